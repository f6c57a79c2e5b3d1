// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/noise.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "model/numerics/clones.h"

namespace skyfit {
namespace {

// Of a crest of ridged_noise() whose octave is `shortest` long, in units of 1.6 times the noise.
constexpr double kCrestWidth = 0.4;

// Points and octaves are worked on eight at a time.
constexpr std::size_t kBatchWidth = 8;
typedef double Doubles __attribute__((vector_size(kBatchWidth * sizeof(double))));
typedef std::int64_t Integers __attribute__((vector_size(kBatchWidth * sizeof(double))));
typedef std::uint64_t Bits __attribute__((vector_size(kBatchWidth * sizeof(double))));

struct Batch {
  Doubles x[3];  // coordinates
  Doubles noise;
};

// Where the noise repeats: a lattice coordinate that is reached by no |x| < 2^51, or the period.
constexpr std::int64_t kNowhere = std::int64_t{1} << 52;

// The gradient at a lattice point is one of the twelve edge directions of a cube (Perlin 2002),
// chosen by the finaliser of MurmurHash3 over the lattice coordinates, in 0 .. end - 1 where the
// noise repeats.
SKYFIT_CLONES
void lattice_noise(Batch& batch, std::int64_t end) {
  // Adding and subtracting it rounds to an integer, whose bits are left in the sum.
  constexpr double kRound = 0x1.8p52;
  constexpr auto kRoundBits = std::bit_cast<std::int64_t>(kRound);
  Doubles d[3], fade[3];
  Bits cell[3][2];  // lattice coordinates below and above
  for (int axis = 0; axis < 3; ++axis) {
    const Doubles x = batch.x[axis], sum = x + kRound, nearest = sum - kRound;
    const Integers above = nearest > x;  // -1 where it is
    const Integers low = (Integers)sum - kRoundBits + above, high = low + 1;
    d[axis] = x - (nearest + __builtin_convertvector(above, Doubles));
    const Doubles t = d[axis];
    fade[axis] = t * t * t * (t * (t * 6 - 15) + 10);
    cell[axis][0] = (Bits)low;
    cell[axis][1] = (Bits)(high == end ? Integers{} : high);
  }
  Doubles value[2][2][2];  // by x, y, z
  for (int a = 0; a < 2; ++a) {
    const Bits by_x = cell[0][a] * 0x9E3779B97F4A7C15u;
    const Doubles x = d[0] - static_cast<double>(a);
    for (int b = 0; b < 2; ++b) {
      const Bits by_y = (by_x ^ cell[1][b]) * 0xC2B2AE3D27D4EB4Fu;
      const Doubles y = d[1] - static_cast<double>(b);
      for (int c = 0; c < 2; ++c) {
        Bits h = (by_y ^ (by_y >> 29) ^ cell[2][c]) * 0x165667B19E3779F9u;
        h = (h ^ (h >> 32)) * 0xFF51AFD7ED558CCDu;
        h = (h ^ (h >> 33)) & 15;
        const Doubles z = d[2] - static_cast<double>(c);
        // The two coordinates of an edge that are not 0, and their signs.
        const Doubles u = h < 8 ? x : y;
        const Doubles v = h < 4 ? y : ((h & 13) == 12 ? x : z);
        value[a][b][c] = (Doubles)((Bits)u ^ (h << 63)) + (Doubles)((Bits)v ^ ((h >> 1) << 63));
      }
    }
  }
  Doubles edge[2][2];  // by y, z
  for (int b = 0; b < 2; ++b) {
    for (int c = 0; c < 2; ++c)
      edge[b][c] = value[0][b][c] + fade[0] * (value[1][b][c] - value[0][b][c]);
  }
  const Doubles near = edge[0][0] + fade[1] * (edge[1][0] - edge[0][0]);
  const Doubles far = edge[0][1] + fade[1] * (edge[1][1] - edge[0][1]);
  batch.noise = near + fade[2] * (far - near);
}

double noise_at(const glm::dvec3& x, std::int64_t end) {
  Batch batch{};
  for (int axis = 0; axis < 3; ++axis) batch.x[axis][0] = x[axis];
  lattice_noise(batch, end);
  return batch.noise[0];
}

// Calls add(wavelength, amplitude, noise) from the longest octave to the shortest.
template <class F>
void for_octaves(const glm::dvec3& x, double longest, double shortest, F&& add) {
  Batch batch{};
  std::array<double, kBatchWidth> wavelengths, amplitudes;
  std::size_t count = 0;
  const auto flush = [&] {
    lattice_noise(batch, kNowhere);
    for (std::size_t i = 0; i < count; ++i) add(wavelengths[i], amplitudes[i], batch.noise[i]);
    count = 0;
  };
  double amplitude = 1;
  for (double wavelength = longest; wavelength > 0.5 * shortest; wavelength *= 0.5) {
    // Octaves of one sum must not share their lattice points.
    const glm::dvec3 at = x / wavelength + glm::dvec3(0.37, 0.73, 0.19);
    for (int axis = 0; axis < 3; ++axis) batch.x[axis][count] = at[axis];
    wavelengths[count] = wavelength;
    amplitudes[count++] = amplitude * std::clamp(2 * wavelength / shortest - 1, 0.0, 1.0);
    amplitude *= 0.5;
    if (count == kBatchWidth) flush();
  }
  if (count > 0) flush();
}

}  // namespace

double gradient_noise(const glm::dvec3& x) { return noise_at(x, kNowhere); }

glm::dvec3 gradient_noises(const std::array<glm::dvec3, 3>& x) {
  Batch batch{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) batch.x[axis][i] = x[i][axis];
  }
  lattice_noise(batch, kNowhere);
  return {batch.noise[0], batch.noise[1], batch.noise[2]};
}

double periodic_gradient_noise(const glm::dvec3& x, int period) {
  return noise_at(x - static_cast<double>(period) * glm::floor(x / static_cast<double>(period)),
                  period);
}

double fractal_noise(const glm::dvec3& x, double longest, double shortest) {
  double sum = 0;
  for_octaves(x, longest, shortest,
              [&](double, double amplitude, double noise) { sum += amplitude * noise; });
  return sum;
}

double ridged_noise(const glm::dvec3& x, double longest, double shortest) {
  double sum = 0, gain = 1, present = 0;
  // Crests lie half a wavelength apart.
  for_octaves(x, longest, 2 * shortest, [&](double wavelength, double amplitude, double noise) {
    // A crest is as round as samples half of `shortest` apart can show: a sharp one would become
    // teeth.
    const double round = kCrestWidth * shortest / wavelength;
    const double crest = 1 - std::min(std::sqrt(2.56 * noise * noise + round * round), 1.0);
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
