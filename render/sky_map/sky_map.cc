// SPDX-License-Identifier: Apache-2.0
#include "render/sky_map/sky_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string_view>

#include "model/base/module_file.h"
#include "model/numerics/angles.h"
#include "render/module/module.h"
#include "render/sky_map/light_grid.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSunNear = 15 * kRadiansPerDegree;

Axis axis_of(double zenith, double azimuth) {
  return {std::sin(zenith) * std::sin(azimuth), std::sin(zenith) * std::cos(azimuth),
          std::cos(zenith)};
}

double dot(const Axis& a, const Axis& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Axis cross(const Axis& a, const Axis& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

constexpr std::string_view kLayerNames[] = {"stokes.Q", "stokes.U", "dolp", "aolp"};
constexpr std::size_t kLayers = std::size(kLayerNames);

class MapPainter {
 public:
  MapPainter(const LightGrid& grid, const MapProjection& projection, const SkyMapOptions& options,
             std::size_t channels)
      : grid_(grid),
        projection_(projection),
        options_(options),
        channels_(channels),
        sun_(axis_of(options.sun_zenith, options.sun_azimuth)) {}

  void paint_row(int y, float* out) const {
    std::vector<double> light(channels_);
    for (int x = 0; x < projection_.width(); ++x, out += channels_) {
      std::ranges::fill(light, 0);
      const int parts = parts_of(x, y);
      for (int j = 0; j < parts; ++j) {
        for (int i = 0; i < parts; ++i)
          add(x + (i + 0.5) / parts, y + (j + 0.5) / parts, 1.0 / (parts * parts), light);
      }
      for (std::size_t c = 0; c < channels_; ++c) out[c] = static_cast<float>(light[c]);
    }
  }

  // Of row y, whose light is in `light`, [layer].
  void paint_polarisation(int y, const MapChannels& channels, const float* light,
                          float* out) const {
    for (int x = 0; x < projection_.width(); ++x, light += channels_) {
      const auto d = projection_.direction(x + 0.5, y + 0.5);
      const double zenith = d ? zenith_of(*d) : 0;
      const bool is_seen = d && (options_.ground || zenith <= grid_.horizon());
      const auto q_u = is_seen ? grid_.polarisation(zenith, azimuth_of(*d))
                               : std::vector<std::array<double, 2>>(channels.polarised.size());
      for (std::size_t c = 0; c < q_u.size(); ++c, out += kLayers) {
        const double q = q_u[c][0], u = sign_of_u(options_.angle) * q_u[c][1];
        const double i = static_cast<double>(light[channels.polarised[c]]);
        const LinearPolarisation linear = linear_polarisation(1, q, u);
        out[0] = static_cast<float>(q * i);
        out[1] = static_cast<float>(u * i);
        out[2] = static_cast<float>(linear.degree);
        out[3] = linear.degree > 0 ? static_cast<float>(linear.angle_deg) : 0.0F;
      }
    }
  }

  // Rings of the disc of which each has its limb darkening; every part goes to its pixel.
  void add_disc(const Star& star, const std::vector<double>& irradiance,
                std::vector<float>& pixels) const {
    constexpr int kRings = 64, kAround = 128;
    const auto [u1, u2] = star.limb_darkening;
    const double mean = 1 - u1 / 3 - u2 / 6;
    const Axis pole = std::abs(sun_[2]) < 0.9 ? Axis{0, 0, 1} : Axis{1, 0, 0};
    Axis right = cross(sun_, pole);
    const double length = std::sqrt(dot(right, right));
    for (double& r : right) r /= length;
    const Axis up = cross(right, sun_);
    for (int i = 0; i < kRings; ++i) {
      const double radius = std::sqrt((i + 0.5) / kRings);  // of equal areas
      const double fall = 1 - std::sqrt(1 - radius * radius);
      const double share = (1 - u1 * fall - u2 * fall * fall) / mean / (kRings * kAround);
      const double away = radius * star.angular_radius_rad();
      for (int k = 0; k < kAround; ++k) {
        const double turn = 2 * kPi * (k + 0.5) / kAround;
        Axis d;
        for (std::size_t c = 0; c < 3; ++c)
          d[c] = std::cos(away) * sun_[c] +
                 std::sin(away) * (std::cos(turn) * right[c] + std::sin(turn) * up[c]);
        add_beam(d, share, irradiance, pixels);
      }
    }
  }

 private:
  // Into how many parts a pixel is divided along each side.
  int parts_of(int x, int y) const {
    constexpr int kParts = 4;
    const auto middle = projection_.direction(x + 0.5, y + 0.5);
    if (!middle) return kParts;  // at the rim of a disc
    const auto corner = projection_.direction(x + 0.01, y + 0.01);
    const double size = corner ? std::acos(std::clamp(dot(*middle, *corner), -1.0, 1.0)) : kPi;
    const double from_sun = std::acos(std::clamp(dot(*middle, sun_), -1.0, 1.0));
    const double from_horizon =
        std::abs(std::acos(std::clamp((*middle)[2], -1.0, 1.0)) - grid_.horizon());
    return from_sun < kSunNear + size || from_horizon < 2 * size ? kParts : 1;
  }

  void add(double x, double y, double share, std::vector<double>& light) const {
    const auto d = projection_.direction(x, y);
    if (!d) return;
    const double zenith = zenith_of(*d);
    if (zenith > grid_.horizon() && !options_.ground) return;
    grid_.add(zenith, azimuth_of(*d), share, light);
  }

  static double zenith_of(const Axis& d) { return std::acos(std::clamp(d[2], -1.0, 1.0)); }
  // From the sun's, clockwise from above.
  double azimuth_of(const Axis& d) const { return std::atan2(d[0], d[1]) - options_.sun_azimuth; }

  void add_beam(const Axis& d, double share, const std::vector<double>& irradiance,
                std::vector<float>& pixels) const {
    const auto at = projection_.point(d);
    if (!at) return;
    const int x = std::clamp(static_cast<int>((*at)[0]), 0, projection_.width() - 1),
              y = std::clamp(static_cast<int>((*at)[1]), 0, projection_.height() - 1);
    const double solid_angle = projection_.solid_angle_sr(x, y);
    if (!(solid_angle > 0)) return;
    const std::size_t first = (static_cast<std::size_t>(y) * projection_.width() + x) * channels_;
    for (std::size_t c = 0; c < channels_; ++c)
      pixels[first + c] += static_cast<float>(share * irradiance[c] / solid_angle);
  }

  const LightGrid& grid_;
  const MapProjection& projection_;
  const SkyMapOptions& options_;
  std::size_t channels_;
  Axis sun_;
};

// Of the map on a horizontal plane.
std::vector<double> map_irradiance(const SkyMap& map, const MapProjection& projection) {
  std::vector<double> sum(map.channels.size());
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const auto d = projection.direction(x + 0.5, y + 0.5);
      if (!d || (*d)[2] <= 0) continue;
      const double weight = (*d)[2] * projection.solid_angle_sr(x, y);
      const float* const pixel =
          &map.pixels[(static_cast<std::size_t>(y) * map.width + x) * map.channels.size()];
      for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += weight * static_cast<double>(pixel[c]);
    }
  }
  return sum;
}

