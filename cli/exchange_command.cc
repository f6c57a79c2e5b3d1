// SPDX-License-Identifier: Apache-2.0
// `skyfit export` and `skyfit import`: presets as the parameters of other people's programs.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "data_refs/spectra.h"
#include "fit/exchange/programs.h"
#include "model/base/input_file.h"
#include "model/base/whole_file.h"
#include "model/registry.h"
#include "render/sky_map/sky_map.h"

namespace skyfit::cli {
namespace {

struct ExportArguments {
  std::string preset, to, out, sun_zenith = "40", sun_azimuth = "180";
  bool textures = false;
  int threads = default_threads();
};

void run_export(const ExportArguments& arguments) {
  const fit::Program* program = nullptr;
  try {
    program = &fit::program_named(arguments.to);
  } catch (const std::invalid_argument& unknown) {
    throw UsageError("--to", arguments.to, unknown.what());
  }
  if (arguments.textures && !program->has_textures)
    throw UsageError("--textures", "true", "expected --to bruneton");
  // What a program reads has one extension, so that "-" alone says what goes to stdout.
  const std::string out =
      arguments.out == "-" ? fmt::format("-{}", program->extension) : arguments.out;
  if (is_stdout(out) && (program->writes_beside || arguments.textures))
    throw UsageError("--out", arguments.out, "expected a file: others are written beside it");
  require_output_files({out}, {std::string(program->extension)});
  const double sun_zenith = parse_angle("--sun-zenith-deg", arguments.sun_zenith, 0, 90),
               sun_azimuth = parse_angle("--sun-azimuth-deg", arguments.sun_azimuth, -360, 360);
  const Preset preset = preset_named(arguments.preset);
  if (std::ranges::none_of(preset.atmosphere.constituents, scatters<double>)) {
    throw std::invalid_argument(fmt::format(
        "{}: no constituent scatters light: there is no sky to export", arguments.preset));
  }
  const Star& star = preset.atmosphere.star;
  if (!program->has_star && (star.spectrum != StarSpectrum::kSolar || star.distance_au != 1))
    warn(fmt::format("{}: its star is not written: {} has the sun's light at 1 au",
                     arguments.preset, program->name));
  const SpectralData spectra = refs::spectral_data_of(preset.atmosphere);
  const auto truth = make_sky_model("reference", spectra, arguments.threads),
             scalar = make_sky_model("reference", spectra, arguments.threads, Transfer::kScalar);
  Progress progress("exporting for " + std::string(program->name));
  const auto write_map = [&](const std::filesystem::path& file) {
    constexpr int kRows = 512;
    SkyMapOptions options;
    options.sun_zenith = sun_zenith;
    options.sun_azimuth = sun_azimuth;
    options.sun_disc = false;
    write_sky_map(sky_map(*truth, preset.atmosphere, xyz_channels(spectra),
                          *make_map_projection("equirectangular", kRows), options),
                  Primaries::kRec709, file);
  };
  const fit::ExportRequest request{
      .preset = preset,
      .spectra = spectra,
      .models = {*truth, *scalar},
      .sun_zenith = sun_zenith,
      .sun_azimuth = sun_azimuth,
      .file = out,
      .textures = arguments.textures,
      .threads = arguments.threads,
      .write_sky_map = write_map,
      .progress = [&](double done) { progress.show(done, "parameters"); }};
  const fit::Exported exported = program->write(request);
  for (const fit::WrittenFile& file : exported.files) write_whole_file(file.path, file.text);
  for (std::size_t i = 1; i < exported.files.size(); ++i)
    print(fmt::format("{}\n", exported.files[i].path.string()));
  for (const std::filesystem::path& picture : exported.pictures)
    print(fmt::format("{}\n", picture.string()));
  print(fmt::format("{}: {} of the preset {}\nloss by what it cannot hold: {}\n", out,
                    program->meaning, preset.name, exported.loss));
}

struct ImportFileArguments {
  std::string file, out;
};

void run_import(const ImportFileArguments& arguments) {
  constexpr std::size_t kMostBytes = 1 << 20;
  if (!arguments.out.empty()) require_output_files({arguments.out}, {".json"});
  constexpr std::string_view kExpected = "the parameters of another program";
  const bool piped = arguments.file == "-";
  const std::string file = piped ? "stdin" : arguments.file,
                    text = piped ? read_stdin(kExpected, kMostBytes)
                                 : read_file(arguments.file, kExpected, kMostBytes);
  for (const fit::Program& program : fit::readable_programs()) {
    std::vector<std::string> notes;
    const auto read = program.read(text, file, notes);
    if (!read) continue;
    Preset preset{std::string(program.name), *read, nullptr,
                  fmt::format("Imported from {}", program.meaning)};
    try {
      validate(preset.atmosphere);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("{}: as a preset: {}", file, error.what()));
    }
    const std::string json = preset_to_json(preset);
    for (const std::string& note : notes) warn(fmt::format("{}: {}", file, note));
    if (arguments.out.empty()) return print(json);
    return write_whole_file(arguments.out, json);
  }
  throw std::invalid_argument(
      fmt::format("{}: not recognised, expected the parameters of one of the programs that `skyfit "
                  "import --help` lists",
                  file));
}

}  // namespace

