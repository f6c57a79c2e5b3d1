// SPDX-License-Identifier: Apache-2.0
// A digital elevation model lies where its georeference says, with its heights; beyond its edge and
// where it has no data it goes over into what is around.
#include "render/gl/terrain/regional_ground.h"

#include <gmock/gmock.h>

#include "tests/render/dem_fixture.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;
constexpr double kDegreeM = kRadius * std::numbers::pi / 180;
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSingle = 1e-3;  // m: heights of some km in single precision
constexpr double kFine = 0.1;     // m: nothing of a map is left out

// 100 m high everywhere, so that what is around a map is told from the sea.
class Plain : public Ground {
 public:
  Elevation elevation(const glm::dvec3&, double) const override { return {kPlain, kPlain}; }
  std::optional<NodeValues> water_reflectance() const override { return std::nullopt; }
  NodeValues reflectance(const glm::dvec3&, double, double, double) const override { return {}; }
  double rock(const glm::dvec3&, double, double, double) const override { return 0; }
  double highest_m() const override { return kPlain; }
  void add_inputs(CacheKey&) const override {}

  static constexpr double kPlain = 100;
};

using RegionalGroundOf = DemFiles;

// Degrees.
double height_at(const RegionalMap& map, double latitude, double longitude) {
  const auto sample = map.at(place_of(direction_at(latitude, longitude)), kFine);
  return sample ? sample->height_m : -1e9;
}

RegionalGround ground_of(const Scene& scene) {
  return {std::make_unique<Plain>(), read_regional_maps(scene, kRadius, true), scene, kRadius};
}

TEST_F(RegionalGroundOf, APlaneIsThatPlane) {
  const RegionalMap map = map_of(write("plane.tif", kAlps, plane));
  for (double latitude = 45.76; latitude < 46.25; latitude += 0.03) {
    for (double longitude = 6.76; longitude < 7.25; longitude += 0.03) {
      EXPECT_NEAR(height_at(map, latitude, longitude), plane(longitude, latitude), kSingle);
      const auto sample = map.at(place_of(direction_at(latitude, longitude)), kFine);
      EXPECT_NEAR(sample->slope_m, 0.005 * std::hypot(800, 400), 0.01);
      EXPECT_EQ(sample->presence, 1);
    }
  }
  EXPECT_NEAR(map.centre().latitude, 46 * kDegree, 1e-12);
  EXPECT_NEAR(map.centre().longitude, 7 * kDegree, 1e-12);
}

TEST_F(RegionalGroundOf, SamplesOfAnHgtLieOnTheLinesOfItsDegree) {
  const RegionalMap map =
      map_of(write_hgt("N43W028.hgt", [](int row, int column) { return 5 + 2 * row + column; }));
  for (const double north : {0.0, 0.2, 0.513, 1.0}) {
    for (const double east : {0.0, 0.3, 0.777, 1.0}) {
      EXPECT_NEAR(height_at(map, 43 + north, -28 + east), 5 + 2 * 1200 * (1 - north) + 1200 * east,
                  kSingle);
    }
  }
}

TEST_F(RegionalGroundOf, DetailsAreLeftOutAndThePlaneStays) {
  const RegionalGround ground = ground_of(scene_of({write("plane.tif", kAlps, plane)}));
  const double coarse = 8 * 0.005 * kDegreeM;  // no noise
  EXPECT_NEAR(ground.height_m(direction_at(46.03, 7.04), coarse), plane(7.04, 46.03), 0.1);
  // Noise of a share of the slope: 4.5 m per cell.
  double mean = 0;
  for (int i = 0; i < 400; ++i) {
    const double latitude = 45.9 + 0.01 * (i % 20), longitude = 6.9 + 0.01 * (i / 20);
    const double height = ground.height_m(direction_at(latitude, longitude), 1);
    EXPECT_NEAR(height, plane(longitude, latitude), 8);
    mean += (height - plane(longitude, latitude)) / 400;
  }
  EXPECT_NEAR(mean, 0, 0.5);
}

