// SPDX-License-Identifier: Apache-2.0
#include "model/solver/reference_model.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "model/atmosphere/parameter_field.h"
#include "model/atmosphere/refraction.h"
#include "model/numerics/angles.h"
#include "model/shared/shared.h"
#include "model/solver/single_scattering.h"
#include "model/solver/sky_solution.h"
#include "model/solver/view_rays.h"

namespace skyfit {
namespace {

void check_option(bool good, std::string_view name, double value, std::string_view expected) {
  check_model_value("reference", good, name, value, expected);
}

template <int N>
std::vector<char> profiles_of_scatterers(const Optics<N>& optics) {
  std::vector<char> scattering(optics.profiles.size());
  for (const Scatterer<N>& s : optics.scatterers) scattering[s.profile] = true;
  return scattering;
}

// Of I, Q and U, or of I alone.
template <class T>
using ByStokes = std::map<Stokes, std::vector<T>>;

// docs/theory (13.2) and (13.3).
// Per unit of single_scattering(): what a phase function or matrix makes of unpolarised light.
template <int N>
Dual<N> phase_of(const Scatterer<N>& scatterer, const SunAlongRay& sun, double nu, Stokes which) {
  if (which == Stokes::kI) return phase_value(scatterer.phase, nu);
  const SunAlongRay::Azimuth turn = sun.twice_the_turn();
  return polarising_phase_value(scatterer.phase, nu) *
         (which == Stokes::kQ ? turn.cosine : turn.sine);
}

template <int N>
PhaseAtNodes<N> phases_at(const Optics<N>& optics, const SunAlongRay& sun,
                          const std::vector<double>& nu, Stokes which) {
  PhaseAtNodes<N> phases;
  for (const Scatterer<N>& scatterer : optics.scatterers) {
    std::vector<Dual<N>>& of_scatterer = phases.emplace_back();
    for (const double at : nu) of_scatterer.push_back(phase_of(scatterer, sun, at, which));
  }
  return phases;
}

// Light scattered once, [point][wavelength].
template <int N>
ByStokes<Dual<N>> single_scattering_of(const Shells& shells, const std::vector<Optics<N>>& optics,
                                       const ViewRays& rays, const std::vector<SunAlongRay>& suns,
                                       std::span<const Stokes> wanted) {
  const std::vector<char> scattering = profiles_of_scatterers(optics.front());
  const auto nodes_of = [&](const ViewPath& path, const std::vector<double>& edges) {
    return ray_nodes(shells, scattering, path.ray, edges, N > 0);
  };
  std::vector<RayNodes> nodes(rays.paths.size());
  tbb::parallel_for(std::size_t{0}, nodes.size(),
                    [&](std::size_t i) { nodes[i] = nodes_of(rays.paths[i], {}); });
  ByStokes<Dual<N>> light;
  for (const Stokes which : wanted) light[which].resize(suns.size() * optics.size());
  tbb::parallel_for(std::size_t{0}, suns.size(), [&](std::size_t i) {
    const ViewPath& path = rays.paths[rays.path_of_point[i]];
    if (path.nodes.empty()) return;
    const std::vector<double> edges = suns[i].shadow_edges();
    RayNodes own;
    if (!edges.empty()) own = nodes_of(path, edges);
    const RayNodes& along = edges.empty() ? nodes[rays.path_of_point[i]] : own;
    const SunlitNodes sunlit = sunlit_nodes(shells, along, suns[i]);
    for (std::size_t w = 0; w < optics.size(); ++w) {
      std::vector<Dual<N>> single;
      if (!suns[i].is_refracted()) single = single_scattering(optics[w], along, sunlit);
      for (auto& [which, values] : light) {
        Dual<N>& sum = values[i * optics.size() + w];
        if (suns[i].is_refracted()) {
          for (const Dual<N>& of_scatterer : single_scattering(
                   optics[w], along, sunlit, phases_at(optics[w], suns[i], sunlit.nu, which)))
            sum += of_scatterer;
        }
        for (std::size_t s = 0; s < single.size(); ++s)
          sum += single[s] * phase_of(optics[w].scatterers[s], suns[i], suns[i].nu(), which);
      }
    }
  });
  return light;
}

// Light scattered more often, added to light[point][wavelength][slice].
template <int N>
void add_multiple_scattering(const SkySolution<N>& solution, const ViewRays& rays,
                             const std::vector<SunAlongRay>& suns, std::size_t slices_per_point,
                             Stokes which, std::vector<double>& light) {
  std::vector<PathWithSuns> bundles;
  for (const ViewPath& path : rays.paths) bundles.push_back({&path, {}});
  for (std::size_t i = 0; i < suns.size(); ++i)
    bundles[rays.path_of_point[i]].suns.push_back({&suns[i], &light[i * slices_per_point]});
  const MultipleScattering<N> scattering = solution.multiple_scattering();
  constexpr std::size_t kAtOnce = MultipleScattering<N>::kPathsAtOnce;
  tbb::parallel_for(std::size_t{0}, (bundles.size() + kAtOnce - 1) / kAtOnce, [&](std::size_t i) {
    scattering.add(
        std::span(bundles).subspan(i * kAtOnce, std::min(kAtOnce, bundles.size() - i * kAtOnce)),
        which);
  });
}

// Interpolation over suns and levels rings where it is dark beside light, by less than a thousandth
// of daylight: there is none. More says that the diffuse field is wrong.
void expect_no_negative(SkyValues& values, std::span<const WavelengthNode> wavelengths,
                        std::span<const SkyPoint> points) {
  constexpr double kRinging = 1e-3;  // 1/sr; a clear sky has 0.05
  for (std::size_t cell = 0; cell < values.value.size(); ++cell) {
    double& radiance = values.value[cell];
    if (!(radiance >= -kRinging)) {
      const SkyPoint& at = points[cell / wavelengths.size()];
      throw BeyondTheSolver(fmt::format(
          "reference model: the diffuse field is negative, {:.3g} 1/sr at {:.6g} nm, sun {:.4g} "
          "deg and view {:.4g} deg from the zenith: this atmosphere is more than the solver can "
          "do (thick, hardly absorbing, with a narrow lobe or high above its planet)",
          radiance, wavelengths[cell % wavelengths.size()].wavelength_nm,
          at.sun_zenith / kRadiansPerDegree, at.view_zenith / kRadiansPerDegree));
    }
    radiance = std::max(radiance, 0.0);
  }
}

// Puts together what single scattering (and the ground) and multiple scattering give; either may be
// left out by its order.
template <int N>
SkyValues sum_of(const std::vector<Dual<N>>& single, const std::vector<double>& multiple,
                 int points, std::size_t wavelengths, std::size_t parameters, bool further) {
  SkyValues values{points, static_cast<int>(wavelengths), static_cast<int>(parameters), {}, {}};
  values.value.resize(single.size());
  values.derivative.resize(single.size() * parameters);
  for (std::size_t cell = 0; cell < single.size(); ++cell) {
    const double* more = further ? &multiple[cell * (1 + parameters)] : nullptr;
    values.value[cell] = single[cell].v + (more ? more[0] : 0);
    if constexpr (N > 0) {
      for (std::size_t p = 0; p < parameters; ++p)
        values.derivative[p * single.size() + cell] = single[cell].d[p] + (more ? more[1 + p] : 0);
    }
  }
  return values;
}

// What is asked of the model.
template <int N>
struct Question {
  const Shells& shells;
  const std::vector<Optics<N>>& optics;
  std::size_t derivatives;
  const ReferenceOptions& options;
  std::span<const Stokes> wanted;
};

// The wanted Stokes parameters of points that take the same fields, in their order.
template <int N>
std::vector<SkyValues> solve_points(const Question<N>& question, std::span<const SkyPoint> points,
                                    FieldsOf kind, const LightTurns* turns) {
  const auto& [shells, optics, derivatives, options, wanted] = question;
  const LevelGrid levels(
      shells, field_grid(shells, options.levels, kind == FieldsOf::kDeepTwilight).levels);
  const ViewRays rays = distinct_view_rays(shells, levels.heights(), points);
  const SunsAlongRays suns = suns_along_rays(shells, rays, points, turns);
  const bool first = options.order <= 1, further = options.order != 1;
  ByStokes<Dual<N>> single;
  for (const Stokes which : wanted) single[which].resize(points.size() * optics.size());
  std::optional<SkySolution<N>> solution;  // none where no ray meets the atmosphere
  tbb::parallel_invoke(
      [&] {
        if (suns.needed.empty()) return;
        solution.emplace(shells, levels, optics, derivatives, suns.needed, options, kind);
      },
      [&] {
        if (first) single = single_scattering_of(shells, optics, rays, suns.along, wanted);
      });
  std::vector<Dual<N>>& intensity = single[Stokes::kI];
  for (std::size_t cell = 0; cell < intensity.size(); ++cell) {
    const std::size_t point = cell / optics.size(), wave = cell % optics.size();
    const ViewPath& path = rays.paths[rays.path_of_point[point]];
    if (path.nodes.empty()) continue;
    intensity[cell] +=
        solution->ground(path, suns.along[point], static_cast<int>(wave), first, further);
  }
  const std::size_t slices = 1 + derivatives;
  std::vector<SkyValues> result;
  for (const Stokes which : wanted) {
    std::vector<double> multiple(points.size() * optics.size() * slices, 0.0);
    if (solution)
      add_multiple_scattering(*solution, rays, suns.along, optics.size() * slices, which, multiple);
    result.push_back(sum_of(single[which], multiple, static_cast<int>(points.size()), optics.size(),
                            derivatives, further));
  }
  return result;
}

// Puts the values of some points, `places` among all of them, where they belong.
void scatter(const SkyValues& some, std::span<const std::size_t> places, SkyValues& all) {
  const auto waves = static_cast<std::size_t>(all.wavelengths);
  const std::size_t cells = all.value.size();
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (std::size_t w = 0; w < waves; ++w) {
      const std::size_t from = k * waves + w, to = places[k] * waves + w;
      all.value[to] = some.value[from];
      for (std::size_t p = 0; p * cells < all.derivative.size(); ++p)
        all.derivative[p * cells + to] = some.derivative[p * some.value.size() + from];
    }
  }
}

// The wanted Stokes parameters, in their order.
template <int N>
std::vector<SkyValues> solve(const Atmosphere<double>& atmosphere,
                             std::span<const WavelengthNode> wavelengths,
                             std::span<const SkyPoint> points,
                             std::span<const Parameter> derivatives,
                             const ReferenceOptions& options, std::span<const Stokes> wanted) {
  Shells shells = shells_of(atmosphere, Keep::kWhatMatters, derivatives);
  std::optional<Refraction> refraction;
  std::vector<SkyPoint> refracted;
  if (options.refraction) {
    refraction.emplace(atmosphere, wavelengths.front().wavelength_nm);
    shells = refraction->refracted(shells);
    refracted.assign(points.begin(), points.end());
    for (SkyPoint& p : refracted) p.altitude_m = refraction->refractive_height(p.altitude_m);
    points = refracted;
  }
  const LightTurns* const turns = refraction ? &*refraction : nullptr;
  std::vector<Optics<N>> optics;
  const auto seeded_atmosphere = seeded<N>(atmosphere, derivatives);
  for (const WavelengthNode& node : wavelengths)
    optics.push_back(optics_at(shells, seeded_atmosphere, node, options.moments,
                               wanted.size() > 1 ? Wanted::kStokes : Wanted::kRadiance));
  const Question<N> question{shells, optics, derivatives.size(), options, wanted};
  const std::size_t cells = points.size() * optics.size();
  std::vector<SkyValues> result(wanted.size(),
                                {static_cast<int>(points.size()), static_cast<int>(optics.size()),
                                 static_cast<int>(derivatives.size()), std::vector<double>(cells),
                                 std::vector<double>(cells * derivatives.size())});
  const auto kind_of = [&](const SkyPoint& point) {
    const FieldsOf kind = fields_of(shells, point, turns);
    const bool is_same =
        shifted_modes(options.moments, true) == shifted_modes(options.moments, false);
    return kind == FieldsOf::kLowSuns && is_same ? FieldsOf::kDay : kind;
  };
  for (const FieldsOf kind : {FieldsOf::kDay, FieldsOf::kLowSuns, FieldsOf::kDeepTwilight}) {
    std::vector<std::size_t> places;
    std::vector<SkyPoint> some;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (kind_of(points[i]) != kind) continue;
      places.push_back(i);
      some.push_back(points[i]);
    }
    if (some.empty()) continue;
    const std::vector<SkyValues> values = solve_points(question, some, kind, turns);
    for (std::size_t k = 0; k < result.size(); ++k) scatter(values[k], places, result[k]);
  }
  expect_no_negative(result.front(), wavelengths, points);
  return result;
}

