// SPDX-License-Identifier: Apache-2.0
// Tables in a preset: an object with "type": "tabulated" that holds the two columns itself, or the
// name of a CSV that does. A preset that is written always holds them.
#pragma once

#include <memory>

#include "model/atmosphere/table_format.h"
#include "model/base/input_file.h"
#include "model/base/preset_reader.h"

namespace skyfit {

inline constexpr std::string_view kTabulated = "tabulated";

// The tables of one preset: CSV names are relative to the preset's folder.
class PresetTables {
 public:
  // Without a reader a preset that names a CSV is refused.
  PresetTables(std::filesystem::path folder, const TableReader& reader, NamedFiles named)
      : folder_(std::move(folder)), reader_(reader), named_(named) {}

  // Table is LinearProfile or TabulatedPhase.
  template <class Table>
  std::shared_ptr<const Table> read(const PresetReader& object, const TableFormat& format) const {
    return read_with(object, format, [](const TwoColumns& columns) {
      return std::make_shared<const Table>(columns);
    });
  }
  // The same with another way to make the table.
  template <class Make>
  auto read_with(const PresetReader& object, const TableFormat& format, const Make& make) const {
    const TwoColumns columns = read_columns(object, format);
    return object.complaining([&] { return make(columns); });
  }

 private:
  TwoColumns read_columns(const PresetReader& object, const TableFormat& format) const;

  std::filesystem::path folder_;
  const TableReader& reader_;
  NamedFiles named_;
};

nlohmann::ordered_json table_to_json(const TwoColumns& table, const TableFormat& format);

}  // namespace skyfit
