// SPDX-License-Identifier: Apache-2.0
#include "render/panels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "model/photometry/srgb_transfer.h"

namespace skyfit {
namespace {

// A picture of [pixel][3] values, without the sun's disc and its glare.
Frame picture_of(const Frame& frame, std::vector<float> rgb) {
  Frame picture;
  picture.width = frame.width;
  picture.height = frame.height;
  picture.primaries = frame.primaries;
  picture.rgb = std::move(rgb);
  picture.luminance = frame.luminance;
  picture.depth_m = frame.depth_m;
  picture.metadata = frame.metadata;
  return picture;
}

const FrameLayers& layers_of(const Frame& frame) {
  if (!frame.layers) throw std::logic_error("render: panels need a frame with layers");
  return *frame.layers;
}

Frame in_scatter(const Frame& frame) { return picture_of(frame, layers_of(frame).in_scatter); }
Frame reflected(const Frame& frame) { return picture_of(frame, layers_of(frame).reflected); }
Frame direct(const Frame& frame) { return picture_of(frame, layers_of(frame).direct); }
Frame ambient(const Frame& frame) {
  std::vector<float> rgb = layers_of(frame).reflected;
  for (std::size_t i = 0; i < rgb.size(); ++i)
    rgb[i] = std::max(rgb[i] - frame.layers->direct[i], 0.0f);
  return picture_of(frame, std::move(rgb));
}
Frame transmittance(const Frame& frame) {
  return picture_of(frame, layers_of(frame).transmittance);
}
Frame albedo(const Frame& frame) { return picture_of(frame, layers_of(frame).albedo); }

// As in normal maps: a component from -1 to 1 is a channel from 0 to 1.
Frame normal(const Frame& frame) {
  const std::vector<float>& normals = layers_of(frame).normal;
  std::vector<float> rgb(normals.size());
  for (std::size_t pixel = 0; pixel < rgb.size() / 3; ++pixel) {
    if (std::isinf(frame.depth_m[pixel])) continue;  // black, as nothing is there
    for (std::size_t k = 3 * pixel; k < 3 * pixel + 3; ++k)
      rgb[k] = static_cast<float>(srgb_decoded(0.5 + 0.5 * double{normals[k]}));
  }
  return picture_of(frame, std::move(rgb));
}

// Black at the nearest point of the picture, light grey at the farthest, even in the logarithm of
// the distance; the sky is white.
Frame depth(const Frame& frame) {
  constexpr double kFarthest = 0.9;
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const float d : frame.depth_m) {
    if (std::isinf(d)) continue;
    nearest = std::min(nearest, double{d});
    farthest = std::max(farthest, double{d});
  }
  const double range = std::log(farthest / nearest);
  std::vector<float> rgb;
  for (const float d : frame.depth_m) {
    const double grey = std::isinf(d) ? 1
                        : range > 0   ? kFarthest * std::log(d / nearest) / range
                                      : 0;
    rgb.insert(rgb.end(), 3, static_cast<float>(srgb_decoded(grey)));
  }
  return picture_of(frame, std::move(rgb));
}

}  // namespace

std::span<const PanelEntry> frame_panels() {
  static constexpr PanelEntry kPanels[] = {
      {"in-scatter", "light that the air sends to the eye", in_scatter, true},
      {"reflected", "light of ground, objects and clouds, as it arrives at the eye", reflected,
       true},
      {"direct", "the part of it that is the suns' beams'", direct, true},
      {"ambient", "the rest of it: light of sky, clouds and the ground around", ambient, true},
      {"transmittance", "share of sunlight that the air lets through, 1 is white", transmittance,
       false},
      {"albedo", "share of sunlight that the ground reflects, 1 is white", albedo, false},
      {"normal",
       "x, y, z toward the sun's azimuth, left of it and up, -1 to 1, as red, green, blue", normal,
       false},
      {"depth", "logarithm of the distance, black the nearest; the sky is white", depth, false},
  };
  return kPanels;
}

void write_panel(const PanelEntry& panel, const Frame& frame, const std::filesystem::path& file,
                 const ToneOptions& tone) {
  ToneOptions shown = tone;
  if (!shown.exposure) shown.exposure = metered_exposure(frame);
  if (!panel.is_light) {
    shown = {.exposure = 1, .curve = ToneCurve::kClip, .transform = ViewTransform::kChannels};
  }
  Frame picture = panel.draw(frame);
  if (!panel.is_light) picture.primaries = Primaries::kRec709;  // shares, not light
  write_png(picture, file, shown);
}

}  // namespace skyfit
