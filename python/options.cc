// SPDX-License-Identifier: Apache-2.0
#include "python/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace skyfit::python {
namespace {

std::string option_name(std::string keyword) {
  std::ranges::replace(keyword, '_', '-');
  return "--" + keyword;
}

std::string keyword_of(const CLI::Option& option) {
  std::string name = option.get_lnames().front();
  std::ranges::replace(name, '-', '_');
  return name;
}

}  // namespace

std::vector<std::string> keywords(const CLI::App& command,
                                  const std::map<std::string, std::string>& refused) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = keyword_of(*option);
    if (name != "help" && !refused.contains(name)) names.push_back(name);
  }
  return names;
}

void parse(CLI::App& command, std::string_view call, const Options& options,
           const std::map<std::string, std::string>& refused) {
  std::vector<std::string> words;
  for (const auto& [keyword, values] : options) {
    if (const auto no = refused.find(keyword); no != refused.end())
      throw std::invalid_argument(fmt::format("{}(): {}: {}", call, keyword, no->second));
    const CLI::Option* option = command.get_option_no_throw(option_name(keyword));
    if (option == nullptr || keyword == "help") {
      throw std::invalid_argument(fmt::format("{}(): {}: expected one of the options {}", call,
                                              keyword,
                                              fmt::join(keywords(command, refused), ", ")));
    }
    const bool is_flag = option->get_items_expected_max() == 0;
    if (is_flag != values.empty()) {
      throw std::invalid_argument(fmt::format("{}(): {}: expected {}", call, keyword,
                                              is_flag ? "True or False" : "a value"));
    }
    const bool may_repeat = option->get_items_expected_max() > 1;
    if (is_flag) {
      words.push_back(option_name(keyword));
    } else if (may_repeat) {
      for (const std::string& value : values)
        words.push_back(fmt::format("{}={}", option_name(keyword), value));
    } else {
      words.push_back(fmt::format("{}={}", option_name(keyword), fmt::join(values, ",")));
    }
  }
  std::ranges::reverse(words);  // as CLI11 wants them
  try {
    command.parse(words);
  } catch (const CLI::ConversionError& error) {
    throw std::invalid_argument(std::string(error.what()) + ": expected a whole number");
  } catch (const CLI::ParseError& error) {
    throw std::invalid_argument(error.what());
  }
}

}  // namespace skyfit::python
