// SPDX-License-Identifier: Apache-2.0
#include "fit/campaign/toml_document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "model/base/text.h"

namespace skyfit::fit {
namespace {

class Converter {
 public:
  explicit Converter(std::string_view source) : source_(source) {}

  nlohmann::json converted(const toml::node& node, const std::string& path) {
    if (!path.empty()) lines_.emplace(path, static_cast<int>(node.source().begin.line));
    if (const toml::table* const table = node.as_table()) {
      nlohmann::json object = nlohmann::json::object();
      for (const auto& [key, value] : *table) {
        const std::string name(key.str());
        object[name] = converted(value, (path.empty() ? "" : path + ".") + excerpt(name));
      }
      return object;
    }
    if (const toml::array* const array = node.as_array()) {
      nlohmann::json list = nlohmann::json::array();
      for (const toml::node& value : *array)
        list.push_back(converted(value, fmt::format("{}[{}]", path, list.size())));
      return list;
    }
    if (const auto* const text = node.as_string()) return text->get();
    if (const auto* const flag = node.as_boolean()) return flag->get();
    if (const auto* const whole = node.as_integer()) return whole->get();
    if (const auto* const number = node.as_floating_point(); number && std::isfinite(number->get()))
      return number->get();
    throw std::invalid_argument(
        fmt::format("{}:{}: {}: expected a text in quotes, a finite number, true or false", source_,
                    node.source().begin.line, path));
  }

  PresetDocument::Lines take_lines() { return std::move(lines_); }

 private:
  std::string source_;
  PresetDocument::Lines lines_;
};

}  // namespace

PresetDocument toml_document(std::string_view text, std::string_view source) {
  try {
    Converter converter(source);
    nlohmann::json value = converter.converted(toml::parse(text), "");
    return PresetDocument::of_value(std::move(value), source, converter.take_lines());
  } catch (const toml::parse_error& error) {
    throw std::invalid_argument(fmt::format("{}:{}: expected TOML, got {}", source,
                                            error.source().begin.line,
                                            excerpt(std::string(error.description()))));
  }
}

}  // namespace skyfit::fit
