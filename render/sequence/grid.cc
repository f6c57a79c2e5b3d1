// SPDX-License-Identifier: Apache-2.0
#include "render/sequence/grid.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace skyfit {
namespace {

// Copies rows of `values` per pixel into a larger picture, whose pixel `corner` is the first.
void paste(const std::vector<float>& from, const Frame& part, std::size_t values,
           std::size_t corner, const Frame& whole, std::vector<float>& to) {
  const auto row_values = static_cast<std::ptrdiff_t>(values) * part.width;
  for (int y = 0; y < part.height; ++y) {
    const auto row = from.begin() + y * row_values;
    const auto at = values * (corner + static_cast<std::size_t>(y) * whole.width);
    std::copy(row, row + row_values, to.begin() + static_cast<std::ptrdiff_t>(at));
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

// The pixel of `whole` at which a frame of a grid begins.
std::size_t corner_of(std::size_t number, const FrameGrid& grid, const Frame& whole) {
  const Frame& frame = grid.frames[number];
  const std::size_t column = number % grid.columns, row = number / grid.columns;
  return row * (frame.height + kGridGap) * whole.width + column * (frame.width + kGridGap);
}

void add(const Frame& frame, std::size_t corner, Frame& whole) {
  const auto add = [&](const std::vector<float>& from, std::size_t values, std::vector<float>& to) {
    paste(from, frame, values, corner, whole, to);
  };
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
  const auto add_pixels = [&](const auto& from, auto& to) {
    for (auto part : from) {
      part.pixel = corner + part.pixel / frame.width * whole.width + part.pixel % frame.width;
      to.push_back(part);
    }
  };
  add_pixels(frame.discs, whole.discs);
  add_pixels(frame.edges, whole.edges);
}

std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && parsed == end ? std::optional(value) : std::nullopt;
}

// 4 digits, "20000" and "1e-06".
std::string short_text(double number) {
  return fmt::format("{}", number_in(fmt::format("{:.4g}", number)).value());
}

}  // namespace

std::size_t steps_of(const GridAxis& axis) { return axis.empty() ? 1 : axis[0].values.size(); }

std::vector<double> spaced(double first, double last, int count, Spacing spacing) {
  if (spacing == Spacing::kGeometric && !(first * last > 0))
    throw std::invalid_argument("geometric steps: expected both ends above 0, or both below");
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    const double share = i / (count - 1.0);
    const double value = spacing == Spacing::kEven ? std::lerp(first, last, share)
                                                   : first * std::pow(last / first, share);
    values.push_back(number_in(fmt::format("{:.9g}", value)).value());
  }
  return values;
}

std::string described(const GridAxis& axis) {
  std::vector<std::string> quantities;
  for (const auto& [name, caption, unit, values] : axis) {
    quantities.push_back(fmt::format("{}{}: {}", name, unit.empty() ? "" : " [" + unit + "]",
                                     fmt::join(values, ", ")));
  }
  return fmt::format("{}", fmt::join(quantities, "; "));
}

std::vector<Caption> captions_at(const GridAxis& columns, std::size_t column, const GridAxis& rows,
                                 std::size_t row) {
  std::vector<Caption> captions;
  const auto add = [&](const GridAxis& axis, std::size_t step) {
    for (const auto& [name, caption, unit, values] : axis) {
      const auto number = number_in(values[step]);
      const std::string value = number ? short_text(*number) : values[step];
      captions.push_back({caption, unit.empty() || unit == "1" ? value : value + " " + unit});
    }
  };
  add(columns, column);
  add(rows, row);
  return captions;
}

Frame joined(const FrameGrid& grid) {
  if (grid.columns < 1 || grid.frames.empty() || grid.frames.size() % grid.columns != 0)
    throw std::invalid_argument("joined: expected whole rows of frames");
  const Frame& first = grid.frames[0];
  for (const Frame& frame : grid.frames) {
    if (frame.width != first.width || frame.height != first.height ||
        frame.layers.has_value() != first.layers.has_value() || frame.primaries != first.primaries)
      throw std::invalid_argument("joined: expected frames of one size and kind");
  }
  const int rows = static_cast<int>(grid.frames.size()) / grid.columns;
  Frame whole = empty_frame(grid.columns * (first.width + kGridGap) - kGridGap,
                            rows * (first.height + kGridGap) - kGridGap, first.layers.has_value());
  whole.metadata = first.metadata;
  whole.metadata.insert(whole.metadata.end(), grid.metadata.begin(), grid.metadata.end());
  whole.primaries = first.primaries;
  for (std::size_t i = 0; i < grid.frames.size(); ++i)
    add(grid.frames[i], corner_of(i, grid, whole), whole);
  std::ranges::sort(whole.discs, {}, &DiscPixel::pixel);
  std::ranges::sort(whole.edges, {}, &EdgePixel::pixel);
  return whole;
}

}  // namespace skyfit
