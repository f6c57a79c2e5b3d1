// SPDX-License-Identifier: Apache-2.0
// Skies as gendaylit and gensky of Radiance write them: the luminance of perezlum.cal (the
// all-weather sky of Perez, Seals & Michalsky 1993) or of skybright.cal (CIE clear, overcast and
// intermediate skies, uniform skies), from the numbers of the scene's brightfunc and its sun.
//
//   perezlum    A1 (1 + A3 exp(A4 / z)) (1 + A5 exp(A6 g) + A7 cos^2 g)
//   skybright   A1 is the sky, A2 the zenith's radiance, A4 what clear and intermediate skies are
//               divided by:
//     1 clear         (0.91 + 10 exp(-3 g) + 0.45 cos^2 g) (1 - exp(-0.32 / z))
//     2 overcast      (1 + 2 z) / 3
//     3 uniform       1
//     4 intermediate  ((1.35 sin(5.631 - 3.59 n) + 3.12) sin(4.396 - 2.6 t) + 6.37 - n) / 2.326 *
//                     exp(-0.563 g ((2.629 - n) (1.562 - t) + 0.812))
//
// g is the angle to the sun, z the cosine of the view's zenith angle n (at least 0.01 in perezlum;
// below it a clear sky has no last factor), t the sun's. skybright blends the ground's radiance A3
// into the sky S: (w S + A3 / w) / (w + 1 / w), w = (z + 1.01)^10, a share of 0.45 at the horizon
// and of 0.10 at 6 deg. perezlum.cal 1.1 did so, too, with A2; 1.2, which counts here, does not.
// Sources: Radiance, perezlum.cal and skybright.cal; manual pages of gendaylit and gensky.
// Directions: x east, y north, z up. Luminances in cd/m^2 are 179 lm/W times the radiance, times
// the brightness of the glow that the function colours, where the scene has one.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit::refs {

enum class RadianceFormula { kPerez, kClear, kOvercast, kUniform, kIntermediate };

struct RadianceSun {
  double zenith, azimuth;  // radians, clockwise from north, 0 <= . < 2 pi
};

// A sun belongs to every formula but overcast and uniform skies, of which a comment may tell it.
struct RadianceSky {
  RadianceFormula formula;
  std::vector<double> a;  // A1, A2, ..
  std::optional<RadianceSun> sun;
  double luminance_per_value = 0;  // cd/m^2

  std::string description() const;  // one line
};

// Whether a text is such a scene.
bool is_radiance_sky(std::string_view text);

// Whether `name` is a file of such a text, which --sampling reads as it does analytic skies.
bool is_radiance_sky_file(std::string_view name);

// Throws std::invalid_argument with one line that names source, line, field, value and what was
// expected; for suns of the function, of the light and of the comments that are more than 0.25 deg
// apart, but for one above 87 deg, which both programs put there; for output that is no luminance
// (gendaylit -O 1).
RadianceSky parse_radiance_sky(std::string_view text, std::string_view source);

// cd/m^2; view_zenith < pi/2.
double radiance_sky_luminance(const RadianceSky& sky, double view_zenith, double scattering_angle);

}  // namespace skyfit::refs
