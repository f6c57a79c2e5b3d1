// SPDX-License-Identifier: Apache-2.0
#include "render/sequence/strip.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace skyfit {
namespace {

// Copies rows of `values` per pixel into a wider picture, from column `left` on.
void paste(const std::vector<float>& from, const Frame& part, std::size_t values, int left,
           const Frame& whole, std::vector<float>& to) {
  for (int y = 0; y < part.height; ++y) {
    const auto row = from.begin() + static_cast<std::ptrdiff_t>(values * y * part.width);
    std::copy(row, row + static_cast<std::ptrdiff_t>(values * part.width),
              to.begin() + static_cast<std::ptrdiff_t>(
                               values * (static_cast<std::size_t>(y) * whole.width + left)));
  }
}

Frame empty_frame(int width, int height, bool layers) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  frame.rgb.resize(3 * pixels);
  frame.luminance.resize(pixels);
  frame.view_zenith_deg.resize(pixels);
  frame.view_azimuth_deg.resize(pixels);
  frame.depth_m.assign(pixels, std::numeric_limits<float>::infinity());
  const std::vector<float> layer(layers ? 3 * pixels : 0);
  if (layers) frame.layers = FrameLayers{layer, layer, layer, layer, layer, layer};
  return frame;
}

}  // namespace

Frame side_by_side(std::span<const Frame> frames, int gap) {
  if (frames.empty()) throw std::invalid_argument("side_by_side: expected a frame");
  int width = gap * (static_cast<int>(frames.size()) - 1);
  for (const Frame& frame : frames) {
    width += frame.width;
    if (frame.height != frames[0].height ||
        frame.layers.has_value() != frames[0].layers.has_value() ||
        frame.primaries != frames[0].primaries)
      throw std::invalid_argument("side_by_side: expected frames of one height and kind");
  }
  Frame whole = empty_frame(width, frames[0].height, frames[0].layers.has_value());
  whole.metadata = frames[0].metadata;
  whole.primaries = frames[0].primaries;
  whole.samples_per_side = frames[0].samples_per_side;
  int left = 0;
  for (const Frame& frame : frames) {
    const auto add = [&](const std::vector<float>& from, std::size_t values,
                         std::vector<float>& to) { paste(from, frame, values, left, whole, to); };
    add(frame.rgb, 3, whole.rgb);
    add(frame.luminance, 1, whole.luminance);
    add(frame.view_zenith_deg, 1, whole.view_zenith_deg);
    add(frame.view_azimuth_deg, 1, whole.view_azimuth_deg);
    add(frame.depth_m, 1, whole.depth_m);
    if (frame.layers) {
      add(frame.layers->in_scatter, 3, whole.layers->in_scatter);
      add(frame.layers->reflected, 3, whole.layers->reflected);
      add(frame.layers->direct, 3, whole.layers->direct);
      add(frame.layers->transmittance, 3, whole.layers->transmittance);
      add(frame.layers->normal, 3, whole.layers->normal);
      add(frame.layers->albedo, 3, whole.layers->albedo);
    }
    if (!frame.glare.empty()) {
      whole.glare.resize(whole.rgb.size());
      add(frame.glare, 3, whole.glare);
    }
    for (DiscPixel disc : frame.discs) {
      disc.pixel = disc.pixel / frame.width * whole.width + left + disc.pixel % frame.width;
      whole.discs.push_back(disc);
    }
    left += frame.width + gap;
  }
  std::ranges::sort(whole.discs, {}, &DiscPixel::pixel);
  return whole;
}

}  // namespace skyfit
