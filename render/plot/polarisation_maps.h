// SPDX-License-Identifier: Apache-2.0
// Degree and angle of linear polarisation over the whole sky, seen from below: centre zenith, rim
// horizon, the sun's azimuth points right. Azimuths count counter-clockwise from above and hence
// clockwise on the page.
#pragma once

#include <array>
#include <vector>

#include "model/polarisation.h"
#include "render/plot/figure_file.h"

namespace skyfit::plot {

// Q / I and U / I on a grid of view zeniths 0 .. 89.9 deg and azimuths 0 .. 180 deg from the sun's,
// row major; NaN where there is no light. The other half of the sky has the same Q and -U.
struct PolarisedSky {
  static constexpr int kZeniths = 91, kAzimuths = 91;
  double sun_zenith = 0, wavelength_nm = 0;  // radians
  std::vector<std::array<double, 2>> q_u;
  std::vector<NeutralPoint> neutral_points;
};
// Throws as SkyModel::stokes() does.
PolarisedSky polarised_sky(const SkyModel& model, const Atmosphere<double>& atmosphere,
                           const WavelengthNode& wavelength, double altitude_m, double sun_zenith);

// Q / I and U / I of a direction, linear between those of the grid; azimuth from the sun's.
std::array<double, 2> polarisation_of(const PolarisedSky& sky, double view_zenith,
                                      double relative_azimuth);

// `angle`: the sense in which the angle counts in the second map. The panels are the two maps.
Figure polarisation_figure(const std::string& title, const PolarisedSky& sky,
                           PolarisationAngle angle, const Sheet& sheet = {});

}  // namespace skyfit::plot
