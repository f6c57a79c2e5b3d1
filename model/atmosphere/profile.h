// SPDX-License-Identifier: Apache-2.0
// How the density of a constituent depends on height: its value, its column along a ray, and both
// derived by the parameters that give the profile its shape. Heights and columns in metres.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "model/atmosphere/atmosphere.h"
#include "model/atmosphere/slant_column.h"
#include "model/numerics/dual.h"

namespace skyfit {

// A relative density and its derivatives by the shape (1/m), 0 where there are none.
struct Density {
  double value = 0;
  ByShape by_shape{};
};

class Profile {
 public:
  // Of a type that is not kSameAs or kSquareOf, see own_profile().
  explicit Profile(const VerticalProfile<double>& profile);

  // How many parameters the shape has: 1 of an exponential profile (the scale height), 2 of a layer
  // (base, top), 0 of the others.
  std::size_t shapes() const { return is_exponential() ? 1 : by_shape_.size(); }
  bool is_exponential() const { return table_ == nullptr; }
  double scale_height() const { return scale_height_; }   // of an exponential profile
  const LinearProfile& table() const { return *table_; }  // of one that is not
  // The derivative of the density by a shape parameter, of a profile that is not exponential.
  const LinearProfile& table_by_shape(std::size_t shape) const { return *by_shape_[shape]; }

  // The same shape by tables of its density and then of the derivatives; `moved` says where a
  // height goes.
  Profile with_tables(std::vector<LinearProfile> tables,
                      const std::function<double(double)>& moved) const;

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
  bool is_layer() const { return top_ > 0; }
  // A table that holds a cloud has quadrature and levels of a layer, from where a two-hundredth of
  // its column lies below to where as much lies above.
  void take_as_layer();
  double bulk_thickness() const;  // of a table, between those two heights
  // Heights near which a layer of that optical depth wants levels of the solver, ascending; empty
  // for other profiles. They lie on a lattice and do not follow base, top and depth continuously,
  // so that a derivative by these holds the levels fixed, as a small difference does.
  std::vector<double> level_heights(double optical_depth) const;

  friend bool operator==(const Profile& a, const Profile& b);  // by the numbers of their tables

 private:
  double scale_height_ = 1;
  TabulatedProfile table_;
  std::vector<TabulatedProfile> by_shape_;
  double base_ = 0, top_ = 0;  // of a layer
  double edge_ = 0;            // how far beyond them its density falls to 0
};

}  // namespace skyfit
