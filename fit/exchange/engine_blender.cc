// SPDX-License-Identifier: Apache-2.0
// The two scattering skies of Blender's sky texture (Blender Foundation, intern/sky): factors on
// fixed air, aerosol and ozone. Single scattering, called Nishita before Blender 5: Rayleigh
// scattering by wavelength with a scale height of 8 km, dust of 2e-5 /m with 1.2 km, an extinction
// 1.11 times that and Cornette & Shanks' g = 0.76, ozone in a tent of 25 +- 15 km. Multiple
// scattering, since Blender 5 (F. Garcia Linan): coefficients at 630, 560, 490 and 430 nm, an urban
// aerosol with a scale height of 730 m and Henyey & Greenstein's g = 0.8.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "fit/exchange/engine_files.h"
#include "model/base/text.h"

namespace skyfit::fit {
namespace {

struct BlenderSky {
  // Values of sky_type; the older one is empty where there was none before Blender 5.
  std::string_view type, older_type;
  double bottom_radius_m, top_radius_m, air_height_m, dust_height_m, tent_peak_m, tent_half_width_m,
      g;
  // At kEngineWavelengths_nm for densities of 1, 1/m at the bottom; ozone at the tip of its tent.
  Rgb air, dust, dust_absorption, ozone;
  double ground_albedo, highest_density;
};

constexpr BlenderSky kSingle = {
    .type = "SINGLE_SCATTERING",
    .older_type = "NISHITA",
    .bottom_radius_m = 6360e3,
    .top_radius_m = 6420e3,
    .air_height_m = 8000,
    .dust_height_m = 1200,
    .tent_peak_m = 25e3,
    .tent_half_width_m = 15e3,
    .g = 0.76,
    .air = {5.290e-6, 1.237e-5, 3.018e-5},
    .dust = {2e-5, 2e-5, 2e-5},
    .dust_absorption = {2.2e-6, 2.2e-6, 2.2e-6},
    .ozone = {7.353e-7, 1.819e-6, 7.310e-8},
    .ground_albedo = 0.1,    // it has none; what single scattering leaves out
    .highest_density = 10};  // before Blender 5

// Its four wavelengths by power laws between neighbours. Its profiles of air and ozone,
// exp(-0.0777 h^1.164) and one normal in the logarithm of h, are taken for the exponential and the
// tent of the same column, the tent of the same standard deviation. The shape of the ozone's
// spectrum is Hillaire's (2020), with Blender's column.
constexpr BlenderSky kMultiple = {.type = "MULTIPLE_SCATTERING",
                                  .older_type = "",
                                  .bottom_radius_m = 6371e3,
                                  .top_radius_m = 6471e3,
                                  .air_height_m = 8521,
                                  .dust_height_m = 730,
                                  .tent_peak_m = 26.2e3,
                                  .tent_half_width_m = 19.7e3,
                                  .g = 0.8,
                                  .air = {4.840e-6, 1.149e-5, 2.871e-5},
                                  .dust = {2.030e-5, 2.478e-5, 3.209e-5},
                                  .dust_absorption = {2.889e-7, 6.799e-7, 1.691e-6},
                                  .ozone = {5.65e-7, 1.636e-6, 7.39e-8},
                                  .ground_albedo = 0.3,
                                  .highest_density = 1000};

void set_densities(const BlenderSky& sky, double air, double dust, double ozone,
                   EngineAtmosphere& engine) {
  engine.bottom_radius_m = sky.bottom_radius_m;
  engine.top_radius_m = sky.top_radius_m;
  engine.rayleigh_scale_height_m = sky.air_height_m;
  engine.mie_scale_height_m = sky.dust_height_m;
  engine.tent_peak_m = sky.tent_peak_m;
  engine.tent_half_width_m = sky.tent_half_width_m;
  engine.g = sky.g;
  engine.ground_albedo.fill(sky.ground_albedo);
  for (std::size_t k = 0; k < 3; ++k) {
    engine.rayleigh_scattering[k] = air * sky.air[k];
    engine.mie_scattering[k] = dust * sky.dust[k];
    engine.mie_absorption[k] = dust * sky.dust_absorption[k];
    engine.absorption[k] = ozone * sky.ozone[k];
  }
}

// Optical depths at 550 nm stay where the densities reach.
void restrict_to(const BlenderSky& sky, EngineAtmosphere& engine) {
  const double air = engine.rayleigh_scattering[1] * engine.rayleigh_scale_height_m,
               dust = engine.mie_scattering[1] * engine.mie_scale_height_m,
               ozone = engine.absorption[1] * engine.tent_half_width_m;
  const auto density = [&](double wanted) { return std::min(wanted, sky.highest_density); };
  set_densities(sky, density(air / sky.air_height_m / sky.air[1]),
                density(dust / sky.dust_height_m / sky.dust[1]),
                density(ozone / sky.tent_half_width_m / sky.ozone[1]), engine);
}

// In Python: Blender before version 5 has another name.
std::string chosen_type(const BlenderSky& sky) {
  if (sky.older_type.empty()) return fmt::format("\"{}\"", sky.type);
  return fmt::format("\"{}\" if since_5 else \"{}\"", sky.type, sky.older_type);
}

std::string text_of(const BlenderSky& sky, const EngineAtmosphere& engine,
                    const ExportFacts& facts) {
  return fmt::format(
      R"(# Sky of the preset {}, for Blender's sky texture node. Loss: {}
# Run it in Blender's text editor; it sets the world's background.
import bpy

world = bpy.context.scene.world or bpy.data.worlds.new("Sky")
bpy.context.scene.world = world
if world.node_tree is None:
    world.use_nodes = True
nodes = world.node_tree.nodes
sky = nodes.new("ShaderNodeTexSky")
since_5 = hasattr(sky, "aerosol_density")
sky.sky_type = {}
sky.air_density = {:.6g}
aerosol_density = {:.6g}
setattr(sky, "aerosol_density" if since_5 else "dust_density", aerosol_density)
sky.ozone_density = {:.6g}
sky.altitude = 0
sky.sun_elevation = {:.9g}
sky.sun_rotation = {:.9g}
sky.sun_size = {:.9g}
background = next(node for node in nodes if node.type == "BACKGROUND")
world.node_tree.links.new(sky.outputs["Color"], background.inputs["Color"])
)",
      facts.preset, facts.loss, chosen_type(sky), engine.rayleigh_scattering[1] / sky.air[1],
      engine.mie_scattering[1] / sky.dust[1], engine.absorption[1] / sky.ozone[1],
      0.5 * std::numbers::pi - facts.sun_zenith, facts.sun_azimuth,
      2 * facts.star.angular_radius_rad());
}

// The value of sky_type; empty where the script has none.
std::string type_of(const Script& script) {
  std::string type = assigned_text(script, "sky_type");
  const std::size_t quote = type.find_first_of("\"'");
  if (quote != std::string::npos) type.erase(0, quote + 1);
  return type.substr(0, type.find_first_of("\"'"));
}

EngineAtmosphere read_densities(const BlenderSky& sky, PhaseType lobe, const Script& script,
                                std::vector<std::string>& notes) {
  const bool since_5 = is_assigned(script, "aerosol_density");
  const double highest = since_5 ? 1000 : 10;
  const double air = assigned_number(script, "air_density", highest),
               dust =
                   assigned_number(script, since_5 ? "aerosol_density" : "dust_density", highest),
               ozone = assigned_number(script, "ozone_density", highest);
  if (is_assigned(script, "altitude") && assigned_number(script, "altitude", 1e5) != 0)
    notes.push_back("altitude is not 0: a preset has no observer, see --altitude-m");
  EngineAtmosphere engine;
  engine.lobe = lobe;
  set_densities(sky, air, dust, ozone, engine);
  return engine;
}

bool is_blender(const Script& script) {
  return is_assigned(script, "air_density") || is_assigned(script, "dust_density") ||
         is_assigned(script, "aerosol_density");
}

}  // namespace

