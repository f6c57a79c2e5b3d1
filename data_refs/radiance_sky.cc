// SPDX-License-Identifier: Apache-2.0
#include "data_refs/radiance_sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "data_refs/csv.h"
#include "data_refs/measured_sky.h"
#include "data_refs/radiance_scene.h"
#include "model/base/input_file.h"
#include "model/base/pattern.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {

using namespace radiance;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLumenPerWatt = 179;  // Radiance's white efficacy (color.h)
// Brightness of red, green and blue (Radiance, color.h).
constexpr std::array<double, 3> kBrightness = {0.265, 0.670, 0.065};

// East, north, up.
RadianceSun direction_of(const Primitive& p, std::size_t first, std::string_view source) {
  const double x = p.reals[first], y = p.reals[first + 1], z = p.reals[first + 2];
  const double length = std::hypot(x, y, z);
  constexpr double kRounding = 0.05;  // of numbers written with few digits
  if (!(std::abs(length - 1) <= kRounding)) {
    fail_at(source, p.line,
            fmt::format("{} {}: direction of the sun {:.6g} {:.6g} {:.6g}: expected a length of 1",
                        p.type, p.name, x, y, z));
  }
  return {std::atan2(std::hypot(x, y), z), std::atan2(x, y)};
}

double angle_between(const RadianceSun& a, const RadianceSun& b) {
  Sample sample;
  sample.sun_zenith = a.zenith;
  sample.view_zenith = b.zenith;
  sample.relative_azimuth = b.azimuth - a.azimuth;
  return scattering_angle(sample);
}

std::string text_of(const RadianceSun& d) {
  return fmt::format("zenith {:.2f} deg, azimuth {:.2f} deg", d.zenith * kDegreesPerRadian,
                     std::remainder(d.azimuth, 2 * kPi) * kDegreesPerRadian);
}

// Of `mu` the cosine of the view's zenith angle and `angle` that to the sun.
double clear_sky(double mu, double angle) {
  constexpr double kHorizon = 0.01;
  const double nu = std::cos(angle);
  return (0.91 + 10 * std::exp(-3 * angle) + 0.45 * nu * nu) *
         (mu > kHorizon ? 1 - std::exp(-0.32 / mu) : 1);
}

double intermediate_sky(double zenith, double sun_zenith, double angle) {
  return ((1.35 * std::sin(5.631 - 3.59 * zenith) + 3.12) * std::sin(4.396 - 2.6 * sun_zenith) +
          6.37 - zenith) /
         2.326 * std::exp(-0.563 * angle * ((2.629 - zenith) * (1.562 - sun_zenith) + 0.812));
}

// Without the ground.
double sky_value(const RadianceSky& sky, double zenith, double angle) {
  const std::vector<double>& a = sky.a;
  const double mu = std::cos(zenith), nu = std::cos(angle);
  switch (sky.formula) {
    case RadianceFormula::kPerez: {
      constexpr double kHorizon = 0.01;
      return a[0] * (1 + a[2] * std::exp(a[3] / std::max(mu, kHorizon))) *
             (1 + a[4] * std::exp(a[5] * angle) + a[6] * nu * nu);
    }
    case RadianceFormula::kClear:
      return a[1] * clear_sky(mu, angle) / a[3];
    case RadianceFormula::kIntermediate:
      return a[1] * intermediate_sky(zenith, sky.sun->zenith, angle) / a[3];
    case RadianceFormula::kOvercast:
      return a[1] * (1 + 2 * mu) / 3;
    case RadianceFormula::kUniform:
      break;
  }
  return a[1];
}

double value_of(const RadianceSky& sky, double zenith, double angle) {
  const double value = sky_value(sky, zenith, angle);
  if (sky.formula == RadianceFormula::kPerez) return value;
  const double weight = std::pow(std::cos(zenith) + 1.01, 10);
  return (weight * value + sky.a[2] / weight) / (weight + 1 / weight);
}

std::string_view meaning_of(RadianceFormula formula) {
  switch (formula) {
    case RadianceFormula::kPerez:
      return "all-weather sky of Perez, Seals & Michalsky 1993 (perezlum.cal)";
    case RadianceFormula::kClear:
      return "CIE clear sky (skybright.cal)";
    case RadianceFormula::kOvercast:
      return "CIE overcast sky (skybright.cal)";
    case RadianceFormula::kIntermediate:
      return "CIE intermediate sky (skybright.cal)";
    case RadianceFormula::kUniform:
      break;
  }
  return "uniform sky (skybright.cal)";
}

