// SPDX-License-Identifier: Apache-2.0
// data_refs/preset.schema.json and the reader of presets agree: on every shipped preset and every
// example of docs/preset.md, on each of these with any field missing, with an unknown one in any
// object, and with any number replaced; and the examples hold every field of the schema.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "data_refs/references.h"
#include "model/atmosphere/preset.h"
#include "tests/data_refs/complaint.h"
#include "tests/data_refs/json_schema.h"

namespace skyfit::refs {
namespace {

using nlohmann::json;

const json& schema() {
  static const json parsed = json::parse(preset_schema_json());
  return parsed;
}

// In the place of the CSVs that an example names.
TwoColumns some_table(const std::filesystem::path&, const TableFormat&) {
  return {{0, 1000}, {1, 0.5}};
}

std::string complaint(const json& preset) {
  return complaint_of([&] { parse_preset(preset.dump(), "preset", some_table); });
}
bool is_accepted(const json& preset) { return complaint(preset) == "accepted"; }
bool fits_schema(const json& preset) { return is_valid(preset, schema(), schema()); }

// The first example is a whole preset, the others hold fields that take the place of its own.
std::vector<json> examples() {
  std::ifstream file(SKYFIT_DOCS "preset.md");
  std::ostringstream text;
  text << file.rdbuf();
  constexpr std::string_view kBegin = "```json\n", kEnd = "```";
  std::vector<json> list;
  std::string rest = text.str();
  for (std::size_t at; (at = rest.find(kBegin)) != std::string::npos;) {
    rest = rest.substr(at + kBegin.size());
    json example = list.empty() ? json::object() : list.front();
    example.update(json::parse(rest.substr(0, rest.find(kEnd))));
    list.push_back(example);
  }
  return list;
}

std::vector<json> shipped_of_version_2() {
  std::vector<json> list;
  for (const std::string& name : shipped_preset_names()) {
    json preset = json::parse(shipped_preset_json(name));
    if (preset.at("skyfit_preset") == 2) list.push_back(std::move(preset));
  }
  return list;
}

// Pointers to all values of a document that `wanted` accepts, but for those inside "fit", which is
// as it is.
template <class Wanted>
std::vector<json::json_pointer> places(const json& document, const Wanted& wanted) {
  std::vector<json::json_pointer> found;
  const std::function<void(const json&, const json::json_pointer&)> visit =
      [&](const json& value, const json::json_pointer& at) {
        if (wanted(value)) found.push_back(at);
        if (!value.is_structured() || at.to_string() == "/fit") return;
        // Of a table, its first numbers stand for all.
        std::size_t i = 0;
        for (const auto& [key, item] : value.items()) {
          if (value.is_array() && !item.is_object() && i > 1) break;
          visit(item, value.is_array() ? at / i : at / key);
          ++i;
        }
      };
  visit(document, json::json_pointer());
  return found;
}

TEST(PresetSchema, ShippedPresetsAndExamplesFitItAndAreRead) {
  ASSERT_GE(examples().size(), 9u);
  for (const json& preset : examples()) {
    EXPECT_TRUE(fits_schema(preset)) << preset;
    EXPECT_EQ(complaint(preset), "accepted") << preset;
  }
  for (const json& preset : shipped_of_version_2())
    EXPECT_TRUE(fits_schema(preset)) << preset.at("name");
}

TEST(PresetSchema, WhatIsWrittenFitsIt) {
  for (const std::string& name : shipped_preset_names()) {
    const Preset preset = parse_preset(shipped_preset_json(name), name);
    EXPECT_TRUE(fits_schema(json::parse(preset_to_json(preset)))) << name;
  }
}

TEST(PresetSchema, KnowsWhichFieldsMustBeThere) {
  for (const json& preset : examples()) {
    for (const auto& place : places(preset, [](const json&) { return true; })) {
      if (place.empty() || place.back().find_first_not_of("0123456789") == std::string::npos)
        continue;
      json without = preset;
      without.at(place.parent_pointer()).erase(place.back());
      // "of" may name what is left out, and a missing exponent leaves the amount without a law.
      EXPECT_EQ(fits_schema(without), is_accepted(without))
          << place << ": " << complaint(without) << preset.at("constituents");
    }
  }
}

TEST(PresetSchema, KnowsNoFieldsThatTheReaderDoesNot) {
  for (const json& preset : examples()) {
    for (const auto& place : places(preset, [](const json& v) { return v.is_object(); })) {
      if (place.to_string() == "/fit") continue;
      json with = preset;
      with.at(place)["unknown"] = 1;
      EXPECT_FALSE(fits_schema(with)) << place;
      EXPECT_FALSE(is_accepted(with)) << place;
    }
  }
}

TEST(PresetSchema, RefusesNoNumberThatTheReaderTakes) {
  for (const json& preset : examples()) {
    for (const auto& place : places(preset, [](const json& v) { return v.is_number(); })) {
      if (place.to_string().starts_with("/fit")) continue;
      for (const double value : {-1e12, -1.0, -0.9995, -0.5, 0.0, 1e-9, 1e-4, 0.5, 1.0, 1.5, 20.0,
                                 1e3, 1e5, 1e6, 1e7, 1e9, 1e12}) {
        json with = preset;
        with.at(place) = value;
        EXPECT_TRUE(fits_schema(with) || !is_accepted(with)) << place << " = " << value;
      }
    }
  }
}

// Names of all properties in a schema.
void collect_properties(const json& value, std::set<std::string>& names) {
  if (!value.is_structured()) return;
  for (const auto& [key, item] : value.items()) {
    if (key == "properties") {
      for (const auto& property : item.items()) names.insert(property.key());
    }
    collect_properties(item, names);
  }
}
void collect_keys(const json& value, std::set<std::string>& names) {
  if (!value.is_structured()) return;
  for (const auto& [key, item] : value.items()) {
    if (value.is_object()) names.insert(key);
    collect_keys(item, names);
  }
}

TEST(PresetSchema, ExamplesHoldEveryFieldOfIt) {
  std::set<std::string> in_schema, in_examples;
  collect_properties(schema(), in_schema);
  for (const json& preset : examples()) collect_keys(preset, in_examples);
  for (const std::string& name : in_schema) EXPECT_TRUE(in_examples.contains(name)) << name;
}

}  // namespace
}  // namespace skyfit::refs
