// SPDX-License-Identifier: Apache-2.0
#include "fit/exchange/programs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "fit/exchange/bruneton_textures.h"
#include "fit/exchange/engines.h"

namespace skyfit::fit {
namespace {

// Beside NAME.json: the textures as raw 32-bit floats, and NAME.textures.json that says what they
// are.
void add_textures(const EngineAtmosphere& engine, const ExportRequest& request,
                  std::vector<WrittenFile>& files) {
  const BrunetonSizes s;
  const BrunetonTextures textures =
      bruneton_textures(engine, request.preset.atmosphere.star, request.spectra, kHighestSun, s,
                        request.threads, request.progress);
  nlohmann::ordered_json json = {{"wavelengths", kEngineWavelengths_nm},
                                 {"solar_irradiance", engine_solar_irradiance(request.spectra)},
                                 {"max_sun_zenith_angle", kHighestSun},
                                 {"texel", "RGBA, 32-bit float, little-endian, x fastest"},
                                 {"scattering_mu_s", s.scattering_mu_s},
                                 {"scattering_nu", s.scattering_nu}};
  const auto add = [&](const char* name, const std::vector<float>& texels,
                       const std::vector<int>& size) {
    const auto file =
        std::filesystem::path(request.file).replace_extension(fmt::format(".{}.dat", name));
    json["textures"][name] = {{"file", file.filename().string()}, {"size", size}};
    files.push_back(
        {file, {reinterpret_cast<const char*>(texels.data()), texels.size() * sizeof(float)}});
  };
  const std::vector<int> volume = {s.scattering_nu * s.scattering_mu_s, s.scattering_mu,
                                   s.scattering_r};
  add("transmittance", textures.transmittance, {s.transmittance_mu, s.transmittance_r});
  add("irradiance", textures.irradiance, {s.irradiance_mu_s, s.irradiance_r});
  add("scattering", textures.scattering, volume);
  add("single_mie_scattering", textures.single_mie, volume);
  files.push_back({std::filesystem::path(request.file).replace_extension(".textures.json"),
                   json.dump(2) + "\n"});
}

Exported export_engine(const Engine& engine, const ExportRequest& request) {
  const Atmosphere<double>& truth = request.preset.atmosphere;
  EngineAtmosphere restricted = engine_atmosphere(engine_form(truth, request.spectra, engine.lobe));
  engine.restrict_to(restricted);
  Atmosphere<double> start = atmosphere_of(restricted);
  start.star = truth.star;
  EngineAtmosphere exported = engine_atmosphere(
      refitted(request.models, request.spectra, truth, start, engine.free(), request.progress));
  engine.restrict_to(exported);  // to the ranges of its properties
  Atmosphere<double> shown = atmosphere_of(exported);
  shown.star = truth.star;
  const ExportFacts facts{plain_line(request.preset.name),
                          loss_text(sky_loss(request.models, request.spectra, truth, shown)),
                          request.sun_zenith, request.sun_azimuth, truth.star};
  Exported result{{{request.file, engine.write(exported, facts)}}, {}, facts.loss};
  if (request.textures) add_textures(exported, request, result.files);
  return result;
}

std::vector<Program> all_programs() {
  std::vector<Program> list;
  for (const Engine& engine : engines()) {
    list.push_back({engine.name, engine.meaning, engine.extension, false, false,
                    engine.has_textures,
                    [&engine](const ExportRequest& r) { return export_engine(engine, r); },
                    [&engine](std::string_view text, std::string_view source,
                              std::vector<std::string>& notes) {
                      const auto read = engine.read(text, source, notes);
                      return read ? std::optional(atmosphere_of(*read)) : std::nullopt;
                    }});
  }
  list.push_back({"threejs", "three.js, object Sky (JavaScript)", ".js", false, false, false,
                  export_threejs, read_threejs});
  list.push_back({"radiance",
                  "Radiance, sun, sky and ground of one hour (.rad and three .dat)",
                  ".rad",
                  true,
                  true,
                  false,
                  export_radiance,
                  {}});
  list.push_back({"mitsuba",
                  "Mitsuba 3, emitters of one hour: sky map and sun (.xml and .exr)",
                  ".xml",
                  true,
                  true,
                  false,
                  export_mitsuba,
                  {}});
  list.push_back({"mitsuba-sunsky", "Mitsuba 3, emitter sunsky, and sun, of one hour (.xml)",
                  ".xml", true, false, false, export_mitsuba_sunsky, read_mitsuba_sunsky});
  list.push_back({"godot",
                  "Godot 4, resource PhysicalSkyMaterial (.tres)",
                  ".tres",
                  false,
                  false,
                  false,
                  export_godot,
                  {}});
  list.push_back({"calcmysky", "CalcMySky for Stellarium, description of the atmosphere (.atmo)",
                  ".atmo", true, false, false, export_calcmysky, read_calcmysky});
  return list;
}

}  // namespace

std::span<const Program> programs() {
  static const std::vector<Program> list = all_programs();
  return list;
}

std::vector<Program> readable_programs() {
  std::vector<Program> list;
  for (const Program& program : programs()) {
    if (program.read) list.push_back(program);
  }
  return list;
}

const Program& program_named(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Program& program : programs()) {
    if (program.name == name) return program;
    names.push_back(program.name);
  }
  throw std::invalid_argument(
      fmt::format("program \"{}\": expected one of {}", name, fmt::join(names, ", ")));
}

const Program* program_of(std::string_view text) {
  for (const Program& program : programs()) {
    if (!program.read) continue;
    std::vector<std::string> notes;
    try {
      if (program.read(text, "", notes)) return &program;
    } catch (const std::invalid_argument&) {  // its own, with something wrong
      return &program;
    }
  }
  return nullptr;
}

std::string plain_line(std::string text) {
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

}  // namespace skyfit::fit
