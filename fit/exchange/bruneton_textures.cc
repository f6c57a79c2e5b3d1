// SPDX-License-Identifier: Apache-2.0
#include "fit/exchange/bruneton_textures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/shared/shared.h"
#include "model/tables/table_lookup.h"
#include "model/tables/tables.h"

namespace skyfit::fit {
namespace {

// The mappings of functions.glsl, from texels to what they stand for. `unit` is 0 at the middle of
// the first texel and 1 at that of the last.
class Mapping {
 public:
  Mapping(double bottom, double top, double highest_sun)
      : bottom_(bottom),
        top_(top),
        horizon_(std::sqrt(top * top - bottom * bottom)),
        lowest_mu_s_(std::cos(highest_sun)) {}

  struct Ray {
    double r, mu;
    bool hits_ground = false;
  };

  Ray of_transmittance(double unit_mu, double unit_r) const {
    const Ray at = at_height(unit_r);
    return upward(at.r, unit_mu);
  }

  // Rays to the ground in the lower half of the texels, from the horizon down to the nadir.
  Ray of_scattering(int row, int rows, double unit_r) const {
    const Ray at = at_height(unit_r);
    const int half = rows / 2;
    if (row >= half) return upward(at.r, unit(row - half, half));
    const double rho = std::sqrt(std::max(at.r * at.r - bottom_ * bottom_, 0.0));
    const double d = std::lerp(at.r - bottom_, rho, unit(half - 1 - row, half));
    const double mu = d > 0 ? -(rho * rho + d * d) / (2 * at.r * d) : -1;
    return {at.r, std::clamp(mu, -1.0, 1.0), true};
  }

  double mu_s(double unit_mu_s) const {
    const double shortest = top_ - bottom_;
    const auto share = [&](double distance) {
      return (distance - shortest) / (horizon_ - shortest);
    };
    const double lowest =
        share(-bottom_ * lowest_mu_s_ +
              std::sqrt(std::max(
                  bottom_ * bottom_ * (lowest_mu_s_ * lowest_mu_s_ - 1) + top_ * top_, 0.0)));
    const double a = lowest * (1 - unit_mu_s) / (1 + unit_mu_s * lowest),
                 d = shortest + std::min(a, lowest) * (horizon_ - shortest);
    return std::clamp((horizon_ * horizon_ - d * d) / (2 * bottom_ * d), -1.0, 1.0);
  }

  double height(double unit_r) const { return std::lerp(0.0, top_ - bottom_, unit_r); }

  static double unit(int texel, int size) { return static_cast<double>(texel) / (size - 1); }

 private:
  Ray at_height(double unit_r) const {
    const double rho = horizon_ * unit_r;
    return {std::sqrt(rho * rho + bottom_ * bottom_), 0};
  }
  Ray upward(double r, double unit_mu) const {
    const double rho = std::sqrt(std::max(r * r - bottom_ * bottom_, 0.0)),
                 d = std::lerp(top_ - r, rho + horizon_, unit_mu),
                 mu = d > 0 ? (horizon_ * horizon_ - rho * rho - d * d) / (2 * r * d) : 1;
    return {r, std::clamp(mu, -1.0, 1.0)};
  }

