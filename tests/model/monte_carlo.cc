// SPDX-License-Identifier: Apache-2.0
#include "tests/model/monte_carlo.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "model/atmosphere/parameter_field.h"

namespace skyfit::truth {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kLayers = 500;
constexpr int kMoments = 64;  // optics_at() wants some; nothing here depends on them
using Vector = Eigen::Vector3d;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double operator()() { return distribution_(engine_); }

 private:
  std::mt19937_64 engine_;
  std::uniform_real_distribution<double> distribution_{1e-15, 1.0};
};

// Cosine of a scattering angle under Henyey & Greenstein's phase function.
double sample_henyey_greenstein(double g, Random& random) {
  const double u = random();
  if (std::abs(g) < 1e-4) return 2 * u - 1;
  const double t = (1 - g * g) / (1 - g + 2 * g * u);
  return (1 + g * g - t * t) / (2 * g);
}

// Under 1 + nu^2 times what `sample` draws from.
template <class Sample>
double sample_with_square(const Sample& sample, Random& random) {
  for (;;) {
    const double nu = sample();
    if (2 * random() < 1 + nu * nu) return nu;
  }
}

double sample_aerosol(const PhaseFunction<Dual<0>>& phase, Random& random) {
  const auto cornette_shanks = [&](double g) {
    return sample_with_square([&] { return sample_henyey_greenstein(g, random); }, random);
  };
  if (phase.type == PhaseType::kHenyeyGreenstein)
    return sample_henyey_greenstein(phase.g.v, random);
  if (phase.type == PhaseType::kCornetteShanks) return cornette_shanks(phase.g.v);
  return cornette_shanks(random() < phase.weight.v ? phase.g1.v : phase.g2.v);
}

double sample_air(Random& random) {
  return sample_with_square([&] { return 2 * random() - 1; }, random);
}

// The direction turned by an angle of cosine c, at a random azimuth.
Vector turned(const Vector& direction, double c, Random& random) {
  const Vector u = direction.unitOrthogonal(), v = direction.cross(u);
  const double s = std::sqrt(std::max(1 - c * c, 0.0)), azimuth = 2 * kPi * random();
  return (c * direction + s * (std::cos(azimuth) * u + std::sin(azimuth) * v)).normalized();
}

}  // namespace

MonteCarlo::MonteCarlo(const Atmosphere<double>& atmosphere, const WavelengthNode& node)
    : shells_(shells_of(atmosphere, Keep::kWhatMatters)),
      optics_(literature::clear_air(shells_, seeded<0>(atmosphere, {}), node)),
      ground_albedo_(atmosphere.ground_albedo) {
  for (int i = 0; i <= kLayers; ++i) {
    const double x = static_cast<double>(i) / kLayers;
    heights_.push_back(shells_.top * x * x);
  }
  for (int i = 0; i < kLayers; ++i) {
    PathColumns c = shells_.columns_to_top(heights_[i], 1);
    c -= shells_.columns_to_top(heights_[i + 1], 1);
    const double thickness = heights_[i + 1] - heights_[i];
    const auto mean = [&](double coefficient, int profile) {
      if (profile < 0) return 0.0;
      return coefficient * std::max(c[static_cast<std::size_t>(profile)].value, 0.0) / thickness;
    };
    air_.push_back(mean(optics_.air.v, optics_.air_profile));
    scattering_.push_back(air_.back() +
                          mean(optics_.aerosol_scattering.v, optics_.aerosol_profile));
    extinction_.push_back(0);
    for (std::size_t k = 0; k < shells_.profiles.size(); ++k)
      extinction_.back() += mean(optics_.extinction[k].v, static_cast<int>(k));
  }
}

int MonteCarlo::layer_of(double height) const {
  return std::clamp(static_cast<int>(std::sqrt(std::max(height, 0.0) / shells_.top) * kLayers), 0,
                    kLayers - 1);
}

// Calls layer(index, s, length) along a ray until it returns true; index -1 is the ground, kLayers
// the top.
template <class Layer>
void MonteCarlo::walk(double height, double mu, const Layer& layer) const {
  const double r = shells_.bottom_radius + height, along = r * mu, impact2 = r * r - along * along;
  const auto half_chord2 = [&](double h) {
    const double radius = shells_.bottom_radius + h;
    return radius * radius - impact2;
  };
  int i = layer_of(height);
  double s = 0;
  for (bool down = mu < 0; i < kLayers;) {
    const double below = half_chord2(heights_[i]);
    down = down && below >= 0;
    const double next =
        std::max(s, down ? -along - std::sqrt(below)
                         : -along + std::sqrt(std::max(half_chord2(heights_[i + 1]), 0.0)));
    if (layer(i, s, next - s)) return;
    s = next;
    i += down ? -1 : 1;
    if (i < 0) break;
  }
  layer(i, s, 0.0);
}

