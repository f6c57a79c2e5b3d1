// SPDX-License-Identifier: Apache-2.0
#include "render/gl/context/shader.h"

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

// One program's sources, flattened, and where every line of the result came from. (#line would do,
// but Mesa's compiler forgets its file number.)
class Expander {
 public:
  explicit Expander(std::span<const ShaderSource> extra) : extra_(extra) {}

  std::string expand(const std::string& path, std::span<const std::string> defined) {
    std::string text(kPrelude);
    for (const std::string& name : defined) text += fmt::format("#define {}\n", name);
    origins_.assign(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')),
                    {path, 1});
    append(path, "", text);
    return text;
  }

  // The first error: "0:14(3): error: ..." (Mesa) or "0(14) : error ..." (NVIDIA) becomes
  // "path:line: ...".
  std::string translate(const std::string& log) const {
    static const std::regex kPlace(R"(^(?:ERROR: )?\d+[:(](\d+)(?:\(\d+\)|\))?\s*:\s*(.*)$)");
    std::istringstream lines(log);
    std::string first, line;
    while (std::getline(lines, line)) {
      if (first.empty()) first = line;
      std::smatch match;
      if (!std::regex_match(line, match, kPlace) || line.find("error") == std::string::npos)
        continue;
      const std::size_t number = std::stoul(match[1]);
      if (number < 1 || number > origins_.size()) return line;
      const Origin& origin = origins_[number - 1];
      return fmt::format("{}:{}: {}", origin.path, origin.line, match[2].str());
    }
    return first;
  }

 private:
  struct Origin {
    std::string path;
    int line;
  };

  // `where` is the place of the #include.
  std::string_view find(const std::string& path, const std::string& where) const {
    for (const auto sources : {extra_, embedded_shaders()}) {
      for (const ShaderSource& source : sources) {
        if (source.path == path) return source.text;
      }
    }
    throw std::runtime_error(fmt::format("{}no such shader source: {}", where, path));
  }

  void append(const std::string& path, const std::string& where, std::string& text) {
    if (std::find(files_.begin(), files_.end(), path) != files_.end()) return;
    files_.push_back(path);
    static const std::regex kInclude(R"re(^\s*#include\s+"([^"]+)"\s*$)re");
    std::istringstream lines{std::string(find(path, where))};
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
      std::smatch match;
      if (std::regex_match(line, match, kInclude)) {
        append(match[1].str(), fmt::format("{}:{}: ", path, number), text);
        continue;
      }
      text += line + '\n';
      origins_.push_back({path, number});
    }
  }

  std::span<const ShaderSource> extra_;
  std::vector<std::string> files_;
  std::vector<Origin> origins_;  // [line of the result]
};

GlShader compile(const ShaderStage& stage, std::span<const ShaderSource> extra,
                 std::span<const std::string> defined) {
  Expander expander(extra);
  const std::string text = expander.expand(stage.path, defined);
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

GlProgram build_program(std::span<const ShaderStage> stages, std::span<const ShaderSource> extra,
                        std::span<const std::string> defined) {
  GlProgram program(glCreateProgram());
  for (const ShaderStage& stage : stages) {
    const GlShader shader = compile(stage, extra, defined);
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
