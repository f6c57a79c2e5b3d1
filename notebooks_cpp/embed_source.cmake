# SPDX-License-Identifier: Apache-2.0
# cmake -DNOTEBOOK=FILE.cpp -DOUTPUT=FILE.cc -P embed_source.cmake: the main of a notebook, which carries its own source.
get_filename_component(name ${NOTEBOOK} NAME)
file(READ ${NOTEBOOK} source)
file(WRITE ${OUTPUT} "// SPDX-License-Identifier: Apache-2.0
#include \"notebooks_cpp/notebook.h\"

int main(int argc, char** argv) {
  constexpr std::string_view kSource = R\"notebook(${source})notebook\";
  return skyfit::notebook::execute(argc, argv, kSource, \"${name}\", run_notebook);
}
")
