// SPDX-License-Identifier: Apache-2.0
// Frames of a planet under a fitted atmosphere, as photometric images. Deferred: a terrain is drawn
// into a G-buffer, and one pass over the picture applies the atmosphere from the tables of
// model/tables/tables.h. OpenGL and the image libraries are loaded by the first call that needs
// them, not by linking this library.
//
// Frame of reference: z up at the camera, x toward the sun's azimuth. Azimuths are relative to the
// sun's, positive to the right of it. Lengths in metres, angles in radians, unless a name says
// otherwise.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/atmosphere/preset.h"
#include "model/base/content_cache.h"
#include "model/base/input_file.h"
#include "model/tables/table_precision.h"
#include "model/tables/tables.h"
#include "render/color_space.h"

namespace skyfit {

struct Camera {
  double altitude_m = 2;     // above the bottom radius, as in SkyPoint
  double view_zenith = 1.4;  // of the picture's centre; pi looks straight down
  double azimuth = 0;        // of the picture's centre, 0 = toward the sun
  double vertical_fov = 1.0;
};

// A place on the planet: the sun's azimuth is counted from north over east.
struct Site {
  double latitude = 0, longitude = 0;
  double sun_azimuth = 0;
};

struct NamedView {
  std::string_view name;
  Camera camera;             // its altitude counts from the ground below when there is a site
  double sun_zenith;         // a sun that suits the view
  std::optional<Site> site;  // without one: a coast that every planet has
  std::string_view meaning;
};

// The names that find_view accepts: ground, sunset, away, valley, 10km, orbit, limb, space.
std::span<const NamedView> named_views();

// Throws std::invalid_argument that lists the known names.
const NamedView& find_view(std::string_view name);

// A triangle mesh on the planet: its origin at the place, its y axis up, its -z axis toward the
// heading (from north over east), its unit a metre.
struct PlacedMesh {
  std::filesystem::path file;  // Wavefront OBJ
  double latitude = 0, longitude = 0;
  double altitude_m = 0;  // of the origin, above the bottom radius
  double heading = 0;
  double scale = 1;
  // Where the file names no material, or one that is in no file: Lambert, of every colour.
  double reflectance = 0.3;
};

// Heights of a region: a digital elevation model as GeoTIFF, or as .hgt of SRTM. It lies where its
// georeference says; see render/dem/dem_module.h.
struct RegionalDem {
  std::filesystem::path file;
  int band = 0;       // from 1 on; 0: the only one
  double zero_m = 0;  // where its heights count from, above the bottom radius
};

// What lies around the regions, and where they have no data.
enum class DemSurroundings {
  kPlanet,  // the ground of the planet
  kSea,     // the sea at its level
};

// What stands on the planet and stays there.
struct Scene {
  // Heights of an equirectangular picture (twice as wide as high, north up, its left edge at -180
  // degrees) or of a cube's six faces side by side (+x, -x, +y, -y, +z, -z; +z is the north pole).
  // Its darkest value is lowest_m above the bottom radius, its brightest highest_m; what lies below
  // the water is flat. Without one: a planet of noise.
  std::filesystem::path height_map;
  double lowest_m = 0, highest_m = 9000;
  // sRGB colours of the ground, laid out as the height map; without one: materials by height and
  // slope.
  std::filesystem::path color_map;
  double water_level_m = 0;  // above the bottom radius; a negative one lets the ground lie lower
  // Regions in the ground above. Heights below the water level are the depth of the sea.
  std::vector<RegionalDem> dems;
  DemSurroundings dem_surroundings = DemSurroundings::kPlanet;
  // How far beyond its edge a region reaches, ever lower above its surroundings; without one: a
  // tenth of its shorter side.
  std::optional<double> dem_edge_m;
  std::vector<PlacedMesh> meshes;
  // A directory of the materials' textures; those that are missing are made and saved there. Empty:
  // made and not saved.
  std::filesystem::path textures;
  NamedFiles named_files = NamedFiles::kInItsFolder;  // which a mesh may name: its materials
};

// Another sun of the same colour and angular size in the same sky; its irradiance as a share of the
// first's.
struct SecondSun {
  double zenith = 1, azimuth = 1;  // azimuth relative to the first
  double irradiance = 0.2;
};

// A grey sphere; its centre as seen from the camera. The default is the Earth's moon.
struct Moon {
  double zenith = 1, azimuth = 1;  // azimuth relative to the sun
  double distance_m = 384.4e6, radius_m = 1737.4e3;
  double reflectance = 0.12;
};

// A thin sheet of white clouds that dims and scatters like a Lambertian surface seen from both
// sides: no scattering inside, no thickness.
struct CloudLayer {
  double altitude_m = 3000;  // above the bottom radius
  double cover = 0.5;        // share of the sky
  double opacity = 0.9;      // of the densest clouds
};

// How the air between the eye and what it sees is evaluated.
enum class AerialPerspective {
  kPerPixel,  // two look-ups of every pixel
  // A volume of 32 x 32 x 16 before the ground, Bodare & Sandberg 2014, 6.4.2. With meshes, a moon
  // or a second sun, from above 12 km and where ground may rise above the atmosphere, as above.
  kVolume,
};

// Light of the suns' discs that the eye or the camera scatters over the picture.
enum class Glare {
  kNone,
  kEye,  // the CIE's point-spread function of the eye, render/image/glare.h
};

struct FrameOptions {
  int width = 1280, height = 720;
  Camera camera;
  std::optional<Site> site;  // without one: the coast
  double sun_zenith = 0.5;
  int samples_per_side = 2;  // each pixel is the mean of samples_per_side^2 samples: 1 to 4
  AerialPerspective aerial = AerialPerspective::kVolume;
  bool shadows = false;  // of the terrain, on the ground and in the air
  double wind_m_s = 5;   // 12.5 m above the sea: how rough it is, 0 to 30
  // The suns' discs stand where air refracts them to, and as flat: those of the light of one
  // wavelength, 550 nm, toward which the ground and the sky are drawn as along straight rays.
  bool refraction = false;
  std::optional<SecondSun> second_sun;
  std::optional<Moon> moon;
  std::optional<CloudLayer> clouds;
  bool layers = false;                       // fill Frame::layers
  Glare glare = Glare::kNone;                // fill Frame::glare
  Primaries primaries = Primaries::kRec709;  // of the light in Frame
  double samples_per_quad = 16;  // side of a terrain quad in the picture, in samples: 1 to 64
};

// Throws std::invalid_argument `render.name = value: must be ...` for the first option out of
// range.
void validate(const FrameOptions& options);
void validate(const Scene& scene);

// The library that reads regions, and its version. Throws std::runtime_error where there is none.
std::string dem_library();

// How far the lowest ground of a scene lies below the bottom radius, >= 0, in metres. Its frames
// want the tables of the atmosphere lowered_by() this depth (model/atmosphere/lowered_ground.h).
double basin_depth_m(const Scene& scene);

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
// pixel's centre; NaN where ground or an object is seen, 0 where there is no light.
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
};

