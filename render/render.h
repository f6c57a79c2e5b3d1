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
#include "model/photometry/second_light.h"
#include "model/tables/table_precision.h"
#include "model/tables/tables.h"
#include "render/color_space.h"
#include "render/frame.h"

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

inline constexpr double kShortestRepeat = 0.01, kLongestRepeat = 1e6;  // m

// A user's own colours and relief of one of the ground's two materials, as pictures of a square of
// the ground, north up. Where there is none, those of the program.
struct OwnMaterial {
  std::filesystem::path color;   // sRGB; its reflectance in the place of the ground's
  std::filesystem::path normal;  // tangent space: red to the east, green to the north, blue up
  // Sides of the square near the eye and far away, in metres.
  double near_m = 4, far_m = 60;
  friend bool operator==(const OwnMaterial&, const OwnMaterial&) = default;
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
  OwnMaterial soil, rock;
  NamedFiles named_files = NamedFiles::kInItsFolder;  // which a mesh may name: its materials
};

// Another sun of the same angular size in the same sky; its irradiance above the air, as the eye
// weights it (illuminance), as a share of the first's.
struct SecondSun {
  double zenith = 1, azimuth = 1;  // azimuth relative to the first
  double irradiance = 0.2;
  // Under its own star (photometry.h), at any irradiance; null: under the first's.
  std::shared_ptr<const SpectralData> spectra = nullptr;
};

// A grey sphere; its centre as seen from the camera. The default is the Earth's moon.
struct Moon {
  double zenith = 1, azimuth = 1;  // azimuth relative to the sun
  double distance_m = kMoonDistance_m, radius_m = kMoonRadius_m;
  double reflectance = 0.12;
  // It lights the scene as a second sun does and is drawn like the suns, a disc with its phase, far
  // beyond all else; the reflectance is then that of the Earth's moon, which depends on the phase
  // (model/photometry/second_light.h).
  bool lights = false;
};

// A thin sheet of white clouds that dims and scatters like a Lambertian surface seen from both
// sides: no scattering inside, no thickness.
struct CloudLayer {
  double altitude_m = 3000;  // above the bottom radius
  double cover = 0.5;        // share of the sky
  double opacity = 0.9;      // of the densest clouds
};
inline constexpr int kMostCloudLayers = 4;

// How the air between the eye and what it sees is evaluated.
enum class AerialPerspective {
  kPerPixel,  // two look-ups of every pixel
  // A volume of 32 x 32 x 16 before the ground, Bodare & Sandberg 2014, 6.4.2. With meshes, a moon
  // or a second sun, in projections, from above 12 km and where ground may rise above the
  // atmosphere, as above.
  kVolume,
};

// Light of the suns' discs that the eye or the camera scatters over the picture.
enum class Glare {
  kNone,
  kEye,  // the CIE's point-spread function of the eye, render/image/glare.h
};

// What the boxes about the blocks of the ground are coloured by.
enum class BlockColors {
  kNone,   // no boxes
  kLevel,  // of drawn blocks, six colours in turn
  // Drawn: green; outside the frustum: red; behind the planet's horizon: blue.
  kCulling,
};

inline constexpr double kLeastLodConstant = 57.6, kLargestLodConstant = 1600;
inline constexpr int kMostLevels = 30;

// How the blocks of the ground, 33 x 33 vertices each, are chosen and shown (Sperlhofer 2011, table
// 4-1).
struct TerrainOptions {
  // A block is split while it is nearer than this many edges of its triangles, 1/32 of its
  // arc; 57.6 to 1600: fewer would leave neighbours more than a level apart. Without one: what
  // FrameOptions::samples_per_quad asks for, and less where it would be too many blocks.
  std::optional<double> lod_constant = {};
  // Of each of the six trees: 1 to 30; without one, as many as show details of 0.3 m.
  std::optional<int> levels = {};
  bool cull = true;  // otherwise the whole planet is drawn
  bool wireframe = false;
  BlockColors boxes = BlockColors::kNone;
  // Whose blocks they are, at the same site, seen from the picture's camera; without one, its own.
  // Without shadows.
  std::optional<Camera> eye = {};
};

