// SPDX-License-Identifier: Apache-2.0
#include "model/registry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>
#include <vector>

#include "model/literature/bodare.h"
#include "model/literature/bruneton.h"
#include "model/literature/hillaire.h"
#include "model/literature/hoffman_preetham.h"
#include "model/literature/nielsen.h"
#include "model/literature/oneil.h"
#include "model/literature/preetham.h"
#include "model/literature/schafhitzel.h"
#include "model/solver/reference_model.h"
#include "model/tables/table_model.h"

namespace skyfit {
namespace {

template <class Model>
std::unique_ptr<SkyModel> make(const SpectralData&, int, Transfer) {
  return std::make_unique<Model>();
}

template <class Model>
std::unique_ptr<SkyModel> make_threaded(const SpectralData&, int threads, Transfer) {
  return std::make_unique<Model>(threads);
}

std::unique_ptr<SkyModel> make_reference(const SpectralData&, int threads, Transfer transfer) {
  ReferenceOptions options;
  options.threads = threads;
  options.transfer = transfer;
  return std::make_unique<ReferenceModel>(options);
}

std::unique_ptr<SkyModel> make_tables(const SpectralData&, int threads, Transfer transfer) {
  return std::make_unique<TableModel>(threads, transfer);
}

std::unique_ptr<SkyModel> make_preetham(const SpectralData& spectra, int, Transfer) {
  return std::make_unique<PreethamModel>(spectra);
}

}  // namespace

std::span<const SkyModelEntry> sky_models() {
  static constexpr SkyModelEntry kModels[] = {
      {"reference", "the yardstick: quadrature and converged multiple scattering in shells",
       make_reference},
      {"tables", "what the renderer looks up: tables of the reference", make_tables},
      {"bruneton", "Bruneton & Neyret 2008: 4D tables, multiple scattering",
       make_threaded<BrunetonModel>},
      {"bodare", "Bodare & Sandberg 2014: 3D tables, gathered multiple scattering",
       make_threaded<BodareModel>},
      {"hillaire", "Hillaire 2020, as engines do: 2D tables, multiple scattering as a series",
       make_threaded<HillaireModel>},
      {"schafhitzel", "Schafhitzel, Falk & Ertl 2007: 3D table, single scattering",
       make_threaded<SchafhitzelModel>},
      {"oneil", "O'Neil 2005: five samples along the ray, single scattering",
       make_threaded<ONeilModel>},
      {"nielsen", "Nielsen 2003: closed form, mean density; day, up to 20 km", make<NielsenModel>},
      {"hoffman-preetham", "Hoffman & Preetham 2002: closed form, constant density; day, ground",
       make<HoffmanPreethamModel>},
      {"preetham", "Preetham, Shirley & Smits 1999: formula over the turbidity; day, ground, sky",
       make_preetham},
  };
  return kModels;
}

std::unique_ptr<SkyModel> make_sky_model(std::string_view name, const SpectralData& spectra,
                                         int threads, Transfer transfer) {
  std::vector<std::string_view> names;
  for (const SkyModelEntry& entry : sky_models()) {
    if (entry.name == name) return entry.make(spectra, threads, transfer);
    names.push_back(entry.name);
  }
  throw std::invalid_argument(
      fmt::format("model \"{}\": expected one of {}", name, fmt::join(names, ", ")));
}

}  // namespace skyfit
