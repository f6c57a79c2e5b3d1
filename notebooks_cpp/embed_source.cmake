# SPDX-License-Identifier: Apache-2.0
# cmake -DNOTEBOOK=FILE.cpp -DOUTPUT=FILE.cc -P embed_source.cmake: the main of a notebook, which carries its own source.
get_filename_component(name ${NOTEBOOK} NAME)
file(READ ${NOTEBOOK} hex HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" literal "${hex}")
# One short literal per 64 bytes: lines stay readable for tools, and the compiler joins them.
string(REGEX REPLACE "((\\\\x[0-9a-f][0-9a-f])(\\\\x[0-9a-f][0-9a-f])?(\\\\x[0-9a-f][0-9a-f])?(\\\\x[0-9a-f][0-9a-f])?(\\\\x[0-9a-f][0-9a-f])?(\\\\x[0-9a-f][0-9a-f])?(\\\\x[0-9a-f][0-9a-f])?(\\\\x[0-9a-f][0-9a-f])?)"
  "    \"\\1\"\n" literal "${literal}")
file(WRITE ${OUTPUT} "// SPDX-License-Identifier: Apache-2.0
#include \"notebooks_cpp/notebook.h\"

int main(int argc, char** argv) {
  constexpr std::string_view kSource =
${literal}      ;
  return skyfit::notebook::execute(argc, argv, kSource, \"${name}\", run_notebook);
}
")
