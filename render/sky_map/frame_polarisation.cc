// SPDX-License-Identifier: Apache-2.0
#include "render/sky_map/frame_polarisation.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "model/numerics/angles.h"
#include "render/scene/second_light.h"
#include "render/sky_map/light_grid.h"
#include "render/sky_map/sky_map.h"

namespace skyfit {
namespace {

struct LinearLight {
  double i = 0, q = 0, u = 0;  // cd/m^2, U clockwise
};

struct Direction {
  double zenith, azimuth;  // radians, azimuth clockwise from the first sun's
};

struct Sun {
  double zenith, azimuth, share;
  LuminanceRule rule;  // of the first sun's illuminance
};

std::vector<LinearLight> by_rays(const SkyModel& model, const Atmosphere<double>& atmosphere,
                                 double altitude_m, const Sun& sun,
                                 const std::vector<Direction>& directions) {
  const LuminanceRule& rule = sun.rule;
  const double r = atmosphere.bottom_radius_m + altitude_m;
  std::vector<std::size_t> met;  // directions whose rays meet the air
  std::vector<SkyPoint> points;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const auto [zenith, azimuth] = directions[k];
    if (zenith < std::numbers::pi / 2 || r * std::sin(zenith) > atmosphere.top_radius_m) continue;
    met.push_back(k);
    points.push_back({altitude_m, sun.zenith, zenith, sun.azimuth - azimuth});
  }
  std::vector<LinearLight> light(directions.size());
  if (points.empty()) return light;
  const StokesValues stokes = model.stokes(atmosphere, rule.nodes, points, {});
  for (std::size_t p = 0; p < points.size(); ++p) {
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      const int point = static_cast<int>(p), node = static_cast<int>(k);
      light[met[p]].i += rule.weight[k] * stokes.i.at(point, node);
      light[met[p]].q += rule.weight[k] * stokes.q.at(point, node);
      light[met[p]].u += rule.weight[k] * stokes.u.at(point, node);
    }
  }
  return light;
}

std::vector<LinearLight> by_grid(const SkyModel& model, const Atmosphere<double>& atmosphere,
                                 double altitude_m, const Sun& sun,
                                 const std::vector<Direction>& directions) {
  const LuminanceRule& rule = sun.rule;
  const MapChannels channels{{"Y"}, rule.nodes, {{rule.weight.begin(), rule.weight.end()}}, {0}};
  SkyMapOptions options;
  options.altitude_m = altitude_m;
  options.sun_zenith = sun.zenith;
  options.ground = false;
  options.stokes = true;
  const LightGrid grid(model, atmosphere, channels, options);
  std::vector<LinearLight> light;
  std::vector<double> luminance(1);
  for (const auto& [zenith, azimuth] : directions) {
    // The frame's horizon is that of its triangles.
    const double above = std::min(zenith, grid.horizon());
    luminance[0] = 0;
    grid.add(above, azimuth - sun.azimuth, 1, luminance);
    const auto [q, u] = grid.polarisation(above, azimuth - sun.azimuth)[0];
    light.push_back({luminance[0], q * luminance[0], u * luminance[0]});
  }
  return light;
}

}  // namespace

void add_polarisation(const SkyModel& model, const Atmosphere<double>& atmosphere,
                      const LuminanceRule& rule, double altitude_m, const FrameOptions& options,
                      PolarisationAngle angle, Frame& frame) {
  std::vector<std::size_t> pixels;
  std::vector<Direction> directions;
  for (std::size_t i = 0; i < frame.depth_m.size(); ++i) {
    if (std::isfinite(frame.depth_m[i]) || std::isnan(frame.view_zenith_deg[i])) continue;
    pixels.push_back(i);
    directions.push_back({kRadiansPerDegree * double{frame.view_zenith_deg[i]},
                          kRadiansPerDegree * double{frame.view_azimuth_deg[i]}});
  }
  std::vector<Sun> suns = {{options.sun_zenith, 0, 1, rule}};
  if (const auto second = second_light(options))
    suns.push_back({second->zenith, second->azimuth, second->share, second->rule(rule)});
  const bool is_outside = atmosphere.bottom_radius_m + altitude_m > atmosphere.top_radius_m;
  std::vector<LinearLight> sum(pixels.size());
  for (const Sun& sun : suns) {
    const std::vector<LinearLight> light =
        (is_outside ? by_rays : by_grid)(model, atmosphere, altitude_m, sun, directions);
    for (std::size_t k = 0; k < sum.size(); ++k) {
      sum[k].i += sun.share * light[k].i;
      sum[k].q += sun.share * light[k].q;
      sum[k].u += sun.share * light[k].u;
    }
  }
  const std::vector<float> nowhere(frame.depth_m.size(), std::numeric_limits<float>::quiet_NaN());
  FramePolarisation& layers =
      frame.polarisation.emplace(FramePolarisation{nowhere, nowhere, nowhere, nowhere});
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    const double u = sign_of_u(angle) * sum[k].u;
    const LinearPolarisation linear =
        sum[k].i > 0 ? linear_polarisation(sum[k].i, sum[k].q, u) : LinearPolarisation{0, 0};
    layers.q[pixels[k]] = static_cast<float>(sum[k].q);
    layers.u[pixels[k]] = static_cast<float>(u);
    layers.degree[pixels[k]] = static_cast<float>(linear.degree);
    layers.angle_deg[pixels[k]] = linear.degree > 0 ? static_cast<float>(linear.angle_deg) : 0.0F;
  }
}

std::string stokes_convention(PolarisationAngle angle) {
  return fmt::format(
      "meridian plane of the view; Q > 0 along it; U > 0 and aolp (deg) {} from up as the observer "
      "sees it; of diffuse light",
      angle == PolarisationAngle::kIau ? "counter-clockwise" : "clockwise");
}

}  // namespace skyfit
