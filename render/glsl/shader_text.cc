// SPDX-License-Identifier: Apache-2.0
#include "render/glsl/shader_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

namespace skyfit {
namespace {

// What model/shared/ expects of a GLSL compiler, see model/shared/shared.h.
constexpr std::string_view kFormulas =
    "#define Number float\n"
    "#define OUT(T) out T\n";

constexpr std::string_view kEs =
    "#version 300 es\n"
    "precision highp float;\n"
    "precision highp int;\n"
    "precision highp sampler2D;\n"
    "precision highp sampler3D;\n";

// What GLSL has under other names. Global constants of HLSL are inputs unless they are static.
constexpr std::string_view kHlsl = R"(#define HLSL
#define vec2 float2
#define vec3 float3
#define vec4 float4
#define ivec2 int2
#define ivec3 int3
#define mix lerp
#define const static const
#define sampler2D Texture2D<float4>
#define sampler3D Texture3D<float4>
#define TABLE(UNIT, TYPE, NAME) TYPE NAME : register(t##UNIT);
#define LIST(TYPE, SIZE, VALUES) { VALUES }
SamplerState skyfit_linear_clamp : register(s0);
#define texture(MAP, AT) MAP.SampleLevel(skyfit_linear_clamp, AT, 0.0)
int2 textureSize(Texture2D<float4> map, int level) {
  uint width, height, levels;
  map.GetDimensions(level, width, height, levels);
  return int2(width, height);
}
int3 textureSize(Texture3D<float4> map, int level) {
  uint width, height, depth, levels;
  map.GetDimensions(level, width, height, depth, levels);
  return int3(width, height, depth);
}
float4 texelFetch(Texture2D<float4> map, int2 at, int level) { return map.Load(int3(at, level)); }
float4 texelFetch(Texture3D<float4> map, int3 at, int level) { return map.Load(int4(at, level)); }
)";

std::string_view prelude(ShaderLanguage language) {
  switch (language) {
    case ShaderLanguage::kGlsl450:
      return "#version 450 core\n";
    case ShaderLanguage::kGlslEs300:
      return kEs;
    case ShaderLanguage::kGlslLibrary:
      return "";
    case ShaderLanguage::kHlslLibrary:
      return kHlsl;
  }
  throw std::logic_error("no such language of shaders");
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

std::string shader_library(std::string_view title, const std::string& path, ShaderLanguage language,
                           std::span<const std::string> defined) {
  std::string library;
  std::istringstream said{std::string(title)};
  for (std::string line; std::getline(said, line);) library += "// " + line + '\n';
  const std::string text = ShaderText(path, language, defined).text();
  library += text;
  static const std::regex kDefine(R"(^\s*#define\s+(\w+).*$)");
  std::set<std::string> names;
  std::istringstream lines(text);
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, match, kDefine)) names.insert(match[1]);
  }
  for (const std::string& name : names) library += fmt::format("#undef {}\n", name);
  return library;
}

}  // namespace skyfit
