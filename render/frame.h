// SPDX-License-Identifier: Apache-2.0
// A frame as a photometric image: what its pixels hold and how it was made. The frame of reference
// is that of render.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/color_space.h"

namespace skyfit {

// What the picture is made of, each [pixel][3], in Frame::primaries and not negative, as Frame::rgb
// is. Light of the air and reflected light add up to the picture's, by their luminance alone where
// one of them has been brought into the gamut.
struct FrameLayers {
  std::vector<float>
      in_scatter;  // cd/m^2: of the air between the eye and what it sees, or of the sky
  std::vector<float> reflected;  // cd/m^2: of ground, objects and clouds, as it arrives at the eye
  std::vector<float>
      direct;  // cd/m^2: the part of it that is the suns' beams', reflected or from their discs
  std::vector<float> transmittance;  // of sunlight, from what is seen to the eye; of sky: to space
  std::vector<float> normal;         // camera frame; 0 for sky
  std::vector<float> albedo;         // of sunlight; 0 for sky
};

// Linear polarisation of the sky's diffuse light, [pixel], luminance in the meridian plane of the
// pixel's centre; NaN where ground, an object or nothing is seen, 0 where there is no light.
struct FramePolarisation {
  std::vector<float> q, u;       // cd/m^2
  std::vector<float> degree;     // 0 .. 1
  std::vector<float> angle_deg;  // above -90 to 90
};

// The part of a pixel that suns' discs cover. A display shows it apart from the rest of the pixel:
// the mean of the sky and of a disc a million times brighter is as white as the disc.
struct DiscPixel {
  std::size_t pixel;
  float cover;               // share of the pixel, above 0
  std::array<float, 3> rgb;  // cd/m^2: the discs' part of Frame::rgb
  float luminance;           // cd/m^2: of Frame::luminance
  float solid_angle_sr = 0;  // of the pixel
};

// A pixel on the line between sky and ground. A display shows its parts apart, as those of a
// DiscPixel: the mean of the ground and of a sky that is much brighter is as bright as the sky.
struct EdgePixel {
  std::size_t pixel;
  float sky_share;                   // 0 .. 1
  std::array<float, 3> sky, ground;  // cd/m^2, of each by itself, as Frame::rgb
};

struct PassTime {
  std::string pass;
  double milliseconds;
};

struct FrameStatistics {
  std::string device = {};     // what drew: OpenGL's renderer and version, and the way to it
  std::int64_t triangles = 0;  // drawn into the G-buffer
  int blocks_drawn = 0;
  // Culled nodes of the tree: outside the frustum, behind the planet's horizon.
  int blocks_outside = 0, blocks_behind = 0;
  int blocks_hidden = 0;  // every patch of theirs outside the frustum or behind nearer ground
  int blocks_made = 0;    // that no earlier frame had, by this frame or its prepare()
  std::vector<PassTime> passes;  // by the device's timers
  double milliseconds = 0;       // from the frame's begin to its end, reading back not counted
  // Of Renderer::draw(), by the wall clock, one after the other: "ground" until all is chosen that
  // is seen, "passes" until the device has drawn, "pixels" until they are in Frame.
  std::vector<PassTime> steps = {};
};

// Row 0 is the top row; width varies fastest. Luminous quantities are those of the sun at 1 au.
struct Frame {
  int width = 0, height = 0;
  Primaries primaries = Primaries::kRec709;
  // [pixel][3] red, green, blue or X, Y, Z, cd/m^2, not negative: light outside the gamut of the
  // primaries is less saturated, of the same luminance and hue
  std::vector<float> rgb;
  std::vector<float> luminance;  // [pixel] cd/m^2
  // [pixel] of the pixel's centre; azimuths relative to the sun, -180 .. 180. Not a number where a
  // projection shows nothing; there is no light then.
  std::vector<float> view_zenith_deg, view_azimuth_deg;
  // [pixel] nearest distance from the camera along the ray, infinite for sky and for nothing
  std::vector<float> depth_m;
  std::vector<DiscPixel> discs;  // in the order of the pixels
  std::vector<EdgePixel> edges;  // in the order of the pixels
  std::vector<float> glare;      // [pixel][3] cd/m^2, or empty; not part of rgb
  std::optional<FrameLayers> layers;
  std::optional<FramePolarisation> polarisation;  // of add_polarisation()
  FrameStatistics statistics;
  std::vector<std::pair<std::string, std::string>>
      metadata;  // preset, sun, camera, version; written with the image
};

}  // namespace skyfit
