// SPDX-License-Identifier: Apache-2.0
// Descriptions of atmospheres for CalcMySky (10110111/CalcMySky, doc/model_generation.md and
// common/AtmosphereParameters.cpp), whose models Stellarium shows: `key: value` lines, sections in
// braces, GLSL between lines of three backticks. Spectra belong to 16 wavelengths; a scatterer has
// a power law and one phase function, an absorber a spectrum. Number densities, 1/m^3, are those of
// particles whose cross section is 1 um^2 at 1 um (scatterers) or that of the list (absorbers).
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "fit/exchange/programs.h"

namespace skyfit::fit::calcmysky {

inline constexpr double kSunRadius_m = 696350e3, kAu_m = 149597870700;  // common/const.hpp
// Of the absorber that goes with a scatterer.
inline constexpr std::string_view kAbsorption = "_abs";

// The lines of a code block.
using Code = std::vector<std::string>;

// Lines by which a file that skyfit wrote is known: of Rayleigh's phase function, of the angle of a
// tabulated one, and of lobes.
inline constexpr std::string_view kRayleighLine =
    "return vec4(3.0/(8.0*PI)/(2.0+rho)*(1.0+rho+(1.0-rho)*sqr(dotViewSun)));";
inline constexpr std::string_view kAngleLine =
    "float angle=degrees(acos(clamp(dotViewSun,-1.0,1.0)));";
inline constexpr std::array kLobes = {PhaseType::kHenyeyGreenstein, PhaseType::kCornetteShanks};
std::string one_lobe(PhaseType type);
std::string two_lobes(PhaseType type);

// The file, with its loss in words.
std::string atmo_text(const ExportRequest& request, std::string_view loss);

}  // namespace skyfit::fit::calcmysky
