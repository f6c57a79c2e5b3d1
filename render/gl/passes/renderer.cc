// SPDX-License-Identifier: Apache-2.0
#include "render/gl/passes/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "render/gl/atmosphere/atmosphere_pass.h"
#include "render/gl/context/context.h"
#include "render/gl/passes/frame_setup.h"
#include "render/gl/passes/gbuffer.h"
#include "render/gl/passes/object_pass.h"
#include "render/gl/passes/passes.h"
#include "render/gl/passes/resolve.h"
#include "render/gl/passes/shadow_pass.h"
#include "render/gl/passes/submitted_frame.h"
#include "render/gl/terrain/block_boxes.h"
#include "render/gl/terrain/color_reflectance.h"
#include "render/gl/terrain/map_ground.h"
#include "render/gl/terrain/regional_ground.h"
#include "render/gl/terrain/relief.h"
#include "render/gl/terrain/terrain_pass.h"
#include "render/gl/terrain/terrain_view.h"
#include "render/image/glare.h"

namespace skyfit {
namespace {

class GlRenderer final : public FrameDrawer {
 public:
  GlRenderer(const Scene& scene, GraphicsDevice device, std::shared_ptr<ContentCache> cache)
      : scene_(scene),
        device_(device),
        cache_(std::move(cache)),
        context_(make_context(device)),
        materials_(scene.textures, cache_.get()),
        atmosphere_(device) {}

  std::string device() const override { return context_->description(); }

  void set_ground(const Atmosphere<double>& atmosphere, const ColorRule& color) override {
    context_->make_current();
    const double bottom = atmosphere.bottom_radius_m;
    if (ground_ && bottom != radius_m_) {
      throw std::invalid_argument(
          fmt::format("render.bottom_radius = {:.9g} m: must stay {:.9g} m from frame to frame",
                      bottom, radius_m_));
    }
    radius_m_ = bottom;
    color_.emplace(color);
    if (!own_textures_) own_textures_.emplace(scene_.soil, scene_.rock, *color_);
    // The made-up planet's colours have the preset's ground albedo as their mean.
    NodeValues albedo;
    for (std::size_t k = 0; k < 4; ++k)
      albedo[k] = ground_albedo_at(atmosphere, color.nodes[k].wavelength_nm);
    if (!ground_ || (scene_.height_map.empty() && albedo != albedo_)) {
      albedo_ = albedo;
      terrain_.reset();
      make_ground(atmosphere, color);
      terrain_.emplace(*ground_, radius_m_, cache_.get());
    }
    if (meshes_.size() < scene_.meshes.size()) {
      for (const PlacedMesh& mesh : scene_.meshes) {
        const ObjectMesh read =
            read_object_mesh(mesh.file, mesh.reflectance, color, scene_.named_files);
        if (!read.warning.empty()) warnings_.push_back(read.warning);
        meshes_.push_back(ObjectPass::upload_mesh(read));
      }
    }
  }

  void prepare(const FrameOptions& options) override {
    const FrameOptions sampled = affordable(options);
    TerrainView view = view_of(sampled);
    affordable_blocks(view, {}, terrain_->store());
  }

  void set_atmosphere(const AtmosphereTables& tables, TablePrecision precision) override {
    set_ground(tables.atmosphere, tables.color);
    atmosphere_.set_tables(tables, add_tables(tables, graph_, precision));
  }

  std::vector<std::string> warnings() const override { return warnings_; }

  double ground_height_m(const std::optional<Site>& site) const override {
    return ground_->height_m(axes_of(site).z, kFinestQuad);
  }

