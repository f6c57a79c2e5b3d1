// SPDX-License-Identifier: Apache-2.0
#include "data_refs/radiance_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "data_refs/csv.h"
#include "model/base/pattern.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

[[noreturn]] void fail(const std::string& source, std::string_view line,
                       std::string_view expected) {
  throw std::invalid_argument(
      fmt::format("{}: {}: expected {}", source, in_quotes(line), expected));
}

// The numbers of `NAME= 1 2 3`.
std::vector<double> numbers_of(const std::string& line, std::size_t count,
                               const std::string& source) {
  std::istringstream words(line.substr(line.find('=') + 1));
  std::vector<double> values;
  for (std::string word; words >> word;) {
    const auto value = csv_number(word);
    if (!value || !std::isfinite(*value)) break;
    values.push_back(*value);
  }
  if (values.size() != count)
    fail(source, line, count == 1 ? "a number > 0" : fmt::format("{} numbers", count));
  return values;
}

void read_factor(const std::string& line, double& factor, double value, const std::string& source) {
  if (!(value > 0)) fail(source, line, "a number > 0");
  factor *= value;
}

void read_variable(const std::string& line, const std::string& source, RadianceHeader& header) {
  const std::string name = line.substr(0, line.find('='));
  if (name == "EXPOSURE") {
    read_factor(line, header.exposure, numbers_of(line, 1, source)[0], source);
  } else if (name == "COLORCORR") {
    const std::vector<double> factors = numbers_of(line, 3, source);
    for (std::size_t c = 0; c < 3; ++c)
      read_factor(line, header.colour_correction[c], factors[c], source);
  } else if (name == "PRIMARIES") {
    const std::vector<double> xy = numbers_of(line, 8, source);
    header.primaries.emplace();
    for (std::size_t k = 0; k < 8; ++k) (*header.primaries)[k] = static_cast<float>(xy[k]);
  } else if (name == "PIXASPECT") {
    if (numbers_of(line, 1, source)[0] != 1) fail(source, line, "square pixels, 1");
  } else if (name == "GAMMA") {
    if (numbers_of(line, 1, source)[0] != 1) fail(source, line, "linear light, 1");
  } else if (name == "FORMAT") {
    const std::string_view format = trim(std::string_view(line).substr(line.find('=') + 1));
    header.is_xyz = format == "32-bit_rle_xyze";
    if (!header.is_xyz && format != "32-bit_rle_rgbe")
      fail(source, line, "32-bit_rle_rgbe or 32-bit_rle_xyze");
  } else if (name == "VIEW") {
    header.view = line.substr(line.find('=') + 1);
  }
}

struct Option {
  std::vector<double> values;
};

// "-vta -vp 0 0 0" as {"-vta": {}, "-vp": {0, 0, 0}}.
std::map<std::string, Option> options_of(const std::string& view) {
  std::map<std::string, Option> options;
  std::istringstream words(view);
  std::string name;
  for (std::string word; words >> word;) {
    const auto number = csv_number(word);
    if (number && !name.empty()) {
      options[name].values.push_back(*number);
    } else {
      name = word;
      options[name];
    }
  }
  return options;
}

std::vector<double> values_or(const std::map<std::string, Option>& options, const std::string& name,
                              std::vector<double> otherwise) {
  const auto found = options.find(name);
  return found == options.end() || found->second.values.size() != otherwise.size()
             ? otherwise
             : found->second.values;
}

}  // namespace

RadianceHeader read_radiance_header(const std::filesystem::path& file) {
  const std::string source = file.string();
  std::ifstream in(file, std::ios::binary);
  RadianceHeader header;
  std::string line;
  while (std::getline(in, line) && !line.empty()) read_variable(line, source, header);
  std::getline(in, line);
  static const std::regex size(R"(([+-][XY])\s+\d+\s+([+-][XY])\s+\d+\s*)");
  const auto match = whole_match(line, size);
  if (!match || (*match)[1].str()[1] == (*match)[2].str()[1])
    fail(source, line.substr(0, 40), "the size, such as -Y 768 +X 1024");
  header.order = (*match)[1].str() + " " + (*match)[2].str();
  return header;
}

Image upright(const Image& image, const std::string& order) {
  if (order == "-Y +X") return image;
  const bool columns_first = order[1] == 'X';
  // Rows of the file are columns of the picture when x is the outer axis.
  Image result{image.width, image.height, image.channels, {}, image.chromaticities};
  if (columns_first) std::swap(result.width, result.height);
  result.pixels.resize(image.pixels.size());
  const std::string outer = order.substr(0, 2), inner = order.substr(3, 2);
  const auto goes_down_or_right = [](const std::string& axis) {
    return axis == "-Y" || axis == "+X";
  };
  const std::size_t channels = image.channels.size();
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const int first = goes_down_or_right(outer) ? row : image.height - 1 - row;
      const int second = goes_down_or_right(inner) ? column : image.width - 1 - column;
      const int y = columns_first ? second : first, x = columns_first ? first : second;
      std::copy_n(image.pixel(column, row), channels,
                  &result.pixels[(static_cast<std::size_t>(y) * result.width + x) * channels]);
    }
  }
  return result;
}

ImportOptions with_view(const ImportOptions& facts, const std::string& view,
                        const std::string& source) {
  if (view.empty()) return facts;
  const auto refuse = [&](std::string_view expected) { fail(source, "VIEW=" + view, expected); };
  const std::map<std::string, Option> options = options_of(view);
  ImportOptions result = facts;
  std::string projection;
  if (options.contains("-vta")) projection = "equidistant";
  if (options.contains("-vth")) projection = "orthographic";
  if (options.contains("-vts")) projection = "stereographic";
  if (projection.empty())
    refuse("a fisheye, -vta, -vth or -vts; remove the line where it is not that of the picture");
  if (facts.projection && *facts.projection != projection)
    refuse(fmt::format("projection = {}, as options or sidecar state", *facts.projection));
  const std::vector<double> direction = values_or(options, "-vd", {0, 1, 0});
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  constexpr double kStraight = 1e-3;
  if (!(direction[2] > 0 && std::hypot(direction[0], direction[1]) / length < kStraight))
    refuse("a view of the zenith, -vd 0 0 1");
  constexpr double kUnstated = 45;  // deg, of Radiance
  if (values_or(options, "-vh", {kUnstated})[0] != 180 ||
      values_or(options, "-vv", {kUnstated})[0] != 180)
    refuse("the whole sky, -vh 180 -vv 180");
  if (values_or(options, "-vs", {0})[0] != 0 || values_or(options, "-vl", {0})[0] != 0)
    refuse("no shift, -vs 0 -vl 0");
  // x is east, y north; `up` points to the upper edge.
  const std::vector<double> up = values_or(options, "-vu", {0, 1, 0});
  if (std::hypot(up[0], up[1]) < kStraight) refuse("an upper edge beside the zenith, -vu 0 1 0");
  const double north_deg = std::atan2(up[0], up[1]) * kDegreesPerRadian;
  if (facts.north_deg && std::abs(std::remainder(*facts.north_deg - north_deg, 360.0)) > 1)
    refuse(fmt::format("north_deg = {:.9g}, as options or sidecar state", *facts.north_deg));
  result.projection = projection;
  result.north_deg = facts.north_deg.value_or(north_deg);
  return result;
}

}  // namespace skyfit::refs
