// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/preset_tables.h"

#include <fmt/format.h>

namespace skyfit {

TwoColumns PresetTables::read_columns(const PresetReader& object, const TableFormat& format) const {
  const auto& [x, y] = format.columns;
  if (!object.has("csv")) {
    object.expect_only({"type", "csv", x, y});
    return {object.numbers(x), object.numbers(y)};
  }
  object.expect_only({"type", "csv"});
  const std::string file = object.text("csv");
  if (!reader_) object.fail_value("csv", fmt::format("{} and {} instead of a file", x, y));
  const auto path = named_file(folder_, file, named_);
  if (!path) object.fail_value("csv", kNamedFile);
  return reader_(*path, format);
}

nlohmann::ordered_json table_to_json(const TwoColumns& table, const TableFormat& format) {
  const auto& [x, y] = format.columns;
  return {{"type", kTabulated}, {std::string(x), table.x}, {std::string(y), table.y}};
}

}  // namespace skyfit
