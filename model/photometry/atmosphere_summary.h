// SPDX-License-Identifier: Apache-2.0
// What an atmosphere holds, in the quantities of the field.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/atmosphere/atmosphere.h"
#include "model/photometry/photometry.h"
#include "model/sky_model.h"

namespace skyfit {

inline constexpr std::array<double, 3> kSummaryWavelengths_nm = {450, 550, 650};

struct ConstituentSummary {
  std::string name;
  std::array<double, 3> optical_depth{};  // vertical, of extinction, at kSummaryWavelengths_nm
  // At 550 nm; none of one that does not scatter.
  std::optional<double> single_scattering_albedo, mean_cosine;
};

// Luminance (or illuminance) and CIE 1931 chromaticity.
struct PhotometricColor {
  double luminance = 0, x = 0, y = 0;
};

struct AtmosphereSummary {
  std::vector<ConstituentSummary> constituents;
  double visibility_m = 0;  // Koschmieder's 3.912 / extinction at 550 nm, 1 m above the ground
  // (tau_Rayleigh + tau_aerosol) / tau_Rayleigh at 550 nm; none where the molecules are
  // far fewer than the Earth's, of whose air turbidity speaks.
  std::optional<double> turbidity;
  // From the ground with the star 30 deg from the zenith: the sky at the zenith (cd/m^2) and the
  // star's beam at normal incidence (lx).
  PhotometricColor zenith, beam;
  // Physical, but hardly meant; one sentence each.
  std::vector<std::string> warnings;
};

// `spectra` are those under the atmosphere's star. Throws as `model` does.
AtmosphereSummary summary_of(const Atmosphere<double>& atmosphere, const SpectralData& spectra,
                             const SkyModel& model);

}  // namespace skyfit
