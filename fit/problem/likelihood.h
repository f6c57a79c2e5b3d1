// SPDX-License-Identifier: Apache-2.0
// How a fit compares the model with its samples, the whole difference between a fit of a CIE sky
// and one of a spectroradiometer:
//
//   link     residual of a sample                                       derivative
//   log      (ln(c model) - ln(value)) / (factor sigma / value)         model' / model
//   linear   (c model - value) / (factor sigma)                         c model'
//
//   scale    the factor c of a scan
//   fixed    1: the values are absolute
//   shared   an unknown of all scans (instrument.scale)
//   per-scan one unknown of each
//   profiled the value that makes the scan's sum of squares smallest, in closed form: the
//            weighted mean of the logarithms, or sum(w model value) / sum(w model^2). The Jacobian
//            is that of the profiled residuals (variable projection, Golub & Pereyra 1973).
//
// A reading of polarisation has the linear link without a scale, whatever the others have, and its
// own sigma. An irradiance beside a sky has the logarithmic link without a scale and a known noise:
// its stated sigma, or 5 %, without the factor.
//
// sigma^2 = floor^2 + (relative value)^2 where the reference states none, over the square root of
// the sample's weight. A loss acts on the mean square of a line of sight's residuals; the profiled
// scale is that of plain squares.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>
#include <vector>

#include "data_refs/samples.h"
#include "fit/problem/dataset.h"
#include "fit/problem/sky_values.h"
#include "fit/solve/least_squares.h"

namespace skyfit::fit {

enum class Link { kLog, kLinear };
enum class Scale { kFixed, kShared, kPerScan, kProfiled };
std::string_view link_name(Link link);     // "log", "linear"
std::string_view scale_name(Scale scale);  // "fixed", "shared", "per-scan", "profiled"

struct Likelihood {
  Link link = Link::kLog;
  Scale scale = Scale::kProfiled;
  NoiseModel noise;  // of the samples that state no sigma
  // Sigma is as stated; otherwise it is multiplied with a factor that the residuals show.
  bool noise_is_known = false;
  Loss loss = Loss::kNone;
  double loss_width = 3;  // sigmas
};

// What a quantity is fitted with unless options say otherwise: a relative luminance with log and
// profiled, an absolute luminance or spectral radiance with linear and fixed, an irradiance with
// log and fixed.
Link default_link(refs::Quantity quantity);
Scale default_scale(refs::Quantity quantity);

struct Whitened {
  Eigen::VectorXd residual;           // per sample
  Eigen::MatrixXd jacobian_per_unit;  // [sample][unknown], per unit of the unknown
  // c of each scan where it is profiled (NaN without a sample), else 1.
  Eigen::VectorXd scale;
};

// `values`: of the model, with the instrument. Throws std::domain_error under the log link when a
// value of the model is not finite and > 0.
Whitened whiten(const Dataset& data, const Likelihood& likelihood, const SampleValues& values,
                double factor);

// Subtracts from every column its weighted mean over each scan: profiles one additive constant per
// scan out. Returns the means, [scan][column]; NaN of a scan without a row.
Eigen::MatrixXd subtract_scan_means(const std::vector<int>& scan, int scans,
                                    const Eigen::VectorXd& weight,
                                    Eigen::Ref<Eigen::MatrixXd> columns);

}  // namespace skyfit::fit
