// SPDX-License-Identifier: Apache-2.0
// The spectrum made for a colour has that colour in sunlight, and grey is flat.
#include "render/gl/terrain/color_reflectance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>

#include "data_refs/spectra.h"

namespace skyfit {
namespace {

const ColorReflectance& colors() {
  static const ColorReflectance made(color_rule(refs::standard_spectral_data()));
  return made;
}

TEST(ColorReflectance, GreyIsFlat) {
  for (const double grey : {0.0, 0.18, 1.0}) {
    for (const double value : colors().at(glm::dvec3(grey))) EXPECT_NEAR(value, grey, 1e-12);
  }
  EXPECT_LT(glm::length(colors().linear_srgb({1, 1, 1, 1}) - glm::dvec3(1)), 1e-12);
}

TEST(ColorReflectance, ComesBackAsTheColor) {
  int within = 0, all = 0;
  for (double r = 0.02; r < 1; r += 0.07) {
    for (double g = 0.02; g < 1; g += 0.07) {
      for (double b = 0.02; b < 1; b += 0.07) {
        const glm::dvec3 color(r, g, b);
        const NodeValues value = colors().at(color);
        for (const double node : value) {
          ASSERT_GE(node, 0);
          ASSERT_LE(node, 1);
        }
        const double error = glm::length(colors().linear_srgb(value) - color);
        ASSERT_LT(error, 0.15) << r << " " << g << " " << b;
        within += error < 1e-9;
        ++all;
      }
    }
  }
  // The others are as saturated as the primaries, which no surface is.
  EXPECT_GT(within, 0.98 * all);
}

TEST(ColorReflectance, IsAsFlatAsItCanBe) {
  // Of a brown: any other spectrum of the same colour has larger steps between its nodes.
  const glm::dvec3 brown(0.3, 0.2, 0.1);
  const NodeValues flattest = colors().at(brown);
  // What changes no colour: the difference of two spectra of one, the first of which had to be bent
  // into 0..1.
  const glm::dvec3 green(0.01, 0.1, 0.01);
  const NodeValues bent = colors().at(green), even = colors().at(0.5 * green + glm::dvec3(0.05));
  NodeValues unseen;
  for (std::size_t k = 0; k < 4; ++k) unseen[k] = 0.5 * bent[k] + 0.05 - even[k];
  ASSERT_GT(std::abs(unseen[0]), 1e-4);
  ASSERT_LT(glm::length(colors().linear_srgb(unseen)), 1e-9);
  const auto steps = [&](double t) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double step = flattest[k + 1] - flattest[k] + t * (unseen[k + 1] - unseen[k]);
      sum += step * step;
    }
    return sum;
  };
  EXPECT_LT(steps(0), steps(1));
  EXPECT_LT(steps(0), steps(-1));
}

}  // namespace
}  // namespace skyfit