// The file of functions that a brightfunc names; empty: none of the two.
std::string_view functions_of(const Primitive& p) {
  if (p.type != "brightfunc" || p.strings.size() != 2) return "";
  for (const std::string_view file : {"perezlum.cal", "skybright.cal"}) {
    if (p.strings[1] == file) return file;
  }
  return "";
}

RadianceFormula formula_of(const Primitive& p, std::string_view source) {
  if (functions_of(p) == "perezlum.cal") return RadianceFormula::kPerez;
  const double kind = p.reals.at(0);
  if (kind == 1) return RadianceFormula::kClear;
  if (kind == 2) return RadianceFormula::kOvercast;
  if (kind == 3) return RadianceFormula::kUniform;
  if (kind == 4) return RadianceFormula::kIntermediate;
  fail_at(source, p.line,
          fmt::format("A1 = {:.9g}: expected 1 (clear), 2 (overcast), 3 (uniform) or 4 "
                      "(intermediate)",
                      kind));
}

const Primitive& sky_function(const std::vector<Primitive>& primitives, std::string_view source) {
  const Primitive* found = nullptr;
  for (const Primitive& p : primitives) {
    if (functions_of(p).empty()) continue;
    if (found != nullptr) fail_at(source, p.line, "a second sky: expected one");
    found = &p;
  }
  if (found == nullptr)
    throw std::invalid_argument(
        fmt::format("{}: expected a brightfunc of perezlum.cal or skybright.cal", source));
  if (found->reals.empty()) fail_at(source, found->line, "0 numbers: expected those of a sky");
  // An overcast or uniform sky has no sun.
  const RadianceFormula formula = formula_of(*found, source);
  const bool has_sun =
      formula != RadianceFormula::kOvercast && formula != RadianceFormula::kUniform;
  const std::size_t count = found->reals.size();
  const std::size_t wanted = formula == RadianceFormula::kPerez ? 10 : has_sun ? 7 : 3;
  if (count != wanted && (has_sun || count != 7)) {
    fail_at(source, found->line,
            fmt::format("{} numbers: expected the {} of {}", count, wanted, functions_of(*found)));
  }
  return *found;
}

// Of the comment with the command that wrote the scene: what its numbers are.
double luminance_per_value(const Scene& scene, std::string_view source) {
  static const std::regex output(R"(gendaylit\b.*\s-O\s*(\d+))");
  for (const Word& comment : scene.comments) {
    const auto match = first_match(comment.text, output);
    if (!match) continue;
    if ((*match)[1] == "2") return 1;  // luminances
    if ((*match)[1] != "0") {
      fail_at(source, comment.line,
              fmt::format("gendaylit -O {}: radiances of all wavelengths: expected -O 0 or -O 2, "
                          "whose numbers are luminances",
                          (*match)[1].str()));
    }
  }
  return kLumenPerWatt;
}

// Whether what the material `name` is on lights the lower hemisphere alone.
bool is_ground(const std::vector<Primitive>& primitives, const std::string& name) {
  constexpr double kWholeSphere_deg = 360;
  bool below = false;
  for (const Primitive& p : primitives) {
    if (p.type != "source" || p.modifier != name || p.reals.size() != 4) continue;
    if (p.reals[2] > 0 || p.reals[3] >= kWholeSphere_deg) return false;
    below = true;
  }
  return below;
}

// The brightness of the sky that the function `name` modulates, 1 where the scene has no glow of
// it.
double glow_of(const std::vector<Primitive>& primitives, const std::string& name,
               std::string_view source) {
  for (const Primitive& p : primitives) {
    if (p.type != "glow" || p.modifier != name || is_ground(primitives, p.name)) continue;
    if (p.reals.size() != 4 || std::ranges::any_of(p.reals, [](double v) { return v < 0; }))
      fail_at(source, p.line, fmt::format("glow {}: expected 4 numbers >= 0", p.name));
    double brightness = 0;
    for (std::size_t c = 0; c < 3; ++c) brightness += kBrightness[c] * p.reals[c];
    if (brightness > 0) return brightness;  // one that is black lights nothing
  }
  return 1;
}

// Azimuths of Radiance's programs count from south to west.
RadianceSun sun_at(double altitude_deg, double azimuth_deg) {
  return {(90 - altitude_deg) * kRadiansPerDegree, (180 + azimuth_deg) * kRadiansPerDegree};
}

struct StatedSun {
  RadianceSun sun;
  int line;
  std::string_view what;
};

