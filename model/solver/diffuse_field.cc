// SPDX-License-Identifier: Apache-2.0
#include "model/solver/diffuse_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "model/atmosphere/parameter_field.h"
#include "model/numerics/angles.h"
#include "model/solver/fourier_modes.h"

namespace skyfit {

// docs/theory (4.4).
void normalised_legendre(int m, int count, double mu, double* out) {
  const double sine = std::sqrt(std::max(1 - mu * mu, 0.0));
  double diagonal = std::sqrt(0.25 / std::numbers::pi);
  for (int k = 1; k <= m; ++k) diagonal *= sine * std::sqrt((2.0 * k + 1) / (2.0 * k));
  double before = 0, current = diagonal;
  const double m2 = static_cast<double>(m) * m;
  for (int l = m; l < count; ++l) {
    out[l - m] = current;
    const double n = l + 1.0, l2 = static_cast<double>(l) * l;
    const double next = std::sqrt((4 * n * n - 1) / (n * n - m2)) *
                        (mu * current - std::sqrt((l2 - m2) / (4 * l2 - 1)) * before);
    before = current;
    current =
        l == 0 ? std::sqrt(3.0) * mu * diagonal : next;  // at l = 0 the second root has no meaning
  }
}

namespace {

ModeBasis mode_basis(const Streams& streams, const std::vector<double>& sun_mu, int m,
                     int moments) {
  const int own = moments - m;
  ModeBasis basis;
  basis.at_rays.resize(static_cast<std::size_t>(streams.levels()) * streams.most() * own);
  for (int i = 0; i < streams.levels(); ++i) {
    for (int k = 0; k < streams.count(i); ++k)
      normalised_legendre(m, moments, streams.mu(i, k),
                          &basis.at_rays[(i * streams.most() + k) * own]);
  }
  basis.at_suns.resize(sun_mu.size() * own);
  for (std::size_t j = 0; j < sun_mu.size(); ++j)
    normalised_legendre(m, moments, sun_mu[j], &basis.at_suns[j * own]);
  return basis;
}

// docs/theory (4.11).
// Modes that matter to the field of one wavelength: the moments of order m and above of light that
// has been scattered once, scattered again, as a share of all light.
template <int N>
int mode_count(const Optics<N>& optics, int moments, double tolerance) {
  constexpr int kLeast = 3;  // those of molecules
  double all = 1e-300;
  for (const Scatterer<N>& s : optics.scatterers) all += s.scaled_scattering.v;
  for (int m = std::min(moments, kLeast); m < moments; ++m) {
    double rest = 0;
    for (int l = m; l < moments; ++l) {
      double sum = 0;
      for (const Scatterer<N>& s : optics.scatterers) {
        if (l < static_cast<int>(s.moments.size()))
          sum += s.scaled_scattering.v / all * s.moments[l].v * s.moments[l].v;
      }
      rest = std::max(rest, sum);
    }
    if (rest < tolerance) return m;
  }
  return moments;
}

template <int N>
bool any_polarises(std::span<const Optics<N>> optics) {
  return std::ranges::any_of(optics.front().scatterers, polarises<N>);
}

template <int N>
bool any_matrix(std::span<const Optics<N>> optics) {
  return std::ranges::any_of(optics.front().scatterers,
                             [](const Scatterer<N>& s) { return !s.matrix.alpha.empty(); });
}

void unpack(const FourierModes& pack, int lane, int m, DiffuseField& field) {
  LargeArray& out = field.moments[m];
  out.reserve(field.shape.levels * field.shape.level(m));
  for (int i = 0; i < field.shape.levels; ++i) pack.append_moments(lane, i, out);
  if (m == 0) pack.append_ground_irradiance(lane, field.ground_irradiance);
}

// Steps of the iteration that couples the suns: where it does not converge; by day.
constexpr int kFewCouplings = 2, kCouplings = 4;

// The share of new light in each, docs/theory (7.8). With a large share light comes from afar in
// fewer steps, with a small one strong coupling converges: where much light is scattered high above
// the ground, a share of 1 diverges.
constexpr double kShare = 0.8, kTwilightShare = 0.6;

// In deep twilight, where light comes from a node of the sun grid further, and through one layer
// more, with each step or two.
int twilight_couplings(int levels) {
  constexpr int kCouplingsOfDefault = 18, kTwilightLevels = 40;  // of kDefaultLevels by day
  return kCouplingsOfDefault + 2 * std::max(levels - kTwilightLevels, 0) / 3;
}

// Nodes of the sun grid beyond 105 deg, and beyond 96, which few steps do not reach.
constexpr int kDark = 2, kDarkByDay = 8;

// With steps to first order in the place of shares, for atmospheres in which these do not converge.
HorizontalCoupling to_first_order(const HorizontalCoupling& coupling) {
  return {coupling.suns, coupling.coupled, coupling.step, {}, {}, coupling.converges};
}

// Whether the coupling's iteration has led to a twilight: the mean radiance on the ground is above
// 0 and falls from sun to sun, no level's is far above that of the sun before, and suns of the day,
// which know their light from few steps, have kept it. The last `dark` nodes of the suns are not
// looked at.
bool has_converged(const DiffuseField& after_few, const DiffuseField& field,
                   const HorizontalCoupling& coupling, int dark) {
  constexpr double kChange = 0.02, kRise = 2;
  const auto mean = [&](const DiffuseField& f, int level, int sun) {
    return f.moments[0][level * f.shape.level(0) + static_cast<std::size_t>(sun) * f.shape.slices];
  };
  double ground_before = std::numeric_limits<double>::infinity(), largest_before = ground_before;
  for (int j = 0; j < field.shape.suns - dark; ++j) {
    if (!coupling.coupled[j]) continue;
    const double ground = mean(field, 0, j);
    double largest = 0;
    for (int i = 0; i < field.shape.levels; ++i)
      largest = std::max(largest, std::abs(mean(field, i, j)));
    if (coupling.shifted[j]) {
      if (!(ground > 0 && ground < ground_before && largest < kRise * largest_before)) return false;
    } else if (!coupling.shifted[j + 1] &&
               !(std::abs(ground / mean(after_few, 0, j) - 1) < kChange)) {
      return false;
    }
    ground_before = ground;
    largest_before = largest;
  }
  return true;
}

}  // namespace

template <int N>
std::vector<DiffuseField> solve_diffuse_fields(
    const Shells& shells, std::span<const Optics<N>> optics, int slices,
    const std::vector<double>& heights, const std::vector<double>& sun_mu, const Streams& streams,
    const HorizontalCoupling& coupling, const DiffuseOptions& options) {
  const int waves = static_cast<int>(optics.size()), moments = options.moments;
  const bool matrices = options.polarised && any_matrix(optics),
             polarised = options.polarised && (matrices || any_polarises(optics));
  const FieldShape shape{static_cast<int>(heights.size()),
                         moments,
                         static_cast<int>(sun_mu.size()),
                         slices,
                         polarised,
                         matrices};
  std::vector<DiffuseField> fields(waves);
  int modes = 0;
  for (const Optics<N>& o : optics)
    modes = std::max(modes, mode_count(o, moments, options.tolerance));
  if (!coupling.shifted.empty()) modes = std::max(modes, options.shifted_modes);
  for (DiffuseField& field : fields) {
    field.shape = shape;
    field.moments.resize(modes);
  }
  std::vector<ModeBasis> bases(modes);
  tbb::parallel_for(0, modes, [&](int m) { bases[m] = mode_basis(streams, sun_mu, m, moments); });
  const FieldColumns columns = field_columns(shells, heights, sun_mu, streams);
  // As many wavelengths at a time as there are lanes; with few, several modes share the lanes.
  constexpr int kBatchWidth = static_cast<int>(batch::kBatchWidth);
  for (int first = 0; first < waves; first += kBatchWidth) {
    const int width = std::min(kBatchWidth, waves - first), at_once = kBatchWidth / width;
    std::array<const Optics<N>*, batch::kBatchWidth> lane_optics;
    for (int k = 0; k < kBatchWidth; ++k) lane_optics[k] = &optics[first + k % width];
    const auto medium_of = [&](MediumOf light) {
      return layer_medium<N>(lane_optics, static_cast<std::size_t>(slices - 1), heights, sun_mu,
                             columns, streams, moments, light);
    };
    const LayerMedium medium = medium_of(MediumOf::kIntensity);
    std::optional<LayerMedium> medium_of_polarised;
    if (polarised) medium_of_polarised.emplace(medium_of(MediumOf::kPolarised));
    const auto pack_of = [&](int p) {
      LaneModes lane_modes;
      for (int k = 0; k < kBatchWidth; ++k)
        lane_modes[k] = std::min(p * at_once + std::min(k / width, at_once - 1), modes - 1);
      return FourierModes(streams, medium, polarised ? &*medium_of_polarised : nullptr, bases,
                          lane_modes);
    };
    const auto unpack_all = [&](const FourierModes& pack, int p, std::span<DiffuseField> to) {
      for (int k = 0; k < at_once * width && p * at_once + k / width < modes; ++k)
        unpack(pack, k, p * at_once + k / width, to[k % width]);
    };
    const int count = (modes + at_once - 1) / at_once;
    const bool coupled = std::ranges::count(coupling.coupled, 1) > 0 && options.order == 0;
    std::vector<std::optional<FourierModes>> packs(coupled ? count : 0);
    tbb::parallel_for(0, count, [&](int p) {
      FourierModes pack = pack_of(p);
      if (options.order == 0) pack.solve();
      for (int k = 0; k < options.order; ++k) pack.advance();
      if (coupled) {
        packs[p] = std::move(pack);
      } else {
        unpack_all(pack, p, std::span(fields).subspan(first, width));
      }
    });
    const auto couple = [&](const HorizontalCoupling& by, int steps, double share,
                            int first_modes) {
      const int active = std::min(count, (first_modes + at_once - 1) / at_once);
      for (int k = 0; k < steps; ++k) {
        tbb::parallel_for(0, active, [&](int p) { packs[p]->prepare_coupling(by, share); });
        tbb::parallel_for(0, active, [&](int p) { packs[p]->couple(by, packs, at_once, width); });
      }
      std::vector<DiffuseField> now(fields.begin() + first, fields.begin() + first + width);
      tbb::parallel_for(0, count, [&](int p) { unpack_all(*packs[p], p, now); });
      return now;
    };
    if (!coupled) continue;
    std::vector<DiffuseField> result =
        couple(coupling, coupling.converges ? kCouplings : kFewCouplings, kShare, modes);
    if (!coupling.shifted.empty()) {
      std::vector<DiffuseField> more;
      if (options.deep_twilight)
        more = couple(coupling, twilight_couplings(options.levels) - kCouplings, kTwilightShare,
                      options.shifted_modes);
      const auto found = [&](std::size_t w) {
        return more.empty() ? has_converged(result[w], result[w], coupling, kDarkByDay)
                            : has_converged(result[w], more[w], coupling, kDark);
      };
      std::vector<DiffuseField> first_order;
      for (std::size_t w = 0; w < result.size(); ++w) {
        if (found(w)) {
          if (!more.empty()) result[w] = std::move(more[w]);
          continue;
        }
        if (first_order.empty()) {
          tbb::parallel_for(0, count, [&](int p) { packs[p].emplace(pack_of(p)).solve(); });
          first_order = couple(to_first_order(coupling), kCouplings, kShare, modes);
        }
        result[w] = std::move(first_order[w]);
      }
    }
    std::ranges::move(result, fields.begin() + first);
  }
  return fields;
}

template std::vector<DiffuseField> solve_diffuse_fields<0>(
    const Shells&, std::span<const Optics<0>>, int, const std::vector<double>&,
    const std::vector<double>&, const Streams&, const HorizontalCoupling&, const DiffuseOptions&);
template std::vector<DiffuseField> solve_diffuse_fields<kDerivativesAtOnce>(
    const Shells&, std::span<const Optics<kDerivativesAtOnce>>, int, const std::vector<double>&,
    const std::vector<double>&, const Streams&, const HorizontalCoupling&, const DiffuseOptions&);

}  // namespace skyfit
