// SPDX-License-Identifier: Apache-2.0
#include "cli/frame_statistics.h"
#include "cli/progress.h"
#include "cli/render_arguments.h"
#include "cli/render_modes.h"
#include "cli/render_session.h"

namespace skyfit::cli {
namespace {

constexpr double kTablesShare = 0.8;  // of the time that a frame takes

std::vector<std::filesystem::path> paths(const std::vector<std::string>& names) {
  return {names.begin(), names.end()};
}

}  // namespace

void render_picture(const RenderRequest& request) {
  TimeAccount time;
  Frame frame;
  {
    Progress progress("rendering");
    RenderSession session(
        request, timeline_of(request.sequence), 0, time,
        [&](double done, std::string_view what) { progress.show(kTablesShare * done, what); });
    frame = session.draw(shot_at(request.sequence, 0, sun_over), 0, [&](double done) {
      progress.show(kTablesShare + (1 - kTablesShare) * done, "frame");
    });
  }
  time.done("closing the renderer");
  write_frame_files(frame, paths(request.out), request.tone, request.panels);
  time.done("files");
  report_frames(StatisticsTable().row(0, frame.statistics), frame.statistics.device, time, request);
}

}  // namespace skyfit::cli
