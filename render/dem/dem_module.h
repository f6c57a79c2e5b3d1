// SPDX-License-Identifier: Apache-2.0
// What regional_map.cc calls in skyfit_dem_module (model/base/module_file.h), the part of render/
// that loads GDAL. Digital elevation models are read from GeoTIFF (OGC 19-008r4) and from the .hgt
// of the Shuttle Radar Topography Mission (SRTM User Guide, 2015), and from nothing else.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace skyfit {

// Heights on a grid of latitude and longitude, north up. On Earth these are those of WGS 84
// (EPSG:4326), on other bodies those of the file's own sphere or ellipsoid.
struct DemCells {
  int columns = 0, rows = 0;
  double west_deg = 0, north_deg = 0;  // the outer corner of the first cell
  double column_deg = 0, row_deg = 0;  // the size of a cell, > 0
  std::vector<float> heights_m;        // [row][column], NaN: no data
};

struct DemModule {
  static constexpr int kRevision = 1;
  int revision;
  std::string (*library)();  // name and version
  // `band` counts from 1; 0: the only one. Other grids than that of DemCells are resampled
  // bilinearly to about the same size of cells. Throws std::runtime_error in one line that names
  // the file, what was found and what was expected: no such format or band, no georeference,
  // colours, a unit that is no length, heights beyond +-25 km, no data at all, more than
  // `most_cells` or fewer than that on a side.
  DemCells (*read)(const std::filesystem::path& file, int band, int fewest_on_a_side,
                   std::int64_t most_cells);
  // Of each cell from the nearest one that is 1 in `known` ([row][column], 0 or 1), in cells; where
  // there is none within `most`: more than `most`.
  std::vector<float> (*distances)(int columns, int rows, const std::vector<std::uint8_t>& known,
                                  double most);
};

}  // namespace skyfit

// The module's only symbol.
extern "C" const void* skyfit_dem_module();
