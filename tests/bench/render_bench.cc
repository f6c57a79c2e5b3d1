// SPDX-License-Identifier: Apache-2.0
// Frames of a planet in software: the whole frame with all blocks made and all shaders compiled,
// without reading it back; the counters are the passes (ms, by the device's timers) and what the
// culling leaves.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "render/render.h"

namespace skyfit {
namespace {

const Preset& preset() {
  static const Preset loaded =
      parse_preset(refs::shipped_preset_json("earth-clear"), "earth-clear");
  return loaded;
}

Renderer& renderer() {
  static Renderer made = [] {
    Renderer renderer;
    renderer.set_atmosphere(preset(), compute_tables(preset().atmosphere,
                                                     color_rule(refs::standard_spectral_data()),
                                                     TableSizes{}, 2, {}));
    return renderer;
  }();
  return made;
}

FrameOptions options_of(const char* view, int width, int height) {
  FrameOptions options;
  const NamedView& named = find_view(view);
  options.width = width;
  options.height = height;
  options.camera = named.camera;
  options.site = named.site;
  options.sun_zenith = named.sun_zenith;
  options.samples_per_side = 1;
  if (options.site) options.camera.altitude_m += renderer().ground_height_m(options.site);
  return options;
}

void run(benchmark::State& state, const FrameOptions& options) {
  renderer().draw(options);
  FrameStatistics statistics;
  for (auto _ : state) {
    statistics = renderer().draw(options).statistics;
    state.SetIterationTime(1e-3 * statistics.milliseconds);
    for (const PassTime& pass : statistics.passes) {
      state.counters[pass.pass] += pass.milliseconds / static_cast<double>(state.max_iterations);
    }
  }
  state.counters["triangles"] = static_cast<double>(statistics.triangles);
  state.counters["blocks"] = statistics.blocks_drawn;
}

void View(benchmark::State& state, const char* view, int width, int height) {
  run(state, options_of(view, width, height));
}

#define SKYFIT_VIEW(name, view, width, height)          \
  BENCHMARK_CAPTURE(View, name, view, width, height)    \
      ->UseManualTime()                                 \
      ->Iterations(10)                                  \
      ->Unit(benchmark::kMillisecond)

SKYFIT_VIEW(valley_1280x720, "valley", 1280, 720);
SKYFIT_VIEW(valley_640x360, "valley", 640, 360);
SKYFIT_VIEW(ground_1280x720, "ground", 1280, 720);
SKYFIT_VIEW(limb_1280x720, "limb", 1280, 720);

}  // namespace
}  // namespace skyfit
