// SPDX-License-Identifier: Apache-2.0
// What the options of `skyfit render` mean, group by group. Every function throws UsageError, and
// what validate() of what it returns throws.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/render_options.h"
#include "render/sequence/sequence.h"

namespace skyfit::cli {

// The first two of the values.
Place parse_place(std::string_view option, const std::string& text,
                  const std::vector<double>& values);

// Camera, sun and, where there is one, preset.
Keyframe parse_start(const RenderOptions& options, const CLI::App& command);

// The sun from one time of a day to another; past midnight where the second is not later. A camera
// without heading keeps the one it has in the first frame.
Sequence parse_day(const RenderOptions& options, const CLI::App& command, Keyframe start);

// Nothing when there is no such day or time.
std::optional<Instant> parse_instant(const std::string& date, const std::string& clock,
                                     double utc_offset_h);

// The sun over a place by the calendar.
SunDirection sun_over(Instant time, const Place& place);

Scene parse_scene(const RenderOptions& options, const CLI::App& command);
FrameOptions parse_frame(const RenderOptions& options, const CLI::App& command);
ToneOptions parse_tone(const RenderOptions& options, const CLI::App& command);

}  // namespace skyfit::cli
