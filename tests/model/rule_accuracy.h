// SPDX-License-Identifier: Apache-2.0
// How far rules of few wavelengths are from the 5 nm sum of the reference model's own radiances.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "data_refs/spectra.h"
#include "model/registry.h"
#include "model/sky_model.h"

namespace skyfit {

using Xyz = std::array<double, 3>;

// An atmosphere and where it is looked at, angles in degrees.
struct RuleCase {
  Atmosphere<double> atmosphere;
  std::vector<double> altitudes_m, suns_deg, views_deg;
};

inline std::vector<SkyPoint> points_of(const RuleCase& rule_case) {
  constexpr double kDegree = std::numbers::pi / 180;
  std::vector<SkyPoint> points;
  for (const double altitude : rule_case.altitudes_m) {
    for (const double sun : rule_case.suns_deg) {
      for (const double view : rule_case.views_deg) {
        for (const double azimuth : {10.0, 90.0, 180.0}) {
          points.push_back({altitude, sun * kDegree, view * kDegree, azimuth * kDegree});
        }
      }
    }
  }
  return points;
}

// XYZ of every point by a rule of three rows of weights.
inline std::vector<Xyz> xyz_of(const Atmosphere<double>& atmosphere, const XyzRule& rule,
                               const std::vector<SkyPoint>& points) {
  const SkyValues sky = make_sky_model("reference", refs::standard_spectral_data(), 2)
                            ->radiance(atmosphere, rule.nodes, points, {});
  std::vector<Xyz> result(points.size(), Xyz{});
  for (int i = 0; i < sky.points; ++i) {
    for (int c = 0; c < 3; ++c) {
      for (int k = 0; k < sky.wavelengths; ++k) result[i][c] += rule.weight[c][k] * sky.at(i, k);
    }
  }
  return result;
}

// The largest of a kind of error, and where it is.
struct WorstError {
  double value = 0;
  std::string where = "nowhere";

  void take(double error, const SkyPoint& p, const Atmosphere<double>& a) {
    if (error <= value) return;
    const auto deg = [](double angle) { return angle * 180 / std::numbers::pi; };
    value = error;
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(),
                  "sun %g view %g azimuth %g altitude %g, aerosol %g exponent %g, ozone %g DU",
                  deg(p.sun_zenith), deg(p.view_zenith), deg(p.relative_azimuth), p.altitude_m,
                  a.at("mie").amount, a.at("mie").angstrom_exponent, a.at("ozone").amount);
    where = text.data();
  }
};

struct WorstErrors {
  WorstError luminance, chromaticity;  // relative; the larger of x and y

  void take(const std::vector<Xyz>& found, const std::vector<Xyz>& exact,
            const std::vector<SkyPoint>& points, const Atmosphere<double>& atmosphere) {
    const auto share = [](const Xyz& xyz, int k) { return xyz[k] / (xyz[0] + xyz[1] + xyz[2]); };
    for (std::size_t i = 0; i < points.size(); ++i) {
      luminance.take(std::abs(found[i][1] / exact[i][1] - 1), points[i], atmosphere);
      for (const int k : {0, 1}) {
        chromaticity.take(std::abs(share(found[i], k) - share(exact[i], k)), points[i], atmosphere);
      }
    }
  }
};

inline XyzRule as_xyz_rule(const LuminanceRule& rule) {
  return {rule.nodes, {rule.weight, rule.weight, rule.weight}};
}

inline XyzRule as_xyz_rule(const ColorRule& rule) {
  XyzRule result{{rule.nodes.begin(), rule.nodes.end()}, {}};
  for (int c = 0; c < 3; ++c) {
    result.weight[c].assign(rule.xyz_from_nodes[c].begin(), rule.xyz_from_nodes[c].end());
  }
  return result;
}

// Holds what model/photometry/photometry.h states of its rules, and prints it.
inline void expect_rules_hold(const std::vector<RuleCase>& cases) {
  const SpectralData& data = refs::standard_spectral_data();
  struct Claim {
    const char* name;
    XyzRule rule;
    double luminance, chromaticity;  // the latter 1 where the rule has no colour
    WorstErrors worst;
  };
  std::array<Claim, 3> claims = {
      {{"luminance_rule", as_xyz_rule(luminance_rule(data)), 1.5e-3, 1, {}},
       {"xyz_rule", xyz_rule(data), 1.5e-3, 5e-4, {}},
       {"color_rule", as_xyz_rule(color_rule(data)), 4e-3, 4e-3, {}}}};
  for (const RuleCase& c : cases) {
    const std::vector<SkyPoint> points = points_of(c);
    const std::vector<Xyz> exact = xyz_of(c.atmosphere, xyz_sum_5nm(data), points);
    for (Claim& claim : claims) {
      claim.worst.take(xyz_of(c.atmosphere, claim.rule, points), exact, points, c.atmosphere);
    }
  }
  for (const Claim& claim : claims) {
    const auto& [luminance, chromaticity] = claim.worst;
    std::printf("%s: luminance %.3f %% at %s\n", claim.name, 100 * luminance.value,
                luminance.where.c_str());
    if (claim.chromaticity < 1) {
      std::printf("  x, y %.5f at %s\n", chromaticity.value, chromaticity.where.c_str());
    }
    EXPECT_LT(luminance.value, claim.luminance) << claim.name;
    EXPECT_LT(chromaticity.value, claim.chromaticity) << claim.name;
  }
}

}  // namespace skyfit
