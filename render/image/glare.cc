// SPDX-License-Identifier: Apache-2.0
#include "render/image/glare.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <map>
#include <numbers>
#include <utility>

#include "model/numerics/angles.h"

namespace skyfit {
namespace {

constexpr int kMostSources = 8;  // on a side of the part of the picture that discs cover

glm::dvec3 direction_of(const Frame& frame, std::size_t pixel) {
  const double zenith = kRadiansPerDegree * frame.view_zenith_deg[pixel],
               azimuth = kRadiansPerDegree * frame.view_azimuth_deg[pixel];
  return {std::sin(zenith) * std::cos(azimuth), std::sin(zenith) * std::sin(azimuth),
          std::cos(zenith)};
}

struct Source {
  glm::dvec3 direction{0};
  glm::dvec3 illuminance{0};  // lux, in the frame's primaries
  double solid_angle_sr = 0;
};

// Neighbouring pixels of discs as one source.
std::vector<Source> sources_of(const Frame& frame) {
  int left = frame.width, right = 0, top = frame.height, bottom = 0;
  const auto place = [&](const DiscPixel& disc) {
    return std::pair(static_cast<int>(disc.pixel % frame.width),
                     static_cast<int>(disc.pixel / frame.width));
  };
  for (const DiscPixel& disc : frame.discs) {
    const auto [x, y] = place(disc);
    left = std::min(left, x), right = std::max(right, x);
    top = std::min(top, y), bottom = std::max(bottom, y);
  }
  const int side = (std::max(right - left, bottom - top) + kMostSources) / kMostSources;
  std::map<std::pair<int, int>, Source> sources;
  for (const DiscPixel& disc : frame.discs) {
    const auto [x, y] = place(disc);
    Source& source = sources[{(x - left) / side, (y - top) / side}];
    const double solid_angle = disc.solid_angle_sr;
    source.illuminance += solid_angle * glm::dvec3(disc.rgb[0], disc.rgb[1], disc.rgb[2]);
    source.direction += double{disc.cover} * direction_of(frame, disc.pixel);
    source.solid_angle_sr += solid_angle;
  }
  std::vector<Source> list;
  for (auto& [key, source] : sources) {
    source.direction = glm::normalize(source.direction);
    list.push_back(source);
  }
  return list;
}

}  // namespace

double glare_function(double angle_deg) {
  constexpr double kAge = 35, kPigmentation = 0.5;
  // 9.2e6 / (1 + (x / 0.0046)^2)^1.5 and 1.5e5 / (1 + (x / 0.045)^2)^1.5 far out.
  constexpr double kTails = 9.2e6 * 0.0046 * 0.0046 * 0.0046 + 1.5e5 * 0.045 * 0.045 * 0.045;
  constexpr double kSharp = 0.3;  // degrees
  constexpr double kRatio = kAge / 70, age = kRatio * kRatio * kRatio * kRatio;
  const double square = angle_deg * angle_deg, x = 1 + square / 0.01;
  const double blunt = square + kSharp * kSharp;
  return (1 - 0.08 * age) * kTails / (blunt * std::sqrt(blunt)) +
         (1 + 1.6 * age) * (400 / x + 3e-8 * square +
                            kPigmentation * (1300 / (x * std::sqrt(x)) + 0.8 / std::sqrt(x))) +
         2.5e-3 * kPigmentation;
}

std::vector<float> glare_of(const Frame& frame) {
  const std::vector<Source> sources = sources_of(frame);
  if (sources.empty()) return {};
  std::vector<float> glare(frame.rgb.size());
  tbb::parallel_for(0, frame.height, [&](int y) {
    for (int x = 0; x < frame.width; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * frame.width + x;
      if (std::isnan(frame.view_zenith_deg[pixel])) continue;
      const glm::dvec3 ray = direction_of(frame, pixel);
      glm::dvec3 sum(0);
      for (const Source& source : sources) {
        const double away = 2 * std::asin(std::min(0.5 * glm::length(ray - source.direction), 1.0));
        // Of a square half the diagonal's square is half its area.
        sum +=
            source.illuminance *
            glare_function(std::sqrt(away * away + source.solid_angle_sr / 2) / kRadiansPerDegree);
      }
      for (int k = 0; k < 3; ++k)
        glare[3 * pixel + static_cast<std::size_t>(k)] = static_cast<float>(sum[k]);
    }
  });
  return glare;
}

}  // namespace skyfit
