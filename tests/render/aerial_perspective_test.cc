// SPDX-License-Identifier: Apache-2.0
// The light that the air scatters into the paths to the ground, looked up for each pixel and from
// the volume, is that of the reference; by `hillaire` and `bodare` what these models
// gather.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "data_refs/spectra.h"
#include "model/atmosphere/phase_moments.h"
#include "model/literature/bodare.h"
#include "model/literature/hillaire.h"
#include "model/registry.h"
#include "model/shared/shared.h"
#include "model/sky_model.h"
#include "model/tables/table_lookup.h"
#include "tests/render/frame_fixture.h"
#include "tests/render/gl_fixture.h"

namespace skyfit {
namespace {

constexpr double kAgreement = 0.03;
// Of a forward lobe narrower than the moments of the tables hold, as that of Martian dust; the
// reference takes twice as many (model/tables/diffuse_source.h).
constexpr double kAgreementOfNarrowLobes = 0.05;
constexpr double kNearest = 3e3;  // m: nearer paths are the small difference of two whole rays

// A planet under a preset, with tables of full size.
struct Planet {
  Planet(const std::string& name, double aerosol_per_m)
      : preset(with_aerosol(shipped(name), aerosol_per_m)),
        tables(tables_of(preset, TableSizes{})) {
    renderer.set_atmosphere(preset, tables);
  }
  static Preset with_aerosol(Preset preset, double per_m) {
    if (per_m > 0) preset.atmosphere.at("mie").amount = per_m;
    return preset;
  }
  Preset preset;
  AtmosphereTables tables;
  Renderer renderer;
};

// The last one that was asked for.
Planet& planet_of(const std::string& name, double aerosol_per_m) {
  static std::pair<std::string, double> made;
  static std::optional<Planet> planet;
  const std::pair asked(name, aerosol_per_m);
  if (made != asked) planet.emplace(name, aerosol_per_m);
  made = asked;
  return *planet;
}

double luminance(const ColorRule& color, const NodeValues& nodes) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += color.xyz_from_nodes[1][k] * nodes[k];
  return sum;
}

struct Seen {
  const char* preset;
  const char* view;
  double sun_deg, altitude_m, aerosol_per_m;  // 0: the view's and the preset's own
  bool narrow_lobe = false;
};
class AerialPerspectiveOf : public ::testing::TestWithParam<Seen> {};

TEST_P(AerialPerspectiveOf, PixelsAndOfTheVolumeIsTheReferences) {
  const auto& [preset, view, sun_deg, altitude_m, aerosol_per_m, narrow_lobe] = GetParam();
  Planet& planet = planet_of(preset, aerosol_per_m);
  const AtmosphereTables& tables = planet.tables;
  FrameOptions options = options_of(view, 96, 54);
  if (options.site)
    options.camera.altitude_m =
        find_view(view).camera.altitude_m + planet.renderer.ground_height_m(options.site);
  if (sun_deg > 0) options.sun_zenith = sun_deg * kDegree;
  if (altitude_m > 0) options.camera.altitude_m = altitude_m;
  options.layers = true;
  options.aerial = AerialPerspective::kPerPixel;
  const Frame by_pixel = planet.renderer.draw(options);
  options.aerial = AerialPerspective::kVolume;
  const Frame by_volume = planet.renderer.draw(options);

  const double bottom = tables.atmosphere.bottom_radius_m;
  const glm::dvec3 eye(0, 0, bottom + options.camera.altitude_m);
  const glm::dvec3 sun(std::sin(options.sun_zenith), 0, std::cos(options.sun_zenith));
  const auto point_at = [&](const glm::dvec3& p, const glm::dvec3& ray) {
    const glm::dvec3 up = glm::normalize(p);
    const double mu = glm::dot(ray, up), mu_s = glm::dot(sun, up);
    const double cosine =
        (glm::dot(ray, sun) - mu * mu_s) / std::sqrt((1 - mu * mu) * (1 - mu_s * mu_s));
    return SkyPoint{std::max(glm::length(p) - bottom, 0.0), std::acos(mu_s), std::acos(mu),
                    std::acos(std::clamp(cosine, -1.0, 1.0))};
  };
  std::vector<std::size_t> pixels;
  std::vector<SkyPoint> points;
  for (std::size_t i = 0; i < by_pixel.depth_m.size(); i += 4) {
    if (is_sky(by_pixel, i) || by_pixel.depth_m[i] < kNearest) continue;
    const glm::dvec3 ray = ray_of(by_pixel, i);
    pixels.push_back(i);
    points.push_back(point_at(eye, ray));
    points.push_back(point_at(eye + double{by_pixel.depth_m[i]} * ray, ray));
  }
  ASSERT_GT(pixels.size(), 80u);
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  // Light straight from the ground is in both ends' rays and falls out of the difference.
  const SkyValues light = model->radiance(tables.atmosphere, tables.color.nodes, points, {});
  double worst_pixel = 0, worst_volume = 0, squares = 0;
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    const SkyPoint &start = points[2 * n], &end = points[2 * n + 1];
    const double mu = std::cos(start.view_zenith);
    const NodeValues t =
        lookup_transmittance(tables, {start.altitude_m, mu, std::cos(start.sun_zenith)},
                             {end.altitude_m, std::cos(end.view_zenith), std::cos(end.sun_zenith)},
                             mu < horizon_cosine(bottom, start.altitude_m));
    NodeValues finite;
    const int ray = static_cast<int>(2 * n);
    for (std::size_t k = 0; k < 4; ++k) {
      const int node = static_cast<int>(k);
      finite[k] = light.at(ray, node) - t[k] * light.at(ray + 1, node);
    }
    const double truth = luminance(tables.color, finite);
    const double pixel = luminance_of(by_pixel.layers->in_scatter, pixels[n]) / truth - 1,
                 volume = luminance_of(by_volume.layers->in_scatter, pixels[n]) / truth - 1;
    worst_pixel = std::max(worst_pixel, std::abs(pixel));
    worst_volume = std::max(worst_volume, std::abs(volume));
    squares += volume * volume;
  }
  std::printf(
      "[ aerial ] %zu paths: worst %.2f %% by pixel; %.2f %%, rms %.2f %% from the volume\n",
      pixels.size(), 100 * worst_pixel, 100 * worst_volume,
      100 * std::sqrt(squares / static_cast<double>(pixels.size())));
  const double agreement = narrow_lobe ? kAgreementOfNarrowLobes : kAgreement;
  EXPECT_LT(worst_pixel, agreement);
  EXPECT_LT(worst_volume, agreement);
}

