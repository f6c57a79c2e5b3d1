// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/preset_constituents.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <initializer_list>
#include <vector>

#include "model/atmosphere/preset_choices.h"

namespace skyfit {
namespace {

using nlohmann::ordered_json;

struct AmountField {
  AmountType type;
  std::string_view name;
};
constexpr std::array<AmountField, 7> kAmounts = {{{AmountType::kScattering, "scattering_per_m"},
                                                  {AmountType::kExtinction, "extinction_per_m"},
                                                  {AmountType::kOpticalDepth, "optical_depth"},
                                                  {AmountType::kColumn, "column_du"},
                                                  {AmountType::kAirPressure, "rayleigh"},
                                                  {AmountType::kOxygenPairs, "oxygen_pairs"},
                                                  {AmountType::kVolume, "volume_um3_per_um2"}}};
constexpr std::string_view kAmountNames =
    "one of scattering_per_m, extinction_per_m, optical_depth, column_du, rayleigh, oxygen_pairs, "
    "volume_um3_per_um2";
constexpr std::string_view kBodhaine = "bodhaine-1999";

std::string_view amount_name(AmountType type) {
  for (const AmountField& field : kAmounts) {
    if (field.type == type) return field.name;
  }
  throw std::invalid_argument("an enumerator without a name");
}

std::shared_ptr<const SpectrumTable> read_spectrum(const PresetReader& object,
                                                   const PresetTables& tables,
                                                   const TableFormat& format) {
  if (object.text("type") != kTabulated) object.fail_value("type", kTabulated);
  return tables.read_with(object, format, [&](const TwoColumns& columns) {
    return std::make_shared<const SpectrumTable>(columns, format);
  });
}

// What depends on a wavelength alone has no place beside an amount that does not.
void refuse_beside(const PresetReader& object, std::string_view amount,
                   std::initializer_list<std::string_view> fields) {
  for (const std::string_view field : fields) {
    if (object.has(field)) object.fail_value(field, fmt::format("none beside {}", amount));
  }
}

// Dry air whose scattering and phase function follow from its pressure.
void read_air(const PresetReader& air, Constituent<double>& c) {
  air.expect_only({"kind", "pressure_hpa", "co2_ppm"});
  if (air.text("kind") != kBodhaine) air.fail_value("kind", kBodhaine);
  c.amount = air.number("pressure_hpa");
  if (air.has("co2_ppm")) c.co2_ppm = air.number("co2_ppm");
  set_king_depolarisation(c);
}

void read_amount(const PresetReader& object, const PresetTables& tables, Constituent<double>& c) {
  const AmountField* found = nullptr;
  for (const AmountField& field : kAmounts) {
    if (!object.has(field.name)) continue;
    if (found != nullptr) object.fail_value(field.name, "no other amount beside it");
    found = &field;
  }
  if (found == nullptr) object.fail_missing(kAmountNames);
  c.amount_type = found->type;
  if (object.has("absorber")) {
    if (c.amount_type != AmountType::kColumn)
      object.fail_value("absorber", "none but beside column_du, which it is the gas of");
    c.absorber = read_choice(object, "absorber", kAbsorbers);
  }
  if (!is_at_wavelength(c.amount_type))
    refuse_beside(object, found->name, {"single_scattering_albedo", "site_pressure_hpa"});
  if (c.amount_type == AmountType::kAirPressure) {
    refuse_beside(object, found->name, {"phase"});
    return read_air(object.object(found->name), c);
  }
  if (c.amount_type == AmountType::kOxygenPairs) {
    const PresetReader pairs = object.object(found->name);
    pairs.expect_only({"pressure_hpa", "temperature_k"});
    c.amount = pairs.number("pressure_hpa");
    c.temperature_k = pairs.number("temperature_k");
    c.single_scattering_albedo = 0;
    return;
  }
  if (c.amount_type == AmountType::kColumn) {
    c.amount = object.number(found->name);
    c.single_scattering_albedo = 0;
    return;
  }
  if (c.amount_type == AmountType::kVolume) {
    c.amount = object.number(found->name);
    return;
  }
  const PresetReader law = object.object(found->name);
  law.expect_only({"wavelength_nm", "value", "exponent", "spectrum"});
  c.wavelength_nm = law.number("wavelength_nm");
  c.amount = law.number("value");
  if (c.phase.type == PhaseType::kSizeDistribution) {
    refuse_beside(law, "particles, whose sizes say how it depends on wavelength",
                  {"exponent", "spectrum"});
  } else if (!law.has("spectrum")) {
    c.angstrom_exponent = law.number("exponent");
  } else if (law.has("exponent")) {
    law.fail_value("exponent", "no exponent beside a spectrum");
  } else {
    c.spectrum = read_spectrum(law.object("spectrum"), tables, kShapeFormat);
  }
}

void read_albedo(const PresetReader& object, const PresetTables& tables, Constituent<double>& c) {
  constexpr std::string_view kField = "single_scattering_albedo";
  if (!object.has(kField)) return;
  if (c.phase.type == PhaseType::kSizeDistribution)
    refuse_beside(object, "particles, whose refractive index says how they absorb", {kField});
  if (object.has_object(kField)) {
    c.albedo_spectrum = read_spectrum(object.object(kField), tables, kAlbedoFormat);
  } else {
    c.single_scattering_albedo = object.number(kField);
  }
}

VerticalProfile<double> read_profile(const PresetReader& object, const PresetTables& tables) {
  VerticalProfile<double> profile;
  const std::string type = object.text("type");
  const auto kinds = corner_profiles();
  if (const auto kind = std::ranges::find(kinds, type, &CornerProfile::name); kind != kinds.end()) {
    profile.type = ProfileType::kCorners;
    profile.corners = static_cast<std::size_t>(kind - kinds.begin());
    std::vector<std::string_view> fields = {"type"};
    for (std::size_t i = 0; i < kind->numbers.size(); ++i) {
      fields.push_back(kind->numbers[i].field);
      profile.numbers[i] = object.number(kind->numbers[i].field);
    }
    object.expect_only(fields);
    return profile;
  }
  std::vector<std::string_view> names;
  for (const CornerProfile& kind : kinds) names.push_back(kind.name);
  profile.type = read_choice(object, "type", kProfileTypes, names);
  switch (profile.type) {
    case ProfileType::kExponential:
      object.expect_only({"type", "scale_height_m"});
      profile.scale_height_m = object.number("scale_height_m");
      break;
    case ProfileType::kCorners:  // is above
      break;
    case ProfileType::kLayer:
      object.expect_only({"type", "base_m", "top_m"});
      profile.base_m = object.number("base_m");
      profile.top_m = object.number("top_m");
      break;
    case ProfileType::kTabulated:
      profile.table = tables.read<LinearProfile>(object, kProfileFormat);
      break;
    case ProfileType::kSameAs:
    case ProfileType::kSquareOf:
      object.expect_only({"type", "of"});
      profile.of = object.text("of");
      break;
  }
  return profile;
}

std::shared_ptr<const RefractiveIndex> read_index_spectrum(const PresetReader& index) {
  return index.complaining([&] {
    return std::make_shared<const RefractiveIndex>(
        "", index.numbers("wavelength_nm"), index.numbers("real"), index.numbers("imaginary"));
  });
}

SizeDistribution<double> read_size_distribution(const PresetReader& object) {
  constexpr std::string_view kIndex = "refractive_index", kMaterial = "material";
  object.expect_only({"type", "median_radius_um", "width", kMaterial, kIndex});
  SizeDistribution<double> particles;
  particles.radius_um = object.number("median_radius_um");
  particles.width = object.number("width");
  particles.tables = std::make_shared<const ParticleTables>();
  if (object.has(kMaterial)) {
    refuse_beside(object, kMaterial, {kIndex});
    particles.index_spectrum = index_of_material(object.text(kMaterial));
    if (particles.index_spectrum == nullptr) {
      std::vector<std::string_view> names;
      for (const Material& material : materials()) names.push_back(material.name);
      object.fail_value(kMaterial, fmt::format("one of {}", fmt::join(names, ", ")));
    }
    return particles;
  }
  if (!object.has(kIndex)) object.fail_missing("material or refractive_index");
  const PresetReader index = object.object(kIndex);
  index.expect_only({"wavelength_nm", "real", "imaginary"});
  if (index.has("wavelength_nm")) {
    particles.index_spectrum = read_index_spectrum(index);
  } else {
    particles.index_real = index.number("real");
    particles.index_imaginary = index.number("imaginary");
  }
  return particles;
}

std::shared_ptr<const SpectralPhase> read_spectral_phase(const PresetReader& object) {
  object.expect_only({"type", "wavelength_nm", "scattering_angle_deg", "phase_per_sr"});
  const std::vector<double> angles = object.numbers("scattering_angle_deg");
  std::vector<std::shared_ptr<const TabulatedPhase>> phases;
  for (const std::vector<double>& values : object.rows("phase_per_sr")) {
    phases.push_back(object.complaining([&] {
      return std::make_shared<const TabulatedPhase>(TwoColumns{angles, values});
    }));
  }
  return object.complaining([&] {
    return std::make_shared<const SpectralPhase>(object.numbers("wavelength_nm"),
                                                 std::move(phases));
  });
}

ordered_json spectrum_to_json(const SpectrumTable& spectrum, const TableFormat& format) {
  return table_to_json(spectrum.table(), format);
}

ordered_json amount_to_json(const Constituent<double>& c) {
  if (c.amount_type == AmountType::kColumn || c.amount_type == AmountType::kVolume) return c.amount;
  if (c.amount_type == AmountType::kAirPressure)
    return {{"kind", kBodhaine}, {"pressure_hpa", c.amount}, {"co2_ppm", c.co2_ppm}};
  if (c.amount_type == AmountType::kOxygenPairs)
    return {{"pressure_hpa", c.amount}, {"temperature_k", c.temperature_k}};
  ordered_json law = {{"wavelength_nm", c.wavelength_nm}, {"value", c.amount}};
  if (c.phase.type == PhaseType::kSizeDistribution) {
    // It follows from the sizes.
  } else if (c.spectrum) {
    law["spectrum"] = spectrum_to_json(*c.spectrum, kShapeFormat);
  } else {
    law["exponent"] = c.angstrom_exponent;
  }
  return law;
}

ordered_json to_json(const VerticalProfile<double>& profile) {
  if (profile.type == ProfileType::kCorners) {
    const CornerProfile& kind = corner_profiles()[profile.corners];
    ordered_json json = {{"type", kind.name}};
    for (std::size_t i = 0; i < kind.numbers.size(); ++i)
      json[std::string(kind.numbers[i].field)] = profile.numbers[i];
    return json;
  }
  const std::string_view type = name_of(profile.type, kProfileTypes);
  switch (profile.type) {
    case ProfileType::kExponential:
      return {{"type", type}, {"scale_height_m", profile.scale_height_m}};
    case ProfileType::kCorners:  // is above
      break;
    case ProfileType::kLayer:
      return {{"type", type}, {"base_m", profile.base_m}, {"top_m", profile.top_m}};
    case ProfileType::kTabulated:
      return table_to_json(profile.table->table(), kProfileFormat);
    case ProfileType::kSameAs:
    case ProfileType::kSquareOf:
      return {{"type", type}, {"of", profile.of}};
  }
  throw std::invalid_argument("an enumerator without a name");
}

ordered_json to_json(const SizeDistribution<double>& particles, std::string_view type) {
  ordered_json object = {
      {"type", type}, {"median_radius_um", particles.radius_um}, {"width", particles.width}};
  const RefractiveIndex* const spectrum = particles.index_spectrum.get();
  if (spectrum == nullptr) {
    object["refractive_index"] = {{"real", particles.index_real},
                                  {"imaginary", particles.index_imaginary}};
  } else if (!spectrum->material().empty()) {
    object["material"] = spectrum->material();
  } else {
    object["refractive_index"] = {{"wavelength_nm", spectrum->wavelength_nm()},
                                  {"real", spectrum->real()},
                                  {"imaginary", spectrum->imaginary()}};
  }
  return object;
}

ordered_json to_json(const PhaseFunction<double>& phase) {
  const std::string_view type = name_of(phase.type, kPhaseTypes);
  switch (phase.type) {
    case PhaseType::kRayleigh:
      return {{"type", type}, {"depolarisation", phase.depolarisation}};
    case PhaseType::kSizeDistribution:
      return to_json(phase.particles, type);
    case PhaseType::kTabulated:
      return table_to_json(phase.table->table(), kPhaseFormat);
    case PhaseType::kTwoLobe:
      return {{"type", type},
              {"lobe", name_of(phase.lobe, kLobeTypes)},
              {"g1", phase.g1},
              {"g2", phase.g2},
              {"weight", phase.weight}};
    case PhaseType::kByWavelength: {
      ordered_json rows = ordered_json::array();
      const auto& phases = phase.by_wavelength->phases();
      for (const auto& table : phases) rows.push_back(table->table().y);
      return {{"type", type},
              {"wavelength_nm", phase.by_wavelength->wavelengths_nm()},
              {"scattering_angle_deg", phases.front()->table().x},
              {"phase_per_sr", std::move(rows)}};
    }
    default:
      return {{"type", type}, {"g", phase.g}};
  }
}

}  // namespace

PhaseFunction<double> read_phase(const PresetReader& object, const PresetTables& tables) {
  PhaseFunction<double> phase;
  phase.type = read_choice(object, "type", kPhaseTypes);
  switch (phase.type) {
    case PhaseType::kTabulated:
      phase.table = tables.read<TabulatedPhase>(object, kPhaseFormat);
      break;
    case PhaseType::kByWavelength:
      phase.by_wavelength = read_spectral_phase(object);
      break;
    case PhaseType::kSizeDistribution:
      phase.particles = read_size_distribution(object);
      break;
    case PhaseType::kRayleigh:
      object.expect_only({"type", "depolarisation"});
      if (object.has("depolarisation")) phase.depolarisation = object.number("depolarisation");
      break;
    case PhaseType::kTwoLobe:
      object.expect_only({"type", "lobe", "g1", "g2", "weight"});
      if (object.has("lobe")) phase.lobe = read_choice(object, "lobe", kLobeTypes);
      phase.g1 = object.number("g1");
      phase.g2 = object.number("g2");
      phase.weight = object.number("weight");
      break;
    default:
      object.expect_only({"type", "g"});
      phase.g = object.number("g");
  }
  return phase;
}

Constituent<double> read_constituent(const PresetReader& object, const PresetTables& tables) {
  object.expect_only({"name", "note", "scattering_per_m", "extinction_per_m", "optical_depth",
                      "column_du", "rayleigh", "oxygen_pairs", "volume_um3_per_um2", "absorber",
                      "site_pressure_hpa", "single_scattering_albedo", "profile", "phase"});
  Constituent<double> c;
  c.name = object.text("name");
  if (object.has("phase")) c.phase = read_phase(object.object("phase"), tables);
  read_amount(object, tables, c);
  read_albedo(object, tables, c);
  if (object.has("site_pressure_hpa")) c.site_pressure_hpa = object.number("site_pressure_hpa");
  c.profile = read_profile(object.object("profile"), tables);
  if (c.amount_type == AmountType::kAirPressure) return c;
  if (!scatters(c) && object.has("phase"))
    object.fail_value("phase", "no phase function of what does not scatter");
  if (scatters(c)) object.object("phase");  // is required
  return c;
}

ordered_json constituent_to_json(const Constituent<double>& c) {
  ordered_json object = {{"name", c.name},
                         {std::string(amount_name(c.amount_type)), amount_to_json(c)}};
  if (c.amount_type == AmountType::kColumn) {
    object["absorber"] = name_of(c.absorber, kAbsorbers);
  } else if (!is_at_wavelength(c.amount_type) || c.phase.type == PhaseType::kSizeDistribution) {
    // It follows from the amount or the phase function.
  } else if (c.albedo_spectrum) {
    object["single_scattering_albedo"] = spectrum_to_json(*c.albedo_spectrum, kAlbedoFormat);
  } else {
    object["single_scattering_albedo"] = c.single_scattering_albedo;
  }
  if (is_at_wavelength(c.amount_type) && c.site_pressure_hpa != kStandardPressureHpa)
    object["site_pressure_hpa"] = c.site_pressure_hpa;
  object["profile"] = to_json(c.profile);
  if (c.amount_type != AmountType::kAirPressure && scatters(c)) object["phase"] = to_json(c.phase);
  return object;
}

}  // namespace skyfit
