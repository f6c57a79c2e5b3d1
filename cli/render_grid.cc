// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/frame_statistics.h"
#include "cli/light_check.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/render_arguments.h"
#include "cli/render_modes.h"
#include "cli/render_session.h"
#include "model/base/whole_file.h"

namespace skyfit::cli {
namespace {

const Preset& preset_of(const RenderRequest& cell) {
  return cell.sequence.keyframes.front().preset;
}

// Cells that one renderer draws with one model, by their presets: each is tabulated once.
struct SessionCells {
  std::vector<TimelineStep> presets;
  std::vector<std::vector<std::size_t>> cells;  // of each
};

std::vector<SessionCells> by_session(const GridRequest& grid) {
  std::vector<SessionCells> sessions;
  std::map<std::string, std::size_t> session_of;
  std::map<std::pair<std::size_t, std::string>, std::size_t> preset_in;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const auto [session, is_new] = session_of.try_emplace(grid.sessions[i], sessions.size());
    if (is_new) sessions.emplace_back();
    SessionCells& of = sessions[session->second];
    const Preset& preset = preset_of(grid.cells[i]);
    const auto [step, is_other] =
        preset_in.try_emplace({session->second, preset_to_json(preset)}, of.presets.size());
    if (is_other) {
      of.presets.push_back({static_cast<double>(of.presets.size()), preset});
      of.cells.emplace_back();
    }
    of.cells[step->second].push_back(i);
  }
  return sessions;
}

struct DrawnGrid {
  std::vector<Frame> frames;
  std::string statistics;
};

DrawnGrid drawn(const GridRequest& grid, TimeAccount& time) {
  Progress progress("rendering");
  DrawnGrid drawn{std::vector<Frame>(grid.cells.size()), {}};
  StatisticsTable table;
  int number = 0;
  for (const auto& [presets, cells] : by_session(grid)) {
    RenderSession session(grid.cells[cells[0][0]], presets, 0, time,
                          [](double, std::string_view) {});
    for (std::size_t step = 0; step < cells.size(); ++step) {
      for (const std::size_t i : cells[step]) {
        progress.show(number / static_cast<double>(grid.cells.size()),
                      fmt::format("frame {} of {}", number + 1, grid.cells.size()));
        const RenderRequest& cell = grid.cells[i];
        drawn.frames[i] =
            session.draw(shot_at(cell.sequence, 0, sun_over), presets[step].time_s, cell.frame, {});
        drawn.statistics += table.row(static_cast<int>(i), drawn.frames[i].statistics);
        ++number;
      }
    }
  }
  drawn.statistics += table.medians();
  return drawn;
}

// With the exposure of each frame.
std::vector<ToneOptions> tones_of(const GridRequest& grid, const std::vector<Frame>& frames) {
  std::vector<const Frame*> metered;
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (!grid.cells[i].tone.exposure) metered.push_back(&frames[i]);
  std::optional<double> common;
  if (grid.meters_together && !metered.empty()) common = metered_exposure(metered);
  std::vector<ToneOptions> tones;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    tones.push_back(grid.cells[i].tone);
    if (!tones.back().exposure)
      tones.back().exposure = common.value_or(metered_exposure(frames[i]));
  }
  return tones;
}

std::vector<std::pair<std::string, std::string>> metadata_of(
    const GridRequest& grid, const std::vector<ToneOptions>& tones) {
  std::vector<std::pair<std::string, std::string>> metadata;
  if (!grid.columns.empty()) metadata.emplace_back("skyfit:strip", described(grid.columns));
  if (!grid.rows.empty()) metadata.emplace_back("skyfit:rows", described(grid.rows));
  const FrameOptions& frame = grid.cells.front().frame;
  metadata.emplace_back(
      "skyfit:grid",
      fmt::format("{} columns, {} rows of {} x {} pixels, {} pixels apart", steps_of(grid.columns),
                  steps_of(grid.rows), frame.width, frame.height, kGridGap));
  std::vector<std::string> exposures;
  for (const ToneOptions& tone : tones)
    exposures.push_back(fmt::format("{:.9g}", *tone.exposure * std::exp2(tone.exposure_stops)));
  metadata.emplace_back("skyfit:exposures_m2_per_cd",
                        fmt::format("{}", fmt::join(exposures, ", ")));
  return metadata;
}

FrameGrid picture_of(const GridRequest& grid, std::vector<Frame> frames) {
  FrameGrid picture;
  picture.columns = static_cast<int>(steps_of(grid.columns));
  picture.tones = tones_of(grid, frames);
  picture.metadata = metadata_of(grid, picture.tones);
  for (std::size_t i = 0; i < frames.size(); ++i)
    picture.captions.push_back(captions_at(grid.columns, i % steps_of(grid.columns), grid.rows,
                                           i / steps_of(grid.columns)));
  picture.frames = std::move(frames);
  return picture;
}

void write_files(const FrameGrid& grid, const std::vector<std::string>& files) {
  for (const Frame& frame : grid.frames) check_light(frame);
  WholeFiles whole({files.begin(), files.end()});
  for (std::size_t i = 0; i < files.size(); ++i) {
    whole.make(i, [&](const std::filesystem::path& file) {
      if (file.extension() == ".png") {
        write_png(grid, file);
      } else {
        write_frame(joined(grid), file, {});
      }
    });
  }
  whole.publish();
}

void print_axis(std::string_view direction, const GridAxis& axis) {
  if (axis.empty()) return;
  std::vector<std::string> names;
  for (const GridQuantity& each : axis)
    names.push_back(each.unit.empty() ? each.name : fmt::format("{} [{}]", each.name, each.unit));
  print(fmt::format("{}, {}:\n", direction, fmt::join(names, ", ")));
  for (std::size_t step = 0; step < steps_of(axis); ++step) {
    std::string line = fmt::format("  {:>3}", step);
    for (const GridQuantity& quantity : axis) line += "  " + quantity.values[step];
    print(line + "\n");
  }
}

}  // namespace

void render_grid(const GridRequest& request) {
  TimeAccount time;
  DrawnGrid grid = drawn(request, time);
  const std::string device = grid.frames.front().statistics.device;
  time.done("closing the renderer");
  write_files(picture_of(request, std::move(grid.frames)), request.cells.front().out);
  time.done("files");
  print_axis("from left to right", request.columns);
  print_axis("from top to bottom", request.rows);
  report_frames(grid.statistics, device, time, request.cells.front());
}

}  // namespace skyfit::cli
