// SPDX-License-Identifier: Apache-2.0
// Gradient noise in three dimensions (Perlin 2002: quintic fade), on a hashed lattice that does not
// repeat.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace skyfit {

// In about -1..1, 0 at lattice points, mean 0, two continuous derivatives. |x| < 2^51.
double gradient_noise(const glm::dvec3& x);

// At three points, in little more time than at one.
glm::dvec3 gradient_noises(const std::array<glm::dvec3, 3>& x);

// Lattice steps between an octave and the next: noise is 0 at its lattice points, which octaves of
// the same axes must not share.
inline constexpr glm::dvec3 kOctaveShift(0.37, 0.73, 0.19);

// The same with a period of `period` lattice steps in each direction.
double periodic_gradient_noise(const glm::dvec3& x, int period);

// Sum of octaves, each of half the wavelength and half the amplitude of the one before: wavelength
// `longest` down to `shortest`, the last one faded in so that a changing `shortest` makes no step.
// The first octave has amplitude 1.
double fractal_noise(const glm::dvec3& x, double longest, double shortest);

// Ridges (Musgrave 1993, ridged multifractal): crests as sharp as samples half of `shortest` apart
// can show, smooth valleys; about 0..1.
double ridged_noise(const glm::dvec3& x, double longest, double shortest);

}  // namespace skyfit