void restrict_to_blender(EngineAtmosphere& engine) { restrict_to(kSingle, engine); }

void restrict_to_blender_multiple(EngineAtmosphere& engine) { restrict_to(kMultiple, engine); }

std::string blender_text(const EngineAtmosphere& engine, const ExportFacts& facts) {
  return text_of(kSingle, engine, facts);
}

std::string blender_multiple_text(const EngineAtmosphere& engine, const ExportFacts& facts) {
  return text_of(kMultiple, engine, facts);
}

std::optional<EngineAtmosphere> read_blender(std::string_view text, std::string_view source,
                                             std::vector<std::string>& notes) {
  const Script script{text, source, "#"};
  const std::string type = type_of(script);
  if (!is_blender(script) || type == kMultiple.type) return {};
  if (type.empty())
    notes.push_back("no sky_type: taken for single scattering (Nishita before Blender 5)");
  else if (type != kSingle.type && type != kSingle.older_type)
    throw std::invalid_argument(
        fmt::format("{}: sky_type = {}: expected {}, {} or {}; the others are formulas without an "
                    "atmosphere",
                    source, printable(type), kSingle.older_type, kSingle.type, kMultiple.type));
  return read_densities(kSingle, PhaseType::kCornetteShanks, script, notes);
}

std::optional<EngineAtmosphere> read_blender_multiple(std::string_view text,
                                                      std::string_view source,
                                                      std::vector<std::string>& notes) {
  const Script script{text, source, "#"};
  if (!is_blender(script) || type_of(script) != kMultiple.type) return {};
  return read_densities(kMultiple, PhaseType::kHenyeyGreenstein, script, notes);
}

}  // namespace skyfit::fit
