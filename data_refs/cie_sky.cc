// SPDX-License-Identifier: Apache-2.0
#include "data_refs/cie_sky.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "data_refs/csv.h"
#include "data_refs/embedded.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kFile = "cie_s011_standard_general_sky.csv";

std::vector<CieSky> read_cie_skies() {
  const CsvTable table(embedded_text(kFile), kFile);
  std::vector<CieSky> skies;
  for (const CsvRecord& record : table.records()) {
    const auto number = [&](std::string_view column) { return table.number(record, column); };
    skies.push_back({static_cast<int>(number("type")), number("a"), number("b"), number("c"),
                     number("d"), number("e"), table.text(record, "description")});
  }
  return skies;
}

}  // namespace

std::span<const CieSky> cie_skies() {
  static const std::vector<CieSky> skies = read_cie_skies();
  return skies;
}

double cie_gradation(const CieSky& sky, double view_zenith) {
  const double mu = std::cos(view_zenith);
  constexpr double kHorizon = 1e-15;  // cos of a rounded pi/2; the limit is 1 because b < 0
  return mu < kHorizon ? 1.0 : 1.0 + sky.a * std::exp(sky.b / mu);
}

double cie_indicatrix(const CieSky& sky, double scattering_angle) {
  const double nu = std::cos(scattering_angle);
  return 1.0 +
         sky.c * (std::exp(sky.d * scattering_angle) - std::exp(sky.d * std::numbers::pi / 2)) +
         sky.e * nu * nu;
}

double cie_relative_luminance(const CieSky& sky, double sun_zenith, double view_zenith,
                              double scattering_angle) {
  return cie_indicatrix(sky, scattering_angle) * cie_gradation(sky, view_zenith) /
         (cie_indicatrix(sky, sun_zenith) * cie_gradation(sky, 0.0));
}

double traditional_overcast_relative_luminance(double view_zenith) {
  return (1.0 + 2.0 * std::cos(view_zenith)) / 3.0;
}

}  // namespace skyfit::refs
