// SPDX-License-Identifier: Apache-2.0
// How far a model is from a reference, in percent, over the samples with weight.
#pragma once

#include <vector>

#include "data_refs/samples.h"
#include "model/photometry/photometry.h"

namespace skyfit::fit {

struct Errors {
  // Root mean square of ln(model / value), weighted with the samples' weights, the mean of every
  // scan subtracted: what is left with a free scale per scan. NaN where a value is not positive.
  double rms_log = 0;
  // Root mean square of model / value - 1 of the luminance of every direction; for spectra the sum
  // of y_bar times radiance over the wavelengths at hand, both sides alike; NaN where these give no
  // luminance (refs::gives_luminance()).
  double luminance = 0;
  // |model - value| / |value|, 2-norms over all samples of 400 .. 700 nm; NaN for luminances.
  double spectral = 0;
  double mean_bias = 0;  // mean of the luminances' model / value - 1; NaN as they are
};

// Of the fitted readings of one kind of polarisation, in percentage points: root mean squares of
// model - value, and of sigma with the fit's factor.
struct PolarisationErrors {
  refs::Polarisation what;
  int readings = 0;
  double start_rms = 0, rms = 0, sigma = 0;
};

// Of the fitted irradiances of one kind beside a sky, percent: root mean squares of
// model / value - 1, and of sigma over the value.
struct IrradianceErrors {
  Irradiance what;
  int samples = 0;
  double start_rms = 0, rms = 0, mean_bias = 0, sigma = 0;
};

// `model`: one value per sample of the reference; samples without one (NaN) and irradiances beside
// a sky do not count. Of one scan (the reference's number) or of all (-1).
Errors errors_of(const refs::Reference& reference, const std::vector<double>& model,
                 const SpectralData& spectra, int scan = -1);

// rms_log of all scans over parts of the sky: outside the cone around the sun that the fit leaves
// out, outside 3 and 10 deg, and with the sun at most 70 deg from the zenith. NaN when no sample
// qualifies.
struct RmsSummary {
  double all = 0, cone3 = 0, cone10 = 0, sun_below_70 = 0;
};
RmsSummary rms_summary(const refs::Reference& reference, const std::vector<double>& model,
                       double exclude_sun);

}  // namespace skyfit::fit