// A frame of both kinds of a preset with its tables.
struct FromTenKilometres {
  FromTenKilometres(const Preset& preset, const AtmosphereTables& tables) {
    Renderer renderer;
    renderer.set_atmosphere(preset, tables);
    options.layers = true;
    options.aerial = AerialPerspective::kPerPixel;
    by_pixel = renderer.draw(options);
    options.aerial = AerialPerspective::kVolume;
    by_volume = renderer.draw(options);
  }
  FrameOptions options = options_of("10km", 96, 54);
  Frame by_pixel, by_volume;
};

struct RelativeErrors {
  double by_pixel, by_volume;
};

// Of every `step`th pixel of ground whose ray falls at least as much the light that the air adds
// before it, against that of `path_light(wavelength, ray, length)`.
void expect_light_of_paths(
    const FromTenKilometres& seen, const ColorRule& color, std::size_t step, double least_fall,
    const RelativeErrors& most,
    const std::function<double(std::size_t, const glm::dvec3&, double)>& path_light) {
  int pixels = 0;
  RelativeErrors worst{0, 0};
  for (std::size_t i = 0; i < seen.by_pixel.depth_m.size(); i += step) {
    const glm::dvec3 ray = ray_of(seen.by_pixel, i);
    if (is_sky(seen.by_pixel, i) || ray.z > -least_fall) continue;
    NodeValues light;
    for (std::size_t k = 0; k < 4; ++k)
      light[k] = path_light(k, ray, double{seen.by_pixel.depth_m[i]});
    const double truth = luminance(color, light);
    const auto error = [&](const Frame& frame) {
      return std::abs(luminance_of(frame.layers->in_scatter, i) / truth - 1);
    };
    worst.by_pixel = std::max(worst.by_pixel, error(seen.by_pixel));
    worst.by_volume = std::max(worst.by_volume, error(seen.by_volume));
    ++pixels;
  }
  std::printf("[ aerial ] %d paths: worst %.2f %% by pixel, %.2f %% from the volume\n", pixels,
              100 * worst.by_pixel, 100 * worst.by_volume);
  ASSERT_GT(pixels, 80);
  EXPECT_LT(worst.by_pixel, most.by_pixel);
  EXPECT_LT(worst.by_volume, most.by_volume);
}

// What a model of the literature has in C++, for each of the four wavelengths.
template <class Tables>
struct TablesOfNodes {
  TablesOfNodes(const auto& geometry, const Preset& preset, const ColorRule& color) {
    for (const WavelengthNode& node : color.nodes) {
      airs.push_back(
          literature::clear_air(geometry.shells(), seeded<0>(preset.atmosphere, {}), node));
      tables.push_back(std::make_unique<Tables>(geometry, airs.back(), std::span<const View>{}));
    }
  }
  std::vector<literature::ClearAir<0>> airs;
  std::vector<std::unique_ptr<Tables>> tables;
};

