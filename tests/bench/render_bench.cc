// SPDX-License-Identifier: Apache-2.0
// Frames of a planet that follow one another, in software and on a GPU, with all blocks made and
// all shaders compiled, not read back: the time from one to the next, for the device draws one
// while the next is prepared; the medians count. The counters are of frames that wait for each
// other: the time of one and of its passes (ms, by the device's timers), and what the culling
// leaves. EightFetches is a full-screen pass with eight fetches from the scattering tables: what
// the atmosphere's pass is held against.
#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "render/gl/atmosphere/atmosphere_pass.h"
#include "render/gl/context/context.h"
#include "render/gl/context/shader.h"
#include "render/gl/passes/passes.h"
#include "render/render.h"

namespace skyfit {
namespace {

constexpr int kFrames = 15;

const Preset& preset() {
  static const Preset loaded =
      parse_preset(refs::shipped_preset_json("earth-clear"), "earth-clear");
  return loaded;
}

const AtmosphereTables& tables() {
  static const AtmosphereTables made = compute_tables(
      preset().atmosphere, color_rule(refs::standard_spectral_data()), TableSizes{}, 2, {});
  return made;
}

// Throws std::runtime_error where there is no such device.
Renderer& renderer(GraphicsDevice device) {
  static std::map<GraphicsDevice, Renderer> made;
  const auto found = made.find(device);
  if (found != made.end()) return found->second;
  Renderer renderer({}, device);
  renderer.set_atmosphere(preset(), tables());
  return made.emplace(device, std::move(renderer)).first->second;
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
  if (options.site)
    options.camera.altitude_m += renderer(GraphicsDevice::kSoftware).ground_height_m(options.site);
  return options;
}

// A GPU without work lowers its clock.
void warm_up(const std::function<void()>& draw) {
  const auto start = std::chrono::steady_clock::now();
  do draw();
  while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(200));
}

void run(benchmark::State& state, Renderer& renderer, const FrameOptions& options) {
  warm_up([&] { renderer.submit(options); });
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    renderer.submit(options);
    state.SetIterationTime(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  renderer.wait();
  renderer.submit(options);
  const FrameStatistics statistics = renderer.wait();
  for (const PassTime& pass : statistics.passes) state.counters[pass.pass] = pass.milliseconds;
  state.counters["alone"] = statistics.milliseconds;
  state.counters["triangles"] = static_cast<double>(statistics.triangles);
  state.counters["blocks"] = statistics.blocks_drawn;
}

void View(benchmark::State& state, const char* view, int width, int height,
          AerialPerspective aerial) {
  FrameOptions options = options_of(view, width, height);
  options.aerial = aerial;
  run(state, renderer(GraphicsDevice::kSoftware), options);
}

// The atmosphere's pass does not depend on the scene: the same view with few and with many
// triangles.
void Triangles(benchmark::State& state, double samples_per_quad) {
  FrameOptions options = options_of("space", 1280, 720);
  options.samples_per_quad = samples_per_quad;
  run(state, renderer(GraphicsDevice::kSoftware), options);
}

// Whatever EGL finds; the label says what it was.
void Gpu(benchmark::State& state, const char* view) {
  try {
    state.SetLabel(make_egl_context()->description());
    run(state, renderer(GraphicsDevice::kGpu), options_of(view, 1920, 1080));
  } catch (const std::runtime_error& error) {
    state.SkipWithError(error.what());
  }
}

void EightFetches(benchmark::State& state, GraphicsDevice device, int width, int height) {
  std::unique_ptr<GlContext> context;
  try {
    context = make_context(device);
  } catch (const std::runtime_error& error) {
    state.SkipWithError(error.what());
    return;
  }
  state.SetLabel(context->description());
  FrameGraph graph;
  add_tables(tables(), graph);
  graph.add_target("light", GL_RGBA32F, width, height);
  const ShaderSource source{"eight.frag",
                            "in vec2 screen;\n"
                            "layout(binding = 0) uniform sampler3D first;\n"
                            "layout(binding = 1) uniform sampler3D second;\n"
                            "layout(location = 0) out vec4 light;\n"
                            "void main() {\n"
                            "  light = vec4(0.0);\n"
                            "  vec3 at = vec3(0.5 + 0.4 * screen, 0.3);\n"
                            "  for (int i = 0; i < 4; ++i) {\n"
                            "    at.z += 0.05;\n"
                            "    light += texture(first, at) + texture(second, at);\n"
                            "  }\n"
                            "}\n"};
  const GlProgram program =
      build_program(std::array{ShaderStage{GL_VERTEX_SHADER, "render/shaders/fullscreen.vert"},
                               ShaderStage{GL_FRAGMENT_SHADER, "eight.frag"}},
                    std::span(&source, 1));
  const GlVertexArray empty = make_vertex_array();
  const std::vector<Pass> passes = {{"eight fetches", {"rayleigh_like", "single"}, {"light"}, [&] {
                                       glUseProgram(program.id());
                                       glBindVertexArray(empty.id());
                                       glDrawArrays(GL_TRIANGLES, 0, 3);
                                     }}};
  warm_up([&] { graph.run(passes).times(); });
  for (auto _ : state)
    state.SetIterationTime(1e-3 * graph.run(passes).times().front().milliseconds);
}

// A frame an iteration: the library's aggregates are those of frames.
void frames(benchmark::internal::Benchmark* benchmark) {
  benchmark->UseManualTime()
      ->Iterations(1)
      ->Repetitions(kFrames)
      ->DisplayAggregatesOnly(true)
      ->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(EightFetches, 1280x720, GraphicsDevice::kSoftware, 1280, 720)->Apply(frames);
BENCHMARK_CAPTURE(Triangles, few, 64)->Apply(frames);
BENCHMARK_CAPTURE(Triangles, many, 3)->Apply(frames);
BENCHMARK_CAPTURE(View, valley_1280x720, "valley", 1280, 720, AerialPerspective::kVolume)
    ->Apply(frames);
BENCHMARK_CAPTURE(View, valley_1280x720_by_pixel, "valley", 1280, 720, AerialPerspective::kPerPixel)
    ->Apply(frames);
BENCHMARK_CAPTURE(View, valley_640x360, "valley", 640, 360, AerialPerspective::kVolume)
    ->Apply(frames);
BENCHMARK_CAPTURE(View, ground_1280x720, "ground", 1280, 720, AerialPerspective::kVolume)
    ->Apply(frames);
BENCHMARK_CAPTURE(View, limb_1280x720, "limb", 1280, 720, AerialPerspective::kVolume)
    ->Apply(frames);

BENCHMARK_CAPTURE(EightFetches, gpu_1920x1080, GraphicsDevice::kGpu, 1920, 1080)->Apply(frames);
BENCHMARK_CAPTURE(Gpu, valley_1920x1080, "valley")->Apply(frames);
BENCHMARK_CAPTURE(Gpu, ground_1920x1080, "ground")->Apply(frames);
BENCHMARK_CAPTURE(Gpu, space_1920x1080, "space")->Apply(frames);
BENCHMARK_CAPTURE(Gpu, limb_1920x1080, "limb")->Apply(frames);

}  // namespace
}  // namespace skyfit
