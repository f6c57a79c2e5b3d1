// SPDX-License-Identifier: Apache-2.0
#include "render/gl/renderer.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "render/gl/atmosphere_pass.h"
#include "render/gl/context.h"
#include "render/gl/map_ground.h"
#include "render/gl/object_pass.h"
#include "render/gl/passes.h"
#include "render/gl/relief.h"
#include "render/gl/shadow_pass.h"
#include "render/gl/terrain_pass.h"

namespace skyfit {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr std::int64_t kMaxSamples = std::int64_t{1} << 25;  // 16 bytes each in the largest texture

// Large pictures have small pixels: fewer samples where the textures would not fit.
int affordable_samples(const FrameOptions& options) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  const int longer = std::max(options.width, options.height);
  if (longer > limit) {
    throw std::invalid_argument(
        fmt::format("render: {} x {} pixels: this OpenGL draws at most {} on a side", options.width,
                    options.height, limit));
  }
  int samples = options.samples_per_side;
  const std::int64_t pixels = std::int64_t{options.width} * options.height;
  while (samples > 1 && (longer * samples > limit || pixels * samples * samples > kMaxSamples))
    --samples;
  return samples;
}

void add_targets(int width, int height, bool layers, FrameGraph& graph) {
  graph.add_target("color", GL_RGBA8, width, height);
  graph.add_target("surface", GL_RGBA16F, width, height);
  graph.add_target("depth", GL_DEPTH_COMPONENT32F, width, height);
  graph.add_target("light", GL_RGBA32F, width, height);
  graph.add_target("distance", GL_R32F, width, height);
  graph.add_target("class", GL_DEPTH_COMPONENT32F, width, height);
  if (!layers) return;
  for (const std::string& layer : kLayerWrites)
    graph.add_target(layer, GL_RGBA32F, width, height);
}

void clear_gbuffer() {
  const std::array<float, 4> nothing{};
  const float far_depth = 0;
  glClearBufferfv(GL_COLOR, 0, nothing.data());
  glClearBufferfv(GL_COLOR, 1, nothing.data());
  glClearBufferfv(GL_DEPTH, 0, &far_depth);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
}

// Calls f(pixel, sample) for every sample; OpenGL's rows run upward, a frame's downward.
template <class F>
void for_samples(const Frame& frame, int samples, F&& f) {
  const auto width = static_cast<std::size_t>(frame.width) * samples;
  for (int y = 0; y < frame.height * samples; ++y) {
    const auto row = static_cast<std::size_t>(frame.height - 1 - y / samples) * frame.width;
    for (std::size_t x = 0; x < width; ++x)
      f(row + x / samples, static_cast<std::size_t>(y) * width + x);
  }
}

void resolve_light(const FrameGraph& graph, int samples, Frame& frame) {
  const auto pixels = static_cast<std::size_t>(frame.width) * frame.height;
  const float part = 1.0f / static_cast<float>(samples * samples);
  const std::vector<float> light = graph.read_back("light", GL_RGBA, 4);
  frame.rgb.assign(3 * pixels, 0);
  frame.luminance.assign(pixels, 0);
  for_samples(frame, samples, [&](std::size_t pixel, std::size_t sample) {
    for (std::size_t k = 0; k < 3; ++k) frame.rgb[3 * pixel + k] += part * light[4 * sample + k];
    frame.luminance[pixel] += part * light[4 * sample + 3];
  });
  const std::vector<float> distance = graph.read_back("distance", GL_RED, 1);
  frame.depth_m.assign(pixels, std::numeric_limits<float>::infinity());
  for_samples(frame, samples, [&](std::size_t pixel, std::size_t sample) {
    frame.depth_m[pixel] = std::min(frame.depth_m[pixel], 1e3f * distance[sample]);
  });
}

// [pixel][3], the mean of the samples.
std::vector<float> resolve_color(const FrameGraph& graph, const std::string& name, int samples,
                                 const Frame& frame) {
  const std::vector<float> source = graph.read_back(name, GL_RGB, 3);
  std::vector<float> values(3 * frame.luminance.size(), 0);
  const float part = 1.0f / static_cast<float>(samples * samples);
  for_samples(frame, samples, [&](std::size_t pixel, std::size_t sample) {
    for (std::size_t k = 0; k < 3; ++k) values[3 * pixel + k] += part * source[3 * sample + k];
  });
  return values;
}

FrameLayers resolve_layers(const FrameGraph& graph, int samples, const Frame& frame) {
  FrameLayers layers;
  layers.in_scatter = resolve_color(graph, "in_scatter", samples, frame);
  layers.reflected = resolve_color(graph, "reflected", samples, frame);
  layers.transmittance = resolve_color(graph, "transmittance", samples, frame);
  layers.normal = resolve_color(graph, "normal", samples, frame);
  layers.albedo = resolve_color(graph, "albedo", samples, frame);
  for (std::size_t i = 0; i < layers.normal.size(); i += 3) {
    float* const n = &layers.normal[i];
    const float length = std::hypot(n[0], n[1], n[2]);
    for (int k = 0; k < 3; ++k) n[k] = length > 0 ? n[k] / length : 0;
  }
  return layers;
}

