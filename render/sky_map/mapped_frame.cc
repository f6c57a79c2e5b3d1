// SPDX-License-Identifier: Apache-2.0
#include "render/sky_map/mapped_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "model/numerics/angles.h"
#include "render/sky_map/face_samples.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;

FrameOptions face_options(const FrameOptions& options, const FaceSamples& samples,
                          const CubeView& face) {
  FrameOptions flat = options;
  flat.projection = PictureProjection::kPerspective;
  flat.width = flat.height = samples.face_side();
  flat.samples_per_side = 1;
  flat.camera.view_zenith = face.zenith;
  flat.camera.azimuth = options.camera.azimuth + face.turn;
  flat.camera.vertical_fov = kPi / 2;
  flat.aerial = AerialPerspective::kPerPixel;  // volumes before two faces do not meet at their edge
  flat.glare = Glare::kNone;
  return flat;
}

void add_to(std::vector<PassTime>& sum, const std::vector<PassTime>& times) {
  for (const PassTime& time : times) {
    const auto same = std::ranges::find(sum, time.pass, &PassTime::pass);
    if (same == sum.end()) {
      sum.push_back(time);
    } else {
      same->milliseconds += time.milliseconds;
    }
  }
}

void add_to(FrameStatistics& sum, const FrameStatistics& face) {
  sum.device = face.device;
  sum.triangles += face.triangles;
  sum.blocks_drawn += face.blocks_drawn;
  sum.blocks_outside += face.blocks_outside;
  sum.blocks_behind += face.blocks_behind;
  sum.blocks_hidden += face.blocks_hidden;
  sum.blocks_made += face.blocks_made;
  sum.milliseconds += face.milliseconds;
  add_to(sum.passes, face.passes);
  add_to(sum.steps, face.steps);
}

constexpr std::vector<float> FrameLayers::*kLayers[] = {
    &FrameLayers::in_scatter,    &FrameLayers::reflected, &FrameLayers::direct,
    &FrameLayers::transmittance, &FrameLayers::normal,    &FrameLayers::albedo};

void add(const float* from, std::size_t channels, float weight, float* to) {
  for (std::size_t k = 0; k < channels; ++k) to[k] += weight * from[k];
}

// A frame to which face after face is added.
class MappedFrame {
 public:
  MappedFrame(const FrameOptions& options, const FaceSamples& samples) : samples_(samples) {
    frame_.width = options.width;
    frame_.height = options.height;
    frame_.primaries = options.primaries;
    const std::size_t pixels = static_cast<std::size_t>(options.width) * options.height;
    frame_.rgb.resize(3 * pixels);
    frame_.luminance.resize(pixels);
    frame_.depth_m.assign(pixels, std::numeric_limits<float>::infinity());
    sky_share_.resize(pixels);
    sky_.resize(3 * pixels);
    ground_.resize(3 * pixels);
    discs_.resize(pixels);
    weight_.resize(pixels);
    samples.for_pixels([&](std::size_t pixel) {
      const std::size_t shown = samples.shown_in(pixel);
      weight_[pixel] = shown > 0 ? 1 / static_cast<float>(shown) : 0;
    });
    if (options.layers) {
      frame_.layers.emplace();
      for (const auto layer : kLayers) ((*frame_.layers).*layer).resize(3 * pixels);
    }
    add_directions(options.camera.azimuth);
  }

