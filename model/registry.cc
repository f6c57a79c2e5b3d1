// SPDX-License-Identifier: Apache-2.0
#include "model/registry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <ranges>
#include <set>
#include <stdexcept>
#include <vector>

#include "model/literature/bodare.h"
#include "model/literature/bruneton.h"
#include "model/literature/hillaire.h"
#include "model/literature/hoffman_preetham.h"
#include "model/literature/hosek_wilkie.h"
#include "model/literature/nielsen.h"
#include "model/literature/oneil.h"
#include "model/literature/preetham.h"
#include "model/literature/schafhitzel.h"
#include "model/solver/reference_model.h"
#include "model/tables/table_model.h"

namespace skyfit {
namespace {

template <class Model>
std::unique_ptr<SkyModel> make(const SkyModelRequest&) {
  return std::make_unique<Model>();
}

template <class Model>
std::unique_ptr<SkyModel> make_threaded(const SkyModelRequest& request) {
  return std::make_unique<Model>(request.threads);
}

constexpr SkyModelVariant kReferenceVariants[] = {
    {ReferenceModel::kRefraction,
     "rays are curved by air: view angles are apparent, suns stand where they would without air",
     false},
};

std::unique_ptr<SkyModel> make_reference(const SkyModelRequest& request) {
  ReferenceOptions options;
  options.threads = request.threads;
  options.transfer = request.transfer;
  options.refraction = !request.variants.empty();
  return std::make_unique<ReferenceModel>(options);
}

std::unique_ptr<SkyModel> make_tables(const SkyModelRequest& request) {
  return std::make_unique<TableModel>(request.threads, request.transfer);
}

template <class Model>
std::unique_ptr<SkyModel> make_with_spectra(const SkyModelRequest& request) {
  return std::make_unique<Model>(request.spectra);
}

constexpr SkyModelVariant kNielsenVariants[] = {
    {NielsenModel::kMeanHeight,
     "paths to the ground have the density at the mean of their heights"},
    {NielsenModel::kRayleighPhase, "air scatters by Rayleigh's phase function"},
    {NielsenModel::kSunThroughSky, "the sun's light is what the model's sky lets through"},
};

constexpr SkyModelVariant kBrunetonVariants[] = {
    {BrunetonMethod::kHalfTransmittance,
     "the transmittance of a path is the quotient of two look-ups in half floats"},
    {BrunetonMethod::kHalfInScatter,
     "in-scatter in half floats, looked up by radii in single precision, before surfaces as the "
     "difference of two look-ups"},
    {BrunetonMethod::kMieFromRayleigh,
     "single Mie scattering follows from all other light, by the proportion of the two at 680 nm"},
};

std::unique_ptr<SkyModel> make_bruneton(const SkyModelRequest& request) {
  return std::make_unique<BrunetonModel>(
      request.threads, BrunetonMethod(bruneton_choices(request.variants),
                                      node_at(request.spectra, BrunetonMethod::kRedNm)));
}

constexpr SkyModelVariant kBodareVariants[] = {
    {BodareMieFromRayleighMethod::kVariant,
     "aerosol's light is air's, by the proportion of the two at 650 nm, as in the source"},
};

std::unique_ptr<SkyModel> make_bodare(const SkyModelRequest& request) {
  if (request.variants.empty()) return std::make_unique<BodareModel>(request.threads);
  return std::make_unique<BodareMieFromRayleighModel>(
      request.threads, BodareMieFromRayleighMethod{
                           {}, node_at(request.spectra, BodareMieFromRayleighMethod::kRedNm)});
}

constexpr SkyModelVariant kONeilVariants[] = {
    {ONeilModel::kSamplesN, "N samples of a ray in the place of 5: 1 to 1000", true, 1,
     ONeilModel::kMostSamples},
    {ONeilModel::kIsotropicAir, "air scatters alike in all directions, as in the source's demo"},
    {ONeilModel::kNoShadow,
     "no test of the planet's shadow, as in the source; of planets of his geometry alone"},
};

std::unique_ptr<SkyModel> make_oneil(const SkyModelRequest& request) {
  return std::make_unique<ONeilModel>(request.threads, oneil_choices(request.variants));
}

std::unique_ptr<SkyModel> make_nielsen(const SkyModelRequest& request) {
  return std::make_unique<NielsenModel>(nielsen_choices(request.variants));
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> parts;
  for (const auto part : std::views::split(text, ':')) parts.emplace_back(part.begin(), part.end());
  return parts;
}

// Throws std::invalid_argument that names the number.
bool is_variant(std::string_view model, std::string_view variant, const SkyModelVariant& row) {
  if (row.most == 0) return variant == row.name;
  const std::string_view prefix = row.name.substr(0, row.name.size() - 1);  // without the N
  if (!variant.starts_with(prefix)) return false;
  const std::string_view digits = variant.substr(prefix.size());
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size() || number < row.least ||
      number > row.most) {
    throw std::invalid_argument(
        fmt::format("model \"{}\": variant \"{}\": expected a whole number from {} to {}", model,
                    variant, row.least, row.most));
  }
  return true;
}

}  // namespace