void add_directions(const Camera& camera, Frame& frame) {
  const ViewBasis basis = view_basis(camera);
  const double tall = std::tan(0.5 * camera.vertical_fov);
  const double wide = tall * frame.width / frame.height;
  const auto pixels = static_cast<std::size_t>(frame.width) * frame.height;
  frame.view_zenith_deg.resize(pixels);
  frame.view_azimuth_deg.resize(pixels);
  tbb::parallel_for(0, frame.height, [&](int y) {
    const double v = tall * (1 - (2 * y + 1.0) / frame.height);
    for (int x = 0; x < frame.width; ++x) {
      const double u = wide * ((2 * x + 1.0) / frame.width - 1);
      const glm::dvec3 ray = basis.forward + u * basis.right + v * basis.up;
      const double zenith = std::atan2(std::sqrt(ray.x * ray.x + ray.y * ray.y), ray.z);
      const std::size_t i = static_cast<std::size_t>(y) * frame.width + x;
      frame.view_zenith_deg[i] = static_cast<float>(kDegrees * zenith);
      frame.view_azimuth_deg[i] = static_cast<float>(kDegrees * std::atan2(-ray.y, ray.x));
    }
  });
}

// How finely the planet is drawn: near the ground a quad spans options.samples_per_quad samples of
// the picture, but no block is split beyond 50 times its size (Sperlhofer 2011, C = 50); 9 levels
// and, near the camera, as many more as show details of a third of a metre.
constexpr double kLargestRatio = 50, kSmallestRatio = 1.8;
// A view from above holds fewer levels of the tree, so that each can be finer for the same number of
// blocks; that from 2 m holds this many.
constexpr double kLevelsFromGround = 19;
constexpr int kFewestLevels = 9;
constexpr double kFinestQuad = 0.3;  // m

int levels_of(double radius) {
  int levels = kFewestLevels;
  while (block_arc_m(levels, radius) / kBlockQuads > kFinestQuad) ++levels;
  return levels;
}

// To where a view from the height touches the bottom sphere.
double horizon_m(double radius, double height) {
  return std::sqrt(height * (2 * radius + height));
}

TerrainView terrain_view(const FrameOptions& options, const SiteAxes& axes, const Ground& ground,
                         double radius, double ground_distance_m) {
  const double aspect = static_cast<double>(options.width) / options.height;
  TerrainView view;
  view.axes = axes;
  view.altitude_m = options.camera.altitude_m;
  view.basis = view_basis(options.camera);
  const double tall = std::tan(0.5 * options.camera.vertical_fov);
  view.tangent = {tall * aspect, tall};
  view.radius_m = radius;
  view.highest_m = ground.highest_m();
  const double sample = 2 * tall / (options.height * options.samples_per_side);
  const double height = std::max(ground_distance_m, 2.0);
  const double horizon = horizon_m(radius, height) + horizon_m(radius, view.highest_m);
  const double levels = 2 + std::log2(std::max(horizon / height, 1.0));
  const double finer = std::sqrt(kLevelsFromGround / std::min(levels, kLevelsFromGround));
  view.split_ratio = std::clamp(finer / (kBlockQuads * options.samples_per_quad * sample),
                                kSmallestRatio, kLargestRatio);
  view.levels = levels_of(radius);
  return view;
}