  void add_face(std::size_t number, Frame face) {
    for (const DiscPixel& disc : face.discs) {
      add_disc(cube_views()[number], disc);
      for (std::size_t k = 0; k < 3; ++k) {
        float& light = face.rgb[3 * disc.pixel + k];
        light = std::max(light - disc.rgb[k], 0.0F);
      }
      float& luminance = face.luminance[disc.pixel];
      luminance = std::max(luminance - disc.luminance, 0.0F);
    }
    std::vector<const EdgePixel*> edge_at(face.luminance.size());
    for (const EdgePixel& edge : face.edges) edge_at[edge.pixel] = &edge;
    const int side = samples_.face_side();
    samples_.for_face(number, [&](std::size_t pixel, const FaceSamples::OnFace& on) {
      const auto pixel_at = [&](int column, int row) {
        return static_cast<std::size_t>(std::clamp(row, 0, side - 1)) * side +
               static_cast<std::size_t>(std::clamp(column, 0, side - 1));
      };
      const auto is_sky = [&](std::size_t at) {
        return edge_at[at] == nullptr && std::isinf(face.depth_m[at]);
      };
      // The sky is smooth: between four of its pixels it is interpolated, all else is the
      // nearest's.
      const int beside = on.column + (on.right < 0 ? -1 : 1),
                below = on.row + (on.down < 0 ? -1 : 1);
      const std::size_t nearest = pixel_at(on.column, on.row);
      std::array<std::size_t, 4> from = {nearest, pixel_at(beside, on.row),
                                         pixel_at(on.column, below), pixel_at(beside, below)};
      const float u = std::abs(on.right), v = std::abs(on.down);
      std::array<float, 4> part = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
      if (!std::ranges::all_of(from, is_sky)) part = {1, 0, 0, 0};
      const float weight = weight_[pixel];
      const auto add_part = [&](const std::vector<float>& values, float* to) {
        for (std::size_t k = 0; k < 4; ++k) add(&values[3 * from[k]], 3, weight * part[k], to);
      };
      add_part(face.rgb, &frame_.rgb[3 * pixel]);
      for (std::size_t k = 0; k < 4; ++k)
        frame_.luminance[pixel] += weight * part[k] * face.luminance[from[k]];
      frame_.depth_m[pixel] = std::min(frame_.depth_m[pixel], face.depth_m[nearest]);
      if (frame_.layers) {
        for (const auto layer : kLayers)
          add_part((*face.layers).*layer, &((*frame_.layers).*layer)[3 * pixel]);
      }
      const EdgePixel* const edge = edge_at[nearest];
      const float* light = &face.rgb[3 * nearest];
      const float sky = edge != nullptr                     ? edge->sky_share
                        : std::isinf(face.depth_m[nearest]) ? 1.0F
                                                            : 0.0F;
      sky_share_[pixel] += weight * sky;
      add(edge != nullptr ? edge->sky.data() : light, 3, weight * sky, &sky_[3 * pixel]);
      add(edge != nullptr ? edge->ground.data() : light, 3, weight * (1 - sky),
          &ground_[3 * pixel]);
    });
    add_to(frame_.statistics, face.statistics);
  }

  Frame finished() && {
    add_edges();
    add_discs();
    if (frame_.layers) {
      samples_.for_pixels([&](std::size_t pixel) {
        float* const n = &frame_.layers->normal[3 * pixel];
        const float length = std::hypot(n[0], n[1], n[2]);
        for (int k = 0; k < 3; ++k) n[k] = length > 0 ? n[k] / length : 0;
      });
    }
    return std::move(frame_);
  }

 private:
  void add_directions(double azimuth) {
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    frame_.view_zenith_deg.assign(frame_.luminance.size(), kNone);
    frame_.view_azimuth_deg.assign(frame_.luminance.size(), kNone);
    samples_.for_pixels([&](std::size_t pixel) {
      if (weight_[pixel] <= 0) return;
      const auto x = static_cast<double>(pixel % frame_.width) + 0.5,
                 y = static_cast<double>(pixel / frame_.width) + 0.5;
      const Axis d = samples_.layout().direction(x, y).value();
      const double turned = std::remainder(azimuth + std::atan2(d[0], d[1]), 2 * kPi);
      frame_.view_zenith_deg[pixel] =
          static_cast<float>(kDegreesPerRadian * std::atan2(std::hypot(d[0], d[1]), d[2]));
      frame_.view_azimuth_deg[pixel] = static_cast<float>(kDegreesPerRadian * turned);
    });
  }

  // In parts, each to the pixel that shows it.
  void add_disc(const CubeView& face, const DiscPixel& disc) {
    constexpr int kParts = 4;
    const int side = samples_.face_side();
    const auto column = static_cast<int>(disc.pixel) % side,
               row = static_cast<int>(disc.pixel) / side;
    for (int j = 0; j < kParts; ++j) {
      for (int i = 0; i < kParts; ++i) {
        const double u = 2 * (column + (i + 0.5) / kParts) / side - 1,
                     v = 1 - 2 * (row + (j + 0.5) / kParts) / side;
        Axis d;
        const double length = std::hypot(1, u, v);
        for (std::size_t k = 0; k < 3; ++k)
          d[k] = (face.forward[k] + u * face.right[k] + v * face.up[k]) / length;
        const auto point = samples_.layout().point(d);
        if (!point) continue;
        const int x = std::clamp(static_cast<int>((*point)[0]), 0, frame_.width - 1),
                  y = std::clamp(static_cast<int>((*point)[1]), 0, frame_.height - 1);
        const std::size_t pixel = static_cast<std::size_t>(y) * frame_.width + x;
        if (weight_[pixel] <= 0) continue;
        const double solid_angle = samples_.layout().solid_angle_sr(x, y);
        const auto share =
            static_cast<float>(double{disc.solid_angle_sr} / (kParts * kParts) / solid_angle);
        auto& to = discs_[pixel];
        if (!to) {
          to = DiscPixel{};
          to->solid_angle_sr = static_cast<float>(solid_angle);
        }
        to->cover += share * disc.cover;
        for (std::size_t k = 0; k < 3; ++k) to->rgb[k] += share * disc.rgb[k];
        to->luminance += share * disc.luminance;
      }
    }
  }

