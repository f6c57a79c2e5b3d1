// SPDX-License-Identifier: Apache-2.0
#include "data_refs/joint_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "data_refs/civil_time.h"
#include "data_refs/units.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

int scan_count(const Reference& reference) {
  int count = static_cast<int>(reference.scans.size());
  for (const Sample& sample : reference.samples) count = std::max(count, sample.scan + 1);
  return count;
}

constexpr double kSameSun = kRadiansPerDegree;
constexpr std::chrono::milliseconds kSameTime{60'000};

// What is known of a scan, and its suns.
struct Moment {
  std::string name;
  std::optional<Instant> time;
  std::vector<double> suns;  // zenith angles; none of a scan without a sample
};

std::vector<Moment> moments_of(const Reference& reference) {
  std::vector<Moment> moments(static_cast<std::size_t>(scan_count(reference)));
  for (std::size_t s = 0; s < moments.size(); ++s) {
    moments[s].name = fmt::format("scan {}", s + 1);
    if (s >= reference.scans.size()) continue;
    if (!reference.scans[s].name.empty()) moments[s].name = reference.scans[s].name;
    moments[s].time = instant(reference.scans[s].time_utc, 0);
  }
  for (const Sample& sample : reference.samples) {
    std::vector<double>& suns = moments[static_cast<std::size_t>(sample.scan)].suns;
    if (suns.empty() || suns.back() != sample.sun_zenith) suns.push_back(sample.sun_zenith);
  }
  return moments;
}

// Of the nearest of the scan's suns to the one of the irradiances.
double sun_difference(const Moment& scan, const Moment& irradiances) {
  double least = std::numeric_limits<double>::infinity();
  for (const double sun : scan.suns)
    least = std::min(least, std::abs(sun - irradiances.suns.front()));
  return least;
}

std::string angles_text(const Moment& scan, const Moment& irradiances) {
  return fmt::format("the sun of {} is {:.4g} deg from the zenith, that of the irradiances {:.4g}",
                     scan.name, scan.suns.front() * kDegreesPerRadian,
                     irradiances.suns.front() * kDegreesPerRadian);
}

const Moment& nearest_of(const std::vector<Moment>& scans, const Moment& irradiances) {
  return *std::ranges::min_element(
      scans, {}, [&](const Moment& scan) { return sun_difference(scan, irradiances); });
}

// The scan of the sky that irradiances belong to; nothing: none.
std::optional<int> scan_of(const std::vector<Moment>& scans, const Moment& irradiances,
                           const std::string& source) {
  std::optional<int> nearest;
  double least = std::numeric_limits<double>::infinity();  // rad, or ms where there is a time
  for (std::size_t s = 0; s < scans.size(); ++s) {
    if (scans[s].suns.empty()) continue;
    double distance = sun_difference(scans[s], irradiances);
    if (irradiances.time) {
      if (!scans[s].time) continue;
      const auto apart = std::chrono::abs(*scans[s].time - *irradiances.time);
      if (apart > kSameTime) continue;
      if (distance > kSameSun) {
        throw std::invalid_argument(
            fmt::format("{}: {}: {} at the same time: expected within {:g} deg", source,
                        iso_text(*irradiances.time), angles_text(scans[s], irradiances),
                        kSameSun * kDegreesPerRadian));
      }
      distance = static_cast<double>(apart.count());
    }
    if (distance >= least) continue;
    nearest = static_cast<int>(s);
    least = distance;
  }
  if (nearest && !irradiances.time && least > kSameSun) nearest.reset();
  return nearest;
}

Reference joined(Reference sky, const Reference& irradiances, bool own_scans) {
  if (is_irradiance(sky.quantity) || sky.irradiance_quantity)
    throw std::invalid_argument(fmt::format("{}: {}: expected a sky beside irradiances", sky.name,
                                            quantity_name(sky.quantity)));
  if (!is_irradiance(irradiances.quantity))
    throw std::invalid_argument(fmt::format("{}: {}: expected irradiances beside a sky",
                                            irradiances.name, quantity_name(irradiances.quantity)));
  const std::vector<Moment> scans = moments_of(sky), moments = moments_of(irradiances);
  sky.irradiance_quantity = irradiances.quantity;
  sky.scans.resize(scans.size());
  std::map<int, int> place;  // of their scans among those of the sky
  for (int m = 0; m < std::ssize(moments); ++m) {
    const Moment& moment = moments[static_cast<std::size_t>(m)];
    if (moment.suns.empty()) continue;
    const Scan& info = irradiances.scans.at(static_cast<std::size_t>(m));
    if (const std::optional<int> scan = scan_of(scans, moment, irradiances.name)) {
      std::optional<double>& water =
          sky.scans[static_cast<std::size_t>(*scan)].precipitable_water_mm;
      if (water && info.precipitable_water_mm && *water != *info.precipitable_water_mm) {
        throw std::invalid_argument(fmt::format(
            "{}: precipitable_water_mm = {:.6g} and {:.6g} of irradiances that belong to {}: "
            "expected one value",
            irradiances.name, *water, *info.precipitable_water_mm,
            scans[static_cast<std::size_t>(*scan)].name));
      }
      if (!water) water = info.precipitable_water_mm;
      place[m] = *scan;
    } else if (own_scans) {
      if (!moment.time && moments.size() == 1) {
        throw std::invalid_argument(fmt::format(
            "{}: {}: expected within {:g} deg of a scan, or the time of both", irradiances.name,
            angles_text(nearest_of(scans, moment), moment), kSameSun * kDegreesPerRadian));
      }
      place[m] = static_cast<int>(sky.scans.size());
      sky.scans.push_back(info);
    }
  }
  if (place.empty()) {
    throw std::invalid_argument(
        fmt::format("{}: no irradiances are of the minute of a scan of {}: expected those of each "
                    "scan's time",
                    irradiances.name, sky.name));
  }
  for (Sample sample : irradiances.samples) {
    const auto scan = place.find(sample.scan);
    if (scan == place.end()) continue;
    sample.scan = scan->second;
    sky.samples.push_back(std::move(sample));
  }
  sky.description += fmt::format(", with {}", irradiances.description);
  sky.notes.insert(sky.notes.end(), irradiances.notes.begin(), irradiances.notes.end());
  return sky;
}

constexpr std::string_view kAnd = " and ", kMore = " more";

}  // namespace

