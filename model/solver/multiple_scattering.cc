// SPDX-License-Identifier: Apache-2.0
#include "model/solver/multiple_scattering.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "model/atmosphere/parameter_field.h"
#include "model/numerics/kernels.h"
#include "model/solver/spin_basis.h"

namespace skyfit {

// A node of a path, with what its points need in every mode.
template <int N>
struct MultipleScattering<N>::Node {
  int path, node;
  std::vector<double> lambda;     // [mode][l], from l = m on
  std::vector<double> r, t;       // [mode][l], of spin_functions(); of fields with matrices
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
  if (which != Stokes::kI) modes = std::min(modes, stokes_modes());
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
      Node node{static_cast<int>(path), static_cast<int>(i), {}, {}, {}, {}, {}, {}, point.mu, {}};
      node.lambda.resize(static_cast<std::size_t>(modes) * moments);
      for (int m = 0; m < modes; ++m)
        normalised_legendre(m, moments, point.mu, &node.lambda[m * moments + m]);
      if (which != Stokes::kI && fields_.front().shape.matrices) {
        node.r.resize(node.lambda.size());
        node.t.resize(node.lambda.size());
        for (int m = 0; m < modes; ++m)
          spin_functions(m, moments, point.mu, &node.r[m * moments], &node.t[m * moments]);
      }
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

// docs/theory (8.5), (13.14) and (13.19).
// What a unit of a row of the field's block gives to the light at a node.
template <int N>
Dual<N> MultipleScattering<N>::row_coefficient(const Node& node, const NodeWeights<N>& weights,
                                               const Optics<N>& optics, const FieldShape& shape,
                                               Stokes which, int m, int row) const {
  const int intensity = shape.moments - m, air = intensity + (shape.polarised_mode(m) ? 1 : 0),
            spin = shape.spin_rows(m);
  enum class Of { kIntensity, kAir, kB, kC };
  const Of of = row < intensity    ? Of::kIntensity
                : row < air        ? Of::kAir
                : row < air + spin ? Of::kB
                                   : Of::kC;
  const int l = of == Of::kIntensity ? row + m
                : of == Of::kAir     ? 2
                                     : (row - air) % std::max(spin, 1) + std::max(m, 2);
  const std::size_t at_l = static_cast<std::size_t>(l),
                    entry = static_cast<std::size_t>(m * shape.moments + l);
  Dual<N> sum;
  const auto add = [&](std::size_t s, const std::vector<Dual<N>>& factor, double function) {
    if (at_l < factor.size()) sum += weights[s][node.node] * factor[at_l] * function;
  };
  for (std::size_t s = 0; s < optics.scatterers.size(); ++s) {
    const Scatterer<N>& scatterer = optics.scatterers[s];
    if (which == Stokes::kI && (of == Of::kIntensity || (of == Of::kAir && polarises(scatterer))))
      add(s, scatterer.moments, node.lambda[entry]);
    if (which != Stokes::kI && polarises(scatterer) && l == 2 &&
        (of == Of::kIntensity || of == Of::kAir))
      add(s, scatterer.moments, component(rayleigh_stokes(m, node.mu), which));
    if (scatterer.matrix.alpha.empty()) continue;
    if (which == Stokes::kI) {
      if (of == Of::kB) add(s, scatterer.matrix.gamma, node.lambda[entry]);
      continue;
    }
    const double kept = which == Stokes::kQ ? node.r[entry] : -node.t[entry],
                 turned = which == Stokes::kQ ? -node.t[entry] : node.r[entry];
    if (of == Of::kIntensity) add(s, scatterer.matrix.gamma, kept);
    if (of == Of::kB) add(s, scatterer.matrix.alpha, kept);
    if (of == Of::kC) add(s, scatterer.matrix.zeta, turned);
  }
  return sum;
}

template <int N>
void MultipleScattering<N>::add_mode(Bundle& bundle, std::span<const NodeWeights<N>> weights,
                                     int wave, int m) const {
  const DiffuseField& field = fields_[wave];
  const Optics<N>& optics = optics_[wave];
  const auto own = field.shape.rows(m), suns = static_cast<std::size_t>(field.shape.suns),
             slices = static_cast<std::size_t>(field.shape.slices), parameters = slices - 1;
  LargeArray scratch, coefficient, tangent, series, by_sun, change;
  for (const Group& group : bundle.groups) {
    const std::size_t rows = group.nodes.size();
    const double* block = block_at(group, field, m, scratch);
    coefficient.resize(rows * own);
    tangent.resize(own * rows * parameters);
    for (std::size_t r = 0; r < rows; ++r) {
      const Node& node = group.nodes[r];
      for (std::size_t k = 0; k < own; ++k) {
        const Dual<N> c = row_coefficient(node, weights[node.path], optics, field.shape,
                                          bundle.which, m, static_cast<int>(k));
        coefficient[r * own + k] = c.v;
        for (std::size_t p = 0; p < parameters; ++p)
          tangent[(k * rows + r) * parameters + p] = derivative_of(c, p);
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
      weights[i] = node_weights(optics_[wave], *paths[i].path);
      bundle.sums.emplace_back(paths[i].suns.size() * slices, 0.0);
    }
    const auto modes = static_cast<int>(fields_[wave].moments.size());
    for (int m = 0; m < (which == Stokes::kI ? modes : std::min(modes, stokes_modes())); ++m)
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
