// SPDX-License-Identifier: Apache-2.0
// The result of a fit and a comparison of models as NetCDF.
#pragma once

#include <string>
#include <string_view>

#include "fit/exchange/netcdf_file.h"
#include "fit/model_comparison.h"
#include "fit/result/result.h"

namespace skyfit::fit {

// Dimensions sample, scan, parameter (the unknowns) and covariance_parameter (those with a
// covariance): the samples as stated, with model and sigma; the scans; the unknowns with one
// standard deviation, covariance and correlation; the fitted preset as the attribute `preset`.
NetcdfFile netcdf_of(const Result& result);

// Dimensions sample and model: the values of the reference and those of every model, unfitted and
// fitted, each with its scan's scale.
NetcdfFile netcdf_of(const refs::Reference& reference, const std::vector<ModelComparison>& rows);

// UDUNITS' spelling of a unit of the reports: "W m^-2" is "W m-2", "deg" is "degree".
std::string cf_unit(std::string_view unit);

// Seconds since 1970-01-01 of "2013-05-27T13:30:00Z"; NaN of "".
double seconds_since_1970(const std::string& time_utc);
inline constexpr const char* kSecondsSince1970 = "seconds since 1970-01-01T00:00:00Z";

}  // namespace skyfit::fit
