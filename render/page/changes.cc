// SPDX-License-Identifier: Apache-2.0
#include "render/page/changes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/atmosphere/parameters.h"

namespace skyfit {
namespace {

// Of tables that hold logarithms already. What is as dark as these can be is no measure.
Table difference(const Table& before, const Table& after) {
  const auto darkest = static_cast<float>(std::log(kDarkestScattering)) + 1e-3f;
  Table change = after;
  for (std::size_t i = 0; i < change.rgba.size(); ++i) {
    const bool dark = before.rgba[i] <= darkest || after.rgba[i] <= darkest;
    change.rgba[i] = dark ? 0 : after.rgba[i] - before.rgba[i];
  }
  return change;
}

// Of others, which are 0 at the top of the atmosphere and at night.
Table ratio(const Table& before, const Table& after) {
  constexpr float kNothing = 1e-12f;
  Table change = after;
  for (std::size_t i = 0; i < change.rgba.size(); ++i) {
    change.rgba[i] =
        std::log(std::max(after.rgba[i], kNothing) / std::max(before.rgba[i], kNothing));
  }
  return change;
}

// Every so many of the heights of a table of `classes` one after the other, all ends among them.
Table at_fewer_heights(const Table& table, int classes) {
  const int heights = table.depth / classes;
  Table thin{table.width, table.height, classes * kChangeSizes.scattering_r, {}};
  const std::ptrdiff_t slice = 4 * static_cast<std::ptrdiff_t>(table.width) * table.height;
  for (int c = 0; c < classes; ++c) {
    for (int z = 0; z < heights; z += kEveryHeight) {
      const auto at = table.rgba.begin() + slice * (c * heights + z);
      thin.rgba.insert(thin.rgba.end(), at, at + slice);
    }
  }
  return thin;
}

// Every so many of the angles of a table of phase functions, both ends among them.
Table thinned(const Table& phase) {
  constexpr int kEvery = 15;
  if (phase.width == 1) return phase;
  Table thin{(phase.width - 1) / kEvery + 1, phase.height, 1, {}};
  for (int y = 0; y < thin.height; ++y) {
    for (int x = 0; x < thin.width; ++x) {
      const auto at = phase.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(y) * phase.width +
                                                static_cast<std::ptrdiff_t>(x) * kEvery);
      thin.rgba.insert(thin.rgba.end(), at, at + 4);
    }
  }
  return thin;
}

}  // namespace

AtmosphereTables table_change(const AtmosphereTables& before, const AtmosphereTables& after) {
  AtmosphereTables change = after;
  change.optical_depth = ratio(before.optical_depth, after.optical_depth);
  change.irradiance = ratio(before.irradiance, after.irradiance);
  change.sizes = kChangeSizes;
  change.rayleigh_like = at_fewer_heights(difference(before.rayleigh_like, after.rayleigh_like), 1);
  change.single = at_fewer_heights(difference(before.single, after.single),
                                   static_cast<int>(after.phases.others.size()));
  change.phase = difference(thinned(before.phase), thinned(after.phase));
  return change;
}

void require_same_classes(const Atmosphere<double>& before, const Atmosphere<double>& after) {
  if (phase_classes(before).of_constituent != phase_classes(after).of_constituent)
    throw std::invalid_argument(
        "expected a parameter of a phase function that no other constituent shares");
}

Atmosphere<double> changed(const Atmosphere<double>& atmosphere, const Parameter& parameter,
                           double value) {
  Atmosphere<double> other = atmosphere;
  set_parameter(other, parameter, value);
  return other;
}

}  // namespace skyfit
