// SPDX-License-Identifier: Apache-2.0
// `skyfit tables`: look-up tables of a preset for other people's renderers, and what tables cost.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/table_options.h"
#include "data_refs/spectra.h"
#include "model/base/whole_file.h"
#include "model/tables/table_precision.h"
#include "render/engine/engine_tables.h"
#include "render/engine/table_errors.h"

namespace skyfit::cli {
namespace {

struct TablesArguments {
  std::string preset, out, format = "dds", precision = "half", size = "small", primaries = "rec709";
  bool force = false, measure = false;
  int threads = default_threads();
};

constexpr double kPercent = 100, kMegabyte = 1e-6;

std::string error_text(const LuminanceError& error) {
  if (error.compared == 0) return "there is no light";
  return fmt::format("{:.2f} % rms, {:.2f} % at worst", kPercent * error.rms,
                     kPercent * error.worst);
}

// A column of --measure.
std::string percent_text(const LuminanceError& error, double LuminanceError::*of) {
  return error.compared == 0 ? "no light" : fmt::format("{:.2f}", kPercent * error.*of);
}

AtmosphereTables tables_of(const Preset& preset, const SpectralData& spectra,
                           const TableSizes& sizes, int threads) {
  Progress progress("tables");
  return compute_tables(preset.atmosphere, color_rule(spectra), sizes, threads,
                        [&](double done) { progress.show(done, preset.name); });
}

void write(const TablesArguments& arguments, const Preset& preset, const SpectralData& spectra) {
  const TableFormatEntry& format = entry_named("--format", arguments.format, table_formats());
  const TablePrecision precision = parse_table_precision("--precision", arguments.precision);
  if (precision == TablePrecision::k8Bit)
    throw UsageError("--precision", arguments.precision, "expected float or half for files");
  const Primaries primaries = parse_primaries(arguments.primaries);
  const TableSizes sizes = parse_table_sizes("--size", arguments.size);
  const WholeDirectory directory(arguments.out, engine_file_names(), arguments.force);
  const AtmosphereTables tables = tables_of(preset, spectra, sizes, arguments.threads);
  const EngineTables engine = engine_tables(preset, tables, precision, primaries);
  directory.publish(
      [&](const std::filesystem::path& staging) { write_engine_tables(engine, format, staging); });
  std::size_t bytes = 0;
  for (const EngineTable& table : engine.tables) {
    const EncodedTable& texels = table.texels;
    print(fmt::format("{}/{}.{}: {} x {} x {}, {}\n", arguments.out, table.name, format.name,
                      texels.width, texels.height, texels.depth,
                      texels.precision == TablePrecision::kHalf ? "half" : "float"));
    bytes += texels.texels.size();
  }
  print(fmt::format("{0}/tables.json, {0}/sky.glsl, {0}/sky.hlsl\n", arguments.out));
  const TableErrors errors =
      errors_against_reference(in_precision(tables, precision), spectra, arguments.threads);
  print(fmt::format(
      "memory of the textures: {:.3g} MB\n"
      "error of the luminance of the sky from the ground, against `skyfit sky`:\n"
      "  suns 0 to 88 deg: {}\n"
      "  suns 90 to 96 deg: {}\n",
      kMegabyte * static_cast<double>(bytes), error_text(errors.day), error_text(errors.twilight)));
}

void measure(const TablesArguments& arguments, const Preset& preset, const SpectralData& spectra) {
  print(fmt::format(
      "Tables of the preset {} against those of full size in float: memory, and "
      "errors of luminance in percent,\nrms and worst, of the sky by day (suns 0 to "
      "88 deg), of the sky in twilight (90 to 96 deg), and of the light\nof 2 and 20 "
      "km of air before the ground.\n\n"
      "{:<8} {:<9} {:>9}   {:>7} {:>7}   {:>8} {:>7}   {:>7} {:>7}\n",
      preset.name, "size", "precision", "MB", "day", "worst", "twilight", "worst", "air", "worst"));
  const AtmosphereTables full =
      tables_of(preset, spectra, table_sizes().front().sizes, arguments.threads);
  for (const TableSizesEntry& size : table_sizes()) {
    const AtmosphereTables tables = &size == &table_sizes().front()
                                        ? full
                                        : tables_of(preset, spectra, size.sizes, arguments.threads);
    for (const TablePrecisionEntry& precision : table_precisions()) {
      const TableErrors errors =
          errors_against_tables(in_precision(tables, precision.precision), full);
      print(fmt::format("{:<8} {:<9} {:>9.1f}   {:>7} {:>7}   {:>8} {:>7}   {:>7} {:>7}\n",
                        size.name, precision.name,
                        kMegabyte * static_cast<double>(table_bytes(tables, precision.precision)),
                        percent_text(errors.day, &LuminanceError::rms),
                        percent_text(errors.day, &LuminanceError::worst),
                        percent_text(errors.twilight, &LuminanceError::rms),
                        percent_text(errors.twilight, &LuminanceError::worst),
                        percent_text(errors.in_scatter, &LuminanceError::rms),
                        percent_text(errors.in_scatter, &LuminanceError::worst)));
    }
  }
}

void run_tables(const TablesArguments& arguments, const CLI::App& command) {
  if (arguments.out.empty() != arguments.measure)
    throw UsageError("--out", arguments.out, "expected a directory, or --measure alone");
  for (const char* option : {"--format", "--precision", "--size", "--primaries", "--force"}) {
    if (arguments.measure && command.count(option) > 0)
      throw UsageError(option, command.get_option(option)->results().front(),
                       "expected without --measure, which measures every size and precision");
  }
  const Preset preset = preset_named(arguments.preset);
  const SpectralData spectra = refs::spectral_data_of(preset.atmosphere);
  if (arguments.measure) return measure(arguments, preset, spectra);
  write(arguments, preset, spectra);
}

}  // namespace

void add_tables_command(CLI::App& app) {
  const auto arguments = std::make_shared<TablesArguments>();
  CLI::App& command = *app.add_subcommand(
      "tables", "Writes the renderer's look-up tables for an engine, with GLSL and HLSL.");
  const auto option = [&](const char* name, std::string& value, const char* meaning,
                          const char* type) {
    return command.add_option(name, value, meaning)->type_name(type)->capture_default_str();
  };
  option("preset", arguments->preset, "Shipped preset or preset file", "PRESET")->required();
  option("--out", arguments->out, "Directory of the tables, tables.json, sky.glsl and sky.hlsl",
         "DIR");
  option("--format", arguments->format, "Of the tables, see below",
         names_of(table_formats()).c_str());
  option("--precision", arguments->precision, "Of the tables of scattered light", "float|half");
  option("--size", arguments->size, "Texels of the tables, see below",
         names_of(table_sizes()).c_str());
  option("--primaries", arguments->primaries, "In which the shaders return light",
         "rec709|rec2020|xyz");
  command.add_flag("--measure", arguments->measure,
                   "Print memory and error of every size and precision; writes nothing");
  command.add_flag("--force", arguments->force, "Write into a directory that has other files");
  add_threads_option(command, arguments->threads);
  command.footer(
      "Formats:\n" + named_lines(table_formats()) + "\nSizes:\n" + named_lines(table_sizes()) +
      "\nThe tables hold light at four wavelengths; the shaders return luminance in cd/m^2 and "
      "illuminance in lx,\n"
      "in linear colours. docs/tables.md says how an engine reads them.\n"
      "\n"
      "Examples:\n"
      "  skyfit tables earth-clear --out sky\n"
      "  skyfit tables fitted/preset.json --format ktx2 --precision float --size full --out sky\n"
      "  skyfit tables earth-hazy --measure");
  command.callback([arguments, &command] { run_tables(*arguments, command); });
}

}  // namespace skyfit::cli
