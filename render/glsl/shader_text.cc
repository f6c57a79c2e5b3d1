// SPDX-License-Identifier: Apache-2.0
#include "render/glsl/shader_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace skyfit {
namespace {

// What model/shared/ expects of a GLSL compiler, see model/shared/shared.h.
constexpr std::string_view kFormulas =
    "#define Number float\n"
    "#define OUT(T) out T\n";

std::string_view prelude(ShaderLanguage language) {
  if (language == ShaderLanguage::kGlsl450) return "#version 450 core\n";
  return "#version 300 es\n"
         "precision highp float;\n"
         "precision highp int;\n"
         "precision highp sampler2D;\n"
         "precision highp sampler3D;\n";
}

}  // namespace

std::string_view embedded_shader(std::string_view path) {
  for (const ShaderSource& source : embedded_shaders()) {
    if (source.path == path) return source.text;
  }
  throw std::out_of_range(fmt::format("{}: not compiled in", path));
}

ShaderText::ShaderText(const std::string& path, ShaderLanguage language,
                       std::span<const std::string> defined, std::span<const ShaderSource> extra)
    : extra_(extra), text_(prelude(language)) {
  text_ += kFormulas;
  for (const std::string& name : defined) text_ += fmt::format("#define {}\n", name);
  origins_.assign(static_cast<std::size_t>(std::count(text_.begin(), text_.end(), '\n')),
                  {path, 1});
  append(path, "");
}

std::string ShaderText::translated(const std::string& log) const {
  static const std::regex kPlace(R"(^(?:ERROR: )?\d+[:(](\d+)(?:\(\d+\)|\))?\s*:\s*(.*)$)");
  std::istringstream lines(log);
  std::string first, line;
  while (std::getline(lines, line)) {
    if (first.empty()) first = line;
    std::smatch match;
    if (!std::regex_match(line, match, kPlace) || line.find("error") == std::string::npos) continue;
    const std::size_t number = std::stoul(match[1]);
    if (number < 1 || number > origins_.size()) return line;
    const Origin& origin = origins_[number - 1];
    return fmt::format("{}:{}: {}", origin.path, origin.line, match[2].str());
  }
  return first;
}

// `where` is the place of the #include.
std::string_view ShaderText::find(const std::string& path, const std::string& where) const {
  for (const auto sources : {extra_, embedded_shaders()}) {
    for (const ShaderSource& source : sources) {
      if (source.path == path) return source.text;
    }
  }
  throw std::runtime_error(fmt::format("{}no such shader source: {}", where, path));
}

void ShaderText::append(const std::string& path, const std::string& where) {
  if (std::find(files_.begin(), files_.end(), path) != files_.end()) return;
  files_.push_back(path);
  static const std::regex kInclude(R"re(^\s*#include\s+"([^"]+)"\s*$)re");
  std::istringstream lines{std::string(find(path, where))};
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    if (std::regex_match(line, match, kInclude)) {
      append(match[1].str(), fmt::format("{}:{}: ", path, number));
      continue;
    }
    text_ += line + '\n';
    origins_.push_back({path, number});
  }
}

}  // namespace skyfit
