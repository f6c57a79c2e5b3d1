// SPDX-License-Identifier: Apache-2.0
#include "model/solver/layer_medium.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "model/atmosphere/parameter_field.h"
#include "model/shared/shared.h"

namespace skyfit {
namespace {

Shared<double> shared;  // stateless
constexpr std::size_t kBatchWidth = batch::kBatchWidth;

double derivative(const Dual<0>&, std::size_t) { return 0; }
template <int N>
double derivative(const Dual<N>& x, std::size_t p) {
  return x.d[p];
}

// docs/theory (3.10) and (3.11).
// I = t I_far + near J_near + far J_far and the derivatives of near and far by x.
struct DiffuseWeights {
  double t, near, far, near_slope, far_slope;
};
DiffuseWeights diffuse_weights(double x) {
  const double t = std::exp(-x);
  if (x < 1e-2) {  // series: (1 - exp(-x)) / x = 1 - x/2 + x^2/6 - ..
    return {t, x * (1.0 / 2 - x * (1.0 / 6 - x * (1.0 / 24 - x * (1.0 / 120 - x / 720)))),
            x * (1.0 / 2 - x * (1.0 / 3 - x * (1.0 / 8 - x * (1.0 / 30 - x / 144)))),
            1.0 / 2 - x * (1.0 / 3 - x * (1.0 / 8 - x * (1.0 / 30 - x / 144))),
            1.0 / 2 - x * (2.0 / 3 - x * (3.0 / 8 - x * (4.0 / 30 - x * 5.0 / 144)))};
  }
  const double mean = -std::expm1(-x) / x, mean_slope = (t - mean) / x;
  return {t, 1 - mean, mean - t, -mean_slope, mean_slope + t};
}

// docs/theory (3.13).
// Integrals over u = 0 .. 1 of exp(-y u) times 1 - u, u and u^2.
struct BeamIntegrals {
  double a, b, c;
};
BeamIntegrals beam_integrals(double y) {
  if (std::abs(y) < 0.5) {  // integral u^n exp(-y u) = sum_k (-y)^k / (k! (n + k + 1))
    double term = 1, sum[3] = {};
    for (int k = 0; k < 14; ++k) {
      for (int n = 0; n < 3; ++n) sum[n] += term / (n + k + 1);
      term *= -y / (k + 1);
    }
    return {sum[0] - sum[1], sum[1], sum[2]};
  }
  const double e = std::exp(-y);
  const double i0 = (1 - e) / y, i1 = (i0 - e) / y, i2 = (2 * i1 - e) / y;
  return {i0 - i1, i1, i2};
}

// docs/theory (3.12) and (3.14).
// Values and slopes by x, the near end's and the far end's depth of the sun.
struct BeamWeight {
  double near, far;
  std::array<double, 3> near_slope, far_slope;
};
BeamWeight beam_weight(double x, const DiffuseWeights& diffuse, bool lit_near, bool lit_far,
                       double near_depth, double far_depth) {
  constexpr double kSteepest = 300;  // beyond, the darker end has nothing to give
  const bool exponential = lit_near && lit_far && std::abs(far_depth - near_depth) < kSteepest;
  if (!exponential) {
    const double t_near = lit_near ? std::exp(-near_depth) : 0;
    const double t_far = lit_far ? std::exp(-far_depth) : 0;
    return {diffuse.near * t_near,
            diffuse.far * t_far,
            {diffuse.near_slope * t_near, -diffuse.near * t_near, 0},
            {diffuse.far_slope * t_far, 0, -diffuse.far * t_far}};
  }
  const BeamIntegrals i = beam_integrals(x + far_depth - near_depth);
  const double beam = std::exp(-near_depth);
  const auto slopes = [&](double integral, double by_y) {
    return std::array<double, 3>{beam * (integral + x * by_y), -x * beam * (integral + by_y),
                                 x * beam * by_y};
  };
  return {x * beam * i.a, x * beam * i.b, slopes(i.a, i.c - i.b), slopes(i.b, -i.c)};
}

// Calls f for every array of lanes.
template <class F>
void for_each_array(LayerMedium& m, const F& f) {
  const auto of_matrix = [&](LayerMedium::Matrix& matrix) {
    for (Batch* array : {&matrix.alpha, &matrix.zeta, &matrix.gamma}) f(*array);
  };
  for (LayerMedium::Scatterer& s : m.scatterers) {
    f(s.chi);
    of_matrix(s.matrix);
    std::ranges::for_each(s.share, f);
    std::ranges::for_each(s.share_tangent, f);
  }
  for (LayerMedium::PhaseTangent& t : m.phase_tangents) {
    f(t.chi);
    of_matrix(t.matrix);
  }
  std::ranges::for_each(m.sun_depth_tangent, f);
  for (Batch* array : {&m.ground_beam, &m.ground_albedo, &m.ground_albedo_tangent}) f(*array);
  for (LayerMedium::Layer& layer : m.layers) {
    for (Batch* array : {&layer.t, &layer.near, &layer.far, &layer.near_slope, &layer.far_slope,
                         &layer.depth_tangent})
      f(*array);
    for (BeamWeights* w : {&layer.down, &layer.up}) {
      f(w->near);
      f(w->far);
      std::ranges::for_each(w->near_slope, f);
      std::ranges::for_each(w->far_slope, f);
    }
  }
}

void copy_lane(LayerMedium& m, std::size_t from, std::size_t to) {
  for_each_array(m, [&](Batch& array) {
    for (std::size_t i = 0; i < array.size(); i += kBatchWidth) array[i + to] = array[i + from];
  });
}

void resize(BeamWeights& w, std::size_t size, bool slopes) {
  w.near.resize(size);
  w.far.resize(size);
  for (std::size_t k = 0; k < 3 && slopes; ++k) {
    w.near_slope[k].resize(size);
    w.far_slope[k].resize(size);
  }
}

void set(BeamWeights& w, std::size_t at, const BeamWeight& weight) {
  w.near[at] = weight.near;
  w.far[at] = weight.far;
  for (std::size_t k = 0; k < 3 && !w.near_slope[0].empty(); ++k) {
    w.near_slope[k][at] = weight.near_slope[k];
    w.far_slope[k][at] = weight.far_slope[k];
  }
}

// Fills one lane of a medium whose arrays have their sizes.
template <int N>
class LaneFiller {
 public:
  LaneFiller(const Optics<N>& optics, const FieldColumns& columns, const Streams& streams,
             std::size_t lane, MediumOf light, LayerMedium& medium)
      : optics_(optics),
        extinction_(light == MediumOf::kIntensity ? optics.scaled_extinction
                                                  : optics.polarised_extinction),
        columns_(columns),
        streams_(streams),
        lane_(lane),
        medium_(medium) {}

