// SPDX-License-Identifier: Apache-2.0
// What `skyfit sky` leaves: which values of a place, and with which uncertainty.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fit/result/record.h"
#include "model/sky_model.h"

namespace skyfit::cli {

// sum_k weight[k] * (value at node first_node + k).
struct NodeSum {
  std::size_t first_node = 0;
  std::vector<double> weight;
  bool not_negative = false;  // what the few nodes of a rule leave below 0 is 0
};

// The sum at a point, and its derivative by a parameter of `sky` (without regard to not_negative).
double value_of(const NodeSum& sum, const SkyValues& sky, int point);
double derivative_of(const NodeSum& sum, const SkyValues& sky, int parameter, int point);

// One line of a place: its first fields, and what it prints of each of the place's points.
struct SkyLine {
  std::string prefix;
  std::vector<NodeSum> sums;
};

struct SkyColumn {
  std::string name;   // "luminance_cd_m2"
  std::string units;  // by UDUNITS: "cd m-2"
};

// A place is a direction of the sky (one point), or an observer's horizontal plane (one point per
// irradiance). It has one line, or one per wavelength.
struct SkyTable {
  std::string prefix_columns;      // of the prefixes of the lines
  std::vector<SkyColumn> columns;  // of the values of a line: points x sums
  std::vector<WavelengthNode> nodes;
  std::vector<SkyLine> lines;
  std::optional<fit::FittedCovariance> covariance;  // prints one sigma after each value
  int orders = 0;  // > 0: after each value prints that many orders of scattering, and the rest

  // Those of the values, each followed by what is printed with it.
  std::vector<SkyColumn> all_columns() const;
  std::vector<Parameter> derivatives() const {
    return covariance ? covariance->parameters : std::vector<Parameter>{};
  }
};

SkyTable luminance_table(const SpectralData& data);
SkyTable color_table(const SpectralData& data);
SkyTable radiance_table(const SpectralData& data, const std::vector<double>& wavelengths_nm);
SkyTable illuminance_table(const SpectralData& data);
SkyTable irradiance_table(const SpectralData& data, const std::vector<double>& wavelengths_nm);

// `place` names the columns of a place, with a comma at its end; so do the fields of
// append_place().
std::string header(const SkyTable& table, std::string_view place);

// The numbers of those lines, line by line.
std::vector<double> place_values(const SkyTable& table, const SkyValues& sky,
                                 std::span<const SkyValues> orders, int first, int count);

// The lines of the place whose points are first .. first + count - 1 of `sky`; `orders` holds the
// same points of each order that the table prints.
void append_place(const SkyTable& table, std::string_view place, const SkyValues& sky,
                  std::span<const SkyValues> orders, int first, int count, fmt::memory_buffer& out);

}  // namespace skyfit::cli