  void add_discs() {
    for (std::size_t pixel = 0; pixel < discs_.size(); ++pixel) {
      if (!discs_[pixel]) continue;
      DiscPixel& disc = frame_.discs.emplace_back(*discs_[pixel]);
      disc.pixel = pixel;
      disc.cover = std::min(disc.cover, 1.0F);
      add(disc.rgb.data(), 3, 1, &frame_.rgb[3 * pixel]);
      frame_.luminance[pixel] += disc.luminance;
    }
  }

  void add_edges() {
    for (std::size_t pixel = 0; pixel < sky_share_.size(); ++pixel) {
      const float sky = sky_share_[pixel], ground = weight_[pixel] > 0 ? 1 - sky : 0;
      constexpr float kLeast = 1e-4F;  // sums of shares are rounded
      if (sky < kLeast || ground < kLeast) continue;
      EdgePixel& edge = frame_.edges.emplace_back(EdgePixel{pixel, sky, {}, {}});
      for (std::size_t k = 0; k < 3; ++k) {
        edge.sky[k] = sky_[3 * pixel + k] / sky;
        edge.ground[k] = ground_[3 * pixel + k] / ground;
      }
    }
  }

  const FaceSamples& samples_;
  Frame frame_;
  std::vector<float> weight_;                    // [pixel] of each of its samples
  std::vector<float> sky_share_, sky_, ground_;  // [pixel], [pixel][3] times their shares
  std::vector<std::optional<DiscPixel>> discs_;  // [pixel]
};

}  // namespace

const MapProjectionEntry& entry_of(PictureProjection projection) {
  return map_projections()[static_cast<std::size_t>(projection) - 1];
}

bool has_direction(PictureProjection projection) {
  return projection == PictureProjection::kPerspective || projection == PictureProjection::kAngular;
}

std::unique_ptr<MapProjection> projection_of(const FrameOptions& options) {
  if (options.projection == PictureProjection::kPerspective) return nullptr;
  const MapProjectionEntry& entry = entry_of(options.projection);
  const double field = options.field_of_view.value_or(entry.field_of_view);
  if (options.field_of_view && !(field >= kRadiansPerDegree && field <= 2 * kPi))
    throw std::invalid_argument(
        fmt::format("render.field_of_view = {:.9g}: must be 1 to 360 degrees in radians", field));
  auto map = entry.make(options.height, field);
  if (map->width() != options.width)
    throw std::invalid_argument(
        fmt::format("render.size = {} x {}: must be {}:1 for the projection {}", options.width,
                    options.height, map->width() / map->height(), entry.name));
  return map;
}

std::vector<FrameOptions> cube_faces(const FrameOptions& options) {
  const FaceSamples samples(options);
  std::vector<FrameOptions> faces;
  for (std::size_t i = 0; i < kCubeFaces; ++i)
    if (samples.shows(i)) faces.push_back(face_options(options, samples, cube_views()[i]));
  return faces;
}

Frame mapped_frame(const FrameOptions& options, const DrawFace& draw,
                   const std::function<void(double)>& progress) {
  const FaceSamples samples(options);
  MappedFrame mapped(options, samples);
  for (std::size_t i = 0; i < kCubeFaces; ++i) {
    if (!samples.shows(i)) continue;
    const auto report = [&](double done) {
      if (progress) progress((static_cast<double>(i) + done) / kCubeFaces);
    };
    mapped.add_face(i, draw(face_options(options, samples, cube_views()[i]), report));
  }
  return std::move(mapped).finished();
}

}  // namespace skyfit
