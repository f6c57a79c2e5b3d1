// SPDX-License-Identifier: Apache-2.0
#include "data_refs/radiance_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string>

#include "data_refs/csv.h"

namespace skyfit::refs::radiance {
namespace {

class Parser {
 public:
  Parser(const Scene& scene, std::string_view source) : words_(scene.words), source_(source) {}

  std::vector<Primitive> primitives() {
    std::vector<Primitive> result;
    while (at_ < words_.size()) {
      Primitive p;
      p.line = words_[at_].line;
      if (words_[at_].text.starts_with('!'))
        fail_at(source_, p.line, "a command: expected the scene that it writes");
      p.modifier = next("a modifier").text;
      if (const auto alias = aliases_.find(p.modifier); alias != aliases_.end())
        p.modifier = alias->second;
      p.type = next("a type").text;
      p.name = next("an identifier").text;
      if (p.type == "alias") {  // a further name of a modifier
        const std::string target = next("the name of a modifier").text;
        const auto alias = aliases_.find(target);
        aliases_[p.name] = alias != aliases_.end() ? alias->second : target;
        continue;
      }
      for (int i = count("strings"); i > 0; --i) p.strings.push_back(next("a string").text);
      for (int i = count("integers"); i > 0; --i) number("an integer");
      for (int i = count("numbers"); i > 0; --i) p.reals.push_back(number("a number"));
      result.push_back(std::move(p));
    }
    return result;
  }

 private:
  const Word& next(std::string_view expected) {
    if (at_ == words_.size())
      fail_at(source_, words_.empty() ? 1 : words_.back().line,
              fmt::format("the scene ends: expected {}", expected));
    return words_[at_++];
  }

  double number(std::string_view expected) {
    const Word& word = next(expected);
    const std::optional<double> value = csv_number(word.text);
    if (!value || !std::isfinite(*value))
      fail_at(source_, word.line, fmt::format("\"{}\": expected {}", word.text, expected));
    return *value;
  }

  int count(std::string_view of) {
    constexpr double kMost = 1000;
    const Word& word = next(fmt::format("how many {}", of));
    const std::optional<double> value = csv_number(word.text);
    if (!value || !(*value >= 0 && *value <= kMost && *value == std::floor(*value)))
      fail_at(source_, word.line, fmt::format("\"{}\": expected how many {}", word.text, of));
    return static_cast<int>(*value);
  }

  const std::vector<Word>& words_;
  std::string_view source_;
  std::map<std::string, std::string> aliases_;
  std::size_t at_ = 0;
};

}  // namespace

Scene scene_of(std::string_view text) {
  Scene scene;
  std::istringstream in{std::string(text)};
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::size_t hash = line.find('#');
    if (hash != std::string::npos) scene.comments.push_back({line.substr(hash), number});
    std::istringstream words(line.substr(0, hash));
    for (std::string word; words >> word;) scene.words.push_back({word, number});
  }
  return scene;
}

std::vector<Primitive> primitives_of(const Scene& scene, std::string_view source) {
  return Parser(scene, source).primitives();
}

}  // namespace skyfit::refs::radiance