// Of one wavelength after another where each has its own rays.
template <int N>
std::vector<SkyValues> solve_by_wavelength(const Atmosphere<double>& atmosphere,
                                           std::span<const WavelengthNode> wavelengths,
                                           std::span<const SkyPoint> points,
                                           std::span<const Parameter> derivatives,
                                           const ReferenceOptions& options,
                                           std::span<const Stokes> wanted) {
  const std::size_t count = wavelengths.size();
  if (!options.refraction || count <= 1)
    return solve<N>(atmosphere, wavelengths, points, derivatives, options, wanted);
  std::vector<SkyValues> all(
      wanted.size(),
      {static_cast<int>(points.size()), static_cast<int>(count),
       static_cast<int>(derivatives.size()), std::vector<double>(points.size() * count),
       std::vector<double>(points.size() * count * derivatives.size())});
  for (std::size_t w = 0; w < count; ++w) {
    const std::vector<SkyValues> one =
        solve<N>(atmosphere, wavelengths.subspan(w, 1), points, derivatives, options, wanted);
    for (std::size_t k = 0; k < all.size(); ++k) {
      for (std::size_t i = 0; i < one[k].value.size(); ++i)
        all[k].value[i * count + w] = one[k].value[i];
      for (std::size_t i = 0; i < one[k].derivative.size(); ++i)
        all[k].derivative[i * count + w] = one[k].derivative[i];
    }
  }
  return all;
}

