// SPDX-License-Identifier: Apache-2.0
#include "model/base/preset_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "model/base/text.h"

namespace skyfit {
namespace {

using nlohmann::json;

// Hands characters to the parser and counts the lines that it has read, which the library does not
// tell.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* position, int* line) : position_(position), line_(line) {}
  reference operator*() const { return *position_; }
  CountingIterator& operator++() {
    if (*position_ == '\n') ++*line_;
    ++position_;
    return *this;
  }
  CountingIterator operator++(int) {
    const CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return position_ == other.position_; }

 private:
  const char* position_;
  int* line_;
};

// Follows the parser: where every field stands, and that no name comes twice in one object.
class FieldTracker {
 public:
  FieldTracker(std::string_view source, const int* line) : source_(source), line_(line) {}

  bool operator()(json::parse_event_t event, const json& parsed) {
    switch (event) {
      case json::parse_event_t::object_start:
        open(false);
        break;
      case json::parse_event_t::array_start:
        open(true);
        break;
      case json::parse_event_t::object_end:
      case json::parse_event_t::array_end:
        open_.pop_back();
        break;
      case json::parse_event_t::key:
        enter(parsed.get<std::string>());
        break;
      case json::parse_event_t::value:
        count_element();
        break;
    }
    return true;
  }

  PresetDocument::Lines take_lines() { return std::move(line_of_path_); }

 private:
  struct Level {
    bool is_array;
    int element = -1;  // of the array, being read
    std::string key;   // the field being read; empty in an array
    std::set<std::string> seen;
  };

  void open(bool is_array) {
    constexpr std::size_t kDeepest = 64;  // guards the stack: the library writes values recursively
    if (open_.size() == kDeepest) {
      throw std::invalid_argument(
          fmt::format("{}:{}: expected at most {} nested values", source_, *line_, kDeepest));
    }
    count_element();
    if (!open_.empty() && open_.back().is_array) line_of_path_.emplace(path(), *line_);
    open_.push_back({is_array, -1, {}, {}});
  }

  void count_element() {
    if (!open_.empty() && open_.back().is_array) ++open_.back().element;
  }

  // "keyframes[1].camera" while that is being read.
  std::string path() const {
    std::string result;
    for (const Level& level : open_) {
      if (level.is_array) {
        result += fmt::format("[{}]", level.element);
      } else if (!level.key.empty()) {
        result += (result.empty() ? "" : ".") + level.key;
      }
    }
    return result;
  }

  void enter(const std::string& key) {
    open_.back().key = excerpt(key);
    const std::string place = path();
    if (!open_.back().seen.insert(key).second) {
      throw std::invalid_argument(
          fmt::format("{}:{}: {}: expected once, found twice", source_, *line_, place));
    }
    line_of_path_.emplace(place, *line_);
  }

  std::string source_;
  const int* line_;
  std::vector<Level> open_;
  PresetDocument::Lines line_of_path_;
};

// What the library found, of its "[json.exception..] parse error at line 1, column 2: syntax error
// while parsing value - invalid literal; last read: 'nul'" or ".. - unexpected number literal;
// expected '}'".
std::string found_by_parser(std::string_view what) {
  constexpr std::string_view kLastRead = "last read: '", kUnexpected = "unexpected ";
  if (const std::size_t word = what.find(kLastRead); word != what.npos) {
    what.remove_prefix(word + kLastRead.size());
    return in_quotes(what.substr(0, what.rfind('\'')));  // of any length
  }
  const std::size_t word = what.find(kUnexpected);
  if (word == what.npos) return "something else";
  what.remove_prefix(word);
  return fmt::format("an {}", what.substr(0, what.find(';')));
}

}  // namespace

std::string json_excerpt(const json& value) {
  return excerpt(value.dump(-1, ' ', false, json::error_handler_t::replace));
}

PresetDocument::PresetDocument(std::string_view text, std::string_view source) : source_(source) {
  int line = 1;
  FieldTracker tracker(source, &line);
  try {
    json_ = json::parse(
        CountingIterator(text.data(), &line), CountingIterator(text.data() + text.size(), &line),
        [&](int, json::parse_event_t event, json& parsed) { return tracker(event, parsed); });
  } catch (const json::exception& error) {
    throw std::invalid_argument(
        fmt::format("{}:{}: expected JSON, got {}", source_, line, found_by_parser(error.what())));
  }
  line_of_path_ = tracker.take_lines();
  if (!json_.is_object()) {
    throw std::invalid_argument(
        fmt::format("{}: expected a JSON object, got {}", source_, json_excerpt(json_)));
  }
}

PresetDocument PresetDocument::of_value(json value, std::string_view source, Lines lines) {
  PresetDocument document;
  document.source_ = source;
  document.json_ = std::move(value);
  document.line_of_path_ = std::move(lines);
  return document;
}

PresetReader PresetDocument::root() const { return PresetReader(*this, json_, ""); }

