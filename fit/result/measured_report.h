// SPDX-License-Identifier: Apache-2.0
// What a fit of measured skies found, for people and for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fit/measured.h"
#include "fit/uncertainty/measured_checks.h"

namespace skyfit::fit {

// What was asked for beside the fit itself.
struct MeasuredChecks {
  std::vector<Profile> profiles;
  std::optional<Bootstrap> bootstrap;
  std::vector<HoldOut> hold_outs;
};

std::string brief_report(const MeasuredResult& result);  // one line
// Tables, at most 100 columns.
std::string full_report(const MeasuredResult& result, const MeasuredChecks& checks);
nlohmann::json report_json(const MeasuredResult& result, const MeasuredChecks& checks);

}  // namespace skyfit::fit
