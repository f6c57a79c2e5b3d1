// SPDX-License-Identifier: Apache-2.0
// What the options of `skyfit render` ask for: the sun of a day, the frames of a day, headings.
#include "cli/render_request.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <set>

#include "cli/arguments.h"
#include "cli/frame_store.h"
#include "cli/grid_request.h"
#include "cli/render_arguments.h"
#include "cli/render_session.h"
#include "model/atmosphere/preset.h"
#include "model/base/temporary_directory.h"
#include "render/features/render_features.h"

namespace skyfit::cli {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

template <class Request>
Request parsed(Request (*request)(const RenderOptions&, const CLI::App&),
               std::vector<std::string> arguments) {
  CLI::App app;
  RenderOptions options;
  add_render_options(app, options);
  arguments.insert(arguments.end(), {"--preset", "earth-clear"});
  std::ranges::reverse(arguments);  // as CLI11 wants them
  app.parse(arguments);
  return request(options, app);
}

RenderRequest request(const std::vector<std::string>& arguments) {
  return parsed(render_request, arguments);
}

GridRequest grid_of(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--out", "x.png"});
  return parsed(grid_request, arguments);
}

std::vector<std::string> at_zurich(std::vector<std::string> more) {
  more.insert(more.end(), {"--latitude-deg", "47.4", "--longitude-deg", "8.5"});
  return more;
}

// At the solstice the sun culminates at 90 - latitude + 23.44 degrees, in the south.
TEST(RenderRequest, TheSunOfADay) {
  const RenderRequest r = request(at_zurich(
      {"--date", "2026-06-21", "--time", "13:28", "--utc-offset-h", "2", "--out", "x.png"}));
  const Shot shot = shot_at(r.sequence, 0, sun_over);
  EXPECT_NEAR(shot.sun.zenith / kDegree, 47.4 - 23.44, 0.02);
  EXPECT_NEAR(shot.sun.azimuth / kDegree, 180, 1);
  EXPECT_TRUE(shot.camera.above_ground);
  EXPECT_FALSE(r.is_sequence);
}

// The named views stand above sea level, a map of mountains does not lie there.
TEST(RenderRequest, OnAMapTheCameraStandsAboveTheGround) {
  const TemporaryDirectory folder;
  const std::string map = (folder.path() / "a.tif").string();
  std::ofstream(map) << "heights";
  const auto camera = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--dem", map, "--out", "x.png"});
    return shot_at(request(more).sequence, 0, sun_over).camera;
  };
  EXPECT_TRUE(camera({}).above_ground);
  EXPECT_FALSE(camera({"--altitude-m", "3000"}).above_ground);
}

TEST(RenderRequest, ADayIsAFilmOfTenSecondsFromAStandingCamera) {
  const RenderRequest r = request(at_zurich(
      {"--date", "2026-06-21", "--time", "05:00..21:00", "--view", "ground", "--out-dir", "x"}));
  EXPECT_TRUE(r.is_sequence);
  EXPECT_EQ(r.sequence.frames, 240);
  ASSERT_EQ(r.sequence.keyframes.size(), 2u);
  EXPECT_EQ(*r.sequence.keyframes[1].sun.time - *r.sequence.keyframes[0].sun.time,
            std::chrono::hours(16));
  EXPECT_NEAR(r.sequence.keyframes[1].time_s, r.sequence.time_s(239), 1e-12);
  const Shot first = shot_at(r.sequence, 0, sun_over), last = shot_at(r.sequence, 9, sun_over);
  EXPECT_TRUE(first.camera.from_north);
  EXPECT_EQ(first.camera.azimuth, last.camera.azimuth);
  EXPECT_NEAR(first.camera.azimuth, first.sun.azimuth, 1e-12);  // toward the sun at first
}

TEST(RenderRequest, PolarisationIsThatOfTheReferenceInAnExr) {
  EXPECT_EQ(request({"--stokes", "--out", "x.exr"}).stokes, PolarisationAngle::kClockwise);
  EXPECT_EQ(request({"--stokes", "--iau", "--out", "x.exr"}).stokes, PolarisationAngle::kIau);
  EXPECT_FALSE(request({"--out", "x.exr"}).stokes);
  EXPECT_THROW(request({"--stokes", "--out", "x.png"}), UsageError);
  for (const auto& [option, value] :
       {std::pair("--model", "bruneton"), {"--clouds", "0.4"}, {"--orders", "2"}})
    EXPECT_THROW(request({"--stokes", option, value, "--out", "x.exr"}), UsageError) << option;
}

