// SPDX-License-Identifier: Apache-2.0
#include "fit/exchange/reduction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "data_refs/references.h"
#include "fit/fit.h"
#include "model/base/misfit.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

constexpr double kSuns_deg[] = {10, 30, 50, 70, 80, 85};
constexpr double kExcluded = 3 * kRadiansPerDegree;

std::vector<double> suns() {
  std::vector<double> list;
  for (const double sun : kSuns_deg) list.push_back(sun * kRadiansPerDegree);
  return list;
}

// The directions of a sampled sky, whose values are not used.
refs::Reference sampled() {
  return refs::load_reference("cie:12", suns(), refs::Sampling::kTregenza);
}

std::vector<SkyPoint> points_of(const refs::Reference& reference) {
  std::vector<SkyPoint> points;
  for (const refs::Sample& s : reference.samples)
    points.push_back({0, s.sun_zenith, s.view_zenith, s.relative_azimuth});
  return points;
}

// The sky of the atmosphere at the engine's wavelengths as a reference of spectral radiances.
refs::Reference spectral_reference(const SkyModel& model, const SpectralData& spectra,
                                   const Atmosphere<double>& truth) {
  refs::Reference reference = sampled();
  const std::vector<double> nm(kEngineWavelengths_nm.begin(), kEngineWavelengths_nm.end());
  const SkyValues sky =
      model.radiance(truth, spectral_nodes(spectra, nm), points_of(reference), {});
  const std::vector<refs::Sample> directions = std::move(reference.samples);
  reference.samples.clear();
  reference.quantity = refs::Quantity::kSpectralRadiance;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    for (std::size_t k = 0; k < nm.size(); ++k) {
      refs::Sample s = directions[i];
      s.wavelength_nm = nm[k];
      s.value =
          sky.at(static_cast<int>(i), static_cast<int>(k)) * spectra.solar_irradiance.at(nm[k]);
      reference.samples.push_back(s);
    }
  }
  return reference;
}

// Those that the atmosphere has and a fit may vary from where they are.
std::vector<Parameter> free_within_bounds(const Atmosphere<double>& start,
                                          const std::vector<Parameter>& free) {
  std::vector<Parameter> list;
  for (const Parameter& parameter : free) {
    if (!has_parameter(start, parameter)) continue;
    const double value = get_parameter(start, parameter);
    const ParameterInfo info = parameter_info(parameter);
    if (value >= info.lower && value <= info.upper) list.push_back(parameter);
  }
  return list;
}

double uv_distance(const Xyz& a, const Xyz& b) {
  const auto uv = [](const Xyz& c) {
    const double sum = c[0] + 15 * c[1] + 3 * c[2];
    return std::array{4 * c[0] / sum, 9 * c[1] / sum};
  };
  const auto p = uv(a), q = uv(b);
  return std::hypot(p[0] - q[0], p[1] - q[1]);
}

}  // namespace

std::vector<Xyz> sky_colors(const SkyModel& model, const XyzRule& rule,
                            const Atmosphere<double>& atmosphere,
                            const std::vector<SkyPoint>& points) {
  const SkyValues sky = model.radiance(atmosphere, rule.nodes, points, {});
  std::vector<Xyz> colors;
  for (int i = 0; i < sky.points; ++i) {
    Xyz xyz{};
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < rule.nodes.size(); ++k)
        xyz[c] += rule.weight[c][k] * sky.at(i, static_cast<int>(k));
    }
    colors.push_back(xyz);
  }
  return colors;
}

Xyz irradiance_color(const SkyValues& irradiance, Irradiance which, const XyzRule& rule,
                     const std::vector<double>& factors) {
  Xyz xyz{};
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < rule.nodes.size(); ++k)
      xyz[c] += rule.weight[c][k] * irradiance.at(which, static_cast<int>(k)) * factors[k];
  }
  return xyz;
}

