// SPDX-License-Identifier: Apache-2.0
// Instants in UTC from the dates, clock times and offsets that files of measurements state.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace skyfit::refs {

// What a time is expected to look like.
inline constexpr std::string_view kTimeForm = "YYYY-MM-DDTHH:MM:SS, also with Z or +HH:MM behind";
inline constexpr double kMostUtcOffset_h = 14;  // of any clock, ahead of UTC or behind

using Instant = std::chrono::sys_time<std::chrono::milliseconds>;

// `date` YYYY-MM-DD (or with / or . between), `clock` HH:MM or HH:MM:SS with an optional fraction
// (or with . between), of a clock that is utc_offset_h ahead of UTC. Nothing when it is no such
// instant, such as 2013-02-30.
std::optional<Instant> instant(std::string_view date, std::string_view clock, double utc_offset_h);

// The same from "2013-05-27T09:30:00", or with a space for the T; an offset that follows, such as
// Z, +02:00 or -0530, is passed over. Nothing where it is none, such as +09:75 or +99:00.
std::optional<Instant> instant(std::string_view date_and_clock, double utc_offset_h);

// The hours ahead of UTC that "2013-05-27T09:30:00+02:00" states; nothing where it states none.
std::optional<double> stated_utc_offset_h(std::string_view date_and_clock);

// "2013-05-27T13:30:00Z", to the second.
std::string iso_text(Instant time);

}  // namespace skyfit::refs
