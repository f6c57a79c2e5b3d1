// SPDX-License-Identifier: Apache-2.0
#include "model/solver/multiple_scattering.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "model/atmosphere/parameter_field.h"
#include "model/numerics/kernels.h"

namespace skyfit {

// A node of a path, with what its points need in every mode.
template <int N>
struct MultipleScattering<N>::Node {
  int path, node;
  std::vector<double> lambda;     // [mode][l], from l = m on
  std::vector<int> index;         // [point][4]
  std::vector<double> even, odd;  // [point][4]
  double mu = 0;
  std::vector<double> wave_factor;  // [mode][point]: (2 - delta_m0) cos m phi; of U 2 sin m phi
};

// Nodes at one height.
template <int N>
struct MultipleScattering<N>::Group {
  LevelStencil levels;
  std::vector<Node> nodes;
};

template <int N>
struct MultipleScattering<N>::Bundle {
  std::span<const PathWithSuns> paths;
  Stokes which;
  std::vector<Group> groups;
  std::vector<std::vector<double>> sums;  // per path [point][slice], of one wavelength
};

namespace {

// cos m phi, of U sin m phi, by Chebyshev's recursion, to out[m * stride].
void set_waves(const SunAlongRay& sun, const RayPoint& p, double mu_s, Stokes which, double* out,
               std::size_t stride, int modes) {
  const SunAlongRay::Azimuth azimuth = which == Stokes::kI
                                           ? SunAlongRay::Azimuth{sun.cos_azimuth(p, mu_s), 0}
                                           : sun.azimuth(p, mu_s);
  const bool sines = which == Stokes::kU;
  double wave = sines ? 0 : 1, before = sines ? -azimuth.sine : azimuth.cosine;
  for (int m = 0; m < modes; ++m) {
    out[m * stride] = m == 0 ? wave : 2 * wave;
    const double next = 2 * azimuth.cosine * wave - before;
    before = wave;
    wave = next;
  }
}

double derivative_of(const Dual<0>&, std::size_t) { return 0; }
template <int N>
double derivative_of(const Dual<N>& x, std::size_t p) {
  return x.d[p];
}

}  // namespace

template <int N>
typename MultipleScattering<N>::Bundle MultipleScattering<N>::bundle_of(
    std::span<const PathWithSuns> paths, Stokes which) const {
  int modes = 0;
  for (const DiffuseField& field : fields_)
    modes = std::max(modes, static_cast<int>(field.moments.size()));
  if (which != Stokes::kI) modes = std::min(modes, kPolarisedModes);
  const int moments = fields_.front().shape.moments;
  Bundle bundle{paths, which, {}, {}};
  std::map<double, std::size_t> groups;
  for (std::size_t path = 0; path < paths.size(); ++path) {
    const std::vector<RayPoint>& nodes = paths[path].path->nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const RayPoint& point = nodes[i];
      const double x = levels_.coordinate(point.height);
      const auto [at, added] = groups.try_emplace(x, bundle.groups.size());
      if (added) bundle.groups.push_back({levels_.stencil(x), {}});
      Node node{static_cast<int>(path), static_cast<int>(i), {}, {}, {}, {}, point.mu, {}};
      node.lambda.resize(static_cast<std::size_t>(modes) * moments);
      for (int m = 0; m < modes; ++m)
        normalised_legendre(m, moments, point.mu, &node.lambda[m * moments + m]);
      const std::size_t points = paths[path].suns.size();
      node.index.reserve(4 * points);
      node.even.reserve(4 * points);
      node.odd.reserve(4 * points);
      node.wave_factor.resize(modes * points);
      for (std::size_t at_point = 0; at_point < points; ++at_point) {
        const SunOfPath& point_sun = paths[path].suns[at_point];
        const RayPoint& sun_point = paths[path].path->sun_points[i];
        const double mu_s = point_sun.sun->mu_s(sun_point);
        const SunStencil stencil = grid_.stencil(mu_s);
        for (const int k : stencil.index) node.index.push_back(solved_[k]);
        node.even.insert(node.even.end(), stencil.even.begin(), stencil.even.end());
        node.odd.insert(node.odd.end(), stencil.odd.begin(), stencil.odd.end());
        set_waves(*point_sun.sun, sun_point, mu_s, which, &node.wave_factor[at_point], points,
                  modes);
      }
      bundle.groups[at->second].nodes.push_back(std::move(node));
    }
  }
  return bundle;
}

// Moments of mode m at the group's height, [l - m][sun][slice].
template <int N>
const double* MultipleScattering<N>::block_at(const Group& group, const DiffuseField& field, int m,
                                              LargeArray& scratch) const {
  const std::size_t size = field.shape.level(m);
  const std::vector<double>& share = group.levels.share;
  const double* first = field.moments[m].data() + group.levels.first * size;
  if (share.size() == 1) return first;
  scratch.assign(size, 0.0);
  for (std::size_t k = 0; k < share.size(); ++k)
    kernels::add_scaled(share[k], first + k * size, scratch.data(), size);
  return scratch.data();
}

