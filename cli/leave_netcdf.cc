// SPDX-License-Identifier: Apache-2.0
#include "cli/leave_netcdf.h"

#include "cli/output.h"

namespace skyfit::cli {

void leave_netcdf(const std::string& file, fit::NetcdfFile content) {
  content.attributes.emplace_back("history", command_line());
  fit::write_netcdf(file, content);
}

}  // namespace skyfit::cli
