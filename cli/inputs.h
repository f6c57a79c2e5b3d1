// SPDX-License-Identifier: Apache-2.0
// What several commands read.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "data_refs/references.h"
#include "model/atmosphere/preset.h"
#include "model/base/input_file.h"
#include "model/sky_model.h"
#include "model/solver/reference_model.h"
#include "render/color_space.h"

namespace skyfit::cli {

// Which files the files that are read may name: --allow-paths of the program, set before a command
// runs.
NamedFiles& named_files();

// A shipped preset's name or the path of a preset file; a shipped name wins over a file of that
// name (write ./name for the file), and "-" is the standard input. Throws std::invalid_argument or
// std::runtime_error with one line, which lists the names for neither.
Preset preset_named(const std::string& name_or_file);

// Does `work`, and names the preset where that is more than the solver can do.
template <class Work>
auto of_preset(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const BeyondTheSolver& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
}

// The pressure that takes the place of the preset's; nothing when the option is not given. Throws
// UsageError.
void add_site_pressure_option(CLI::App& command, std::string& site_pressure);
std::optional<double> parse_site_pressure(const std::string& text);

// The options of the commands that read an analytic reference; their values are parsed by the two
// functions below.
void add_sampling_options(CLI::App& command, std::string& sampling, std::string& sun_zenith);

// Warns on stderr of options that were given but are not used: of sampling for a measured sky,
// which has its own directions, and for measured skies where the reference is a shipped one.
void warn_of_unused_options(const CLI::App& command, const std::string& reference);

// What the options for measured skies (data_refs/import_options.h) were given, by name.
struct ImportArguments {
  std::map<std::string, std::optional<std::string>, std::less<>> facts;
  std::optional<std::string> exclude_samples, sidecar;
  bool accept_sun = false;
};
void add_import_options(CLI::App& command, ImportArguments& arguments);

// Throws UsageError.
refs::ImportOptions parse_import_options(const ImportArguments& arguments);

// Radians; the sun of a daytime reference stands above the horizon: 0 <= angle < 90 degrees. Throws
// UsageError.
std::vector<double> parse_sun_zeniths(const std::string& text);

// A name of kColorSpaces; throws UsageError.
Primaries parse_primaries(const std::string& name);

// "principal" or "tregenza"; throws UsageError.
refs::Sampling parse_sampling(const std::string& text);

// A shipped reference, a measured sky, or several of one quantity separated by commas that become
// one (data_refs/joint_reference.h). Warns of options that are not used. Throws UsageError, and
// what load_reference() throws.
refs::Reference load_references(const std::string& names, const std::string& sun_zenith,
                                const std::string& sampling, const ImportArguments& import,
                                const CLI::App& command);

// The irradiances of data_refs/irradiance.h; --sun-zenith-deg, one sun, is theirs where it is
// given. Throws UsageError, and what irradiance_reference() throws.
refs::Reference load_irradiances(const std::string& text, const std::string& sun_zenith,
                                 const ImportArguments& import, const CLI::App& command);

// --no-cache; without it particles are kept in the user's cache (model/atmosphere/particles.h), if
// there is a place for one. Of commands that show an atmosphere as it stands.
void add_particle_cache_option(CLI::App& command);

// The sky with irradiances beside it (data_refs/joint_reference.h), whose sun, where it is not
// given, is that of the sky's one scan.
refs::Reference load_with_irradiances(refs::Reference sky, const std::string& text,
                                      const std::string& sun_zenith, const ImportArguments& import,
                                      const CLI::App& command);

// Analytic: read where the user says.
bool is_shipped_reference(const std::string& name);

// --out, --force and --json of a command that leaves a directory; --json prints `file` of it.
void add_result_options(CLI::App& command, std::string& out, bool& force, bool& json,
                        const std::string& file);

// --netcdf FILE; `what` says of what. require_netcdf() throws before long work where the file that
// was given, if any, cannot be written.
void add_netcdf_option(CLI::App& command, std::string& netcdf, const std::string& what);
void require_netcdf(const std::string& netcdf);

// Threads to use when the user names no number: those of the machine.
int default_threads();
void add_threads_option(CLI::App& command, int& threads);

// --refraction: rays of the model `reference` are curved by air.
CLI::Option* add_refraction_option(CLI::App& command, bool& refraction);
// A model of the registry, or its variant with refraction. Throws as make_sky_model() does.
std::unique_ptr<SkyModel> sky_model_named(const std::string& name, const SpectralData& spectra,
                                          int threads, Transfer transfer, bool refraction);

// --scalar: the models `reference` and `tables` without polarisation.
void add_scalar_option(CLI::App& command, bool& scalar);
Transfer transfer_of(bool scalar);
// What --scalar expects beside an option that asks for polarisation.
inline constexpr const char* kScalarStokes =
    "expected without --stokes: Stokes parameters are those of polarised light";
// --iau beside `stokes`, the option that asks for polarisation.
void add_iau_option(CLI::App& command, bool& iau, CLI::Option* stokes);
// A reference that was computed without polarisation is compared with a model without.
Transfer transfer_for(const refs::Reference& reference, bool scalar);

}  // namespace skyfit::cli
