// SPDX-License-Identifier: Apache-2.0
// Compiled notebooks. A notebook is one C++ file in the percent format (percent.h) that defines
// run_notebook; its cells are plain statements of that function, each beginning with
// `page.cell();`. Executed with an output directory, the program writes itself there as an .ipynb
// (nbformat 4.5) with what its cells printed and drew.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <source_location>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "model/base/temporary_directory.h"
#include "notebooks_cpp/percent.h"

namespace skyfit::notebook {

// A notebook that is not written as it should be; the message begins with file and line.
struct CellError : std::logic_error {
  using std::logic_error::logic_error;
};

// Collects the outputs of the cells while the notebook runs. What is written to std::cout belongs
// to the cell that runs.
class Page {
 public:
  // `source` is the text of the file `name`. Throws std::invalid_argument as parse_percent does;
  // std::runtime_error when there is no room for temporary files.
  Page(std::string_view source, std::string name);
  ~Page();
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

  // Begins the code cell that the call stands in. Throws CellError with one line when it stands in
  // none, or the cell has run before.
  void cell(std::source_location here = std::source_location::current());

  // A place for a file that goes away with the page.
  std::filesystem::path scratch(std::string_view file_name) const {
    return scratch_.path() / file_name;
  }

  // Shows a .png or .svg in the cell that runs. Throws std::runtime_error when it cannot be read.
  void figure(const std::filesystem::path& file);

  // The whole notebook. Throws CellError `name:line: ...` when a code cell after the first that ran
  // did not run.
  nlohmann::json to_ipynb();

  // "name:line" of the cell that runs, for messages.
  std::string place() const;

 private:
  void end_cell();  // moves what was printed to the cell's outputs

  std::string name_;
  std::vector<Cell> cells_;
  std::vector<nlohmann::json> outputs_;  // per cell
  std::vector<int> run_order_;           // cells, in the order they ran
  std::ostringstream printed_;
  std::streambuf* terminal_;
  TemporaryDirectory scratch_;
};

// Runs the notebook and writes OUTPUT_DIRECTORY/STEM.ipynb, whole or not at all. Returns the exit
// status; every failure is one line on stderr that names the cell.
int execute(int argc, char** argv, std::string_view source, const std::string& name,
            void (*run)(Page&));

}  // namespace skyfit::notebook

// What a notebook file defines.
void run_notebook(skyfit::notebook::Page& page);
