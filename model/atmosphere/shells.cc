// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/shells.h"

#include <algorithm>
#include <iterator>

#include "model/atmosphere/optics.h"
#include "model/atmosphere/parameter_field.h"

namespace skyfit {
namespace {

struct Depths {
  double extinction = 0, scattering = 0;
};

Depths depths_at_550(const Constituent<double>& c, const Profile& profile) {
  const double column = profile.vertical_column().value;
  const auto at = coefficients_at<0>(with_scalar<Dual<0>>(c), Dual<0>(column), {550, 0});
  return {at.extinction.v * column, at.scattering.v * column};
}

// Which profiles are layers, and the optical depths. Constituents with the same profile count
// together, whether by kSameAs or by the same numbers: a constituent may stand in two halves.
void set_layers(const Atmosphere<double>& a, Shells& shells) {
  const std::size_t count = shells.profiles.size();
  std::vector<double> depth(count), of_scatterers(count), scattering(count);
  for (std::size_t i = 0; i < a.constituents.size(); ++i) {
    if (shells.profile_of[i] == Shells::kNone) continue;
    const auto own = static_cast<std::size_t>(shells.profile_of[i]);
    const Depths of = depths_at_550(a.constituents[i], shells.profiles[own]);
    for (std::size_t k = 0; k < count; ++k) {
      if (shells.profiles[k] != shells.profiles[own]) continue;
      depth[k] += of.extinction;
      scattering[k] += of.scattering;
      if (scatters(a.constituents[i])) of_scatterers[k] += of.extinction;
    }
  }
  // Thick and in a small part of the atmosphere: a cloud, which the levels of clear air miss.
  constexpr double kThick = 0.5, kNarrow = 0.055;
  for (std::size_t k = 0; k < count; ++k) {
    Profile& profile = shells.profiles[k];
    if (!profile.is_exponential() && !profile.is_layer() && of_scatterers[k] > kThick &&
        profile.bulk_thickness() < kNarrow * shells.top)
      profile.take_as_layer();
    shells.layer_depth.push_back(profile.is_layer() ? depth[k] : 0);
    shells.bulk_depth.push_back(profile.is_layer() ? 0 : scattering[k]);
  }
}

}  // namespace

PathColumns Shells::columns_to_top(double height, double mu) const {
  PathColumns c;
  for (const Profile& profile : profiles)
    c.push_back(profile.column_to_top(bottom_radius, height, mu, top));
  return c;
}

Shells shells_of(const Atmosphere<double>& a, Keep keep, std::span<const Parameter> derivatives) {
  Shells shells{a.bottom_radius_m,
                a.top_radius_m - a.bottom_radius_m,
                a.star.angular_radius_rad(),
                {},
                {},
                {},
                {},
                {}};
  const auto matters = [&](const Constituent<double>& c) {
    if (keep != Keep::kWhatMatters) return keep == Keep::kAll || scatters(c);
    return c.amount > 0 || std::ranges::any_of(derivatives, [&](const Parameter& p) {
             return p.constituent() == c.name;
           });
  };
  shells.profile_of.assign(a.constituents.size(), Shells::kNone);
  const auto add = [&](std::size_t i) {
    if (shells.profile_of[i] != Shells::kNone) return;
    shells.profile_of[i] = static_cast<int>(shells.profiles.size());
    shells.profiles.emplace_back(own_profile(a, a.constituents[i]));
    shells.breaks.push_back(a.constituents[i].profile.type == ProfileType::kLayer);
  };
  // Smooth absorbers need none: the columns along a ray are exact.
  const auto note_breaks = [&](std::size_t i) {
    const auto profile = static_cast<std::size_t>(shells.profile_of[i]);
    if (scatters(a.constituents[i]) && !shells.profiles[profile].is_exponential())
      shells.breaks[profile] = true;
  };
  for (std::size_t i = 0; i < a.constituents.size(); ++i) {
    const Constituent<double>& c = a.constituents[i];
    if (!matters(c)) continue;
    if (c.profile.type != ProfileType::kSameAs) {
      add(i);
      note_breaks(i);
      continue;
    }
    const auto other = static_cast<std::size_t>(a.find(c.profile.of) - a.constituents.data());
    add(other);
    shells.profile_of[i] = shells.profile_of[other];
    note_breaks(i);
  }
  set_layers(a, shells);
  return shells;
}

PathColumns columns_along(const Shells& shells, const ViewRay& ray, const RayPoint& point) {
  return columns_along([&](double height, double mu) { return shells.columns_to_top(height, mu); },
                       shells.bottom_radius, ray, point);
}

std::vector<double> with_profile_breaks(const Shells& shells, const ViewRay& ray,
                                        std::vector<double> breaks) {
  for (std::size_t i = 0; i < shells.profiles.size(); ++i) {
    if (!shells.breaks[i]) continue;
    std::ranges::copy(
        shell_crossings(ray, shells.bottom_radius, shells.profiles[i].quadrature_heights()),
        std::back_inserter(breaks));
  }
  std::sort(breaks.begin(), breaks.end());
  return breaks;
}

}  // namespace skyfit
