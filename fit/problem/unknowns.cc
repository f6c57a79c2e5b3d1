// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/unknowns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace skyfit::fit {
namespace {

double value_at(const SkyState& state, const Unknown& unknown, std::size_t scan) {
  if (const Parameter* parameter = std::get_if<Parameter>(&unknown.what))
    return get_parameter(state.atmosphere[scan], *parameter);
  return state.instrument[scan][static_cast<std::size_t>(std::get<Instrument>(unknown.what))];
}

}  // namespace

std::variant<Parameter, Instrument> unknown_from_name(std::string_view name) {
  std::vector<std::string_view> known;
  for (const InstrumentInfo& info : instrument_table()) {
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
  InstrumentState instrument{};
  for (const InstrumentInfo& info : instrument_table())
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

}  // namespace skyfit::fit
