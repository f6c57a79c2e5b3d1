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

// Of the page's tables; packing rounds them, which the errors include.
inline constexpr Packing kScatteringPacking{.step = 1.0 / 160, .row = kPageSizes.scattering_mu_s};

struct SliderTables {
  PageSlider slider;
  std::vector<AtmosphereTables> changes;  // at slider.tabulated(), see render/page/changes.h
  double tabulated_error = 0, half_way_error = 0;  // as in SkyPageErrors
};

struct PageTables {
  AtmosphereTables tables;  // of kPageSizes, the scattering tables as the page decodes them
  std::array<double, kComparedAltitudes_m.size()> errors{};
  std::vector<SliderTables> sliders;
};

// Throws as sky_page() does.
PageTables page_tables(const SkyPageRequest& request);

}  // namespace skyfit
