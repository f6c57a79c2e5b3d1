// SPDX-License-Identifier: Apache-2.0
#include "cli/render_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/light_check.h"
#include "cli/output.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/lowered_ground.h"
#include "model/atmosphere/shells.h"
#include "model/base/whole_file.h"
#include "model/registry.h"
#include "model/tables/table_cache.h"
#include "render/panels.h"
#include "render/sky_map/frame_polarisation.h"

namespace skyfit::cli {
namespace {

// Of the tables of each step. `drawn` makes of a preset's atmosphere that of the frames.
std::vector<std::optional<HeightAxis>> heights_of(
    const std::vector<TimelineStep>& steps, int heights,
    const std::function<Atmosphere<double>(const Preset&)>& drawn) {
  std::vector<Shells> shells;
  for (const TimelineStep& step : steps)
    shells.push_back(shells_of(drawn(step.preset), Keep::kAll));
  const std::vector<HeightAxis> axes = height_axes(shells, heights);
  return {axes.begin(), axes.end()};
}

}  // namespace

RenderSession::RenderSession(const RenderRequest& request, std::vector<TimelineStep> timeline,
                             double first_time_s, TimeAccount& time, Report report)
    : request_(request),
      time_(time),
      report_(std::move(report)),
      model_(make_sky_model(request.model, refs::standard_spectral_data(), request.threads,
                            request.light.transfer)),
      stays_(timeline.size() == 1),
      steps_(std::move(timeline)),
      heights_(stays_
                   ? std::vector<std::optional<HeightAxis>>(1)
                   : heights_of(steps_, request.table_sizes.scattering_r,
                                [this](const Preset& preset) { return drawn_atmosphere(preset); })),
      timeline_(request.update_frames > 0
                    ? std::optional<Timeline>()
                    : std::optional<Timeline>(
                          std::in_place, steps_,
                          [this](std::size_t step) { return tables_of(step); }, first_time_s)),
      renderer_(request.scene, request.device, request.cache) {
  time_.done("opening the renderer");
}

Atmosphere<double> RenderSession::drawn_atmosphere(const Preset& preset) const {
  return lowered_by(basin_depth_m(request_.scene), preset.atmosphere);
}

AtmosphereTables RenderSession::tables_of(std::size_t step) const {
  const Preset& preset = steps_[step].preset;
  const auto atmosphere = drawn_atmosphere(preset);
  const ColorRule color = color_rule(refs::spectral_data_of(preset.atmosphere));
  const TableSizes& sizes = request_.table_sizes;
  const std::optional<HeightAxis>& heights = heights_[step];
  const auto progress = [this](double done) { report_(done, "tables of the atmosphere"); };
  const auto compute = [&] {
    if (request_.light.orders > 0)
      return compute_tables(atmosphere, color, sizes, request_.threads, progress, request_.light,
                            heights);
    return compute_tables_of(*model_, atmosphere, color, sizes, request_.threads, progress,
                             heights);
  };
  if (!request_.cache || !stays_) return compute();  // not the many of one that changes
  return cached_tables(*request_.cache, {request_.model, request_.light, atmosphere, color, sizes},
                       compute);
}

FrameOptions RenderSession::placed(const Shot& shot, const Preset& preset,
                                   FrameOptions frame) const {
  place_camera(
      shot.camera, shot.sun, preset.atmosphere.bottom_radius_m,
      [&](const std::optional<Site>& site) { return renderer_.ground_height_m(site); }, frame);
  return frame;
}

// Makes the atmosphere of a time that of the renderer.
Preset RenderSession::show(double time_s) {
  if (settled_) return *timeline_->steady();
  const Timeline::Now now = timeline_->at(time_s);
  time_.done("waiting for tables");
  if (now.tables != shown_) {
    renderer_.set_atmosphere(now.preset, *now.tables, request_.table_precision);
    shown_ = now.tables;
    time_.done("tables to the renderer");
  }
  if (timeline_->steady() != nullptr) {
    settled_ = true;
    shown_.reset();
    timeline_->forget();
  }
  return now.preset;
}

Frame RenderSession::draw(const Shot& shot, double time_s,
                          const std::function<void(double)>& progress) {
  return draw(shot, time_s, request_.frame, progress);
}

Frame RenderSession::draw(const Shot& shot, double time_s, const FrameOptions& options,
                          const std::function<void(double)>& progress) {
  if (!timeline_) return draw_updated(shot, time_s, progress);
  // Before the first frame of an atmosphere that stays, while its tables are made.
  if (const Preset* preset = timeline_->steady(); preset != nullptr && !settled_) {
    renderer_.set_ground(drawn_atmosphere(*preset),
                         color_rule(refs::spectral_data_of(preset->atmosphere)));
    renderer_.prepare(placed(shot, *preset, options));
    time_.done("ground");
  }
  const Preset preset = show(time_s);
  if (!std::exchange(warned_, true)) {
    for (const std::string& warning : renderer_.warnings()) warn(warning);
  }
  const FrameOptions frame = placed(shot, preset, options);
  Frame drawn = renderer_.draw(frame, progress);
  time_.done("frame: other", drawn.statistics.steps);
  if (request_.stokes) {
    add_polarisation(*model_, drawn_atmosphere(preset),
                     luminance_rule(refs::spectral_data_of(preset.atmosphere)),
                     frame.camera.altitude_m + basin_depth_m(request_.scene), frame,
                     *request_.stokes, drawn);
    drawn.metadata.emplace_back("skyfit:stokes", stokes_convention(*request_.stokes));
    time_.done("polarisation");
  }
  return drawn;
}

// With tables that are renewed over frames.
Frame RenderSession::draw_updated(const Shot& shot, double time_s,
                                  const std::function<void(double)>& progress) {
  if (!updates_) {
    const Preset& first = steps_.front().preset;
    updates_.emplace(
        steps_, request_.sequence.frames_per_second,
        color_rule(refs::spectral_data_of(first.atmosphere)),
        [this](const Preset& preset) { return drawn_atmosphere(preset); },
        BodareUpdateOptions{.slices = request_.update_frames}, TableSizes{}, request_.threads);
    time_.done("first tables");
  }
  const auto frame = static_cast<int>(std::lround(time_s * request_.sequence.frames_per_second));
  const TableUpdates::Now now = updates_->at(frame);
  time_.done("update of tables");
  if (now.tables != shown_) {
    renderer_.set_atmosphere(now.preset, *now.tables);
    shown_ = now.tables;
    time_.done("tables to the renderer");
  }
  Frame drawn = renderer_.draw(placed(shot, now.preset, request_.frame), progress);
  time_.done("frame: other", drawn.statistics.steps);
  drawn.statistics.passes.insert(drawn.statistics.passes.begin(), {"table update", now.update_ms});
  drawn.metadata.emplace_back("skyfit:table_blend", fmt::format("{:.9g}", now.blend));
  return drawn;
}

void write_frame(const Frame& frame, const std::filesystem::path& file, const ToneOptions& tone) {
  check_light(frame);
  if (file.extension() == ".exr") {
    write_exr(frame, file);
  } else if (file.extension() == ".npy") {
    write_npy(frame, file);
  } else {
    write_png(frame, file, tone);
  }
}

void write_frame_files(const Frame& frame, const std::vector<std::filesystem::path>& files,
                       const ToneOptions& tone, bool panels) {
  using Write = std::function<void(const std::filesystem::path& file)>;
  std::vector<std::filesystem::path> targets;
  std::vector<Write> writes;
  for (const std::filesystem::path& file : files) {
    targets.push_back(file);
    writes.emplace_back([&](const auto& to) { write_frame(frame, to, tone); });
    if (!panels || file.extension() != ".png") continue;
    for (const PanelEntry& panel : frame_panels()) {
      targets.push_back(
          std::filesystem::path(file).replace_extension(fmt::format(".{}.png", panel.name)));
      writes.emplace_back([&](const auto& to) { write_panel(panel, frame, to, tone); });
    }
  }
  WholeFiles whole(targets);
  for (std::size_t i = 0; i < targets.size(); ++i) whole.make(i, writes[i]);
  whole.publish();
}

std::vector<TimelineStep> timeline_of(const Sequence& sequence) {
  std::vector<TimelineStep> steps;
  for (const Keyframe& keyframe : sequence.keyframes)
    steps.push_back({keyframe.time_s, keyframe.preset});
  return refined(steps);
}

}  // namespace skyfit::cli