// The same, of any number of derivatives.
std::vector<SkyValues> solve_all(const Atmosphere<double>& atmosphere,
                                 std::span<const WavelengthNode> wavelengths,
                                 std::span<const SkyPoint> points,
                                 std::span<const Parameter> derivatives,
                                 const ReferenceOptions& options, std::span<const Stokes> wanted) {
  tbb::task_arena arena(options.threads);
  return arena.execute([&] {
    if (derivatives.empty())
      return solve_by_wavelength<0>(atmosphere, wavelengths, points, {}, options, wanted);
    return in_batches<kDerivativesAtOnce>(derivatives, [&](std::span<const Parameter> batch) {
      return solve_by_wavelength<kDerivativesAtOnce>(atmosphere, wavelengths, points, batch,
                                                     options, wanted);
    });
  });
}

}  // namespace

ReferenceModel::ReferenceModel(const ReferenceOptions& options) : options_(options) {
  check_option(options.streams >= 4, "streams", options.streams, ">= 4");
  check_option(options.moments >= 3 && options.moments <= 2 * options.streams, "moments",
               options.moments, "in 3 .. 2 streams");
  check_option(options.levels >= 4, "levels", options.levels, ">= 4");
  check_option(options.threads >= 1, "threads", options.threads, ">= 1");
  check_option(options.tolerance > 0, "tolerance", options.tolerance, "> 0");
  check_option(options.order >= 0, "order", options.order, ">= 0");
}

