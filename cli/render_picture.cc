// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/arguments.h"
#include "cli/frame_statistics.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/render_arguments.h"
#include "cli/render_modes.h"
#include "cli/render_session.h"
#include "render/sequence/strip.h"

namespace skyfit::cli {
namespace {

constexpr double kTablesShare = 0.8;  // of the time that a frame takes
constexpr int kGap = 4;               // pixels between the frames of a strip

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
  if (request.stats) print_statistics(StatisticsTable().row(0, frame.statistics), time, request);
}

void render_strip(const RenderRequest& request) {
  const Strip& strip = *request.strip;
  const int count = static_cast<int>(strip.values.size());
  std::vector<TimelineStep> steps;
  for (int i = 0; i < count; ++i) {
    Preset preset = request.sequence.keyframes.front().preset;
    set_parameter(preset.atmosphere, strip.parameter, strip.values[i]);
    preset.fit = nullptr;
    steps.push_back({1.0 * i, preset});
  }
  TimeAccount time;
  std::vector<Frame> frames;
  std::string statistics;
  {
    Progress progress("rendering");
    StatisticsTable table;
    RenderSession session(request, steps, 0, time, [](double, std::string_view) {});
    for (int i = 0; i < count; ++i) {
      progress.show((i + 0.0) / count, fmt::format("frame {} of {}", i + 1, count));
      frames.push_back(session.draw(shot_at(request.sequence, 0, sun_over), i, {}));
      statistics += table.row(i, frames.back().statistics);
    }
    statistics += table.medians();
  }
  time.done("closing the renderer");
  const ParameterInfo info = parameter_info(strip.parameter);
  std::vector<std::string> values;
  for (const double value : strip.values) values.push_back(fmt::format("{:.9g}", value));
  Frame whole = side_by_side(frames, kGap);
  whole.metadata.emplace_back(
      "skyfit:strip", fmt::format("{} [{}]: {}", info.name, info.unit, fmt::join(values, ", ")));
  int left = 0;
  for (int i = 0; i < count; ++i) {
    whole.captions.push_back(
        {left, frames[i].width, std::string(info.name),
         fmt::format("{:.4g}{}{}", strip.values[i], info.unit == "1" ? "" : " ",
                     info.unit == "1" ? "" : info.unit)});
    left += frames[i].width + kGap;
  }
  write_frame_files(whole, paths(request.out), request.tone, false);
  time.done("files");
  print(fmt::format("from left to right, {} [{}]:\n", info.name, info.unit));
  for (int i = 0; i < count; ++i) print(fmt::format("  {:>3}  {}\n", i, values[i]));
  if (request.stats) print_statistics(statistics, time, request);
}

}  // namespace skyfit::cli
