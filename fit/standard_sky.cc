// SPDX-License-Identifier: Apache-2.0
#include "fit/standard_sky.h"

#include <fmt/format.h>

#include <algorithm>

#include "data_refs/cie_sky.h"
#include "data_refs/references.h"
#include "fit/problem/free_parameters.h"

namespace skyfit::fit {
namespace {

constexpr Parameter kCloudOpticalDepth{"cloud", Quantity::kOpticalDepth};

// - Single scattering albedo and ground without snow: the ranges of findings.cc.
// - Scale height of aerosol: from a shallow to a deep mixed layer.
// - Scattering of aerosol under a cloud: with the scale height of the presets and the least single
//   scattering albedo an optical depth of 0.67, that of a town's air.
// - Ground under a cloud: from water to clean fresh snow (Warren 1982: 0.97 to 0.99 in visible
// light).
// - The sky under a cloud of more than 40 has the shape of that under one of 40: fits of type 1
// with
//   30 to 120 have the same residual, 2.91 %.
constexpr Bounds kAlbedoOfAerosol{0.82, 1}, kMixedLayer{800, 3000}, kLobe{0, 0.98}, kShare{0, 1},
    kGroundWithoutSnow{0.03, 0.4}, kAnyGround{0.03, 0.99}, kAnyAerosol{1e-7, 2e-3},
    kAerosolUnderCloud{1e-6, 4.6e-4}, kCloudDepth{0.1, 40};

const std::vector<StandardSkyKind>& kinds() {
  static const std::vector<StandardSkyKind> kAll = {
      {"clear",
       "aerosol of one or two lobes, no cloud",
       "",
       {7, 8, 9, 10, 11, 12, 13, 14, 15},
       {{Parameter::kMieScattering, kAnyAerosol},
        {Parameter::kMieSingleScatteringAlbedo, kAlbedoOfAerosol},
        {Parameter::kMieScaleHeight, kMixedLayer},
        {Parameter::kMiePhaseG, kLobe},
        {Parameter::kMiePhaseG1, kLobe},
        {Parameter::kMiePhaseG2, kLobe},
        {Parameter::kMiePhaseWeight, kShare},
        {Parameter::kGroundAlbedo, kGroundWithoutSnow}}},
      {"cloud over haze",
       "a closed cloud, thin at the start, over haze that absorbs, any ground",
       "thin-cloud",
       {1, 2, 4, 6},
       {{Parameter::kMieScattering, kAerosolUnderCloud},
        {Parameter::kMieSingleScatteringAlbedo, kAlbedoOfAerosol},
        {kCloudOpticalDepth, kCloudDepth},
        {Parameter::kGroundAlbedo, kAnyGround}}},
      {"overcast",
       "a closed thick cloud over any ground",
       "overcast",
       {3, 5},
       {{kCloudOpticalDepth, kCloudDepth}, {Parameter::kGroundAlbedo, kAnyGround}}},
  };
  return kAll;
}

// The models of the literature know air and one aerosol.
bool knows_clouds(const SkyModel& model) {
  return model.name() == "reference" || model.name() == "tables";
}

Atmosphere<double> start_with_lobes(const FitOptions& options) {
  return with_lobes(start_atmosphere(options), options.lobes);
}

}  // namespace

std::span<const StandardSkyKind> standard_sky_kinds() { return kinds(); }

std::optional<int> standard_sky_type(std::string_view reference) {
  for (const refs::CieSky& sky : refs::cie_skies()) {
    if (reference == fmt::format("cie:{}", sky.type)) return sky.type;
  }
  return {};
}

const StandardSkyKind& standard_sky_kind(int type, const SkyModel& model) {
  if (!knows_clouds(model)) return kinds().front();
  return *std::ranges::find_if(kinds(), [type](const StandardSkyKind& kind) {
    return std::ranges::count(kind.types, type) > 0;
  });
}

FitOptions with_standard_sky(const FitOptions& options, const StandardSkyKind& kind,
                             const SkyModel& model) {
  if (options.start) return options;
  FitOptions result = options;
  if (!kind.preset.empty())
    result.start = parse_preset(refs::shipped_preset_json(kind.preset), kind.preset);
  result.use_priors = false;
  const Atmosphere<double> atmosphere = start_with_lobes(result);
  if (!options.free) {
    result.free.emplace();
    for (const auto& [id, bounds] : kind.free) {
      const bool held = options.fix.contains(id) || !model.can_fit(id);
      if (!held && has_parameter(atmosphere, id)) result.free->push_back(id);
    }
  }
  for (const auto& [id, bounds] : kind.free) {
    if (std::ranges::count(*result.free, id) > 0) result.bounds.emplace(id, bounds);
  }
  return result;
}

}  // namespace skyfit::fit
