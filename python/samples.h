// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "data_refs/samples.h"
#include "python/arrays.h"

namespace skyfit::python {

// Name and array of every quantity of the samples, one element a sample; sigma is NaN where none is
// stated.
py::dict arrays_of(const refs::Reference& reference);

// Keywords of read().
std::vector<std::string> reading_options();

}  // namespace skyfit::python
