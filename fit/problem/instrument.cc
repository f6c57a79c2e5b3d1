// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/instrument.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

// - Azimuth offset: a compass beside a metal tripod may be wrong by anything; the sky says it
// better.
// - Tilt: a spirit level holds 1 deg.
// - Scale: radiance calibrations of field spectrometers claim 5 %.
constexpr std::array<InstrumentInfo, kInstrumentCount> kTable = {{
    {Instrument::kAzimuthOffset, "instrument.azimuth_offset", "deg", kRadiansPerDegree, 0,
     -60 * kRadiansPerDegree, 60 * kRadiansPerDegree, Prior{0, 30 * kRadiansPerDegree},
     "true minus stated azimuth, clockwise"},
    {Instrument::kTiltNorth, "instrument.tilt_north", "deg", kRadiansPerDegree, 0,
     -10 * kRadiansPerDegree, 10 * kRadiansPerDegree, Prior{0, 1 * kRadiansPerDegree},
     "lean of the instrument's axis toward north"},
    {Instrument::kTiltEast, "instrument.tilt_east", "deg", kRadiansPerDegree, 0,
     -10 * kRadiansPerDegree, 10 * kRadiansPerDegree, Prior{0, 1 * kRadiansPerDegree},
     "lean of the instrument's axis toward east"},
    {Instrument::kScale, "instrument.scale", "1", 1, 1, 1e-3, 1e3, Prior{1, 0.05},
     "measured over true value"},
}};

}  // namespace

std::span<const InstrumentInfo, kInstrumentCount> instrument_table() { return kTable; }

const InstrumentInfo& instrument_info(Instrument id) {
  return kTable.at(static_cast<std::size_t>(id));
}

std::string_view pointing_name(Pointing pointing) {
  switch (pointing) {
    case Pointing::kAzimuth:
      return "azimuth";
    case Pointing::kAzimuthAndTilt:
      return "tilt";
    case Pointing::kStated:
      break;
  }
  return "stated";
}

SkyPoint pointed(const SkyPoint& stated, double sun_azimuth, const InstrumentState& instrument) {
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
