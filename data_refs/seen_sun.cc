// SPDX-License-Identifier: Apache-2.0
#include "data_refs/seen_sun.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kTerms = 9;
using Terms = Eigen::Matrix<double, kTerms, 1>;

struct Direction {
  double zenith, azimuth, log_value;
};

struct Place {
  double zenith, azimuth;
};

double angle_between(const Place& a, double zenith, double azimuth) {
  const double cosine = std::cos(a.zenith) * std::cos(zenith) +
                        std::sin(a.zenith) * std::sin(zenith) * std::cos(azimuth - a.azimuth);
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

// At the wavelength with the most directions, of these the longest: where the sun's aureole stands
// out most.
std::vector<Direction> directions_of(std::span<const Sample> scan) {
  std::map<double, int> count;
  for (const Sample& s : scan) {
    if (s.weight > 0) ++count[s.wavelength_nm];
  }
  double wavelength = 0;
  int most = 0;
  for (const auto& [nm, directions] : count) {
    if (directions < most) continue;
    wavelength = nm;
    most = directions;
  }
  std::vector<Direction> directions;
  for (const Sample& s : scan) {
    if (s.weight > 0 && s.wavelength_nm == wavelength)
      directions.push_back({s.view_zenith, s.relative_azimuth, std::log(s.value)});
  }
  return directions;
}

// Without what stands dark before the sky, houses and trees: less than a quarter of the median
// about the same zenith angle.
std::vector<Direction> without_obstacles(const std::vector<Direction>& directions) {
  constexpr double kRing = 4 * kRadiansPerDegree;
  const double darkest = std::log(0.25);
  std::vector<Direction> clear;
  for (const Direction& d : directions) {
    std::vector<double> ring;
    for (const Direction& other : directions) {
      if (std::abs(other.zenith - d.zenith) < kRing) ring.push_back(other.log_value);
    }
    const auto middle = ring.begin() + static_cast<std::ptrdiff_t>(ring.size() / 2);
    std::ranges::nth_element(ring, middle);
    if (d.log_value - *middle > darkest) clear.push_back(d);
  }
  return clear;
}

bool surround_the_sky(const std::vector<Direction>& directions) {
  constexpr std::size_t kFewest = 24;
  constexpr double kWidestGap = 100 * kRadiansPerDegree, kLeastRange = 30 * kRadiansPerDegree;
  if (directions.size() < kFewest) return false;
  const auto [low, high] = std::ranges::minmax_element(directions, {}, &Direction::zenith);
  if (high->zenith - low->zenith < kLeastRange) return false;
  std::set<double> azimuths;
  for (const Direction& d : directions) azimuths.insert(std::remainder(d.azimuth, kTurn));
  double before = *azimuths.rbegin() - kTurn, gap = 0;
  for (const double azimuth : azimuths) {
    gap = std::max(gap, azimuth - before);
    before = azimuth;
  }
  return gap < kWidestGap;
}

class Misfit {
 public:
  explicit Misfit(std::vector<Direction> directions) : directions_(std::move(directions)) {}

  std::size_t freedom() const { return directions_.size() - kTerms - 2; }

  // Root mean square with the sun there.
  double operator()(const Place& sun) const {
    Eigen::Matrix<double, kTerms, kTerms> normal = Eigen::Matrix<double, kTerms, kTerms>::Zero();
    Terms right = Terms::Zero();
    double squares = 0;
    for (const Direction& d : directions_) {
      const Terms terms = terms_of(d, sun);
      normal.selfadjointView<Eigen::Lower>().rankUpdate(terms);
      right += d.log_value * terms;
      squares += d.log_value * d.log_value;
    }
    constexpr double kRidge = 1e-9;  // two terms may be the same in few zenith angles
    normal.diagonal() *= 1 + kRidge;
    const Terms solution = normal.selfadjointView<Eigen::Lower>().ldlt().solve(right);
    return std::sqrt(std::max(squares - right.dot(solution), 1e-12) /
                     static_cast<double>(directions_.size()));
  }

 private:
  static Terms terms_of(const Direction& d, const Place& sun) {
    const double cosine = std::cos(d.zenith), angle = angle_between(sun, d.zenith, d.azimuth);
    const double nu = std::cos(angle);
    Terms terms;
    terms << 1, cosine, cosine * cosine, 1 / (cosine + 0.1), nu, nu * nu, std::exp(-1.5 * angle),
        std::exp(-4 * angle), std::exp(-12 * angle);
    return terms;
  }

  std::vector<Direction> directions_;
};

// Coarse grid, then steps that halve.
Place best_place(const Misfit& misfit) {
  constexpr double kStep = 6 * kRadiansPerDegree, kFinest = 0.02 * kRadiansPerDegree;
  Place best{0, 0};
  double least = misfit(best);
  const auto attempt = [&](const Place& place) {
    if (place.zenith > kTurn / 4) return false;
    const double value = misfit(place);
    if (value >= least) return false;
    least = value;
    best = place;
    return true;
  };
  for (double zenith = kStep; zenith <= kTurn / 4; zenith += kStep) {
    const int count = static_cast<int>(std::ceil(kTurn * std::sin(zenith) / kStep));
    for (int i = 0; i < count; ++i) attempt({zenith, kTurn * i / count});
  }
  for (double step = 0.5 * kStep; step > kFinest; step *= 0.5) {
    for (bool moved = true; moved;) {
      const Place from = best;
      const double turn = step / std::max(std::sin(from.zenith), 0.05);
      moved = false;
      for (const auto& [up, aside] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
        moved |= attempt({std::abs(from.zenith + up * step), from.azimuth + aside * turn});
    }
  }
  return best;
}

// The weaker of two directions across each other.
double sigma_at(const Misfit& misfit, const Place& best, double least) {
  constexpr double kApart = 2 * kRadiansPerDegree;
  const double turn = kApart / std::max(std::sin(best.zenith), 0.05);
  double sharpness = 1e300;
  for (const auto& [up, aside] : {std::pair{1, 0}, {0, 1}}) {
    const double before =
                     misfit({std::abs(best.zenith - up * kApart), best.azimuth - aside * turn}),
                 after = misfit({best.zenith + up * kApart, best.azimuth + aside * turn});
    sharpness = std::min(sharpness, 0.5 * (before * before + after * after) / (least * least) - 1);
  }
  const double variance =
      kApart * kApart / (std::max(sharpness, 1e-9) * static_cast<double>(misfit.freedom()));
  return std::sqrt(variance);
}

}  // namespace

std::optional<SeenSun> seen_sun(std::span<const Sample> scan) {
  const std::vector<Direction> directions = without_obstacles(directions_of(scan));
  if (!surround_the_sky(directions)) return {};
  const double stated = scan.front().sun_zenith;
  if (std::ranges::any_of(scan, [&](const Sample& s) { return s.sun_zenith != stated; })) return {};
  const Misfit misfit(directions);
  const Place best = best_place(misfit);
  SeenSun seen{best.zenith, std::remainder(best.azimuth, kTurn)};
  seen.misfit = misfit(best);
  seen.stated_misfit = misfit({stated, 0});
  seen.sigma = sigma_at(misfit, best, seen.misfit);
  const auto brightest = std::ranges::max_element(directions, {}, &Direction::log_value);
  seen.brightest = angle_between({stated, 0}, brightest->zenith, brightest->azimuth);
  return seen;
}

double seen_from_stated(const SeenSun& seen, double stated_zenith) {
  return angle_between({stated_zenith, 0}, seen.zenith, seen.relative_azimuth);
}

}  // namespace skyfit::refs
