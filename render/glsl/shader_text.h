// SPDX-License-Identifier: Apache-2.0
// The sources of shaders as text, without OpenGL: those that are part of the library, and programs
// put together of them. A source may `#include "path"` another one by its path in the repository;
// each file is read once per program. `model/shared/` formulas find Number and OUT defined.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit {

struct ShaderSource {
  std::string_view path;  // as in #include: "model/shared/phase.glsl"
  std::string_view text;
};

// Every file of render/shaders/ and render/page/, and every .glsl file of model/shared/.
std::span<const ShaderSource> embedded_shaders();

// Throws std::out_of_range when no such file was compiled in.
std::string_view embedded_shader(std::string_view path);

// The libraries are for files of other programs, which say their version themselves: GLSL from 4.20
// on and HLSL from shader model 4 on.
enum class ShaderLanguage { kGlsl450, kGlslEs300, kGlslLibrary, kHlslLibrary };

// One shader, flattened, and where each of its lines came from. (#line would do, but Mesa's
// compiler forgets its file number.)
class ShaderText {
 public:
  // `extra` sources are looked up first; each of `defined`, a name or a name and its value, is
  // #defined. Throws std::runtime_error that names the missing file.
  ShaderText(const std::string& path, ShaderLanguage language, std::span<const std::string> defined,
             std::span<const ShaderSource> extra = {});

  const std::string& text() const { return text_; }

  // The first error of a driver's log, "0:14(3): error: ..." (Mesa) or "0(14) : error ..."
  // (NVIDIA), as "path:line: ...".
  std::string translated(const std::string& log) const;

 private:
  struct Origin {
    std::string path;
    int line;
  };

  std::string_view find(const std::string& path, const std::string& where) const;
  void append(const std::string& path, const std::string& where);

  std::span<const ShaderSource> extra_;
  std::string text_;
  std::vector<std::string> files_;
  std::vector<Origin> origins_;  // [line of the result]
};

// The text of a library, with `title` as a comment before it; none of the names that it defines for
// the preprocessor outlives it. Throws as ShaderText().
std::string shader_library(std::string_view title, const std::string& path, ShaderLanguage language,
                           std::span<const std::string> defined);

}  // namespace skyfit
