// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "render/gl/passes/passes.h"

namespace skyfit {

// What the device draws while the next frame is prepared.
struct SubmittedFrame {
  FrameStatistics statistics;
  std::int64_t begin_ns;  // by the device's clock
  StartedPasses passes;

  FrameStatistics wait() const {
    FrameStatistics finished = statistics;
    finished.passes = passes.times();
    finished.milliseconds = 1e-6 * static_cast<double>(passes.end_ns() - begin_ns);
    return finished;
  }
};

}  // namespace skyfit
