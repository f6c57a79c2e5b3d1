// SPDX-License-Identifier: Apache-2.0
// The text of hosek_wilkie_2012_xyz.csv, which is compiled in.
#pragma once

#include <string_view>

namespace skyfit::literature {

std::string_view hosek_wilkie_table();

}  // namespace skyfit::literature