TEST(RenderRequest, TablesByTheirNames) {
  const RenderRequest r =
      request({"--out", "x.png", "--table-size", "small", "--table-precision", "8bit"});
  EXPECT_EQ(r.table_precision, TablePrecision::k8Bit);
  EXPECT_LT(r.table_sizes.scattering_mu_s, TableSizes{}.scattering_mu_s);
  EXPECT_EQ(request({"--out", "x.png"}).table_sizes.scattering_mu_s, TableSizes{}.scattering_mu_s);
  EXPECT_THROW(request({"--out", "x.png", "--table-size", "huge"}), UsageError);
}

TEST(RenderRequest, StepsAndFramesOfADay) {
  const RenderRequest steps = request(at_zurich(
      {"--date", "2026-06-21", "--time", "22:00..01:10", "--step-min", "30", "--out-dir", "x"}));
  EXPECT_EQ(steps.sequence.frames, 7);  // past midnight: 22:00, 22:30 .. 01:00
  EXPECT_EQ(*steps.sequence.keyframes[1].sun.time - *steps.sequence.keyframes[0].sun.time,
            std::chrono::hours(3));
  const RenderRequest frames = request(at_zurich(
      {"--date", "2026-06-21", "--time", "10:00..14:00", "--frames", "5", "--out-dir", "x"}));
  EXPECT_EQ(frames.sequence.frames, 5);
  const RenderRequest one = request(at_zurich(
      {"--date", "2026-06-21", "--time", "10:00..14:00", "--frames", "1", "--out-dir", "x"}));
  EXPECT_EQ(one.sequence.keyframes.size(), 1u);
}

TEST(RenderRequest, SceneOptions) {
  const RenderRequest r =
      request({"--moon", "60,-20", "--second-sun", "70,90,0.5", "--clouds", "0.3,2500", "--shadows",
               "--aerial", "pixel", "--gpu", "--layers", "--out", "x.exr", "--tone", "exponential",
               "--exposure", "1e-4"});
  EXPECT_NEAR(r.frame.moon->azimuth, -20 * kDegree, 1e-12);
  EXPECT_EQ(r.frame.second_sun->irradiance, 0.5);
  EXPECT_EQ(r.frame.clouds[0].altitude_m, 2500);
  EXPECT_EQ(r.frame.clouds[0].opacity, CloudLayer{}.opacity);
  EXPECT_TRUE(r.frame.shadows && r.frame.layers);
  EXPECT_EQ(r.frame.aerial, AerialPerspective::kPerPixel);
  EXPECT_EQ(r.device, GraphicsDevice::kGpu);
  EXPECT_EQ(r.tone.curve, ToneCurve::kExponential);
  EXPECT_EQ(r.tone.exposure, 1e-4);
}

TEST(RenderRequest, TheViewOfASequenceFollowsThePlanetThatItsFileNames) {
  const TemporaryDirectory directory;
  const auto write = [&](const char* name, const char* text) {
    std::ofstream(directory.path() / name) << text;
  };
  write("small.json",
        R"({"skyfit_preset": 2, "name": "small", "constituents": [], "ground": {"albedo": 0.1},
      "planet": {"bottom_radius_m": 1e6, "top_radius_m": 1.02e6}})");
  write("day.json", R"({"skyfit_sequence": 1, "frames": 1,
      "keyframes": [{"time_s": 0, "preset": "small.json"}]})");
  const RenderRequest r = request({"--view", "space", "--out-dir", "x", "--sequence",
                                   (directory.path() / "day.json").string()});
  EXPECT_EQ(r.sequence.keyframes[0].camera, pose_of(find_view("space"), 1e6));
}

