// SPDX-License-Identifier: Apache-2.0
// Look-up tables of an atmosphere for real-time rendering: four wavelengths in RGBA (the nodes of a
// ColorRule), values per unit solar irradiance. Mappings: after Bruneton 2017, in
// model/shared/mapping.glsl, shared with the shaders.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "model/atmosphere/atmosphere.h"
#include "model/geometry/sun_disc.h"
#include "model/photometry/photometry.h"
#include "model/tables/diffuse_source.h"
#include "model/tables/height_axis.h"
#include "model/tables/phase_classes.h"
#include "model/tables/sky_rays.h"

namespace skyfit {

// Texels of a table of view rays at one height: rays to the ground and to the sky, suns, azimuths.
struct RayTexels {
  int ground = 0, sky = 0, mu_s = 0, azimuth = 0;
  int rows() const { return ground + sky; }
  std::size_t row() const { return static_cast<std::size_t>(mu_s) * azimuth; }  // texels of one
};

struct TableSizes {
  int optical_depth_mu = 256, optical_depth_r = 128;
  int irradiance_mu_s = 64, irradiance_r = 16;
  int scattering_r = 32, scattering_ground = 22, scattering_sky = 70;  // rays to ground and to sky
  int scattering_mu_s = 64, scattering_azimuth = 24;
  int outside_sky = 100, outside_mu_s = 128, outside_azimuth = 48;  // SkyRayMapping::kFromOutside

  RayTexels scattering() const {
    return {scattering_ground, scattering_sky, scattering_mu_s, scattering_azimuth};
  }
  RayTexels outside() const { return {0, outside_sky, outside_mu_s, outside_azimuth}; }
};

// The least value in the scattering tables, as the argument of the logarithm, 1/km: about
// 2e-4 cd/m^2 over 100 km, as dark as a night without moon.
inline constexpr double kDarkestScattering = 2e-10;

struct AtmosphereTables {
  Atmosphere<double> atmosphere;
  PhaseClasses phases;
  ColorRule color;
  TableSizes sizes;
  HeightAxis heights;   // of all tables
  Table optical_depth;  // x: mu, y: r; from a point to the top of the atmosphere (pure number). Not
                        // the transmittance: that of a finite path is exp(a difference), which does
                        // not lose its digits in thick air. By BrunetonTransmittance::kInHalfFloats
                        // that transmittance, rounded to half floats
  Table irradiance;     // x: mu_s, y: r; diffuse, on a horizontal surface that faces up, per unit
                        // solar irradiance
  // The two scattering tables hold natural logarithms: toward sunset light falls exponentially with
  // the sun's height, which a linear filter then follows. They hold the mean over the ray,
  // amplitude / length in km, because the amplitude of a ray that ends at its beginning is 0. Sun
  // and azimuth are those at the ray's distance_to_sun_point (model/shared/mapping.glsl). 3D
  // textures x: azimuth * mu_s (mu_s fastest), y: mu, z: r; along the whole ray to the top or to
  // the ground:
  Table rayleigh_like;  // single Rayleigh amplitude + multiple scattering / Rayleigh phase function
                        // (sr^0); light that comes straight from the ground to the eye is not in
                        // it: the renderer draws the ground
  Table single;         // single scattering / phase function (pure number) of the other classes of
                        // `phases`, one after the other along z
  Table phase;  // x: scattering angle, from 0 to pi; y: class; logarithm of a tabulated phase
                // function (1/sr). One texel, which is not read, where there is none
  SkyRayTables sky_rays;  // `aerosol`: classes one after the other along z as in `single`
};

// Of the reference's light, at as many heights as their axis asks for and `sizes` state; without
// `heights` at those of the atmosphere's own layers. Progress in 0..1; may be empty.
AtmosphereTables compute_tables(const Atmosphere<double>& atmosphere, const ColorRule& color,
                                const TableSizes& sizes, int threads,
                                const std::function<void(double)>& progress,
                                const TableLight& light = {},
                                const std::optional<HeightAxis>& heights = {});

// Of another model's light, by its scattered_light(); `reference` and `tables` are the above,
// with their transfer.
// Throws what the model throws.
class SkyModel;
AtmosphereTables compute_tables_of(const SkyModel& model, const Atmosphere<double>& atmosphere,
                                   const ColorRule& color, const TableSizes& sizes, int threads,
                                   const std::function<void(double)>& progress,
                                   const std::optional<HeightAxis>& heights = {});

}  // namespace skyfit
