// SPDX-License-Identifier: Apache-2.0
// The spherical shells of an atmosphere and the profiles in them, without coefficients: what
// columns along rays need. Lengths in metres.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/atmosphere/parameters.h"
#include "model/atmosphere/profile.h"
#include "model/geometry/ray.h"

namespace skyfit {

// Columns from one point to another, in metres of density 1: one for each profile of the shells.
class PathColumns {
 public:
  std::size_t size() const { return size_; }
  void push_back(const Column& column) { columns_[size_++] = column; }
  const Column& operator[](std::size_t profile) const { return columns_[profile]; }

  PathColumns& operator+=(const PathColumns& o) { return add(o, 1); }
  PathColumns& operator-=(const PathColumns& o) { return add(o, -1); }
  PathColumns operator-() const { return PathColumns{} -= *this; }

 private:
  PathColumns& add(const PathColumns& o, double factor) {
    size_ = std::max(size_, o.size_);
    for (std::size_t i = 0; i < o.size_; ++i) {
      columns_[i].value += factor * o.columns_[i].value;
      for (std::size_t s = 0; s < kMostShapes; ++s)
        columns_[i].by_shape[s] += factor * o.columns_[i].by_shape[s];
    }
    return *this;
  }

  std::size_t size_ = 0;
  std::array<Column, kMostConstituents> columns_{};
};

struct Shells {
  static constexpr int kNone = -1;

  double bottom_radius, top;  // top is a height
  double sun_radius;          // of the star's disc, rad
  std::vector<Profile> profiles;
  std::vector<char> breaks;  // per profile: whether quadratures along a ray begin anew at it
  // Per profile, at 550 nm: vertical optical depth of all layers that are like it, or, of one that
  // is no layer, the scattering part of that; the other is 0.
  std::vector<double> layer_depth, bulk_depth;
  // Per constituent of the atmosphere: which of the profiles is its own, or kNone of one that is
  // left out because it neither weakens light nor is differentiated by its amount.
  std::vector<int> profile_of;

  // From a point at height h upward to the top; mu < 0 passes the tangent point.
  PathColumns columns_to_top(double height, double mu) const;
};

// Which constituents stay: those with an amount or a derivative by one of the parameters, those
// that scatter, or every one. Throws nothing for an atmosphere that validate() accepts.
enum class Keep { kWhatMatters, kScatterers, kAll };
Shells shells_of(const Atmosphere<double>& atmosphere, Keep keep,
                 std::span<const Parameter> derivatives = {});

// Columns from the ray's entry to the point.
PathColumns columns_along(const Shells& shells, const ViewRay& ray, const RayPoint& point);

// The breaks of a quadrature along the ray and besides those that scatterers and layers want whose
// profiles are not exponential, see Profile::quadrature_heights(); ascending.
std::vector<double> with_profile_breaks(const Shells& shells, const ViewRay& ray,
                                        std::vector<double> breaks);

}  // namespace skyfit
