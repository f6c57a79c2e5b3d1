// SPDX-License-Identifier: Apache-2.0
// Strict reading of a JSON document: every complaint is one std::invalid_argument of one line that
// names the source, the line, the full path of the field, its value and what was expected.
// Duplicate names are an error too.
#pragma once

#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit {

class PresetReader;

// A value as it stands in the file, short enough for a message (text.h).
std::string json_excerpt(const nlohmann::json& value);

class PresetDocument {
 public:
  PresetDocument(std::string_view text, std::string_view source);
  // Where fields stand, by their paths.
  using Lines = std::map<std::string, int, std::less<>>;
  // A value that something else has read. Without lines messages name fields alone.
  static PresetDocument of_value(nlohmann::json value, std::string_view source, Lines lines = {});

  // The outermost object; lives as long as the document.
  PresetReader root() const;

  // `source:line` of the field with that path, or of its nearest enclosing one.
  std::string place(std::string_view path) const;

 private:
  PresetDocument() = default;

  std::string source_;
  nlohmann::json json_;
  Lines line_of_path_;
};

// One object of the document and the path that leads to it, such as "keyframes[1].camera".
class PresetReader {
 public:
  PresetReader(const PresetDocument& document, const nlohmann::json& value, std::string path);

  const nlohmann::json& value() const { return value_; }
  bool has(std::string_view field) const { return value_.contains(field); }

  // Refuses fields that are not in the list.
  void expect_only(std::span<const std::string_view> fields) const;
  void expect_only(std::initializer_list<std::string_view> fields) const {
    expect_only(std::span(fields.begin(), fields.size()));
  }

  PresetReader object(std::string_view field) const;
  std::vector<PresetReader> objects(std::string_view field) const;  // of an array
  bool has_object(std::string_view field) const {
    return has(field) && value_.at(std::string(field)).is_object();
  }
  double number(std::string_view field) const;
  bool is_null(std::string_view field) const;
  double number_or_nan(std::string_view field) const;  // null is not a number
  std::vector<double> numbers(std::string_view field) const;
  std::vector<std::vector<double>> rows(std::string_view field) const;  // an array of arrays
  std::string text(std::string_view field) const;
  bool flag(std::string_view field) const;
  std::vector<std::string> texts(std::string_view field) const;

  // The result of `make`, which may throw std::invalid_argument with a message that begins with a
  // path inside this object: source, line and this object's path are put before it.
  template <class Make>
  auto complaining(Make make) const {
    try {
      return make();
    } catch (const std::invalid_argument& error) {
      fail_inside(error.what());
    }
  }

  // `source:line: path` of a field that is there.
  std::string place(std::string_view field) const;

  [[noreturn]] void fail_value(std::string_view field, std::string_view expectation) const;
  // Something that may have one of several names is missing.
  [[noreturn]] void fail_missing(std::string_view expectation) const;

 private:
  [[noreturn]] void fail_inside(std::string_view message) const;
  std::string path_of(std::string_view field) const;
  const nlohmann::json& member(std::string_view field, std::string_view expectation) const;

  const PresetDocument& document_;
  const nlohmann::json& value_;
  std::string path_;  // empty for the root
};

}  // namespace skyfit