void ReferenceModel::check(const Atmosphere<double>& atmosphere, std::span<const SkyPoint> points,
                           std::span<const Parameter> derivatives) const {
  validate(atmosphere);
  for (const SkyPoint& p : points) check_point("reference", p);
  for (const Parameter& p : derivatives) check_derivative("reference", atmosphere, p);
  if (!derivatives.empty())
    check_option(options_.order == 0, "order", options_.order, "0 where derivatives are asked for");
}

SkyValues ReferenceModel::radiance(const Atmosphere<double>& atmosphere,
                                   std::span<const WavelengthNode> wavelengths,
                                   std::span<const SkyPoint> points,
                                   std::span<const Parameter> derivatives) const {
  check(atmosphere, points, derivatives);
  constexpr Stokes kWanted[] = {Stokes::kI};
  return solve_all(atmosphere, wavelengths, points, derivatives, options_for(atmosphere, options_),
                   kWanted)
      .front();
}

StokesValues ReferenceModel::stokes(const Atmosphere<double>& atmosphere,
                                    std::span<const WavelengthNode> wavelengths,
                                    std::span<const SkyPoint> points,
                                    std::span<const Parameter> derivatives) const {
  if (options_.transfer == Transfer::kScalar)
    return SkyModel::stokes(atmosphere, wavelengths, points, derivatives);
  check(atmosphere, points, derivatives);
  constexpr Stokes kWanted[] = {Stokes::kI, Stokes::kQ, Stokes::kU};
  std::vector<SkyValues> all = solve_all(atmosphere, wavelengths, points, derivatives,
                                         options_for(atmosphere, options_), kWanted);
  return {std::move(all[0]), std::move(all[1]), std::move(all[2])};
}

}  // namespace skyfit