// docs/theory (8.5).
template <int N>
void MultipleScattering<N>::add_mode(Bundle& bundle, std::span<const NodeWeights<N>> weights,
                                     int wave, int m) const {
  const DiffuseField& field = fields_[wave];
  const Optics<N>& optics = optics_[wave];
  const auto own = field.shape.rows(m), moments = static_cast<std::size_t>(field.shape.moments - m),
             suns = static_cast<std::size_t>(field.shape.suns),
             slices = static_cast<std::size_t>(field.shape.slices), parameters = slices - 1;
  LargeArray scratch, coefficient, tangent, series, by_sun, change;
  for (const Group& group : bundle.groups) {
    const std::size_t rows = group.nodes.size();
    const double* block = block_at(group, field, m, scratch);
    coefficient.resize(rows * own);
    tangent.resize(own * rows * parameters);
    for (std::size_t r = 0; r < rows; ++r) {
      const Node& node = group.nodes[r];
      const double* const lambda = &node.lambda[m * field.shape.moments + m];
      for (std::size_t k = 0; k < own; ++k) {
        // After the moments, what air makes of the second moment of Q and U.
        const bool polarised = k == moments;
        const std::size_t l = polarised ? 2 : k + static_cast<std::size_t>(m);
        const bool of_air = polarised || bundle.which != Stokes::kI;
        double function = lambda[l - static_cast<std::size_t>(m)];
        if (bundle.which != Stokes::kI)
          function = l == 2 ? component(rayleigh_stokes(m, node.mu), bundle.which) : 0;
        Dual<N> c;
        for (std::size_t s = 0; s < optics.scatterers.size(); ++s) {
          const std::vector<Dual<N>>& chi = optics.scatterers[s].moments;
          if (l < chi.size() && (!of_air || polarises(optics.scatterers[s])))
            c += weights[node.path][s][node.node] * chi[l];
        }
        coefficient[r * own + k] = c.v * function;
        for (std::size_t p = 0; p < parameters; ++p)
          tangent[(k * rows + r) * parameters + p] = derivative_of(c, p) * function;
      }
    }
    series.resize(rows * field.shape.row());
    kernels::multiply(coefficient.data(), block, series.data(), rows, own, field.shape.row());
    if (parameters > 0) {
      by_sun.resize(suns * own);
      for (std::size_t j = 0; j < suns; ++j) {
        for (std::size_t k = 0; k < own; ++k) by_sun[j * own + k] = block[(k * suns + j) * slices];
      }
      const std::size_t columns = rows * parameters;
      change.resize(suns * columns);
      kernels::multiply(by_sun.data(), tangent.data(), change.data(), suns, own, columns);
      for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t j = 0; j < suns; ++j) {
          for (std::size_t p = 0; p < parameters; ++p)
            series[(r * suns + j) * slices + 1 + p] += change[j * columns + r * parameters + p];
        }
      }
    }
    for (std::size_t r = 0; r < rows; ++r) {
      const Node& node = group.nodes[r];
      kernels::accumulate_suns(series.data() + r * field.shape.row(), slices, node.index.data(),
                               m % 2 == 0 ? node.even.data() : node.odd.data(),
                               &node.wave_factor[m * (node.index.size() / 4)],
                               node.index.size() / 4, bundle.sums[node.path].data());
    }
  }
}

template <int N>
void MultipleScattering<N>::add(std::span<const PathWithSuns> paths, Stokes which) const {
  Bundle bundle = bundle_of(paths, which);
  std::vector<NodeWeights<N>> weights(paths.size());
  for (std::size_t wave = 0; wave < fields_.size(); ++wave) {
    const auto slices = static_cast<std::size_t>(fields_[wave].shape.slices);
    bundle.sums.clear();
    for (std::size_t i = 0; i < paths.size(); ++i) {
      weights[i] = node_weights(optics_[wave], *paths[i].path, bundle.which != Stokes::kI);
      bundle.sums.emplace_back(paths[i].suns.size() * slices, 0.0);
    }
    const auto modes = static_cast<int>(fields_[wave].moments.size());
    for (int m = 0; m < (which == Stokes::kI ? modes : std::min(modes, kPolarisedModes)); ++m)
      add_mode(bundle, weights, static_cast<int>(wave), m);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      for (std::size_t k = 0; k < paths[i].suns.size(); ++k) {
        for (std::size_t p = 0; p < slices; ++p)
          paths[i].suns[k].out[wave * slices + p] += bundle.sums[i][k * slices + p];
      }
    }
  }
}

template class MultipleScattering<0>;
template class MultipleScattering<kDerivativesAtOnce>;

}  // namespace skyfit
