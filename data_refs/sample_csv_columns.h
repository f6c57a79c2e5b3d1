// SPDX-License-Identifier: Apache-2.0
// The columns of a CSV of samples, which its reader and its writer share (meaning: sample_csv.h).
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "data_refs/samples.h"

namespace skyfit::refs::sample_csv {

inline constexpr std::string_view kSunZenith = "sun_zenith_deg", kViewZenith = "view_zenith_deg",
                                  kRelativeAzimuth = "relative_azimuth_deg",
                                  kSunAzimuth = "sun_azimuth_deg",
                                  kViewAzimuth = "view_azimuth_deg", kWavelength = "wavelength_nm",
                                  kSigma = "sigma", kWeight = "weight",
                                  kReason = "zero_weight_reason", kDirection = "direction",
                                  kScan = "scan", kTime = "time_utc", kDistance = "sun_distance_au",
                                  kElevation = "elevation_m";

struct ValueColumn {
  std::string_view name;
  Quantity quantity;
};
inline constexpr std::array kValueColumns = {
    ValueColumn{"luminance_cd_m2", Quantity::kLuminance},
    ValueColumn{"relative_luminance", Quantity::kRelativeLuminance},
    ValueColumn{"spectral_radiance_w_m2_sr_nm", Quantity::kSpectralRadiance}};
// Of irradiances, which are no columns of such a CSV (irradiance.h): their names in records.
inline constexpr std::array kIrradianceColumns = {
    ValueColumn{"illuminance_lx", Quantity::kIlluminance},
    ValueColumn{"irradiance_w_m2", Quantity::kIrradiance}};
constexpr std::string_view value_column(Quantity quantity) {
  return is_irradiance(quantity)
             ? std::ranges::find(kIrradianceColumns, quantity, &ValueColumn::quantity)->name
             : std::ranges::find(kValueColumns, quantity, &ValueColumn::quantity)->name;
}

struct PolarisationColumn {
  std::string_view name, sigma;
  Polarisation what;
};
inline constexpr std::array kPolarisationColumns = {
    PolarisationColumn{"q_over_i", "q_over_i_sigma", Polarisation::kQ},
    PolarisationColumn{"u_over_i", "u_over_i_sigma", Polarisation::kU},
    PolarisationColumn{"dolp", "dolp_sigma", Polarisation::kDegree}};
constexpr std::string_view polarisation_column(Polarisation what) {
  return std::ranges::find(kPolarisationColumns, what, &PolarisationColumn::what)->name;
}

inline constexpr std::array kColumns = {kSunZenith,
                                        kViewZenith,
                                        kRelativeAzimuth,
                                        kSunAzimuth,
                                        kViewAzimuth,
                                        kValueColumns[0].name,
                                        kValueColumns[1].name,
                                        kValueColumns[2].name,
                                        kWavelength,
                                        kSigma,
                                        kPolarisationColumns[0].name,
                                        kPolarisationColumns[0].sigma,
                                        kPolarisationColumns[1].name,
                                        kPolarisationColumns[1].sigma,
                                        kPolarisationColumns[2].name,
                                        kPolarisationColumns[2].sigma,
                                        kWeight,
                                        kReason,
                                        kDirection,
                                        kScan,
                                        kTime,
                                        kDistance,
                                        kElevation};

}  // namespace skyfit::refs::sample_csv