TEST(RenderRequest, Projections) {
  const RenderRequest cube = request({"--projection", "cube", "--out", "x.exr"});
  EXPECT_EQ(cube.frame.width, 6 * cube.frame.height);  // where no size is typed
  const RenderRequest wide = request({"--projection", "angular", "--field-of-view-deg", "200",
                                      "--pitch-deg", "30", "--size", "64x64", "--out", "x.exr"});
  EXPECT_NEAR(*wide.frame.field_of_view, 200 * kDegree, 1e-12);
  EXPECT_NEAR(wide.sequence.keyframes[0].camera.view_zenith, 60 * kDegree, 1e-12);
  const auto refused = [](std::vector<std::string> arguments, const char* text) {
    arguments.insert(arguments.end(), {"--out", "x.exr"});
    EXPECT_THAT([&] { request(arguments); },
                testing::ThrowsMessage<std::exception>(testing::HasSubstr(text)));
  };
  refused({"--projection", "cube", "--size", "64x64"}, "must be 6:1 for the projection cube");
  refused({"--projection", "cube", "--pitch-deg", "5"}, "perspective or angular");
  refused({"--projection", "cube", "--field-of-view-deg", "5"}, "perspective, fisheye or angular");
  refused({"--projection", "fisheye", "--field-of-view-deg", "361"}, "from 1 to 360");
  refused({"--field-of-view-deg", "160"}, "from 1 to 150");
  refused({"--projection", "fisheye", "--overview-m", "500"}, "expected without --overview-m");
}

// What frames are known by follows from every row of render_features(), and what the rows need or
// exclude are options.
TEST(RenderRequest, EveryFeatureIsAnOptionAndPartOfWhatAFrameIsKnownBy) {
  const auto fingerprint = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--out", "x.exr"});
    const RenderRequest r = request(arguments);
    return Fingerprints(r, timeline_of(r.sequence)).of(shot_at(r.sequence, 0, sun_over), 0);
  };
  const std::map<std::string, std::string> tuples = {
      {"clouds", "0.4"}, {"second_sun", "60,40,0.3"}, {"moon", "60,40"}};
  CLI::App app;
  RenderOptions options;
  add_render_options(app, options);
  std::set<std::string> known = {fingerprint({})};
  for (const RenderFeature& feature : render_features()) {
    for (const FeatureOption& option : feature.options) {
      for (const auto& others : {option.needs, option.excludes})
        for (const std::string& other : others) EXPECT_NO_THROW(app.get_option(other)) << other;
    }
    std::string typed = feature.options.front().name;
    if (feature.numbers != nullptr) {
      typed += "=" + tuples.at(std::string(feature.name));
    } else if (feature.limits) {
      typed += fmt::format("={}", feature.limits->lower);
    } else if (!feature.words.empty()) {
      const std::string usual = app.get_option(typed)->get_default_str();
      const auto other = std::ranges::find_if(
          feature.words, [&](const FeatureWord& word) { return word.word != usual; });
      typed += "=" + std::string(other->word);
    }
    EXPECT_TRUE(known.insert(fingerprint({typed})).second) << typed;
  }
}

TEST(RenderRequest, SecondLights) {
  const RenderRequest red = request(
      {"--second-sun", "70,90,0.5", "--second-sun-temperature-k", "3000", "--out", "x.png"});
  ASSERT_TRUE(red.frame.second_sun->spectra);
  const Spectrum& light = red.frame.second_sun->spectra->solar_irradiance;
  EXPECT_GT(light.at(700), 2 * light.at(500));
  EXPECT_FALSE(request({"--second-sun", "70,90,0.5", "--out", "x.png"}).frame.second_sun->spectra);
  EXPECT_FALSE(request({"--moon", "60,0", "--out", "x.png"}).frame.moon->lights);
  EXPECT_TRUE(request({"--moon", "60,0", "--moonlight", "--out", "x.png"}).frame.moon->lights);
}

TEST(RenderRequest, WithoutAtmosphereNothingScatters) {
  EXPECT_FALSE(
      request({"--out", "x.png"}).sequence.keyframes[0].preset.atmosphere.constituents.empty());
  EXPECT_TRUE(request({"--atmosphere", "off", "--out", "x.png"})
                  .sequence.keyframes[0]
                  .preset.atmosphere.constituents.empty());
  EXPECT_EQ(request({"--tone", "clip", "--out", "x.png"}).tone.curve, ToneCurve::kClip);
}

TEST(RenderRequest, ModelsThatDoNotDrawAreRefused) {
  EXPECT_EQ(request({"--model", "nielsen:sun-through-sky", "--out", "x.png"}).model,
            "nielsen:sun-through-sky");
  for (const char* sky : {"preetham", "hosek-wilkie"})
    EXPECT_EQ(request({"--model", sky, "--out", "x.png"}).model, sky);
  EXPECT_THROW(request({"--model", "reference:refraction", "--out", "x.png"}), UsageError);
}

