// SPDX-License-Identifier: Apache-2.0
#include "model/sky_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "model/bruneton_model.h"
#include "model/reference_model.h"

namespace skyfit {

void check_model_value(std::string_view model, bool good, std::string_view name, double value,
                       std::string_view expected) {
  if (!good)
    throw std::invalid_argument(
        fmt::format("{} model: {} = {:.9g}: must be {}", model, name, value, expected));
}

void check_point(std::string_view model, const SkyPoint& p) {
  const auto check = [&](bool good, std::string_view name, double value,
                         std::string_view expected) {
    check_model_value(model, good, name, value, expected);
  };
  const auto is_zenith = [](double angle) { return angle >= 0 && angle <= std::numbers::pi; };
  check(std::isfinite(p.altitude_m) && p.altitude_m >= 0, "altitude_m", p.altitude_m, ">= 0");
  check(is_zenith(p.sun_zenith), "sun zenith (rad)", p.sun_zenith, "in 0 .. pi");
  check(is_zenith(p.view_zenith), "view zenith (rad)", p.view_zenith, "in 0 .. pi");
  check(std::isfinite(p.relative_azimuth), "relative azimuth (rad)", p.relative_azimuth, "finite");
}

std::vector<std::string_view> sky_model_names() { return {"reference", "bruneton"}; }

std::unique_ptr<SkyModel> make_sky_model(std::string_view name, int threads) {
  if (name == "reference") {
    ReferenceOptions options;
    options.threads = threads;
    return std::make_unique<ReferenceModel>(options);
  }
  if (name == "bruneton") return std::make_unique<BrunetonModel>(threads);
  throw std::invalid_argument(
      fmt::format("model \"{}\": expected one of {}", name, fmt::join(sky_model_names(), ", ")));
}

}  // namespace skyfit
