// SPDX-License-Identifier: Apache-2.0
// What a fit is told. The defaults depend on the quantity of the reference and on nothing else:
//
//   quantity              link    scale     pointing  free besides the table's
//   relative luminance    log     profiled  stated    -
//   luminance             linear  fixed     azimuth   -
//   spectral radiance     linear  fixed     azimuth   the Angstrom exponent, of two wavelengths or
//                                                     more
//   irradiance            log     fixed     stated    only the aerosol's optical depth at 550 nm;
//   of
//                                                     two kinds or more its single scattering
//                                                     albedo, too
//
// Too few irradiances show their own noise: theirs is known, as stated or 5 %.
//
// Where the pointing is unknown the forward lobe g1 gets a prior. Where no preset is given, the air
// of all but relative luminances scatters after Bodhaine et al. 1999 (dry_air.h) and has the
// pressure that is given, or the standard pressure of the elevation that the scans state, or that
// of the sea's level; its prior is 0.5 % of that.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "data_refs/aeronet_products.h"
#include "fit/problem/instrument.h"
#include "fit/problem/likelihood.h"
#include "model/atmosphere/ground_spectrum.h"
#include "model/atmosphere/parameters.h"
#include "model/atmosphere/preset.h"

namespace skyfit::fit {

struct FitOptions {
  int lobes = 2;                             // 1 or 2; a tabulated phase function stays
  int starts = 4;                            // >= 1; multi-start of the phase parameters
  int max_iterations = 100;                  // per start, >= 1
  double exclude_sun = 0.05235987755982988;  // radians (3 deg) around the sun that are left out
  int threads = 2;              // >= 1: starts solved at once; results do not depend on it
  std::optional<Preset> start;  // otherwise the table's defaults
  std::optional<double> site_pressure_hpa;  // > 0; otherwise the start's
  // Exactly these; none: the start is evaluated, with the instrument's unknowns fitted.
  std::optional<std::vector<Parameter>> free;
  std::map<Parameter, double> fix;
  std::map<Parameter, Bounds> bounds;  // of free ones, in the place of the table's
  std::map<Parameter, Prior> priors;   // in the place of the table's, or besides
  bool use_priors = true;              // false drops those of the tables
  std::set<Parameter> per_scan;        // of the free ones: one unknown per scan
  std::optional<Link> link;            // the default ones: see above
  std::optional<Scale> scale;
  std::optional<Pointing> pointing;
  std::map<Instrument, Prior> instrument_priors;  // in place of the table's, in its units
  std::optional<NoiseModel> noise;                // known: not rescaled by the residuals
  Loss loss = Loss::kNone;
  double loss_width = 3;  // sigmas
  std::optional<std::shared_ptr<const GroundSpectrum>>
      ground;  // in place of the start's; null: grey
  // Of the aerosol: its amount becomes an optical depth at 550 nm, and the values are start and
  // prior of optical depth, exponent and single scattering albedo where these are free.
  std::optional<refs::AerosolKnowledge> aerosol;
  std::function<void(double fraction, const std::string& status)> progress;  // may be empty
};
// Throws std::invalid_argument, one line: `fit.starts = 0: must be >= 1`.
void validate(const FitOptions& options);

// Throws std::invalid_argument where the options and the quantity contradict each other: a relative
// luminance has no absolute value, its scale must be profiled; or where under the log link some of
// the samples with weight state a sigma and others do not.
Likelihood likelihood_of(const FitOptions& options, const refs::Reference& reference);
Pointing pointing_of(const FitOptions& options, const refs::Reference& reference);

}  // namespace skyfit::fit
