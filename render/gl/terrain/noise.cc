// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace skyfit {
namespace {

// Finaliser of MurmurHash3 over the three lattice coordinates.
std::uint64_t hash(std::int64_t x, std::int64_t y, std::int64_t z) {
  std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15u;
  h = (h ^ static_cast<std::uint64_t>(y)) * 0xC2B2AE3D27D4EB4Fu;
  h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(z)) * 0x165667B19E3779F9u;
  h = (h ^ (h >> 32)) * 0xFF51AFD7ED558CCDu;
  return h ^ (h >> 33);
}

// The twelve edge directions of a cube.
double corner(std::int64_t x, std::int64_t y, std::int64_t z, const glm::dvec3& d) {
  static constexpr std::array<std::array<double, 3>, 16> kEdges = {{{1, 1, 0},
                                                                    {-1, 1, 0},
                                                                    {1, -1, 0},
                                                                    {-1, -1, 0},
                                                                    {1, 0, 1},
                                                                    {-1, 0, 1},
                                                                    {1, 0, -1},
                                                                    {-1, 0, -1},
                                                                    {0, 1, 1},
                                                                    {0, -1, 1},
                                                                    {0, 1, -1},
                                                                    {0, -1, -1},
                                                                    {1, 1, 0},
                                                                    {0, -1, 1},
                                                                    {-1, 1, 0},
                                                                    {0, -1, -1}}};
  const auto& edge = kEdges[hash(x, y, z) & 15];
  return edge[0] * d.x + edge[1] * d.y + edge[2] * d.z;
}

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

// `wrapped` turns a lattice coordinate into the one that is hashed.
template <class Wrapped>
double lattice_noise(const glm::dvec3& x, Wrapped&& wrapped) {
  const glm::dvec3 base = glm::floor(x);
  const glm::dvec3 d = x - base;
  const auto i = static_cast<std::int64_t>(base.x);
  const auto j = static_cast<std::int64_t>(base.y);
  const auto k = static_cast<std::int64_t>(base.z);
  const double u = fade(d.x), v = fade(d.y), w = fade(d.z);
  const auto edge = [&](int b, int c) {
    const std::int64_t row = wrapped(j + b), slice = wrapped(k + c);
    const double low = corner(wrapped(i), row, slice, d - glm::dvec3(0, b, c));
    const double high = corner(wrapped(i + 1), row, slice, d - glm::dvec3(1, b, c));
    return low + u * (high - low);
  };
  const double near = edge(0, 0) + v * (edge(1, 0) - edge(0, 0));
  const double far = edge(0, 1) + v * (edge(1, 1) - edge(0, 1));
  return near + w * (far - near);
}

// Calls octave(wavelength, amplitude) from longest to shortest.
template <class F>
void for_octaves(double longest, double shortest, F&& octave) {
  double amplitude = 1;
  for (double wavelength = longest; wavelength > 0.5 * shortest; wavelength *= 0.5) {
    octave(wavelength, amplitude * std::clamp(2 * wavelength / shortest - 1, 0.0, 1.0));
    amplitude *= 0.5;
  }
}

// Octaves of one sum must not share their lattice points.
glm::dvec3 octave_point(const glm::dvec3& x, double wavelength) {
  return x / wavelength + glm::dvec3(0.37, 0.73, 0.19);
}

}  // namespace

double gradient_noise(const glm::dvec3& x) {
  return lattice_noise(x, [](std::int64_t i) { return i; });
}

double periodic_gradient_noise(const glm::dvec3& x, int period) {
  return lattice_noise(x, [period](std::int64_t i) { return ((i % period) + period) % period; });
}

double fractal_noise(const glm::dvec3& x, double longest, double shortest) {
  double sum = 0;
  for_octaves(longest, shortest, [&](double wavelength, double amplitude) {
    if (amplitude > 0) sum += amplitude * gradient_noise(octave_point(x, wavelength));
  });
  return sum;
}

double ridged_noise(const glm::dvec3& x, double longest, double shortest) {
  double sum = 0, gain = 1, present = 0;
  for_octaves(longest, shortest, [&](double wavelength, double amplitude) {
    if (amplitude <= 0) return;
    const double crest =
        1 - std::min(std::abs(1.6 * gradient_noise(octave_point(x, wavelength))), 1.0);
    const double ridge = crest * crest * gain;
    gain = std::clamp(1.8 * ridge, 0.0, 1.0);
    sum += amplitude * ridge;
    present += amplitude;
  });
  // Seen from afar the ranges keep their mean height.
  constexpr double kMean = 0.45;
  return 0.6 * (sum + kMean * std::max(1 - present, 0.0));
}

}  // namespace skyfit
