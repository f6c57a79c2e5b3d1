// SPDX-License-Identifier: Apache-2.0
// Godot 4's PhysicalSkyMaterial (class reference; scene/resources/3d/sky_material.cpp, sky shader,
// after three.js and Preetham, Shirley & Smits 1999). It is no atmosphere, so its own formula is
// fitted to the preset's sky: L = formula_light() with beta_R = 1e-4 rayleigh_coefficient
// rayleigh_color and beta_M = 4.34e-4 turbidity mie_coefficient mie_color (linear colours), the air
// mass 1 / (c + 0.15 (3.885 + 54.5 c)^-1.253) at the view's cosine c and E = 0.757 mu_s times the
// light's energy; the colour is energy_multiplier L^(1 / 2.4). Below the horizon L is that of the
// horizon times ground_color.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "fit/exchange/formula_sky.h"
#include "fit/exchange/programs.h"
#include "model/atmosphere/ground_spectrum.h"
#include "model/numerics/angles.h"
#include "model/photometry/srgb_transfer.h"

namespace skyfit::fit {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRayleighUnit = 1e-4, kMieUnit = 4.34e-4;  // 1/m
constexpr double kGamma = 1 / 2.4;

// ln beta_R, ln beta_M (red, green, blue), g, ln energy_multiplier per cd/m^2.
constexpr int kCount = 8;

// L of a channel.
template <class T>
T light(const std::array<T, kCount>& x, std::size_t channel, const SkyPoint& p) {
  using std::exp;
  const double c = std::max(std::cos(p.view_zenith), 0.0);
  return formula_light(FormulaAir<T>{exp(x[channel]), exp(x[3 + channel]), x[6]},
                       0.757 * std::max(std::cos(p.sun_zenith), 0.0),
                       1 / (c + 0.15 * std::pow(3.885 + 54.5 * c, -1.253)), p);
}

struct GodotColor {
  template <class T>
  T operator()(const std::array<T, kCount>& x, std::size_t channel, const SkyPoint& p) const {
    using std::exp, std::pow;
    return exp(x[7]) * pow(light(x, channel, p), kGamma);
  }
};

FormulaFit<kCount> fit_of(double brightness) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  FormulaFit<kCount> fit;
  // The ranges of the properties in the editor; turbidity is at most 1000, mie_coefficient 1.
  for (std::size_t k = 0; k < 3; ++k) {
    fit.lower[k] = std::log(kRayleighUnit * 1e-4);
    fit.upper[k] = std::log(kRayleighUnit * 64);
    fit.lower[3 + k] = std::log(kMieUnit * 1e-4);
    fit.upper[3 + k] = std::log(kMieUnit * 1000);
  }
  fit.lower[6] = -0.98;
  fit.upper[6] = 0.98;
  fit.lower[7] = -kInfinite;
  fit.upper[7] = kInfinite;
  for (const double mie : {0.05, 0.5, 5.0}) {
    for (const double g : {0.3, 0.7}) {
      Unknowns<kCount>& start = fit.starts.emplace_back();
      const Rgb air = {0.15, 0.3, 0.7};  // about those of the engine's defaults
      for (std::size_t k = 0; k < 3; ++k) {
        start[k] = std::log(kRayleighUnit * air[k]);
        start[3 + k] = std::log(kMieUnit * mie);
      }
      start[6] = g;
      start[7] = std::log(brightness);
    }
  }
  return fit;
}

std::string color_text(const Rgb& linear) {
  return fmt::format("Color({:.6g}, {:.6g}, {:.6g}, 1)", srgb_encoded(linear[0]),
                     srgb_encoded(linear[1]), srgb_encoded(linear[2]));
}

// Coefficients as a number and a colour whose largest channel is 1.
struct Split {
  double amount;
  Rgb color;
};
Split split_color(const Unknowns<kCount>& x, std::size_t first, double unit) {
  Rgb beta;
  for (std::size_t k = 0; k < 3; ++k) beta[k] = std::exp(x[first + k]) / unit;
  const double most = std::ranges::max(beta);
  for (double& b : beta) b /= most;
  return {most, beta};
}

}  // namespace

