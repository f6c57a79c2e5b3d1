// SPDX-License-Identifier: Apache-2.0
#include "model/literature/oneil.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <charconv>
#include <numbers>
#include <stdexcept>

#include "model/atmosphere/phase_moments.h"
#include "model/geometry/sun_along_ray.h"
#include "model/literature/evaluate.h"
#include "model/shared/shared.h"

namespace skyfit {
namespace {

bool is_oneils_geometry(const Atmosphere<double>& a) {
  constexpr double kThickness = 0.025, kScaleDepth = 0.25, kSame = 1e-3;
  const double thickness = a.top_radius_m - a.bottom_radius_m;
  const auto same = [](double x, double y) { return std::abs(x / y - 1) < kSame; };
  return same(thickness / a.bottom_radius_m, kThickness) &&
         std::ranges::all_of(a.constituents, [&](const Constituent<double>& c) {
           return !scatters(c) || (c.profile.type == ProfileType::kExponential &&
                                   same(c.profile.scale_height_m / thickness, kScaleDepth));
         });
}

// The columns of one atmosphere by the polynomial or in closed form.
class Depths {
 public:
  Depths(const Atmosphere<double>& atmosphere, ONeilDepths depths)
      : shells_(shells_of(atmosphere, Keep::kScatterers)),
        polynomial_(depths == ONeilDepths::kPolynomial) {}

  const Shells& shells() const { return shells_; }
  double bottom() const { return shells_.bottom_radius; }
  PathColumns to_top(double height, double mu) const {
    if (!polynomial_) return shells_.columns_to_top(height, mu);
    const double slant = Shared<double>{}.oneil_slant(mu);
    PathColumns columns;
    for (const Profile& profile : shells_.profiles) {  // H exp(-h / H) slant
      const Density density = profile.density(height);
      const double by_scale_height = density.value + profile.scale_height() * density.by_shape[0];
      columns.push_back(
          {slant * profile.scale_height() * density.value, {slant * by_scale_height}});
    }
    return columns;
  }
  // From the ray's beginning.
  PathColumns along(const ViewRay& ray, const RayPoint& point) const {
    return columns_along([&](double height, double mu) { return to_top(height, mu); }, bottom(),
                         ray, point);
  }

 private:
  Shells shells_;
  bool polynomial_;
};

// What a ray needs of its samples, whatever the wavelength.
struct Sample {
  double height;
  PathColumns columns;  // from the eye and on to the sun
};
struct Path {
  View view;
  double step = 0;
  std::vector<Sample> lit;  // by the sun
  bool ground_lit = false;
  double ground_mu_s = 0;
  PathColumns ground_columns;
};
Path path_of(const Atmosphere<double>& atmosphere, const Depths& depths,
             const ONeilChoices& choices, const SkyPoint& point) {
  Path path{literature::view_of(atmosphere, point), 0, {}, false, 0, {}};
  const ViewRay& ray = path.view.ray;
  const SunAlongRay sun(depths.bottom(), ray, point);
  path.step = ray.length / choices.samples;
  const auto columns = [&](const RayPoint& at, double mu_s) {
    PathColumns c = depths.along(ray, at);
    return c += depths.to_top(at.height, mu_s);
  };
  for (int i = 0; i < choices.samples && ray.length > 0; ++i) {
    const RayPoint at = ray_point(ray, depths.bottom(), path.step * (i + 0.5));
    const double mu_s = sun.mu_s(at);
    if (choices.shadow == ONeilShadow::kNone || sun.lit(at, mu_s))
      path.lit.push_back({at.height, columns(at, mu_s)});
  }
  if (ray.hits_ground) {
    const RayPoint at = ray_point(ray, depths.bottom(), ray.length);
    path.ground_mu_s = sun.mu_s(at);
    path.ground_lit = path.ground_mu_s > 0;
    if (path.ground_lit) path.ground_columns = columns(at, path.ground_mu_s);
  }
  return path;
}

template <int N>
literature::RayLight<N> light_of(const literature::ClearAir<N>& air, const Path& path,
                                 ONeilAirPhase phase) {
  Dual<N> by_air(0.0), by_aerosol(0.0);
  for (const Sample& sample : path.lit) {
    const Dual<N> through = exp(-air.optical_depth(sample.columns));
    const auto density = air.densities(sample.height);
    by_air += density.air * through;
    by_aerosol += density.aerosol * through;
  }
  const double nu = path.view.nu;
  literature::RayLight<N> light;
  const double air_phase = phase == ONeilAirPhase::kIsotropic
                               ? 1 / (4 * std::numbers::pi)
                               : Shared<double>{}.rayleigh_phase(air.depolarisation, nu);
  light.air = path.step * air_phase * air.air * by_air;
  light.aerosol = path.step * air.aerosol_scattering * phase_value(air.phase, nu) * by_aerosol;
  if (path.ground_lit) {
    light.ground = air.ground_albedo * (path.ground_mu_s / std::numbers::pi) *
                   exp(-air.optical_depth(path.ground_columns));
  }
  return light;
}

std::vector<Path> paths_of(const Atmosphere<double>& atmosphere, const Depths& depths,
                           const ONeilChoices& choices, std::span<const SkyPoint> points,
                           int threads) {
  std::vector<Path> paths(points.size());
  tbb::task_arena(threads).execute([&] {
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
      paths[i] = path_of(atmosphere, depths, choices, points[i]);
    });
  });
  return paths;
}

}  // namespace