  void fill_levels(const std::vector<double>& heights) {
    const auto set_phase = [&](auto& to, const Scatterer<N>& from, const auto& part) {
      for (const auto& [out, in] : {std::pair{&to.chi, &from.moments},
                                    {&to.matrix.alpha, &from.matrix.alpha},
                                    {&to.matrix.zeta, &from.matrix.zeta},
                                    {&to.matrix.gamma, &from.matrix.gamma}}) {
        for (std::size_t l = 0; l < in->size(); ++l)
          (*out)[l * kBatchWidth + lane_] = part((*in)[l]);
      }
    };
    for (std::size_t k = 0; k < optics_.scatterers.size(); ++k)
      set_phase(medium_.scatterers[k], optics_.scatterers[k],
                [](const Dual<N>& chi) { return chi.v; });
    for (LayerMedium::PhaseTangent& tangent : medium_.phase_tangents)
      set_phase(tangent, optics_.scatterers[tangent.scatterer],
                [&](const Dual<N>& chi) { return derivative(chi, tangent.parameter); });
    for (std::size_t i = 0; i < heights.size(); ++i)
      set_level(i, optics_.densities_at_level(heights[i > 0 ? i - 1 : 0], heights[i],
                                              heights[std::min(i + 1, heights.size() - 1)]));
    medium_.ground_albedo[lane_] = optics_.ground_albedo.v;
    put(medium_.ground_albedo_tangent, 0, optics_.ground_albedo);
    for (std::size_t j = 0; j < medium_.suns; ++j) {
      medium_.ground_beam[j * kBatchWidth + lane_] =
          columns_.lit[j] ? std::exp(-sun_depth_[j].v) : 0;
    }
  }