  Frame draw(const FrameOptions& options, const std::function<void(double)>& progress) override {
    const auto report = [&](double done) {
      if (progress) progress(done);
    };
    const FrameOptions sampled = affordable(options);
    const int samples = sampled.samples_per_side;
    Frame frame;
    before_.reset();
    StepClock clock;
    frame.statistics = start_frame(sampled, true, [&](double done) {
                         clock.done("ground");
                         report(done);
                       }).wait();
    clock.done("passes");
    report(0.9);
    frame.primaries = options.primaries;
    frame.width = options.width;
    frame.height = options.height;
    resolve_light(graph_, samples, frame);
    if (options.layers) frame.layers = resolve_layers(graph_, samples, frame);
    add_directions(options.camera, frame);
    if (options.glare == Glare::kEye) frame.glare = glare_of(frame);
    clock.done("pixels");
    frame.statistics.steps = clock.steps();
    report(1);
    return frame;
  }

  FrameStatistics submit(const FrameOptions& options) override {
    SubmittedFrame started = start_frame(affordable(options), false, [](double) {});
    glFlush();
    const FrameStatistics statistics = (before_ ? *before_ : started).wait();
    before_ = std::move(started);
    return statistics;
  }

  FrameStatistics wait() override {
    if (!before_) throw std::logic_error("render: no frame to wait for");
    context_->make_current();
    return before_->wait();
  }

 private:
  void make_ground(const Atmosphere<double>& atmosphere, const ColorRule& color) {
    if (scene_.height_map.empty()) {
      auto relief = std::make_unique<Relief>(radius_m_, albedo_, atmosphere.sea);
      home_ = relief->coast();
      ground_ = std::move(relief);
    } else {
      ground_ = std::make_unique<MapGround>(scene_, radius_m_, color);
      home_ = site_axes({});
    }
    if (scene_.dems.empty()) return;
    const bool has_sea = atmosphere.sea || !scene_.height_map.empty();
    if (!regions_) regions_ = read_regional_maps(scene_, radius_m_, has_sea);
    ground_ = std::make_unique<RegionalGround>(std::move(ground_), regions_, scene_, radius_m_);
    home_ = site_axes({regions_->front().centre().latitude, regions_->front().centre().longitude});
  }

  SiteAxes axes_of(const std::optional<Site>& site) const {
    return site ? site_axes(*site) : home_;
  }

  // With as many samples as the device can hold. Makes the context current.
  FrameOptions affordable(const FrameOptions& options) const {
    context_->make_current();
    FrameOptions sampled = options;
    sampled.samples_per_side = affordable_samples(options);
    return sampled;
  }

  // `read`: distances are wanted, too.
  SubmittedFrame start_frame(const FrameOptions& options, bool read,
                             const std::function<void(double)>& report) {
    const int samples = options.samples_per_side;
    add_targets(options.width * samples, options.height * samples, options.layers, graph_);
    atmosphere_.add_sky_view(options, graph_);
    const std::int64_t begin_ns = device_clock_ns();
    FrameStatistics statistics;
    statistics.device = device();
    prepare_scene(options, statistics);
    report(0.7);
    return {statistics, begin_ns, graph_.run(passes(options, read))};
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
    std::optional<ObjectPass::Model> boxes;  // of blocks; kilometres from the camera, site axes
    std::vector<ShadowView> shadows;
    std::array<TerrainDraw, 2 * kShadowMaps> casters;  // of each sun
    double farthest_km = 0;
  };

  double ground_distance_m(const FrameOptions& options) const {
    return options.camera.altitude_m - ground_height_m(options.site);
  }

  TerrainView view_of(const FrameOptions& options) {
    FrameOptions seen = options;
    seen.camera = options.terrain.eye.value_or(options.camera);
    TerrainView view =
        terrain_view(seen, axes_of(options.site), *ground_, radius_m_, ground_distance_m(seen));
    bend(atmosphere_.eye_in_air(seen), view);
    return view;
  }

  void add_boxes(const FrameOptions& options, const TerrainView& view,
                 const BlockSelection& selection) {
    current_.boxes.reset();
    if (options.terrain.boxes == BlockColors::kNone) return;
    std::vector<MeasuredNode> drawn;
    for (const CubeBlock& block : current_.blocks.seen)
      drawn.push_back({block, terrain_->store().heights(block).whole});
    current_.boxes = ObjectPass::upload_mesh(
        block_boxes({drawn, selection}, view, options.camera.altitude_m, options.terrain.boxes,
                    directions_of_suns(options)[0], *color_));
    current_.boxes->primitive = GL_LINES;
  }