struct PassTime {
  std::string pass;
  double milliseconds;
};

struct FrameStatistics {
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

// What a part of a picture shows, "mie.scattering" and "1e-05 1/m"; columns left .. left + width.
struct Caption {
  int left = 0, width = 0;
  std::string name, value;
};

// Row 0 is the top row; width varies fastest. Luminous quantities are those of the sun at 1 au.
struct Frame {
  int width = 0, height = 0;
  int samples_per_side = 0;  // of a pixel, that were drawn; 0: unknown
  Primaries primaries = Primaries::kRec709;
  // [pixel][3] red, green, blue or X, Y, Z, cd/m^2, not negative: light outside the gamut of the
  // primaries is less saturated, of the same luminance and hue
  std::vector<float> rgb;
  std::vector<float> luminance;         // [pixel] cd/m^2
  std::vector<float> view_zenith_deg;   // [pixel] of the pixel's centre
  std::vector<float> view_azimuth_deg;  // [pixel] relative to the sun, -180 .. 180
  std::vector<float>
      depth_m;  // [pixel] nearest distance from the camera along the ray, infinite for sky
  std::vector<DiscPixel> discs;  // in the order of the pixels
  std::vector<float> glare;      // [pixel][3] cd/m^2, or empty; not part of rgb
  std::optional<FrameLayers> layers;
  std::optional<FramePolarisation> polarisation;  // of add_polarisation()
  FrameStatistics statistics;
  std::vector<std::pair<std::string, std::string>>
      metadata;                   // preset, sun, camera, version; written with the image
  std::vector<Caption> captions;  // below the picture in a PNG; other files hold the picture alone
};

// What draws: OSMesa's software or, by EGL, a GPU (or Mesa's software where there is none).
enum class GraphicsDevice { kSoftware, kGpu };

class FrameDrawer;  // of the module, render/module/module.h

// Draws frames of one planet. Belongs to the thread that made it. Not copied: it holds the device's
// memory.
class Renderer {
 public:
  // `cache` keeps the ground and its textures from one process to the next; null: none.
  // Throws std::invalid_argument for a scene that validate() refuses, std::runtime_error that names
  // a file that cannot be read or says that there is no OpenGL to draw with.
  explicit Renderer(const Scene& scene = {}, GraphicsDevice device = GraphicsDevice::kSoftware,
                    std::shared_ptr<ContentCache> cache = nullptr);
  ~Renderer();
  Renderer(Renderer&&) noexcept;

