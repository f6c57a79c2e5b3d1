// SPDX-License-Identifier: Apache-2.0
#include "cli/frame_store.h"

#include <fmt/format.h>

#include <stdexcept>

#include "cli/render_session.h"
#include "model/base/content_hash.h"
#include "model/base/input_file.h"
#include "model/base/whole_file.h"
#include "model/version.h"
#include "render/features/render_features.h"

namespace skyfit::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kManifest = "frames.json";
constexpr int kManifestVersion = 1;

std::string hash_of(const std::string& text) {
  ContentHash hash;
  hash.add(text);
  return hash.text();
}

// Of a file's content; of no file: "".
std::string hash_of_file(const fs::path& file) {
  if (file.empty()) return {};
  ContentHash hash;
  hash.add_file(file);
  return hash.text();
}

ordered_json json_of(const TableSizes& sizes) {
  const RayTexels rays = sizes.scattering(), outside = sizes.outside();
  return {sizes.optical_depth_mu,
          sizes.optical_depth_r,
          sizes.irradiance_mu_s,
          sizes.irradiance_r,
          sizes.scattering_r,
          rays.ground,
          rays.sky,
          rays.mu_s,
          rays.azimuth,
          outside.sky,
          outside.mu_s,
          outside.azimuth};
}

ordered_json json_of(const OwnMaterial& material) {
  return {hash_of_file(material.color), hash_of_file(material.normal), material.near_m,
          material.far_m};
}

ordered_json json_of(const Scene& scene) {
  ordered_json meshes = ordered_json::array();
  for (const PlacedMesh& mesh : scene.meshes) {
    meshes.push_back({hash_of_file(mesh.file), mesh.latitude, mesh.longitude, mesh.altitude_m,
                      mesh.heading, mesh.scale, mesh.reflectance});
  }
  ordered_json dems = ordered_json::array();
  for (const RegionalDem& dem : scene.dems)
    dems.push_back({dem.file.filename().string(), hash_of_file(dem.file), dem.band, dem.zero_m});
  ordered_json textures = ordered_json::array();
  if (!scene.textures.empty()) {
    for (const fs::path& file : texture_files(scene.textures))
      textures.push_back(hash_of_file(file));
  }
  return {{"height_map", hash_of_file(scene.height_map)},
          {"range_m", {scene.lowest_m, scene.highest_m}},
          {"color_map", hash_of_file(scene.color_map)},
          {"water_level_m", scene.water_level_m},
          {"dems", {dems, static_cast<int>(scene.dem_surroundings), scene.dem_edge_m.value_or(-1)}},
          {"meshes", meshes},
          {"textures", textures},
          {"soil", json_of(scene.soil)},
          {"rock", json_of(scene.rock)}};
}

ordered_json json_of(const FrameOptions& frame) {
  ordered_json json = {{"size", {frame.width, frame.height}},
                       {"samples_per_side", frame.samples_per_side},
                       {"samples_per_quad", frame.samples_per_quad},
                       {"primaries", static_cast<int>(frame.primaries)},
                       {"field_of_view", frame.field_of_view.value_or(0)}};
  for (const RenderFeature& feature : render_features())
    json[std::string(feature.name)] = feature_key(feature, frame);
  return json;
}

ordered_json json_of(const CameraPose& pose) {
  ordered_json json = {{"altitude_m", pose.altitude_m},   {"above_ground", pose.above_ground},
                       {"view_zenith", pose.view_zenith}, {"azimuth", pose.azimuth},
                       {"from_north", pose.from_north},   {"vertical_fov", pose.vertical_fov},
                       {"overview_m", pose.overview_m}};
  if (pose.place) json["place"] = {pose.place->latitude, pose.place->longitude};
  if (const auto& target = pose.look_at)
    json["look_at"] = {target->place.latitude, target->place.longitude, target->altitude_m};
  return json;
}

ordered_json read_manifest(const fs::path& file) {
  if (!fs::exists(file)) return {{"frames", ordered_json::object()}};
  const ordered_json json =
      ordered_json::parse(read_file(file, "what an earlier sequence left"), nullptr, false);
  if (!json.is_object() || json.value("skyfit_frames", 0) != kManifestVersion ||
      !json.contains("frames") || !json.at("frames").is_object()) {
    throw std::runtime_error(fmt::format(
        "{}: expected what an earlier sequence of this version left; remove it to draw all frames "
        "anew",
        file.string()));
  }
  return json;
}

std::string name_of(int frame) { return fmt::format("frame_{:05}", frame); }

}  // namespace

