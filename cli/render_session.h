// SPDX-License-Identifier: Apache-2.0
// Where the frames of `skyfit render` are drawn: the planet, the model that makes the tables, and
// the timeline.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "cli/render_request.h"
#include "cli/time_account.h"
#include "model/registry.h"
#include "model/sky_model.h"
#include "render/sequence/table_updates.h"
#include "render/sequence/timeline.h"

namespace skyfit::cli {

// Progress in 0..1 and what is being done; may be called from several threads.
using Report = std::function<void(double, std::string_view)>;

class RenderSession {
 public:
  // Opens the scene, while the tables of the time at which the first frame will be drawn are made
  // in the background. `report` hears of the tables, `time` of all that is done. Throws what
  // Renderer and make_sky_model() throw.
  RenderSession(const RenderRequest& request, std::vector<TimelineStep> timeline,
                double first_time_s, TimeAccount& time, Report report);

  Frame draw(const Shot& shot, double time_s, const std::function<void(double)>& progress);
  // With other options than the request's.
  Frame draw(const Shot& shot, double time_s, const FrameOptions& options,
             const std::function<void(double)>& progress);

 private:
  AtmosphereTables tables_of(std::size_t step) const;
  Atmosphere<double> drawn_atmosphere(const Preset& preset) const;
  FrameOptions placed(const Shot& shot, const Preset& preset, FrameOptions frame) const;
  Preset show(double time_s);
  Frame draw_updated(const Shot& shot, double time_s, const std::function<void(double)>& progress);

  const RenderRequest& request_;
  TimeAccount& time_;
  Report report_;
  std::unique_ptr<SkyModel> model_;
  bool stays_;  // the atmosphere, from frame to frame
  std::vector<TimelineStep> steps_;
  std::vector<std::optional<HeightAxis>> heights_;  // of each step's tables; none: their own
  std::optional<Timeline> timeline_;                // or, with --update-frames,
  std::optional<TableUpdates> updates_;             // made for the first frame
  Renderer renderer_;
  Timeline::Tables shown_;  // what renderer_ has
  bool settled_ = false;    // it has them for all times, and alone
  bool warned_ = false;     // of what its scene lacks
};

// Writes PNG or EXR, by the extension.
void write_frame(const Frame& frame, const std::filesystem::path& file, const ToneOptions& tone);

// All files appear, or none. `panels`: beside each PNG those of its parts, name.PANEL.png.
void write_frame_files(const Frame& frame, const std::vector<std::filesystem::path>& files,
                       const ToneOptions& tone, bool panels);

// The timeline that the keyframes ask for.
std::vector<TimelineStep> timeline_of(const Sequence& sequence);

}  // namespace skyfit::cli
