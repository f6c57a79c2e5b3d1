// SPDX-License-Identifier: Apache-2.0
// A joint fit of CIE type 12 over nine suns, two lobes and four starts, against one evaluation of
// the model.
#include <benchmark/benchmark.h>

#include <numbers>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "fit/fit.h"
#include "model/registry.h"

namespace skyfit {
namespace {

void FitOfCie12(benchmark::State& state) {
  std::vector<double> suns;
  for (int sun = 0; sun <= 80; sun += 10) suns.push_back(sun * std::numbers::pi / 180);
  const refs::Reference reference =
      refs::load_reference("cie:12", suns, refs::Sampling::kPrincipalPlane);
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 1);
  fit::FitOptions options;
  options.lobes = static_cast<int>(state.range(0));
  for (auto _ : state) {
    const fit::Result result =
        fit::fit_atmosphere(reference, refs::standard_spectral_data(), *model, options);
    state.counters["rms_log_percent"] = result.errors.rms_log;
  }
}
BENCHMARK(FitOfCie12)->Arg(1)->Arg(2)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

}  // namespace
}  // namespace skyfit
