// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/obj_syntax.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "model/base/text.h"

namespace skyfit {
namespace {

constexpr std::int64_t kMostTriangles = 50'000'000;
constexpr std::string_view kSpace = " \t\r";

// Takes the next word off the line; empty at its end.
std::string_view next_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kSpace), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kSpace));
  line.remove_prefix(word.size());
  return word;
}

[[noreturn]] void fail_at(const std::filesystem::path& file, int line, const std::string& what) {
  throw std::runtime_error(fmt::format("{}:{}: {}", file.string(), line, what));
}

// Takes them off the line. Throws as fail_at() does.
void expect_three_numbers(const std::filesystem::path& file, int line, std::string_view& words) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view word = next_word(words);
    const std::string_view digits = word.substr(word.starts_with('+'));
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc() && end == digits.data() + digits.size() &&
        std::isfinite(static_cast<float>(value)))
      continue;
    fail_at(file, line, "expected three finite numbers, got " + in_quotes(word));
  }
}

class Checker {
 public:
  explicit Checker(const std::filesystem::path& file) : file_(file) {}

  MaterialUses check(std::string_view text) {
    while (!text.empty()) {
      ++line_;
      const std::string_view line = text.substr(0, text.find('\n'));
      check_line(line);
      text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    if (triangles_ == 0) fail_file("no faces");
    vertices_.expect_enough(*this);
    normals_.expect_enough(*this);
    return uses_;
  }

 private:
  // What corners refer to. An index from 1 on may stand before its element.
  struct Elements {
    const char* name;
    std::int64_t count = 0, greatest = 0;
    int line = 0;  // of the greatest index

    void expect_enough(const Checker& checker) const {
      if (greatest <= count) return;
      checker.fail(line, fmt::format("{} {}: the file has {}", name, greatest, count));
    }
  };

  [[noreturn]] void fail(int line, const std::string& what) const { fail_at(file_, line, what); }
  [[noreturn]] void fail_file(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {}", file_.string(), what));
  }

  void check_line(std::string_view line) {
    const std::string_view kind = next_word(line);
    if (kind == "v") check_vector(line, vertices_);
    if (kind == "vn") check_vector(line, normals_);
    if (kind == "f") check_face(line);
    if (kind == "usemtl") uses_.emplace(next_word(line), line_);
  }

  void check_vector(std::string_view line, Elements& elements) {
    expect_three_numbers(file_, line_, line);
    ++elements.count;
  }

  void check_face(std::string_view line) {
    int corners = 0;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      check_corner(word);
      ++corners;
    }
    if (corners < 3) fail(line_, fmt::format("a face of {} corners: expected at least 3", corners));
    triangles_ += corners - 2;
    if (triangles_ > kMostTriangles) fail_file("more than 50 million triangles");
  }

  // vertex, vertex/texture, vertex//normal or vertex/texture/normal.
  void check_corner(std::string_view word) {
    const std::size_t first = word.find('/');
    check_index(word, word.substr(0, first), vertices_);
    if (first == std::string_view::npos) return;
    const std::size_t second = word.find('/', first + 1);
    if (second != std::string_view::npos) check_index(word, word.substr(second + 1), normals_);
  }

  // From 1 on, or from -1 back from the last element so far.
  void check_index(std::string_view word, std::string_view digits, Elements& elements) {
    int index = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (error != std::errc() || end != digits.data() + digits.size() || index == 0)
      fail(line_, fmt::format("expected a {} from 1 on, got {}", elements.name, in_quotes(word)));
    if (index < -elements.count) {
      fail(line_,
           fmt::format("{} {}: there are {} before it", elements.name, index, elements.count));
    }
    if (index <= elements.greatest) return;
    elements.greatest = index;
    elements.line = line_;
  }

  std::filesystem::path file_;
  int line_ = 0;
  Elements vertices_{"vertex"}, normals_{"normal"};
  std::int64_t triangles_ = 0;
  MaterialUses uses_;
};

}  // namespace

namespace {

// Behind numbers; names of materials and groups may hold a #.
std::string_view without_comment(std::string_view line) {
  std::string_view rest = line;
  const std::string_view kind = next_word(rest);
  return kind == "f" || kind == "v" || kind == "vn" || kind == "vt" ? line.substr(0, line.find('#'))
                                                                    : line;
}

// Stands for a blank in a name, which the loader would end there.
constexpr char kBlankInName = '\x1f';

std::string with_joined_name(std::string_view line) {
  std::string_view rest = line;
  const std::string_view kind = next_word(rest);
  const std::string_view name = trim(rest);
  constexpr std::string_view kEnding = ".mtl";
  const bool one_file = kind == "mtllib" && name.ends_with(kEnding) &&
                        name.find(kEnding) == name.size() - kEnding.size();
  if (kind != "usemtl" && kind != "newmtl" && !one_file) return std::string(line);
  std::string joined(name);
  std::ranges::replace_if(
      joined, [](char c) { return kSpace.find(c) != kSpace.npos; }, kBlankInName);
  return fmt::format("{} {}", kind, joined);
}

}  // namespace

std::string with_joined_names(std::string_view text) {
  std::string result;
  result.reserve(text.size() + 1);
  for (const std::string_view line : split(text, '\n')) {
    result += line.find("mtl") == line.npos ? line : with_joined_name(line);
    result += '\n';
  }
  return result;
}

std::string with_blanks(std::string name) {
  std::ranges::replace(name, kBlankInName, ' ');
  return name;
}

std::string with_joined_lines(std::string_view obj) {
  std::string text;
  text.reserve(obj.size() + 1);
  std::size_t joined = 0;
  while (!obj.empty()) {
    std::string_view line = obj.substr(0, obj.find('\n'));
    obj.remove_prefix(std::min(line.size() + 1, obj.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    const bool goes_on = line.ends_with('\\');
    if (goes_on) line.remove_suffix(1);
    text += without_comment(line);
    if (goes_on) {
      text += ' ';
      ++joined;
    } else {
      text.append(1 + std::exchange(joined, 0), '\n');
    }
  }
  return with_joined_names(text);
}

void check_mtl(const std::filesystem::path& file, std::string_view text) {
  int number = 0;
  for (std::string_view line : split(text, '\n')) {
    ++number;
    if (next_word(line) == "Kd") expect_three_numbers(file, number, line);
  }
}

MaterialUses check_obj(const std::filesystem::path& file, std::string_view text) {
  return Checker(file).check(text);
}

}  // namespace skyfit
