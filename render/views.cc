// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "render/render.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

constexpr std::array<NamedView, 6> kViews = {{
    {"ground",
     {2, 76 * kDegree, 0, 65 * kDegree},
     60 * kDegree,
     "2 m above a plain, toward the sun"},
    {"sunset",
     {2, 84 * kDegree, 0, 45 * kDegree},
     88 * kDegree,
     "2 m above a plain, toward a low sun"},
    {"away",
     {2, 80 * kDegree, 180 * kDegree, 60 * kDegree},
     75 * kDegree,
     "2 m above a plain, away from the sun"},
    {"10km",
     {10e3, 95 * kDegree, -80 * kDegree, 60 * kDegree},
     60 * kDegree,
     "from 10 km, over the mountains"},
    {"limb",
     {400e3, 106 * kDegree, -100 * kDegree, 40 * kDegree},
     70 * kDegree,
     "from 400 km, the planet's limb"},
    {"space",
     {11e6, 180 * kDegree, 90 * kDegree, 50 * kDegree},
     45 * kDegree,
     "from 11 000 km, the full disc"},
}};

constexpr int kMaxSide = 16384;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 26;

void require(bool good, std::string_view name, double value, std::string_view expected) {
  if (!good)
    throw std::invalid_argument(
        fmt::format("render.{} = {:.9g}: must be {}", name, value, expected));
}

bool within(double value, double low, double high) { return value >= low && value <= high; }

}  // namespace

std::span<const NamedView> named_views() { return kViews; }

const NamedView& find_view(std::string_view name) {
  std::string known;
  for (const NamedView& view : kViews) {
    if (view.name == name) return view;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", view.name);
  }
  throw std::invalid_argument(fmt::format("render.view = \"{}\": must be one of {}", name, known));
}

void validate(const FrameOptions& options) {
  const Camera& camera = options.camera;
  require(within(options.width, 1, kMaxSide), "width", options.width, "1 to 16384 pixels");
  require(within(options.height, 1, kMaxSide), "height", options.height, "1 to 16384 pixels");
  const std::int64_t pixels = std::int64_t{options.width} * options.height;
  require(pixels <= kMaxPixels, "width * height", static_cast<double>(pixels),
          "at most 67108864 pixels");
  require(within(options.samples_per_side, 1, 4), "samples_per_side", options.samples_per_side,
          "1 to 4");
  require(within(camera.altitude_m, 1, 1e9), "camera.altitude_m", camera.altitude_m, "1 to 1e9 m");
  require(within(camera.view_zenith, 0, std::numbers::pi), "camera.view_zenith", camera.view_zenith,
          "0 to pi");
  require(std::isfinite(camera.azimuth), "camera.azimuth", camera.azimuth, "finite");
  require(within(camera.vertical_fov, kDegree, 150 * kDegree), "camera.vertical_fov",
          camera.vertical_fov, "1 to 150 degrees in radians");
  require(within(options.sun_zenith, 0, std::numbers::pi), "sun_zenith", options.sun_zenith,
          "0 to pi");
}

}  // namespace skyfit
