// SPDX-License-Identifier: Apache-2.0
#include "data_refs/truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <stdexcept>

#include "data_refs/csv.h"
#include "data_refs/embedded.h"
#include "data_refs/spectra.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kPrefix = "truth:";
constexpr double kWavelength = 550;  // nm, of every table

struct TruthTable {
  TruthEntry entry;
  std::string_view file;                 // in truth/
  std::string_view plane_parallel_case;  // of those of that file; empty: Monte Carlo
  Transfer transfer = Transfer::kScalar;
};
constexpr TruthTable kTables[] = {
    {{"truth:earth-550nm-ground", "Monte Carlo, clear air over a spherical Earth, 550 nm"},
     "earth_550nm_ground.csv",
     ""},
    {{"truth:earth-550nm-haze-ground",
      "Monte Carlo, aerosol optical depth 0.2 over a spherical Earth, 550 nm"},
     "earth_550nm_haze_ground.csv",
     ""},
    {{"truth:plane-parallel", "discrete ordinates, plane-parallel air and aerosol, 550 nm"},
     "plane_parallel.csv",
     "A3"},
    {{"truth:plane-parallel-rayleigh", "discrete ordinates, plane-parallel air over black, 550 nm"},
     "plane_parallel.csv",
     "R1"},
    {{"truth:plane-parallel-thick-rayleigh",
      "discrete ordinates, plane-parallel air of optical depth 0.25 over albedo 0.3"},
     "plane_parallel.csv",
     "R3"},
};

const TruthTable& table_named(std::string_view name) {
  const auto found = std::ranges::find_if(
      kTables, [&](const TruthTable& table) { return table.entry.name == name; });
  if (found == std::end(kTables))
    throw std::invalid_argument(fmt::format("{}: no such table of truth", name));
  return *found;
}

}  // namespace

std::span<const TruthEntry> truth_references() {
  static const auto entries = [] {
    std::array<TruthEntry, std::size(kTables)> list;
    std::ranges::transform(kTables, list.begin(), &TruthTable::entry);
    return list;
  }();
  return entries;
}

Reference truth_reference(std::string_view name) {
  const TruthTable& table = table_named(name);
  const std::string file = fmt::format("truth/{}", table.file);
  const CsvTable csv(embedded_text(file), file);
  const double irradiance = standard_spectral_data().solar_irradiance.at(kWavelength);
  const bool monte_carlo = table.plane_parallel_case.empty();
  Reference reference;
  reference.name = name;
  reference.description = table.entry.description;
  reference.quantity = Quantity::kSpectralRadiance;
  reference.transfer = table.transfer;
  std::map<double, int> scan_of_sun;
  for (const CsvRecord& record : csv.records()) {
    if (!monte_carlo && (csv.text(record, "case") != table.plane_parallel_case ||
                         csv.text(record, "flag") != "ok")) {
      continue;
    }
    const auto angle = [&](std::string_view column) {
      return csv.number(record, column) * kRadiansPerDegree;
    };
    Sample sample;
    sample.sun_zenith = angle("sun_zenith_deg");
    sample.view_zenith = angle("view_zenith_deg");
    sample.relative_azimuth = angle("rel_azimuth_deg");
    sample.wavelength_nm = kWavelength;
    sample.value =
        irradiance * csv.number(record, monte_carlo ? "L_total" : "radiance_norm_per_sr");
    sample.scan = scan_of_sun.try_emplace(sample.sun_zenith, static_cast<int>(scan_of_sun.size()))
                      .first->second;
    reference.samples.push_back(sample);
  }
  return reference;
}

Preset truth_preset(std::string_view name) {
  const std::string file =
      fmt::format("truth/{}.json", table_named(name).entry.name.substr(kPrefix.size()));
  return parse_preset(std::string(embedded_text(file)), file);
}

}  // namespace skyfit::refs
