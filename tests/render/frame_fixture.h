// SPDX-License-Identifier: Apache-2.0
// What tests of frames share: one atmosphere, one renderer (it keeps its terrain from frame to
// frame) and ways to talk about pixels.
#pragma once

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "model/base/temporary_directory.h"
#include "render/render.h"
#include "tests/render/gl_fixture.h"

namespace skyfit {

inline constexpr double kDegree = std::numbers::pi / 180;

inline const Preset& earth_clear() {
  static const Preset loaded = shipped("earth-clear");
  return loaded;
}

inline const AtmosphereTables& small_tables() {
  static const AtmosphereTables made = tables_of(earth_clear(), kSmallTables);
  return made;
}

inline Renderer make_renderer(const Scene& scene = {},
                              GraphicsDevice device = GraphicsDevice::kSoftware,
                              std::shared_ptr<ContentCache> cache = nullptr) {
  Renderer made(scene, device, std::move(cache));
  made.set_atmosphere(earth_clear(), small_tables());
  return made;
}

inline Renderer& renderer() {
  static Renderer made = make_renderer();
  return made;
}

inline Frame draw_layers(FrameOptions options, Renderer& with = renderer()) {
  options.layers = true;
  return with.draw(options);
}

// The named view in a picture of one sample per pixel.
inline FrameOptions options_of(std::string_view name, int width, int height) {
  const NamedView& view = find_view(name);
  FrameOptions options;
  options.width = width;
  options.height = height;
  options.samples_per_side = 1;
  options.camera = view.camera;
  options.site = view.site;
  options.sun_zenith = view.sun_zenith;
  if (options.site) options.camera.altitude_m += renderer().ground_height_m(options.site);
  return options;
}

// The camera at the coast.
inline FrameOptions options_at(const Camera& camera, double sun_zenith, int width, int height) {
  FrameOptions options;
  options.width = width;
  options.height = height;
  options.samples_per_side = 1;
  options.camera = camera;
  options.sun_zenith = sun_zenith;
  return options;
}

inline glm::dvec3 direction_to(double zenith, double azimuth) {
  return {std::sin(zenith) * std::cos(azimuth), -std::sin(zenith) * std::sin(azimuth),
          std::cos(zenith)};
}

inline glm::dvec3 ray_of(const Frame& frame, std::size_t pixel) {
  return direction_to(frame.view_zenith_deg[pixel] * kDegree,
                      frame.view_azimuth_deg[pixel] * kDegree);
}

inline bool is_sky(const Frame& frame, std::size_t pixel) {
  return std::isinf(frame.depth_m[pixel]);
}

// Of linear sRGB.
inline double luminance_of(const std::vector<float>& rgb, std::size_t pixel) {
  return 0.2126729 * rgb[3 * pixel] + 0.7151522 * rgb[3 * pixel + 1] +
         0.0721750 * rgb[3 * pixel + 2];
}

inline glm::dvec3 color_of(const std::vector<float>& rgb, std::size_t pixel) {
  return {rgb[3 * pixel], rgb[3 * pixel + 1], rgb[3 * pixel + 2]};
}

// The largest error of a picture and the pixel that has it.
class WorstPixel {
 public:
  void add(const Frame& frame, std::size_t pixel, double error) {
    ++count_;
    square_ += error * error;
    if (count_ > 1 && std::abs(error) <= std::abs(error_)) return;
    error_ = error;
    x_ = static_cast<int>(pixel) % frame.width;
    y_ = static_cast<int>(pixel) / frame.width;
  }
  int count() const { return count_; }
  double error() const { return std::abs(error_); }
  double rms() const { return count_ > 0 ? std::sqrt(square_ / count_) : 0; }
  std::string text() const {
    char line[120];
    std::snprintf(line, sizeof line, "%.3g at pixel (%d, %d), rms %.3g of %d", error_, x_, y_,
                  rms(), count_);
    return line;
  }
  void print(const char* what) const { std::printf("[  worst ] %s: %s\n", what, text().c_str()); }

 private:
  int count_ = 0, x_ = 0, y_ = 0;
  double error_ = 0, square_ = 0;
};

}  // namespace skyfit
