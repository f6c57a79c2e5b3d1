// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/unknowns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace skyfit::fit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// - Azimuth offset: a compass beside a metal tripod may be wrong by anything; the sky says it
// better.
// - Tilt: a spirit level holds 1 deg.
// - Scale: radiance calibrations of field spectrometers claim 5 %.
constexpr std::array<InstrumentInfo, kInstrumentCount> kTable = {{
    {Instrument::kAzimuthOffset, "instrument.azimuth_offset", "deg", kDegree, 0, -60 * kDegree,
     60 * kDegree, Prior{0, 30 * kDegree}, "true minus stated azimuth, clockwise"},
    {Instrument::kTiltNorth, "instrument.tilt_north", "deg", kDegree, 0, -10 * kDegree,
     10 * kDegree, Prior{0, 1 * kDegree}, "lean of the instrument's axis toward north"},
    {Instrument::kTiltEast, "instrument.tilt_east", "deg", kDegree, 0, -10 * kDegree, 10 * kDegree,
     Prior{0, 1 * kDegree}, "lean of the instrument's axis toward east"},
    {Instrument::kScale, "instrument.scale", "1", 1, 1, 1e-3, 1e3, Prior{1, 0.05},
     "measured over true value"},
}};

const double& value_of(const SkyState& state, std::size_t scan, Instrument id) {
  return state.instrument[scan][static_cast<std::size_t>(id)];
}

double value_at(const SkyState& state, const Unknown& unknown, std::size_t scan) {
  if (const Parameter* parameter = std::get_if<Parameter>(&unknown.what))
    return get_parameter(state.atmosphere[scan], *parameter);
  return value_of(state, scan, std::get<Instrument>(unknown.what));
}

}  // namespace

std::span<const InstrumentInfo, kInstrumentCount> instrument_table() { return kTable; }

const InstrumentInfo& instrument_info(Instrument id) {
  return kTable.at(static_cast<std::size_t>(id));
}

std::variant<Parameter, Instrument> unknown_from_name(std::string_view name) {
  std::vector<std::string_view> known;
  for (const InstrumentInfo& info : kTable) {
    if (info.name == name) return info.id;
    known.push_back(info.name);
  }
  try {
    return parameter_from_name(name);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}, {}", error.what(), fmt::join(known, ", ")));
  }
}

std::string Unknown::name() const {
  const Parameter* parameter = std::get_if<Parameter>(&what);
  const std::string base = parameter != nullptr
                               ? parameter->name()
                               : std::string(instrument_info(std::get<Instrument>(what)).name);
  return scan == kAllScans ? base : fmt::format("{}[{}]", base, scan + 1);
}

std::string_view Unknown::unit() const {
  const Parameter* parameter = std::get_if<Parameter>(&what);
  return parameter != nullptr ? parameter_info(*parameter).unit
                              : instrument_info(std::get<Instrument>(what)).unit;
}

double Unknown::unit_value() const {
  const Instrument* instrument = std::get_if<Instrument>(&what);
  return instrument != nullptr ? instrument_info(*instrument).unit_value : 1;
}

SkyState start_state(const Atmosphere<double>& atmosphere, int scans) {
  std::array<double, kInstrumentCount> instrument{};
  for (const InstrumentInfo& info : kTable)
    instrument[static_cast<std::size_t>(info.id)] = info.start;
  const auto count = static_cast<std::size_t>(scans);
  return {std::vector(count, atmosphere), std::vector(count, instrument), true};
}

double get_unknown(const SkyState& state, const Unknown& unknown) {
  return value_at(state, unknown,
                  unknown.scan == kAllScans ? 0 : static_cast<std::size_t>(unknown.scan));
}

SkyState with_unknowns(SkyState state, const std::vector<Unknown>& unknowns,
                       const Eigen::VectorXd& scaled) {
  for (std::size_t u = 0; u < unknowns.size(); ++u) {
    const Unknown& unknown = unknowns[u];
    const double value = unknown.value(scaled(static_cast<Eigen::Index>(u)));
    const Parameter* parameter = std::get_if<Parameter>(&unknown.what);
    if (parameter != nullptr && unknown.scan != kAllScans) state.one_atmosphere = false;
    for (std::size_t scan = 0; scan < state.atmosphere.size(); ++scan) {
      if (!unknown.applies_to(static_cast<int>(scan))) continue;
      if (parameter != nullptr) {
        set_parameter(state.atmosphere[scan], *parameter, value);
      } else {
        state.instrument[scan][static_cast<std::size_t>(std::get<Instrument>(unknown.what))] =
            value;
      }
    }
  }
  return state;
}

Eigen::VectorXd scaled_values(const std::vector<Unknown>& unknowns, const SkyState& state) {
  Eigen::VectorXd result(unknowns.size());
  for (std::size_t u = 0; u < unknowns.size(); ++u) {
    result(static_cast<Eigen::Index>(u)) =
        std::clamp(unknowns[u].scaled(get_unknown(state, unknowns[u])), 0.0, 1.0);
  }
  return result;
}

SkyPoint pointed(const SkyPoint& stated, double sun_azimuth,
                 const std::array<double, kInstrumentCount>& instrument) {
  const auto of = [&](Instrument id) { return instrument[static_cast<std::size_t>(id)]; };
  SkyPoint result = stated;
  result.relative_azimuth += of(Instrument::kAzimuthOffset);
  const double north = of(Instrument::kTiltNorth), east = of(Instrument::kTiltEast);
  if (north == 0 && east == 0) return result;  // keeps the zenith angle, and with it shared rays
  // x north, y west, z up; the axis leans toward (north, -east): a turn about z x lean.
  const double azimuth = result.relative_azimuth + sun_azimuth;
  const double sin_z = std::sin(result.view_zenith);
  const Eigen::Vector3d direction(sin_z * std::cos(azimuth), -sin_z * std::sin(azimuth),
                                  std::cos(result.view_zenith));
  const Eigen::Vector3d turn(east, north, 0);
  const Eigen::Vector3d leant = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * direction;
  result.view_zenith = std::atan2(std::hypot(leant.x(), leant.y()), leant.z());
  result.relative_azimuth =
      std::remainder(std::atan2(-leant.y(), leant.x()) - sun_azimuth, 2 * std::numbers::pi);
  return result;
}

}  // namespace skyfit::fit
