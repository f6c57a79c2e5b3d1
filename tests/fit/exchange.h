// SPDX-License-Identifier: Apache-2.0
// What the tests of exports share.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "fit/exchange/engines.h"
#include "fit/exchange/programs.h"
#include "model/atmosphere/preset.h"
#include "model/registry.h"

namespace skyfit::fit {

inline const SpectralData& spectra() { return refs::standard_spectral_data(); }

inline const SkyModel& scalar() {
  static const auto made = make_sky_model("reference", spectra(), 2, Transfer::kScalar);
  return *made;
}
inline const Models kScalarTruth{scalar(), scalar()};

inline Atmosphere<double> shipped(const std::string& name) {
  return parse_preset(refs::shipped_preset_json(name), name).atmosphere;
}

inline Exported exported(const Preset& preset, std::string_view to, double zenith, double azimuth,
                         const std::filesystem::path& file = "folder/sky.x") {
  return program_named(to).write({.preset = preset,
                                  .spectra = spectra(),
                                  .models = kScalarTruth,
                                  .sun_zenith = zenith,
                                  .sun_azimuth = azimuth,
                                  .file = file,
                                  .write_sky_map = {}});
}

inline EngineAtmosphere restricted(const Atmosphere<double>& atmosphere, const Engine& engine) {
  EngineAtmosphere form = engine_atmosphere(engine_form(atmosphere, spectra(), engine.lobe));
  engine.restrict_to(form);
  return form;
}

}  // namespace skyfit::fit