std::vector<double> weighted(const MapChannels& channels, const SkyValues& values, int point) {
  std::vector<double> result;
  for (const std::vector<double>& weight : channels.weight) {
    double sum = 0;
    for (std::size_t k = 0; k < weight.size(); ++k)
      sum += weight[k] * values.at(point, static_cast<int>(k));
    result.push_back(std::max(sum, 0.0));
  }
  return result;
}

}  // namespace

MapChannels xyz_channels(const SpectralData& data) {
  const XyzRule rule = xyz_rule(data);
  return {{"X", "Y", "Z"}, rule.nodes, {rule.weight.begin(), rule.weight.end()}, {1}};
}

MapChannels spectral_channels(const SpectralData& data, const std::vector<double>& wavelengths_nm) {
  MapChannels channels{{}, spectral_nodes(data, wavelengths_nm), {}, {}};
  for (std::size_t k = 0; k < wavelengths_nm.size(); ++k) {
    channels.names.push_back(fmt::format("{:g}nm", wavelengths_nm[k]));
    channels.weight.emplace_back(wavelengths_nm.size());
    channels.polarised.push_back(k);
    channels.weight.back()[k] = data.solar_irradiance.at(wavelengths_nm[k]);
  }
  return channels;
}

SkyMap sky_map(const SkyModel& model, const Atmosphere<double>& atmosphere,
               const MapChannels& channels, const MapProjection& projection,
               const SkyMapOptions& options) {
  SkyMap map;
  map.width = projection.width();
  map.height = projection.height();
  map.faces = projection.faces();
  map.channels = channels.names;
  map.is_xyz = channels.names == std::vector<std::string>{"X", "Y", "Z"};
  const std::size_t row = channels.names.size() * static_cast<std::size_t>(map.width);
  map.pixels.resize(row * static_cast<std::size_t>(map.height));
  if (options.stokes) {
    for (const std::size_t c : channels.polarised) {
      for (const std::string_view name : kLayerNames)
        map.layers.push_back(map.is_xyz ? std::string(name)
                                        : fmt::format("{}.{}", name, channels.names[c]));
    }
  }
  const std::size_t layer_row = map.layers.size() * static_cast<std::size_t>(map.width);
  map.layer_values.resize(layer_row * static_cast<std::size_t>(map.height));
  const SkyValues irradiance =
      model.irradiance(atmosphere, channels.nodes, options.altitude_m, options.sun_zenith, {});
  map.direct_normal = weighted(channels, irradiance, kDirectNormal);
  map.diffuse_horizontal = weighted(channels, irradiance, kDiffuseHorizontal);
  const LightGrid grid(model, atmosphere, channels, options);
  const MapPainter painter(grid, projection, options, channels.names.size());
  for (int y = 0; y < map.height; ++y) {
    float* const light = &map.pixels[static_cast<std::size_t>(y) * row];
    painter.paint_row(y, light);
    if (options.stokes) {
      painter.paint_polarisation(y, channels, light,
                                 &map.layer_values[static_cast<std::size_t>(y) * layer_row]);
    }
    options.progress((y + 1.0) / map.height);
  }
  map.map_horizontal = map_irradiance(map, projection);
  if (options.sun_disc) painter.add_disc(atmosphere.star, map.direct_normal, map.pixels);
  return map;
}

void write_sky_map(const SkyMap& map, Primaries primaries, const std::filesystem::path& file) {
  module_named<RenderModule>("skyfit_render_module").write_map(map, primaries, file);
}

}  // namespace skyfit
