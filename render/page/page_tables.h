// SPDX-License-Identifier: Apache-2.0
// What a page of a sky looks up: the tables of its atmosphere and the changes by its sliders, and
// how far both are from the model `reference`.
#pragma once

#include <array>
#include <vector>

#include "model/tables/tables.h"
#include "render/page/sky_page.h"
#include "render/page/table_packing.h"

namespace skyfit {

// Texels of a page's tables: as many as small ones have, with hardly any for rays from outside,
// which it looks up in the others. Where no layer is thick, fewer heights do, and the others stand
// for suns and azimuths; a lobe that is narrow for the reference has a third more texels.
TableSizes page_sizes(const Atmosphere<double>& atmosphere);

// Of the page's scattering tables; it rounds them, which the errors include.
Packing scattering_packing(const TableSizes& sizes);

struct SliderTables {
  PageSlider slider;
  std::vector<AtmosphereTables> changes;  // at slider.tabulated(), see render/page/changes.h
  double tabulated_error = 0, half_way_error = 0;  // as in SkyPageErrors
};

struct PageTables {
  AtmosphereTables tables;  // of page_sizes(), the scattering tables as the page decodes them
  std::array<WorstError, kComparedAltitudes_m.size()> errors{};
  std::vector<SliderTables> sliders;
};

// Throws as sky_page() does.
PageTables page_tables(const SkyPageRequest& request);

}  // namespace skyfit
