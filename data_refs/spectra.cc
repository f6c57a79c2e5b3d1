// SPDX-License-Identifier: Apache-2.0
#include "data_refs/spectra.h"

#include <string_view>

#include "data_refs/csv.h"
#include "data_refs/embedded.h"

namespace skyfit::refs {
namespace {

CsvTable embedded_table(std::string_view file) { return CsvTable(embedded_text(file), file); }

Spectrum read_spectrum(const CsvTable& table, std::string_view column) {
  Spectrum spectrum;
  for (const CsvRecord& record : table.records()) {
    const double nm = table.number(record, "wavelength_nm");
    if (!spectrum.wavelength_nm.empty() && nm <= spectrum.wavelength_nm.back()) {
      table.fail_value(record, "wavelength_nm", "ascending wavelengths");
    }
    spectrum.wavelength_nm.push_back(nm);
    spectrum.value.push_back(table.number(record, column));
  }
  return spectrum;
}

SpectralData read_standard_spectral_data() {
  const CsvTable matching = embedded_table("cie_1931_xyz_5nm.csv");
  return {
      .x_bar = read_spectrum(matching, "x_bar"),
      .y_bar = read_spectrum(matching, "y_bar"),
      .z_bar = read_spectrum(matching, "z_bar"),
      .solar_irradiance =
          read_spectrum(embedded_table("solar_irradiance_astm_e490_5nm.csv"), "irradiance_W_m2_nm"),
      .ozone_cross_section =
          read_spectrum(embedded_table("ozone_cross_section_233K_10nm.csv"), "cross_section_m2"),
      .oxygen_pair_cross_section =
          read_spectrum(embedded_table("oxygen_pair_cross_section_273K.csv"), "cross_section_m5"),
      .nitrogen_dioxide_cross_section = read_spectrum(
          embedded_table("nitrogen_dioxide_cross_section_294K_5nm.csv"), "cross_section_m2")};
}

}  // namespace

const SpectralData& standard_spectral_data() {
  static const SpectralData data = read_standard_spectral_data();
  return data;
}

SpectralData spectral_data_of(const Atmosphere<double>& atmosphere) {
  return under(standard_spectral_data(), atmosphere.star);
}

}  // namespace skyfit::refs
