// SPDX-License-Identifier: Apache-2.0
#include "tests/data_refs/json_schema.h"

#include <algorithm>
#include <functional>
#include <map>
#include <regex>
#include <stdexcept>

namespace skyfit::refs {
namespace {

using nlohmann::json;

// One keyword: its argument, the value, the schema it stands in and the root.
using Keyword = std::function<bool(const json&, const json&, const json&, const json&)>;

bool has_type(const json& value, const std::string& type) {
  return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
         (type == "string" && value.is_string()) || (type == "number" && value.is_number()) ||
         (type == "boolean" && value.is_boolean());
}

std::ptrdiff_t count_valid(const json& value, const json& schemas, const json& root) {
  return std::ranges::count_if(schemas,
                               [&](const json& schema) { return is_valid(value, schema, root); });
}

bool known_properties_only(const json& value, const json& schema) {
  return !value.is_object() || std::ranges::all_of(value.items(), [&](const auto& item) {
    return schema.at("properties").contains(item.key());
  });
}

bool valid_properties(const json& properties, const json& value, const json& root) {
  return !value.is_object() || std::ranges::all_of(properties.items(), [&](const auto& item) {
    return !value.contains(item.key()) || is_valid(value.at(item.key()), item.value(), root);
  });
}

Keyword numbers(const std::function<bool(double, double)>& holds) {
  return [holds](const json& bound, const json& value, const json&, const json&) {
    return !value.is_number() || holds(value.get<double>(), bound.get<double>());
  };
}

Keyword sizes(const std::function<bool(std::size_t, std::size_t)>& holds) {
  return [holds](const json& bound, const json& value, const json&, const json&) {
    return !value.is_array() || holds(value.size(), bound.get<std::size_t>());
  };
}

const std::map<std::string, Keyword>& assertions() {
  static const std::map<std::string, Keyword> all = {
      {"type", [](auto& type, auto& value, auto&, auto&) { return has_type(value, type); }},
      {"const", [](auto& constant, auto& value, auto&, auto&) { return value == constant; }},
      {"enum", [](auto& values, auto& value, auto&,
                  auto&) { return std::ranges::count(values, value) > 0; }},
      {"minimum", numbers(std::greater_equal<>())},
      {"maximum", numbers(std::less_equal<>())},
      {"exclusiveMinimum", numbers(std::greater<>())},
      {"minItems", sizes(std::greater_equal<>())},
      {"maxItems", sizes(std::less_equal<>())},
      {"pattern",
       [](auto& pattern, auto& value, auto&, auto&) {
         return !value.is_string() ||
                std::regex_search(value.template get<std::string>(),
                                  std::regex(pattern.template get<std::string>()));
       }},
      {"required",
       [](auto& names, auto& value, auto&, auto&) {
         return !value.is_object() || std::ranges::all_of(names, [&](const json& name) {
           return value.contains(name.get<std::string>());
         });
       }},
      {"additionalProperties",
       [](auto& allowed, auto& value, auto& schema, auto&) {
         return allowed == true || known_properties_only(value, schema);
       }},
  };
  return all;
}

const std::map<std::string, Keyword>& applicators() {
  static const std::map<std::string, Keyword> all = {
      {"properties", [](auto& properties, auto& value, auto&,
                        auto& root) { return valid_properties(properties, value, root); }},
      {"items",
       [](auto& schema, auto& value, auto&, auto& root) {
         return !value.is_array() || std::ranges::all_of(value, [&](const json& item) {
           return is_valid(item, schema, root);
         });
       }},
      {"$ref",
       [](auto& name, auto& value, auto&, auto& root) {
         return is_valid(
             value, root.at(json::json_pointer(name.template get<std::string>().substr(1))), root);
       }},
      {"oneOf", [](auto& schemas, auto& value, auto&,
                   auto& root) { return count_valid(value, schemas, root) == 1; }},
      {"anyOf", [](auto& schemas, auto& value, auto&,
                   auto& root) { return count_valid(value, schemas, root) > 0; }},
      {"not",
       [](auto& schema, auto& value, auto&, auto& root) { return !is_valid(value, schema, root); }},
      {"if",
       [](auto& condition, auto& value, auto& schema, auto& root) {
         const char* const branch = is_valid(value, condition, root) ? "then" : "else";
         return !schema.contains(branch) || is_valid(value, schema.at(branch), root);
       }},
  };
  return all;
}

// Keywords that assert nothing on their own.
bool is_annotation(const std::string& keyword) {
  static const std::vector<std::string> names = {"$schema", "$defs", "title", "description",
                                                 "default", "then",  "else"};
  return std::ranges::count(names, keyword) > 0;
}

}  // namespace

bool is_valid(const json& value, const json& schema, const json& root) {
  for (const auto& [name, argument] : schema.items()) {
    if (is_annotation(name)) continue;
    const bool asserts = assertions().contains(name);
    if (!asserts && !applicators().contains(name))
      throw std::invalid_argument(name + ": no keyword that this knows");
    const Keyword& keyword = asserts ? assertions().at(name) : applicators().at(name);
    if (!keyword(argument, value, schema, root)) return false;
  }
  return true;
}

}  // namespace skyfit::refs