  // Chooses the blocks of the picture and of the shadow maps and makes those that are missing.
  void prepare_scene(const FrameOptions& options, FrameStatistics& statistics) {
    const double aspect = static_cast<double>(options.width) / options.height;
    current_.axes = axes_of(options.site);
    current_.projection = make_projection(options.camera, aspect, atmosphere_.eye_in_air(options));
    TerrainView view = view_of(options);
    BlockStore& store = terrain_->store();
    current_.shadows.clear();
    if (options.shadows) current_.shadows = shadow_views_of(options);
    std::vector<Planes> casters;
    for (const ShadowView& shadow : current_.shadows) casters.push_back(shadow.planes);
    // As fine for the shadows as for the picture: a surface must not shade itself.
    const std::vector<BlockSelection> selections = affordable_blocks(view, casters, store);
    const BlockSelection& selection = selections.front();
    statistics.blocks_outside = static_cast<int>(selection.outside.size());
    statistics.blocks_behind = static_cast<int>(selection.behind.size());
    statistics.blocks_made = store.take_made();
    terrain_->prepare(selection.blocks, view, options.camera.altitude_m, current_.blocks);
    add_boxes(options, view, selection);
    view.cull = true;
    for (std::size_t i = 0; i < casters.size(); ++i) {
      view.planes = casters[i];
      terrain_->prepare(selections[i + 1].blocks, view, options.camera.altitude_m,
                        current_.casters[i]);
    }
    statistics.triangles = current_.blocks.triangles;
    statistics.blocks_drawn = current_.blocks.blocks;
    statistics.blocks_hidden = current_.blocks.hidden;
    place_objects(options, statistics);
    current_.farthest_km = 1e-3 * view.farther *
                           (horizon_m(radius_m_, options.camera.altitude_m) +
                            horizon_m(radius_m_, ground_->highest_m()));
  }

  std::vector<ShadowView> shadow_views_of(const FrameOptions& options) const {
    std::vector<ShadowView> views;
    for (const glm::dvec3& sun : directions_of_suns(options)) {
      std::ranges::move(shadow_views(sun, ground_distance_m(options), ground_->highest_m()),
                        std::back_inserter(views));
    }
    return views;
  }

  void place_objects(const FrameOptions& options, FrameStatistics& statistics) {
    current_.meshes.clear();
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      current_.meshes.push_back({&meshes_[i], place_of(scene_.meshes[i], current_.axes, radius_m_,
                                                       options.camera.altitude_m)});
      statistics.triangles += meshes_[i].triangles();
    }
    current_.moon.reset();
    if (!options.moon || options.moon->lights) return;  // then it is drawn as suns are
    if (!moon_ || moon_reflectance_ != options.moon->reflectance) {
      moon_ = ObjectPass::upload_mesh(moon_mesh(*options.moon));
      moon_reflectance_ = options.moon->reflectance;
    }
    current_.moon = Placed{&*moon_, place_of(*options.moon)};
    statistics.triangles += moon_->triangles();
  }

