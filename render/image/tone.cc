// SPDX-License-Identifier: Apache-2.0
#include "render/image/tone.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "render/image/gamut.h"
#include "render/image/view_transform.h"

namespace skyfit {
namespace {

double curved(double x, ToneCurve curve) {
  if (curve == ToneCurve::kClip) return std::clamp(x, 0.0, 1.0);
  return curve == ToneCurve::kFilmic ? view_transform::film_curve(x)
                                     : 1 - std::exp(-std::max(x, 0.0));
}

// Uniform in 0..1 from a pixel and channel, without a visible pattern.
double white_noise(std::uint32_t index) {
  index ^= index >> 16;
  index *= 0x7feb352du;
  index ^= index >> 15;
  index *= 0x846ca68bu;
  index ^= index >> 16;
  return index * (1.0 / 4294967296.0);
}

// A frame's pixels as the display's light.
class Display {
 public:
  Display(const Frame& frame, const ToneOptions& tone)
      : frame_(frame),
        tone_(tone),
        space_(color_space(frame.primaries)),
        exposure_(tone.exposure.value() * std::exp2(tone.exposure_stops)) {}

  ColorChannels pixel(std::size_t pixel) const { return display_light(scene_light(pixel), tone_); }

  ColorChannels pixel_with(const EdgePixel& edge) const {
    return mixed(display_light(scene_light(edge.pixel, edge.ground), tone_),
                 display_light(scene_light(edge.pixel, edge.sky), tone_), edge.sky_share);
  }

  // The parts of a pixel that a disc does and does not cover, each by itself.
  ColorChannels pixel_with(const DiscPixel& disc) const {
    const ColorChannels light = scene_light(disc.pixel);
    const ColorChannels sun = exposed({disc.rgb[0], disc.rgb[1], disc.rgb[2]});
    ColorChannels around, covered;
    for (std::size_t k = 0; k < 3; ++k) {
      around[k] = std::max(light[k] - sun[k], 0.0);
      covered[k] = around[k] + sun[k] / disc.cover;
    }
    return mixed(display_light(around, tone_), display_light(covered, tone_), disc.cover);
  }

 private:
  static ColorChannels mixed(const ColorChannels& a, const ColorChannels& b, double share_of_b) {
    ColorChannels mean;
    for (std::size_t k = 0; k < 3; ++k) mean[k] = std::lerp(a[k], b[k], share_of_b);
    return mean;
  }

  // In linear sRGB, without a negative channel.
  ColorChannels exposed(ColorChannels light) const {
    for (double& channel : light) channel *= exposure_;
    return into_gamut(converted(light, space_, color_space(Primaries::kRec709)),
                      luminance_of(light, space_), color_space(Primaries::kRec709));
  }

  ColorChannels scene_light(std::size_t pixel) const {
    const float* rgb = &frame_.rgb[3 * pixel];
    return scene_light(pixel, {rgb[0], rgb[1], rgb[2]});
  }

  // Of a part of a pixel with the pixel's glare.
  ColorChannels scene_light(std::size_t pixel, const std::array<float, 3>& rgb) const {
    ColorChannels light;
    for (std::size_t k = 0; k < 3; ++k) {
      light[k] = rgb[k];
      if (!frame_.glare.empty()) light[k] += frame_.glare[3 * pixel + k];
    }
    return exposed(light);
  }

  const Frame& frame_;
  const ToneOptions& tone_;
  const ColorSpace& space_;
  double exposure_;
};

}  // namespace

ColorChannels display_light(const ColorChannels& scene, const ToneOptions& tone) {
  if (tone.transform == ViewTransform::kChannels) {
    ColorChannels light = scene;
    for (double& channel : light) channel = std::min(curved(channel, tone.curve), 1.0);
    return light;
  }
  const double luminance = luminance_of(scene, color_space(Primaries::kRec709));
  return displayed(scene, luminance, curved(luminance, tone.curve));
}

std::vector<std::uint8_t> tone_mapped(const Frame& frame, const ToneOptions& tone) {
  const Display display(frame, tone);
  std::vector<ColorChannels> light(frame.luminance.size());
  tbb::parallel_for(std::size_t{0}, light.size(),
                    [&](std::size_t pixel) { light[pixel] = display.pixel(pixel); });
  for (const EdgePixel& edge : frame.edges) light[edge.pixel] = display.pixel_with(edge);
  for (const DiscPixel& disc : frame.discs) light[disc.pixel] = display.pixel_with(disc);
  std::vector<std::uint8_t> bytes(frame.rgb.size());
  tbb::parallel_for(std::size_t{0}, bytes.size(), [&](std::size_t i) {
    const auto index = static_cast<std::uint32_t>(i);
    const double noise = white_noise(2 * index) - white_noise(2 * index + 1);
    const double level = 255 * view_transform::srgb_transfer(light[i / 3][i % 3]) + 0.5 + noise;
    bytes[i] = static_cast<std::uint8_t>(std::clamp(std::floor(level), 0.0, 255.0));
  });
  return bytes;
}

}  // namespace skyfit
