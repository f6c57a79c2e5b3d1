// SPDX-License-Identifier: Apache-2.0
#include "render/dem/dem_module.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <gdal.h>
#include <gdal_alg.h>
#include <gdal_frmts.h>
#include <gdalwarper.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace skyfit {
namespace {

namespace fs = std::filesystem;

constexpr double kHighest = 25e3;                            // m; Olympus Mons: 21 km
constexpr std::int64_t kMostBlockBytes = 256 * (1LL << 20);  // of a file's tiles or strips
constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();

struct DatasetCloser {
  void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, DatasetCloser>;

// GDAL with the two formats, and no way to anything but the file that is named: no sidecar files,
// no network, no drivers from plugins. What it says stays in CPLGetLastErrorMsg().
class Session {
 public:
  Session() {
    [[maybe_unused]] static const bool ready = [] {
      CPLSetConfigOption("GDAL_PAM_ENABLED", "NO");
      CPLSetConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR");
      CPLSetConfigOption("GDAL_CACHEMAX", "64");  // MB
      OSRSetPROJEnableNetwork(FALSE);
      GDALRegister_GTiff();
      GDALRegister_SRTMHGT();
      GDALRegister_MEM();  // for what is computed; Source opens no file with it
      return true;
    }();
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~Session() { CPLPopErrorHandler(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

using GeoTransform = std::array<double, 6>;

// One band of a file.
class Source {
 public:
  Source(const fs::path& file, int band) : file_(file) {
    open();
    choose(band);
    check_place();
    check_values();
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {}", file_.string(), what));
  }
  [[noreturn]] void fail_to_read() const {
    const std::string message = CPLGetLastErrorMsg();
    fail("cannot be read: " + message.substr(0, message.find('\n')));
  }

  // On the grid of DemCells. `most_cells`: of it.
  DemCells cells(int fewest_on_a_side, std::int64_t most_cells) const {
    const std::int64_t across = columns(dataset_.get()), down = rows(dataset_.get());
    if (std::min(across, down) < fewest_on_a_side)
      fail(fmt::format("{} x {} cells: expected at least {} on a side", across, down,
                       fewest_on_a_side));
    const OGRSpatialReference target = geographic();
    if (is_on_grid(target)) {
      expect_few(across, down, most_cells);
      return read(dataset_.get(), band_);
    }
    return read(resampled(target, most_cells).get(), 1);
  }

 private:
  static std::int64_t columns(GDALDatasetH dataset) { return GDALGetRasterXSize(dataset); }
  static std::int64_t rows(GDALDatasetH dataset) { return GDALGetRasterYSize(dataset); }
  GDALRasterBandH band() const { return GDALGetRasterBand(dataset_.get(), band_); }

  void open() {
    const char* const formats[] = {"GTiff", "SRTMHGT", nullptr};
    const char* const options[] = {"GEOREF_SOURCES=INTERNAL", nullptr};
    // An absolute path is no name with a meaning of its own, such as GTIFF_DIR:1:FILE.
    dataset_.reset(GDALOpenEx(fs::absolute(file_).c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY,
                              formats, options, nullptr));
    if (dataset_) return;
    if (file_.extension() == ".hgt") {
      fail(
          "cannot be read: expected a name that says where it lies, as N43W028.hgt, and a square "
          "of 16-bit heights, 1201 or 3601 on a side");
    }
    const std::string message = CPLGetLastErrorMsg();
    if (message.empty() || message.find("not recognized") != std::string::npos)
      fail("cannot be read: expected a GeoTIFF or an .hgt of SRTM");
    fail_to_read();
  }

  void choose(int wanted) {
    const int count = GDALGetRasterCount(dataset_.get());
    if (wanted > count) {
      fail(fmt::format("band {}: the file has {}", wanted, count));
    }
    if (wanted == 0 && count != 1)
      fail(fmt::format("{} bands: expected one, or FILE@BAND that says which", count));
    band_ = std::max(wanted, 1);
  }

  void check_place() {
    const OGRSpatialReferenceH found = GDALGetSpatialRef(dataset_.get());
    if (GDALGetGeoTransform(dataset_.get(), place_.data()) != CE_None || found == nullptr)
      fail("no georeference: expected a GeoTIFF that says where it lies");
    srs_ = *OGRSpatialReference::FromHandle(found);
    srs_.StripVertical();
    srs_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    if (!srs_.IsGeographic() && !srs_.IsProjected()) {
      fail(fmt::format("coordinate system {}: expected latitude and longitude, or a projection",
                       srs_.GetName() == nullptr ? "without a name" : srs_.GetName()));
    }
    // What GDAL puts in the place of a datum that a file states by a code it does not know, or not
    // at all.
    const auto is_unnamed = [&](const char* node) {
      const char* const name = srs_.GetAttrValue(node);
      return name != nullptr && name == std::string_view("unnamed");
    };
    if (is_of_earth() && is_unnamed("DATUM") && is_unnamed("SPHEROID"))
      fail(fmt::format(
          "coordinate system {}: its datum is not known: expected a code that EPSG has, "
          "or a stated ellipsoid",
          srs_.GetName()));
    const double area = place_[1] * place_[5] - place_[2] * place_[4];
    if (!std::isfinite(area) || area == 0 || !std::isfinite(place_[0] + place_[3]))
      fail("georeference: expected cells of a size");
  }

  void check_values() {
    if (GDALDataTypeIsComplex(GDALGetRasterDataType(band())) != 0)
      fail("complex numbers: expected heights");
    if (GDALGetRasterColorInterpretation(band()) == GCI_PaletteIndex)
      fail("colours of a palette: expected heights");
    int width = 0, height = 0;
    GDALGetBlockSize(band(), &width, &height);
    if (std::int64_t{width} * height * GDALGetDataTypeSizeBytes(GDALGetRasterDataType(band())) >
        kMostBlockBytes)
      fail(fmt::format("tiles of {} x {} cells: expected at most 256 MiB", width, height));
    const double unit = unit_m();
    int stated = 0;
    const double scale = GDALGetRasterScale(band(), &stated);
    scale_ = unit * (stated != 0 ? scale : 1);
    const double offset = GDALGetRasterOffset(band(), &stated);
    offset_ = unit * (stated != 0 ? offset : 0);
  }

  double unit_m() const {
    struct Unit {
      std::string_view name;
      double metres;
    };
    // The foot is that of 1959, the older one of surveys in the United States 1200/3937 m.
    constexpr Unit kUnits[] = {{"", 1},          {"m", 1},
                               {"metre", 1},     {"meter", 1},
                               {"metres", 1},    {"meters", 1},
                               {"ft", 0.3048},   {"foot", 0.3048},
                               {"feet", 0.3048}, {"dm", 0.1},
                               {"cm", 0.01},     {"US survey foot", 1200.0 / 3937},
                               {"km", 1000},     {"us-ft", 1200.0 / 3937}};
    const std::string name = GDALGetRasterUnitType(band());
    const auto found = std::ranges::find(kUnits, std::string_view(name), &Unit::name);
    if (found == std::end(kUnits)) fail(fmt::format("heights in \"{}\": expected m or ft", name));
    return found->metres;
  }

  void expect_few(std::int64_t across, std::int64_t down, std::int64_t most) const {
    if (across <= 0 || down <= 0) fail("georeference: expected a place in latitude and longitude");
    if (across <= most / down) return;
    fail(fmt::format("{} x {} cells: expected at most {} in all", across, down, most));
  }

  bool is_of_earth() const {
    constexpr double kNear = 0.01;  // of the radius: any ellipsoid of the Earth
    return std::abs(srs_.GetSemiMajor() / SRS_WGS84_SEMIMAJOR - 1) < kNear;
  }

  OGRSpatialReference geographic() const {
    OGRSpatialReference target;
    if (is_of_earth()) {
      target.importFromEPSG(4326);
    } else {
      const std::unique_ptr<OGRSpatialReference> own(srs_.CloneGeogCS());
      target = *own;
    }
    target.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return target;
  }

  bool is_on_grid(const OGRSpatialReference& target) const {
    return srs_.IsGeographic() && srs_.IsSame(&target) && place_[2] == 0 && place_[4] == 0 &&
           place_[1] > 0 && place_[5] < 0;
  }

  Dataset resampled(const OGRSpatialReference& target, std::int64_t most_cells) const {
    const std::string from = wkt(srs_), to = wkt(target);
    const std::string source = "SRC_SRS=" + from, destination = "DST_SRS=" + to;
    const char* const options[] = {source.c_str(), destination.c_str(), nullptr};
    const std::unique_ptr<void, void (*)(void*)> transformer(
        GDALCreateGenImgProjTransformer2(dataset_.get(), nullptr, const_cast<char**>(options)),
        GDALDestroyGenImgProjTransformer);
    GeoTransform place{};
    int across = 0, down = 0;
    if (!transformer ||
        GDALSuggestedWarpOutput(dataset_.get(), GDALGenImgProjTransform, transformer.get(),
                                place.data(), &across, &down) != CE_None)
      fail_to_read();
    expect_few(across, down, most_cells);
    Dataset made(GDALCreate(GDALGetDriverByName("MEM"), "", across, down, 1, GDT_Float32, nullptr));
    if (!made) fail_to_read();
    GDALSetGeoTransform(made.get(), place.data());
    GDALSetProjection(made.get(), to.c_str());
    GDALSetRasterNoDataValue(GDALGetRasterBand(made.get(), 1), kNoData);
    const std::unique_ptr<GDALWarpOptions, void (*)(GDALWarpOptions*)> warp(GDALCreateWarpOptions(),
                                                                            GDALDestroyWarpOptions);
    warp->nBandCount = 1;
    warp->panSrcBands = static_cast<int*>(CPLMalloc(sizeof(int)));
    warp->panDstBands = static_cast<int*>(CPLMalloc(sizeof(int)));
    warp->panSrcBands[0] = band_;
    warp->panDstBands[0] = 1;
    warp->papszWarpOptions = CSLSetNameValue(warp->papszWarpOptions, "INIT_DEST", "NO_DATA");
    warp->papszWarpOptions = CSLSetNameValue(warp->papszWarpOptions, "NUM_THREADS", "ALL_CPUS");
    constexpr double kWarpBytes = 256e6, kWarpError = 0.05;  // cells
    if (GDALReprojectImage(dataset_.get(), from.c_str(), made.get(), to.c_str(), GRA_Bilinear,
                           kWarpBytes, kWarpError, nullptr, nullptr, warp.get()) != CE_None)
      fail_to_read();
    return made;
  }

  static std::string wkt(const OGRSpatialReference& srs) {
    char* text = nullptr;
    srs.exportToWkt(&text);
    const std::string copy = text == nullptr ? "" : text;
    CPLFree(text);
    return copy;
  }

  DemCells read(GDALDatasetH dataset, int band) const {
    DemCells cells;
    cells.columns = GDALGetRasterXSize(dataset);
    cells.rows = GDALGetRasterYSize(dataset);
    GeoTransform place{};
    GDALGetGeoTransform(dataset, place.data());
    cells.west_deg = place[0];
    cells.north_deg = place[3];
    cells.column_deg = place[1];
    cells.row_deg = -place[5];
    check_extent(cells);
    read_heights(GDALGetRasterBand(dataset, band), cells);
    return cells;
  }

  void check_extent(const DemCells& cells) const {
    const double south = cells.north_deg - cells.rows * cells.row_deg;
    const double width = cells.columns * cells.column_deg;
    if (cells.north_deg > 90 + cells.row_deg || south < -90 - cells.row_deg)
      fail(fmt::format("latitudes {:.6g} to {:.6g} deg: expected -90 to 90", south,
                       cells.north_deg));
    if (width > 360 + cells.column_deg || std::abs(cells.west_deg) > 720)
      fail(fmt::format("longitudes {:.6g} to {:.6g} deg: expected at most once around",
                       cells.west_deg, cells.west_deg + width));
  }

  void read_heights(GDALRasterBandH from, DemCells& cells) const {
    const auto across = static_cast<std::size_t>(cells.columns);
    cells.heights_m.resize(across * static_cast<std::size_t>(cells.rows));
    const GDALRasterBandH mask = GDALGetMaskBand(from);
    std::vector<std::uint8_t> valid(across);
    bool any = false;
    for (int row = 0; row < cells.rows; ++row) {
      float* const heights = &cells.heights_m[static_cast<std::size_t>(row) * across];
      if (GDALRasterIO(from, GF_Read, 0, row, cells.columns, 1, heights, cells.columns, 1,
                       GDT_Float32, 0, 0) != CE_None ||
          GDALRasterIO(mask, GF_Read, 0, row, cells.columns, 1, valid.data(), cells.columns, 1,
                       GDT_Byte, 0, 0) != CE_None)
        fail_to_read();
      for (std::size_t i = 0; i < across; ++i) {
        if (valid[i] == 0 || std::isnan(heights[i])) {
          heights[i] = kNoData;
          continue;
        }
        any = true;
        heights[i] = static_cast<float>(scale_ * heights[i] + offset_);
        if (std::abs(heights[i]) <= kHighest) continue;
        fail(
            fmt::format("{:.9g} m in column {} of row {}: expected heights within 25 km, or a "
                        "no-data value that the file states",
                        heights[i], i, row));
      }
    }
    if (!any) fail("no data in any cell: expected heights");
  }

  fs::path file_;
  Dataset dataset_;
  int band_ = 1;
  GeoTransform place_{};
  OGRSpatialReference srs_;
  double scale_ = 1, offset_ = 0;  // to metres
};

std::string library() { return fmt::format("GDAL {}", GDALVersionInfo("RELEASE_NAME")); }

DemCells read(const fs::path& file, int band, int fewest_on_a_side, std::int64_t most_cells) {
  const Session session;
  return Source(file, band).cells(fewest_on_a_side, most_cells);
}

[[noreturn]] void fail_in_memory() {
  throw std::runtime_error(std::string("GDAL: ") + CPLGetLastErrorMsg());
}

Dataset in_memory(int columns, int rows, GDALDataType type) {
  Dataset made(GDALCreate(GDALGetDriverByName("MEM"), "", columns, rows, 1, type, nullptr));
  if (!made) fail_in_memory();
  return made;
}

std::vector<float> distances(int columns, int rows, const std::vector<std::uint8_t>& known,
                             double most) {
  const Session session;
  const Dataset targets = in_memory(columns, rows, GDT_Byte);
  const Dataset far = in_memory(columns, rows, GDT_Float32);
  const GDALRasterBandH from = GDALGetRasterBand(targets.get(), 1);
  const GDALRasterBandH result = GDALGetRasterBand(far.get(), 1);
  std::vector<float> made(known.size());
  const std::string reach = fmt::format("MAXDIST={:.9g}", most);
  const std::string beyond = fmt::format("NODATA={:.9g}", 2 * most + 1);
  const char* const options[] = {"VALUES=1", "DISTUNITS=PIXEL", reach.c_str(), beyond.c_str(),
                                 nullptr};
  if (GDALRasterIO(from, GF_Write, 0, 0, columns, rows, const_cast<std::uint8_t*>(known.data()),
                   columns, rows, GDT_Byte, 0, 0) != CE_None ||
      GDALComputeProximity(from, result, const_cast<char**>(options), nullptr, nullptr) !=
          CE_None ||
      GDALRasterIO(result, GF_Read, 0, 0, columns, rows, made.data(), columns, rows, GDT_Float32, 0,
                   0) != CE_None)
    fail_in_memory();
  return made;
}

}  // namespace
}  // namespace skyfit

extern "C" __attribute__((visibility("default"))) const void* skyfit_dem_module() {
  static constexpr skyfit::DemModule kModule = {skyfit::DemModule::kRevision, skyfit::library,
                                                skyfit::read, skyfit::distances};
  return &kModule;
}