// By `hillaire` it is what its steps gather along the path, for each pixel the same steps as in
// C++, in the volume others.
TEST(AerialPerspective, OfHillaireIsMarched) {
  const Preset preset = shipped("earth-clear");
  const SpectralData& spectra = refs::standard_spectral_data();
  const AtmosphereTables tables = compute_tables_of(HillaireModel(2), preset.atmosphere,
                                                    color_rule(spectra), kSmallTables, 2, {});
  const literature::HillaireGeometry geometry(preset.atmosphere);
  const FromTenKilometres seen(preset, tables);
  const TablesOfNodes<literature::HillaireTables<0>> model(geometry, preset, tables.color);
  const glm::dvec3 sun(std::sin(seen.options.sun_zenith), 0, std::cos(seen.options.sun_zenith));
  expect_light_of_paths(
      seen, tables.color, 4, 0, {.by_pixel = 0.01, .by_volume = 0.03},
      [&](std::size_t k, const glm::dvec3& ray, double length) {
        const double nu = glm::dot(ray, sun);
        const auto marched =
            model.tables[k]->march(seen.options.camera.altitude_m, ray.z, sun.z, nu, length);
        return Shared<double>{}.rayleigh_phase(model.airs[k].depolarisation, nu) * marched.air.v +
               phase_value(model.airs[k].phase, nu).v * marched.aerosol.v + marched.multiple.v;
      });
}

// By `bodare` it is the integral over the path of sunlight and of what the table of gathered light
// holds, here by Simpson's rule with 2 x 200 steps.
class AerialPerspectiveOfBodare : public ::testing::TestWithParam<double> {};

TEST_P(AerialPerspectiveOfBodare, IsTheIntegralOfSunAndGatheredLight) {
  const Preset preset = Planet::with_aerosol(shipped("bodare-2014"), GetParam());
  const AtmosphereTables tables =
      compute_tables_of(BodareModel(2), preset.atmosphere,
                        color_rule(refs::standard_spectral_data()), kSmallTables, 2, {});
  const literature::BodareGeometry geometry(preset.atmosphere);
  const FromTenKilometres seen(preset, tables);
  const TablesOfNodes<literature::BodareTables<0>> model(geometry, preset, tables.color);
  const glm::dvec3 sun(std::sin(seen.options.sun_zenith), 0, std::cos(seen.options.sun_zenith));
  const double r0 = geometry.shells().bottom_radius + seen.options.camera.altitude_m;
  const auto path_light = [&](std::size_t k, const glm::dvec3& ray, double length) {
    const double nu = glm::dot(ray, sun);
    const auto& air = model.airs[k];
    const PathColumns beyond =
        geometry.shells().columns_to_top(seen.options.camera.altitude_m, -ray.z);
    const auto source = [&](double s) {
      const double r = std::sqrt(r0 * r0 + s * s + 2 * r0 * s * ray.z),
                   h = std::max(r - geometry.shells().bottom_radius, 0.0),
                   mu = (r0 * ray.z + s) / r, mu_s = (r0 * sun.z + s * nu) / r;
      const auto density = air.densities(h);
      PathColumns path = geometry.shells().columns_to_top(h, std::max(-mu, 0.0));
      path += -beyond;
      const double through = std::exp(-air.optical_depth(path).v),
                   light =
                       std::exp(-air.optical_depth(geometry.shells().columns_to_top(h, mu_s)).v) +
                       model.tables[k]->gathered(h, mu_s).v;
      return through * light *
             (air.air.v * density.air.v * Shared<double>{}.elek_rayleigh_phase(nu) +
              air.aerosol_scattering.v * density.aerosol.v * phase_value(air.phase, nu).v);
    };
    constexpr int kSteps = 200;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double a = length * i / kSteps, b = length * (i + 1) / kSteps;
      sum += (b - a) / 6 * (source(a) + 4 * source(0.5 * (a + b)) + source(b));
    }
    return sum;
  };
  constexpr double kGround = 0.06;  // such rays meet the ground for certain
  expect_light_of_paths(seen, tables.color, 12, kGround, {.by_pixel = 0.02, .by_volume = 0.03},
                        path_light);
}

// Scattering by aerosol, 1/m; 0: the preset's own.
INSTANTIATE_TEST_SUITE_P(Air, AerialPerspectiveOfBodare, ::testing::Values(0.0));
INSTANTIATE_TEST_SUITE_P(SlowFog, AerialPerspectiveOfBodare, ::testing::Values(3e-4));

INSTANTIATE_TEST_SUITE_P(Views, AerialPerspectiveOf,
                         ::testing::Values(Seen{"earth-clear", "valley", 0, 0, 0},
                                           Seen{"earth-clear", "10km", 0, 0, 0},
                                           Seen{"earth-clear", "valley", 84, 0, 0},
                                           Seen{"earth-clear", "10km", 84, 0, 0},
                                           Seen{"earth-clear", "10km", 0, 12e3, 0},
                                           Seen{"earth-clear", "10km", 84, 12e3, 0},
                                           Seen{"earth-clear", "valley", 0, 0, 6e-4},
                                           Seen{"mars", "10km", 84, 0, 0, true}));

INSTANTIATE_TEST_SUITE_P(SlowViews, AerialPerspectiveOf,
                         ::testing::Values(Seen{"earth-clear", "valley", 0, 0, 2e-3},
                                           Seen{"bodare-2014", "valley", 0, 0, 0}));

}  // namespace
}  // namespace skyfit