double angle_from_sun(const SkyPoint& p) {
  const double cosine =
      std::cos(p.sun_zenith) * std::cos(p.view_zenith) +
      std::sin(p.sun_zenith) * std::sin(p.view_zenith) * std::cos(p.relative_azimuth);
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

std::vector<SkyPoint> lattice_sky(double sun_zenith) {
  constexpr int kDirections = 400;
  std::vector<SkyPoint> points;
  for (int i = 0; i < kDirections; ++i) {
    // Equal areas of the hemisphere.
    const double zenith = std::acos(1 - (i + 0.5) / kDirections);
    points.push_back(
        {0, sun_zenith, zenith,
         std::remainder(2 * std::numbers::pi * i * std::numbers::phi, 2 * std::numbers::pi)});
  }
  return points;
}

std::vector<SkyPoint> six_skies() { return points_of(sampled()); }

SkyLoss sky_loss(const Models& models, const SpectralData& spectra, const Atmosphere<double>& truth,
                 const Atmosphere<double>& approximate) {
  const XyzRule rule = xyz_rule(spectra);
  const std::vector<SkyPoint> points = six_skies();
  return color_loss(points, sky_colors(models.truth, rule, truth, points),
                    sky_colors(models.engine, rule, approximate, points));
}

SkyLoss color_loss(const std::vector<SkyPoint>& points, const std::vector<Xyz>& a,
                   const std::vector<Xyz>& b) {
  SkyLoss loss;
  double squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (angle_from_sun(points[i]) < kExcluded) continue;
    const double error = std::log(b[i][1] / a[i][1]), uv = uv_distance(a[i], b[i]);
    squares += error * error;
    loss.mean_uv += uv;
    loss.worst_uv = std::max(loss.worst_uv, uv);
    ++count;
    if (100 * std::abs(error) <= std::abs(loss.worst_percent)) continue;
    loss.worst_percent = 100 * error;
    loss.worst = points[i];
  }
  loss.rms_percent = 100 * std::sqrt(squares / count);
  loss.mean_uv /= count;
  return loss;
}

std::string loss_text(const SkyLoss& loss, std::string_view directions) {
  const double factor = std::exp(std::abs(loss.worst_percent) / 100);
  const std::string worst =
      factor > 1.5
          ? fmt::format("{:.2g} times too {}", factor, loss.worst_percent > 0 ? "bright" : "dark")
          : fmt::format("{:+.1f} %", 100 * std::expm1(loss.worst_percent / 100));
  return fmt::format(
      "luminance RMS {}, worst {} (sun {:.0f}, view {:.0f}, azimuth {:.0f} deg); colour "
      "u'v' {:.4f} in the mean, {:.4f} at worst; {}",
      log_misfit_with_unit(loss.rms_percent, 2), worst, loss.worst.sun_zenith * kDegreesPerRadian,
      loss.worst.view_zenith * kDegreesPerRadian,
      std::remainder(loss.worst.relative_azimuth * kDegreesPerRadian, 360), loss.mean_uv,
      loss.worst_uv, directions);
}

Atmosphere<double> refitted(const Models& models, const SpectralData& spectra,
                            const Atmosphere<double>& truth, const Atmosphere<double>& start,
                            const std::vector<Parameter>& free,
                            const std::function<void(double)>& progress) {
  constexpr double kSame = 0.01;  // %
  if (std::abs(sky_loss(models, spectra, truth, start).worst_percent) < kSame) return start;
  FitOptions options;
  options.lobes = 1;
  options.starts = 1;
  options.exclude_sun = kExcluded;
  options.start = Preset{"start", start, nullptr};
  options.free = free_within_bounds(start, free);
  options.use_priors = false;
  options.link = Link::kLog;
  options.scale = Scale::kFixed;
  options.pointing = Pointing::kStated;
  options.progress = [&](double done, const std::string&) { progress(done); };
  return fit_atmosphere(spectral_reference(models.truth, spectra, truth), spectra, models.engine,
                        options)
      .preset.atmosphere;
}

}  // namespace skyfit::fit