  std::vector<Pass> passes(const FrameOptions& options, bool read) {
    const AtmosphereView view{options,
                              current_.projection,
                              current_.axes,
                              current_.shadows,
                              current_.farthest_km,
                              current_.meshes.empty() && !current_.moon && !current_.boxes,
                              current_.blocks.nearest_m,
                              ground_->highest_m(),
                              materials_,
                              *own_textures_,
                              read};
    std::vector<Pass> list;
    if (!current_.shadows.empty())
      list.push_back({"shadow maps", {}, {}, [this] { draw_shadows(); }});
    list.push_back({"terrain", {}, kGBuffer, [this, wireframe = options.terrain.wireframe] {
                      clear_gbuffer();
                      terrain_->draw(current_.blocks, current_.projection, current_.axes,
                                     wireframe);
                    }});
    if (!current_.meshes.empty() || current_.moon || current_.boxes) {
      list.push_back({"objects", {}, kGBuffer, [this] { draw_objects(); }});
    }
    if (atmosphere_.has_sky_view(options)) {
      list.push_back({"sky view", kTableReads, kSkyViewWrites,
                      [this, view] { atmosphere_.draw_sky_view(view); }});
    }
    if (view.volume(atmosphere_.tables())) {
      list.push_back(
          {"aerial volume", kTableReads, {}, [this, view] { atmosphere_.fill_volume(view); }});
    }
    std::vector<std::string> lights = {"light"};
    if (read || options.layers || device_ == GraphicsDevice::kGpu) lights.emplace_back("distance");
    if (options.layers) lights.insert(lights.end(), kLayerWrites.begin(), kLayerWrites.end());
    std::vector<std::string> lights_and_depth = lights;
    if (read) lights_and_depth.push_back(kDiscWrite);
    lights_and_depth.emplace_back("depth");
    if (device_ == GraphicsDevice::kGpu) {
      list.push_back({"atmosphere",
                      kAtmosphereReads,
                      {},
                      [this, view] { atmosphere_.dispatch(view, shadow_pass_); },
                      lights});
      // Not the G-buffer again, whose depth it tests against; the sky's view is still bound.
      list.push_back({"suns", kTableReads, lights_and_depth,
                      [this, view] { atmosphere_.draw_only_suns(view); }});
      return list;
    }
    if (view.sees_grains()) {
      list.push_back(
          {"classes", {"depth"}, {"depth"}, [this, view] { atmosphere_.classify(view); }});
    }
    list.push_back({"atmosphere", kAtmosphereReads, lights_and_depth,
                    [this, view] { atmosphere_.draw(view, shadow_pass_); }});
    return list;
  }

  void draw_objects() const {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    for (const Placed& mesh : current_.meshes)
      objects_.draw(*mesh.model, mesh.place, current_.projection, current_.axes);
    if (current_.moon)
      objects_.draw(*current_.moon->model, current_.moon->place, current_.projection,
                    current_.axes);
    if (current_.boxes)
      objects_.draw(*current_.boxes, {glm::dmat3(1), glm::dvec3(0)}, current_.projection,
                    current_.axes);
  }

  void draw_shadows() {
    const glm::dmat4 site_from_planet(current_.axes.site_from_planet());
    shadow_pass_.draw(current_.shadows.size(), [&](std::size_t map) {
      const glm::dmat4& clip_from_site = current_.shadows[map].clip_from_site;
      terrain_->draw_depth(current_.casters[map], glm::mat4(clip_from_site * site_from_planet));
      for (const Placed& mesh : current_.meshes)
        objects_.draw_depth(*mesh.model, mesh.place, clip_from_site);
    });
  }

  Scene scene_;
  GraphicsDevice device_;
  std::shared_ptr<ContentCache> cache_;  // may be null
  std::unique_ptr<GlContext> context_;
  FrameGraph graph_;
  double radius_m_ = 0;
  NodeValues albedo_{};
  std::optional<ColorReflectance> color_;
  std::unique_ptr<Ground> ground_;
  RegionalMaps regions_;  // null before the first ground
  SiteAxes home_;         // where the camera stands without a site
  std::optional<TerrainPass> terrain_;
  ObjectPass objects_;
  Materials materials_;
  std::optional<OwnTextures> own_textures_;  // of the first ground's colour rule
  std::vector<ObjectPass::Model> meshes_;    // of the scene
  std::vector<std::string> warnings_;        // of their files
  std::optional<ObjectPass::Model> moon_;
  double moon_reflectance_ = 0;
  ShadowPass shadow_pass_;
  AtmospherePass atmosphere_;
  FrameScene current_;
  std::optional<SubmittedFrame> before_;  // the last one of submit()
};

}  // namespace

std::unique_ptr<FrameDrawer> make_drawer(const Scene& scene, GraphicsDevice device,
                                         std::shared_ptr<ContentCache> cache) {
  return std::make_unique<GlRenderer>(scene, device, std::move(cache));
}

}  // namespace skyfit
