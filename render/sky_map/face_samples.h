// SPDX-License-Identifier: Apache-2.0
// Where the samples of a frame of all directions lie on the faces of a cube about its camera.
#pragma once

#include <tbb/parallel_for.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "model/geometry/map_projection.h"
#include "render/render.h"

namespace skyfit {

// Axes of the frame: x to the right of the camera's azimuth, y along it, z up.
struct CubeView {
  Axis forward, right, up;
  double zenith, turn;  // of the camera that draws it; turn: from the picture's azimuth
};
inline constexpr std::size_t kCubeFaces = 6;
const std::array<CubeView, kCubeFaces>& cube_views();

// Between a picture's points and directions in the frame's axes.
class PictureLayout {
 public:
  explicit PictureLayout(const FrameOptions& options);
  std::optional<Axis> direction(double x, double y) const;
  std::optional<std::array<double, 2>> point(const Axis& direction) const;
  double solid_angle_sr(int x, int y) const { return map_->solid_angle_sr(x, y); }

 private:
  std::unique_ptr<MapProjection> map_;
  Axis forward_, up_;
};

// Where each sample of a picture is on the faces.
class FaceSamples {
 public:
  explicit FaceSamples(const FrameOptions& options);

  const PictureLayout& layout() const { return layout_; }
  int face_side() const { return face_side_; }
  bool shows(std::size_t face) const { return shown_[face]; }

  // Of a sample on a face: the pixel that holds it and how far from that pixel's centre it lies,
  // in pixels, -1/2 .. 1/2.
  struct OnFace {
    int column, row;
    float right, down;
  };

  // Calls f(pixel, OnFace) for each sample on a face; those of a pixel on one thread.
  template <class F>
  void for_face(std::size_t face, F&& f) const {
    const std::uint32_t first = static_cast<std::uint32_t>(face) * face_samples(),
                        end = first + face_samples();
    const auto count = static_cast<std::size_t>(per_side_ * per_side_);
    for_pixels([&](std::size_t pixel) {
      for (std::size_t i = pixel * count; i < (pixel + 1) * count; ++i) {
        if (samples_[i] < first || samples_[i] >= end) continue;
        const auto at = static_cast<int>(samples_[i] - first);
        f(pixel, OnFace{at % face_side_, at / face_side_, offsets_[i].right / kOffsets,
                        offsets_[i].down / kOffsets});
      }
    });
  }
  template <class F>
  void for_pixels(F&& f) const {
    tbb::parallel_for(0, height_, [&](int y) {
      const std::size_t first = static_cast<std::size_t>(y) * width_;
      for (std::size_t pixel = first; pixel < first + width_; ++pixel) f(pixel);
    });
  }
  std::size_t shown_in(std::size_t pixel) const;  // of its samples, those with a direction

 private:
  static constexpr std::uint32_t kNothing = ~std::uint32_t{0};

  std::uint32_t face_samples() const {
    return static_cast<std::uint32_t>(face_side_) * static_cast<std::uint32_t>(face_side_);
  }
  std::span<const std::uint32_t> of_pixel(std::size_t pixel) const {
    const auto count = static_cast<std::size_t>(per_side_ * per_side_);
    return std::span(samples_).subspan(pixel * count, count);
  }

  struct Offset {
    std::int8_t right, down;  // in kOffsets of a pixel of the face
  };
  static constexpr float kOffsets = 254;

  std::pair<std::uint32_t, Offset> sample_at(const Axis& direction) const;
  void place_samples();

  PictureLayout layout_;
  int width_, height_, per_side_, face_side_;
  std::vector<std::uint32_t> samples_;  // [pixel][per_side^2] face, row, column
  std::vector<Offset> offsets_;         // of each
  std::array<bool, kCubeFaces> shown_{};
};

}  // namespace skyfit
