// SPDX-License-Identifier: Apache-2.0
#include "model/sky_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "model/literature/bodare.h"
#include "model/literature/bruneton.h"
#include "model/literature/hoffman_preetham.h"
#include "model/literature/nielsen.h"
#include "model/literature/oneil.h"
#include "model/literature/preetham.h"
#include "model/literature/schafhitzel.h"
#include "model/solver/reference_model.h"
#include "model/tables/table_model.h"

namespace skyfit {

void check_model_value(std::string_view model, bool good, std::string_view name, double value,
                       std::string_view expected) {
  if (!good)
    throw std::invalid_argument(
        fmt::format("{} model: {} = {:.9g}: must be {}", model, name, value, expected));
}

void check_point(std::string_view model, const SkyPoint& p) {
  const auto check = [&](bool good, std::string_view name, double value,
                         std::string_view expected) {
    check_model_value(model, good, name, value, expected);
  };
  const auto is_zenith = [](double angle) { return angle >= 0 && angle <= std::numbers::pi; };
  check(std::isfinite(p.altitude_m) && p.altitude_m >= 0, "altitude_m", p.altitude_m, ">= 0");
  check(is_zenith(p.sun_zenith), "sun zenith (rad)", p.sun_zenith, "in 0 .. pi");
  check(is_zenith(p.view_zenith), "view zenith (rad)", p.view_zenith, "in 0 .. pi");
  check(std::isfinite(p.relative_azimuth), "relative azimuth (rad)", p.relative_azimuth, "finite");
}

ScatteredLight SkyModel::scattered_light(const Atmosphere<double>&, std::span<const WavelengthNode>,
                                         std::span<const SkyPoint>) const {
  throw std::invalid_argument(
      fmt::format("{} model: cannot be tabulated for rendering: it does not hold for every height, "
                  "direction and sun, or does not part air and aerosol",
                  name()));
}

std::size_t SkyModel::prepare(const Atmosphere<double>& atmosphere,
                              std::span<const WavelengthNode>) const {
  validate(atmosphere);
  return 0;
}

std::span<const SkyModelEntry> sky_models() {
  static constexpr SkyModelEntry kModels[] = {
      {"reference", "the yardstick: quadrature and converged multiple scattering in shells"},
      {"tables", "what the renderer looks up: tables of the reference"},
      {"bruneton", "Bruneton & Neyret 2008: 4D tables, multiple scattering"},
      {"bodare", "Bodare & Sandberg 2014: 3D tables, gathered multiple scattering"},
      {"schafhitzel", "Schafhitzel, Falk & Ertl 2007: 3D table, single scattering"},
      {"oneil", "O'Neil 2005: five samples along the ray, single scattering"},
      {"nielsen", "Nielsen 2003: closed form, mean density; day, up to 20 km"},
      {"hoffman-preetham", "Hoffman & Preetham 2002: closed form, constant density; day, ground"},
      {"preetham", "Preetham, Shirley & Smits 1999: formula over the turbidity; day, ground, sky"},
  };
  return kModels;
}

std::unique_ptr<SkyModel> make_sky_model(std::string_view name, const SpectralData& spectra,
                                         int threads) {
  if (name == "reference") {
    ReferenceOptions options;
    options.threads = threads;
    return std::make_unique<ReferenceModel>(options);
  }
  if (name == "tables") return std::make_unique<TableModel>(threads);
  if (name == "bruneton") return std::make_unique<BrunetonModel>(threads);
  if (name == "bodare") return std::make_unique<BodareModel>(threads);
  if (name == "schafhitzel") return std::make_unique<SchafhitzelModel>(threads);
  if (name == "oneil") return std::make_unique<ONeilModel>(threads);
  if (name == "nielsen") return std::make_unique<NielsenModel>();
  if (name == "hoffman-preetham") return std::make_unique<HoffmanPreethamModel>();
  if (name == "preetham") return std::make_unique<PreethamModel>(spectra);
  std::vector<std::string_view> names;
  for (const SkyModelEntry& entry : sky_models()) names.push_back(entry.name);
  throw std::invalid_argument(
      fmt::format("model \"{}\": expected one of {}", name, fmt::join(names, ", ")));
}

}  // namespace skyfit
