// SPDX-License-Identifier: Apache-2.0
#include "cli/light_check.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "cli/arguments.h"

namespace skyfit::cli {
namespace {

bool is_light(double value) { return std::isfinite(value) && value >= 0; }

[[noreturn]] void fail(std::string_view name, double value, std::string_view where) {
  throw std::runtime_error(fmt::format(
      "{} = {:.9g} at {}: expected a finite number >= 0; nothing is written", name, value, where));
}

void check_pixels(const std::vector<float>& values, int channels, int width,
                  std::string_view name) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (is_light(static_cast<double>(values[i]))) continue;
    const int pixel = static_cast<int>(i) / channels;
    fail(name, static_cast<double>(values[i]),
         fmt::format("column {}, row {} of the picture", pixel % width, pixel / width));
  }
}

}  // namespace

void check_light(const SkyValues& sky, const std::vector<WavelengthNode>& nodes,
                 const std::vector<SkyPoint>& points) {
  for (int i = 0; i < sky.points; ++i) {
    for (int k = 0; k < sky.wavelengths; ++k) {
      if (is_light(sky.at(i, k))) continue;
      const SkyPoint& p = points[static_cast<std::size_t>(i)];
      fail("radiance", sky.at(i, k),
           fmt::format("altitude {:.9g} m, sun zenith {:.9g}, view zenith {:.9g}, azimuth {:.9g} "
                       "deg, {:.9g} nm",
                       p.altitude_m, degrees(p.sun_zenith), degrees(p.view_zenith),
                       degrees(p.relative_azimuth),
                       nodes[static_cast<std::size_t>(k)].wavelength_nm));
    }
  }
}

void check_irradiance(const SkyValues& irradiance, const std::vector<WavelengthNode>& nodes,
                      double altitude_m, double sun_zenith) {
  for (int i = 0; i < irradiance.points; ++i) {
    for (int k = 0; k < irradiance.wavelengths; ++k) {
      if (is_light(irradiance.at(i, k))) continue;
      fail("irradiance", irradiance.at(i, k),
           fmt::format("altitude {:.9g} m, sun zenith {:.9g} deg, {:.9g} nm", altitude_m,
                       degrees(sun_zenith), nodes[static_cast<std::size_t>(k)].wavelength_nm));
    }
  }
}

void check_light(const Frame& frame) {
  check_pixels(frame.luminance, 1, frame.width, "luminance");
  check_pixels(frame.rgb, 3, frame.width, "colour");
  if (!frame.layers) return;
  check_pixels(frame.layers->in_scatter, 3, frame.width, "inscatter");
  check_pixels(frame.layers->reflected, 3, frame.width, "reflected light");
  check_pixels(frame.layers->direct, 3, frame.width, "direct light");
  check_pixels(frame.layers->transmittance, 3, frame.width, "transmittance");
}

void check_light(const std::vector<fit::ModelComparison>& rows) {
  for (const fit::ModelComparison& row : rows) {
    for (const auto& errors : {row.unfitted, row.fitted}) {
      if (!errors) continue;
      const std::string model = "model " + row.model;
      if (!is_light(errors->scale)) fail("scale", errors->scale, model);
      if (!is_light(errors->rms_log_percent)) fail("RMS error", errors->rms_log_percent, model);
      for (std::size_t i = 0; i < errors->model.size(); ++i)
        if (std::isinf(errors->model[i]) || errors->model[i] < 0)
          fail("luminance", errors->model[i], fmt::format("{}, sample {}", model, i));
    }
  }
}

}  // namespace skyfit::cli
