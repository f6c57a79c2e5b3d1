// SPDX-License-Identifier: Apache-2.0
// The light of all directions about an observer as one picture, for other people's renderers: the
// model's radiance, the sun's disc in it or beside it, the ground as the model has it or black.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "model/geometry/map_projection.h"
#include "model/polarisation.h"
#include "model/sky_model.h"
#include "render/color_space.h"

namespace skyfit {

// A quantity is a weighted sum over wavelengths of the model's value per unit solar irradiance.
struct MapChannels {
  std::vector<std::string> names;
  std::vector<WavelengthNode> nodes;
  std::vector<std::vector<double>> weight;  // [channel][node]
  std::vector<std::size_t> polarised;  // channels whose polarisation SkyMapOptions::stokes asks for
};

// X, Y, Z in cd/m^2 (irradiances: lx), by xyz_rule().
MapChannels xyz_channels(const SpectralData& data);
// W m^-2 sr^-1 nm^-1, named "550nm". Throws std::invalid_argument as spectral_nodes() does.
MapChannels spectral_channels(const SpectralData& data, const std::vector<double>& wavelengths_nm);

struct SkyMapOptions {
  double altitude_m = 0;
  double sun_zenith = 0, sun_azimuth = 0;  // radians, azimuth clockwise from north
  bool sun_disc = true;
  bool ground = true;          // else what lies below the horizon is black
  bool level_horizon = false;  // the horizon is at 90 deg at every altitude
  bool stokes = false;         // also the layers of polarisation
  PolarisationAngle angle = PolarisationAngle::kClockwise;
  std::function<void(double)> progress = [](double) {};
};

struct SkyMap {
  int width = 0, height = 0;
  int faces = 1;  // 6: those of the projection cube, side by side
  std::vector<std::string> channels;
  std::vector<float> pixels;  // [pixel][channel], rows from above
  bool is_xyz = false;
  // Polarisation: for each polarised channel stokes.Q and stokes.U in its unit, dolp (0 .. 1) and
  // aolp (degrees), of luminance under these names, of a wavelength with ".550nm" behind them.
  std::vector<std::string> layers;
  std::vector<float> layer_values;  // [pixel][layer]
  std::vector<std::pair<std::string, std::string>> metadata;
  // [channel]: of the beam on a plane that faces the sun; of the sky's diffuse light on a
  // horizontal plane, by the model's own quadrature and as the sum over the map's pixels.
  std::vector<double> direct_normal, diffuse_horizontal, map_horizontal;
};

// Pixels are means over 4 x 4 directions within 15 deg of the sun and at the horizon, else the
// direction of their centres. Light is interpolated between the model's values every half degree in
// zenith angle (a quarter within 12 deg of the sun's, 0.1 within 2 of the horizon) and every degree
// in azimuth (0.25 within 12). The disc has the star's limb darkening and exactly the beam's
// irradiance. Degree and angle of polarisation are those of the diffuse light in the direction of a
// pixel's centre, by (13.15) of docs/theory in the meridian plane of that direction; Q and U are
// those of the pixel's diffuse light with that polarisation. All are 0 where there is no light, or
// nothing polarised. Throws as SkyModel::radiance() does, with `stokes` as SkyModel::stokes().
SkyMap sky_map(const SkyModel& model, const Atmosphere<double>& atmosphere,
               const MapChannels& channels, const MapProjection& projection,
               const SkyMapOptions& options);

// .exr, .npy, or .hdr and .ktx2 of XYZ without layers, whole or not at all; XYZ becomes the
// primaries. .ktx2 is a texture of floats with alpha 1, of six faces a cube map whose +X is east,
// +Y up and +Z north. Throws std::runtime_error that names the file.
void write_sky_map(const SkyMap& map, Primaries primaries, const std::filesystem::path& file);

}  // namespace skyfit
