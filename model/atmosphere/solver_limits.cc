// SPDX-License-Identifier: Apache-2.0
// Found by trying atmospheres without absorption over a black ground: light on the ground must not
// exceed the sun's, and must not be negative.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "model/atmosphere/optics.h"
#include "model/atmosphere/parameter_field.h"
#include "model/atmosphere/profile.h"
#include "model/atmosphere/validation.h"

namespace skyfit {
namespace {

constexpr double kWavelengths[] = {400, 550, 700};  // nm, at which depths are looked at
constexpr double kGreen = 550;                      // nm

// From this top height over radius on few rays of the diffuse field lie between the horizon and the
// limb. Their quadrature of scattering gains light, the more the oftener light is scattered: with
// top height x radii optical depths beyond some 1 / x^2 come out too bright, then negative.
constexpr double kThickPlanet = 0.03;

// A lobe narrower than this is lost between the directions of the diffuse field: 1.4 times the
// sun's light came through an optical depth of 10 with g = 0.99. What is scattered once at most is
// right.
constexpr double kNarrowest = 0.98, kNarrowestOnThickPlanet = 0.95, kThinDepth = 0.3;

double highest_density(const VerticalProfile<double>& profile) {
  return profile.type == ProfileType::kTabulated ? std::ranges::max(profile.table->densities()) : 1;
}

// The greatest g of a phase function; of a table the one whose lobe cut off as coarsely.
double narrowest_lobe(const PhaseFunction<double>& phase) {
  const auto of_table = [](const TabulatedPhase& table) {
    return std::pow(std::max(table.last_moment(), 0.0), 1.0 / TabulatedPhase::kLastMoment);
  };
  switch (phase.type) {
    case PhaseType::kRayleigh:
      return 0;
    case PhaseType::kTwoLobe:
      return std::max(phase.g1, phase.g2);
    case PhaseType::kTabulated:
      return of_table(*phase.table);
    case PhaseType::kSizeDistribution: {
      const double last =
          optics_at(phase.particles, kGreen)->moment(TabulatedPhase::kLastMoment)[0];
      return std::pow(std::max(last, 0.0), 1.0 / TabulatedPhase::kLastMoment);
    }
    case PhaseType::kByWavelength: {
      double g = 0;
      for (const auto& table : phase.by_wavelength->phases()) g = std::max(g, of_table(*table));
      return g;
    }
    default:
      return phase.g;
  }
}

void validate_lobe(const Constituent<double>& c, double depth, double thickness) {
  if (depth <= kThinDepth || !scatters(c)) return;
  const double g = narrowest_lobe(c.phase);
  const double most = thickness > kThickPlanet ? kNarrowestOnThickPlanet : kNarrowest;
  expect(
      g <= most, c.name + ".phase", g,
      fmt::format("no lobe narrower than that of g = {} where the vertical optical depth is above "
                  "{}: it is {:.4g}",
                  most, kThinDepth, depth));
}

}  // namespace

void validate_solver_limits(const Atmosphere<double>& a) {
  const double thickness = a.top_radius_m / a.bottom_radius_m - 1;
  for (const double nm : kWavelengths) {
    double scattered = 0;
    for (const Constituent<double>& c : a.constituents) {
      const VerticalProfile<double> profile = own_profile(a, c);
      const double column = Profile(profile).vertical_column().value;
      // Particles are as thick at the others within a factor of some; each wavelength has a table.
      const double of_limit = c.phase.type == PhaseType::kSizeDistribution ? kGreen : nm;
      const Coefficients<0> k =
          coefficients_at<0>(with_scalar<Dual<0>>(c), Dual<0>(column), {of_limit, 0, 0, 0});
      const std::string path = c.name + "." + std::string(amount_path(c.amount_type));
      const double coefficient = k.extinction.v * highest_density(profile);
      expect(coefficient <= kMostCoefficient, path, c.amount,
             fmt::format("an extinction coefficient of at most {} 1/m: it reaches {:.4g} at {} nm",
                         kMostCoefficient, coefficient, nm));
      const double depth = k.extinction.v * column;
      expect(depth <= kMostDepth, path, c.amount,
             fmt::format("a vertical optical depth of at most {}: it is {:.4g} at {} nm",
                         kMostDepth, depth, nm));
      scattered += k.scattering.v * column;
      validate_lobe(c, depth, thickness);
    }
    if (thickness <= kThickPlanet) continue;
    const double most = 1 / (thickness * thickness);
    expect(scattered <= most, "planet.top_radius_m", a.top_radius_m,
           fmt::format("a lower top, or a vertical optical depth of scattering of at most {:.4g} "
                       "under this one: it is {:.4g} at {} nm",
                       most, scattered, nm));
  }
}

}  // namespace skyfit
