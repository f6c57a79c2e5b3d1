// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/preset_v1.h"

#include "model/atmosphere/preset_choices.h"
#include "model/atmosphere/preset_constituents.h"

namespace skyfit {
namespace {

constexpr std::string_view kExponential = "exponential";

void read_power_law(const PresetReader& parent, Constituent<double>& c) {
  const PresetReader object = parent.object("scattering_per_m");
  object.expect_only({"wavelength_nm", "value", "exponent"});
  c.wavelength_nm = object.number("wavelength_nm");
  c.amount = object.number("value");
  c.angstrom_exponent = object.number("exponent");
}

TabulatedProfile read_table(const PresetReader& profile, const PresetTables& tables) {
  if (profile.text("type") != kTabulated) profile.fail_value("type", kTabulated);
  return tables.read<LinearProfile>(profile, kProfileFormat);
}

// The profile of the air or the aerosol: a scale height or a table, not both.
VerticalProfile<double> read_profile(const PresetReader& object, const PresetTables& tables) {
  constexpr std::string_view kScaleHeight = "scale_height_m", kProfile = "profile";
  VerticalProfile<double> profile;
  if (!object.has_object(kProfile)) {
    if (object.has(kProfile) && object.text(kProfile) != kExponential)
      object.fail_value(kProfile, "exponential or an object");
    profile.scale_height_m = object.number(kScaleHeight);
    return profile;
  }
  if (object.has(kScaleHeight))
    object.fail_value(kScaleHeight, "no scale height beside a tabulated profile");
  profile.type = ProfileType::kTabulated;
  profile.table = read_table(object.object(kProfile), tables);
  return profile;
}

Constituent<double> read_rayleigh(const PresetReader& object, const PresetTables& tables) {
  object.expect_only(
      {"scattering_per_m", "scale_height_m", "depolarisation", "site_pressure_hpa", "profile"});
  Constituent<double> c = standard_rayleigh<double>();
  read_power_law(object, c);
  if (object.has("depolarisation")) c.phase.depolarisation = object.number("depolarisation");
  if (object.has("site_pressure_hpa")) c.site_pressure_hpa = object.number("site_pressure_hpa");
  c.profile = read_profile(object, tables);
  return c;
}

Constituent<double> read_mie(const PresetReader& object, const PresetTables& tables) {
  object.expect_only(
      {"scattering_per_m", "single_scattering_albedo", "scale_height_m", "profile", "phase"});
  Constituent<double> c = standard_mie<double>();
  read_power_law(object, c);
  c.single_scattering_albedo = object.number("single_scattering_albedo");
  c.profile = read_profile(object, tables);
  const PresetReader phase = object.object("phase");
  c.phase = read_phase(phase, tables);
  if (c.phase.type == PhaseType::kSizeDistribution)
    phase.fail_value("type", "another one: particles of a size distribution need version 2");
  return c;
}

// Exponential ozone has the scale height of the air.
Constituent<double> read_ozone(const PresetReader& object, const PresetTables& tables,
                               bool air_is_exponential) {
  object.expect_only({"column_du", "profile"});
  Constituent<double> c = standard_ozone<double>();
  c.amount = object.number("column_du");
  if (object.has_object("profile")) {
    c.profile = {};
    c.profile.type = ProfileType::kTabulated;
    c.profile.table = read_table(object.object("profile"), tables);
    return c;
  }
  const std::string type = object.text("profile");
  if (type == kExponential) {
    if (!air_is_exponential)
      object.fail_value("profile", "tent or a table, the air has no scale height");
    c.profile = {};
    c.profile.type = ProfileType::kSameAs;
    c.profile.of = "rayleigh";
  } else if (type != "tent") {
    object.fail_value("profile", "one of tent, exponential, tabulated");
  }
  return c;
}

}  // namespace

std::vector<Constituent<double>> read_constituents_v1(const PresetReader& root,
                                                      const PresetTables& tables) {
  std::vector<Constituent<double>> list;
  list.push_back(read_rayleigh(root.object("rayleigh"), tables));
  list.push_back(read_mie(root.object("mie"), tables));
  list.push_back(
      read_ozone(root.object("ozone"), tables, list[0].profile.type == ProfileType::kExponential));
  return list;
}

}  // namespace skyfit
