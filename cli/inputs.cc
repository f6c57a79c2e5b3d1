// SPDX-License-Identifier: Apache-2.0
#include "cli/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <thread>

#include "cli/arguments.h"
#include "cli/output.h"
#include "data_refs/irradiance.h"
#include "data_refs/joint_reference.h"
#include "data_refs/measured_sky.h"
#include "data_refs/perez_sky.h"
#include "data_refs/radiance_sky.h"
#include "data_refs/table_csv.h"
#include "fit/exchange/programs.h"
#include "model/atmosphere/particles.h"
#include "model/base/content_cache.h"
#include "model/registry.h"
#include "model/solver/reference_model.h"

namespace skyfit::cli {
namespace {

constexpr const char *kExcludeSample = "--exclude-sample",
                     *kImportGroup = "Measured skies, where the file or its sidecar does not say";

// "latitude_deg" is --latitude-deg.
std::string import_option_name(const refs::ImportOptionRow& row) {
  std::string name = fmt::format("--{}", row.name);
  std::ranges::replace(name, '_', '-');
  return name;
}

}  // namespace

NamedFiles& named_files() {
  static NamedFiles named = NamedFiles::kInItsFolder;
  return named;
}

namespace {

// Of a file that is no preset: whose parameters it holds.
void expect_no_other_program(const std::string& file) {
  constexpr std::size_t kMostBytes = 1 << 20;
  const fit::Program* program = fit::program_of(read_file(file, "a preset", kMostBytes));
  if (program == nullptr) return;
  throw std::invalid_argument(
      fmt::format("{}: is no preset but {}; `skyfit import` reads it", file, program->meaning));
}

}  // namespace

Preset preset_named(const std::string& name_or_file) {
  if (name_or_file == "-") {
    static const std::string text = read_stdin("a preset");
    if (text.empty()) throw std::runtime_error("stdin: is empty, expected a preset");
    return parse_preset(text, "stdin", refs::load_table_csv, named_files());
  }
  const std::vector<std::string> shipped = refs::shipped_preset_names();
  if (std::ranges::count(shipped, name_or_file) > 0) {
    return parse_preset(refs::shipped_preset_json(name_or_file), name_or_file);
  }
  if (!std::filesystem::exists(name_or_file)) {
    throw std::invalid_argument(
        fmt::format("preset \"{}\": no such file, and none of the shipped presets {}", name_or_file,
                    fmt::join(shipped, ", ")));
  }
  try {
    return load_preset(name_or_file, refs::load_table_csv, named_files());
  } catch (const std::invalid_argument&) {
    expect_no_other_program(name_or_file);
    throw;
  }
}

void add_site_pressure_option(CLI::App& command, std::string& site_pressure) {
  command
      .add_option("--site-pressure-hpa", site_pressure,
                  "Air pressure at the ground, to which Rayleigh scattering is proportional; "
                  "by default the preset's, 1013.25 when it names none")
      ->type_name("HPA");
}

std::optional<double> parse_site_pressure(const std::string& text) {
  constexpr std::string_view kOption = "--site-pressure-hpa";
  if (text.empty()) return {};
  const double pressure = parse_number(kOption, text);
  if (pressure <= 0) throw UsageError(kOption, text, "expected a pressure > 0 hPa");
  return pressure;
}

void add_sampling_options(CLI::App& command, std::string& sampling, std::string& sun_zenith) {
  command
      .add_option("--sampling", sampling,
                  "Where an analytic reference is read: principal or tregenza")
      ->type_name("NAME")
      ->capture_default_str();
  command
      .add_option("--sun-zenith-deg", sun_zenith,
                  "The sun zenith angles of an analytic reference, below 90")
      ->type_name("LIST")
      ->capture_default_str();
}

void warn_of_unused_options(const CLI::App& command, const std::string& reference) {
  const bool is_scene = refs::is_radiance_sky_file(reference);
  const bool is_measured = !is_shipped_reference(reference) && !is_scene;
  const bool is_analytic = !is_measured && !reference.starts_with("truth:");
  const bool has_own_sun = is_scene || (is_analytic && reference.find('@') != reference.npos);
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    const bool is_import = option->get_group() == kImportGroup;
    const bool is_sampling =
        option->check_lname("sampling") || option->check_lname("sun-zenith-deg");
    if (has_own_sun && option->check_lname("sun-zenith-deg")) {
      warn(fmt::format("{} is not used: {} has its own sun", option->get_name(), reference));
      continue;
    }
    const CLI::Option* const irradiances = command.get_option_no_throw("--irradiance");
    if (option->check_lname("sun-zenith-deg") && irradiances != nullptr && irradiances->count() > 0)
      continue;  // their sun
    if (!(is_import && !is_measured) && !(is_sampling && !is_analytic)) continue;
    warn(fmt::format("{} is not used: {} {}", option->get_name(), reference,
                     is_import ? "is no measured sky" : "has its own directions"));
  }
}

