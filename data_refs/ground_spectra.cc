// SPDX-License-Identifier: Apache-2.0
#include "data_refs/ground_spectra.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "data_refs/csv.h"
#include "data_refs/embedded.h"
#include "data_refs/table_csv.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kFlat = "flat", kFile = "ground_spectra.csv";
constexpr std::string_view kWavelength = "wavelength_nm";

CsvTable shipped_table() { return CsvTable(embedded_text(kFile), kFile); }

}  // namespace

std::vector<std::string> ground_names() {
  std::vector<std::string> names = {std::string(kFlat)};
  const CsvTable table = shipped_table();
  for (const std::string& column : table.columns()) {
    if (column != kWavelength) names.push_back(column);
  }
  return names;
}

std::shared_ptr<const GroundSpectrum> ground_spectrum(std::string_view name) {
  if (name == kFlat) return nullptr;
  const CsvTable table = shipped_table();
  if (name != kWavelength && table.has(name)) {
    TwoColumns columns;
    for (const CsvRecord& record : table.records()) {
      columns.x.push_back(table.number(record, kWavelength));
      columns.y.push_back(table.number(record, name));
    }
    return std::make_shared<const GroundSpectrum>(columns);
  }
  if (!std::filesystem::exists(name)) {
    throw std::invalid_argument(fmt::format("ground \"{}\": no such file, expected one of {}", name,
                                            fmt::join(ground_names(), ", ")));
  }
  return std::make_shared<const GroundSpectrum>(load_table_csv(name, kGroundFormat));
}

}  // namespace skyfit::refs