  double bottom_, top_, horizon_, lowest_mu_s_;
};

void put(const NodeValues& values, const Rgb& factor, std::size_t texel, std::vector<float>& out) {
  for (std::size_t k = 0; k < 3; ++k)
    out[4 * texel + k] = static_cast<float>(factor[k] * values[k]);
}

std::vector<float> texels(int width, int height, int depth = 1) {
  return std::vector<float>(4 * static_cast<std::size_t>(width) * height * depth);
}

}  // namespace

Rgb engine_solar_irradiance(const SpectralData& spectra) {
  Rgb values;
  for (std::size_t k = 0; k < 3; ++k)
    values[k] = spectra.solar_irradiance.at(kEngineWavelengths_nm[k]);
  return values;
}

BrunetonTextures bruneton_textures(const EngineAtmosphere& engine, const Star& star,
                                   const SpectralData& spectra, double highest_sun,
                                   const BrunetonSizes& sizes, int threads,
                                   const std::function<void(double)>& progress) {
  Atmosphere<double> atmosphere = atmosphere_of(engine);
  atmosphere.star = star;
  ColorRule color{};  // its colours are not asked for
  for (std::size_t k = 0; k < 4; ++k)
    color.nodes[k] = node_at(spectra, kEngineWavelengths_nm[std::min<std::size_t>(k, 2)]);
  const AtmosphereTables tables =
      compute_tables(atmosphere, color, {}, threads, progress, {Transfer::kScalar, 0});
  const double bottom = atmosphere.bottom_radius_m, top = atmosphere.top_radius_m;
  const Mapping mapping(bottom, top, highest_sun);
  const Rgb sun = engine_solar_irradiance(spectra);
  BrunetonTextures made;

  made.transmittance = texels(sizes.transmittance_mu, sizes.transmittance_r);
  for (int j = 0, texel = 0; j < sizes.transmittance_r; ++j) {
    for (int i = 0; i < sizes.transmittance_mu; ++i, ++texel) {
      const Mapping::Ray ray = mapping.of_transmittance(Mapping::unit(i, sizes.transmittance_mu),
                                                        Mapping::unit(j, sizes.transmittance_r));
      NodeValues through = lookup_optical_depth(tables, ray.r - bottom, ray.mu);
      for (double& value : through) value = std::exp(-value);
      put(through, {1, 1, 1}, static_cast<std::size_t>(texel), made.transmittance);
    }
  }
  made.irradiance = texels(sizes.irradiance_mu_s, sizes.irradiance_r);
  for (int j = 0, texel = 0; j < sizes.irradiance_r; ++j) {
    for (int i = 0; i < sizes.irradiance_mu_s; ++i, ++texel) {
      const double mu_s = std::lerp(-1.0, 1.0, Mapping::unit(i, sizes.irradiance_mu_s));
      put(lookup_irradiance(tables, mapping.height(Mapping::unit(j, sizes.irradiance_r)), mu_s),
          sun, static_cast<std::size_t>(texel), made.irradiance);
    }
  }
  const int width = sizes.scattering_nu * sizes.scattering_mu_s;
  made.scattering = texels(width, sizes.scattering_mu, sizes.scattering_r);
  made.single_mie = made.scattering;
  tbb::parallel_for(0, sizes.scattering_r, [&](int k) {
    Shared<double> shared;
    for (int j = 0; j < sizes.scattering_mu; ++j) {
      const Mapping::Ray ray =
          mapping.of_scattering(j, sizes.scattering_mu, Mapping::unit(k, sizes.scattering_r));
      for (int i = 0; i < width; ++i) {
        const double mu_s =
            mapping.mu_s(Mapping::unit(i % sizes.scattering_mu_s, sizes.scattering_mu_s));
        const double middle = ray.mu * mu_s,
                     reach = std::sqrt((1 - ray.mu * ray.mu) * (1 - mu_s * mu_s));
        const double nu =
            std::clamp(2 * Mapping::unit(i / sizes.scattering_mu_s, sizes.scattering_nu) - 1,
                       middle - reach, middle + reach);
        const std::vector<NodeValues> parts =
            lookup_amplitudes(tables, {ray.r - bottom, ray.mu, mu_s}, nu, ray.hits_ground);
        const double phase = shared.rayleigh_phase(tables.phases.depolarisation, nu) /
                             (3 / (16 * std::numbers::pi) * (1 + nu * nu));
        const std::size_t texel =
            (static_cast<std::size_t>(k) * sizes.scattering_mu + j) * width + i;
        put(parts[0], {phase * sun[0], phase * sun[1], phase * sun[2]}, texel, made.scattering);
        if (parts.size() > 1) put(parts[1], sun, texel, made.single_mie);
        made.scattering[4 * texel + 3] = made.single_mie[4 * texel];
      }
    }
  });
  return made;
}

}  // namespace skyfit::fit
