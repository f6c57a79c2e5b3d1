// SPDX-License-Identifier: Apache-2.0
#include "data_refs/patch_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "data_refs/sun_check.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr double kPi = std::numbers::pi;

// Mean angle between the sun and the brightest patches of the scans, degrees, when azimuths start
// at `zero`, radians from north.
double brightest_from_sun_deg(std::span<const PatchScan> scans,
                              std::span<const SkyDirection> directions, double zero, bool counter) {
  constexpr std::size_t kBrightest = 3;
  double sum = 0;
  for (const PatchScan& scan : scans) {
    std::vector<std::size_t> order(kPatches);
    std::iota(order.begin(), order.end(), 0u);
    const auto brightness = [&](std::size_t i) {
      return std::isfinite(scan.values[i]) ? scan.values[i] : 0.0;
    };
    std::ranges::partial_sort(order, order.begin() + kBrightest, std::greater{}, brightness);
    for (std::size_t k = 0; k < kBrightest; ++k) {
      const SkyDirection& patch = directions[order[k]];
      Sample sample;
      sample.sun_zenith = scan.sun.zenith;
      sample.view_zenith = patch.view_zenith;
      sample.relative_azimuth =
          zero + (counter ? -1 : 1) * patch.relative_azimuth - scan.sun.azimuth.value_or(0);
      sum += scattering_angle(sample) / kRadiansPerDegree;
    }
  }
  return sum / static_cast<double>(kBrightest * scans.size());
}

// Mean distance between the stated azimuths of the sun and the computed ones when azimuths start at
// `zero`; nothing where a scan does not state it.
std::optional<double> stated_azimuth_off_deg(std::span<const PatchScan> scans, double zero,
                                             bool counter) {
  double sum = 0;
  for (const PatchScan& scan : scans) {
    if (!scan.stated_sun_azimuth || !scan.sun.azimuth) return {};
    sum += std::abs(std::remainder(
        zero + (counter ? -1 : 1) * *scan.stated_sun_azimuth - *scan.sun.azimuth, 2 * kPi));
  }
  return sum / kRadiansPerDegree / static_cast<double>(scans.size());
}

// Where azimuths start, by the azimuth that the file states for the sun; sets facts.azimuth_zero.
std::optional<std::string> settle_by_sun_azimuth(ImportOptions& facts,
                                                 std::span<const PatchScan> scans, bool counter) {
  constexpr double kNear_deg = 10;  // of a sun at another minute of the scan, even a high one
  const auto north = stated_azimuth_off_deg(scans, 0, counter),
             south = stated_azimuth_off_deg(scans, kPi, counter);
  if (!north || !south || std::min(*north, *south) > kNear_deg) return {};
  facts.azimuth_zero = *north < *south ? "north" : "south";
  return fmt::format(
      "azimuth_zero is {}: the file's azimuth of the sun is {:.1f} deg from the "
      "sun's with it",
      *facts.azimuth_zero, std::min(*north, *south));
}

Reference sky_of(const std::string& source, const Unit& unit, const ImportOptions& facts,
                 std::span<const PatchScan> scans, std::span<const SkyDirection> directions,
                 const std::vector<std::string>& notes) {
  MeasuredSky sky(source, unit, facts);
  for (const std::string& text : notes) sky.note(text);
  for (const PatchScan& scan : scans) {
    sky.begin_scan(scan.name, scan.sun);
    for (std::size_t i = 0; i < kPatches; ++i) {
      Reading reading;
      reading.number = static_cast<int>(i) + 1;  // the channel
      reading.view_zenith_deg = directions[i].view_zenith / kRadiansPerDegree;
      reading.view_azimuth_deg = directions[i].relative_azimuth / kRadiansPerDegree;
      reading.value = scan.values[i];
      sky.add(reading);
    }
  }
  return sky.finish();
}

// Sets facts.azimuth_zero, or throws; returns what to note.
std::optional<std::string> settle_azimuth_zero(const std::string& source, const Unit& unit,
                                               ImportOptions& facts,
                                               std::span<const PatchScan> scans,
                                               std::span<const SkyDirection> directions) {
  constexpr double kNear_deg = 40, kApart_deg = 40;  // of a patch of 12 deg and a bright aureole
  const bool counter = facts.azimuth_turns == "counter-clockwise";
  const double north = brightest_from_sun_deg(scans, directions, 0, counter);
  const double south = brightest_from_sun_deg(scans, directions, kPi, counter);
  const std::string found = fmt::format(
      "the brightest patches are {:.0f} deg from the sun with north, {:.0f} deg with south", north,
      south);
  const bool is_clear = std::min(north, south) < kNear_deg && std::abs(north - south) > kApart_deg;
  const std::string says = north < south ? "north" : "south";
  if (!facts.azimuth_zero) {
    if (!is_clear) {
      if (auto settled = settle_by_sun_azimuth(facts, scans, counter)) return settled;
      ImportOptions from_north = facts;
      from_north.azimuth_zero = "north";
      const std::string mends =
          mends_from_either_zero(sky_of(source, unit, from_north, scans, directions, {}));
      throw std::invalid_argument(
          fmt::format("{}: azimuth_zero: not stated, expected north or south: {}{}{}", source,
                      found, mends.empty() ? "" : "; if the clock or place is wrong, ", mends));
    }
    facts.azimuth_zero = says;
    return fmt::format("azimuth_zero is {}: {}", says, found);
  }
  if (is_clear && *facts.azimuth_zero != says) {
    throw std::invalid_argument(fmt::format("{}: azimuth_zero = {}: expected {}: {}", source,
                                            *facts.azimuth_zero, says, found));
  }
  return {};
}

}  // namespace

std::vector<SkyDirection> patch_directions(const ImportOptions& facts) {
  std::vector<SkyDirection> directions = sampling_directions(Sampling::kTregenza);
  if (facts.patch_order == "rows") return directions;
  bool downward = false;
  for (auto first = directions.begin(); first != directions.end(); downward = !downward) {
    const auto last = std::find_if(first, directions.end(), [&](const SkyDirection& direction) {
      return direction.view_zenith != first->view_zenith;
    });
    if (downward) std::reverse(first, last);
    first = last;
  }
  return directions;
}

Reference patch_reference(const std::string& source, const Unit& unit, ImportOptions facts,
                          std::span<const PatchScan> scans, const std::vector<std::string>& notes) {
  const std::vector<SkyDirection> directions = patch_directions(facts);
  const std::optional<std::string> note =
      settle_azimuth_zero(source, unit, facts, scans, directions);
  std::vector<std::string> all = notes;
  if (note) all.insert(all.begin(), *note);
  return sky_of(source, unit, facts, scans, directions, all);
}

}  // namespace skyfit::refs
