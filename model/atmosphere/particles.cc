// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/particles.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "model/atmosphere/mie.h"
#include "model/base/content_cache.h"
#include "model/numerics/clones.h"

namespace skyfit {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kCutoff = 4;  // of a distribution, in widths from its median

// Places on a fixed grid of ln x, in steps of 0.02 for small spheres and of 0.005 for large ones,
// whose scattering oscillates faster: place kPlaces (ln x + 3 ln(1 + x / 8)).
constexpr double kPlaces = 50;

double place_of(double x) { return kPlaces * (std::log(x) + 3 * std::log1p(x / 8)); }

// Places per ln x.
double density(double x) { return kPlaces * (1 + 3 * x / (8 + x)); }

// By Newton's method; place_of() is convex in ln x.
double size_parameter_at(int place) {
  double log_x = place / kPlaces;
  for (double step = 1; std::abs(step) > 1e-14 * std::max(1.0, std::abs(log_x));) {
    const double x = std::exp(log_x);
    step = (place - place_of(x)) / density(x);
    log_x += step;
  }
  return std::exp(log_x);
}

enum Slope : std::size_t { kValue, kByRadius, kByWidth, kByReal, kByImaginary };

// Beyond them lies little of what the distribution scatters. Spheres smaller than the wavelength
// scatter as r^3 per volume, which moves their light to larger radii, by 3 sigma^2 in ln r; large
// ones scatter as their area, which moves it down by sigma^2.
std::pair<double, double> radius_limits(const ParticleMode& mode) {
  const double kept = largest_radius_um(mode.radius_um, mode.width),
               of_small = std::min(kept * std::exp(3 * mode.width * mode.width),
                                   3 * mode.wavelength_nm / (2e3 * kPi));
  return {mode.radius_um * std::exp(-(kCutoff + mode.width) * mode.width),
          std::max(kept, of_small)};
}

// Of a sphere on the grid: the area of the cross sections per volume of all.
ParticleValue weight_of(const ParticleMode& mode, double radius_um, double x) {
  const double u = std::log(radius_um / mode.radius_um) / mode.width;
  const double area =
      0.75 / radius_um * std::exp(-0.5 * u * u) / (std::sqrt(2 * kPi) * mode.width * density(x));
  return {area, area * u / (mode.width * mode.radius_um), area * (u * u - 1) / mode.width, 0, 0};
}

// What one sphere scatters, at the angles of the panels.
struct SphereMatrix {
  std::vector<float> phase, polarising, turning;  // m11, m12 and m33 of mie_matrix()
};
struct Sphere {
  MieEfficiencies efficiencies;
  std::vector<SphereMatrix> matrix;  // [0]; [1] and [2] where it has derivatives by the index
};

// From mie_matrix()'s order to ascending angles, with 90 deg once.
void in_order(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::reverse(middle, values.end());
  values.erase(middle);
}

Sphere sphere(double x, std::complex<double> index, bool by_index, const AnglePanels& panels) {
  const MieCoefficients c = mie_coefficients(x, index, by_index);
  Sphere result{mie_efficiencies(x, c), {}};
  for (MieMatrix& matrix : mie_matrix(x, c, panels.forward_cosines())) {
    for (auto* values : {&matrix.m11, &matrix.m12, &matrix.m33}) in_order(*values);
    result.matrix.push_back({{matrix.m11.begin(), matrix.m11.end()},
                             {matrix.m12.begin(), matrix.m12.end()},
                             {matrix.m33.begin(), matrix.m33.end()}});
  }
  return result;
}

SKYFIT_CLONES
void add_scaled(std::size_t count, double factor, const float* from, double* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] += factor * static_cast<double>(from[i]);
}

double dot(std::size_t count, const double* a, const double* b) {
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

// value / by.
void divide(ParticleValue& value, const ParticleValue& by) {
  value[kValue] /= by[kValue];
  for (std::size_t slope = 1; slope < kParticleSlopes; ++slope)
    value[slope] = (value[slope] - value[kValue] * by[slope]) / by[kValue];
}

}  // namespace

