// SPDX-License-Identifier: Apache-2.0
// three.js' object Sky (three.js, examples/jsm/objects/Sky.js, after Preetham, Shirley & Smits
// 1999): Rayleigh scattering by 680, 550 and 450 nm over 8.4 km times `rayleigh`; Mie scattering
// 0.434 0.2 turbidity 1e-17 M, M as lambda^-2, over 1.25 km times `mieCoefficient`; Henyey &
// Greenstein's lobe; no ozone. Its brightness has no unit.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/exchange/engine_files.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

constexpr double kRayleigh = 1.3562911419845635e-5;                   // 1/m at 550 nm
constexpr double kMie = 0.434 * 0.2 * 1e-17 * 2.7798023919660528e14;  // of turbidity 1, at 550 nm
constexpr double kAirHeight = 8400, kAerosolHeight = 1250;
constexpr double kGround = 0.1;  // it has none

}  // namespace

void restrict_to_threejs(EngineAtmosphere& engine) {
  const double air = engine.rayleigh_scattering[1] * engine.rayleigh_scale_height_m,
               aerosol = engine.mie_scattering[1] * engine.mie_scale_height_m;
  engine.rayleigh_scale_height_m = kAirHeight;
  engine.mie_scale_height_m = kAerosolHeight;
  for (std::size_t k = 0; k < 3; ++k) {
    const double ratio = 550 / kEngineWavelengths_nm[k];
    engine.rayleigh_scattering[k] = air / kAirHeight * std::pow(ratio, 4);
    engine.mie_scattering[k] = aerosol / kAerosolHeight * ratio * ratio;
    engine.mie_absorption[k] = engine.absorption[k] = 0;
    engine.ground_albedo[k] = kGround;
  }
}

std::string threejs_text(const EngineAtmosphere& engine, const ExportFacts& facts) {
  const double turbidity = 1 + engine.mie_scattering[1] * engine.mie_scale_height_m /
                                   (engine.rayleigh_scattering[1] * engine.rayleigh_scale_height_m);
  return fmt::format(
      R"(// Sky of the preset {}, for three.js. Loss: {}
import {{ MathUtils, Vector3 }} from 'three';
import {{ Sky }} from 'three/addons/objects/Sky.js';

export function makeSky() {{
  const sky = new Sky();
  sky.scale.setScalar(450000);
  const uniforms = sky.material.uniforms;
  uniforms['turbidity'].value = {:.6g};
  uniforms['rayleigh'].value = {:.6g};
  uniforms['mieCoefficient'].value = {:.6g};
  uniforms['mieDirectionalG'].value = {:.6g};
  uniforms['sunPosition'].value.setFromSphericalCoords(
      1, MathUtils.degToRad({:.9g}), MathUtils.degToRad({:.9g}));
  return sky;
}}
)",
      facts.preset, facts.loss, turbidity, engine.rayleigh_scattering[1] / kRayleigh,
      engine.mie_scattering[1] / (kMie * turbidity), engine.g, facts.sun_zenith * kDegreesPerRadian,
      180 - facts.sun_azimuth * kDegreesPerRadian);
}

std::optional<EngineAtmosphere> read_threejs(std::string_view text, std::string_view source,
                                             std::vector<std::string>&) {
  const Script script{text, source, "//"};
  if (!is_assigned(script, "mieCoefficient") && !is_assigned(script, "mieDirectionalG")) return {};
  constexpr double kMost = 1000;
  const double turbidity = assigned_number(script, "turbidity", kMost),
               rayleigh = assigned_number(script, "rayleigh", kMost),
               mie = assigned_number(script, "mieCoefficient", kMost),
               g = assigned_number(script, "mieDirectionalG", 1);
  EngineAtmosphere engine;
  engine.rayleigh_scattering = {0, rayleigh * kRayleigh, 0};
  engine.rayleigh_scale_height_m = kAirHeight;
  engine.mie_scattering = {0, mie * turbidity * kMie, 0};
  engine.mie_scale_height_m = kAerosolHeight;
  engine.g = g;
  restrict_to_threejs(engine);
  return engine;
}

}  // namespace skyfit::fit