  // The atmosphere of the frames that follow; `tables` must come from the preset's atmosphere,
  // lowered_by() the scene's basin_depth_m().
  // Throws std::invalid_argument when the planet has another radius than before.
  // `precision`: how the tables of scattered light are kept.
  void set_atmosphere(const Preset& preset, const AtmosphereTables& tables,
                      TablePrecision precision = TablePrecision::kFloat);

  // What of a frame needs no tables, for while they are computed; set_atmosphere() and draw() do it
  // where it was not done: the ground of an atmosphere, lowered_by() as its tables, and the blocks
  // of it that a frame sees. Throws as they do; a camera below the ground prepares nothing.
  void set_ground(const Atmosphere<double>& atmosphere, const ColorRule& color);
  void prepare(const FrameOptions& options);

  // What of the scene could not be drawn as its files ask for, a line each: materials of meshes
  // that are in no file. Known with the ground.
  std::vector<std::string> warnings() const;

  // Height of the ground above the bottom radius, in metres, at a place or at the coast. Needs an
  // atmosphere or a ground, which know the radius.
  double ground_height_m(const std::optional<Site>& site) const;

  // Progress in 0..1; may be empty. Throws std::invalid_argument for options that validate()
  // refuses, for a camera below the ground, and for a camera or a sun that the tables' model does
  // not know (SkyRayTables::limits).
  Frame draw(const FrameOptions& options, const std::function<void(double)>& progress = {});

  // The same for frames that are shown one after another on the device. Waits for the frame before,
  // not for this one, which is drawn while the next is prepared. The statistics are those of the
  // frame before, of this one when there is none. Errors as above.
  FrameStatistics submit(const FrameOptions& options);
  // For the last of these frames, whose statistics it returns; throws std::logic_error when nothing
  // has been drawn since the last draw().
  FrameStatistics wait();

 private:
  bool is_above_ground(const FrameOptions& options) const;
  FrameOptions raised(const FrameOptions& options) const;
  FrameOptions above_lowest_ground(const FrameOptions& options) const;

  std::unique_ptr<FrameDrawer> drawer_;
  double basin_depth_m_;
  std::optional<DaylightLimits> limits_;  // of the tables
  std::string preset_;                    // as JSON
};

// One frame of a planet of noise.
Frame render_frame(const Preset& preset, const AtmosphereTables& tables,
                   const FrameOptions& options, const std::function<void(double)>& progress = {});

// OpenEXR, 32-bit float: R, G, B, luminance.Y, view.zenith_deg, view.azimuth_deg, Z (metres,
// infinite for sky) and, where the frame has layers, inscatter.R, .G, .B, reflected.R, .G, .B,
// direct.R, .G, .B, transmittance.R, .G, .B, normal.X, .Y, .Z, albedo.R, .G, .B, and where it has
// its polarisation stokes.Q, stokes.U, dolp, aolp; with
// Frame::metadata as attributes `skyfit:...` and the chromaticities of the primaries. R, G, B hold
// X, Y, Z where these are the primaries. The file appears whole or not at all; throws
// std::runtime_error that names it.
void write_exr(const Frame& frame, const std::filesystem::path& file);

// R, G and B in the frame's primaries (cd/m^2), height x width x 3, for NumPy.
void write_npy(const Frame& frame, const std::filesystem::path& file);

enum class ToneCurve {
  kFilmic,       // a fit of the ACES film curve, Narkowicz 2015
  kExponential,  // 1 - exp(-k L), Sperlhofer 2011
  kClip,         // k L, cut off at 1: a display without a curve
};

// How a tone curve, and the display's range, apply to colours.
enum class ViewTransform {
  kHue,       // the curve to the luminance; the hue in Oklab stays, render/image/gamut.h
  kChannels,  // the curve to each channel, which is clipped by itself
};

struct ToneOptions {
  double exposure_stops = 0;       // added to the automatic exposure, or to `exposure`
  std::optional<double> exposure;  // k, m^2/cd; without one: from the mean logarithm of the
                                   // luminance, within limits
  ToneCurve curve = ToneCurve::kFilmic;
  ViewTransform transform = ViewTransform::kHue;
};

// The automatic exposure of a frame by itself, m^2/cd.
double metered_exposure(const Frame& frame);

// PNG, 8 bit sRGB, dithered, with the frame's glare.
void write_png(const Frame& frame, const std::filesystem::path& file, const ToneOptions& tone = {});

}  // namespace skyfit
