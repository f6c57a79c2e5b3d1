// SPDX-License-Identifier: Apache-2.0
// The text that is read in the place of a file whose columns a sidecar names (column_mapping.h),
// with the suns that its lines do not state: of one time for all lines, or of a column of times.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"
#include "data_refs/solar_position.h"

namespace skyfit::refs {

struct MappedSky {
  std::string text;
  bool facts_are_used = false;       // those of time, place and sun
  std::optional<Site> site{};        // that suns were computed for
  std::vector<std::string> notes{};  // lines that were left out
};

// `facts` have columns. Columns local_time (on the clock of utc_offset_h, or with its own offset;
// local_date before it where it is a clock time alone) or time_utc tell the time of each line; a
// scan ends where the sun jumps by 1 deg. Throws std::invalid_argument with one line that names
// file, line, field, value and expectation.
MappedSky mapped_sky(std::string_view text, std::string_view source, const ImportOptions& facts);

// Suns of mapped columns against those of time and place, where the facts or a column tell both.
// Throws as sun_of_scan() where they disagree; otherwise what is to be noted of them.
std::vector<std::string> check_mapped_suns(const Reference& sky, std::string_view source,
                                           const ImportOptions& facts);

}  // namespace skyfit::refs
