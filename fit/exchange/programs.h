// SPDX-License-Identifier: Apache-2.0
// Other people's programs that take an atmosphere or its sky: one row each, from which `skyfit
// export`, `skyfit import`, their help and docs/exchange.md follow.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fit/exchange/reduction.h"
#include "model/atmosphere/preset.h"

namespace skyfit::fit {

struct ExportRequest {
  const Preset& preset;
  const SpectralData& spectra;  // under the preset's star
  Models models;
  double sun_zenith = 0, sun_azimuth = 0;  // radians, azimuth clockwise from north
  std::filesystem::path file;              // names what is written
  bool textures = false;                   // of Program::has_textures
  int threads = 1;                         // for them
  // Writes this sun's sky and ground without the disc as a .exr: equirectangular, 1024 x 512, north
  // in the middle and east to its right, linear light of sRGB's primaries in cd/m^2.
  std::function<void(const std::filesystem::path&)> write_sky_map;
  std::function<void(double)> progress = [](double) {};
};

struct WrittenFile {
  std::filesystem::path path;
  std::string text;
};

struct Exported {
  std::vector<WrittenFile> files;               // the first is the one asked for
  std::vector<std::filesystem::path> pictures;  // that are written already
  std::string loss;                             // against the preset's own sky, in words
};

struct Program {
  std::string_view name, meaning;
  std::string_view extension;
  bool has_star;       // whether what is written holds the preset's star
  bool writes_beside;  // further files beside the one that was asked for
  bool has_textures;   // that it reads in the place of computing them
  std::function<Exported(const ExportRequest&)> write;
  // Nothing when the text is another program's. Throws std::invalid_argument in one line that names
  // source, field, value and expectation. `notes`: what it says that an atmosphere does not hold.
  // Empty: `skyfit import` does not read the program.
  std::function<std::optional<Atmosphere<double>>(std::string_view text, std::string_view source,
                                                  std::vector<std::string>& notes)>
      read;
};

std::span<const Program> programs();
// Those that `skyfit import` reads.
std::vector<Program> readable_programs();

// Throws std::invalid_argument that lists the names.
const Program& program_named(std::string_view name);

// Whose parameters a text holds; null: nobody's.
const Program* program_of(std::string_view text);

// The programs that are not of engines.h. Their sources are named in each .cc.
Exported export_radiance(const ExportRequest& request);
Exported export_mitsuba(const ExportRequest& request);
Exported export_mitsuba_sunsky(const ExportRequest& request);
std::optional<Atmosphere<double>> read_mitsuba_sunsky(std::string_view text,
                                                      std::string_view source,
                                                      std::vector<std::string>& notes);
Exported export_godot(const ExportRequest& request);
Exported export_threejs(const ExportRequest& request);
std::optional<Atmosphere<double>> read_threejs(std::string_view text, std::string_view source,
                                               std::vector<std::string>& notes);
Exported export_calcmysky(const ExportRequest& request);
std::optional<Atmosphere<double>> read_calcmysky(std::string_view text, std::string_view source,
                                                 std::vector<std::string>& notes);

// Of comments: one line of plain characters, whatever the preset is called.
std::string plain_line(std::string text);

}  // namespace skyfit::fit