// The suns that comments state: the command gives one (-ang), or the program tells what it computed
// from the time.
std::vector<StatedSun> suns_of_comments(const Scene& scene) {
  static const std::regex computed(R"(solar altitude and azimuth:\s*(-?[\d.]+)\s+(-?[\d.]+))",
                                   std::regex::icase),
      given(R"(gen(?:sky|daylit)\s+-ang\s+(-?[\d.]+)\s+(-?[\d.]+))");
  std::vector<StatedSun> suns;
  for (const Word& comment : scene.comments) {
    for (const auto& [pattern, what] :
         {std::pair{&computed, "solar altitude and azimuth"}, {&given, "-ang"}}) {
      const auto match = first_match(comment.text, *pattern);
      if (!match) continue;
      suns.push_back({sun_at(std::stod((*match)[1]), std::stod((*match)[2])), comment.line, what});
    }
  }
  return suns;
}

// The suns of the light and of the comments must be that of the function. gensky and gendaylit put
// a sun above 87 deg there, and say the altitude before.
void check_sun(const std::vector<Primitive>& primitives, const Scene& scene, const RadianceSun& sun,
               std::string_view source) {
  const auto expect = [&](const RadianceSun& other, int line, std::string_view what) {
    const double apart = angle_between(sun, other) * kDegreesPerRadian;
    if (apart <= kSunAgreement_deg) return;
    fail_at(source, line,
            fmt::format("{}: {}, {:.3g} deg from the sky's sun ({}): expected within {:g} deg",
                        what, text_of(other), apart, text_of(sun), kSunAgreement_deg));
  };
  constexpr double kWidest_deg = 1;  // a sky or a ground is a source of 180 deg
  for (const Primitive& p : primitives) {
    if (p.type != "source" || p.reals.size() != 4 || p.reals[3] > kWidest_deg) continue;
    expect(direction_of(p, 0, source), p.line, "source " + p.name);
  }
  constexpr double kHighest = 3 * kRadiansPerDegree, kRounding = 1e-3;
  const bool may_be_lowered = std::abs(sun.zenith - kHighest) < kRounding;
  for (StatedSun stated : suns_of_comments(scene)) {
    if (may_be_lowered) stated.sun.zenith = std::max(stated.sun.zenith, kHighest);
    expect(stated.sun, stated.line, stated.what);
  }
}

// Of the function, or where it has none of the comments.
std::optional<RadianceSun> sun_of(const Primitive& function, const Scene& scene,
                                  std::string_view source) {
  constexpr std::size_t kWithoutSun = 3;
  std::optional<RadianceSun> sun;
  int line = function.line;
  if (function.reals.size() > kWithoutSun) {
    sun = direction_of(function, function.reals.size() - 3, source);
  } else if (const std::vector<StatedSun> stated = suns_of_comments(scene); !stated.empty()) {
    sun = stated.front().sun;
    line = stated.front().line;
  }
  if (!sun) return {};
  if (!(sun->zenith >= 0 && sun->zenith < 0.5 * kPi))
    fail_at(source, line, fmt::format("sun {}: expected a sun above the horizon", text_of(*sun)));
  sun->azimuth = std::fmod(sun->azimuth + 4 * kPi, 2 * kPi);
  return sun;
}

}  // namespace

std::string RadianceSky::description() const {
  return fmt::format("Radiance: {}{}", meaning_of(formula), sun ? ", sun " + text_of(*sun) : "");
}

bool is_radiance_sky(std::string_view text) {
  const auto has = [&](std::string_view word) { return text.find(word) != text.npos; };
  return has("brightfunc") && (has("perezlum.cal") || has("skybright.cal"));
}

bool is_radiance_sky_file(std::string_view name) {
  constexpr std::size_t kMostBytes = 1 << 20;  // of a scene that holds a sky and little else
  const std::filesystem::path file(name);
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none) ||
      std::filesystem::file_size(file, none) > kMostBytes)
    return false;
  return is_radiance_sky(read_text_file(file, "a measured sky or a scene of Radiance"));
}

RadianceSky parse_radiance_sky(std::string_view text, std::string_view source) {
  const Scene scene = scene_of(text);
  const std::vector<Primitive> primitives = primitives_of(scene, source);
  const Primitive& function = sky_function(primitives, source);
  const RadianceSky sky{
      formula_of(function, source), function.reals, sun_of(function, scene, source),
      luminance_per_value(scene, source) * glow_of(primitives, function.name, source)};
  if (sky.sun) check_sun(primitives, scene, *sky.sun, source);
  return sky;
}

double radiance_sky_luminance(const RadianceSky& sky, double view_zenith, double scattering_angle) {
  return sky.luminance_per_value * value_of(sky, view_zenith, scattering_angle);
}

}  // namespace skyfit::refs
