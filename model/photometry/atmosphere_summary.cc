// SPDX-License-Identifier: Apache-2.0
#include "model/photometry/atmosphere_summary.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "model/atmosphere/derived.h"
#include "model/atmosphere/optics.h"
#include "model/atmosphere/parameter_field.h"

namespace skyfit {
namespace {

constexpr double kGreen = 550;  // nm

ConstituentSummary summary_of(const Atmosphere<double>& atmosphere, const Constituent<double>& c,
                              const SpectralData& spectra) {
  ConstituentSummary summary{c.name, {}, {}, {}};
  for (std::size_t k = 0; k < kSummaryWavelengths_nm.size(); ++k) {
    const double nm = kSummaryWavelengths_nm[k];
    summary.optical_depth[k] = vertical_optical_depth(atmosphere, c, node_at(spectra, nm));
  }
  if (scatters(c)) {
    summary.single_scattering_albedo = single_scattering_albedo(c);
    summary.mean_cosine = mean_cosine(c.phase);
  }
  return summary;
}

double extinction_at(const Atmosphere<double>& atmosphere, double height) {
  const Shells shells = shells_of(atmosphere, Keep::kWhatMatters);
  const Optics<0> optics = true_optics_at(shells, seeded<0>(atmosphere, {}), {kGreen, 0});
  const Densities<0> density = optics.densities(height);
  double sum = 0;
  for (std::size_t k = 0; k < optics.extinction.size(); ++k)
    sum += optics.extinction[k].v * density[k].v;
  return sum;
}

template <class Value>
PhotometricColor color_of(const XyzRule& rule, const Value& value_at) {
  std::array<double, 3> xyz{};
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < rule.nodes.size(); ++k)
      xyz[c] += rule.weight[c][k] * value_at(static_cast<int>(k));
  }
  const double sum = xyz[0] + xyz[1] + xyz[2];
  if (!(sum > 0)) return {};
  return {xyz[1], xyz[0] / sum, xyz[1] / sum};
}

std::vector<std::string> warnings_of(const Atmosphere<double>& atmosphere,
                                     const AtmosphereSummary& summary) {
  std::vector<std::string> warnings;
  const double top = atmosphere.top_radius_m - atmosphere.bottom_radius_m;
  for (std::size_t i = 0; i < atmosphere.constituents.size(); ++i) {
    const Constituent<double>& c = atmosphere.constituents[i];
    const ConstituentSummary& s = summary.constituents[i];
    constexpr double kThick = 100, kDark = 0.3, kFew = 5, kLostAbove = 0.01;
    if (s.optical_depth[1] > kThick)
      warnings.push_back(
          fmt::format("{} has a vertical optical depth of {:.4g} at 550 nm: no "
                      "light comes through",
                      c.name, s.optical_depth[1]));
    if (s.single_scattering_albedo && *s.single_scattering_albedo < kDark)
      warnings.push_back(
          fmt::format("{} has a single scattering albedo of {:.3g}: darker than "
                      "any aerosol but soot",
                      c.name, *s.single_scattering_albedo));
    if (c.phase.type == PhaseType::kRayleigh && scatters(c) && is_at_wavelength(c.amount_type) &&
        !c.spectrum && std::abs(c.angstrom_exponent - 4) > 0.5)
      warnings.push_back(
          fmt::format("{} has Rayleigh's phase function and the exponent {:.3g}: "
                      "molecules have about 4",
                      c.name, c.angstrom_exponent));
    if (c.profile.type == ProfileType::kExponential && c.profile.scale_height_m * kFew > top)
      warnings.push_back(fmt::format(
          "{} has a scale height of {:.4g} m under a top of {:.4g} m: "
          "{:.2g} % of it is cut off",
          c.name, c.profile.scale_height_m, top, 100 * std::exp(-top / c.profile.scale_height_m)));
    if (c.profile.type == ProfileType::kTabulated && c.profile.table->heights().back() > top &&
        c.profile.table->density(top) > kLostAbove)
      warnings.push_back(
          fmt::format("{} is tabulated beyond the top of the atmosphere, {:.4g} m", c.name, top));
  }
  if (summary.visibility_m < 50)
    warnings.push_back(
        fmt::format("the visibility at the ground is {:.3g} m", summary.visibility_m));
  if (summary.turbidity && *summary.turbidity > 100)
    warnings.push_back(fmt::format("the turbidity is {:.4g}", *summary.turbidity));
  return warnings;
}

}  // namespace

AtmosphereSummary summary_of(const Atmosphere<double>& atmosphere, const SpectralData& spectra,
                             const SkyModel& model) {
  constexpr double kKoschmieder = 3.912;   // -ln 0.02
  constexpr double kAirOfTheEarth = 0.02;  // optical depth of a fifth of it
  constexpr double kSun = std::numbers::pi / 6, kEye = 1;
  AtmosphereSummary summary;
  for (const Constituent<double>& c : atmosphere.constituents)
    summary.constituents.push_back(summary_of(atmosphere, c, spectra));
  summary.visibility_m = kKoschmieder / extinction_at(atmosphere, kEye);
  if (const double air = rayleigh_optical_depth(atmosphere); air > kAirOfTheEarth)
    summary.turbidity = (air + aerosol_optical_depth(atmosphere)) / air;
  const XyzRule rule = xyz_rule(spectra);
  const SkyPoint zenith{kEye, kSun, 0, 0};
  const SkyValues sky = model.radiance(atmosphere, rule.nodes, {&zenith, 1}, {});
  const SkyValues light = model.irradiance(atmosphere, rule.nodes, kEye, kSun, {});
  summary.zenith = color_of(rule, [&](int k) { return sky.at(0, k); });
  summary.beam = color_of(rule, [&](int k) { return light.at(kDirectNormal, k); });
  summary.warnings = warnings_of(atmosphere, summary);
  return summary;
}

}  // namespace skyfit
