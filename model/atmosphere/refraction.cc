// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/refraction.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "model/atmosphere/column_kernels.h"
#include "model/atmosphere/dry_air.h"
#include "model/numerics/lagrange.h"

namespace skyfit {
namespace {

constexpr int kTableHeights = 40, kTableCosines = 64;

// Of 0 .. top: a profile of scale height H that is linear between them has columns that are off by
// a twelfth of the square of step over H, 0.02 % of an aerosol of 1200 m.
std::vector<double> profile_heights(double top) {
  constexpr double kFirst = 20, kGrowth = 0.025;  // m, share of the height
  std::vector<double> heights = {0};
  while (heights.back() < top)
    heights.push_back(std::min(heights.back() + kFirst + kGrowth * heights.back(), top));
  return heights;
}

// Of 0 .. top, dense at the ground.
std::vector<double> cubic_heights(double top, int count) {
  std::vector<double> heights;
  for (int i = 0; i < count; ++i) {
    const double x = static_cast<double>(i) / (count - 1);
    heights.push_back(top * x * x * x);
  }
  return heights;
}

// Where `x` lies among ascending nodes: the first of the four nearest, and their weights.
struct Four {
  std::size_t first;
  double share[4];
};
Four four_around(const std::vector<double>& nodes, double x) {
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), x) - nodes.begin();
  Four four{
      static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 2, 0, std::ssize(nodes) - 4)),
      {}};
  lagrange_weights(&nodes[four.first], 4, x, four.share);
  return four;
}

// Pressure over the standard one, to which refractivity is proportional.
double relative_pressure(const Constituent<double>& air) {
  const double hpa =
      air.amount_type == AmountType::kAirPressure ? air.amount : air.site_pressure_hpa;
  return hpa / kStandardPressureHpa;
}

}  // namespace

Refraction::Refraction(const Atmosphere<double>& atmosphere, double wavelength_nm)
    : bottom_radius_(atmosphere.bottom_radius_m),
      top_(atmosphere.top_radius_m - atmosphere.bottom_radius_m),
      refractive_radius_(bottom_radius_),
      heights_(profile_heights(top_)) {
  const auto air = std::ranges::find_if(atmosphere.constituents, [](const auto& c) {
    return c.amount_type == AmountType::kAirPressure ||
           (scatters(c) && c.phase.type == PhaseType::kRayleigh);
  });
  if (air != atmosphere.constituents.end()) {
    refractivity_ =
        (refractive_index_of_air(wavelength_nm, air->co2_ppm) - 1) * relative_pressure(*air);
    air_.emplace_back(own_profile(atmosphere, *air));
  }
  refractive_radius_ = bottom_radius_ * (1 + air_at(0).density);
  for (const double height : heights_) {
    if (!(stretch(height) > 0))
      throw std::invalid_argument(
          "refraction: the air turns rays more than the planet is curved: expected thinner air or "
          "a "
          "smaller planet");
    refractive_heights_.push_back(refractive_height(height));
    indices_.push_back(1 + air_at(height).density);
  }
  tabulate();
}

Refraction::Air Refraction::air_at(double height) const {
  if (air_.empty()) return {0, 0};
  const Profile& profile = air_.front();
  if (profile.is_exponential()) {
    const double density = refractivity_ * profile.density(height).value;
    return {density, -density / profile.scale_height()};
  }
  constexpr double kStep = 50;
  const double low = std::max(height - kStep, 0.0), high = std::min(height + kStep, top_);
  return {
      refractivity_ * profile.density(height).value,
      refractivity_ * (profile.density(high).value - profile.density(low).value) / (high - low)};
}

Refraction::NearGround Refraction::near_ground() const {
  const Air air = air_at(0);
  if (!(air.density > 0) || !(air.slope < 0)) return {0, 1};
  return {air.density, -air.density / air.slope};
}

// docs/theory (14.2).
double Refraction::stretch(double height) const {
  const Air air = air_at(height);
  return 1 + air.density + (bottom_radius_ + height) * air.slope;
}

double Refraction::refractive_height(double height) const {
  if (height > top_) return height - (refractive_radius_ - bottom_radius_);
  return (bottom_radius_ + height) * (1 + air_at(height).density) - refractive_radius_;
}

// docs/theory (14.3).
LinearProfile Refraction::refracted(const LinearProfile& profile) const {
  TwoColumns table;
  const auto add = [&](double height, double density) {
    table.x.push_back(refractive_height(height));
    table.y.push_back(density / stretch(std::min(height, top_)));
  };
  const std::vector<double>& corners = profile.heights();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    add(corners[i], profile.densities()[i]);
    if (i + 1 == corners.size()) break;
    auto inside = std::upper_bound(heights_.begin(), heights_.end(), corners[i]);
    for (; inside != heights_.end() && *inside < corners[i + 1]; ++inside)
      add(*inside, profile.density_in(i, *inside));
  }
  return LinearProfile::of_any_sign(std::move(table));
}