// How directions become points of the picture: flat, or as one of map_projections()
// (model/geometry/map_projection.h), which has the same name. Of these, north is the camera's
// azimuth and the zenith above; angular alone is tilted by the camera's zenith angle.
enum class PictureProjection {
  kPerspective,
  kEquirectangular,
  kFisheye,
  kCube,
  kOctahedral,
  kAngular,
};

struct FrameOptions {
  int width = 1280, height = 720;
  PictureProjection projection = PictureProjection::kPerspective;
  // Of fisheye and angular, across the disc: 1 to 360 degrees; without one, 180 and 360.
  std::optional<double> field_of_view = {};
  Camera camera;
  std::optional<Site> site;  // without one: the coast
  double sun_zenith = 0.5;
  int samples_per_side = 2;  // each pixel is the mean of samples_per_side^2 samples: 1 to 4
  AerialPerspective aerial = AerialPerspective::kVolume;
  bool shadows = false;  // of the terrain, under each sun, on ground and in air; of clouds, in air
  double wind_m_s = 5;   // 12.5 m above the sea: how rough it is, 0 to 30
  // Ground, horizon and clouds are seen where air refracts them to, suns' discs there and as flat,
  // in the light of one wavelength, 550 nm. What lights them comes along straight rays.
  bool refraction = false;
  std::optional<SecondSun> second_sun;
  std::optional<Moon> moon;
  std::vector<CloudLayer> clouds;            // of different altitudes, in any order
  bool layers = false;                       // fill Frame::layers
  Glare glare = Glare::kNone;                // fill Frame::glare
  Primaries primaries = Primaries::kRec709;  // of the light in Frame
  double samples_per_quad = 16;  // side of a terrain quad in the picture, in samples: 1 to 64
  TerrainOptions terrain;
};

// Throws std::invalid_argument `render.name = value: must be ...` for the first option out of
// range.
void validate(const FrameOptions& options);
void validate(const Scene& scene);

// The library that reads regions, and its version. Throws std::runtime_error where there is none.
std::string dem_library();

// The files of the program's own textures in a directory (Scene::textures), made where they are
// missing. Throws std::runtime_error that names one that cannot be read or written.
std::vector<std::filesystem::path> texture_files(const std::filesystem::path& directory);

// How far the lowest ground of a scene lies below the bottom radius, >= 0, in metres. Its frames
// want the tables of the atmosphere lowered_by() this depth (model/atmosphere/lowered_ground.h).
double basin_depth_m(const Scene& scene);

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

  // What draws: OpenGL's renderer and version, and the way to it.
  std::string device() const;

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
  // frame before, of this one when there is none. Errors as above, and for a projection.
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

// The automatic exposure, m^2/cd: of a frame by itself, or of frames that are shown alike, of all
// their pixels together.
double metered_exposure(const Frame& frame);
double metered_exposure(std::span<const Frame* const> frames);

// PNG, 8 bit sRGB, dithered, with the frame's glare.
void write_png(const Frame& frame, const std::filesystem::path& file, const ToneOptions& tone = {});

// What a frame of a grid shows, "mie.scattering" and "1e-05 1/m".
struct Caption {
  std::string name, value;
};

inline constexpr int kGridGap = 4;  // black pixels between the frames of a grid

// Frames in rows and columns as one picture, all of one size, kind and primaries.
struct FrameGrid {
  int columns = 1;
  std::vector<Frame> frames;                                  // row by row
  std::vector<std::vector<Caption>> captions;                 // of each frame
  std::vector<ToneOptions> tones;                             // of each frame, with its exposure
  std::vector<std::pair<std::string, std::string>> metadata;  // beside that of the first frame
};

// The frames as one, kGridGap apart; without captions, statistics are not kept. Throws
// std::invalid_argument for frames that do not go together.
Frame joined(const FrameGrid& grid);

// PNG: each frame as write_png() shows it, its captions in a band below it where its width has room
// for text of 8 pixels.
void write_png(const FrameGrid& grid, const std::filesystem::path& file);

}  // namespace skyfit