Fingerprints::Fingerprints(const RenderRequest& request, const std::vector<TimelineStep>& timeline)
    : timeline_(timeline),
      update_frames_(timeline.size() > 1 ? request.update_frames : 0),
      frames_per_second_(request.sequence.frames_per_second) {
  common_ = {{"version", kVersion},
             {"model", request.model},
             {"light", {static_cast<int>(request.light.transfer), request.light.orders}},
             {"tables", json_of(request.table_sizes)},
             {"table_precision", static_cast<int>(request.table_precision)},
             {"stokes", request.stokes ? static_cast<int>(*request.stokes) : -1},
             {"device", static_cast<int>(request.device)},
             {"scene", json_of(request.scene)},
             {"frame", json_of(request.frame)},
             {"tone",
              {static_cast<int>(request.tone.curve), static_cast<int>(request.tone.transform),
               request.tone.exposure_stops, request.tone.exposure.value_or(0)}}};
}

std::string Fingerprints::of(const Shot& shot, double time_s) const {
  const TimelineMoment moment = moment_at(timeline_, time_s);
  ordered_json json = common_;
  json["camera"] = json_of(shot.camera);
  json["sun"] = {shot.sun.zenith, shot.sun.azimuth};
  json["timeline"] = {preset_to_json(timeline_[moment.before].preset),
                      preset_to_json(timeline_[moment.after].preset), moment.share};
  if (update_frames_ > 0) {
    // What earlier frames have seen is still in the tables.
    for (const TimelineStep& step : timeline_)
      json["updates"].push_back({step.time_s, preset_to_json(step.preset)});
    json["update"] = {update_frames_, frames_per_second_, time_s};
  }
  // Where the timeline stands still, time does not matter.
  if (json["timeline"][0] == json["timeline"][1]) json["timeline"][2] = 0;
  return hash_of(json.dump());
}

FrameStore::FrameStore(fs::path directory, std::vector<std::string> extensions)
    : directory_(std::move(directory)), extensions_(std::move(extensions)) {
  std::error_code error;
  made_ = fs::create_directory(directory_, error);
  if (error || !fs::is_directory(directory_))
    throw std::runtime_error(fmt::format("{}: cannot be made: {}", directory_.string(),
                                         error ? error.message() : "expected a directory"));
  require_writable_file(directory_ / kManifest);
  const ordered_json manifest = read_manifest(directory_ / kManifest);
  frames_ = manifest.at("frames");
  video_ = manifest.value("video", "");
}

FrameStore::~FrameStore() {
  std::error_code ignored;  // that it is not empty, as it should be
  if (made_) fs::remove(directory_, ignored);
}

std::vector<fs::path> FrameStore::files_of(int frame) const {
  std::vector<fs::path> files;
  for (const std::string& extension : extensions_)
    files.push_back(directory_ / (name_of(frame) + extension));
  return files;
}

std::optional<FrameStore::Entry> FrameStore::find(int frame, const std::string& request) const {
  const auto found = frames_.find(name_of(frame));
  if (found == frames_.end() || found->value("request", "") != request) return {};
  for (const fs::path& file : files_of(frame)) {
    std::error_code error;
    if (fs::file_size(file, error) != found->value(file.extension().string(), std::uintmax_t{0}) ||
        error)
      return {};
  }
  return Entry{request, found->value("metered_exposure_m2_per_cd", 0.0),
               found->value("exposure_m2_per_cd", 0.0)};
}

void FrameStore::write(int frame, const Entry& entry, const Frame& picture, ToneOptions tone) {
  tone.exposure = entry.exposure;
  std::vector<fs::path> files = files_of(frame);
  files.push_back(directory_ / kManifest);
  WholeFiles whole(files);
  ordered_json noted = {{"request", entry.request},
                        {"metered_exposure_m2_per_cd", entry.metered},
                        {"exposure_m2_per_cd", entry.exposure}};
  for (std::size_t i = 0; i + 1 < files.size(); ++i) {
    whole.make(i, [&](const fs::path& file) { write_frame(picture, file, tone); });
    noted[files[i].extension().string()] = fs::file_size(whole.temporary(i));
  }
  frames_[name_of(frame)] = noted;
  whole.write(files.size() - 1, manifest());
  whole.publish();
}

bool FrameStore::has_video(int frames, double frames_per_second) const {
  return video_ == video_of(frames, frames_per_second);
}

void FrameStore::note_video(int frames, double frames_per_second) {
  video_ = video_of(frames, frames_per_second);
  write_whole_file(directory_ / kManifest, manifest());
}

std::string FrameStore::video_of(int frames, double frames_per_second) const {
  ordered_json video = {frames_per_second};
  for (int i = 0; i < frames; ++i) video.push_back(frames_.value(name_of(i), ordered_json()));
  return hash_of(video.dump());
}

std::string FrameStore::manifest() const {
  const ordered_json json = {
      {"skyfit_frames", kManifestVersion}, {"video", video_}, {"frames", frames_}};
  return json.dump(1) + "\n";
}

}  // namespace skyfit::cli