ONeilModel::ONeilModel(int threads, const ONeilChoices& choices)
    : threads_(threads), choices_(choices), name_("oneil") {
  if (choices.samples != ONeilChoices{}.samples)
    name_ += fmt::format(":{}{}", kSamplesN.substr(0, kSamplesN.size() - 1), choices.samples);
  if (choices.phase == ONeilAirPhase::kIsotropic) name_.append(":").append(kIsotropicAir);
  if (choices.shadow == ONeilShadow::kNone) name_.append(":").append(kNoShadow);
  check_model_value(name_, threads >= 1, "threads", threads, ">= 1");
  check_model_value(name_, choices.samples >= 1 && choices.samples <= kMostSamples, "samples",
                    choices.samples, fmt::format("1 to {}", kMostSamples));
}

ONeilChoices oneil_choices(std::span<const std::string_view> names) {
  constexpr std::string_view kPrefix =
      ONeilModel::kSamplesN.substr(0, ONeilModel::kSamplesN.size() - 1);
  ONeilChoices choices;
  for (const std::string_view name : names) {
    if (name == ONeilModel::kIsotropicAir) choices.phase = ONeilAirPhase::kIsotropic;
    if (name == ONeilModel::kNoShadow) choices.shadow = ONeilShadow::kNone;
    if (name.starts_with(kPrefix))
      std::from_chars(name.data() + kPrefix.size(), name.data() + name.size(), choices.samples);
  }
  return choices;
}

ONeilChoices ONeilModel::choices_for(const Atmosphere<double>& atmosphere) const {
  ONeilChoices choices = choices_;
  if (is_oneils_geometry(atmosphere)) {
    choices.depths = ONeilDepths::kPolynomial;
  } else if (choices.shadow == ONeilShadow::kNone) {
    throw std::invalid_argument(fmt::format(
        "{} model: atmosphere: must be 0.025 planet radii thick, with scale heights of a quarter "
        "of that: the source's polynomial, without which there is no light in the planet's shadow "
        "to speak of, holds for that alone",
        name_));
  }
  return choices;
}

Atmosphere<double> ONeilModel::effective_atmosphere(const Atmosphere<double>& atmosphere) const {
  return literature::without_absorption(atmosphere);
}

SkyValues ONeilModel::radiance(const Atmosphere<double>& atmosphere,
                               std::span<const WavelengthNode> wavelengths,
                               std::span<const SkyPoint> points,
                               std::span<const Parameter> derivatives) const {
  literature::check_request(name_, atmosphere, points, derivatives);
  const ONeilChoices choices = choices_for(atmosphere);
  const Depths depths(atmosphere, choices.depths);
  const std::vector<Path> paths = paths_of(atmosphere, depths, choices, points, threads_);
  return literature::evaluate<literature::kAllAtOnce>(
      atmosphere, wavelengths, points.size(), derivatives,
      [&]<int N>(const Atmosphere<Dual<N>>& air, const WavelengthNode& node,
                 std::span<Dual<N>> out) {
        const auto optics =
            literature::clear_air(depths.shells(), literature::without_absorption(air), node);
        for (std::size_t i = 0; i < paths.size(); ++i)
          out[i] = light_of(optics, paths[i], choices.phase).sum();
      });
}

ScatteredLight ONeilModel::scattered_light(const Atmosphere<double>& atmosphere,
                                           std::span<const WavelengthNode> wavelengths,
                                           std::span<const SkyPoint> points) const {
  literature::check_request(name_, atmosphere, points, {});
  const ONeilChoices choices = choices_for(atmosphere);
  const Depths depths(atmosphere, choices.depths);
  const std::vector<Path> paths = paths_of(atmosphere, depths, choices, points, threads_);
  const auto air = literature::without_absorption(seeded<0>(atmosphere, {}));
  ScatteredLight light;
  light.air.resize(points.size() * wavelengths.size());
  light.aerosol.resize(light.air.size());
  for (std::size_t w = 0; w < wavelengths.size(); ++w) {
    const auto optics = literature::clear_air(depths.shells(), air, wavelengths[w]);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const literature::RayLight<0> of_ray = light_of(optics, paths[i], choices.phase);
      light.air[i * wavelengths.size() + w] = of_ray.air.v;
      light.aerosol[i * wavelengths.size() + w] = of_ray.aerosol.v;
    }
  }
  return light;
}

std::optional<SkyRayTables> ONeilModel::sky_rays(const Atmosphere<double>& atmosphere,
                                                 std::span<const WavelengthNode, 4>) const {
  const Table none{1, 1, 1, std::vector<float>(4)};
  SkyRayTables rays{SkyRayMapping::kONeil, none, none};
  rays.oneil = choices_for(atmosphere);
  return rays;
}

bool ONeilModel::can_fit(const Parameter& parameter) const {
  return literature::can_fit_without_absorption(parameter);
}

}  // namespace skyfit
