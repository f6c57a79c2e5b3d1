// SPDX-License-Identifier: Apache-2.0
#include "render/plot/suns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace skyfit::plot {
namespace {

constexpr double kSameSunDeg = 1e-6;      // angles that went through radians and back
constexpr double kSameAzimuthDeg = 0.01;  // of a sample written with four digits

double azimuth_from_sun_deg(const Sample& sample) {
  return std::abs(std::remainder(sample.relative_azimuth_deg, 360.0));
}

std::vector<double> sun_zeniths(const Comparison& comparison) {
  std::set<double> all;
  for (const auto& curve : comparison.curves)
    for (const auto* list : {&curve.plane, &curve.hemisphere})
      for (const auto& sample : *list) all.insert(sample.sun_zenith_deg);
  std::vector<double> distinct;
  for (const double zenith : all)
    if (distinct.empty() || zenith - distinct.back() > kSameSunDeg) distinct.push_back(zenith);
  return distinct;
}

std::vector<double> evenly_chosen(const std::vector<double>& all, std::size_t count) {
  if (all.size() <= count) return all;
  std::vector<double> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(all[i * (all.size() - 1) / (count - 1)]);
  return chosen;
}

std::vector<Sample> of_sun(const std::vector<Sample>& samples, double sun_zenith_deg,
                           bool plane_only) {
  std::vector<Sample> chosen;
  std::ranges::copy_if(samples, std::back_inserter(chosen), [&](const Sample& sample) {
    return std::abs(sample.sun_zenith_deg - sun_zenith_deg) <= kSameSunDeg &&
           (!plane_only || in_principal_plane(sample));
  });
  if (plane_only) std::ranges::stable_sort(chosen, {}, signed_view_zenith_deg);
  return chosen;
}

void check_sample(const std::string& label, const Sample& sample) {
  const auto check = [&](const char* field, double value) {
    if (!std::isfinite(value) || value <= 0)
      throw std::invalid_argument(
          fmt::format("figure: {} = {} in \"{}\" at sun zenith {:.9g}, view zenith {:.9g}, azimuth "
                      "{:.9g} deg: expected a number > 0",
                      field, value, label, sample.sun_zenith_deg, sample.view_zenith_deg,
                      sample.relative_azimuth_deg));
  };
  check("reference", sample.reference);
  check("model", sample.model);
  if (!std::isnan(sample.start_model)) check("start_model", sample.start_model);
}

}  // namespace

bool in_principal_plane(const Sample& sample) {
  const double azimuth = azimuth_from_sun_deg(sample);
  return std::abs(sample.view_zenith_deg) < kSameAzimuthDeg || azimuth < kSameAzimuthDeg ||
         180 - azimuth < kSameAzimuthDeg;
}

double signed_view_zenith_deg(const Sample& sample) {
  return azimuth_from_sun_deg(sample) > 90 ? -sample.view_zenith_deg : sample.view_zenith_deg;
}

std::vector<Sample> plane_samples(const Curve& curve) {
  std::vector<Sample> chosen;
  std::ranges::copy_if(curve.plane, std::back_inserter(chosen), in_principal_plane);
  return chosen;
}

void validate(const Comparison& comparison) {
  if (comparison.curves.empty() || comparison.curves.size() > kMaxCurves)
    throw std::invalid_argument(
        fmt::format("figure: {} curves: expected 1 to {}", comparison.curves.size(), kMaxCurves));
  for (const auto& curve : comparison.curves) {
    if (curve.plane.empty() && curve.hemisphere.empty())
      throw std::invalid_argument(
          fmt::format("figure: curve \"{}\": expected at least one sample", curve.label));
    for (const auto* list : {&curve.plane, &curve.hemisphere})
      for (const auto& sample : *list) check_sample(curve.label, sample);
  }
}

Suns samples_by_sun(const Comparison& comparison) {
  const auto zeniths = sun_zeniths(comparison);
  Suns suns;
  suns.total = zeniths.size();
  for (const double zenith : evenly_chosen(zeniths, kMaxPanels)) {
    SunSamples sun{zenith, {}, {}};
    for (const auto& curve : comparison.curves) {
      sun.plane.push_back(of_sun(curve.plane, zenith, true));
      sun.hemisphere.push_back(of_sun(curve.hemisphere, zenith, false));
      suns.has_hemisphere |= !sun.hemisphere.back().empty();
    }
    suns.shown.push_back(std::move(sun));
  }
  return suns;
}

std::vector<SunPanel> sun_panels(const Comparison& comparison) {
  std::vector<SunPanel> panels;
  for (const auto& sun : samples_by_sun(comparison).shown) {
    SunPanel panel{sun.sun_zenith_deg, {}, {}};
    for (const auto& plane : sun.plane) panel.rms_plane_percent.push_back(rms_log_percent(plane));
    for (const auto& sky : sun.hemisphere)
      panel.rms_hemisphere_percent.push_back(rms_log_percent(sky));
    panels.push_back(std::move(panel));
  }
  return panels;
}

}  // namespace skyfit::plot
