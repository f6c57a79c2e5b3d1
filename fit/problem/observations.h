// SPDX-License-Identifier: Apache-2.0
// The samples of a reference that take part in a fit, as arrays.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "data_refs/samples.h"
#include "model/sky_model.h"

namespace skyfit::fit {

struct Observations {
  std::vector<std::size_t> sample;  // index into the reference's samples
  std::vector<SkyPoint> points;
  Eigen::VectorXd log_reference;
  Eigen::VectorXd weight;          // the samples' weights, > 0
  Eigen::VectorXd sigma_log;       // sigma / value, or 1 where the reference has no sigma
  std::vector<int> scan;           // 0 .. scans - 1
  std::vector<int> scan_name;      // the reference's number of each scan
  std::vector<double> sun_zenith;  // of each scan, radians
  int scans = 0;
  bool has_sigma = false;
  int count() const { return static_cast<int>(points.size()); }
};

// The samples with weight > 0, at least `exclude_sun` (radians) away from the sun and with the sun
// at most `largest_sun_zenith` (radians) from the zenith; may be none. Throws std::invalid_argument
// when a sample is not positive and finite, or when some samples have a sigma and others not.
Observations observe(const refs::Reference& reference, double exclude_sun,
                     double largest_sun_zenith = 10);

SkyPoint sky_point(const refs::Sample& sample);

// Subtracts from every column its weighted mean over each scan: profiles one additive constant per
// scan out. Returns the means, [scan][column].
Eigen::MatrixXd subtract_scan_means(const std::vector<int>& scan, int scans,
                                    const Eigen::VectorXd& weight,
                                    Eigen::Ref<Eigen::MatrixXd> columns);

}  // namespace skyfit::fit
