// SPDX-License-Identifier: Apache-2.0
// Frames of a planet under a fitted atmosphere, as photometric images. Deferred: a terrain is drawn
// into a G-buffer, and one pass over the picture applies the atmosphere from the tables of
// model/tables.h. OpenGL and the image libraries are loaded by the first call that needs them, not
// by linking this library.
//
// Frame of reference: z up at the camera, x toward the sun's azimuth. Azimuths are relative to the
// sun's, positive to the right of it. Lengths in metres, angles in radians, unless a name says
// otherwise.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/preset.h"
#include "model/tables.h"

namespace skyfit {

struct Camera {
  double altitude_m = 2;     // above the bottom radius, as in SkyPoint
  double view_zenith = 1.4;  // of the picture's centre; pi looks straight down
  double azimuth = 0;        // of the picture's centre, 0 = toward the sun
  double vertical_fov = 1.0;
};

struct NamedView {
  std::string_view name;
  Camera camera;
  double sun_zenith;  // a sun that suits the view
  std::string_view meaning;
};

// The names that find_view accepts: ground, sunset, away, 10km, limb, space.
std::span<const NamedView> named_views();

// Throws std::invalid_argument that lists the known names.
const NamedView& find_view(std::string_view name);

struct FrameOptions {
  int width = 1280, height = 720;
  Camera camera;
  double sun_zenith = 0.5;
  int samples_per_side = 2;   // each pixel is the mean of samples_per_side^2 samples: 1 to 4
  bool keep_gbuffer = false;  // fill Frame::normal and Frame::reflectance
};

// Throws std::invalid_argument `render.name = value: must be ...` for the first option out of
// range.
void validate(const FrameOptions& options);

// Row 0 is the top row; width varies fastest. Luminous quantities are those of the sun at 1 au.
struct Frame {
  int width = 0, height = 0;
  std::vector<float> rgb;  // [pixel][3] linear sRGB primaries, cd/m^2; negative outside the gamut
  std::vector<float> luminance;         // [pixel] cd/m^2
  std::vector<float> view_zenith_deg;   // [pixel] of the pixel's centre
  std::vector<float> view_azimuth_deg;  // [pixel] relative to the sun, -180 .. 180
  std::vector<float>
      depth_m;  // [pixel] nearest distance from the camera along the ray, infinite for sky
  std::vector<float> normal;       // [pixel][3] or empty
  std::vector<float> reflectance;  // [pixel][4] at the nodes of the colour rule, or empty
  std::int64_t triangles = 0;      // drawn into the G-buffer
  std::vector<std::pair<std::string, std::string>>
      metadata;  // preset, sun, camera, version; written with the image
};

// `tables` must come from the preset's atmosphere. Progress in 0..1; may be empty. Throws
// std::invalid_argument for options that validate() refuses and std::runtime_error when there is no
// OpenGL to draw with.
Frame render_frame(const Preset& preset, const AtmosphereTables& tables,
                   const FrameOptions& options, const std::function<void(double)>& progress = {});

// OpenEXR, 32-bit float: R, G, B, luminance.Y, view.zenith_deg, view.azimuth_deg, Z (metres,
// infinite for sky), with Frame::metadata as attributes `skyfit:...` and the chromaticities of
// sRGB. The file appears whole or not at all; throws std::runtime_error that names it.
void write_exr(const Frame& frame, const std::filesystem::path& file);

struct ToneOptions {
  double exposure_stops = 0;  // added to the automatic exposure
};

// PNG, 8 bit sRGB, tone-mapped: exposure from the mean logarithm of the luminance, filmic curve,
// dithered.
void write_png(const Frame& frame, const std::filesystem::path& file, const ToneOptions& tone = {});

}  // namespace skyfit
