// SPDX-License-Identifier: Apache-2.0
// What is no digital elevation model, or one of a place that cannot be, is named in one line; other
// files are not followed.
#include <gmock/gmock.h>

#include <array>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "render/gl/terrain/regional_ground.h"
#include "tests/render/dem_fixture.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using DemRefusals = DemFiles;

TEST_F(DemRefusals, ADryPlanetHasNoDepthOfASea) {
  const fs::path file = write("basin.tif", kAlps, [](double, double) { return -50.0; });
  try {
    read_regional_maps(scene_of({file}), kRadius, false);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("basin.tif: heights down to -50 m on a planet without a "
                                        "sea: expected none below 0 m"));
  }
}

TEST_F(DemRefusals, WhatIsNoElevationModelIsNamed) {
  const auto error_of = [](const Scene& scene, std::int64_t most_cells = kMostDemCells) {
    try {
      RegionalMap(scene, scene.dems[0], kRadius, most_cells);
    } catch (const std::runtime_error& error) {
      const std::string message = error.what(), file = scene.dems[0].file.string();
      EXPECT_THAT(message, StartsWith(file + ": "));
      EXPECT_THAT(message, Not(HasSubstr("\n")));
      return message.substr(file.size() + 2);
    }
    return std::string("no error");
  };
  const auto error = [&](const std::string& name, const DemFile& dem) {
    return error_of(scene_of({write(name, dem, plane)}));
  };
  const auto text = [&](const std::string& name, const std::string& bytes) {
    std::ofstream(directory_ / name) << bytes;
    return error_of(scene_of({directory_ / name}));
  };
  DemFile dem = kAlps;
  dem.srs = "";
  EXPECT_EQ(error("nowhere.tif", dem),
            "no georeference: expected a GeoTIFF that says where it lies");
  dem = kAlps;
  dem.place = {};
  EXPECT_EQ(error("unplaced.tif", dem),
            "no georeference: expected a GeoTIFF that says where it lies");
  dem = kAlps;
  dem.srs = "LOCAL_CS[\"site\",UNIT[\"metre\",1]]";
  EXPECT_THAT(error("local.tif", dem),
              EndsWith("expected latitude and longitude, or a projection"));
  // As a file states a datum by a code that the EPSG data set has not.
  const auto with_code = [&](const std::string& name, std::uint16_t code) {
    const std::filesystem::path file = write(name, kAlps, plane);
    std::stringstream stream;
    stream << std::ifstream(file, std::ios::binary).rdbuf();
    std::string bytes = stream.str();
    constexpr std::uint16_t kGeodeticKey = 2048, kWgs84 = 4326;  // OGC 19-008r4, GeodeticCRSGeoKey
    const std::array<std::uint16_t, 4> key = {kGeodeticKey, 0, 1, kWgs84};
    const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(key.data()), 8));
    EXPECT_NE(at, std::string::npos);
    std::memcpy(&bytes[at + 6], &code, sizeof code);
    std::ofstream(file, std::ios::binary) << bytes;
    return error_of(scene_of({file}));
  };
  EXPECT_EQ(with_code("known.tif", 4326), "no error");
  for (const std::uint16_t code : {std::uint16_t{9999}, std::uint16_t{32767}})
    EXPECT_EQ(with_code("unknown.tif", code),
              "coordinate system WGS 84: its datum is not known: expected a code that EPSG has, or "
              "a stated ellipsoid");
  dem = kAlps;
  dem.bands = 3;
  EXPECT_EQ(error("colours.tif", dem), "3 bands: expected one, or FILE@BAND that says which");
  Scene scene = scene_of({write("plane.tif", kAlps, plane)});
  scene.dems[0].band = 2;
  EXPECT_EQ(error_of(scene), "band 2: the file has 1");
  scene.dems[0].band = 1;
  EXPECT_EQ(error_of(scene, 9999), "100 x 100 cells: expected at most 9999 in all");
  dem = kAlps;
  dem.unit = "fathom";
  EXPECT_EQ(error("fathoms.tif", dem), "heights in \"fathom\": expected m or ft");
  dem = kAlps;
  dem.place[3] = 95;
  EXPECT_EQ(error("north.tif", dem), "latitudes 94.5 to 95 deg: expected -90 to 90");
  dem = {800, 4, {-180, 0.5, 0, 1, 0, -0.5}};
  EXPECT_EQ(error("twice.tif", dem), "longitudes -180 to 220 deg: expected at most once around");
  dem = kAlps;
  dem.columns = 3;
  EXPECT_EQ(error("narrow.tif", dem), "3 x 100 cells: expected at least 4 on a side");
  EXPECT_EQ(error_of(scene_of({write("void.tif", kAlps, [](double, double) { return -32768; })})),
            "-32768 m in column 0 of row 0: expected heights within 25 km, or a no-data value that "
            "the file states");
  dem = kAlps;
  dem.no_data = 7;
  EXPECT_EQ(error_of(scene_of({write("empty.tif", dem, [](double, double) { return 7; })})),
            "no data in any cell: expected heights");
  EXPECT_EQ(text("words.tif", "no picture at all, but text of some length\n"),
            "cannot be read: expected a GeoTIFF or an .hgt of SRTM");
  EXPECT_THAT(text("N46E007.hgt", "short"),
              StartsWith("cannot be read: expected a name that says"));
  EXPECT_THAT(text("alps.hgt", "short"), StartsWith("cannot be read: expected a name that says"));
}

TEST_F(DemRefusals, OtherFilesAreNotFollowed) {
  // A VRT names files and addresses; a sidecar would place what says not where it lies.
  const fs::path plane_file = write("plane.tif", kAlps, plane);
  std::ofstream(directory_ / "virtual.tif")
      << "<VRTDataset rasterXSize=\"100\" rasterYSize=\"100\"><VRTRasterBand dataType=\"Float32\" "
         "band=\"1\"><SimpleSource><SourceFilename>"
      << plane_file.string() << "</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>";
  EXPECT_THROW(map_of(directory_ / "virtual.tif"), std::runtime_error);
  DemFile bare = kAlps;
  bare.place = {};
  bare.srs = "";
  const fs::path file = write("bare.tif", bare, plane);
  std::ofstream(directory_ / "bare.tfw") << "0.005\n0\n0\n-0.005\n6.75\n46.25\n";
  std::ofstream(directory_ / "bare.tif.aux.xml")
      << "<PAMDataset><SRS>EPSG:4326</SRS><GeoTransform>6.75,0.005,0,46.25,0,-0.005</GeoTransform>"
         "</PAMDataset>";
  EXPECT_THROW(map_of(file), std::runtime_error);
}

TEST_F(DemRefusals, ATruncatedFileIsAnError) {
  const fs::path file = write("cut.tif", kAlps, plane);
  fs::resize_file(file, fs::file_size(file) / 2);
  EXPECT_THROW(map_of(file), std::runtime_error);
}

}  // namespace
}  // namespace skyfit
