// SPDX-License-Identifier: Apache-2.0
#include "fit/exchange/programs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "fit/exchange/engines.h"

namespace skyfit::fit {
namespace {

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
  return {{{request.file, engine.write(exported, facts)}}, {}, facts.loss};
}

std::vector<Program> all_programs() {
  std::vector<Program> list;
  for (const Engine& engine : engines()) {
    list.push_back({engine.name, engine.meaning, engine.extension, false, false,
                    [&engine](const ExportRequest& r) { return export_engine(engine, r); },
                    [&engine](std::string_view text, std::string_view source,
                              std::vector<std::string>& notes) {
                      const auto read = engine.read(text, source, notes);
                      return read ? std::optional(atmosphere_of(*read)) : std::nullopt;
                    }});
  }
  list.push_back({"threejs", "three.js, object Sky (JavaScript)", ".js", false, false,
                  export_threejs, read_threejs});
  list.push_back({"radiance",
                  "Radiance, sun, sky and ground of one hour (.rad and three .dat)",
                  ".rad",
                  true,
                  true,
                  export_radiance,
                  {}});
  list.push_back({"mitsuba",
                  "Mitsuba 3, emitters of one hour: sky map and sun (.xml and .exr)",
                  ".xml",
                  true,
                  true,
                  export_mitsuba,
                  {}});
  list.push_back({"godot",
                  "Godot 4, resource PhysicalSkyMaterial (.tres)",
                  ".tres",
                  false,
                  false,
                  export_godot,
                  {}});
  list.push_back({"calcmysky", "CalcMySky for Stellarium, description of the atmosphere (.atmo)",
                  ".atmo", true, false, export_calcmysky, read_calcmysky});
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
