// SPDX-License-Identifier: Apache-2.0
#include "model/single_scattering.h"

#include <algorithm>
#include <cmath>

#include "model/parameters.h"

namespace skyfit {
namespace {

// Heights between which every profile and its extinction are smooth enough for the rule: dense
// where an aerosol of the least scale height lives, with the corners of the ozone tent. Profiles
// from tables bring their own besides.
const std::vector<double> kShells = {60,    150,   300,   500,   800,   1200,  1700,  2400,
                                     3300,  4500,  6000,  8000,  10000, 13000, 17000, 21000,
                                     25000, 32000, 40000, 52000, 68000, 84000};
constexpr int kOrder = 3;  // nodes between shells

}  // namespace

std::vector<SingleScatteringSample> single_scattering_samples(const Shells& shells,
                                                              const ViewRay& ray,
                                                              const SunAlongRay& sun) {
  std::vector<double> breaks = shell_crossings(ray, shells.bottom_radius, kShells);
  for (const double s : sun.shadow_edges()) breaks.push_back(s);
  std::vector<SingleScatteringSample> samples;
  for (const QuadratureNode& q : composite_gauss(with_table_breaks(shells, ray, breaks), kOrder)) {
    const RayPoint p = ray_point(ray, shells.bottom_radius, q.s);
    const double mu_s = sun.mu_s(p);
    if (!sun.lit(p, mu_s)) continue;
    SingleScatteringSample sample{p.height, q.weight, columns_along(shells, ray, p)};
    sample.columns += shells.columns_to_top(p.height, mu_s);
    samples.push_back(sample);
  }
  return samples;
}

template <int N>
SingleScattering<N> single_scattering(const Optics<N>& optics,
                                      const std::vector<SingleScatteringSample>& samples) {
  Dual<N> air, aerosol;  // sums over the ray of rho T ds
  for (const SingleScatteringSample& s : samples) {
    const Dual<N> tau = optics.optical_depth(s.columns);
    const double t = std::exp(-tau.v) * s.weight;
    const Dual<N> transmitted = tau.chain(t, -t);
    const Densities<N> rho = optics.densities(s.height);
    air += transmitted * rho.air;
    aerosol += transmitted * rho.aerosol;
  }
  return {optics.air * air, optics.aerosol_scattering * aerosol};
}

template SingleScattering<0> single_scattering<0>(const Optics<0>&,
                                                  const std::vector<SingleScatteringSample>&);
template SingleScattering<kParameterCount> single_scattering<kParameterCount>(
    const Optics<kParameterCount>&, const std::vector<SingleScatteringSample>&);

}  // namespace skyfit
