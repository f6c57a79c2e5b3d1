// SPDX-License-Identifier: Apache-2.0
// three.js' object Sky (three.js from r183 on, examples/jsm/objects/Sky.js, MIT; before, a power
// 1 / 2.4 of the light came last). It is no atmosphere, so its
// own formula is fitted to the preset's sky: formula_light() with beta_R at 680, 550 and 450 nm
// times `rayleigh`, beta_M = 0.434 0.2 turbidity 1e-17 M times `mieCoefficient`, the air mass of
// Kasten (cosine + 0.15 (93.885 - zenith in deg)^-1.253) and E = 1000 (1 - exp(-(pi / 1.95 - sun
// zenith) / 1.5)); a tenth of the transmittance is added, the sum times 0.04, and a blue of the
// night.
#include <fmt/format.h>

#include "fit/exchange/engine_files.h"
#include "fit/exchange/formula_sky.h"
#include "fit/exchange/programs.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

constexpr Rgb kRayleigh = {5.804542996261093e-6, 1.3562911419845635e-5,
                           3.0265902468824876e-5};  // 1/m, of `rayleigh` 1
constexpr double kMie = 0.434 * 0.2 * 1e-17;        // of turbidity and mieCoefficient 1, times
constexpr Rgb kMieConst = {1.8399918514433978e14, 2.7798023919660528e14, 4.0790479543861094e14};
constexpr Rgb kNight = {0, 0.0003, 0.00075};
constexpr double kAirHeight = 8400, kAerosolHeight = 1250;
// Of rayleigh and of turbidity times mieCoefficient: beyond, the light is that of opaque air.
constexpr double kMostRayleigh = 100, kMostMie = 1e3;
constexpr double kTurbidity = 10;  // of the two, which act as their product alone

// ln rayleigh, ln (turbidity mieCoefficient), mieDirectionalG, ln of the cd/m^2 of its light 1.
constexpr int kCount = 4;

struct ThreejsColor {
  template <class T>
  T operator()(const std::array<T, kCount>& x, std::size_t channel, const SkyPoint& p) const {
    using std::exp;
    const FormulaAir<T> air{exp(x[0]) * kRayleigh[channel], exp(x[1]) * kMie * kMieConst[channel],
                            x[2]};
    const double zenith = std::min(p.view_zenith, 0.5 * std::numbers::pi),
                 mass = 1 / (std::cos(zenith) +
                             0.15 * std::pow(93.885 - zenith * kDegreesPerRadian, -1.253)),
                 energy =
                     1000 *
                     std::max(0.0, 1 - std::exp(-(std::numbers::pi / 1.95 - p.sun_zenith) / 1.5));
    const T light = formula_light(air, energy, mass, p) + 0.1 * exp(-air.depth(mass));
    return exp(x[3]) * (0.04 * light + kNight[channel]);
  }
};

}  // namespace

Exported export_threejs(const ExportRequest& request) {
  const XyzRule rule = xyz_rule(request.spectra);
  const std::vector<SkyPoint> points = six_skies();
  const std::vector<Xyz> truth =
      sky_colors(request.models.truth, rule, request.preset.atmosphere, points);
  constexpr double kInfinite = std::numeric_limits<double>::infinity(), kLeast = 1e-6;
  FormulaFit<kCount> fit{{std::log(kLeast), std::log(kLeast), -0.98, -kInfinite},
                         {std::log(kMostRayleigh), std::log(kMostMie), 0.98, kInfinite},
                         {}};
  for (const double rayleigh : {0.4, 1.5}) {
    for (const double mie : {0.003, 0.05, 0.5}) {
      for (const double g : {0.3, 0.8})
        fit.starts.push_back({std::log(rayleigh), std::log(mie), g, std::log(truth.front()[1])});
    }
  }
  const ThreejsColor color;
  const Unknowns<kCount> x = fitted(color, fit, points, linear_srgb(truth), request.progress);
  std::vector<Xyz> shown;
  for (const SkyPoint& p : points)
    shown.push_back(xyz_of_srgb({color(x, 0, p), color(x, 1, p), color(x, 2, p)}));
  const std::string loss = loss_text(color_loss(points, truth, shown));
  return {{{request.file,
            fmt::format(
                R"(// Sky of the preset {}, for three.js r183 or later. Loss: {}
// Its light 1, before tone mapping, is {:.4g} cd/m^2. North is -z.
import {{ MathUtils, REVISION }} from 'three';
import {{ Sky }} from 'three/addons/objects/Sky.js';

export function makeSky() {{
  if (parseInt(REVISION) < 183) console.warn('Before r183 Sky has another formula than these numbers are for.');
  const sky = new Sky();
  sky.scale.setScalar(450000);
  const uniforms = sky.material.uniforms;
  uniforms['turbidity'].value = {:.6g};
  uniforms['rayleigh'].value = {:.6g};
  uniforms['mieCoefficient'].value = {:.6g};
  uniforms['mieDirectionalG'].value = {:.6g};
  if (uniforms['cloudCoverage']) uniforms['cloudCoverage'].value = 0;
  uniforms['sunPosition'].value.setFromSphericalCoords(
      1, MathUtils.degToRad({:.9g}), MathUtils.degToRad({:.9g}));
  return sky;
}}
)",
                plain_line(request.preset.name), loss, std::exp(x[3]), kTurbidity, std::exp(x[0]),
                std::exp(x[1]) / kTurbidity, x[2], request.sun_zenith * kDegreesPerRadian,
                180 - request.sun_azimuth * kDegreesPerRadian)}},
          {},
          loss};
}

std::optional<Atmosphere<double>> read_threejs(std::string_view text, std::string_view source,
                                               std::vector<std::string>& notes) {
  const Script script{text, source, "//"};
  if (!is_assigned(script, "mieCoefficient") && !is_assigned(script, "mieDirectionalG")) return {};
  constexpr double kMost = 1000, kGround = 0.1;
  // Without a value the object's own.
  const double turbidity = assigned_number(script, "turbidity", kMost, 2),
               rayleigh = assigned_number(script, "rayleigh", kMost, 1),
               mie = assigned_number(script, "mieCoefficient", kMost, 0.005),
               g = assigned_number(script, "mieDirectionalG", 1, 0.8);
  if (assigned_number(script, "cloudCoverage", 1, 0) > 0)
    notes.emplace_back("cloudCoverage: the clouds of the object are not read");
  EngineAtmosphere engine;
  engine.rayleigh_scale_height_m = kAirHeight;
  engine.mie_scale_height_m = kAerosolHeight;
  for (std::size_t k = 0; k < 3; ++k) {
    const double ratio = 550 / kEngineWavelengths_nm[k];
    engine.rayleigh_scattering[k] = rayleigh * kRayleigh[1] * std::pow(ratio, 4);
    engine.mie_scattering[k] = mie * turbidity * kMie * kMieConst[1] * ratio * ratio;
    engine.ground_albedo[k] = kGround;
  }
  engine.g = g;
  notes.emplace_back(
      "the sky of three.js is a formula: the atmosphere of its coefficients has another sky");
  return atmosphere_of(engine);
}

}  // namespace skyfit::fit
