// SPDX-License-Identifier: Apache-2.0
// Which suns are coupled, and how: see diffuse_field.h and HorizontalCoupling.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/numerics/angles.h"
#include "model/solver/diffuse_field.h"

namespace skyfit {
namespace {

using OfModes = std::vector<double>;

// cos and sin of m phi.
struct Waves {
  OfModes cosine, sine;
};
Waves waves(double phi, std::size_t modes) {
  Waves w{OfModes(modes), OfModes(modes)};
  for (std::size_t m = 0; m < modes; ++m) {
    w.cosine[m] = std::cos(static_cast<double>(m) * phi);
    w.sine[m] = std::sin(static_cast<double>(m) * phi);
  }
  return w;
}

// docs/theory (7.7): for one layer and ray, the modes of one sun's light. [from sun][m][from mode]
struct Shift {
  std::vector<std::vector<OfModes>> cosine, sine;
};
Shift shift_of(const SunGrid& grid, const std::vector<int>& solved, std::size_t suns,
               double sun_zenith, double psi, double highest_mu, std::size_t modes) {
  constexpr std::size_t kBeside = 5;  // modes on either side that a mode's light goes to
  // The products of two modes are summed exactly.
  const int azimuths = 2 * static_cast<int>(modes) + 4;
  const std::vector<OfModes> none(modes, OfModes(modes));
  Shift shift{{suns, none}, {suns, none}};
  const double mu = std::cos(sun_zenith), s = std::sin(sun_zenith);
  for (int k = 0; k < azimuths; ++k) {
    const double phi = std::numbers::pi * (k + 0.5) / azimuths;
    const Waves here = waves(phi, modes),
                far = waves(std::atan2(s * std::sin(phi),
                                       s * std::cos(phi) * std::cos(psi) - mu * std::sin(psi)),
                            modes);
    const SunStencil stencil =
        grid.stencil(std::min(mu * std::cos(psi) + s * std::sin(psi) * std::cos(phi), highest_mu));
    for (std::size_t q = 0; q < stencil.index.size(); ++q) {
      const auto sun = static_cast<std::size_t>(solved[static_cast<std::size_t>(stencil.index[q])]);
      for (std::size_t from = 0; from < modes; ++from) {
        const double weight = (from % 2 == 0 ? stencil.even[q] : stencil.odd[q]) / azimuths,
                     cosine = weight * (from == 0 ? 1 : 2) * far.cosine[from],
                     sine = weight * 2 * far.sine[from];
        const std::size_t first = from < kBeside ? 0 : from - kBeside,
                          end = std::min(from + kBeside + 1, modes);
        for (std::size_t m = first; m < end; ++m) {
          shift.cosine[sun][m][from] += cosine * here.cosine[m];
          shift.sine[sun][m][from] += sine * here.sine[m];
        }
      }
    }
  }
  return shift;
}

void set_shares(const SunGrid& grid, const std::vector<int>& solved, std::size_t modes,
                HorizontalCoupling& c) {
  constexpr double kDusk = 92 * kRadiansPerDegree;  // above it, first order does as well
  constexpr double kSmall = 3e-4;                   // of a sun's light, as twilight decays
  const std::size_t suns = c.suns.size();
  c.shifted.assign(suns, false);
  std::vector<double> decay(suns);
  // The highest sun whose neighbours are solved: that before the first coupled one. Few levels have
  // layers in which a ray goes beyond it; light there hardly changes with the sun.
  constexpr double kPast = 1e-9;
  int first = 0;
  while (solved[first] < 0 || !c.coupled[solved[first]]) ++first;
  const double highest_mu = first == 0 ? 1 : std::cos(grid.zenith(first - 1) + kPast);
  for (int i = 0; i < grid.size(); ++i) {
    if (solved[i] < 0) continue;
    c.shifted[solved[i]] = c.coupled[solved[i]] && grid.zenith(i) > kDusk;
    decay[solved[i]] = grid.decay(grid.zenith(i));
  }
  c.shares.resize(c.step.size());
  tbb::parallel_for(std::size_t{0}, c.step.size(), [&](std::size_t at) {
    c.shares[at].resize(modes);
    if (c.step[at] == 0) return;
    for (int i = 0; i < grid.size(); ++i) {
      if (solved[i] < 0 || !c.shifted[solved[i]]) continue;
      const auto sun = static_cast<std::size_t>(solved[i]);
      const Shift shift =
          shift_of(grid, solved, suns, grid.zenith(i), c.step[at], highest_mu, modes);
      for (std::size_t m = 0; m < modes; ++m) {
        for (std::size_t from_sun = 0; from_sun < suns; ++from_sun) {
          for (std::size_t from = 0; from < modes; ++from) {
            const double own = m == from && from_sun == sun ? 1 : 0,
                         cosine = shift.cosine[from_sun][m][from] - own,
                         sine = shift.sine[from_sun][m][from] - own;
            if (decay[from_sun] / decay[sun] * std::max(std::abs(cosine), std::abs(sine)) < kSmall)
              continue;
            c.shares[at][m].push_back({static_cast<std::uint8_t>(sun),
                                       static_cast<std::uint8_t>(from_sun),
                                       static_cast<std::uint8_t>(from), static_cast<float>(cosine),
                                       static_cast<float>(sine)});
          }
        }
      }
    }
  });
}

double top_over_radius(const Shells& shells) { return shells.top / shells.bottom_radius; }

}  // namespace

bool is_extended(const Shells& shells) {
  constexpr double kThin = 0.02;
  return top_over_radius(shells) > kThin;
}

FieldGrid field_grid(const Shells& shells, int levels_by_day, bool deep_twilight) {
  if (is_extended(shells)) return {2 * levels_by_day, LimbRays::kOfExtended};
  if (deep_twilight) return {levels_by_day * 10 / 7, LimbRays::kOfTwilight};
  return {levels_by_day, LimbRays::kOfDay};
}

int first_coupled_sun(const SunGrid& grid, const Shells& shells) {
  if (is_extended(shells)) return 0;
  constexpr double kLow = 86 * kRadiansPerDegree;
  int i = 0;
  while (grid.zenith(i) < kLow) ++i;
  return i;
}

HorizontalCoupling sun_coupling(const SunGrid& grid, const Shells& shells,
                                const std::vector<int>& solved, const Streams& streams, int first,
                                int shifted_modes) {
  constexpr double kThick = 0.05;
  HorizontalCoupling c;
  c.converges = top_over_radius(shells) < kThick;
  for (int i = 0; i < grid.size(); ++i) {
    if (solved[i] < 0) continue;
    c.coupled.push_back(i >= first);
    HorizontalCoupling::Sun sun;
    if (i >= first) {
      sun.at_zenith = grid.zenith(i) == 0;
      sun.cotangent = sun.at_zenith ? 0 : 1 / std::tan(grid.zenith(i));
      sun.slope = grid.slope(i);
      for (int& k : sun.slope.index) k = solved[k];
    }
    c.suns.push_back(sun);
  }
  for (int i = 0; i + 1 < streams.levels(); ++i) {
    for (int k = 0; k < streams.most(); ++k) {
      // The difference of the ray's zenith angles at both ends.
      const double low = streams.mu(i, k), high = streams.mu(i + 1, k);
      c.step.push_back(k < streams.count(i) ? std::asin(std::sqrt(1 - low * low) * high -
                                                        low * std::sqrt(1 - high * high))
                                            : 0.0);
    }
  }
  if (c.converges && std::ranges::count(c.coupled, 1) > 0)
    set_shares(grid, solved, static_cast<std::size_t>(shifted_modes), c);
  return c;
}

}  // namespace skyfit