// Integrals over the radii.
class ParticleSums {
 public:
  explicit ParticleSums(std::shared_ptr<const AnglePanels> panels)
      : optics_(std::make_shared<ParticleOptics>()) {
    for (auto* values : elements()) values->fill(std::vector<double>(panels->size()));
    optics_->panels_ = std::move(panels);
  }

  // `weight` has the slopes by radius and width.
  void add(const ParticleValue& weight, const Sphere& sphere) {
    const MieEfficiencies& q = sphere.efficiencies;
    add(weight, {q.extinction, q.extinction_by_index[0], q.extinction_by_index[1]},
        optics_->extinction);
    add(weight, {q.scattering, q.scattering_by_index[0], q.scattering_by_index[1]},
        optics_->scattering);
    add(weight, sphere, &SphereMatrix::phase, optics_->phase_);
    add(weight, sphere, &SphereMatrix::polarising, optics_->polarising_);
    add(weight, sphere, &SphereMatrix::turning, optics_->turning_);
  }

  // The spheres' efficiencies are exact; what the panels make of forward peaks is normalised.
  std::shared_ptr<const ParticleOptics> optics() {
    ParticleValue integral;
    for (std::size_t slope = 0; slope < kParticleSlopes; ++slope) {
      const std::vector<double>& values = optics_->phase_[slope];
      integral[slope] = dot(values.size(), optics_->panels_->moment(0), values.data());
    }
    for (auto* values : elements()) {
      for (std::size_t i = 0; i < (*values)[kValue].size(); ++i) {
        ParticleValue at;
        for (std::size_t slope = 0; slope < kParticleSlopes; ++slope)
          at[slope] = (*values)[slope][i];
        divide(at, integral);
        for (std::size_t slope = 0; slope < kParticleSlopes; ++slope)
          (*values)[slope][i] = at[slope];
      }
    }
    return optics_;
  }

 private:
  std::array<ParticleOptics::OfAngles*, 3> elements() const {
    return {&optics_->phase_, &optics_->polarising_, &optics_->turning_};
  }
  static void add(const ParticleValue& weight, const std::array<double, 3>& value,
                  ParticleValue& sum) {
    for (const Slope slope : {kValue, kByRadius, kByWidth}) sum[slope] += weight[slope] * value[0];
    sum[kByReal] += weight[kValue] * value[1];
    sum[kByImaginary] += weight[kValue] * value[2];
  }
  static void add(const ParticleValue& weight, const Sphere& sphere,
                  const std::vector<float> SphereMatrix::*element, ParticleOptics::OfAngles& sums) {
    const std::vector<float>& value = sphere.matrix[0].*element;
    for (const Slope slope : {kValue, kByRadius, kByWidth})
      add_scaled(value.size(), weight[slope], value.data(), sums[slope].data());
    for (std::size_t part = 1; part < sphere.matrix.size(); ++part)
      add_scaled(value.size(), weight[kValue], (sphere.matrix[part].*element).data(),
                 sums[kByReal + part - 1].data());
  }

  std::shared_ptr<ParticleOptics> optics_;
};

// What follows from a mode, in a cache. Slopes by the index are there where they were wanted.
class KeptOptics {
 public:
  KeptOptics(ContentCache& cache, const ParticleMode& mode, bool by_index)
      : cache_(cache), key_("particles"), slopes_(by_index ? kParticleSlopes : kByReal) {
    key_.value(mode.wavelength_nm).value(mode.radius_um).value(mode.width);
    key_.value(mode.index.real()).value(mode.index.imag()).value(by_index);
  }

  std::shared_ptr<const ParticleOptics> find(std::shared_ptr<const AnglePanels> panels) const {
    const auto optics = std::make_shared<ParticleOptics>();
    const auto expected = parts(*optics, panels->size());
    const auto room = [&](std::size_t part, std::uint64_t bytes) -> std::span<std::byte> {
      if (part >= expected.size() || bytes != expected[part].size()) return {};
      return expected[part];
    };
    if (!cache_.find(key_, room)) return nullptr;
    optics->panels_ = std::move(panels);
    return optics;
  }