bool is_joint_name(std::string_view name) {
  return name.ends_with(kMore) && name.find(kAnd) != std::string_view::npos;
}

Reference joint_reference(const std::vector<Reference>& references) {
  if (references.empty()) throw std::invalid_argument("no reference given, expected at least one");
  if (references.size() == 1) return references.front();
  Reference joint;
  joint.name = fmt::format("{}{}{}{}", references.front().name, kAnd, references.size() - 1, kMore);
  joint.description = fmt::format("{} references together", references.size());
  joint.quantity = references.front().quantity;
  joint.transfer = references.front().transfer;
  for (const Reference& reference : references) {
    if (reference.quantity != joint.quantity) {
      throw std::invalid_argument(fmt::format(
          "{}: {}: expected {} as in {}", reference.name, quantity_name(reference.quantity),
          quantity_name(joint.quantity), references.front().name));
    }
    if (reference.transfer != joint.transfer) {
      throw std::invalid_argument(fmt::format("{}: {} transfer: expected {} as in {}",
                                              reference.name, transfer_name(reference.transfer),
                                              transfer_name(joint.transfer),
                                              references.front().name));
    }
    joint.notes.insert(joint.notes.end(), reference.notes.begin(), reference.notes.end());
    const int first = static_cast<int>(joint.scans.size());
    for (Sample sample : reference.samples) {
      sample.scan += first;
      joint.samples.push_back(sample);
    }
    joint.scans.insert(joint.scans.end(), reference.scans.begin(), reference.scans.end());
    joint.scans.resize(static_cast<std::size_t>(first + scan_count(reference)));
  }
  return joint;
}

Reference with_irradiances(Reference sky, const Reference& irradiances) {
  return joined(std::move(sky), irradiances, true);
}

Reference with_irradiances_of_scans(Reference sky, const Reference& irradiances) {
  return joined(std::move(sky), irradiances, false);
}

}  // namespace skyfit::refs
