// SPDX-License-Identifier: Apache-2.0
// The relief has no steps and no seams, and the materials' mean is the ground albedo.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "render/gl/terrain/noise.h"
#include "render/gl/terrain/relief.h"

namespace skyfit {
namespace {

constexpr double kEarth = 6360e3;

glm::dvec3 direction(int i, int count) {
  const double z = 1 - (2 * i + 1.0) / count, turn = i * 2.399963;
  const double s = std::sqrt(1 - z * z);
  return {s * std::cos(turn), s * std::sin(turn), z};
}

TEST(Noise, HasTwoContinuousDerivativesAcrossLatticePlanes) {
  constexpr double kStep = 1e-3;
  for (int i = -50; i < 50; ++i) {
    const glm::dvec3 at(i, 0.3 + 0.17 * i, -0.4 * i);
    const auto slope = [&](double x) {
      const glm::dvec3 step(kStep, 0, 0), p = at + glm::dvec3(x, 0, 0);
      return (gradient_noise(p + step) - gradient_noise(p - step)) / (2 * kStep);
    };
    EXPECT_NEAR(gradient_noise(at - glm::dvec3(1e-9, 0, 0)),
                gradient_noise(at + glm::dvec3(1e-9, 0, 0)), 1e-8);
    EXPECT_NEAR(slope(-2 * kStep), slope(2 * kStep), 0.05);
  }
}

TEST(Noise, HasMeanZeroAndStaysBounded) {
  double sum = 0, largest = 0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const double value = gradient_noise(1e4 * direction(i, kCount));
    sum += value;
    largest = std::max(largest, std::abs(value));
  }
  EXPECT_NEAR(sum / kCount, 0, 0.01);
  EXPECT_GT(largest, 0.5);
  EXPECT_LT(largest, 1.2);
}

TEST(Noise, ChangesLittleWhenTheFinestDetailFadesIn) {
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 p = 1e5 * direction(i, 200);
    for (const double finest : {99.0, 199.9, 400.1}) {
      EXPECT_NEAR(fractal_noise(p, 3200, finest), fractal_noise(p, 3200, finest * 1.001), 0.01);
    }
  }
}

// A crest between two samples does not stand out of the line through them, nor sink below it from
// one pair to the next: mountains would have teeth.
TEST(Noise, SamplesShowTheRidgesTheyStandFor) {
  constexpr double kShortest = 2000, kLongest = 16e3;
  constexpr int kCount = 20000;
  double squares = 0, worst = 0;
  for (int i = 0; i < kCount; ++i) {
    const glm::dvec3 here = kEarth * direction(i, kCount);
    const glm::dvec3 half = 0.25 * kShortest * direction((i * 7919) % kCount, kCount);
    const auto ridge = [&](double x) { return ridged_noise(here + x * half, kLongest, kShortest); };
    const double error = ridge(0) - 0.5 * (ridge(-1) + ridge(1));
    squares += error * error / kCount;
    worst = std::max(worst, std::abs(error));
  }
  EXPECT_LT(std::sqrt(squares), 0.013);
  EXPECT_LT(worst, 0.1);
}

TEST(Relief, IsContinuousAndNeverBelowTheBottomRadius) {
  const Relief relief(kEarth, {0.15, 0.15, 0.15, 0.15}, true);
  constexpr double kStep = 1;  // m
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec3 here = direction(i, 3000);
    const glm::dvec3 side = glm::normalize(glm::cross(here, glm::dvec3(0.3, 0.5, 0.8)));
    const double height = relief.height_m(here, 10);
    EXPECT_GE(height, 0);
    EXPECT_LT(height, 9e3);
    const double next = relief.height_m(glm::normalize(here + kStep / kEarth * side), 10);
    EXPECT_LT(std::abs(next - height), 4 * kStep)
        << "direction " << i;  // no slope above 76 degrees
  }
}

TEST(Relief, LeavesRoomForACameraOneMetreUp) {
  for (const double radius : {kEarth, 3390e3, 1e9, 1e4}) {
    const Relief relief(radius, {0.2, 0.2, 0.2, 0.2}, true);
    EXPECT_LT(relief.height_m(relief.coast().z, 0.1), 0.7) << "radius " << radius;
  }
}

TEST(Relief, ReflectsTheGroundAlbedoOnAverage) {
  for (const double albedo : {0.0, 0.1, 0.5, 0.95, 1.0}) {
    const Relief relief(kEarth, {albedo, albedo, albedo, albedo}, true);
    NodeValues sum{};
    constexpr int kCount = 5003;  // other directions than the relief's own balance
    for (int i = 0; i < kCount; ++i) {
      const glm::dvec3 here = direction(i, kCount);
      const Elevation at = relief.elevation(here, 2e3);
      const NodeValues value = at.above_water_m > 0 ? relief.reflectance(here, at.height_m, 0, 2e3)
                                                    : relief.water_reflectance().value();
      for (std::size_t k = 0; k < 4; ++k) {
        ASSERT_GE(value[k], 0);
        ASSERT_LE(value[k], 1);
        sum[k] += value[k] / kCount;
      }
    }
    EXPECT_NEAR((sum[0] + sum[1] + sum[2] + sum[3]) / 4, albedo, 0.02 * albedo);
  }
}

}  // namespace
}  // namespace skyfit