std::span<const SkyModelEntry> sky_models() {
  static constexpr SkyModelEntry kModels[] = {
      {"reference", "the yardstick: quadrature and converged multiple scattering in shells",
       make_reference, kReferenceVariants},
      {"tables", "what the renderer looks up: tables of the reference", make_tables},
      {"bruneton", "Bruneton & Neyret 2008: 4D tables, multiple scattering", make_bruneton,
       kBrunetonVariants},
      {"bodare", "Bodare & Sandberg 2014: 3D tables, gathered multiple scattering", make_bodare,
       kBodareVariants},
      {"hillaire", "Hillaire 2020, as engines do: 2D tables, multiple scattering as a series",
       make_threaded<HillaireModel>},
      {"schafhitzel", "Schafhitzel, Falk & Ertl 2007: 3D table, single scattering",
       make_threaded<SchafhitzelModel>},
      {"oneil", "O'Neil 2005: five samples along the ray, single scattering", make_oneil,
       kONeilVariants},
      {"nielsen", "Nielsen 2003: closed form, mean density; day, up to 30 km", make_nielsen,
       kNielsenVariants},
      {"hoffman-preetham",
       "Hoffman & Preetham 2002: closed form, constant density; day, up to 10 km",
       make<HoffmanPreethamModel>},
      {"preetham",
       "Preetham, Shirley & Smits 1999: formula over the turbidity; day, up to 3 km, sky",
       make_with_spectra<PreethamModel>,
       {},
       /*sees_ground=*/false},
      {"hosek-wilkie",
       "Hosek & Wilkie 2012: formula over turbidity and albedo; day, up to 3 km, sky",
       make_with_spectra<HosekWilkieModel>,
       {},
       /*sees_ground=*/false},
  };
  return kModels;
}

const SkyModelEntry& sky_model_entry(std::string_view name) {
  std::vector<std::string_view> names;
  for (const SkyModelEntry& entry : sky_models()) {
    if (entry.name == name.substr(0, name.find(':'))) return entry;
    names.push_back(entry.name);
  }
  throw std::invalid_argument(
      fmt::format("model \"{}\": expected one of {}", name, fmt::join(names, ", ")));
}

bool draws_frames(std::string_view name) {
  const SkyModelEntry& entry = sky_model_entry(name);
  const std::vector<std::string_view> parts = split(name);
  return std::ranges::none_of(entry.variants, [&](const auto& variant) {
    return !variant.draws_frames && std::ranges::count(parts, variant.name) > 0;
  });
}

std::unique_ptr<SkyModel> make_sky_model(std::string_view name, const SpectralData& spectra,
                                         int threads, Transfer transfer) {
  const SkyModelEntry& entry = sky_model_entry(name);
  std::vector<std::string_view> variants = split(name);
  variants.erase(variants.begin());
  std::set<std::string_view> given;  // rows
  for (const std::string_view variant : variants) {
    const auto found = std::ranges::find_if(
        entry.variants, [&](const auto& row) { return is_variant(name, variant, row); });
    if (found != entry.variants.end()) {
      if (given.insert(found->name).second) continue;
      throw std::invalid_argument(fmt::format("model \"{}\": variant \"{}\": expected {} once",
                                              name, variant, found->name));
    }
    std::vector<std::string_view> known;
    for (const SkyModelVariant& row : entry.variants) known.push_back(row.name);
    throw std::invalid_argument(
        fmt::format("model \"{}\": variant \"{}\": expected {}", name, variant,
                    known.empty() ? "none" : fmt::format("one of {}", fmt::join(known, ", "))));
  }
  return entry.make({spectra, threads, transfer, variants});
}

}  // namespace skyfit
