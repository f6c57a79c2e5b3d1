// SPDX-License-Identifier: Apache-2.0
#include "data_refs/sky_bins.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

SkyBins::SkyBins(double bin_deg) {
  constexpr double kTregenza_deg = 12;
  if (bin_deg == kTregenza_deg) {
    add_tregenza_rows(kTregenza_deg * kRadiansPerDegree);
    return;
  }
  const int rows = std::max(1, static_cast<int>(std::lround(90 / bin_deg)));
  const double height = kPi / 2 / rows;
  for (int row = rows - 1; row >= 0; --row) {
    const double middle = (row + 0.5) * height;
    add_row(row * height, (row + 1) * height,
            std::max(1, static_cast<int>(std::lround(2 * kPi * std::sin(middle) / height))));
  }
}

void SkyBins::add_tregenza_rows(double height) {
  const std::vector<SkyDirection> patches = sampling_directions(Sampling::kTregenza);
  for (auto first = patches.begin(); first != patches.end();) {
    const auto last = std::find_if(first, patches.end(), [&](const SkyDirection& patch) {
      return patch.view_zenith != first->view_zenith;
    });
    add_row(std::max(0.0, first->view_zenith - height / 2), first->view_zenith + height / 2,
            static_cast<int>(last - first));
    first = last;
  }
}

void SkyBins::add_row(double low_zenith, double high_zenith, int cells) {
  rows_.push_back({low_zenith, high_zenith, cells, sums_.size()});
  sums_.resize(sums_.size() + static_cast<std::size_t>(cells));
}

std::size_t SkyBins::bin_of(const SkyDirection& direction) const {
  // The first row, from the horizon up, that begins at or below the direction.
  const auto found = std::ranges::find_if(
      rows_, [&](const Row& row) { return row.low_zenith <= direction.view_zenith; });
  const Row& row = found == rows_.end() ? rows_.back() : *found;
  const double turns = direction.relative_azimuth / (2 * kPi) * row.cells;
  const int cell = static_cast<int>(std::lround(turns)) % row.cells;  // centred on north
  return row.first + static_cast<std::size_t>(cell < 0 ? cell + row.cells : cell);
}

void SkyBins::add(const SkyDirection& direction, double solid_angle_sr, double luminance,
                  std::string_view flaw) {
  Sum& sum = sums_[bin_of(direction)];
  if (!flaw.empty()) {
    sum.flaw_sr[std::string(flaw)] += solid_angle_sr;
    return;
  }
  const double horizontal = std::sin(direction.view_zenith) * solid_angle_sr;
  sum.used_sr += solid_angle_sr;
  sum.luminance_sr += luminance * solid_angle_sr;
  sum.east_sr += horizontal * std::sin(direction.relative_azimuth);
  sum.north_sr += horizontal * std::cos(direction.relative_azimuth);
  sum.up_sr += std::cos(direction.view_zenith) * solid_angle_sr;
}

SkyBin SkyBins::bin(const Row& row, int cell) const {
  const std::size_t index = row.first + static_cast<std::size_t>(cell);
  const Sum& sum = sums_[index];
  SkyBin result{static_cast<int>(index) + 1,
                {row.low_zenith == 0 && row.cells == 1 ? 0 : (row.low_zenith + row.high_zenith) / 2,
                 2 * kPi * cell / row.cells},
                0,
                {}};
  double flawed_sr = 0;
  for (const auto& [flaw, sr] : sum.flaw_sr) flawed_sr += sr;
  if (sum.used_sr > 0) {
    result.direction = {std::atan2(std::hypot(sum.east_sr, sum.north_sr), sum.up_sr),
                        std::atan2(sum.east_sr, sum.north_sr)};
    result.luminance = sum.luminance_sr / sum.used_sr;
  }
  if (flawed_sr > 0 && flawed_sr >= sum.used_sr) {
    result.flaw = std::ranges::max_element(sum.flaw_sr, {}, [](const auto& entry) {
                    return entry.second;
                  })->first;
  } else if (sum.used_sr == 0) {
    result.flaw = "no pixels";
  }
  return result;
}

std::vector<SkyBin> SkyBins::result() const {
  std::vector<SkyBin> bins;
  for (const Row& row : rows_) {
    for (int cell = 0; cell < row.cells; ++cell) bins.push_back(bin(row, cell));
  }
  return bins;
}

SkyBin SkyBins::brightest() const {
  const std::vector<SkyBin> bins = result();
  return *std::ranges::max_element(bins, {}, [](const SkyBin& candidate) {
    return candidate.flaw.empty() ? candidate.luminance : 0.0;
  });
}

std::map<std::string, double> SkyBins::shares_not_used() const {
  std::map<std::string, double> shares;
  double all_sr = 0;
  for (const Sum& sum : sums_) {
    all_sr += sum.used_sr;
    for (const auto& [flaw, sr] : sum.flaw_sr) {
      shares[flaw] += sr;
      all_sr += sr;
    }
  }
  for (auto& [flaw, share] : shares) share /= all_sr;
  return shares;
}

}  // namespace skyfit::refs
