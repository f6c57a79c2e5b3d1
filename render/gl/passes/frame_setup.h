// SPDX-License-Identifier: Apache-2.0
// What a frame needs before its passes: samples that fit, textures, clocks.
#pragma once

#include <chrono>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "render/gl/passes/passes.h"
#include "render/render.h"

namespace skyfit {

// Samples of a pixel along each side, fewer than asked for where the textures would not fit: large
// pictures have small pixels. Throws std::invalid_argument where this OpenGL cannot draw the size.
int affordable_samples(const FrameOptions& options);

// The textures of a frame of so many samples.
void add_targets(int width, int height, bool layers, FrameGraph& graph);

// Unit vectors in the camera frame, one or two: of the sun and of the second light.
std::vector<glm::dvec3> directions_of_suns(const FrameOptions& options);

std::int64_t device_clock_ns();

// Steps one after the other by the wall clock.
class StepClock {
 public:
  void done(const char* step) {
    const Clock::time_point now = Clock::now();
    steps_.push_back({step, std::chrono::duration<double, std::milli>(now - last_).count()});
    last_ = now;
  }
  const std::vector<PassTime>& steps() const { return steps_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
  std::vector<PassTime> steps_;
};

}  // namespace skyfit