TEST_F(RegionalGroundOf, AConeIsThatCone) {
  // Distances from the tip as on the sphere, cells of some 560 m x 390 m.
  const auto cone = [](double longitude, double latitude) {
    const double east = (longitude - 7) * kDegreeM * std::cos(46 * kDegree);
    return 3000 - 0.1 * std::hypot(east, (latitude - 46) * kDegreeM);
  };
  const RegionalMap map = map_of(write("cone.tif", kAlps, cone));
  for (double turn = 0; turn < 6.3; turn += 0.3) {
    const double latitude = 46 + 0.1 * std::sin(turn), longitude = 7 + 0.1 * std::cos(turn);
    // A spline over cells of h bends by h^2 / 6 of the second derivative: 0.1 / 7800 m.
    EXPECT_NEAR(height_at(map, latitude, longitude), cone(longitude, latitude), 1.4);
  }
  // The tip is rounded over a cell.
  EXPECT_LT(height_at(map, 46, 7), 3000);
  EXPECT_GT(height_at(map, 46, 7), 3000 - 0.1 * 560);
}

TEST_F(RegionalGroundOf, AProjectionIsTakenBackToLatitudeAndLongitude) {
  // UTM 33: the central meridian 15 degrees east is easting 500 km.
  const DemFile utm = {200, 200, {490e3, 100, 0, 5110e3, 0, -100}, "EPSG:32633"};
  const RegionalMap map = map_of(
      write("utm.tif", utm, [](double easting, double) { return 1000 + 0.1 * (easting - 500e3); }));
  // EPSG guidance note 7-2: near it, k0 times the arc of the parallel on the WGS 84 ellipsoid.
  constexpr double kScale = 0.9996, kSemiMajor = 6378137, kFlattening = 1 / 298.257223563;
  constexpr double kSquare = kFlattening * (2 - kFlattening);
  for (const double east : {-0.1, -0.05, 0.0, 0.05, 0.1}) {
    for (const double latitude : {46.0, 46.05, 46.1}) {
      const double s = std::sin(latitude * kDegree);
      const double parallel =
          kSemiMajor / std::sqrt(1 - kSquare * s * s) * std::cos(latitude * kDegree);
      const double easting = kScale * parallel * east * kDegree;
      // Resampled bilinearly, with transformations within 0.05 cells.
      EXPECT_NEAR(height_at(map, latitude, 15 + east), 1000 + 0.1 * easting, 0.6);
    }
  }
}

TEST_F(RegionalGroundOf, ATurnedMapLiesAsTurned) {
  const double c = 0.005 * std::cos(0.5), s = 0.005 * std::sin(0.5);
  const DemFile turned = {100, 100, {6.75, c, s, 46.25, s, -c}};
  const RegionalMap map = map_of(write("turned.tif", turned, plane));
  const double longitude = 6.75 + 50 * (c + s), latitude = 46.25 + 50 * (s - c);
  for (const double step : {-0.1, 0.0, 0.1})
    EXPECT_NEAR(height_at(map, latitude + step, longitude + step),
                plane(longitude + step, latitude + step), 0.3);
  // In a corner of the square of latitude and longitude about it there are no data.
  EXPECT_FALSE(map.at(place_of(direction_at(46.45, 6.8)), kFine));
}

TEST_F(RegionalGroundOf, AMapMayLieAcrossTheLineOfDate) {
  const DemFile dem = {40, 40, {179.9, 0.005, 0, 10.1, 0, -0.005}};
  const RegionalMap map =
      map_of(write("date.tif", dem, [](double longitude, double) { return 100 * longitude; }));
  for (const double longitude : {179.95, 179.99, 180.0, 180.01, 180.05})
    EXPECT_NEAR(height_at(map, 10, longitude), 100 * longitude, 2 * kSingle);
}

TEST_F(RegionalGroundOf, AMapOfThePlanetHasNoSeam) {
  const DemFile dem = {72, 36, {-180, 5, 0, 90, 0, -5}};
  const RegionalMap map = map_of(write("planet.tif", dem, [](double longitude, double latitude) {
    return 2000 + 1000 * std::cos(longitude * kDegree) * std::cos(latitude * kDegree);
  }));
  for (double longitude = 170; longitude < 190; longitude += 1) {
    // Cells of 5 degrees: the spline bends by 0.0013 of the curvature.
    EXPECT_NEAR(height_at(map, 0, longitude), 2000 + 1000 * std::cos(longitude * kDegree), 3);
    EXPECT_EQ(map.at(place_of(direction_at(0, longitude)), kFine)->presence, 1);
  }
}

