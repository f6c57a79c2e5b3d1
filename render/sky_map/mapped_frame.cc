// SPDX-License-Identifier: Apache-2.0
#include "render/sky_map/mapped_frame.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "model/numerics/angles.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::int64_t kMostSamples = std::int64_t{1} << 25;  // of the picture, and of a face

// Of a face: pixels as wide as a sun's disc of 0.5 degrees, whose light is wrong in wider ones.
constexpr double kLeastSide = 256;

// Axes of the frame: x to the right of the camera's azimuth, y along it, z up.
struct Face {
  Axis forward, right, up;
  double zenith, turn;  // of the camera that draws it; turn: from the picture's azimuth
};
constexpr std::array<Face, 6> kFaces = {{
    {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, kPi / 2, 0},
    {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, kPi / 2, kPi / 2},
    {{0, -1, 0}, {-1, 0, 0}, {0, 0, 1}, kPi / 2, kPi},
    {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, kPi / 2, -kPi / 2},
    {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}, 0, 0},
    {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, kPi, 0},
}};

double dot(const Axis& a, const Axis& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Between a picture's points and directions in the frame's axes.
class Layout {
 public:
  explicit Layout(const FrameOptions& options) : map_(projection_of(options)) {
    const double pitch =
        has_direction(options.projection) ? kPi / 2 - options.camera.view_zenith : 0;
    forward_ = {0, std::cos(pitch), std::sin(pitch)};
    up_ = {0, -std::sin(pitch), std::cos(pitch)};
  }

  std::optional<Axis> direction(double x, double y) const {
    const auto d = map_->direction(x, y);
    if (!d) return {};
    return Axis{(*d)[0], (*d)[1] * forward_[1] + (*d)[2] * up_[1],
                (*d)[1] * forward_[2] + (*d)[2] * up_[2]};
  }
  std::optional<std::array<double, 2>> point(const Axis& d) const {
    return map_->point({d[0], dot(d, forward_), dot(d, up_)});
  }
  double solid_angle_sr(int x, int y) const { return map_->solid_angle_sr(x, y); }

 private:
  std::unique_ptr<MapProjection> map_;
  Axis forward_, up_;
};

// The largest angle across the middle of a pixel.
double widest_pixel_rad(const Layout& layout, int width, int height) {
  constexpr int kTried = 64;
  double widest = 0;
  for (int j = 0; j < kTried; ++j) {
    for (int i = 0; i < kTried; ++i) {
      const double x = std::floor((i + 0.5) / kTried * width) + 0.5,
                   y = std::floor((j + 0.5) / kTried * height) + 0.5;
      const auto across = [&](double dx, double dy) {
        const auto a = layout.direction(x - dx, y - dy), b = layout.direction(x + dx, y + dy);
        if (a && b) widest = std::max(widest, 2 * std::acos(std::clamp(dot(*a, *b), -1.0, 1.0)));
      };
      across(0.25, 0);
      across(0, 0.25);
    }
  }
  return widest;
}

// Where each sample of a picture is on the faces.
class Samples {
 public:
  explicit Samples(const FrameOptions& options)
      : layout_(options), width_(options.width), height_(options.height) {
    const std::int64_t pixels = std::int64_t{width_} * height_;
    per_side_ = options.samples_per_side;
    while (per_side_ > 1 && pixels * per_side_ * per_side_ > kMostSamples) --per_side_;
    face_side_ =
        side_of_faces(per_side_ * std::round(2 / widest_pixel_rad(layout_, width_, height_)));
    place_samples();
  }

  const Layout& layout() const { return layout_; }
  int face_side() const { return face_side_; }
  bool shows(std::size_t face) const { return shown_[face]; }

  // Calls f(pixel, sample of the face) for each sample on a face; those of a pixel on one thread.
  template <class F>
  void for_face(std::size_t face, F&& f) const {
    const std::uint32_t first = static_cast<std::uint32_t>(face) * face_samples(),
                        end = first + face_samples();
    for_pixels([&](std::size_t pixel) {
      for (const std::uint32_t sample : of_pixel(pixel))
        if (sample >= first && sample < end) f(pixel, sample - first);
    });
  }
  template <class F>
  void for_pixels(F&& f) const {
    tbb::parallel_for(0, height_, [&](int y) {
      const std::size_t first = static_cast<std::size_t>(y) * width_;
      for (std::size_t pixel = first; pixel < first + width_; ++pixel) f(pixel);
    });
  }
  // Samples of a pixel that show a direction.
  std::size_t shown_in(std::size_t pixel) const {
    const auto samples = of_pixel(pixel);
    return samples.size() - static_cast<std::size_t>(std::ranges::count(samples, kNothing));
  }

 private:
  // Samples are the middles of every, every third, every fifth .. of a face.
  static int side_of_faces(double wanted) {
    const double most = std::floor(std::sqrt(static_cast<double>(kMostSamples)));
    double side = std::clamp(wanted, 1.0, most);
    if (side < kLeastSide) side *= 2 * std::ceil((kLeastSide / side - 1) / 2) + 1;
    return static_cast<int>(side);
  }

  static constexpr std::uint32_t kNothing = ~std::uint32_t{0};

  std::uint32_t face_samples() const {
    return static_cast<std::uint32_t>(face_side_) * static_cast<std::uint32_t>(face_side_);
  }
  std::span<const std::uint32_t> of_pixel(std::size_t pixel) const {
    const auto count = static_cast<std::size_t>(per_side_ * per_side_);
    return std::span(samples_).subspan(pixel * count, count);
  }

  std::uint32_t sample_at(const Axis& d) const {
    const auto face = std::ranges::max_element(
        kFaces, {}, [&](const Face& each) { return dot(d, each.forward); });
    const double depth = dot(d, face->forward);
    const auto cell = [&](double tangent) {
      return static_cast<std::uint32_t>(
          std::clamp(0.5 * (1 + tangent) * face_side_, 0.0, face_side_ - 1.0));
    };
    const std::uint32_t column = cell(dot(d, face->right) / depth),
                        row = cell(-dot(d, face->up) / depth);
    return static_cast<std::uint32_t>(face - kFaces.begin()) * face_samples() +
           row * static_cast<std::uint32_t>(face_side_) + column;
  }

  void place_samples() {
    const auto count = static_cast<std::size_t>(per_side_ * per_side_);
    samples_.resize(count * width_ * height_);
    for_pixels([&](std::size_t pixel) {
      std::uint32_t* sample = &samples_[pixel * count];
      for (int j = 0; j < per_side_; ++j) {
        for (int i = 0; i < per_side_; ++i) {
          const double x = static_cast<double>(pixel % width_) + (i + 0.5) / per_side_,
                       y = static_cast<double>(pixel / width_) + (j + 0.5) / per_side_;
          const auto d = layout_.direction(x, y);
          *sample++ = d ? sample_at(*d) : kNothing;
        }
      }
    });
    for (const std::uint32_t sample : samples_)
      if (sample != kNothing) shown_[sample / face_samples()] = true;
  }

  Layout layout_;
  int width_, height_, per_side_, face_side_;
  std::vector<std::uint32_t> samples_;  // [pixel][per_side^2] face, row, column
  std::array<bool, kFaces.size()> shown_{};
};

FrameOptions face_options(const FrameOptions& options, const Samples& samples, const Face& face) {
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
  MappedFrame(const FrameOptions& options, const Samples& samples) : samples_(samples) {
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
      add_disc(kFaces[number], disc);
      for (std::size_t k = 0; k < 3; ++k) {
        float& light = face.rgb[3 * disc.pixel + k];
        light = std::max(light - disc.rgb[k], 0.0F);
      }
      float& luminance = face.luminance[disc.pixel];
      luminance = std::max(luminance - disc.luminance, 0.0F);
    }
    std::vector<const EdgePixel*> edge_at(face.luminance.size());
    for (const EdgePixel& edge : face.edges) edge_at[edge.pixel] = &edge;
    samples_.for_face(number, [&](std::size_t pixel, std::uint32_t sample) {
      const float weight = weight_[pixel];
      const float* light = &face.rgb[3 * std::size_t{sample}];
      add(light, 3, weight, &frame_.rgb[3 * pixel]);
      frame_.luminance[pixel] += weight * face.luminance[sample];
      frame_.depth_m[pixel] = std::min(frame_.depth_m[pixel], face.depth_m[sample]);
      if (frame_.layers) {
        for (const auto layer : kLayers)
          add(&((*face.layers).*layer)[3 * std::size_t{sample}], 3, weight,
              &((*frame_.layers).*layer)[3 * pixel]);
      }
      const EdgePixel* const edge = edge_at[sample];
      const float sky = edge != nullptr                    ? edge->sky_share
                        : std::isinf(face.depth_m[sample]) ? 1.0F
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
      const auto d = samples_.layout().direction(x, y);
      if (!d) return;
      const double turned = std::remainder(azimuth + std::atan2((*d)[0], (*d)[1]), 2 * kPi);
      frame_.view_zenith_deg[pixel] =
          static_cast<float>(kDegreesPerRadian * std::atan2(std::hypot((*d)[0], (*d)[1]), (*d)[2]));
      frame_.view_azimuth_deg[pixel] = static_cast<float>(kDegreesPerRadian * turned);
    });
  }

  // In parts, each to the pixel that shows it.
  void add_disc(const Face& face, const DiscPixel& disc) {
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
        const double solid_angle = samples_.layout().solid_angle_sr(x, y);
        if (!(solid_angle > 0)) continue;
        const auto share =
            static_cast<float>(double{disc.solid_angle_sr} / (kParts * kParts) / solid_angle);
        auto& to = discs_[static_cast<std::size_t>(y) * frame_.width + x];
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

  const Samples& samples_;
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
  const Samples samples(options);
  std::vector<FrameOptions> faces;
  for (std::size_t i = 0; i < kFaces.size(); ++i)
    if (samples.shows(i)) faces.push_back(face_options(options, samples, kFaces[i]));
  return faces;
}

Frame mapped_frame(const FrameOptions& options, const DrawFace& draw,
                   const std::function<void(double)>& progress) {
  const Samples samples(options);
  MappedFrame mapped(options, samples);
  for (std::size_t i = 0; i < kFaces.size(); ++i) {
    if (!samples.shows(i)) continue;
    const auto report = [&](double done) {
      if (progress) progress((static_cast<double>(i) + done) / kFaces.size());
    };
    mapped.add_face(i, draw(face_options(options, samples, kFaces[i]), report));
  }
  return std::move(mapped).finished();
}

}  // namespace skyfit
