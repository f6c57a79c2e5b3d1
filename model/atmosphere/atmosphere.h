// SPDX-License-Identifier: Apache-2.0
// The atmosphere that skyfit fits: a spherical planet, its star, its ground, and a list of
// constituents (model/atmosphere/constituent.h), whose order does not matter. Lengths in metres.
// Source of the standard ones: Bruneton & Neyret 2008, section 2, with the aerosol's wavelength
// dependence of Angstrom and an ozone layer.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "model/atmosphere/constituent.h"
#include "model/atmosphere/ground_spectrum.h"
#include "model/atmosphere/star.h"

namespace skyfit {

inline constexpr std::size_t kMostConstituents = 8;

[[noreturn]] void fail_without_constituent(std::string_view name);

template <class T>
struct Atmosphere {
  double bottom_radius_m = 6360e3;
  double top_radius_m = 6460e3;
  std::vector<Constituent<T>> constituents = {standard_rayleigh<T>(), standard_mie<T>(),
                                              standard_ozone<T>()};
  T ground_albedo{0.1};                                             // Lambertian, at 550 nm
  std::shared_ptr<const GroundSpectrum> ground_spectrum = nullptr;  // null: grey
  bool sea = true;  // whether a renderer's made-up ground has seas, and plants on its land
  Star star;
  bool operator==(const Atmosphere&) const = default;

  // The constituent of that name; null where there is none.
  const Constituent<T>* find(std::string_view name) const {
    for (const Constituent<T>& c : constituents) {
      if (c.name == name) return &c;
    }
    return nullptr;
  }
  // Throws std::invalid_argument where there is none.
  const Constituent<T>& at(std::string_view name) const {
    if (const Constituent<T>* c = find(name)) return *c;
    fail_without_constituent(name);
  }
  Constituent<T>& at(std::string_view name) {
    return const_cast<Constituent<T>&>(std::as_const(*this).at(name));
  }
};

// The profile of a constituent that may be that of another: never kSameAs or kSquareOf.
template <class T>
VerticalProfile<T> own_profile(const Atmosphere<T>& atmosphere, const Constituent<T>& c) {
  if (c.profile.type != ProfileType::kSameAs && c.profile.type != ProfileType::kSquareOf)
    return c.profile;
  VerticalProfile<T> profile = atmosphere.at(c.profile.of).profile;
  if (c.profile.type == ProfileType::kSquareOf) profile.scale_height_m *= T(0.5);
  return profile;
}

// Throws std::invalid_argument with one line that names the preset path, the value and what was
// expected, when a parameter is not finite, not physical (negative coefficient, albedo outside
// 0..1, |g| >= 1, top <= bottom ...) or beyond what the solver can do, when names repeat or there
// are more than kMostConstituents.
void validate(const Atmosphere<double>& atmosphere);

}  // namespace skyfit
