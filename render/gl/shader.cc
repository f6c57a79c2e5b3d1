// SPDX-License-Identifier: Apache-2.0
#include "render/gl/shader.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace skyfit {
namespace {

// What model/shared/ expects of a GLSL compiler, see model/shared/shared.h.
constexpr std::string_view kPrelude =
    "#version 450 core\n"
    "#define Number float\n"
    "#define OUT(T) out T\n";

// One program's sources, flattened; #line numbers the files so that messages can be translated
// back.
class Expander {
 public:
  explicit Expander(std::span<const ShaderSource> extra) : extra_(extra) {}

  std::string expand(const std::string& path) {
    files_.clear();
    std::string text(kPrelude);
    append(path, "", 0, text);
    return text;
  }

  // "2:14(3): error: ..." (Mesa) or "2(14) : error ..." (NVIDIA) becomes "path:14: ...".
  std::string translate(const std::string& log) const {
    static const std::regex kPlace(R"(^(?:ERROR: )?(\d+)[:(](\d+)(?:\(\d+\)|\))?\s*:\s*(.*)$)");
    std::istringstream lines(log);
    std::string first, line;
    while (std::getline(lines, line)) {
      std::smatch match;
      if (std::regex_match(line, match, kPlace)) {
        const auto file = static_cast<std::size_t>(std::stoul(match[1]));
        if (file < files_.size()) {
          line = fmt::format("{}:{}: {}", files_[file], match[2].str(), match[3].str());
        }
        if (line.find("error") != std::string::npos) return line;
      }
      if (first.empty()) first = line;
    }
    return first;
  }

 private:
  std::string_view find(const std::string& path, const std::string& from, int line) const {
    for (const auto sources : {extra_, embedded_shaders()}) {
      for (const ShaderSource& source : sources) {
        if (source.path == path) return source.text;
      }
    }
    const std::string where = from.empty() ? std::string() : fmt::format("{}:{}: ", from, line);
    throw std::runtime_error(fmt::format("{}no such shader source: {}", where, path));
  }

  void append(const std::string& path, const std::string& from, int from_line, std::string& text) {
    if (std::find(files_.begin(), files_.end(), path) != files_.end()) return;
    const std::string_view source = find(path, from, from_line);
    const std::size_t index = files_.size();
    files_.push_back(path);
    text += fmt::format("#line 1 {}\n", index);
    static const std::regex kInclude(R"re(^\s*#include\s+"([^"]+)"\s*$)re");
    std::istringstream lines{std::string(source)};
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
      std::smatch match;
      if (std::regex_match(line, match, kInclude)) {
        append(match[1].str(), path, number, text);
        text += fmt::format("#line {} {}\n", number + 1, index);
      } else {
        text += line + '\n';
      }
    }
  }

  std::span<const ShaderSource> extra_;
  std::vector<std::string> files_;
};

GlShader compile(const ShaderStage& stage, std::span<const ShaderSource> extra) {
  Expander expander(extra);
  const std::string text = expander.expand(stage.path);
  GlShader shader(glCreateShader(stage.type));
  const char* pointer = text.c_str();
  glShaderSource(shader.id(), 1, &pointer, nullptr);
  glCompileShader(shader.id());
  GLint done = GL_FALSE;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &done);
  if (done == GL_TRUE) return shader;
  GLint length = 0;
  glGetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetShaderInfoLog(shader.id(), length, nullptr, log.data());
  throw std::runtime_error(expander.translate(log.c_str()));
}

}  // namespace

GlProgram build_program(std::span<const ShaderStage> stages, std::span<const ShaderSource> extra) {
  GlProgram program(glCreateProgram());
  for (const ShaderStage& stage : stages) {
    const GlShader shader = compile(stage, extra);
    glAttachShader(program.id(), shader.id());
  }
  glLinkProgram(program.id());
  GLint done = GL_FALSE;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &done);
  if (done == GL_TRUE) return program;
  GLint length = 0;
  glGetProgramiv(program.id(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetProgramInfoLog(program.id(), length, nullptr, log.data());
  throw std::runtime_error(fmt::format("{}: cannot link: {}", stages.back().path, log.c_str()));
}

}  // namespace skyfit
