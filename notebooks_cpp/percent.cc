// SPDX-License-Identifier: Apache-2.0
#include "notebooks_cpp/percent.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "model/base/text.h"

namespace skyfit::notebook {
namespace {

constexpr std::string_view kMarker = "// %%";

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::invalid_argument error_at(std::string_view name, int line, std::string_view what) {
  return std::invalid_argument(fmt::format("{}:{}: {}", name, line, what));
}

CellKind kind_of(std::string_view marker, std::string_view name, int line) {
  const auto kind = trim(marker.substr(kMarker.size()));
  if (kind.empty()) return CellKind::kCode;
  if (kind == "[markdown]") return CellKind::kMarkdown;
  if (kind == "[hidden]") return CellKind::kHidden;
  throw error_at(name, line,
                 fmt::format("cell \"{}\": expected nothing, [markdown] or [hidden]", kind));
}

std::string markdown_line(std::string_view line, std::string_view name, int number) {
  const auto text = trim(line);
  if (text.empty()) return {};
  if (!text.starts_with("//"))
    throw error_at(name, number, "code in a markdown cell: expected a line with //");
  return std::string(text.substr(text.starts_with("// ") ? 3 : 2));
}

void remove_indentation(std::vector<std::string>& lines) {
  std::size_t indentation = std::string::npos;
  for (const auto& line : lines) indentation = std::min(indentation, line.find_first_not_of(' '));
  if (indentation == std::string::npos) return;
  for (auto& line : lines) line.erase(0, std::min(indentation, line.size()));
}

std::string joined_without_blank_ends(std::vector<std::string> lines) {
  while (!lines.empty() && trim(lines.back()).empty()) lines.pop_back();
  while (!lines.empty() && trim(lines.front()).empty()) lines.erase(lines.begin());
  std::string text;
  for (const auto& line : lines) text += (&line == lines.data() ? "" : "\n") + line;
  return text;
}

std::string shown_source(const Cell& cell, const std::vector<std::string_view>& lines,
                         std::string_view name) {
  std::vector<std::string> shown;
  for (int number = cell.first_line + 1; number <= cell.last_line; ++number) {
    const auto line = lines[number - 1];
    if (cell.kind == CellKind::kMarkdown)
      shown.push_back(markdown_line(line, name, number));
    else if (trim(line) != "page.cell();")
      shown.emplace_back(line);
  }
  if (cell.kind == CellKind::kCode) remove_indentation(shown);
  return joined_without_blank_ends(std::move(shown));
}

}  // namespace

std::vector<Cell> parse_percent(std::string_view text, std::string_view name) {
  const auto lines = lines_of(text);
  const int count = static_cast<int>(lines.size());
  std::vector<Cell> cells;
  for (int number = 1; number <= count; ++number) {
    const auto line = trim(lines[number - 1]);
    if (line.starts_with(kMarker))
      cells.push_back({kind_of(line, name, number), number, number, {}});
    if (!cells.empty()) cells.back().last_line = number;
  }
  for (auto& cell : cells) {
    cell.source = shown_source(cell, lines, name);
    if (cell.source.empty()) throw error_at(name, cell.first_line, "empty cell");
  }
  if (std::ranges::none_of(cells, [](const Cell& cell) { return cell.kind == CellKind::kCode; }))
    throw error_at(name, 1, "no code cell");
  return cells;
}

}  // namespace skyfit::notebook