void add_import_options(CLI::App& command, ImportArguments& arguments) {
  const auto add = [&](const std::string& name, std::optional<std::string>& text,
                       const std::string& meaning, const std::string& type) {
    command.add_option(name, text, meaning)->type_name(type)->group(kImportGroup);
  };
  for (const refs::ImportOptionRow& row : refs::import_option_table()) {
    if (!row.on_command_line) continue;
    add(import_option_name(row), arguments.facts[row.name],
        fmt::format("{} ({})", row.meaning, row.expectation), row.number ? "NUMBER" : "TEXT");
  }
  add(kExcludeSample, arguments.exclude_samples, "Do not use the samples of these numbers", "LIST");
  command
      .add_flag("--accept-sun", arguments.accept_sun,
                "Take the sun as it is stated, though the light of the sky puts it elsewhere")
      ->group(kImportGroup);
  add("--sidecar", arguments.sidecar, "In the place of FILE.sidecar.json", "FILE");
}

refs::ImportOptions parse_import_options(const ImportArguments& arguments) {
  refs::ImportOptions options;
  options.named_files = named_files();
  options.accept_sun = arguments.accept_sun;
  for (const refs::ImportOptionRow& row : refs::import_option_table()) {
    const auto given = arguments.facts.find(row.name);
    if (given == arguments.facts.end() || !given->second) continue;
    if (!row.set(*given->second, options)) {
      throw UsageError(import_option_name(row), *given->second, "expected " + row.expectation);
    }
  }
  if (arguments.exclude_samples) {
    for (const double sample : parse_list_within(kExcludeSample, *arguments.exclude_samples, 0,
                                                 kMaxListValues, "the number of a sample")) {
      if (sample != std::floor(sample))
        throw UsageError(kExcludeSample, *arguments.exclude_samples, "expected whole numbers");
      options.exclude_samples.push_back(
          {static_cast<int>(sample), std::string("excluded by ") + kExcludeSample});
    }
  }
  if (arguments.sidecar) options.sidecar = *arguments.sidecar;
  return options;
}

std::vector<double> parse_sun_zeniths(const std::string& text) {
  std::vector<double> angles = parse_list("--sun-zenith-deg", text);
  for (double& angle : angles) {
    if (!(angle >= 0 && angle < 90)) {
      throw UsageError(
          "--sun-zenith-deg", text,
          fmt::format("{:.9g}: expected the sun above the horizon, 0 <= angle < 90", angle));
    }
    angle = radians(angle);
  }
  return angles;
}

Primaries parse_primaries(const std::string& name) {
  const auto found = std::ranges::find(kColorSpaces, name, &ColorSpace::name);
  if (found == kColorSpaces.end())
    throw UsageError("--primaries", name, "expected rec709, rec2020 or xyz");
  return static_cast<Primaries>(found - kColorSpaces.begin());
}

refs::Sampling parse_sampling(const std::string& text) {
  if (text == "principal") return refs::Sampling::kPrincipalPlane;
  if (text == "tregenza") return refs::Sampling::kTregenza;
  throw UsageError("--sampling", text, "expected principal or tregenza");
}

refs::Reference load_references(const std::string& names, const std::string& sun_zenith,
                                const std::string& sampling, const ImportArguments& import,
                                const CLI::App& command) {
  const std::vector<double> suns = parse_sun_zeniths(sun_zenith);
  const refs::Sampling how = parse_sampling(sampling);
  const refs::ImportOptions options = parse_import_options(import);
  std::vector<refs::Reference> references;
  const std::vector<std::string> parts = refs::reference_names(names);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const auto same = [&](const std::string& other) {
      std::error_code missing;
      return other == parts[i] || std::filesystem::equivalent(other, parts[i], missing);
    };
    if (std::any_of(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(i), same))
      throw UsageError("--reference", parts[i], "is given twice: expected each sky once");
  }
  refs::LeftOut left_out("sky");
  for (const std::string& name : parts) {
    const auto load = [&] { references.push_back(refs::load_reference(name, suns, how, options)); };
    // What a file holds may be bad among others; a name that is wrong is the caller's mistake.
    if (parts.size() > 1 && std::filesystem::exists(name)) {
      left_out.attempt(load);
    } else {
      load();
    }
    warn_of_unused_options(command, name);
  }
  const std::vector<std::string> notes = left_out.notes();  // throws when nothing was read
  for (const std::string& note : notes) warn(note);
  refs::Reference joint = refs::joint_reference(references);
  joint.notes.insert(joint.notes.end(), notes.begin(), notes.end());
  return joint;
}