Shells Refraction::refracted(const Shells& shells) const {
  Shells result = shells;
  result.bottom_radius = refractive_radius_;
  result.top = refractive_height(top_);
  for (Profile& profile : result.profiles) {
    std::vector<LinearProfile> tables;
    for (std::size_t s = 0; s <= profile.shapes(); ++s) {
      if (profile.is_exponential()) {
        TwoColumns table{heights_, {}};
        for (const double height : heights_) {
          const Density density = profile.density(height);
          table.y.push_back(s == 0 ? density.value : density.by_shape[s - 1]);
        }
        tables.push_back(refracted(LinearProfile::of_any_sign(std::move(table))));
      } else {
        tables.push_back(refracted(s == 0 ? profile.table() : profile.table_by_shape(s - 1)));
      }
    }
    profile = profile.with_tables(std::move(tables),
                                  [this](double height) { return refractive_height(height); });
  }
  return result;
}

// docs/theory (14.5).
// The bending is a column: x sin z times the slant column of -(d ln n / dx) / x.
void Refraction::tabulate() {
  TwoColumns turning;
  for (const double height : heights_) {
    const Air air = air_at(height);
    const double n = 1 + air.density;
    turning.x.push_back(refractive_height(height));
    turning.y.push_back(-air.slope / (n * stretch(height) * n * (bottom_radius_ + height)));
  }
  const double top = turning.x.back();
  const LinearProfile profile = LinearProfile::of_any_sign(std::move(turning));
  table_heights_ = cubic_heights(top, kTableHeights);
  for (int k = 0; k < kTableCosines; ++k) {
    const double root = static_cast<double>(k) / (kTableCosines - 1);
    table_cosines_.push_back(root * root);
  }
  for (const double height : table_heights_) {
    const std::vector<double> at(table_cosines_.size(), height);
    std::vector<double> column(at.size());
    kernels::linear_columns({refractive_radius_, top}, profile, at.size(), at.data(),
                            table_cosines_.data(), column.data());
    for (const double turned : column) table_.push_back((refractive_radius_ + height) * turned);
  }
}

double Refraction::bending(double height, double zenith) const {
  if (height >= table_heights_.back() && zenith <= std::numbers::pi / 2) return 0;
  const double cosine = std::cos(zenith);
  if (cosine < 0) {
    // Over the tangent point, and on to the point from the other side.
    const double lowest = (refractive_radius_ + height) * std::sin(zenith) - refractive_radius_;
    const double right = 0.5 * std::numbers::pi;
    return 2 * bending(std::max(lowest, 0.0), right) - bending(height, std::numbers::pi - zenith);
  }
  const Four h = four_around(table_heights_, std::min(height, table_heights_.back())),
             c = four_around(table_cosines_, cosine);
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 4; ++k)
      sum += h.share[i] * c.share[k] * table_[(h.first + i) * table_cosines_.size() + c.first + k];
  }
  return std::max(sum, 0.0) * std::sin(zenith);
}

double Refraction::refractive_index(double height) const {
  if (height >= refractive_heights_.back()) return 1;
  const Four h = four_around(refractive_heights_, height);
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += h.share[i] * indices_[h.first + i];
  return sum;
}

// docs/theory (14.6).
double Refraction::apparent_zenith(double height, double true_zenith) const {
  constexpr int kMostSteps = 50;
  constexpr double kExact = 1e-11;  // radians
  // The bending grows with the zenith angle, on the limb of the planet faster than the angle
  // itself, so that the root lies between these two. By the regula falsi, with the weight of an end
  // that stays halved (Illinois).
  double high = true_zenith, above = bending(height, high), low = std::max(high - above, 0.0),
         below = low + bending(height, low) - true_zenith;
  for (int k = 0; k < kMostSteps && above > kExact && below < -kExact; ++k) {
    const double between = high - above * (high - low) / (above - below),
                 off = between + bending(height, between) - true_zenith;
    if (std::abs(off) < kExact) return between;
    if (off > 0) {
      high = between;
      above = off;
      below *= 0.5;
    } else {
      low = between;
      below = off;
      above *= 0.5;
    }
  }
  return above < -below ? high : low;
}

// docs/theory (14.7).
double Refraction::beam_spread(double height, double apparent) const {
  constexpr double kStep = 1e-3;
  const double low = std::max(apparent - kStep, 0.0), high = apparent + kStep;
  const double slope = (bending(height, high) - bending(height, low)) / (high - low);
  const double true_zenith = apparent + bending(height, apparent);
  const double sines =
      apparent < kStep ? 1 / (1 + slope) : std::sin(apparent) / std::sin(true_zenith);
  return sines / (1 + slope);
}

}  // namespace skyfit
