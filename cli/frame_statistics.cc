// SPDX-License-Identifier: Apache-2.0
#include "cli/frame_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "cli/output.h"
#include "model/base/text.h"

namespace skyfit::cli {
namespace {

constexpr int kCounts = 6;
constexpr std::string_view kHead =
    "      frame   triangles  blocks drawn  outside  behind  hidden   made";

std::string line(const std::string& first, const std::vector<double>& values) {
  std::string text =
      fmt::format("{:>11} {:>11.0f} {:>13.0f} {:>8.0f} {:>7.0f} {:>7.0f} {:>6.0f}", first,
                  values[0], values[1], values[2], values[3], values[4], values[5]);
  for (std::size_t i = kCounts; i < values.size(); ++i)
    text += fmt::format(" {:>15.3f}", values[i]);
  return text + "\n";
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace

std::string StatisticsTable::row(int frame, const FrameStatistics& statistics) {
  std::vector<std::string> passes;
  std::vector<double> values = {static_cast<double>(statistics.triangles),
                                1.0 * statistics.blocks_drawn,
                                1.0 * statistics.blocks_outside,
                                1.0 * statistics.blocks_behind,
                                1.0 * statistics.blocks_hidden,
                                1.0 * statistics.blocks_made};
  for (const PassTime& pass : statistics.passes) {
    passes.push_back(pass.pass);
    values.push_back(pass.milliseconds);
  }
  values.push_back(statistics.milliseconds);
  std::string text;
  if (columns_.empty() || passes != passes_) {
    text = kHead;
    for (const std::string& pass : passes) text += fmt::format(" {:>15}", pass + " ms");
    text += fmt::format(" {:>15}\n", "frame ms");
    passes_ = passes;
    columns_.assign(values.size(), {});
  }
  for (std::size_t i = 0; i < values.size(); ++i) columns_[i].push_back(values[i]);
  return text + line(fmt::to_string(frame), values);
}

std::string StatisticsTable::medians() const {
  if (columns_.empty() || columns_[0].size() < 2) return {};
  std::vector<double> values;
  for (const std::vector<double>& column : columns_) values.push_back(median(column));
  return line("median", values);
}

void report_frames(const std::string& lines, const std::string& device, const TimeAccount& time,
                   const RenderRequest& request) {
  const std::string drawn = device.empty() ? "" : fmt::format("drawn with {}\n", printable(device));
  if (!request.stats) {
    const Verbosity least =
        request.device == GraphicsDevice::kGpu ? Verbosity::kNormal : Verbosity::kVerbose;
    if (!drawn.empty() && verbosity() >= least) fmt::print(stderr, "skyfit: {}", drawn);
    return;
  }
  print(lines + drawn + time.table());
  if (!request.cache_trouble.empty() || (request.cache && request.cache->trouble()))
    fmt::print(stderr, "skyfit: no cache: {}\n",
               request.cache ? printable(*request.cache->trouble()) : request.cache_trouble);
}

}  // namespace skyfit::cli
