# SPDX-License-Identifier: Apache-2.0
# cmake -DOUTPUT=out.cc -DROOT=dir -DFILES=a.glsl;b.glsl -P embed_shaders.cmake
# writes a C++ file that holds the text of every shader file under its path relative to ROOT.
set(text "// Made by render/embed_shaders.cmake.\n#include \"render/gl/context/shader.h\"\n\nnamespace skyfit {\n")
string(APPEND text "std::span<const ShaderSource> embedded_shaders() {\n  static constexpr ShaderSource kSources[] = {\n")
foreach(file IN LISTS FILES)
  file(READ ${ROOT}/${file} source)
  string(APPEND text "{\"${file}\", R\"__glsl__(${source})__glsl__\"},\n")
endforeach()
string(APPEND text "  };\n  return kSources;\n}\n}  // namespace skyfit\n")
file(WRITE ${OUTPUT} "${text}")
