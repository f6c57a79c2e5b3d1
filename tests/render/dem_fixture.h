// SPDX-License-Identifier: Apache-2.0
// Small digital elevation models with heights in closed form, written into a directory of their
// own.
#pragma once

#include <gdal.h>
#include <gdal_frmts.h>
#include <gtest/gtest.h>
#include <ogr_srs_api.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <glm/vec3.hpp>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "model/base/temporary_directory.h"
#include "render/gl/terrain/regional_map.h"
#include "render/render.h"

namespace skyfit {

// What a GeoTIFF says of itself. `place`: as GDAL's, x = place[0] + column place[1] + row place[2],
// y = place[3] + column place[4] + row place[5].
struct DemFile {
  int columns = 0, rows = 0;
  std::array<double, 6> place{};
  std::string srs = "EPSG:4326";  // or PROJ's or WKT; empty: none
  int bands = 1;
  std::string unit = {};
  double scale = 1, offset = 0;
  double no_data = std::numeric_limits<double>::quiet_NaN();
};

class DemFiles : public ::testing::Test {
 protected:
  // value(x, y) at the middle of the cells, in the last band; 0 in the others.
  template <class F>
  std::filesystem::path write(const std::string& name, const DemFile& dem, F&& value) const {
    GDALRegister_GTiff();
    const std::filesystem::path file = directory_ / name;
    const std::unique_ptr<void, void (*)(void*)> made(
        GDALCreate(GDALGetDriverByName("GTiff"), file.c_str(), dem.columns, dem.rows, dem.bands,
                   GDT_Float32, nullptr),
        [](void* dataset) { GDALClose(dataset); });
    std::array<double, 6> place = dem.place;
    if (place[1] != 0) GDALSetGeoTransform(made.get(), place.data());
    if (!dem.srs.empty()) {
      const std::unique_ptr<void, void (*)(void*)> srs(OSRNewSpatialReference(nullptr),
                                                       [](void* s) { OSRRelease(s); });
      EXPECT_EQ(OSRSetFromUserInput(srs.get(), dem.srs.c_str()), OGRERR_NONE);
      GDALSetSpatialRef(made.get(), srs.get());
    }
    const GDALRasterBandH band = GDALGetRasterBand(made.get(), dem.bands);
    if (!dem.unit.empty()) GDALSetRasterUnitType(band, dem.unit.c_str());
    if (dem.scale != 1) GDALSetRasterScale(band, dem.scale);
    if (dem.offset != 0) GDALSetRasterOffset(band, dem.offset);
    if (!std::isnan(dem.no_data)) GDALSetRasterNoDataValue(band, dem.no_data);
    std::vector<float> values;
    for (int row = 0; row < dem.rows; ++row) {
      for (int column = 0; column < dem.columns; ++column) {
        const double c = column + 0.5, r = row + 0.5;
        values.push_back(static_cast<float>(
            value(place[0] + c * place[1] + r * place[2], place[3] + c * place[4] + r * place[5])));
      }
    }
    EXPECT_EQ(GDALRasterIO(band, GF_Write, 0, 0, dem.columns, dem.rows, values.data(), dem.columns,
                           dem.rows, GDT_Float32, 0, 0),
              CE_None);
    return file;
  }

  // An .hgt of 1201 x 1201 samples, at the corners of its degree and between them, whose values are
  // value(row, column).
  template <class F>
  std::filesystem::path write_hgt(const std::string& name, F&& value) const {
    std::string bytes;
    for (int row = 0; row < kHgt; ++row) {
      for (int column = 0; column < kHgt; ++column) {
        const auto height =
            static_cast<std::uint16_t>(static_cast<std::int16_t>(value(row, column)));
        bytes += static_cast<char>(height >> 8);
        bytes += static_cast<char>(height & 255);
      }
    }
    std::ofstream(directory_ / name, std::ios::binary) << bytes;
    return directory_ / name;
  }

  static Scene scene_of(std::vector<std::filesystem::path> files) {
    Scene scene;
    for (const std::filesystem::path& file : files) scene.dems.push_back({file});
    return scene;
  }

  static constexpr int kHgt = 1201;
  const TemporaryDirectory temporary_;
  const std::filesystem::path directory_ = temporary_.path();
};

// Degrees.
inline glm::dvec3 direction_at(double latitude, double longitude) {
  constexpr double kDegree = std::numbers::pi / 180;
  const double f = latitude * kDegree, l = longitude * kDegree;
  return {std::cos(f) * std::cos(l), std::cos(f) * std::sin(l), std::sin(f)};
}

inline constexpr double kRadius = 6360e3;  // of the planet in these tests, m

// Half a degree about latitude 46, longitude 7, in cells of 0.005 degrees.
inline const DemFile kAlps = {100, 100, {6.75, 0.005, 0, 46.25, 0, -0.005}};

// m, of degrees.
inline double plane(double longitude, double latitude) {
  return 1500 + 800 * (longitude - 7) - 400 * (latitude - 46);
}

inline RegionalMap map_of(const Scene& scene) {
  return {scene, scene.dems[0], kRadius, kMostDemCells};
}

inline RegionalMap map_of(const std::filesystem::path& file) {
  Scene scene;
  scene.dems.push_back({file});
  return map_of(scene);
}

}  // namespace skyfit
