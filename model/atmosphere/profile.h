// SPDX-License-Identifier: Apache-2.0
// How the density of a species falls with height: its value, its column along a ray, and both
// derived by the scale height where there is one. Heights and columns in metres.
#pragma once

#include <utility>
#include <vector>

#include "model/atmosphere/atmosphere.h"
#include "model/atmosphere/slant_column.h"
#include "model/numerics/dual.h"

namespace skyfit {

// A relative density and its derivative by the scale height (1/m), 0 where there is none.
struct Density {
  double value = 0;
  double by_scale_height = 0;
};

class Profile {
 public:
  Profile() = default;
  // exp(-h / H)
  explicit Profile(double scale_height) : scale_height_(scale_height) {}
  // Linear between corners.
  explicit Profile(TabulatedProfile table) : table_(std::move(table)) {}

  bool is_exponential() const { return table_ == nullptr; }
  double scale_height() const { return scale_height_; }   // of an exponential profile
  const LinearProfile& table() const { return *table_; }  // of one that is not
  Density density(double height) const;
  // The same at a level of a grid between its neighbours `low` and `high`: the value of a table is
  // its mean about the level, so that no layer falls between two levels.
  Density density_at_level(double low, double height, double high) const;
  // From a point upward to height `top`; mu as for exponential_column().
  Column column_to_top(double bottom_radius, double height, double mu, double top) const;
  Column vertical_column() const;  // from the ground to infinity

  // Ascending heights that divide the profile for a quadrature: the same shares of the column lie
  // above them for every profile, and empty layers end at them.
  std::vector<double> quadrature_heights() const;

  friend bool operator==(const Profile&, const Profile&) = default;

 private:
  double scale_height_ = 1;
  TabulatedProfile table_;
};

// Of all species. Ozone is either linear or has the profile of the air and its scale height.
struct Profiles {
  Profile air, aerosol, ozone;
};

// 0 at 10 km, 1 at 25 km, 0 at 40 km.
TabulatedProfile ozone_tent();

template <class T>
Profiles profiles_of(const Atmosphere<T>& a) {
  const auto profile = [](const auto& species) {
    return species.profile ? Profile(species.profile) : Profile(value_of(species.scale_height_m));
  };
  const Profile air = profile(a.rayleigh);
  const bool follows_air = a.ozone.profile == OzoneProfile::kExponential;
  return {air, profile(a.mie),
          follows_air ? air : Profile(a.ozone.table ? a.ozone.table : ozone_tent())};
}

}  // namespace skyfit
