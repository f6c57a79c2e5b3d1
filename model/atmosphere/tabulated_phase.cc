// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/tabulated_phase.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "model/numerics/angles.h"
#include "model/numerics/gauss.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;

// 2 pi integral P(angle) P_l(cos angle) sin(angle) d angle of the piecewise exponential P.
std::vector<double> legendre_integrals(const std::vector<double>& angle,
                                       const std::vector<double>& log_phase, int count) {
  static const GaussRule kRule = gauss_legendre(8);
  std::vector<double> integral(static_cast<std::size_t>(count), 0.0);
  for (std::size_t i = 0; i + 1 < angle.size(); ++i) {
    const double length = angle[i + 1] - angle[i], rise = log_phase[i + 1] - log_phase[i];
    // At most a radian of the fastest polynomial and a factor of e^4 for the rule's 8 nodes.
    const double parts = std::ceil(std::max(length * count, std::abs(rise) / 4));
    for (double part = 0; part < parts; ++part) {
      for (std::size_t k = 0; k < kRule.node.size(); ++k) {
        const double share = (part + kRule.node[k]) / parts;
        const double theta = angle[i] + share * length, nu = std::cos(theta);
        const double weight = 2 * kPi * kRule.weight[k] * length / parts * std::sin(theta) *
                              std::exp(log_phase[i] + share * rise);
        double before = 0, legendre = 1;  // P_{l-1}, P_l by Bonnet's recursion
        for (int l = 0; l < count; ++l) {
          integral[static_cast<std::size_t>(l)] += weight * legendre;
          before = std::exchange(legendre, ((2 * l + 1) * nu * legendre - l * before) / (l + 1));
        }
      }
    }
  }
  return integral;
}

std::vector<double> radians(const std::vector<double>& degrees) {
  std::vector<double> result;
  for (const double angle : degrees) result.push_back(angle * kRadiansPerDegree);
  return result;
}

std::vector<double> logarithms(const std::vector<double>& values) {
  std::vector<double> result;
  for (const double value : values) result.push_back(std::log(value));
  return result;
}

std::optional<TableFault> phase_fault(const TwoColumns& table) {
  constexpr double kLargestCorrection = 0.05;
  if (auto fault = ascending_fault(kPhaseFormat, table, 0)) return fault;
  if (table.x.back() != 180) return TableFault{0, table.x.size() - 1, {}, "180, the last"};
  for (std::size_t i = 0; i < table.y.size(); ++i) {
    if (!(table.y[i] > 0) || !std::isfinite(table.y[i])) {
      return TableFault{1, i, {}, "a phase function > 0"};
    }
  }
  const double integral = legendre_integrals(radians(table.x), logarithms(table.y), 1).front();
  if (!(std::abs(integral - 1) <= kLargestCorrection)) {
    return TableFault{
        1, {}, fmt::format("integral over the sphere {:.6g}", integral), "1 within 5 %"};
  }
  return {};
}

}  // namespace

const TableFormat kPhaseFormat{{"scattering_angle_deg", "phase_per_sr"}, phase_fault};

TabulatedPhase::TabulatedPhase(TwoColumns table) : table_(std::move(table)) {
  expect_no_fault(kPhaseFormat, table_);
  angle_ = radians(table_.x);
  log_phase_ = logarithms(table_.y);
  const double excess = std::log(moments(1).front());
  for (double& value : log_phase_) value -= excess;
  last_moment_ = moments(kLastMoment + 1).back();
}

double TabulatedPhase::phase(double angle) const {
  const auto above = std::upper_bound(angle_.begin() + 1, angle_.end() - 1, angle);
  const auto i = static_cast<std::size_t>(above - angle_.begin());
  const double share = std::clamp((angle - angle_[i - 1]) / (angle_[i] - angle_[i - 1]), 0.0, 1.0);
  return std::exp(log_phase_[i - 1] + share * (log_phase_[i] - log_phase_[i - 1]));
}

std::vector<double> TabulatedPhase::moments(int count) const {
  return legendre_integrals(angle_, log_phase_, count);
}

SpectralPhase::SpectralPhase(std::vector<double> wavelengths_nm,
                             std::vector<std::shared_ptr<const TabulatedPhase>> phases)
    : wavelengths_nm_(std::move(wavelengths_nm)), phases_(std::move(phases)) {
  if (wavelengths_nm_.empty() || wavelengths_nm_.size() != phases_.size()) {
    throw std::invalid_argument(
        fmt::format("wavelength_nm: {} values: expected as many as phase "
                    "functions, {}, and at least 1",
                    wavelengths_nm_.size(), phases_.size()));
  }
  double before = 0;
  for (std::size_t i = 0; i < wavelengths_nm_.size(); ++i) {
    const double nm = wavelengths_nm_[i];
    if (!(nm > before) || !std::isfinite(nm)) {
      throw std::invalid_argument(
          fmt::format("wavelength_nm[{}] = {}: expected more than {} nm", i, nm, before));
    }
    before = nm;
  }
}

std::shared_ptr<const TabulatedPhase> SpectralPhase::at(double wavelength_nm) const {
  const auto above =
      std::upper_bound(wavelengths_nm_.begin(), wavelengths_nm_.end(), wavelength_nm);
  const auto i = static_cast<std::size_t>(above - wavelengths_nm_.begin());
  if (i == 0) return phases_.front();
  if (i == phases_.size() || wavelength_nm == wavelengths_nm_[i - 1]) return phases_[i - 1];
  const std::lock_guard lock(mutex_);
  auto& made = made_[wavelength_nm];
  if (made == nullptr) made = between(i, wavelength_nm);
  return made;
}

std::shared_ptr<const TabulatedPhase> SpectralPhase::between(std::size_t above,
                                                             double wavelength_nm) const {
  const TabulatedPhase &low = *phases_[above - 1], &high = *phases_[above];
  const double part = (wavelength_nm - wavelengths_nm_[above - 1]) /
                      (wavelengths_nm_[above] - wavelengths_nm_[above - 1]);
  TwoColumns mixed;
  std::ranges::set_union(low.table().x, high.table().x, std::back_inserter(mixed.x));
  for (const double degrees : mixed.x) {
    const double angle = degrees * kRadiansPerDegree;
    mixed.y.push_back(
        std::exp(std::lerp(std::log(low.phase(angle)), std::log(high.phase(angle)), part)));
  }
  // A geometric mean of two phase functions integrates to less than 1.
  const double integral = legendre_integrals(radians(mixed.x), logarithms(mixed.y), 1).front();
  for (double& value : mixed.y) value /= integral;
  return std::make_shared<const TabulatedPhase>(std::move(mixed));
}

}  // namespace skyfit
