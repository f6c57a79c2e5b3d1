// SPDX-License-Identifier: Apache-2.0
// How far a fit can be trusted: the likelihood along one unknown, fits of
// resampled directions, and the errors of samples that were not fitted. All repeat the fit from the
// solution, on its reference and with its options, with at most 12 wavelengths unless the noise is
// known.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fit/problem/options.h"
#include "fit/result/result.h"
#include "model/sky_model.h"

namespace skyfit::fit {

struct Interval {
  double lower, upper;  // NaN: beyond the profile
};

// The other unknowns are fitted at every value; priors included.
struct Profile {
  std::string name, unit;
  std::vector<double> value;       // ascending, in the report's unit, the fitted one among them
  std::vector<double> chi_square;  // above the smallest of them
  Interval percent68, percent95;   // where chi_square crosses 1 and 3.841
};

// `name` as in the report, such as "mie.scattering" or "instrument.azimuth_offset[2]". Values reach
// to three sigmas of the result on both sides, within the bounds. Throws std::invalid_argument that
// lists the names of the unknowns when there is no such one.
Profile profile_likelihood(const SpectralData& spectra, const SkyModel& model,
                           const FitOptions& options, const Result& result, std::string_view name);

// Directions of every scan drawn with replacement, as many as there are.
struct Bootstrap {
  int repetitions = 0, failed = 0;
  std::vector<double> mean, sigma;  // per unknown of the result, in the report's unit
};
Bootstrap bootstrap(const SpectralData& spectra, const SkyModel& model, const FitOptions& options,
                    const Result& result, int repetitions, std::uint64_t seed);

// Errors of what was left out of a fit of the rest.
struct HoldOut {
  std::string name;  // of the scan, or "directions, part 1 of 5"
  // The instrument of a scan left out is the mean of the others'; where the scale is profiled, its
  // own.
  Errors predicted;
  Errors pointed;  // and with its own pointing fitted; the atmosphere stays
};

// Every scan once. Throws std::invalid_argument when there are fewer than two scans.
std::vector<HoldOut> leave_one_scan_out(const SpectralData& spectra, const SkyModel& model,
                                        const FitOptions& options, const Result& result);

// The directions are dealt at random into `parts` >= 2; every part is left out once.
std::vector<HoldOut> hold_out_directions(const SpectralData& spectra, const SkyModel& model,
                                         const FitOptions& options, const Result& result, int parts,
                                         std::uint64_t seed);

// What may be asked for beside the fit itself, and what came of it.
struct CheckOptions {
  std::vector<std::string> profiles;  // names of unknowns
  int bootstrap = 0;                  // repetitions
  // Nothing, every scan in turn (0), or each of so many parts of the directions.
  std::optional<int> hold_out;
  std::uint64_t seed = 1;
};
struct Checks {
  std::vector<Profile> profiles;
  std::optional<Bootstrap> bootstrap;
  std::vector<HoldOut> hold_outs;
};
Checks run_checks(const SpectralData& spectra, const SkyModel& model, const FitOptions& options,
                  const Result& result, const CheckOptions& wanted);

}  // namespace skyfit::fit