TEST_F(RegionalGroundOf, OtherBodiesHaveTheirOwnSphere) {
  DemFile mars = kAlps;
  mars.srs = "+proj=longlat +R=3396190 +no_defs";
  EXPECT_NEAR(height_at(map_of(write("mars.tif", mars, plane)), 46.02, 7.03), plane(7.03, 46.02),
              kSingle);
}

TEST_F(RegionalGroundOf, UnitsScalesAndBandsAreObeyed) {
  DemFile dem = kAlps;
  dem.unit = "ft";
  EXPECT_NEAR(height_at(map_of(write("feet.tif", dem, plane)), 46, 7), 0.3048 * 1500, kSingle);
  dem = kAlps;
  dem.scale = 0.1;
  dem.offset = 20;
  EXPECT_NEAR(height_at(map_of(write("scaled.tif", dem, plane)), 46, 7), 170, kSingle);
  dem = kAlps;
  dem.bands = 3;
  Scene scene = scene_of({write("bands.tif", dem, plane)});
  scene.dems[0].band = 3;
  EXPECT_NEAR(height_at(map_of(scene), 46, 7), 1500, kSingle);
  scene.dems[0].band = 2;
  EXPECT_NEAR(height_at(map_of(scene), 46, 7), 0, kSingle);
  scene.dems[0].zero_m = 30;
  EXPECT_NEAR(height_at(map_of(scene), 46, 7), 30, kSingle);
}

TEST_F(RegionalGroundOf, BeyondTheEdgeItGoesOverIntoThePlanet) {
  Scene scene = scene_of({write("flat.tif", kAlps, [](double, double) { return 1100.0; })});
  scene.dem_edge_m = 4000;
  const RegionalGround ground = ground_of(scene);
  const auto height = [&](double beyond_m) {
    return ground.height_m(direction_at(46.25 + beyond_m / kDegreeM, 7), 4000);
  };
  EXPECT_NEAR(height(-1), 1100, 0.01);
  EXPECT_NEAR(height(1000), 100 + 1000 * (1 - 0.15625), 0.1);  // 3 t^2 - 2 t^3 at 1/4
  EXPECT_NEAR(height(2000), 600, 0.1);
  EXPECT_EQ(height(4001), Plain::kPlain);
  scene.dem_surroundings = DemSurroundings::kSea;
  const RegionalGround island = ground_of(scene);
  EXPECT_NEAR(island.height_m(direction_at(46.25 + 2000 / kDegreeM, 7), 4000), 550, 0.1);
  EXPECT_EQ(island.height_m(direction_at(47, 7), 4000), 0);
  scene.dem_edge_m.reset();  // a tenth of 0.5 degrees of longitude
  const double tenth = 0.05 * kDegreeM * std::cos(46 * kDegree);
  EXPECT_NEAR(ground_of(scene).height_m(direction_at(46.25 + 0.5 * tenth / kDegreeM, 7), 4000), 550,
              0.5);
}

TEST_F(RegionalGroundOf, TilesThatAdjoinAreOne) {
  DemFile east = kAlps;
  east.place[0] += 0.5;
  const RegionalGround ground =
      ground_of(scene_of({write("west.tif", kAlps, plane), write("east.tif", east, plane)}));
  for (double longitude = 7.2; longitude < 7.3; longitude += 0.0007) {
    EXPECT_NEAR(ground.height_m(direction_at(46, longitude), 8 * 0.005 * kDegreeM),
                plane(longitude, 46), 0.1);
  }
}

TEST_F(RegionalGroundOf, TheFinerOfTwoMapsShows) {
  const DemFile coarse = {50, 50, {6, 0.04, 0, 47, 0, -0.04}};
  const fs::path around = write("coarse.tif", coarse, [](double, double) { return 500.0; });
  const fs::path fine = write("fine.tif", kAlps, [](double, double) { return 1500.0; });
  for (const auto& files : {std::vector{around, fine}, std::vector{fine, around}}) {
    const RegionalGround ground = ground_of(scene_of(files));
    EXPECT_NEAR(ground.height_m(direction_at(46, 7), 4000), 1500, 0.01);
    EXPECT_NEAR(ground.height_m(direction_at(46.5, 7), 4000), 500, 0.01);
    // Over the two cells about the edge of the fine one.
    EXPECT_NEAR(ground.height_m(direction_at(46.25, 7), 4000), 1000, 1);
  }
}

