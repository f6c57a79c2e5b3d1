// SPDX-License-Identifier: Apache-2.0
// `skyfit check`: reads a preset, a measured sky or its sidecar the way the other commands do and
// says what it holds.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "data_refs/measured_formats.h"
#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "data_refs/table_csv.h"
#include "data_refs/units.h"
#include "model/atmosphere/preset.h"
#include "model/photometry/atmosphere_summary.h"
#include "model/registry.h"

namespace skyfit::cli {
namespace {

using nlohmann::json;

constexpr std::string_view kSidecarEnd = ".sidecar.json";

// A preset is a JSON object.
bool looks_like_json(const std::filesystem::path& file) {
  if (file.extension() == ".json") return true;
  if (std::filesystem::is_directory(file)) return false;
  require_regular_file(file, "a measured sky, a preset or a sidecar", kMostImageBytes);
  std::ifstream in(file);
  char first = 0;
  return in >> first && first == '{';
}

json json_of(const PhotometricColor& color, const char* quantity) {
  return {{quantity, color.luminance}, {"x", color.x}, {"y", color.y}};
}

json summary_of_preset(const std::string& file) {
  const Preset preset = preset_named(file);
  const SpectralData spectra = refs::spectral_data_of(preset.atmosphere);
  const AtmosphereSummary summary =
      summary_of(preset.atmosphere, spectra, *make_sky_model("reference", spectra, 1));
  json constituents = json::array();
  for (const ConstituentSummary& c : summary.constituents) {
    json row = {{"name", c.name}, {"optical_depth", c.optical_depth}};
    if (c.single_scattering_albedo) row["single_scattering_albedo"] = *c.single_scattering_albedo;
    if (c.mean_cosine) row["mean_cosine"] = *c.mean_cosine;
    constituents.push_back(row);
  }
  json result = {{"file", file},
                 {"kind", "preset"},
                 {"name", preset.name},
                 {"fitted", !preset.fit.is_null()},
                 {"wavelengths_nm", kSummaryWavelengths_nm},
                 {"constituents", constituents},
                 {"visibility_m", summary.visibility_m},
                 {"zenith", json_of(summary.zenith, "luminance_cd_m2")},
                 {"beam", json_of(summary.beam, "illuminance_lx")},
                 {"warnings", summary.warnings}};
  if (summary.turbidity) result["turbidity"] = *summary.turbidity;
  return result;
}

// What a preset holds.
std::string preset_lines(const json& summary) {
  std::string text = fmt::format("  {:<26}{:>10}{:>10}{:>10}   {:<12}{}\n", "optical depth at",
                                 "450 nm", "550 nm", "650 nm", "albedo", "mean cosine");
  for (const json& row : summary["constituents"]) {
    const auto number = [&](const char* field) {
      return row.contains(field) ? fmt::format("{:.3f}", row[field].get<double>()) : "-";
    };
    text += fmt::format("  {:<26}", row["name"].get<std::string>());
    for (const json& depth : row["optical_depth"])
      text += fmt::format("{:>10.4g}", depth.get<double>());
    text += fmt::format("   {:<12}{}\n", number("single_scattering_albedo"), number("mean_cosine"));
  }
  text += fmt::format("  visibility {:.4g} km", 1e-3 * summary["visibility_m"].get<double>());
  if (summary.contains("turbidity"))
    text += fmt::format(", turbidity {:.4g}", summary["turbidity"].get<double>());
  const json &zenith = summary["zenith"], &beam = summary["beam"];
  text += fmt::format(
      "\n  star 30 deg from the zenith: zenith sky {:.4g} cd/m^2 (x {:.3f}, y {:.3f}), beam {:.4g} "
      "lx "
      "(x {:.3f}, y {:.3f})\n",
      zenith["luminance_cd_m2"].get<double>(), zenith["x"].get<double>(), zenith["y"].get<double>(),
      beam["illuminance_lx"].get<double>(), beam["x"].get<double>(), beam["y"].get<double>());
  for (const json& warning : summary["warnings"])
    text += fmt::format("  warning: {}\n", warning.get<std::string>());
  return text;
}

json summary_of_sidecar(const std::string& file) {
  const refs::ImportOptions options = refs::load_sidecar(file, named_files());
  return {
      {"file", file}, {"kind", "sidecar"}, {"excluded_samples", options.exclude_samples.size()}};
}

// One entry per scan, with the sun of its begin, as its time and azimuth are.
json scans_of(const refs::Reference& reference) {
  std::map<int, std::pair<std::size_t, double>> scans;  // samples and sun zenith
  for (const refs::Sample& sample : reference.samples)
    ++scans.try_emplace(sample.scan, 0, sample.sun_zenith).first->second.first;
  json list = json::array();
  for (const auto& [index, scan] : scans) {
    json entry = {{"samples", scan.first}, {"sun_zenith_deg", degrees(scan.second)}};
    const auto known = static_cast<std::size_t>(index);
    if (known < reference.scans.size()) {
      const refs::Scan& facts = reference.scans[known];
      entry["name"] = facts.name;
      if (!facts.time_utc.empty()) entry["time_utc"] = facts.time_utc;
      if (facts.sun_azimuth) entry["sun_azimuth_deg"] = degrees(*facts.sun_azimuth);
      entry["sun_distance_au"] = facts.sun_distance_au;
      if (facts.elevation_m) entry["elevation_m"] = *facts.elevation_m;
    }
    list.push_back(entry);
  }
  return list;
}

json summary_of_samples(const std::string& file, const refs::ImportOptions& options) {
  const refs::Reference reference =
      refs::load_reference(file, {}, refs::Sampling::kPrincipalPlane, options);
  std::set<double> suns, wavelengths;
  std::set<std::tuple<int, double, double>> directions;  // numbered, or at the same place
  std::size_t weighted = 0;
  const bool is_numbered = std::ranges::any_of(
      reference.samples, [](const refs::Sample& sample) { return sample.direction != 0; });
  for (const refs::Sample& sample : reference.samples) {
    suns.insert(degrees(sample.sun_zenith));
    if (is_numbered)
      directions.emplace(sample.direction, 0, 0);
    else
      directions.emplace(0, sample.view_zenith, sample.relative_azimuth);
    if (sample.wavelength_nm > 0) wavelengths.insert(sample.wavelength_nm);
    if (sample.weight > 0) ++weighted;
  }
  const json scans = scans_of(reference);
  return {{"file", file},
          {"kind", "samples"},
          {"quantity", refs::quantity_name(reference.quantity)},
          {"samples", reference.samples.size()},
          {"samples_with_weight", weighted},
          {"samples_not_used", refs::samples_left_out(reference)},
          {"directions", directions.size()},
          {"wavelengths_nm", wavelengths},
          {"scans", scans.size()},
          {"scan_list", scans},
          {"notes", reference.notes},
          {"sun_zenith_deg", {*suns.begin(), *suns.rbegin()}}};
}

// "; not used: 41 known wrong, 3 not positive"
std::string not_used_text(const json& summary) {
  std::vector<std::string> reasons;
  for (const auto& [reason, count] : summary["samples_not_used"].items())
    reasons.push_back(fmt::format("{} \"{}\"", count.get<std::size_t>(), reason));
  return reasons.empty() ? "" : fmt::format("; not used: {}", fmt::join(reasons, ", "));
}

std::string wavelengths_text(const json& summary) {
  const json& wavelengths = summary["wavelengths_nm"];
  if (wavelengths.empty()) return "";
  if (wavelengths.size() == 1)
    return fmt::format(" at {:.9g} nm", wavelengths.front().get<double>());
  return fmt::format(" at {} wavelengths from {:.9g} to {:.9g} nm", wavelengths.size(),
                     wavelengths.front().get<double>(), wavelengths.back().get<double>());
}

// Of each scan whose sun's azimuth is known, and the notes.
std::string detail_lines(const json& summary) {
  constexpr std::size_t kMostLines = 20;
  std::string text;
  std::size_t lines = 0;
  for (const json& scan : summary["scan_list"]) {
    if (!scan.contains("sun_azimuth_deg")) continue;
    if (++lines > kMostLines) continue;
    text += fmt::format("  {}: {}sun zenith {:.3f}, azimuth {:.3f} deg, {:.5f} au, {} samples\n",
                        scan["name"].get<std::string>(),
                        scan.contains("time_utc") ? scan["time_utc"].get<std::string>() + ", " : "",
                        scan["sun_zenith_deg"].get<double>(), scan["sun_azimuth_deg"].get<double>(),
                        scan["sun_distance_au"].get<double>(), scan["samples"].get<std::size_t>());
  }
  if (lines > kMostLines)
    text += fmt::format("  and {} more (all of them with --json)\n", lines - kMostLines);
  for (const json& note : summary["notes"]) text += fmt::format("  {}\n", note.get<std::string>());
  return text;
}

std::string text_of(const json& summary) {
  const std::string file = summary["file"];
  if (summary["kind"] == "preset") {
    return fmt::format("{}: valid preset \"{}\"{}\n", file, summary["name"].get<std::string>(),
                       summary["fitted"].get<bool>() ? ", the result of a fit" : "") +
           preset_lines(summary);
  }
  if (summary["kind"] == "sidecar") {
    return fmt::format("{}: valid sidecar, {} excluded samples\n", file,
                       summary["excluded_samples"].get<std::size_t>());
  }
  const auto scans = summary["scans"].get<std::size_t>();
  return fmt::format(
             "{}: valid samples of {}: {} ({} with weight{}){} in {} directions and {}, sun "
             "zenith {:.9g} to {:.9g} deg\n",
             file, summary["quantity"].get<std::string>(), summary["samples"].get<std::size_t>(),
             summary["samples_with_weight"].get<std::size_t>(), not_used_text(summary),
             wavelengths_text(summary), summary["directions"].get<std::size_t>(),
             scans == 1 ? "1 scan" : fmt::format("{} scans", scans),
             summary["sun_zenith_deg"][0].get<double>(),
             summary["sun_zenith_deg"][1].get<double>()) +
         detail_lines(summary);
}

void run_check(const std::string& file, const refs::ImportOptions& options, bool as_json) {
  const auto shipped = refs::shipped_preset_names();
  const bool is_preset = file == "-" || std::ranges::find(shipped, file) != shipped.end();
  if (!is_preset && !std::filesystem::exists(file)) {
    throw std::runtime_error(fmt::format(
        "{}: expected a preset (.json) or a measured sky, there is no such file", file));
  }
  json summary;
  if (file.ends_with(kSidecarEnd)) {
    summary = summary_of_sidecar(file);
  } else if (is_preset || (std::filesystem::is_regular_file(file) && looks_like_json(file))) {
    summary = summary_of_preset(file);
  } else {
    summary = summary_of_samples(file, options);
  }
  print(as_json ? json_text(summary) : text_of(summary));
}

}  // namespace

void add_check_command(CLI::App& app) {
  struct Options {
    std::string file;
    ImportArguments import;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* const command = app.add_subcommand(
      "check", "Says whether a preset or a measured sky is valid, and what it holds.");
  command
      ->add_option("file", options->file,
                   "preset.json, a measured sky in any format that skyfit reads, or its sidecar")
      ->required()
      ->type_name("FILE");
  add_import_options(*command, options->import);
  command->add_flag("--json", options->json, "Print the summary as JSON");
  command->footer(
      "Formats of measured skies, recognised by what a file holds:\n" +
      named_lines(refs::measured_formats()) +
      "\nExamples:\n  skyfit check fitted/preset.json\n  skyfit check scan.csv --exclude-sample 0");
  command->callback([options] {
    run_check(options->file, parse_import_options(options->import), options->json);
  });
}

}  // namespace skyfit::cli
