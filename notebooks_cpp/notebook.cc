// SPDX-License-Identifier: Apache-2.0
#include "notebooks_cpp/notebook.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "model/base/input_file.h"
#include "model/base/whole_file.h"

namespace skyfit::notebook {
namespace {

using nlohmann::json;

// RFC 4648.
std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

// nbformat keeps text as a list of lines that hold their own ends.
json lines_of(const std::string& text) {
  json lines = json::array();
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    lines.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return lines;
}

json notebook_metadata() {
  return {
      {"kernelspec",
       {{"display_name", "C++20 (compiled)"}, {"language", "C++"}, {"name", "skyfit-compiled"}}},
      {"language_info",
       {{"name", "C++"},
        {"version", "20"},
        {"file_extension", ".cpp"},
        {"mimetype", "text/x-c++src"},
        {"codemirror_mode", "text/x-c++src"},
        {"pygments_lexer", "cpp"}}}};
}

}  // namespace

Page::Page(std::string_view source, std::string name)
    : name_(std::move(name)),
      cells_(parse_percent(source, name_)),
      outputs_(cells_.size(), json::array()),
      terminal_(std::cout.rdbuf()) {
  std::cout.rdbuf(printed_.rdbuf());
}

Page::~Page() { std::cout.rdbuf(terminal_); }

void Page::cell(std::source_location here) {
  end_cell();
  const int line = static_cast<int>(here.line());
  const auto cell = std::ranges::find_if(
      cells_, [line](const Cell& c) { return c.first_line <= line && line <= c.last_line; });
  if (cell == cells_.end() || cell->kind != CellKind::kCode)
    throw CellError(fmt::format("{}:{}: page.cell() stands in no code cell", name_, line));
  const int index = static_cast<int>(cell - cells_.begin());
  if (std::ranges::find(run_order_, index) != run_order_.end())
    throw CellError(fmt::format("{}:{}: the cell ran twice", name_, line));
  run_order_.push_back(index);
}

void Page::end_cell() {
  std::cout.flush();
  const std::string text = printed_.str();
  printed_.str("");
  if (text.empty()) return;
  if (run_order_.empty())
    throw CellError(fmt::format("{}: printed before the first page.cell()", name_));
  outputs_[run_order_.back()].push_back(
      {{"output_type", "stream"}, {"name", "stdout"}, {"text", lines_of(text)}});
}

void Page::figure(const std::filesystem::path& file) {
  end_cell();
  if (run_order_.empty())
    throw CellError(fmt::format("{}: drawn before the first page.cell()", name_));
  const bool svg = file.extension() == ".svg";
  const std::string bytes = read_file(file, "a picture", kMostImageBytes);
  json data = svg ? json{{"image/svg+xml", lines_of(bytes)}} : json{{"image/png", base64(bytes)}};
  outputs_[run_order_.back()].push_back(
      {{"output_type", "display_data"}, {"data", std::move(data)}, {"metadata", json::object()}});
}

json Page::to_ipynb() {
  end_cell();
  const int first = run_order_.empty() ? 0 : run_order_.front();
  json cells = json::array();
  for (int i = 0; i < static_cast<int>(cells_.size()); ++i) {
    const Cell& cell = cells_[i];
    if (cell.kind == CellKind::kHidden) continue;
    json shown = {{"id", fmt::format("cell-{:03}", i)},
                  {"metadata", json::object()},
                  {"source", lines_of(cell.source)}};
    shown["cell_type"] = cell.kind == CellKind::kCode ? "code" : "markdown";
    if (cell.kind == CellKind::kCode) {
      const auto run = std::ranges::find(run_order_, i);
      if (run == run_order_.end() && i >= first)
        throw CellError(fmt::format("{}:{}: the cell did not run: expected page.cell() in it",
                                    name_, cell.first_line));
      shown["execution_count"] =
          run == run_order_.end() ? json(nullptr) : json(run - run_order_.begin() + 1);
      shown["outputs"] = outputs_[i];
    }
    cells.push_back(std::move(shown));
  }
  return {{"nbformat", 4},
          {"nbformat_minor", 5},
          {"metadata", notebook_metadata()},
          {"cells", std::move(cells)}};
}

std::string Page::place() const {
  return run_order_.empty() ? name_
                            : fmt::format("{}:{}", name_, cells_[run_order_.back()].first_line);
}

int execute(int argc, char** argv, std::string_view source, const std::string& name,
            void (*run)(Page&)) {
  if (argc != 2) {
    std::cerr << "usage: " << argv[0] << " OUTPUT_DIRECTORY\n";
    return 2;
  }
  std::string place;
  try {
    Page page(source, name);
    try {
      run(page);
    } catch (const CellError&) {
      throw;
    } catch (...) {
      place = page.place() + ": cell failed: ";
      throw;
    }
    const auto stem = std::filesystem::path(name).stem().string();
    std::filesystem::create_directories(argv[1]);
    write_whole_file(std::filesystem::path(argv[1]) / (stem + ".ipynb"),
                     page.to_ipynb().dump(1) + "\n");
    return 0;
  } catch (const std::exception& error) {
    std::cerr << place << error.what() << '\n';
    return 1;
  }
}

}  // namespace skyfit::notebook