TEST_F(RegionalGroundOf, WithoutDataThereIsWhatIsAround) {
  DemFile dem = kAlps;
  dem.no_data = -9999;
  // East of 7 degrees nothing is known.
  const fs::path file = write(
      "half.tif", dem, [](double longitude, double) { return longitude > 7 ? -9999.0 : 1100.0; });
  Scene scene = scene_of({file});
  scene.dem_edge_m = 8000;
  const double cell_m = 0.005 * kDegreeM * std::cos(46 * kDegree);  // along the parallel
  const RegionalGround ground = ground_of(scene);
  const auto height = [&](const RegionalGround& of, double cells_east) {
    return of.height_m(direction_at(46, 7 + 0.005 * cells_east), 400);
  };
  EXPECT_NEAR(height(ground, -0.6), 1100, 0.01);
  const double t = 10 * cell_m / 8000;  // from the last cell with data, half a cell west of 7
  EXPECT_NEAR(height(ground, 9.5), 100 + 1000 * (1 - t * t * (3 - 2 * t)), 1);
  EXPECT_EQ(height(ground, 30), Plain::kPlain);
  scene.dem_surroundings = DemSurroundings::kSea;
  const RegionalGround coast = ground_of(scene);
  EXPECT_NEAR(height(coast, -10), 1100, 0.01);
  for (const double cells : {2.5, 9.5, 30.0}) EXPECT_EQ(height(coast, cells), 0);
}

TEST_F(RegionalGroundOf, AVoidIsClosedFromItsEdge) {
  const fs::path file = write_hgt("N46E007.hgt", [](int row, int column) {
    const bool hole = std::hypot(row - 600, column - 600) < 40;
    return hole ? -32768 : 1000 + row;
  });
  Scene scene = scene_of({file});
  const RegionalGround ground = ground_of(scene);
  const double height = ground.height_m(direction_at(46.5, 7.5), 800);
  EXPECT_NEAR(height, 1600, 3);  // by means that are bilinear over the void: 80 m from side to side
}

TEST_F(RegionalGroundOf, HeightsBelowTheWaterAreItsDepth) {
  const fs::path file =
      write("shore.tif", kAlps, [](double longitude, double) { return 2000 * (longitude - 7); });
  const RegionalGround ground = ground_of(scene_of({file}));
  for (const double west : {0.02, 0.1, 0.2}) {
    const glm::dvec3 d = direction_at(46, 7 - west);
    const auto [height, above_water] = ground.elevation(d, kFine);
    EXPECT_EQ(height, 0);
    EXPECT_NEAR(above_water / (-2000 * west), 1, 0.3);  // and what is finer than the map
  }
  EXPECT_NEAR(ground.height_m(direction_at(46, 7.1), 4000), 200, 1);
  EXPECT_LT(ground.height_m(direction_at(46, 7.24), kFine), ground.highest_m());
}

// Water is level also where a region goes over into its surroundings: none lies on the slope
// between.
TEST_F(RegionalGroundOf, NoWaterLiesOnTheSlopeBeyondTheEdge) {
  // An ocean all around, as far below the water as the made-up planet's.
  class Ocean final : public Plain {
    Elevation elevation(const glm::dvec3&, double) const override { return {0, -8000}; }
  };
  constexpr double kLittle = 0.2;  // m
  const fs::path file = write("high.tif", kAlps, [](double, double) { return 1100.0; });
  for (const DemSurroundings around : {DemSurroundings::kPlanet, DemSurroundings::kSea}) {
    Scene scene = scene_of({file});
    scene.dem_edge_m = 4000;
    scene.dem_surroundings = around;
    const RegionalGround ground(std::make_unique<Ocean>(), read_regional_maps(scene, kRadius, true),
                                scene, kRadius);
    int water = 0, land = 0;
    for (double beyond_m = 0; beyond_m < 4500; beyond_m += 5) {
      const Elevation at = ground.elevation(direction_at(46.25 + beyond_m / kDegreeM, 7), 4000);
      ++(at.above_water_m > 0 ? land : water);
      if (at.above_water_m > 0) continue;
      EXPECT_LT(at.height_m, kLittle) << beyond_m;
    }
    EXPECT_GT(water, 50);
    EXPECT_GT(land, 500);
  }
}

}  // namespace
}  // namespace skyfit
