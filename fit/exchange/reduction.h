// SPDX-License-Identifier: Apache-2.0
// A preset's sky by an atmosphere of a simpler form, refitted, and what is lost.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/exchange/engine_form.h"
#include "model/sky_model.h"

namespace skyfit::fit {

// What the preset is, and what the program can do: nature's light is polarised, that of engines is
// not.
struct Models {
  const SkyModel& truth;
  const SkyModel& engine;
};

// CIE 1931, Y in cd/m^2.
using Xyz = std::array<double, 3>;

std::vector<Xyz> sky_colors(const SkyModel& model, const XyzRule& rule,
                            const Atmosphere<double>& atmosphere,
                            const std::vector<SkyPoint>& points);

// Of one of the irradiances at the rule's nodes, each times its factor; lx.
Xyz irradiance_color(const SkyValues& irradiance, Irradiance which, const XyzRule& rule,
                     const std::vector<double>& factors);

// How two skies differ, without directions within 3 deg of the sun.
struct SkyLoss {
  double rms_percent = 0;            // of ln of the luminances
  double worst_percent = 0;          // 100 ln, of the largest
  SkyPoint worst;                    // where it is
  double mean_uv = 0, worst_uv = 0;  // distance in CIE 1976 u', v'
};

// Of the colours of the same directions.
SkyLoss color_loss(const std::vector<SkyPoint>& points, const std::vector<Xyz>& truth,
                   const std::vector<Xyz>& approximate);

// Six suns 10 to 85 deg from the zenith, the 145 patches of Tregenza each.
std::vector<SkyPoint> six_skies();
inline constexpr std::string_view kSixSkies = "suns 10 to 85 deg from the zenith";

double angle_from_sun(const SkyPoint& point);  // radians

// One sun, 400 directions spread evenly over the hemisphere, a Fibonacci lattice.
std::vector<SkyPoint> lattice_sky(double sun_zenith);

inline constexpr std::string_view kLatticeSky = "400 directions of the sky of this sun";

// Of six_skies().
SkyLoss sky_loss(const Models& models, const SpectralData& spectra, const Atmosphere<double>& truth,
                 const Atmosphere<double>& approximate);

// "luminance RMS 1.2 %, worst +4.1 % (sun 85, view 84, azimuth 12 deg); ..; DIRECTIONS".
std::string loss_text(const SkyLoss& loss, std::string_view directions = kSixSkies);

// `start` with these parameters, as far as they lie within their bounds, refitted to the sky of
// `truth` at 680, 550 and 440 nm, all suns jointly, in logarithms without priors. Without a fit
// where the two skies already agree within 0.01 %. Throws std::runtime_error where the fit fails.
Atmosphere<double> refitted(const Models& models, const SpectralData& spectra,
                            const Atmosphere<double>& truth, const Atmosphere<double>& start,
                            const std::vector<Parameter>& free,
                            const std::function<void(double)>& progress);

}  // namespace skyfit::fit
