// SPDX-License-Identifier: Apache-2.0
// The renderer's tables, which `tables` evaluates: making them at their default size (CPU time is
// what counts) and one look-up.
#include <benchmark/benchmark.h>

#include <cmath>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/preset.h"
#include "model/tables/table_lookup.h"

namespace skyfit {
namespace {

AtmosphereTables tables_of(const char* preset) {
  return compute_tables(parse_preset(refs::shipped_preset_json(preset), preset).atmosphere,
                        color_rule(refs::standard_spectral_data()), TableSizes{}, 1, {});
}

void ComputeTables(benchmark::State& state, const char* preset) {
  std::size_t floats = 0;
  for (auto _ : state) {
    const AtmosphereTables tables = tables_of(preset);
    floats = 0;
    for (const Table* table : {&tables.rayleigh_like, &tables.single, &tables.optical_depth,
                               &tables.irradiance, &tables.sky_rays.air, &tables.sky_rays.aerosol})
      floats += table->rgba.size();
    benchmark::DoNotOptimize(floats);
  }
  state.counters["megabytes"] = 1e-6 * sizeof(float) * static_cast<double>(floats);
}

// Directions that lie apart, so that the texels of one are not in the cache for the next.
void LookupRadiance(benchmark::State& state) {
  const AtmosphereTables tables = tables_of("earth-clear");
  const double top = tables.atmosphere.top_radius_m - tables.atmosphere.bottom_radius_m;
  const auto golden = [](int i, double step) { return std::fmod(i * step, 1.0); };
  int i = 0;
  for (auto _ : state) {
    ++i;
    const double h = 0.9 * top * golden(i, 0.8191725134), mu = golden(i, 0.6710436067),
                 mu_s = golden(i, 0.5497004779);
    const double nu =
        mu * mu_s + std::sqrt((1 - mu * mu) * (1 - mu_s * mu_s)) * (2 * golden(i, 0.4503) - 1);
    benchmark::DoNotOptimize(lookup_radiance(tables, h, mu, mu_s, nu, false));
  }
}

BENCHMARK_CAPTURE(ComputeTables, earth_clear, "earth-clear")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ComputeTables, mars, "mars")->Unit(benchmark::kMillisecond);
BENCHMARK(LookupRadiance)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace skyfit