TEST(RenderRequest, SheetsOfCloudsMayBeSeveral) {
  const RenderRequest r =
      request({"--clouds", "0.4,9000,0.5", "--clouds", "0.3", "--out", "x.png"});
  ASSERT_EQ(r.frame.clouds.size(), 2u);
  EXPECT_EQ(r.frame.clouds[0].altitude_m, 9000);
  EXPECT_EQ(r.frame.clouds[1].cover, 0.3);
  EXPECT_THROW(request({"--clouds", "0.4,3000", "--clouds", "0.3,3000", "--out", "x.png"}),
               UsageError);
}

// A frame that is there stays as long as its textures have the same content.
TEST(RenderRequest, FramesAreKnownByTheContentOfTheirTextures) {
  const TemporaryDirectory directory;
  const auto write = [&](const char* name, const char* text) {
    std::ofstream(directory.path() / name) << text;
  };
  const auto fingerprint = [&] {
    const RenderRequest r = request({"--textures", directory.path().string(), "--out-dir", "x",
                                     "--frames", "2", "--time", "05:00..21:00", "--date",
                                     "2026-06-21", "--latitude-deg", "47", "--longitude-deg", "8"});
    const std::vector<TimelineStep> timeline = timeline_of(r.sequence);
    return Fingerprints(r, timeline).of(shot_at(r.sequence, 0, sun_over), 0);
  };
  const std::string made = fingerprint();
  EXPECT_EQ(fingerprint(), made);
  write("grass.png", "one");
  write("materials.json", R"({"skyfit_materials": 1, "soil": {"color": "grass.png"}})");
  const std::string own = fingerprint();
  EXPECT_NE(own, made);
  write("grass.png", "two");
  EXPECT_NE(fingerprint(), own);
  write("grass.png", "one");
  EXPECT_EQ(fingerprint(), own);
  write("materials.json",
        R"({"skyfit_materials": 1, "soil": {"color": "grass.png", "near_m": 5}})");
  EXPECT_NE(fingerprint(), own);
  std::filesystem::remove(directory.path() / "materials.json");
  EXPECT_EQ(fingerprint(), made);
  std::filesystem::copy_file(directory.path() / "grains.png", directory.path() / "crags.png",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_NE(fingerprint(), made);
}

TEST(RenderRequest, FolderOfTexturesMustExist) {
  const TemporaryDirectory directory;
  const std::string folder = directory.path() / "ground";
  EXPECT_THAT(
      [&] {
        request({"--textures", folder, "--out", "x.png"});
      },
      ::testing::ThrowsMessage<UsageError>("--textures \"" + folder + "\": no such directory"));
}

std::vector<double> altitudes_of(const GridRequest& grid) {
  std::vector<double> altitudes;
  for (const RenderRequest& cell : grid.cells)
    altitudes.push_back(cell.sequence.keyframes.front().camera.altitude_m);
  return altitudes;
}

double ozone_of(const RenderRequest& cell) {
  return get_parameter(cell.sequence.keyframes.front().preset.atmosphere, Parameter::kOzoneColumn);
}

TEST(GridRequest, AStripIsAGridOfOneRow) {
  const GridRequest grid = grid_of({"--strip", "ozone.column=100..400:4"});
  ASSERT_EQ(grid.cells.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_DOUBLE_EQ(ozone_of(grid.cells[i]), 100.0 * static_cast<double>(i + 1));
  EXPECT_THAT(grid.columns[0].values, ::testing::ElementsAre("100", "200", "300", "400"));
  EXPECT_EQ(grid.columns[0].unit, "DU");
  EXPECT_TRUE(grid.rows.empty());
  EXPECT_TRUE(grid.meters_together);
}

TEST(GridRequest, StepsAreGeometricOrListed) {
  EXPECT_THAT(grid_of({"--strip", "mie.scattering=1e-6..1.6e-5:5:geometric"}).columns[0].values,
              ::testing::ElementsAre("1e-06", "2e-06", "4e-06", "8e-06", "1.6e-05"));
  EXPECT_THAT(grid_of({"--strip", "mie.scattering=2e-6,4e-6,8e-6"}).columns[0].values,
              ::testing::ElementsAre("2e-06", "4e-06", "8e-06"));
  EXPECT_EQ(grid_of({"--strip", "mie.scattering=2e-6..4e-6"}).cells.size(), 5u);
}

// A cell has the values of its column and its row: row by row, what is repeated moves together.
TEST(GridRequest, RowsAndColumnsMakeEveryCell) {
  const GridRequest grid =
      grid_of({"--strip", "ozone.column=0,300", "--strip", "mie.scattering=1e-6,2e-6", "--rows",
               "altitude-m=2000,5000,20000", "--rows", "exposure-ev=-1..1:3"});
  EXPECT_THAT(altitudes_of(grid), ::testing::ElementsAre(2000, 2000, 5000, 5000, 20000, 20000));
  for (std::size_t i = 0; i < 6; ++i) {
    const Preset& preset = grid.cells[i].sequence.keyframes.front().preset;
    EXPECT_EQ(ozone_of(grid.cells[i]), i % 2 == 0 ? 0 : 300);
    EXPECT_DOUBLE_EQ(get_parameter(preset.atmosphere, Parameter::kMieScattering),
                     i % 2 == 0 ? 1e-6 : 2e-6);
    EXPECT_EQ(grid.cells[i].tone.exposure_stops, -1.0 + static_cast<double>(i / 2));
    EXPECT_EQ(grid.sessions[i], grid.sessions[0]) << "all are drawn by one renderer";
  }
}

// An option of an axis is what it is when it is typed, with what it needs beside it.
TEST(GridRequest, DaysAndTimesMoveTheSun) {
  const GridRequest grid =
      grid_of(at_zurich({"--strip", "time=08:00,13:28", "--rows", "date=2026-06-21,2026-12-21",
                         "--utc-offset-h", "2"}));
  ASSERT_EQ(grid.cells.size(), 4u);
  const auto zenith_deg = [&](std::size_t i) {
    return shot_at(grid.cells[i].sequence, 0, sun_over).sun.zenith / kDegree;
  };
  EXPECT_NEAR(zenith_deg(1), 47.4 - 23.44, 0.02);
  EXPECT_NEAR(zenith_deg(3), 47.4 + 23.44, 0.1);  // the equation of time differs by 4 minutes
  EXPECT_GT(zenith_deg(0), zenith_deg(1));
}

TEST(GridRequest, HasNoSequencesPanelsOrPolarisation) {
  for (const char* option : {"--stokes", "--panels"})
    EXPECT_THROW(grid_of({option, "--strip", "mie.scattering=1e-6..8e-6"}), UsageError) << option;
  EXPECT_THROW(grid_of({"--sequence", "day.json", "--rows", "altitude-m=1,2"}), UsageError);
}

TEST(GridRequest, BlocksOfTheGroundMayVary) {
  const GridRequest grid = grid_of(
      {"--strip", "lod-constant=60,120", "--rows", "culling=on,off", "--overview-m", "1e5"});
  ASSERT_EQ(grid.cells.size(), 4u);
  EXPECT_EQ(grid.cells[1].frame.terrain.lod_constant, 120);
  EXPECT_TRUE(grid.cells[1].frame.terrain.cull);
  EXPECT_FALSE(grid.cells[2].frame.terrain.cull);
  EXPECT_EQ(grid.cells[3].sequence.keyframes.front().camera.overview_m, 1e5);
}

TEST(RenderRequest, BlocksOfTheGround) {
  const RenderRequest r = request({"--lod-constant", "80", "--terrain-levels", "7", "--wireframe",
                                   "--block-boxes", "level", "--out", "x.png"});
  EXPECT_EQ(r.frame.terrain.lod_constant, 80);
  EXPECT_EQ(r.frame.terrain.levels, 7);
  EXPECT_TRUE(r.frame.terrain.cull);
  EXPECT_TRUE(r.frame.terrain.wireframe);
  EXPECT_EQ(r.frame.terrain.boxes, BlockColors::kLevel);
  for (const auto& [option, value] : {std::pair("--lod-constant", "50"),
                                      {"--lod-constant", "far"},
                                      {"--terrain-levels", "0"},
                                      {"--culling", "yes"},
                                      {"--block-boxes", "red"},
                                      {"--overview-m", "0"}})
    EXPECT_THROW(request({option, value, "--out", "x.png"}), UsageError) << option;
  EXPECT_THROW(request({"--overview-m", "1e5", "--shadows", "--out", "x.png"}), UsageError);
}

TEST(GridRequest, AnotherModelIsAnotherSession) {
  const GridRequest grid =
      grid_of({"--strip", "model=bodare,bruneton", "--rows", "sun-zenith-deg=30,60"});
  EXPECT_EQ(grid.cells[0].model, "bodare");
  EXPECT_EQ(grid.cells[3].model, "bruneton");
  EXPECT_EQ(grid.sessions[0], grid.sessions[2]);
  EXPECT_NE(grid.sessions[0], grid.sessions[1]);
}

}  // namespace
}  // namespace skyfit::cli
