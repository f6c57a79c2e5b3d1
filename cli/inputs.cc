// SPDX-License-Identifier: Apache-2.0
#include "cli/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include "cli/arguments.h"
#include "data_refs/perez_sky.h"
#include "data_refs/table_csv.h"

namespace skyfit::cli {

Preset preset_named(const std::string& name_or_file) {
  const std::vector<std::string> shipped = refs::shipped_preset_names();
  if (std::ranges::count(shipped, name_or_file) > 0) {
    return parse_preset(refs::shipped_preset_json(name_or_file), name_or_file);
  }
  if (!std::filesystem::exists(name_or_file)) {
    throw std::invalid_argument(
        fmt::format("preset \"{}\": no such file, and none of the shipped presets {}", name_or_file,
                    fmt::join(shipped, ", ")));
  }
  return load_preset(name_or_file, refs::load_table_csv);
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

void warn_of_unused_sampling(const CLI::App& command, const std::string& reference) {
  if (is_shipped_reference(reference)) return;
  for (const char* option : {"--sampling", "--sun-zenith-deg"}) {
    if (command.count(option) == 0) continue;
    fmt::print(stderr, "skyfit: warning: {} is not used: {} has its own directions\n", option,
               reference);
  }
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

refs::Sampling parse_sampling(const std::string& text) {
  if (text == "principal") return refs::Sampling::kPrincipalPlane;
  if (text == "tregenza") return refs::Sampling::kTregenza;
  throw UsageError("--sampling", text, "expected principal or tregenza");
}

bool is_shipped_reference(const std::string& name) {
  return refs::is_perez_name(name) ||
         std::ranges::count(refs::shipped_references(), name, &refs::ReferenceEntry::name) > 0;
}

int default_threads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void add_threads_option(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads; results do not depend on it")
      ->check(CLI::Range(1, 1024).description(""))
      ->capture_default_str();
}

}  // namespace skyfit::cli