  void keep(const ParticleOptics& optics) const {
    ParticleOptics copy = optics;
    std::vector<std::span<const std::byte>> kept;
    for (const auto part : parts(copy, copy.panels_->size())) kept.push_back(part);
    cache_.keep(key_, kept);
  }

 private:
  std::vector<std::span<std::byte>> parts(ParticleOptics& optics, std::size_t angles) const {
    std::vector<std::span<std::byte>> all;
    for (ParticleValue* value : {&optics.extinction, &optics.scattering})
      all.push_back(std::as_writable_bytes(std::span(*value)));
    for (auto* element : {&optics.phase_, &optics.polarising_, &optics.turning_}) {
      for (std::size_t slope = 0; slope < kParticleSlopes; ++slope) {
        std::vector<double>& values = (*element)[slope];
        values.resize(angles);
        if (slope < slopes_) all.push_back(std::as_writable_bytes(std::span(values)));
      }
    }
    return all;
  }

  ContentCache& cache_;
  CacheKey key_;
  std::size_t slopes_;
};

namespace {

std::shared_ptr<ContentCache>& particle_cache() {
  static std::shared_ptr<ContentCache> cache;
  return cache;
}

// The same for all.
std::shared_ptr<const AnglePanels> shared_panels() {
  static const auto panels = std::make_shared<const AnglePanels>();
  return panels;
}

}  // namespace

void keep_particles_in(std::shared_ptr<ContentCache> cache) { particle_cache() = std::move(cache); }

// Those of one index by their place on the grid of ln x, as far as they were wanted.
struct ParticleTables::Spheres {
  std::complex<double> index;
  int first = 0;  // place of rows[0]
  std::vector<std::unique_ptr<const Sphere>> rows;

  const Sphere& at(int place) const { return *rows[static_cast<std::size_t>(place - first)]; }

  void make_room(int from, int to) {
    if (rows.empty()) first = from;
    std::vector<std::unique_ptr<const Sphere>> wider(static_cast<std::size_t>(
        std::max(first + static_cast<int>(rows.size()), to + 1) - std::min(first, from)));
    std::ranges::move(rows, wider.begin() + std::max(first - from, 0));
    first = std::min(first, from);
    rows = std::move(wider);
  }

  void fill(int from, int to, bool by_index, const AnglePanels& panels) {
    make_room(from, to);
    // No other task may come in between in this thread, for it could wait for the lock of the
    // tables.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(0, to - from + 1, [&](int i) {
        const int place = to - i;  // those that take longest first
        auto& row = rows[static_cast<std::size_t>(place - first)];
        if (row != nullptr && (!by_index || row->matrix.size() > 1)) return;
        row = std::make_unique<const Sphere>(
            sphere(size_parameter_at(place), index, by_index, panels));
      });
    });
  }
};

double largest_radius_um(double radius_um, double width) {
  return radius_um * std::exp(kCutoff * width);
}

ParticleValue ParticleOptics::at(const OfAngles& values, double angle) const {
  const AnglePanels::Weights at_angle = panels_->at(angle);
  ParticleValue result{};
  for (std::size_t slope = 0; slope < kParticleSlopes; ++slope) {
    for (std::size_t k = 0; k < AnglePanels::kNodes; ++k)
      result[slope] += at_angle.weight[k] * values[slope][at_angle.first + k];
  }
  return result;
}

ParticleValue ParticleOptics::integral(const double* weights, const OfAngles& values) const {
  ParticleValue result;
  for (std::size_t slope = 0; slope < kParticleSlopes; ++slope)
    result[slope] = dot(panels_->size(), weights, values[slope].data());
  return result;
}