Exported export_godot(const ExportRequest& request) {
  const XyzRule rule = xyz_rule(request.spectra);
  const Atmosphere<double>& a = request.preset.atmosphere;
  const SkyValues sun = request.models.truth.irradiance(a, rule.nodes, 0, request.sun_zenith, {});
  const std::vector<double> ones(rule.nodes.size(), 1);
  const double beam = irradiance_color(sun, kDirectNormal, rule, ones)[1];  // lx
  if (!(beam > 0))
    throw std::invalid_argument(
        "the sun gives no light at this zenith angle: Godot's light has energy 1, expected a "
        "higher sun");

  const std::vector<SkyPoint> points = six_skies();
  const std::vector<Xyz> truth = sky_colors(request.models.truth, rule, a, points);
  const GodotColor color;
  const Unknowns<kCount> x =
      fitted(color, fit_of(truth.front()[1]), points, linear_srgb(truth), request.progress);
  std::vector<Xyz> shown;
  for (const SkyPoint& p : points)
    shown.push_back(xyz_of_srgb({color(x, 0, p), color(x, 1, p), color(x, 2, p)}));
  const std::string loss = loss_text(color_loss(points, truth, shown));

  // The ground of this sun, seen across the sun's azimuth.
  std::vector<double> reflected;
  for (const WavelengthNode& node : rule.nodes)
    reflected.push_back(ground_albedo_at(a, node.wavelength_nm) / kPi);
  const Rgb ground_light = linear_srgb(irradiance_color(sun, kGlobalHorizontal, rule, reflected));
  Rgb ground{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double horizon = light(x, k, {0, request.sun_zenith, 0.5 * kPi, 0.5 * kPi});
    const double seen = std::pow(std::max(ground_light[k], 0.0) / std::exp(x[7]), 1 / kGamma);
    ground[k] = horizon > 0 ? std::min(seen / horizon, 1.0) : 0;
  }
  constexpr double kMostEnergy = 128;  // its range
  const double energy = std::exp(x[7]) * kPi / beam;
  if (energy > kMostEnergy)
    throw std::invalid_argument(fmt::format(
        "the direct light of this sun is {:.3g} lx: beside a light of energy 1 Godot's sky wants "
        "an "
        "energy_multiplier of {:.3g}, expected at most {:g}, as of a higher sun or thinner air",
        beam, energy, kMostEnergy));
  const Split rayleigh = split_color(x, 0, kRayleighUnit), mie = split_color(x, 3, kMieUnit);
  constexpr double kMieCoefficient = 0.005, kMostTurbidity = 1000;  // its default, its range
  const double mie_coefficient = std::max(kMieCoefficient, mie.amount / kMostTurbidity);
  return {
      {{request.file, fmt::format(
                          R"([gd_resource type="PhysicalSkyMaterial" format=3]

; Sky of the preset {}, for Godot 4. Loss: {}
; Of a DirectionalLight3D with light_energy 1, whose direct light is then {:.4g} lx, and
; light_angular_distance {:.4g}, which gives the sun's disc its size.
[resource]
rayleigh_coefficient = {:.6g}
rayleigh_color = {}
mie_coefficient = {:.6g}
mie_eccentricity = {:.6g}
mie_color = {}
turbidity = {:.6g}
sun_disk_scale = 1.0
ground_color = {}
energy_multiplier = {:.6g}
)",
                          plain_line(request.preset.name), loss, beam,
                          2 * a.star.angular_radius_rad() * kDegreesPerRadian, rayleigh.amount,
                          color_text(rayleigh.color), mie_coefficient, x[6], color_text(mie.color),
                          mie.amount / mie_coefficient, color_text(ground), energy)}},
      {},
      loss};
}

}  // namespace skyfit::fit
