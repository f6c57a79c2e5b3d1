// SPDX-License-Identifier: Apache-2.0
#include "render/sky_map/face_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "render/sky_map/mapped_frame.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::int64_t kMostSamples = std::int64_t{1} << 25;  // of the picture, and of a face

// Of a face: pixels as wide as a sun's disc of 0.5 degrees, whose light is wrong in wider ones.
constexpr double kLeastSide = 256;

constexpr std::array<CubeView, kCubeFaces> kViews = {{
    {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, kPi / 2, 0},
    {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, kPi / 2, kPi / 2},
    {{0, -1, 0}, {-1, 0, 0}, {0, 0, 1}, kPi / 2, kPi},
    {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, kPi / 2, -kPi / 2},
    {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}, 0, 0},
    {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, kPi, 0},
}};

double dot(const Axis& a, const Axis& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The largest angle across the middle of a pixel.
double widest_pixel_rad(const PictureLayout& layout, int width, int height) {
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

// Samples are the middles of every, every third, every fifth .. of a face.
int side_of_faces(double wanted) {
  const double most = std::floor(std::sqrt(static_cast<double>(kMostSamples)));
  double side = std::clamp(wanted, 1.0, most);
  if (side < kLeastSide) side *= 2 * std::ceil((kLeastSide / side - 1) / 2) + 1;
  return static_cast<int>(side);
}

}  // namespace

const std::array<CubeView, kCubeFaces>& cube_views() { return kViews; }

PictureLayout::PictureLayout(const FrameOptions& options) : map_(projection_of(options)) {
  const double pitch = has_direction(options.projection) ? kPi / 2 - options.camera.view_zenith : 0;
  forward_ = {0, std::cos(pitch), std::sin(pitch)};
  up_ = {0, -std::sin(pitch), std::cos(pitch)};
}

std::optional<Axis> PictureLayout::direction(double x, double y) const {
  const auto d = map_->direction(x, y);
  if (!d) return {};
  return Axis{(*d)[0], (*d)[1] * forward_[1] + (*d)[2] * up_[1],
              (*d)[1] * forward_[2] + (*d)[2] * up_[2]};
}

std::optional<std::array<double, 2>> PictureLayout::point(const Axis& d) const {
  return map_->point({d[0], dot(d, forward_), dot(d, up_)});
}

FaceSamples::FaceSamples(const FrameOptions& options)
    : layout_(options), width_(options.width), height_(options.height) {
  const std::int64_t pixels = std::int64_t{width_} * height_;
  per_side_ = options.samples_per_side;
  while (per_side_ > 1 && pixels * per_side_ * per_side_ > kMostSamples) --per_side_;
  face_side_ =
      side_of_faces(per_side_ * std::round(2 / widest_pixel_rad(layout_, width_, height_)));
  place_samples();
}

std::pair<std::uint32_t, FaceSamples::Offset> FaceSamples::sample_at(const Axis& d) const {
  const auto face = std::ranges::max_element(
      kViews, {}, [&](const CubeView& each) { return dot(d, each.forward); });
  const double depth = dot(d, face->forward);
  const auto along = [&](double tangent) {
    return std::clamp(0.5 * (1 + tangent) * face_side_, 0.0, std::nextafter(face_side_, 0.0));
  };
  const double x = along(dot(d, face->right) / depth), y = along(-dot(d, face->up) / depth);
  const auto offset = [](double at) {
    return static_cast<std::int8_t>(std::lround((at - std::floor(at) - 0.5) * double{kOffsets}));
  };
  return {static_cast<std::uint32_t>(face - kViews.begin()) * face_samples() +
              static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(face_side_) +
              static_cast<std::uint32_t>(x),
          {offset(x), offset(y)}};
}

void FaceSamples::place_samples() {
  const auto count = static_cast<std::size_t>(per_side_ * per_side_);
  samples_.assign(count * width_ * height_, kNothing);
  offsets_.resize(samples_.size());
  for_pixels([&](std::size_t pixel) {
    const auto left = static_cast<double>(pixel % width_),
               top = static_cast<double>(pixel / width_);
    // On the rim of a disc a pixel whose centre shows nothing has no direction, and no light.
    if (!layout_.direction(left + 0.5, top + 0.5)) return;
    std::size_t sample = pixel * count;
    for (int j = 0; j < per_side_; ++j) {
      for (int i = 0; i < per_side_; ++i) {
        const auto d = layout_.direction(left + (i + 0.5) / per_side_, top + (j + 0.5) / per_side_);
        if (d) std::tie(samples_[sample], offsets_[sample]) = sample_at(*d);
        ++sample;
      }
    }
  });
  for (const std::uint32_t sample : samples_)
    if (sample != kNothing) shown_[sample / face_samples()] = true;
}

std::size_t FaceSamples::shown_in(std::size_t pixel) const {
  const auto samples = of_pixel(pixel);
  return samples.size() - static_cast<std::size_t>(std::ranges::count(samples, kNothing));
}

}  // namespace skyfit
