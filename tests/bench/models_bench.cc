// SPDX-License-Identifier: Apache-2.0
// The models of the literature: a sky of 315 directions at one wavelength with everything that they
// precompute, alone and with seven derivatives; and the look-ups of prepared tables.
#include <benchmark/benchmark.h>

#include <numbers>

#include "data_refs/spectra.h"
#include "model/registry.h"
#include "model/sky_model.h"

namespace skyfit {
namespace {

constexpr WavelengthNode kGreen{550, 0};
constexpr Parameter kSeven[] = {
    Parameter::kRayleighScattering, Parameter::kRayleighScaleHeight,
    Parameter::kMieScattering,      Parameter::kMieSingleScatteringAlbedo,
    Parameter::kMieScaleHeight,     Parameter::kMiePhaseG,
    Parameter::kGroundAlbedo};

std::vector<SkyPoint> sky_points() {
  constexpr double kDegree = std::numbers::pi / 180;
  std::vector<SkyPoint> points;
  for (int sun = 0; sun <= 80; sun += 10) {
    for (int i = 0; i < 35; ++i)
      points.push_back({0, sun * kDegree, (85.0 - 5 * (i % 18)) * kDegree, i < 18 ? 0.0 : 3.0});
  }
  return points;
}

Atmosphere<double> haze() {
  Atmosphere<double> a;
  a.at("mie").amount = 1.5e-4;
  return a;
}

void Sky(benchmark::State& state, const char* name, std::span<const Parameter> derivatives,
         bool prepared) {
  const auto model = make_sky_model(name, refs::standard_spectral_data(), 1);
  const std::vector<SkyPoint> points = sky_points();
  if (prepared) model->prepare(haze(), {&kGreen, 1});
  for (auto _ : state)
    benchmark::DoNotOptimize(model->radiance(haze(), {&kGreen, 1}, points, derivatives));
}

const bool kRegistered = [] {
  for (const char* name : {"reference", "bruneton", "bodare", "hillaire", "schafhitzel", "oneil",
                           "nielsen", "hoffman-preetham", "preetham", "hosek-wilkie"}) {
    const auto add = [&](const char* what, std::span<const Parameter> derivatives, bool prepared) {
      benchmark::RegisterBenchmark(
          (std::string(what) + "/" + name).c_str(),
          [=](benchmark::State& state) { Sky(state, name, derivatives, prepared); })
          ->Unit(benchmark::kMillisecond);
    };
    add("Sky", {}, false);
    add("SkyWithSevenDerivatives", kSeven, false);
    add("SkyFromPreparedTables", {}, true);
  }
  return true;
}();

}  // namespace
}  // namespace skyfit
