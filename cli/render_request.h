// SPDX-License-Identifier: Apache-2.0
// What the options of `skyfit render` ask for.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/render_options.h"
#include "model/base/content_cache.h"
#include "model/polarisation.h"
#include "model/tables/table_precision.h"
#include "model/tables/tables.h"
#include "render/sequence/sequence.h"

namespace skyfit::cli {

struct RenderRequest {
  Scene scene;
  GraphicsDevice device = GraphicsDevice::kSoftware;
  std::string model;
  TableLight light;
  TableSizes table_sizes;
  TablePrecision table_precision = TablePrecision::kFloat;
  std::optional<PolarisationAngle> stokes;  // also the polarisation of the sky
  FrameOptions frame;                       // camera, site and sun are those of the sequence
  Sequence sequence;                        // of one frame for a single picture
  bool is_sequence = false;
  ToneOptions tone;
  double adaptation_s = 1;
  std::vector<std::string> out;         // of a picture
  std::string out_dir;                  // of a sequence
  std::vector<std::string> extensions;  // of its frames: .png, .exr
  int update_frames = 0;                // --update-frames; 0: tables of each time
  bool panels = false;                  // beside each PNG of a picture
  bool stats = false;
  std::shared_ptr<ContentCache> cache;  // null with --no-cache and where there is no place for one
  std::string cache_trouble;            // why there is no place
  int threads = 1;
};

// Throws UsageError and what the readers of presets and sequences throw, before anything is drawn:
// files to be read can be, cameras and sizes are possible. The first leaves open where the frames
// go.
RenderRequest frame_request(const RenderOptions& options, const CLI::App& command);
RenderRequest render_request(const RenderOptions& options, const CLI::App& command);
// That a request has files to go to, of kinds that hold what it asks for. Called once in a process:
// it takes the standard output where a file goes there.
void check_outputs(const RenderOptions& options, const CLI::App& command,
                   const RenderRequest& request);

}  // namespace skyfit::cli
