// SPDX-License-Identifier: Apache-2.0
// The fits of all standard skies side by side: how close a horizontally uniform atmosphere comes to
// each, for all suns together and for each of them in that joint fit, and with which atmosphere.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "fit/result/findings.h"
#include "fit/result/result.h"

namespace skyfit::fit {

struct StandardSkyFit {
  int type = 0;           // 1 to 15
  std::string_view kind;  // StandardSkyKind::name
  Result result;
};

// Percent, of the joint fit and of one of its suns: what is closer is called the same sky. Chosen:
// joint fits of the fifteen types are either below 8 % or above 12 %.
inline constexpr double kSameSkyPercent = 10;

// What the fit found outside of what the literature calls plausible.
std::vector<Finding> implausible_findings(const Result& result);
// Unknowns at a bound, "ground.albedo".
std::vector<std::string> unknowns_at_bounds(const Result& result);

// A table and, made from the numbers, sentences: which skies an atmosphere can be, and where the
// others fail.
std::string standard_skies_text(const std::vector<StandardSkyFit>& fits);
// One row per type; columns rms_log_percent, rms_log_percent_sun_ZENITH, and one per parameter of
// any fit, empty where a fit has no such parameter.
std::string standard_skies_csv(const std::vector<StandardSkyFit>& fits);
nlohmann::json standard_skies_json(const std::vector<StandardSkyFit>& fits);

}  // namespace skyfit::fit
