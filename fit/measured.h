// SPDX-License-Identifier: Apache-2.0
// Fits an atmosphere to measured skies: absolute luminances or spectral radiances of one or several
// scans, jointly, with what is not known of the instrument as further unknowns.
//
// Residuals, one per sample: (model - measured) / sigma, sigma^2 = floor^2 + (relative * value)^2
// where the reference states none, over the square root of the sample's weight. One residual
// (unknown - mean) / sigma per prior. A loss acts on the mean square of each direction's residuals.
//
// A smooth sky's misfit by another is not noise: it agrees between neighbouring directions and
// wavelengths (scan_noise.h). Unless the noise is stated, sigma is multiplied with a factor that
// the residuals show, sqrt(chi^2 / degrees of freedom / share of independent wavelengths), so that
// a direction's spectrum weighs against the priors as the few samples that it is worth; the fit is
// repeated with it. The covariance is that of this estimate under residuals that are correlated
// over directions as well.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fit/fit.h"
#include "fit/problem/scan_data.h"
#include "fit/problem/unknowns.h"
#include "fit/solve/least_squares.h"
#include "model/atmosphere/ground_spectrum.h"

namespace skyfit::fit {

enum class Calibration {
  kAbsolute,     // the scale is 1
  kSharedScale,  // one unknown scale of all scans
  kScalePerScan
};
enum class Pointing {
  kStated,         // the instrument points where it says
  kAzimuth,        // an unknown azimuth offset per scan
  kAzimuthAndTilt  // and two unknown tilts per scan
};

struct MeasuredOptions {
  // The atmosphere's parameters, starts, limits and threads. Without `free` the table's, and for
  // spectral radiances the Angstrom exponent as well; with an empty list none: the start is
  // evaluated, with the instrument's unknowns fitted. The forward lobe g1 gets a prior. Where
  // neither a preset nor a pressure is given, the air has the standard pressure of the elevation
  // that the scans state.
  FitOptions common;
  std::set<Parameter> per_scan;  // of the free ones: one unknown per scan
  Calibration calibration = Calibration::kAbsolute;
  Pointing pointing = Pointing::kAzimuth;
  std::map<Instrument, Prior> instrument_priors;  // in place of the table's, in its units
  NoiseModel noise;
  bool noise_is_stated = false;  // true: sigma is taken at its word
  Loss loss = Loss::kNone;
  double loss_width = 3;  // sigmas
  std::optional<std::shared_ptr<const GroundSpectrum>>
      ground;  // in place of the start's; null: grey
};
// Throws std::invalid_argument, one line that names the option.
void validate(const MeasuredOptions& options);

struct UnknownRow {
  Unknown unknown;
  // In the unit of the report.
  double start = 0, fitted = 0;
  double sigma = 0;  // priors included; NaN at a bound and when nothing holds the unknown
  bool at_bound = false, identifiable = true;
};

// How far the model is from the measured values, percent, over samples with weight.
struct MeasuredErrors {
  // Root mean square of model / measured - 1 of the luminance of every direction; for spectra the
  // sum of y_bar times radiance over the wavelengths at hand, both sides alike; NaN where none of
  // them is visible.
  double luminance = 0;
  // |model - measured| / |measured|, 2-norms over all samples of 400 .. 700 nm; NaN for luminances.
  double spectral = 0;
  double mean_bias = 0;  // mean of the luminances' model / measured - 1
};

struct ScanOutcome {
  ScanInfo info;
  Atmosphere<double> atmosphere;
  std::array<double, kInstrumentCount> instrument;  // radians, 1
  MeasuredErrors errors;
  int samples = 0, directions = 0;
};

struct MeasuredResult {
  // As fitted: samples closer to the sun than exclude_sun, where the instrument truly points, have
  // weight 0.
  refs::Reference reference;
  Preset preset;  // the atmosphere of the first scan: of all, unless parameters are per scan
  std::vector<UnknownRow> unknowns;
  std::vector<int> covariance_unknowns;  // rows and columns of the matrices: indices of unknowns
  Eigen::MatrixXd covariance;            // in the reports' units; empty when singular
  Eigen::MatrixXd correlation;           // empty when singular
  double condition_number = 0;
  double sigma_factor = 1;  // on the stated or assumed sigma, see above
  double effective_samples = 0;
  double chi_square_per_dof = 0;  // with the factor left out
  MeasuredErrors start_errors, errors;
  std::vector<ScanOutcome> scans;
  std::vector<double> model, start_model;  // per sample of the reference, with the instrument
  // Per sample; NaN where the sample was not fitted. sigma: the assumed one times the root mean
  // square of the whitened residuals, what one sample scatters by.
  std::vector<double> loss_weight, sigma;
  std::vector<StartSummary> starts;
  bool converged = false;
  std::string termination;
  int samples = 0, directions = 0, iterations = 0, model_evaluations = 0,
      derivative_evaluations = 0;
  double wall_seconds = 0;
};

// Throws std::invalid_argument for options, a start outside the bounds, or a reference that cannot
// be fitted; std::runtime_error when the solver fails. One line, naming option, value, constraint.
MeasuredResult fit_measured(const refs::Reference& reference, const SpectralData& spectra,
                            const SkyModel& model, const MeasuredOptions& options);

// Errors of values, one per sample of the reference, over the samples with weight, of one scan or
// of all (kAllScans).
MeasuredErrors measured_errors(const refs::Reference& reference, const std::vector<double>& model,
                               const SpectralData& spectra, int scan);

}  // namespace skyfit::fit
