// SPDX-License-Identifier: Apache-2.0
// Blender's sky texture of the Nishita type: factors on fixed air, dust and ozone (Blender
// Foundation, intern/sky: Rayleigh scattering by wavelength with a scale height of 8 km, dust of
// 2e-5 /m with 1.2 km, an extinction 1.11 times that and Cornette & Shanks' g = 0.76, ozone in a
// tent of 25 +- 15 km, radii of 6360 and 6420 km, single scattering).
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "fit/exchange/engine_files.h"

namespace skyfit::fit {
namespace {

constexpr Rgb kAir = {5.290e-6, 1.237e-5, 3.018e-5};    // 1/m at 680, 550, 440 nm
constexpr Rgb kOzone = {7.353e-7, 1.819e-6, 7.310e-8};  // at the tip
constexpr double kDust = 2e-5, kDustExtinction = 1.11, kDustG = 0.76;
constexpr double kGround = 0.1;  // it has none; what single scattering leaves out
constexpr double kHighest = 10;  // of a density

double density(double factor) { return std::min(factor, kHighest); }

}  // namespace

void restrict_to_blender(EngineAtmosphere& engine) {
  const double air = engine.rayleigh_scattering[1] * engine.rayleigh_scale_height_m,
               dust = engine.mie_scattering[1] * engine.mie_scale_height_m,
               ozone = engine.absorption[1] * engine.tent_half_width_m;
  engine.bottom_radius_m = 6360e3;
  engine.top_radius_m = 6420e3;
  engine.rayleigh_scale_height_m = 8000;
  engine.mie_scale_height_m = 1200;
  engine.tent_peak_m = 25e3;
  engine.tent_half_width_m = 15e3;
  engine.g = kDustG;
  engine.ground_albedo.fill(kGround);
  for (std::size_t k = 0; k < 3; ++k) {
    engine.rayleigh_scattering[k] = density(air / 8000 / kAir[1]) * kAir[k];
    engine.mie_scattering[k] = density(dust / 1200 / kDust) * kDust;
    engine.mie_absorption[k] = (kDustExtinction - 1) * engine.mie_scattering[k];
    engine.absorption[k] = density(ozone / 15e3 / kOzone[1]) * kOzone[k];
  }
}

std::string blender_text(const EngineAtmosphere& engine, const ExportFacts& facts) {
  return fmt::format(
      R"(# Sky of the preset {}, for Blender's sky texture node. Loss: {}
# Run it in Blender's text editor; it sets the world's background.
import bpy

world = bpy.context.scene.world or bpy.data.worlds.new("Sky")
bpy.context.scene.world = world
world.use_nodes = True
sky = world.node_tree.nodes.new("ShaderNodeTexSky")
sky.sky_type = "NISHITA"
sky.air_density = {:.6g}
sky.dust_density = {:.6g}
sky.ozone_density = {:.6g}
sky.altitude = 0
sky.sun_elevation = {:.9g}
sky.sun_rotation = {:.9g}
sky.sun_size = {:.9g}
background = world.node_tree.nodes["Background"]
world.node_tree.links.new(sky.outputs["Color"], background.inputs["Color"])
)",
      facts.preset, facts.loss, engine.rayleigh_scattering[1] / kAir[1],
      engine.mie_scattering[1] / kDust, engine.absorption[1] / kOzone[1],
      0.5 * std::numbers::pi - facts.sun_zenith, facts.sun_azimuth,
      2 * facts.star.angular_radius_rad());
}

std::optional<EngineAtmosphere> read_blender(std::string_view text, std::string_view source,
                                             std::vector<std::string>& notes) {
  const Script script{text, source, "#"};
  if (!is_assigned(script, "air_density") && !is_assigned(script, "dust_density")) return {};
  const double air = assigned_number(script, "air_density", kHighest),
               dust = assigned_number(script, "dust_density", kHighest),
               ozone = assigned_number(script, "ozone_density", kHighest);
  if (is_assigned(script, "altitude") && assigned_number(script, "altitude", 6e4) != 0)
    notes.push_back("altitude is not 0: a preset has no observer, see --altitude-m");
  EngineAtmosphere engine;
  engine.lobe = PhaseType::kCornetteShanks;
  engine.rayleigh_scattering = {0, air * kAir[1], 0};
  engine.rayleigh_scale_height_m = 8000;
  engine.mie_scattering = {0, dust * kDust, 0};
  engine.mie_scale_height_m = 1200;
  engine.absorption = {0, ozone * kOzone[1], 0};
  restrict_to_blender(engine);
  return engine;
}

}  // namespace skyfit::fit
