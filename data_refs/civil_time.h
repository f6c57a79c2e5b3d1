// SPDX-License-Identifier: Apache-2.0
// Instants in UTC from the dates, clock times and offsets that files of measurements state.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace skyfit::refs {

using Instant = std::chrono::sys_time<std::chrono::milliseconds>;

// `date` YYYY-MM-DD (or with / or . between), `clock` HH:MM or HH:MM:SS with an optional fraction
// (or with . between), of a clock that is utc_offset_h ahead of UTC. Nothing when it is no such
// instant, such as 2013-02-30.
std::optional<Instant> instant(std::string_view date, std::string_view clock, double utc_offset_h);

// The same from "2013-05-27T09:30:00", or with a space for the T.
std::optional<Instant> instant(std::string_view date_and_clock, double utc_offset_h);

// "2013-05-27T13:30:00Z", to the second.
std::string iso_text(Instant time);

}  // namespace skyfit::refs
