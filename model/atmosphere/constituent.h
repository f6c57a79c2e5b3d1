// SPDX-License-Identifier: Apache-2.0
// One constituent of an atmosphere: molecules, an aerosol, a gas that absorbs. Its optical
// properties at wavelength lambda and height h are
//   extinction(h) = extinction(lambda) rho(h), scattering(h) = scattering(lambda) rho(h),
// with a relative density rho that the profile gives, 0 <= rho <= 1 for all kinds but tables.
// Lengths in metres, coefficients in 1/m, wavelengths in nm, heights from the bottom radius.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "model/atmosphere/corner_profiles.h"
#include "model/atmosphere/dry_air.h"
#include "model/atmosphere/linear_profile.h"
#include "model/atmosphere/size_distribution.h"
#include "model/atmosphere/spectrum_table.h"
#include "model/atmosphere/tabulated_phase.h"
#include "model/numerics/dual.h"

namespace skyfit {

// The first two numbers are those of lobe_phase() in model/shared/phase.glsl.
enum class PhaseType {
  kCornetteShanks = 0,
  kHenyeyGreenstein = 1,
  kTwoLobe = 2,
  kTabulated = 3,
  kRayleigh = 4,
  kByWavelength = 5,
  kSizeDistribution = 6,
};

// All forms integrate to 1 over the sphere, g > 0 scatters forward. kTwoLobe: weight P(g1) +
// (1 - weight) P(g2) with P of the type `lobe`.
template <class T>
struct PhaseFunction {
  PhaseType type = PhaseType::kCornetteShanks;
  T g{0.76};                                    // one lobe only
  T g1{0.8}, g2{0.3}, weight{0.5};              // two lobes only; weight is that of g1
  PhaseType lobe = PhaseType::kCornetteShanks;  // or kHenyeyGreenstein
  double depolarisation = 0;                    // kRayleigh: of natural light scattered at a
                                                // right angle; 0.0279 for dry air
  std::shared_ptr<const TabulatedPhase> table = nullptr;         // kTabulated only
  std::shared_ptr<const SpectralPhase> by_wavelength = nullptr;  // kByWavelength only
  SizeDistribution<T> particles{};                               // kSizeDistribution only,
  std::shared_ptr<const ParticleOptics> optics = nullptr;  // at one wavelength, see phase_at()
  bool operator==(const PhaseFunction&) const = default;
};

// Whether it is another at another wavelength.
constexpr bool depends_on_wavelength(PhaseType type) {
  return type == PhaseType::kByWavelength || type == PhaseType::kSizeDistribution;
}

// "one lobe", "two lobes", "a tabulated phase function", "particles of a size distribution" or
// "Rayleigh's phase function".
std::string_view phase_kind(PhaseType type);

enum class ProfileType {
  kExponential,  // exp(-h / scale_height)
  kCorners,      // linear between corners that numbers give, corner_profiles.h
  kLayer,        // 1 from base to top, with edges that are kLayerEdge of the thickness wide
  kTabulated,    // linear between heights, 0 above the last
  kSameAs,       // that of another constituent
  kSquareOf      // the square of that of another, which is exponential: of pairs of its molecules
};

// A layer's density rises from 0 to 1 linearly over this share of its thickness, centred at the
// base, and falls at the top in the same way: its column is top - base, and depends smoothly on
// both.
inline constexpr double kLayerEdge = 0.05;

using TabulatedProfile = std::shared_ptr<const LinearProfile>;

template <class T>
struct VerticalProfile {
  ProfileType type = ProfileType::kExponential;
  T scale_height_m{8000.0};          // kExponential
  T base_m{0.0}, top_m{1000.0};      // kLayer
  std::size_t corners = 0;           // kCorners: of corner_profiles(),
  ProfileNumbers numbers{};          // and its numbers
  TabulatedProfile table = nullptr;  // kTabulated
  std::string of{};                  // kSameAs, kSquareOf: a constituent with a profile of its own
  bool operator==(const VerticalProfile&) const = default;
};

template <class T>
void set_tent(double peak_m, double half_width_m, VerticalProfile<T>& profile) {
  profile.type = ProfileType::kCorners;
  profile.corners = corner_profile_named("tent");
  profile.numbers = {peak_m, half_width_m};
}

struct Tent {
  double peak_m, half_width_m;
};
template <class T>
std::optional<Tent> tent_of(const VerticalProfile<T>& profile) {
  if (profile.type != ProfileType::kCorners || profile.corners != corner_profile_named("tent"))
    return {};
  return Tent{profile.numbers[0], profile.numbers[1]};
}

// What the number `amount` of a constituent is.
enum class AmountType {
  kScattering,    // scattering coefficient where the density is 1, 1/m, at `wavelength_nm`
  kExtinction,    // extinction coefficient there, 1/m
  kOpticalDepth,  // vertical optical depth (of extinction), a pure number
  kColumn,        // vertical column of the absorber in Dobson units; its absorption is that of the
                  // tabulated cross section of model/photometry/photometry.h
  kAirPressure,   // pressure of dry air at the ground, hPa: its column scatters as in dry_air.h
  kOxygenPairs,   // pressure of dry air at the ground, hPa: the pairs of its oxygen molecules
                  // absorb (collision-induced), as many as dry_air.h says
  kVolume,        // volume of the particles above an area, um^3/um^2; they have a size distribution
};

// The gas of a column.
enum class Absorber { kOzone, kNitrogenDioxide };

// Whether the amount is stated at a wavelength and depends on it by an exponent or a table.
constexpr bool is_at_wavelength(AmountType type) {
  return type == AmountType::kScattering || type == AmountType::kExtinction ||
         type == AmountType::kOpticalDepth;
}

inline constexpr double kStandardPressureHpa = 1013.25;

template <class T>
struct Constituent {
  std::string name;
  AmountType amount_type = AmountType::kScattering;
  T amount{};
  double wavelength_nm = 550;  // of an amount that is_at_wavelength()
  // How coefficients depend on wavelength: (lambda / wavelength_nm)^-angstrom_exponent, or a table
  // over its value at wavelength_nm; neither of particles with a size distribution, whose
  // coefficients and single scattering albedo follow from it.
  T angstrom_exponent{};
  std::shared_ptr<const SpectrumTable> spectrum;
  // The coefficient is that of the standard pressure and goes as the pressure of the site.
  double site_pressure_hpa = kStandardPressureHpa;
  Absorber absorber = Absorber::kOzone;                  // kColumn only
  double temperature_k = 288.15;                         // kOxygenPairs only, at the ground
  double co2_ppm = 400;                                  // kAirPressure only, by volume
  T single_scattering_albedo{1.0};                       // scattering / extinction; 0: an absorber
  std::shared_ptr<const SpectrumTable> albedo_spectrum;  // in its place
  VerticalProfile<T> profile;
  PhaseFunction<T> phase;  // of one that scatters
  bool operator==(const Constituent&) const = default;
};

// The phase function of air that states its pressure: Rayleigh's with the depolarisation of King's
// factor at 550 nm, which the optical properties replace by that at their wavelength.
template <class T>
void set_king_depolarisation(Constituent<T>& c) {
  c.phase.type = PhaseType::kRayleigh;
  c.phase.depolarisation = king_depolarisation(550, c.co2_ppm);
}

// "rayleigh": dry air, 1.216e-5 / m at 550 nm with the exponent 4.08 and a scale height of 8 km.
template <class T>
Constituent<T> standard_rayleigh() {
  Constituent<T> c;
  c.name = "rayleigh";
  c.amount = T(1.216e-5);
  c.angstrom_exponent = T(4.08);
  c.phase.type = PhaseType::kRayleigh;
  return c;
}

// "rayleigh" of a measured sky: dry air of the standard pressure after Bodhaine et al. 1999.
template <class T>
Constituent<T> standard_air() {
  Constituent<T> c = standard_rayleigh<T>();
  c.amount_type = AmountType::kAirPressure;
  c.amount = T(kStandardPressureHpa);
  c.angstrom_exponent = T(0.0);
  set_king_depolarisation(c);
  return c;
}

// "mie": one lobe of aerosol with a scale height of 1.2 km (Bruneton & Neyret 2008).
template <class T>
Constituent<T> standard_mie() {
  Constituent<T> c;
  c.name = "mie";
  c.amount = T(2.2e-5);
  c.angstrom_exponent = T(1.3);
  c.single_scattering_albedo = T(0.9);
  c.profile.scale_height_m = T(1200.0);
  return c;
}

// "ozone": 300 DU in a tent of 10 to 40 km.
template <class T>
Constituent<T> standard_ozone() {
  Constituent<T> c;
  c.name = "ozone";
  c.amount_type = AmountType::kColumn;
  c.amount = T(300.0);
  c.single_scattering_albedo = T(0.0);
  set_tent(25e3, 15e3, c.profile);
  return c;
}

// "oxygen_pairs": the collision-induced absorption of O2-O2 in air of the standard pressure and
// temperature, with the square of the density of the air.
template <class T>
Constituent<T> standard_oxygen_pairs() {
  Constituent<T> c;
  c.name = "oxygen_pairs";
  c.amount_type = AmountType::kOxygenPairs;
  c.amount = T(kStandardPressureHpa);
  c.single_scattering_albedo = T(0.0);
  c.profile.type = ProfileType::kSquareOf;
  c.profile.of = "rayleigh";
  return c;
}

// "nitrogen_dioxide": 0.2 DU (5.4e15 molecules per cm^2), half as much above clean places and more
// above towns, in the tent of the ozone: most of it is in the stratosphere there.
template <class T>
Constituent<T> standard_nitrogen_dioxide() {
  Constituent<T> c = standard_ozone<T>();
  c.name = "nitrogen_dioxide";
  c.absorber = Absorber::kNitrogenDioxide;
  c.amount = T(0.2);
  c.profile = {};
  c.profile.type = ProfileType::kSameAs;
  c.profile.of = "ozone";
  return c;
}

// Whether any of its extinction is scattering.
template <class T>
bool scatters(const Constituent<T>& c) {
  return c.amount_type != AmountType::kColumn && c.amount_type != AmountType::kOxygenPairs &&
         (c.albedo_spectrum || value_of(c.single_scattering_albedo) > 0);
}

}  // namespace skyfit
