// SPDX-License-Identifier: Apache-2.0
// The forward model: 4 nodes x 9 suns x 115 directions at the ground, value alone and with ten
// derivatives, with polarisation and without, and how the cost grows with directions and
// wavelengths.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "data_refs/spectra.h"
#include "model/registry.h"
#include "model/sky_model.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::vector<SkyPoint> sky_points(int directions) {
  std::vector<SkyPoint> points;
  for (int sun = 0; sun <= 80; sun += 10) {
    for (int i = 0; i < directions; ++i) {
      const double zenith = 85.0 * ((i % 23) + 0.5) / 23, azimuth = 180.0 * (i / 23) / 4;
      points.push_back({0, sun * kDegree, zenith * kDegree, azimuth * kDegree});
    }
  }
  return points;
}

Atmosphere<double> two_lobe_earth() {
  Atmosphere<double> a;
  a.at("mie").amount = 1.5e-4;
  a.at("mie").phase = {PhaseType::kTwoLobe, 0, 0.75, 0.3, 0.4};
  return a;
}

// The same amount of aerosol, as particles.
Atmosphere<double> earth_of_particles() {
  Atmosphere<double> a = two_lobe_earth();
  PhaseFunction<double>& phase = a.at("mie").phase;
  phase.type = PhaseType::kSizeDistribution;
  phase.particles.tables = std::make_shared<const ParticleTables>();
  return a;
}

const std::vector<Parameter> kTen = {
    Parameter::kRayleighScattering, Parameter::kRayleighScaleHeight,
    Parameter::kMieScattering,      Parameter::kMieSingleScatteringAlbedo,
    Parameter::kMieScaleHeight,     Parameter::kMiePhaseG1,
    Parameter::kMiePhaseG2,         Parameter::kMiePhaseWeight,
    Parameter::kOzoneColumn,        Parameter::kGroundAlbedo};

void run(benchmark::State& state, int directions, int node_count,
         const std::vector<Parameter>& derivatives, int threads,
         Transfer transfer = Transfer::kVector,
         const Atmosphere<double>& atmosphere = two_lobe_earth()) {
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), threads, transfer);
  const auto points = sky_points(directions);
  std::vector<double> nm;
  for (int k = 0; k < node_count; ++k) nm.push_back(450 + 200.0 * (k + 0.5) / node_count);
  const auto nodes = spectral_nodes(refs::standard_spectral_data(), nm);
  for (auto _ : state) {
    benchmark::DoNotOptimize(model->radiance(atmosphere, nodes, points, derivatives));
  }
}

void Value(benchmark::State& state) { run(state, 115, 4, {}, static_cast<int>(state.range(0))); }
void ValueAndTenDerivatives(benchmark::State& state) {
  run(state, 115, 4, kTen, static_cast<int>(state.range(0)));
}
void ScalarValue(benchmark::State& state) { run(state, 115, 4, {}, 1, Transfer::kScalar); }
void ScalarValueAndTenDerivatives(benchmark::State& state) {
  run(state, 115, 4, kTen, 1, Transfer::kScalar);
}
// Radiance, and all three Stokes parameters.
void ParticlesValue(benchmark::State& state) {
  run(state, 115, 4, {}, 1, Transfer::kVector, earth_of_particles());
}
void ParticlesStokes(benchmark::State& state) {
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 1);
  const std::vector<double> nm = {475, 525, 575, 625};
  const auto nodes = spectral_nodes(refs::standard_spectral_data(), nm);
  const auto points = sky_points(115);
  const Atmosphere<double> atmosphere = earth_of_particles();
  for (auto _ : state) benchmark::DoNotOptimize(model->stokes(atmosphere, nodes, points, {}));
}
void ValueByDirections(benchmark::State& state) {
  run(state, static_cast<int>(state.range(0)), 4, {}, 1);
}
void ValueByWavelengths(benchmark::State& state) {
  run(state, 115, static_cast<int>(state.range(0)), {}, 1);
}

BENCHMARK(Value)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(ValueAndTenDerivatives)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(ScalarValue)->Unit(benchmark::kMillisecond);
BENCHMARK(ScalarValueAndTenDerivatives)->Unit(benchmark::kMillisecond);
BENCHMARK(ParticlesValue)->Unit(benchmark::kMillisecond);
BENCHMARK(ParticlesStokes)->Unit(benchmark::kMillisecond);
BENCHMARK(ValueByDirections)->Arg(115)->Arg(230)->Arg(460)->Unit(benchmark::kMillisecond);
BENCHMARK(ValueByWavelengths)->Arg(1)->Arg(2)->Arg(4)->Arg(8)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skyfit
