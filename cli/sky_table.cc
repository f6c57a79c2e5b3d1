// SPDX-License-Identifier: Apache-2.0
#include "cli/sky_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace skyfit::cli {
namespace {

std::vector<std::string> irradiance_columns(std::string_view unit) {
  std::vector<std::string> columns;
  for (const char* name : {"direct_normal", "direct_horizontal", "diffuse_horizontal",
                           "global_horizontal"}) {  // the order of Irradiance
    columns.push_back(fmt::format("{}_{}", name, unit));
  }
  return columns;
}

// One line per wavelength, of the value there times scale(wavelength).
template <class Scale>
SkyTable spectral_table(const SpectralData& data, const std::vector<double>& wavelengths_nm,
                        std::vector<std::string> columns, const Scale& scale) {
  SkyTable table{
      "wavelength_nm,", std::move(columns), spectral_nodes(data, wavelengths_nm), {}, {}};
  for (std::size_t k = 0; k < wavelengths_nm.size(); ++k) {
    const double nm = wavelengths_nm[k];
    table.lines.push_back({fmt::format("{:.9g},", nm), {{k, {scale(nm)}}}});
  }
  return table;
}

// Weights of linear sRGB from those of XYZ.
NodeSum srgb_channel(const XyzRule& rule, int channel) {
  NodeSum sum{0, std::vector<double>(rule.nodes.size())};
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      sum.weight[k] += kLinearSrgbFromXyz[channel][c] * rule.weight[c][k];
    }
  }
  return sum;
}

// sqrt(g C g) with the gradient g of the sum by the parameters of the covariance.
double sigma_of(const NodeSum& sum, const SkyValues& sky, int point,
                const Eigen::MatrixXd& covariance) {
  Eigen::VectorXd gradient(covariance.rows());
  for (Eigen::Index p = 0; p < gradient.size(); ++p)
    gradient(p) = derivative_of(sum, sky, static_cast<int>(p), point);
  return std::sqrt(std::max(gradient.dot(covariance * gradient), 0.0));
}

}  // namespace

double value_of(const NodeSum& sum, const SkyValues& sky, int point) {
  double total = 0;
  for (std::size_t k = 0; k < sum.weight.size(); ++k) {
    total += sum.weight[k] * sky.at(point, static_cast<int>(sum.first_node + k));
  }
  return sum.not_negative ? std::max(total, 0.0) : total;
}

double derivative_of(const NodeSum& sum, const SkyValues& sky, int parameter, int point) {
  double total = 0;
  for (std::size_t k = 0; k < sum.weight.size(); ++k) {
    total +=
        sum.weight[k] * sky.derivative_at(parameter, point, static_cast<int>(sum.first_node + k));
  }
  return total;
}

SkyTable luminance_table(const SpectralData& data) {
  const LuminanceRule rule = luminance_rule(data);
  return {"", {"luminance_cd_m2"}, rule.nodes, {{"", {{0, rule.weight}}}}, {}};
}

SkyTable color_table(const SpectralData& data) {
  const XyzRule rule = xyz_rule(data);
  SkyLine line;
  for (const std::vector<double>& weight : rule.weight) line.sums.push_back({0, weight, true});
  for (int channel = 0; channel < 3; ++channel) line.sums.push_back(srgb_channel(rule, channel));
  return {"",
          {"X_cd_m2", "Y_cd_m2", "Z_cd_m2", "R_cd_m2", "G_cd_m2", "B_cd_m2"},
          rule.nodes,
          {line},
          {}};
}

SkyTable radiance_table(const SpectralData& data, const std::vector<double>& wavelengths_nm) {
  return spectral_table(data, wavelengths_nm, {"radiance_per_irradiance_sr"},
                        [](double) { return 1.0; });
}

SkyTable illuminance_table(const SpectralData& data) {
  SkyTable table = luminance_table(data);
  table.columns = irradiance_columns("lx");
  return table;
}

SkyTable irradiance_table(const SpectralData& data, const std::vector<double>& wavelengths_nm) {
  return spectral_table(data, wavelengths_nm, irradiance_columns("w_m2_nm"),
                        [&](double nm) { return data.solar_irradiance.at(nm); });
}

std::string header(const SkyTable& table, std::string_view place) {
  std::string text = std::string(place) + table.prefix_columns;
  for (const std::string& column : table.columns) {
    text += column + ",";
    if (table.covariance) text += "sigma_" + column + ",";
    for (int order = 1; order <= table.orders; ++order) text += fmt::format("order_{},", order);
    if (table.orders > 0) text += "order_higher,";
  }
  text.back() = '\n';
  return text;
}

void append_place(const SkyTable& table, std::string_view place, const SkyValues& sky,
                  std::span<const SkyValues> orders, int first, int count,
                  fmt::memory_buffer& out) {
  const auto end = std::back_inserter(out);
  for (const SkyLine& line : table.lines) {
    fmt::format_to(end, "{}{}", place, line.prefix);
    std::string_view separator = "";
    for (int point = first; point < first + count; ++point) {
      for (const NodeSum& sum : line.sums) {
        const double value = value_of(sum, sky, point);
        fmt::format_to(end, "{}{:.9g}", separator, value);
        separator = ",";
        if (table.covariance)
          fmt::format_to(end, ",{:.9g}", sigma_of(sum, sky, point, table.covariance->matrix));
        double higher = value;
        for (const SkyValues& order : orders) {
          const double part = value_of(sum, order, point);
          higher -= part;
          fmt::format_to(end, ",{:.9g}", part);
        }
        if (!orders.empty()) fmt::format_to(end, ",{:.9g}", higher);
      }
    }
    out.push_back('\n');
  }
}

}  // namespace skyfit::cli