MonteCarlo::Step MonteCarlo::fly(double height, double mu, double depth) const {
  Step step{-1, false};
  double passed = 0;
  walk(height, mu, [&](int i, double s, double length) {
    if (i < 0) step = {s, true};
    if (i < 0 || i >= kLayers) return true;
    const double here = extinction_[i] * length;
    if (passed + here >= depth) {
      step.distance = s + (depth - passed) / extinction_[i];
      return true;
    }
    passed += here;
    return false;
  });
  return step;
}

double MonteCarlo::to_sun(double height, double mu_s) const {
  const double r = shells_.bottom_radius + height, bottom = shells_.bottom_radius;
  if (mu_s < 0 && bottom * bottom >= r * r * (1 - mu_s * mu_s)) return 0;
  return std::exp(-optics_.optical_depth(shells_.columns_to_top(std::max(height, 0.0), mu_s)).v);
}

MonteCarloResult MonteCarlo::radiance(const SkyPoint& point, long histories,
                                      std::uint64_t seed) const {
  Random random(seed);
  Shared<double> shared;
  const double bottom = shells_.bottom_radius;
  const Vector sun(std::sin(point.sun_zenith), 0, std::cos(point.sun_zenith));
  const double sine = std::sin(point.view_zenith);
  const Vector view(sine * std::cos(point.relative_azimuth),
                    sine * std::sin(point.relative_azimuth), std::cos(point.view_zenith));
  const ViewRay ray = view_ray(bottom, shells_.top, point.altitude_m, std::cos(point.view_zenith));
  if (ray.length <= 0) return {0, 0, 0};
  const Vector entry = Vector(0, 0, bottom + point.altitude_m) + ray.entry_distance * view;
  const double entry_height = std::min(ray.entry_height, shells_.top * (1 - 1e-12));
  double depth = 0;  // of the whole view ray
  walk(entry_height, ray.entry_mu, [&](int i, double, double length) {
    if (i >= 0 && i < kLayers) depth += extinction_[i] * length;
    return false;
  });
  const double any_event = ray.hits_ground ? 1 : -std::expm1(-depth);

  double single = 0, sum = 0, squares = 0;
  for (long k = 0; k < histories; ++k) {
    double weight = any_event, multiple = 0;
    const double first = -std::log1p(-(static_cast<double>(k) + random()) /
                                     static_cast<double>(histories) * any_event);
    Vector position = entry, direction = view;
    Step step = fly(entry_height, ray.entry_mu, first);
    if (step.distance < 0) step.distance = ray.length;  // by rounding
    for (int event = 1;; ++event) {
      position += step.distance * direction;
      const Vector zenith = position.normalized();
      const double height = step.hits_ground ? 0 : position.norm() - bottom;
      const double mu_s = zenith.dot(sun), beam = to_sun(height, mu_s);
      const int layer = layer_of(height);
      double light;
      bool by_air = false;
      if (step.hits_ground) {
        weight *= ground_albedo_;
        light = weight / kPi * std::max(mu_s, 0.0) * beam;
      } else {
        weight *= scattering_[layer] / extinction_[layer];
        const double air_share = air_[layer] / scattering_[layer], nu = direction.dot(sun);
        light = weight * beam *
                (air_share * shared.rayleigh_phase(optics_.depolarisation, nu) +
                 (1 - air_share) * phase_value(optics_.phase, nu).v);
        by_air = random() < air_share;
      }
      (event == 1 ? single : multiple) += light;
      constexpr double kFaint = 0.02;  // below, every other history goes on with twice the weight
      if (weight <= 0) break;
      if (weight < kFaint) {
        if (random() < 0.5) break;
        weight *= 2;
      }
      if (step.hits_ground) {
        position = bottom * zenith;
        direction = turned(zenith, std::sqrt(random()), random);
      } else {
        direction = turned(
            direction, by_air ? sample_air(random) : sample_aerosol(optics_.phase, random), random);
      }
      const double mu =
          step.hits_ground ? std::max(direction.dot(zenith), 1e-6) : direction.dot(zenith);
      step = fly(height, mu, -std::log(random()));
      if (step.distance < 0) break;
    }
    sum += multiple;
    squares += multiple * multiple;
  }
  const auto n = static_cast<double>(histories);
  const double mean = sum / n;
  return {single / n, mean, std::sqrt(std::max(squares / n - mean * mean, 0.0) / n)};
}

}  // namespace skyfit::truth