namespace {

void check_moment(int l) {
  if (l >= AnglePanels::kMostMoments) {
    throw std::invalid_argument(fmt::format("{} moments of particles: expected at most {}", l + 1,
                                            AnglePanels::kMostMoments));
  }
}

}  // namespace

ParticleValue ParticleOptics::moment(int l) const {
  check_moment(l);
  return integral(panels_->moment(l), phase_);
}

// docs/theory (13.18).
ParticleOptics::MatrixMoments ParticleOptics::matrix_moments(int l) const {
  check_moment(l);
  using Spin = AnglePanels::Spin;
  const double *const kept = panels_->moment(Spin::kKept, l), *const reversed = panels_->moment(
                                                                  Spin::kReversed, l);
  const ParticleValue kept_phase = integral(kept, phase_), kept_turning = integral(kept, turning_),
                      reversed_phase = integral(reversed, phase_),
                      reversed_turning = integral(reversed, turning_);
  MatrixMoments m{{}, {}, integral(panels_->moment(Spin::kNone, l), polarising_)};
  for (std::size_t slope = 0; slope < kParticleSlopes; ++slope) {
    const double sum = kept_phase[slope] + kept_turning[slope],
                 difference = reversed_phase[slope] - reversed_turning[slope];
    m.alpha[slope] = 0.5 * (sum + difference);
    m.zeta[slope] = 0.5 * (sum - difference);
  }
  return m;
}

ParticleTables::ParticleTables() : panels_(shared_panels()) {}
ParticleTables::~ParticleTables() = default;

ParticleTables::Spheres& ParticleTables::spheres_of(std::complex<double> index) const {
  constexpr std::size_t kMostKept = 64;  // of some 2 MB
  const auto known = std::ranges::find(spheres_, index, &Spheres::index);
  if (known != spheres_.end()) {
    std::rotate(known, known + 1, spheres_.end());
    return *spheres_.back();
  }
  if (spheres_.size() == kMostKept) spheres_.erase(spheres_.begin());
  spheres_.push_back(std::make_unique<Spheres>());
  spheres_.back()->index = index;
  return *spheres_.back();
}

// docs/theory (2.19) to (2.22).
std::shared_ptr<const ParticleOptics> ParticleTables::optics(const ParticleMode& mode,
                                                             bool by_index) const {
  const std::lock_guard lock(mutex_);
  const auto known = std::ranges::find_if(
      made_, [&](const Made& each) { return each.mode == mode && each.by_index >= by_index; });
  if (known != made_.end()) return known->optics;
  const double um_per_x = mode.wavelength_nm / (2e3 * kPi);
  const auto [low, high] = radius_limits(mode);
  const double largest = high / um_per_x;
  if (!(largest <= kLargestSizeParameter)) {
    throw std::invalid_argument(fmt::format(
        "particles of radius {:.4g} um and width {:.4g} reach a size parameter of {:.4g} at {:.6g} "
        "nm: expected at most {}",
        mode.radius_um, mode.width, largest, mode.wavelength_nm, kLargestSizeParameter));
  }
  const int first = static_cast<int>(place_of(low / um_per_x)),
            last = static_cast<int>(place_of(largest));
  std::shared_ptr<const ParticleOptics> optics;
  std::optional<KeptOptics> kept;
  if (particle_cache()) {
    kept.emplace(*particle_cache(), mode, by_index);
    optics = kept->find(panels_);
  }
  if (optics == nullptr) {
    Spheres& spheres = spheres_of(mode.index);
    spheres.fill(first, last, by_index, *panels_);
    ParticleSums sums(panels_);
    for (int i = first; i <= last; ++i) {
      const double x = size_parameter_at(i);
      sums.add(weight_of(mode, um_per_x * x, x), spheres.at(i));
    }
    optics = sums.optics();
    if (kept) kept->keep(*optics);
  }
  constexpr std::size_t kMostKept = 256;
  if (made_.size() == kMostKept) made_.erase(made_.begin());
  made_.push_back({mode, by_index, optics});
  return made_.back().optics;
}

}  // namespace skyfit
