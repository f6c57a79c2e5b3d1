// SPDX-License-Identifier: Apache-2.0
// Sentences and cells that the reports as text and as a page share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fit/result/result.h"
#include "fit/uncertainty/checks.h"

namespace skyfit::fit {

// "-" where there is none.
std::string number_text(double value, int digits = 5);
// Link, scale, pointing, noise and loss.
std::string likelihood_text(const Result& result);
// "[2] 1030.csv, sun 45.1 deg"; `scan` from 0.
std::string scan_name(const Result& result, std::size_t scan);
// "145 in 145 directions of 1 scans, 3 deg around the sun left out", or "2 under 1 sun"; and how
// many irradiances beside the sky, and how they are weighed.
std::string samples_text(const Result& result);
// Of the errors of directions: "luminance", or what irradiances are.
std::string value_name(const Result& result);
// "at lower bound", "not identifiable" or nothing.
std::string remark_text(const UnknownRow& row);
std::string prior_text(const UnknownRow& row);
// "Q / I", "U / I" or "degree of linear polarisation".
std::string_view polarisation_name(refs::Polarisation what);
// The head of the errors of irradiances beside a sky.
std::string irradiances_title(const Result& result);
// What one sigma is made of; lines of at most 100 columns.
std::string sigma_text(const Result& result);
// What "RMS of log", "luminance", "spectral" and "own" errors are.
std::string errors_meaning(const Result& result);
// Both ends of an interval of a profile; "beyond" its last value where it ends before.
std::string interval_text(const Profile& profile, const Interval& interval);
std::string hold_outs_meaning();
// "4 iterations of all 3 starts; 20 model solutions, 8 with derivatives".
std::string effort_text(const Result& result);
// A sentence for each prior that the misfit overrides; the same lines.
std::vector<std::string> pulled_priors(const Result& result);

}  // namespace skyfit::fit
