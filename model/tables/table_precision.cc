// SPDX-License-Identifier: Apache-2.0
#include "model/tables/table_precision.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace skyfit {
namespace {

constexpr double kSteps = 255;             // of 8 bits
constexpr double kLargestShare = 32768.0;  // of values in half precision: far from its ends

template <class Texel>
void append(const Table& table, std::vector<std::byte>& bytes, auto&& texel_of) {
  bytes.resize(table.rgba.size() * sizeof(Texel));
  for (std::size_t i = 0; i < table.rgba.size(); ++i) {
    const Texel texel = texel_of(static_cast<double>(table.rgba[i]));
    std::memcpy(bytes.data() + i * sizeof texel, &texel, sizeof texel);
  }
}

TexelCode code_of(const Table& table, TableHolds holds, TablePrecision precision) {
  if (precision == TablePrecision::kFloat || table.rgba.empty()) return {};
  const auto [low, high] = std::ranges::minmax(table.rgba);
  if (precision == TablePrecision::kHalf) {
    if (holds == TableHolds::kLogarithms) return {1, high};
    return {high > 0 ? static_cast<float>(high / kLargestShare) : 1, 0};
  }
  return {high > low ? static_cast<float>((high - low)) : 1, low};
}

double value_of(const std::byte* bytes, TablePrecision precision) {
  const auto read = [&]<class T>(T value) {
    std::memcpy(&value, bytes, sizeof value);
    return value;
  };
  switch (precision) {
    case TablePrecision::kFloat:
      return read(float{});
    case TablePrecision::kHalf:
      return static_cast<float>(std::bit_cast<Eigen::half>(read(std::uint16_t{})));
    case TablePrecision::k8Bit:
      break;
  }
  return read(std::uint8_t{}) / kSteps;
}

constexpr std::size_t kChannels = 4;

std::size_t texels(const Table& table) { return table.rgba.size() / kChannels; }

}  // namespace

std::span<const TablePrecisionEntry> table_precisions() {
  static constexpr std::array kPrecisions = {
      TablePrecisionEntry{"float", TablePrecision::kFloat, "16 bytes a texel"},
      TablePrecisionEntry{"half", TablePrecision::kHalf, "8 bytes a texel"},
      TablePrecisionEntry{"8bit", TablePrecision::k8Bit, "4 bytes a texel; skies show steps"}};
  return kPrecisions;
}

std::size_t bytes_of_texel(TablePrecision precision) {
  switch (precision) {
    case TablePrecision::kFloat:
      return kChannels * sizeof(float);
    case TablePrecision::kHalf:
      return kChannels * sizeof(std::uint16_t);
    case TablePrecision::k8Bit:
      break;
  }
  return kChannels;
}

EncodedTable encoded(const Table& table, TableHolds holds, TablePrecision precision) {
  EncodedTable result{
      table.width, table.height, table.depth, precision, code_of(table, holds, precision), {}};
  const double scale = result.code.scale, offset = result.code.offset;
  switch (precision) {
    case TablePrecision::kFloat:
      append<float>(table, result.texels, [](double v) { return static_cast<float>(v); });
      break;
    case TablePrecision::kHalf:
      append<std::uint16_t>(table, result.texels, [&](double v) {
        return std::bit_cast<std::uint16_t>(Eigen::half(static_cast<float>((v - offset) / scale)));
      });
      break;
    case TablePrecision::k8Bit:
      append<std::uint8_t>(table, result.texels, [&](double v) {
        const double steps = std::round(kSteps * (v - offset) / scale);
        return static_cast<std::uint8_t>(std::clamp(steps, 0.0, kSteps));
      });
      break;
  }
  return result;
}

Table decoded(const EncodedTable& table) {
  Table result{table.width, table.height, table.depth, {}};
  const std::size_t size = bytes_of_texel(table.precision) / kChannels;
  result.rgba.reserve(table.texels.size() / size);
  for (std::size_t i = 0; i < table.texels.size(); i += size) {
    const double texel = value_of(table.texels.data() + i, table.precision);
    result.rgba.push_back(static_cast<float>(static_cast<double>(table.code.scale) * texel +
                                             static_cast<double>(table.code.offset)));
  }
  return result;
}

TableHolds sky_rays_hold(SkyRayMapping mapping) {
  return mapping == SkyRayMapping::kFromOutside ? TableHolds::kLogarithms : TableHolds::kValues;
}

bool sky_rays_encoded(SkyRayMapping mapping) {
  return mapping == SkyRayMapping::kFromOutside || mapping == SkyRayMapping::kBruneton ||
         mapping == SkyRayMapping::kBodare || mapping == SkyRayMapping::kSchafhitzel;
}

AtmosphereTables in_precision(const AtmosphereTables& tables, TablePrecision precision) {
  AtmosphereTables read = tables;
  if (precision == TablePrecision::kFloat) return read;
  const auto round = [&](Table& table, TableHolds holds) {
    table = decoded(encoded(table, holds, precision));
  };
  round(read.rayleigh_like, TableHolds::kLogarithms);
  round(read.single, TableHolds::kLogarithms);
  const SkyRayMapping mapping = tables.sky_rays.mapping;
  if (sky_rays_encoded(mapping)) {
    round(read.sky_rays.air, sky_rays_hold(mapping));
    round(read.sky_rays.aerosol, sky_rays_hold(mapping));
  }
  return read;
}

std::size_t table_bytes(const AtmosphereTables& tables, TablePrecision precision) {
  std::size_t encoded = texels(tables.rayleigh_like) + texels(tables.single),
              single =
                  texels(tables.optical_depth) + texels(tables.irradiance) + texels(tables.phase);
  (sky_rays_encoded(tables.sky_rays.mapping) ? encoded : single) +=
      texels(tables.sky_rays.air) + texels(tables.sky_rays.aerosol);
  return encoded * bytes_of_texel(precision) + single * bytes_of_texel(TablePrecision::kFloat);
}

std::span<const TableSizesEntry> table_sizes() {
  static constexpr std::array kSizes = {
      TableSizesEntry{"full", {}, "what skyfit render takes"},
      TableSizesEntry{"medium",
                      {.scattering_ground = 14,
                       .scattering_sky = 50,
                       .scattering_azimuth = 16,
                       .outside_sky = 70,
                       .outside_mu_s = 96,
                       .outside_azimuth = 32},
                      "half of the texels"},
      TableSizesEntry{"small", kSmallTableSizes, "a fifth of the texels"},
      TableSizesEntry{"tiny",
                      {.optical_depth_mu = 128,
                       .optical_depth_r = 64,
                       .irradiance_mu_s = 32,
                       .irradiance_r = 8,
                       .scattering_r = 16,
                       .scattering_ground = 8,
                       .scattering_sky = 24,
                       .scattering_mu_s = 32,
                       .scattering_azimuth = 8,
                       .outside_sky = 32,
                       .outside_mu_s = 48,
                       .outside_azimuth = 16},
                      "a thirtieth of the texels"}};
  return kSizes;
}

}  // namespace skyfit