  // After fill_levels().
  void set_layer(int i) {
    LayerMedium::Layer& layer = medium_.layers[i];
    const std::size_t suns = medium_.suns, below = i * suns, above = below + suns;
    for (int k = 0; k < streams_.count(i); ++k) {
      PathColumns c = columns_.rays[i * streams_.most() + k];
      c -= columns_.rays[(i + 1) * streams_.most() + k];
      const Dual<N> depth = optics_.optical_depth_by(extinction_, c);
      const DiffuseWeights w = diffuse_weights(depth.v);
      const std::size_t ray = static_cast<std::size_t>(k), at = ray * kBatchWidth + lane_;
      layer.t[at] = w.t;
      layer.near[at] = w.near;
      layer.far[at] = w.far;
      layer.near_slope[at] = w.near_slope;
      layer.far_slope[at] = w.far_slope;
      put(layer.depth_tangent, ray, depth);
      for (std::size_t j = 0; j < suns; ++j) {
        const bool lit = columns_.lit[below + j], lit_above = columns_.lit[above + j];
        const double tau = sun_depth_[below + j].v, tau_above = sun_depth_[above + j].v;
        const std::size_t sun_at = (ray * suns + j) * kBatchWidth + lane_;
        set(layer.down, sun_at, beam_weight(depth.v, w, lit, lit_above, tau, tau_above));
        set(layer.up, sun_at, beam_weight(depth.v, w, lit_above, lit, tau_above, tau));
      }
    }
  }

 private:
  void put(Batch& tangent, std::size_t index, const Dual<N>& x) const {
    for (std::size_t p = 0; p < medium_.parameters; ++p)
      tangent[(index * medium_.parameters + p) * kBatchWidth + lane_] = derivative(x, p);
  }

  // docs/theory (4.6): the share of each scatterer.
  void set_level(std::size_t level, const Densities<N>& rho) {
    Dual<N> extinction;
    for (std::size_t k = 0; k < optics_.profiles.size(); ++k) extinction += extinction_[k] * rho[k];
    const bool empty = !(extinction.v > 0);
    for (std::size_t k = 0; k < optics_.scatterers.size(); ++k) {
      const Scatterer<N>& scatterer = optics_.scatterers[k];
      const Dual<N> share =
          empty ? Dual<N>() : scatterer.scaled_scattering * rho[scatterer.profile] / extinction;
      medium_.scatterers[k].share[level][lane_] = share.v;
      put(medium_.scatterers[k].share_tangent[level], 0, share);
    }
    for (std::size_t j = 0; j < medium_.suns; ++j) {
      sun_depth_.push_back(optics_.scaled_optical_depth(columns_.suns[level * medium_.suns + j]));
      put(medium_.sun_depth_tangent[level], j, sun_depth_.back());
    }
  }

  const Optics<N>& optics_;
  const std::vector<Dual<N>>& extinction_;
  const FieldColumns& columns_;
  const Streams& streams_;
  const std::size_t lane_;
  LayerMedium& medium_;
  std::vector<Dual<N>> sun_depth_;  // [level][sun]
};

}  // namespace

FieldColumns field_columns(const Shells& shells, const std::vector<double>& heights,
                           const std::vector<double>& sun_mu, const Streams& streams) {
  FieldColumns c;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const int level = static_cast<int>(i);
    for (int k = 0; k < streams.most(); ++k) {
      c.rays.push_back(k < streams.count(level)
                           ? shells.columns_to_top(heights[i], streams.mu(level, k))
                           : PathColumns{});
    }
    for (const double mu : sun_mu) {
      const bool lit =
          mu >= 0 || shared.sphere_discriminant(shells.bottom_radius, heights[i], mu, 0) < 0;
      c.lit.push_back(lit);
      c.suns.push_back(lit ? shells.columns_to_top(heights[i], mu) : PathColumns{});
    }
  }
  return c;
}

bool LayerMedium::has_matrices() const {
  return std::ranges::any_of(scatterers,
                             [](const Scatterer& s) { return !s.matrix.alpha.empty(); });
}

