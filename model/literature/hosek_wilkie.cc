// SPDX-License-Identifier: Apache-2.0
#include "model/literature/hosek_wilkie.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/atmosphere/ground_spectrum.h"
#include "model/literature/hosek_wilkie_table.h"

namespace skyfit {
namespace {

constexpr literature::TurbidityDomain kDomain = {"hosek-wilkie", 1, 10, 3e3};

constexpr int kControlPoints = 6;
// [channel][control point]
using Beziers = std::array<std::array<HosekWilkieShapes, kControlPoints>, 3>;

Beziers parsed_table() {
  Beziers beziers{};
  std::istringstream table{std::string(literature::hosek_wilkie_table())};
  std::size_t rows = 0;
  for (std::string line; std::getline(table, line);) {
    if (line.starts_with('#') || line.starts_with("channel")) continue;
    std::ranges::replace(line, ',', ' ');
    std::istringstream fields(line);
    char channel = 0;
    std::size_t albedo = 0, turbidity = 0, control_point = 0;
    fields >> channel >> albedo >> turbidity >> control_point;
    HosekWilkieShape<double>& shape = beziers.at(static_cast<std::size_t>(channel - 'X'))
                                          .at(control_point)
                                          .at(albedo)
                                          .at(turbidity - 1);
    for (double& number : shape) fields >> number;
    if (!fields) throw std::logic_error("the table of hosek-wilkie: " + line);
    ++rows;
  }
  if (rows != 3 * 2 * 10 * kControlPoints)
    throw std::logic_error("the table of hosek-wilkie has other rows");
  return beziers;
}

const Beziers& all_beziers() {
  static const Beziers beziers = parsed_table();
  return beziers;
}

}  // namespace

std::array<HosekWilkieShapes, 3> hosek_wilkie_shapes(double sun_zenith) {
  Shared<double> shared;
  const Beziers& beziers = all_beziers();
  const double elevation = shared.hosek_wilkie_elevation(sun_zenith);
  std::array<HosekWilkieShapes, 3> all{};
  for (std::size_t k = 0; k < kControlPoints; ++k) {
    const double weight = shared.hosek_wilkie_weight(static_cast<int>(k), elevation);
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t ground = 0; ground < 2; ++ground) {
        for (std::size_t t = 0; t < 10; ++t) {
          for (std::size_t i = 0; i < all[c][ground][t].size(); ++i)
            all[c][ground][t][i] += weight * beziers[c][k][ground][t][i];
        }
      }
    }
  }
  return all;
}

SkyValues HosekWilkieModel::radiance(const Atmosphere<double>& atmosphere,
                                     std::span<const WavelengthNode> wavelengths,
                                     std::span<const SkyPoint> points,
                                     std::span<const Parameter> derivatives) const {
  return literature::radiance_of_formula(
      kDomain, spectrum_, atmosphere, wavelengths, points, derivatives,
      []<int N>(const Atmosphere<Dual<N>>& air, const Dual<N>& turbidity) {
        const Dual<N> albedo = ground_albedo_at(air, GroundSpectrum::kWavelengthNm);
        // Neighbouring points have the same sun.
        return [=, sun_zenith = -1.0, shapes = std::array<HosekWilkieShape<Dual<N>>, 3>()](
                   const SkyPoint& point, double from_sun) mutable {
          if (point.sun_zenith != sun_zenith) {
            sun_zenith = point.sun_zenith;
            const std::array<HosekWilkieShapes, 3> all = hosek_wilkie_shapes(sun_zenith);
            for (std::size_t c = 0; c < 3; ++c)
              shapes[c] = hosek_wilkie_shape(all[c], turbidity, albedo);
          }
          std::array<Dual<N>, 3> xyz;
          for (std::size_t c = 0; c < 3; ++c)
            xyz[c] = hosek_wilkie_light(shapes[c], std::cos(point.view_zenith), from_sun);
          return xyz;
        };
      });
}

std::optional<SkyRayTables> HosekWilkieModel::sky_rays(
    const Atmosphere<double>& atmosphere, std::span<const WavelengthNode, 4> nodes) const {
  SkyRayTables rays = literature::rays_of_formula(kDomain, SkyRayMapping::kHosekWilkie, spectrum_,
                                                  atmosphere, nodes);
  const double albedo = ground_albedo_at(atmosphere, GroundSpectrum::kWavelengthNm);
  constexpr int kNumbers = std::tuple_size_v<HosekWilkieShape<double>>;
  rays.air = {kNumbers, kControlPoints, 1, std::vector<float>(4 * kNumbers * kControlPoints)};
  for (std::size_t k = 0; k < kControlPoints; ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      const HosekWilkieShape<double> shape =
          hosek_wilkie_shape(all_beziers()[c][k], rays.formula.turbidity, albedo);
      for (std::size_t i = 0; i < kNumbers; ++i)
        rays.air.rgba[4 * (k * kNumbers + i) + c] = static_cast<float>(shape[i]);
    }
  }
  return rays;
}

bool HosekWilkieModel::can_fit(const Parameter& parameter) const {
  return literature::is_aerosol_amount(parameter) || parameter == Parameter::kGroundAlbedo;
}

}  // namespace skyfit
