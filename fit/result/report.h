// SPDX-License-Identifier: Apache-2.0
// What a fit found, for people and for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "fit/result/result.h"
#include "fit/uncertainty/checks.h"

namespace skyfit::fit {

std::string brief_report(const Result& result);  // one line
// Tables, at most 100 columns but for names, notes and reasons.
std::string full_report(const Result& result, const Checks& checks = {});
// The preset's record (record.h), and the checks.
nlohmann::json report_json(const Result& result, const Checks& checks = {});

}  // namespace skyfit::fit