// Coarser where a picture asks for more blocks than memory should hold.
BlockSelection affordable_blocks(TerrainView& view, BlockStore& store) {
  const HeightsOf heights_of = [&](std::span<const CubeBlock> blocks) {
    store.provide(blocks);
    std::vector<HeightRange> heights;
    for (const CubeBlock& block : blocks) heights.push_back(store.heights(block).whole);
    return heights;
  };
  for (;;) {
    try {
      return select_blocks(view, heights_of);
    } catch (const std::length_error&) {
      if (view.split_ratio <= kSmallestRatio) throw;
      view.split_ratio = std::max(0.8 * view.split_ratio, kSmallestRatio);
      store.begin_frame();
    }
  }
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

class GlRenderer final : public FrameDrawer {
 public:
  GlRenderer(const Scene& scene, GraphicsDevice device)
      : scene_(scene), context_(make_context(device)), materials_(scene.textures) {}

  void set_atmosphere(const AtmosphereTables& tables) override {
    context_->make_current();
    const double bottom = tables.atmosphere.bottom_radius_m;
    if (ground_ && bottom != radius_m_) {
      throw std::invalid_argument(
          fmt::format("render.bottom_radius = {:.9g} m: must stay {:.9g} m from frame to frame",
                      bottom, radius_m_));
    }
    radius_m_ = bottom;
    // The made-up planet's colours have the preset's ground albedo as their mean.
    const double albedo = tables.atmosphere.ground_albedo;
    if (!ground_ || (scene_.height_map.empty() && albedo != albedo_)) {
      albedo_ = albedo;
      terrain_.reset();
      make_ground(tables);
      terrain_.emplace(*ground_, radius_m_);
    }
    if (meshes_.size() < scene_.meshes.size()) {
      for (const PlacedMesh& mesh : scene_.meshes) {
        meshes_.push_back(ObjectPass::upload_mesh(
            read_object_mesh(mesh.file, mesh.reflectance, tables.color)));
      }
    }
    add_tables(tables, graph_);
    atmosphere_.set_tables(tables);
  }

  double ground_height_m(const std::optional<Site>& site) const override {
    return ground_->height_m(axes_of(site).z, kFinestQuad);
  }

  Frame draw(const FrameOptions& options, const std::function<void(double)>& progress) override {
    const auto report = [&](double done) {
      if (progress) progress(done);
    };
    context_->make_current();
    require_above_ground(options);
    FrameOptions sampled = options;
    sampled.samples_per_side = affordable_samples(options);
    const int samples = sampled.samples_per_side;
    add_targets(options.width * samples, options.height * samples, options.layers, graph_);
    atmosphere_.add_sky_view(options, graph_);

    const auto start = std::chrono::steady_clock::now();
    Frame frame;
    prepare_scene(sampled, frame.statistics);
    report(0.7);
    frame.statistics.passes = graph_.run(passes(sampled));
    frame.statistics.milliseconds = milliseconds_since(start);
    report(0.9);
    frame.width = options.width;
    frame.height = options.height;
    resolve_light(graph_, samples, frame);
    if (options.layers) frame.layers = resolve_layers(graph_, samples, frame);
    add_directions(options.camera, frame);
    report(1);
    return frame;
  }

 private:
  void make_ground(const AtmosphereTables& tables) {
    if (scene_.height_map.empty()) {
      auto relief = std::make_unique<Relief>(radius_m_, albedo_);
      home_ = relief->coast();
      ground_ = std::move(relief);
    } else {
      ground_ = std::make_unique<MapGround>(scene_, radius_m_, tables.color);
      home_ = site_axes({});
    }
  }

  SiteAxes axes_of(const std::optional<Site>& site) const {
    return site ? site_axes(*site) : home_;
  }

  void require_above_ground(const FrameOptions& options) const {
    constexpr double kRoom = 0.3;  // m
    const double ground = ground_height_m(options.site);
    if (options.camera.altitude_m < ground + kRoom) {
      throw std::invalid_argument(
          fmt::format("render.camera.altitude_m = {:.9g}: must be above the ground, {:.9g} m",
                      options.camera.altitude_m, ground + kRoom));
    }
  }

  // What stands where in a frame.
  struct Placed {
    const ObjectPass::Model* model;
    ObjectPlace place;
  };
  struct FrameScene {
    SiteAxes axes;
    Projection projection;
    TerrainDraw blocks;
    std::vector<Placed> meshes;  // they cast shadows, the moon does not
    std::optional<Placed> moon;
    std::array<ShadowView, kShadowMaps> shadows;
    std::array<TerrainDraw, kShadowMaps> casters;
    double farthest_km = 0;
  };

  // Chooses the blocks of the picture and of the shadow maps and makes those that are missing.
  void prepare_scene(const FrameOptions& options, FrameStatistics& statistics) {
    const double aspect = static_cast<double>(options.width) / options.height;
    current_.axes = axes_of(options.site);
    current_.projection = make_projection(options.camera, aspect);
    const double ground_distance = options.camera.altitude_m - ground_height_m(options.site);
    TerrainView view = terrain_view(options, current_.axes, *ground_, radius_m_, ground_distance);
    BlockStore& store = terrain_->store();
    store.begin_frame();
    const BlockSelection selection = affordable_blocks(view, store);
    statistics.blocks_outside = selection.outside;
    statistics.blocks_behind = selection.behind;
    if (options.shadows) prepare_shadows(options, view, ground_distance);
    statistics.blocks_made = store.made();
    current_.blocks = terrain_->prepare(selection.blocks, view);
    statistics.triangles = current_.blocks.triangles;
    statistics.blocks_drawn = current_.blocks.blocks;
    statistics.blocks_hidden = current_.blocks.hidden;
    place_objects(options, statistics);
    current_.farthest_km = 1e-3 * (horizon_m(radius_m_, options.camera.altitude_m) +
                                   horizon_m(radius_m_, ground_->highest_m()));
  }

  // The same blocks as in the picture where both see them: a surface must not shade itself.
  void prepare_shadows(const FrameOptions& options, TerrainView view, double ground_distance_m) {
    const glm::dvec3 sun(std::sin(options.sun_zenith), 0, std::cos(options.sun_zenith));
    current_.shadows = shadow_views(sun, ground_distance_m);
    for (std::size_t i = 0; i < kShadowMaps; ++i) {
      view.planes = current_.shadows[i].planes;
      current_.casters[i] =
          terrain_->prepare(affordable_blocks(view, terrain_->store()).blocks, view);
    }
  }

  void place_objects(const FrameOptions& options, FrameStatistics& statistics) {
    current_.meshes.clear();
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      current_.meshes.push_back({&meshes_[i], place_of(scene_.meshes[i], current_.axes, radius_m_,
                                                       options.camera.altitude_m)});
      statistics.triangles += meshes_[i].triangles();
    }
    current_.moon.reset();
    if (!options.moon) return;
    if (!moon_ || moon_reflectance_ != options.moon->reflectance) {
      moon_ = ObjectPass::upload_mesh(moon_mesh(*options.moon));
      moon_reflectance_ = options.moon->reflectance;
    }
    current_.moon = Placed{&*moon_, place_of(*options.moon)};
    statistics.triangles += moon_->triangles();
  }

  std::vector<Pass> passes(const FrameOptions& options) {
    const AtmosphereView view{options, current_.projection, current_.axes,
                              options.shadows ? &current_.shadows : nullptr, current_.farthest_km,
                              current_.meshes.empty() && !current_.moon, materials_};
    std::vector<Pass> list;
    if (options.shadows) list.push_back({"shadow maps", {}, {}, [this] { draw_shadows(); }});
    list.push_back({"terrain", {}, {"color", "surface", "depth"}, [this] {
                      clear_gbuffer();
                      terrain_->draw(current_.blocks, current_.projection, current_.axes);
                    }});
    if (!current_.meshes.empty() || current_.moon) {
      list.push_back({"objects", {}, {"color", "surface", "depth"}, [this] {
                        draw_objects();
                      }});
    }
    list.push_back({"classes", {"depth"}, {"class"}, [this, view] { atmosphere_.classify(view); }});
    if (AtmospherePass::has_sky_view(options)) {
      list.push_back({"sky view", kTableReads, kSkyViewWrites, [this, view] {
                        atmosphere_.draw_sky_view(view);
                      }});
    }
    if (view.volume(atmosphere_.tables())) {
      list.push_back({"aerial volume", kTableReads, {}, [this, view] {
                        atmosphere_.fill_volume(view);
                      }});
    }
    std::vector<std::string> lights = {"light", "distance"};
    if (options.layers) lights.insert(lights.end(), kLayerWrites.begin(), kLayerWrites.end());
    lights.emplace_back("class");
    list.push_back({"atmosphere", kAtmosphereReads, lights, [this, view] {
                      atmosphere_.draw(view, shadow_maps());
                    }});
    return list;
  }

  void draw_objects() const {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    for (const Placed& mesh : current_.meshes)
      objects_.draw(*mesh.model, mesh.place, current_.projection);
    if (current_.moon) objects_.draw(*current_.moon->model, current_.moon->place, current_.projection);
  }

  const ShadowPass& shadow_maps() {
    if (!shadow_pass_) shadow_pass_.emplace();
    return *shadow_pass_;
  }

  void draw_shadows() {
    const glm::dmat4 site_from_planet(current_.axes.site_from_planet());
    shadow_maps().draw([&](int i) {
      const auto map = static_cast<std::size_t>(i);
      const glm::dmat4& clip_from_site = current_.shadows[map].clip_from_site;
      terrain_->draw_depth(current_.casters[map], glm::mat4(clip_from_site * site_from_planet));
      for (const Placed& mesh : current_.meshes)
        objects_.draw_depth(*mesh.model, mesh.place, clip_from_site);
    });
  }

  Scene scene_;
  std::unique_ptr<GlContext> context_;
  FrameGraph graph_;
  double radius_m_ = 0, albedo_ = 0;
  std::unique_ptr<Ground> ground_;
  SiteAxes home_;  // where the camera stands without a site
  std::optional<TerrainPass> terrain_;
  ObjectPass objects_;
  Materials materials_;
  std::vector<ObjectPass::Model> meshes_;  // of the scene
  std::optional<ObjectPass::Model> moon_;
  double moon_reflectance_ = 0;
  std::optional<ShadowPass> shadow_pass_;  // made when first used
  AtmospherePass atmosphere_;
  FrameScene current_;
};

}  // namespace

std::unique_ptr<FrameDrawer> make_drawer(const Scene& scene, GraphicsDevice device) {
  return std::make_unique<GlRenderer>(scene, device);
}

}  // namespace skyfit
