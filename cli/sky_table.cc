// SPDX-License-Identifier: Apache-2.0
#include "cli/sky_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace skyfit::cli {
namespace {

constexpr const char* kCandela = "cd m-2";

std::vector<SkyColumn> irradiance_columns(std::string_view unit, const std::string& units) {
  std::vector<SkyColumn> columns;
  for (const std::string_view name : kIrradianceNames)
    columns.push_back({fmt::format("{}_{}", name, unit), units});
  return columns;
}

// One line per wavelength, of the value there times scale(wavelength).
template <class Scale>
SkyTable spectral_table(const SpectralData& data, const std::vector<double>& wavelengths_nm,
                        std::vector<SkyColumn> columns, const Scale& scale) {
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
  return {"", {{"luminance_cd_m2", kCandela}}, rule.nodes, {{"", {{0, rule.weight}}}}, {}};
}

SkyTable color_table(const SpectralData& data) {
  const XyzRule rule = xyz_rule(data);
  SkyLine line;
  for (const std::vector<double>& weight : rule.weight) line.sums.push_back({0, weight, true});
  for (int channel = 0; channel < 3; ++channel) line.sums.push_back(srgb_channel(rule, channel));
  SkyTable table{"", {}, rule.nodes, {line}, {}};
  for (const char* name : {"X_cd_m2", "Y_cd_m2", "Z_cd_m2", "R_cd_m2", "G_cd_m2", "B_cd_m2"})
    table.columns.push_back({name, kCandela});
  return table;
}

SkyTable radiance_table(const SpectralData& data, const std::vector<double>& wavelengths_nm) {
  return spectral_table(data, wavelengths_nm, {{"radiance_per_irradiance_sr", "sr-1"}},
                        [](double) { return 1.0; });
}

SkyTable illuminance_table(const SpectralData& data) {
  SkyTable table = luminance_table(data);
  table.columns = irradiance_columns("lx", "lx");
  return table;
}

SkyTable irradiance_table(const SpectralData& data, const std::vector<double>& wavelengths_nm) {
  return spectral_table(data, wavelengths_nm, irradiance_columns("w_m2_nm", "W m-2 nm-1"),
                        [&](double nm) { return data.solar_irradiance.at(nm); });
}

std::vector<SkyColumn> SkyTable::all_columns() const {
  std::vector<SkyColumn> all;
  for (const SkyColumn& column : columns) {
    all.push_back(column);
    if (covariance) all.push_back({"sigma_" + column.name, column.units});
    for (int order = 1; order <= orders; ++order)
      all.push_back({fmt::format("order_{}", order), column.units});
    if (orders > 0) all.push_back({"order_higher", column.units});
  }
  return all;
}

std::string header(const SkyTable& table, std::string_view place) {
  std::string text = std::string(place) + table.prefix_columns;
  for (const SkyColumn& column : table.all_columns()) text += column.name + ",";
  text.back() = '\n';
  return text;
}

std::vector<double> place_values(const SkyTable& table, const SkyValues& sky,
                                 std::span<const SkyValues> orders, int first, int count) {
  std::vector<double> values;
  for (const SkyLine& line : table.lines) {
    for (int point = first; point < first + count; ++point) {
      for (const NodeSum& sum : line.sums) {
        const double value = value_of(sum, sky, point);
        values.push_back(value);
        if (table.covariance) values.push_back(sigma_of(sum, sky, point, table.covariance->matrix));
        double higher = value;
        for (const SkyValues& order : orders) {
          values.push_back(value_of(sum, order, point));
          higher -= values.back();
        }
        if (!orders.empty()) values.push_back(higher);
      }
    }
  }
  return values;
}

void append_place(const SkyTable& table, std::string_view place, const SkyValues& sky,
                  std::span<const SkyValues> orders, int first, int count,
                  fmt::memory_buffer& out) {
  const std::vector<double> values = place_values(table, sky, orders, first, count);
  const std::size_t columns = values.size() / table.lines.size();
  auto value = values.begin();
  for (const SkyLine& line : table.lines) {
    fmt::format_to(std::back_inserter(out), "{}{}", place, line.prefix);
    for (std::size_t i = 0; i < columns; ++i)
      fmt::format_to(std::back_inserter(out), "{}{:.9g}", i == 0 ? "" : ",", *value++);
    out.push_back('\n');
  }
}

}  // namespace skyfit::cli