template <int N>
LayerMedium layer_medium(const std::array<const Optics<N>*, batch::kBatchWidth>& optics,
                         std::size_t parameters, const std::vector<double>& heights,
                         const std::vector<double>& sun_mu, const FieldColumns& columns,
                         const Streams& streams, int moments, MediumOf light) {
  LayerMedium m;
  m.moments = moments;
  m.suns = sun_mu.size();
  m.parameters = parameters;
  m.sun_mu = sun_mu;
  const auto sized = [](std::size_t elements) { return Batch(elements * kBatchWidth, 0.0); };
  const std::size_t l_count = static_cast<std::size_t>(moments);
  m.sun_depth_tangent.assign(heights.size(), sized(m.suns * parameters));
  m.scatterers.assign(optics[0]->scatterers.size(),
                      {false,
                       sized(l_count),
                       {},
                       std::vector<Batch>(heights.size(), sized(1)),
                       std::vector<Batch>(heights.size(), sized(parameters))});
  for (std::size_t k = 0; k < m.scatterers.size(); ++k) {
    m.scatterers[k].polarises = polarises(optics[0]->scatterers[k]);
    const bool has_matrix = !optics[0]->scatterers[k].matrix.alpha.empty();
    const auto matrix = [&] {
      const Batch array = has_matrix ? sized(l_count) : Batch();
      return LayerMedium::Matrix{array, array, array};
    };
    m.scatterers[k].matrix = matrix();
    for (std::size_t p = 0; p < parameters; ++p) {
      const bool changes = std::ranges::any_of(optics, [&](const Optics<N>* o) {
        return std::ranges::any_of(o->scatterers[k].moments,
                                   [&](const Dual<N>& chi) { return derivative(chi, p) != 0; });
      });
      if (changes) m.phase_tangents.push_back({k, p, sized(l_count), matrix()});
    }
  }
  m.ground_beam = sized(m.suns);
  m.ground_albedo = sized(1);
  m.ground_albedo_tangent = sized(parameters);
  m.layers.resize(heights.size() - 1);
  for (std::size_t i = 0; i < m.layers.size(); ++i) {
    const auto rays = static_cast<std::size_t>(streams.count(static_cast<int>(i)));
    LayerMedium::Layer& layer = m.layers[i];
    for (Batch* v : {&layer.t, &layer.near, &layer.far, &layer.near_slope, &layer.far_slope})
      *v = sized(rays);
    layer.depth_tangent = sized(rays * parameters);
    resize(layer.down, rays * m.suns * kBatchWidth, parameters > 0);
    resize(layer.up, rays * m.suns * kBatchWidth, parameters > 0);
  }
  std::vector<LaneFiller<N>> fillers;  // of the first lane of each wavelength
  std::array<std::size_t, kBatchWidth> first;
  for (std::size_t lane = 0; lane < kBatchWidth; ++lane) {
    first[lane] = static_cast<std::size_t>(
        std::find(optics.begin(), optics.begin() + lane, optics[lane]) - optics.begin());
    if (first[lane] < lane) continue;
    fillers.emplace_back(*optics[lane], columns, streams, lane, light, m);
    fillers.back().fill_levels(heights);
  }
  tbb::parallel_for(0, streams.levels() - 1, [&](int i) {
    for (LaneFiller<N>& filler : fillers) filler.set_layer(i);
  });
  for (std::size_t lane = 0; lane < kBatchWidth; ++lane) {
    if (first[lane] < lane) copy_lane(m, first[lane], lane);
  }
  return m;
}

template LayerMedium layer_medium<0>(const std::array<const Optics<0>*, batch::kBatchWidth>&,
                                     std::size_t, const std::vector<double>&,
                                     const std::vector<double>&, const FieldColumns&,
                                     const Streams&, int, MediumOf);
template LayerMedium layer_medium<kDerivativesAtOnce>(
    const std::array<const Optics<kDerivativesAtOnce>*, batch::kBatchWidth>&, std::size_t,
    const std::vector<double>&, const std::vector<double>&, const FieldColumns&, const Streams&,
    int, MediumOf);

}  // namespace skyfit