namespace {

std::optional<double> sun_of_irradiances(const std::string& sun_zenith, const CLI::App& command) {
  if (command.count("--sun-zenith-deg") == 0) return {};
  const std::vector<double> suns = parse_sun_zeniths(sun_zenith);
  if (suns.size() != 1)
    throw UsageError("--sun-zenith-deg", sun_zenith, "expected one sun of --irradiance");
  return suns.front();
}

// Where the samples of a sky are all of one scan, the sun of its first.
std::optional<double> only_sun(const refs::Reference& sky) {
  if (sky.samples.empty()) return {};
  const refs::Sample& first = sky.samples.front();
  const bool is_one = std::ranges::all_of(
      sky.samples, [&](const refs::Sample& sample) { return sample.scan == first.scan; });
  return is_one ? std::optional(first.sun_zenith) : std::nullopt;
}

}  // namespace

refs::Reference load_irradiances(const std::string& text, const std::string& sun_zenith,
                                 const ImportArguments& import, const CLI::App& command) {
  const std::optional<double> sun = sun_of_irradiances(sun_zenith, command);
  for (const char* unused : {"--sampling", "--exclude-sun-deg", "--exclude-sample"}) {
    if (command.get_option_no_throw(unused) != nullptr && command.count(unused) > 0)
      warn(fmt::format("{} is not used: irradiances have no directions", unused));
  }
  return refs::irradiance_reference(text, sun, parse_import_options(import));
}

refs::Reference load_with_irradiances(refs::Reference sky, const std::string& text,
                                      const std::string& sun_zenith, const ImportArguments& import,
                                      const CLI::App& command) {
  std::optional<double> sun = sun_of_irradiances(sun_zenith, command);
  if (!sun) sun = only_sun(sky);
  return refs::with_irradiances(
      std::move(sky), refs::irradiance_reference(text, sun, parse_import_options(import)));
}

bool is_shipped_reference(const std::string& name) {
  return refs::is_perez_name(name) ||
         std::ranges::count(refs::shipped_references(), name, &refs::ReferenceEntry::name) > 0;
}

void add_result_options(CLI::App& command, std::string& out, bool& force, bool& json,
                        const std::string& file) {
  command.add_option("--out", out, "Directory of the result")->required()->type_name("DIR");
  command.add_flag("--force", force, "Write into a directory that holds other files; they stay");
  command.add_flag("--json", json, fmt::format("Print {} to stdout", file));
}

void add_netcdf_option(CLI::App& command, std::string& netcdf, const std::string& what) {
  command.add_option("--netcdf", netcdf, what + " as a NetCDF-4 file by the CF conventions")
      ->type_name("FILE.nc");
}

void require_netcdf(const std::string& netcdf) {
  if (!netcdf.empty()) require_output_files({netcdf}, {".nc"}, "--netcdf");
}

int default_threads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void add_threads_option(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads; results do not depend on it")
      ->check(CLI::Range(1, 1024).description(""))
      ->capture_default_str();
}

void add_scalar_option(CLI::App& command, bool& scalar) {
  command.add_flag("--scalar", scalar,
                   "Leave the polarisation of light out of the models reference and tables:\n"
                   "a quarter of the time less, and radiances off by up to 13 % in the blue,\n"
                   "4 % in the green (docs/accuracy.md)");
}

void add_particle_cache_option(CLI::App& command) {
  const auto no_cache = std::make_shared<bool>(false);
  command.add_flag("--no-cache", *no_cache,
                   "Compute the scattering of spheres (size-distribution) anew instead of reading\n"
                   "or keeping it in $XDG_CACHE_HOME/skyfit or ~/.cache/skyfit");
  command.parse_complete_callback([no_cache] {
    const auto directory = user_cache_directory();
    keep_particles_in(*no_cache || !directory ? nullptr
                                              : std::make_shared<ContentCache>(*directory));
  });
}

CLI::Option* add_refraction_option(CLI::App& command, bool& refraction) {
  return command.add_flag(
      "--refraction", refraction,
      "Rays of the model reference are curved by air: view angles are those that are seen,\n"
      "suns stand where they would without air");
}

std::unique_ptr<SkyModel> sky_model_named(const std::string& name, const SpectralData& spectra,
                                          int threads, Transfer transfer, bool refraction) {
  if (refraction && name != "reference" && !name.starts_with("reference:"))
    throw UsageError("--refraction",
                     fmt::format("expected with the model reference, not {}", name));
  const bool asks = name.find(fmt::format(":{}", ReferenceModel::kRefraction)) == std::string::npos;
  const std::string variant =
      refraction && asks ? fmt::format("{}:{}", name, ReferenceModel::kRefraction) : name;
  return make_sky_model(variant, spectra, threads, transfer);
}

void add_iau_option(CLI::App& command, bool& iau, CLI::Option* stokes) {
  command
      .add_flag("--iau", iau,
                "Count U and the angle counter-clockwise, as the International Astronomical\n"
                "Union does")
      ->needs(stokes);
}

Transfer transfer_of(bool scalar) { return scalar ? Transfer::kScalar : Transfer::kVector; }

Transfer transfer_for(const refs::Reference& reference, bool scalar) {
  return scalar ? Transfer::kScalar : reference.transfer;
}

}  // namespace skyfit::cli