std::string PresetDocument::place(std::string_view path) const {
  while (!path.empty()) {
    if (const auto found = line_of_path_.find(path); found != line_of_path_.end()) {
      return fmt::format("{}:{}", source_, found->second);
    }
    const std::size_t dot = path.rfind('.');
    path = path.substr(0, dot == std::string_view::npos ? 0 : dot);
  }
  return source_;
}

PresetReader::PresetReader(const PresetDocument& document, const json& value, std::string path)
    : document_(document), value_(value), path_(std::move(path)) {}

void PresetReader::expect_only(std::span<const std::string_view> fields) const {
  for (const auto& [name, ignored] : value_.items()) {
    if (std::find(fields.begin(), fields.end(), name) != fields.end()) continue;
    const std::string path = path_of(name);
    throw std::invalid_argument(fmt::format("{}: {}: unknown name, expected one of {}",
                                            document_.place(path), path, fmt::join(fields, ", ")));
  }
}

PresetReader PresetReader::object(std::string_view field) const {
  const json& found = member(field, "an object");
  if (!found.is_object()) fail_value(field, "an object");
  return PresetReader(document_, found, path_of(field));
}

std::vector<PresetReader> PresetReader::objects(std::string_view field) const {
  const json& found = member(field, "an array of objects");
  if (!found.is_array()) fail_value(field, "an array of objects");
  std::vector<PresetReader> readers;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::string element = fmt::format("{}[{}]", field, i);
    if (!found[i].is_object()) fail_value(field, "an array of objects");
    readers.emplace_back(document_, found[i], path_of(element));
  }
  return readers;
}

double PresetReader::number(std::string_view field) const {
  const json& found = member(field, "a number");
  if (!found.is_number()) fail_value(field, "a number");
  return found.get<double>();
}

bool PresetReader::is_null(std::string_view field) const {
  return member(field, "a value or null").is_null();
}

double PresetReader::number_or_nan(std::string_view field) const {
  const json& found = member(field, "a number or null");
  if (found.is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (!found.is_number()) fail_value(field, "a number or null");
  return found.get<double>();
}

std::vector<double> PresetReader::numbers(std::string_view field) const {
  const json& found = member(field, "an array of numbers");
  const auto is_number = [](const json& value) { return value.is_number(); };
  if (!found.is_array() || !std::all_of(found.begin(), found.end(), is_number)) {
    fail_value(field, "an array of numbers");
  }
  return found.get<std::vector<double>>();
}

std::vector<std::vector<double>> PresetReader::rows(std::string_view field) const {
  const json& found = member(field, "an array of arrays of numbers");
  const auto is_row = [](const json& row) {
    return row.is_array() &&
           std::ranges::all_of(row, [](const json& value) { return value.is_number(); });
  };
  if (!found.is_array() || !std::ranges::all_of(found, is_row))
    fail_value(field, "an array of arrays of numbers");
  return found.get<std::vector<std::vector<double>>>();
}

std::string PresetReader::text(std::string_view field) const {
  const json& found = member(field, "a text");
  if (!found.is_string()) fail_value(field, "a text");
  return found.get<std::string>();
}

bool PresetReader::flag(std::string_view field) const {
  const json& found = member(field, "true or false");
  if (!found.is_boolean()) fail_value(field, "true or false");
  return found.get<bool>();
}

std::vector<std::string> PresetReader::texts(std::string_view field) const {
  const json& found = member(field, "an array of texts");
  const auto is_text = [](const json& value) { return value.is_string(); };
  if (!found.is_array() || !std::ranges::all_of(found, is_text))
    fail_value(field, "an array of texts");
  return found.get<std::vector<std::string>>();
}

std::string PresetReader::place(std::string_view field) const {
  const std::string path = path_of(field);
  return fmt::format("{}: {}", document_.place(path), path);
}

void PresetReader::fail_value(std::string_view field, std::string_view expectation) const {
  throw std::invalid_argument(fmt::format("{} = {}: expected {}", place(field),
                                          json_excerpt(value_.at(std::string(field))),
                                          expectation));
}

void PresetReader::fail_missing(std::string_view expectation) const {
  throw std::invalid_argument(
      fmt::format("{}: {}: missing: expected {}", document_.place(path_), path_, expectation));
}

// A path ends before the first space, bracket or colon.
void PresetReader::fail_inside(std::string_view message) const {
  const std::string path = path_of(message.substr(0, message.find_first_of(" [:")));
  throw std::invalid_argument(fmt::format("{}: {}", document_.place(path), path_of(message)));
}

std::string PresetReader::path_of(std::string_view field) const {
  return path_.empty() ? excerpt(field) : fmt::format("{}.{}", path_, excerpt(field));
}

const json& PresetReader::member(std::string_view field, std::string_view expectation) const {
  const auto found = value_.find(field);
  if (found != value_.end()) return *found;
  const std::string path = path_of(field);
  throw std::invalid_argument(
      fmt::format("{}: {}: missing, expected {}", document_.place(path), path, expectation));
}

}  // namespace skyfit
