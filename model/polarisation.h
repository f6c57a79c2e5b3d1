// SPDX-License-Identifier: Apache-2.0
// Linear polarisation of the sky: its degree and angle, and where it vanishes. Stokes parameters
// and their reference plane are those of StokesValues (model/sky_model.h).
#pragma once

#include <string_view>
#include <vector>

#include "model/sky_model.h"

namespace skyfit {

// In which sense U and the angle of polarisation are counted, as the observer sees them: clockwise
// from up, or counter-clockwise as the International Astronomical Union counts.
enum class PolarisationAngle { kClockwise, kIau };
inline double sign_of_u(PolarisationAngle angle) {
  return angle == PolarisationAngle::kIau ? -1 : 1;
}

// Degree of linear polarisation, 0 .. 1, and its angle from the meridian plane in degrees, above
// -90 to 90, docs/theory (13.15); NaN without light, and the angle without polarisation.
struct LinearPolarisation {
  double degree, angle_deg;
};
LinearPolarisation linear_polarisation(double i, double q, double u);

// A direction of the sun's vertical circle whose light is not polarised.
enum class NeutralPointKind { kBabinet, kBrewster, kArago, kOther };
struct NeutralPoint {
  NeutralPointKind kind;
  double view_zenith;       // radians, 0 .. pi / 2
  double relative_azimuth;  // radians: 0 on the sun's side, else pi
  // Radians along the vertical circle: from the sun to Babinet's (above it), Brewster's (below it)
  // and other points, from the antisolar point up to Arago's.
  double distance;
};
std::string_view neutral_point_name(NeutralPointKind kind);  // "Babinet", .., "neutral point"

// The zeros of Q along the sun's vertical circle above the horizon (U is 0 there by symmetry),
// linear between directions every quarter degree; from the horizon below the sun to that opposite.
// Babinet's and Brewster's are the nearest to the sun within 90 deg, Arago's the nearest to the
// antisolar point. Throws as SkyModel::stokes() does.
std::vector<NeutralPoint> neutral_points(const SkyModel& model,
                                         const Atmosphere<double>& atmosphere,
                                         const WavelengthNode& wavelength, double altitude_m,
                                         double sun_zenith);

}  // namespace skyfit