void add_export_command(CLI::App& app) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App& command = *app.add_subcommand(
      "export", "Writes a preset, or its sky, for another program, and what is lost.");
  command.add_option("preset", arguments->preset, "Shipped preset or preset file")
      ->required()
      ->type_name("PRESET");
  command.add_option("--to", arguments->to, "The program, see below")
      ->required()
      ->type_name("NAME");
  command
      .add_option("--out", arguments->out,
                  "The file, or - for stdout; what belongs to it is written beside it")
      ->required()
      ->type_name("FILE");
  command.add_option("--sun-zenith-deg", arguments->sun_zenith, "Zenith angle of its sun, 0 to 90")
      ->type_name("ANGLE")
      ->capture_default_str();
  command
      .add_option("--sun-azimuth-deg", arguments->sun_azimuth,
                  "Azimuth of its sun, clockwise from north")
      ->type_name("ANGLE")
      ->capture_default_str();
  command.add_flag(
      "--textures", arguments->textures,
      "With --to bruneton: also the four textures of its shaders, filled by skyfit's own solver");
  add_threads_option(command, arguments->threads);
  command.footer(
      "Programs:\n" + named_lines(fit::programs()) +
      "\nRadiance and Mitsuba get the sky of the sun that the options state, with its ground and "
      "its beam\n"
      "(mitsuba-sunsky: a formula fitted to that sky, and no ground).\n"
      "The others get the atmosphere. What they cannot hold (a second lobe, layers, heights that "
      "are fixed, a\n"
      "spectrum) is refitted to the preset's sky by the model reference, without polarisation, "
      "which such\n"
      "programs leave out. What remains is stated as the loss; the program's own approximations "
      "come on top.\n"
      "\n"
      "Examples:\n"
      "  skyfit export fitted/preset.json --to unreal --out sky.json\n"
      "  skyfit export earth-clear --to radiance --sun-zenith-deg 60 --sun-azimuth-deg 120 --out "
      "sky.rad");
  command.callback([arguments] { run_export(*arguments); });
}

void add_import_command(CLI::App& app) {
  const auto arguments = std::make_shared<ImportFileArguments>();
  CLI::App& command =
      *app.add_subcommand("import", "Reads the parameters of another program as a preset.");
  command.add_option("file", arguments->file, "The parameters")->required()->type_name("FILE");
  command.add_option("--out", arguments->out, "The preset; by default it is printed")
      ->type_name("FILE.json");
  command.footer("Programs, recognised by what the file holds:\n" +
                 named_lines(fit::readable_programs()) +
                 "\nExample: skyfit import sky.json --out preset.json");
  command.callback([arguments] { run_import(*arguments); });
}

}  // namespace skyfit::cli
