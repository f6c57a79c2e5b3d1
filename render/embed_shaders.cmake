# SPDX-License-Identifier: Apache-2.0
# cmake -DOUTPUT=out.cc -DROOT=dir -DFILES=a.glsl;b.glsl -P embed_shaders.cmake
# writes a C++ file that holds the text of every shader file and page part under its path relative to ROOT.
set(text "// Made by render/embed_shaders.cmake.\n#include \"render/glsl/shader_text.h\"\n\nnamespace skyfit {\n")
string(APPEND text "std::span<const ShaderSource> embedded_shaders() {\n  static constexpr ShaderSource kSources[] = {\n")
foreach(file IN LISTS FILES)
  file(READ ${ROOT}/${file} source)
  string(APPEND text "{\"${file}\", R\"__text__(${source})__text__\"},\n")
endforeach()
string(APPEND text "  };\n  return kSources;\n}\n}  // namespace skyfit\n")
file(WRITE ${OUTPUT} "${text}")
