// SPDX-License-Identifier: Apache-2.0
#include "data_refs/gas_absorption.h"

#include "data_refs/csv.h"
#include "data_refs/embedded.h"

namespace skyfit::refs {

const GasAbsorption& standard_gas_absorption() {
  static const GasAbsorption absorption = [] {
    constexpr std::string_view kFile = "gas_absorption_spectrl2.csv";
    const CsvTable table(embedded_text(kFile), kFile);
    GasAbsorption result;
    for (const CsvRecord& record : table.records()) {
      for (const auto& [spectrum, column] : {std::pair{&result.water_vapour, "water_vapour"},
                                             {&result.mixed_gases, "mixed_gases"}}) {
        spectrum->wavelength_nm.push_back(table.number(record, "wavelength_nm"));
        spectrum->value.push_back(table.number(record, column));
      }
    }
    return result;
  }();
  return absorption;
}

}  // namespace skyfit::refs
