// SPDX-License-Identifier: Apache-2.0
#include "render/glsl/table_defines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

#include "model/tables/diffuse_source.h"

namespace skyfit {

std::vector<std::string> table_defines(const AtmosphereTables& tables) {
  const Atmosphere<double>& a = tables.atmosphere;
  const TableSizes& s = tables.sizes;
  std::vector<int> phase_types, lobe_types;
  for (const PhaseFunction<double>& phase : tables.phases.others) {
    phase_types.push_back(static_cast<int>(phase.type));
    lobe_types.push_back(static_cast<int>(phase.lobe));
  }
  const double sun_radius = a.star.angular_radius_rad();
  std::vector<std::string> defined = {
      fmt::format("CLASSES {}", tables.phases.others.size()),
      fmt::format("PHASE_TYPES {}", fmt::join(phase_types, ", ")),
      fmt::format("LOBE_TYPES {}", fmt::join(lobe_types, ", ")),
      fmt::format("BOTTOM_KM {:.9g}", 1e-3 * a.bottom_radius_m),
      fmt::format("THICKNESS_KM {:.9g}", 1e-3 * (a.top_radius_m - a.bottom_radius_m)),
      fmt::format("LOWEST_SUN {:.9g}", kTableLowestSun),
      fmt::format("SUN_RADIUS {:.9g}", sun_radius),
      fmt::format("SUN_SOLID_ANGLE {:.9g}",
                  4 * std::numbers::pi * std::pow(std::sin(0.5 * sun_radius), 2)),
      fmt::format("LIMB_DARKENING {:.9g}, {:.9g}", a.star.limb_darkening[0],
                  a.star.limb_darkening[1]),
      fmt::format("OPTICAL_DEPTH_SIZE {}, {}", s.optical_depth_mu, s.optical_depth_r),
      fmt::format("IRRADIANCE_SIZE {}, {}", s.irradiance_mu_s, s.irradiance_r),
      fmt::format("SCATTERING_SIZE {}, {}, {}, {}", s.scattering_mu_s, s.scattering_azimuth,
                  s.scattering_ground, s.scattering_sky),
      fmt::format("SCATTERING_HEIGHTS {}", s.scattering_r)};
  if (const std::vector<double>& nodes = tables.heights.nodes(); !nodes.empty())
    defined.insert(defined.end(), {fmt::format("HEIGHT_NODES {}", nodes.size()),
                                   fmt::format("DECK_NODE {}", tables.heights.deck_node())});
  return defined;
}

std::vector<std::string> lasting_table_defines(const AtmosphereTables& tables) {
  std::vector<std::string> defined = table_defines(tables);
  if (const std::vector<double>& nodes = tables.heights.nodes(); !nodes.empty())
    defined.push_back(fmt::format("HEIGHT_UNITS {:.9g}", fmt::join(nodes, ", ")));
  return defined;
}

std::vector<std::array<double, 4>> phase_parameters(const PhaseClasses& phases) {
  std::vector<std::array<double, 4>> parameters;
  for (const PhaseFunction<double>& phase : phases.others) {
    parameters.push_back({phase.type == PhaseType::kRayleigh ? phase.depolarisation : phase.g,
                          phase.g1, phase.g2, phase.weight});
  }
  return parameters;
}

}  // namespace skyfit
