// SPDX-License-Identifier: Apache-2.0
// Tables that are kept from one process to the next.
#pragma once

#include <functional>
#include <string_view>

#include "model/base/content_cache.h"
#include "model/tables/tables.h"

namespace skyfit {

// All that tables follow from beside the program: the arguments of compute_tables_of() and the name
// that its model was made by.
struct TableInputs {
  std::string_view model;
  TableLight light;
  const Atmosphere<double>& atmosphere;
  const ColorRule& color;
  TableSizes sizes;
};

// What `compute` returns for the inputs, bit by bit, from the cache where it has them; else it is
// called and the cache has them from then on.
AtmosphereTables cached_tables(ContentCache& cache, const TableInputs& inputs,
                               const std::function<AtmosphereTables()>& compute);

}  // namespace skyfit
