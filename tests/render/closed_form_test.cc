// SPDX-License-Identifier: Apache-2.0
// Frames by the closed forms, `nielsen`, `hoffman-preetham` and `preetham`: what the air before the
// ground lets through, and of the last what it scatters, is that of the formulas with the ground at
// its own height; observers that the models do not know are refused. Their sky is in
// sky_agreement_test.cc.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <numeric>
#include <string>

#include "data_refs/spectra.h"
#include "model/literature/evaluate.h"
#include "model/literature/nielsen.h"
#include "model/registry.h"
#include "model/shared/shared.h"
#include "model/sky_model.h"
#include "model/tables/table_lookup.h"
#include "render/render.h"
#include "tests/render/gl_fixture.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kBeta = 2e-5;  // 1/m

// Of grey aerosol alone, so that a colour's three numbers are one.
Preset grey_haze() {
  Preset preset = shipped("nielsen-2003");
  preset.atmosphere.at("rayleigh").amount = 0;
  Constituent<double>& mie = preset.atmosphere.at("mie");
  mie.amount = kBeta;
  mie.angstrom_exponent = 0;
  return preset;
}

AtmosphereTables tables_by(const std::string& model, const Preset& preset) {
  const SpectralData& spectra = refs::standard_spectral_data();
  return compute_tables_of(*make_sky_model(model, spectra, 2), preset.atmosphere,
                           color_rule(spectra), TableSizes{}, 2, {});
}

FrameOptions options_of(std::string_view view) {
  FrameOptions options;
  options.width = 64;
  options.height = 40;
  options.samples_per_side = 1;
  options.layers = true;
  options.camera = find_view(view).camera;
  options.sun_zenith = find_view(view).sun_zenith;
  return options;
}

// `depth`, in metres of density 1, of a path from one height to another over a length, all in m.
// Returns the range of the heights of the ground.
double expect_transmittance(
    Renderer& renderer, const std::string& model, const Preset& preset,
    const std::function<double(double from, double to, double length)>& depth) {
  renderer.set_atmosphere(preset, tables_by(model, preset));
  const FrameOptions options = options_of("10km");
  const Frame frame = renderer.draw(options);
  const double from = options.camera.altitude_m;
  double lowest = from, highest = 0;
  int pixels = 0;
  for (std::size_t i = 0; i < frame.depth_m.size(); ++i) {
    if (!std::isfinite(frame.depth_m[i])) continue;
    ++pixels;
    const double to = Shared<double>{}.height_after(preset.atmosphere.bottom_radius_m, from,
                                                    std::cos(frame.view_zenith_deg[i] * kDegree),
                                                    frame.depth_m[i]);
    lowest = std::min(lowest, to);
    highest = std::max(highest, to);
    const double expected = std::exp(-kBeta * depth(from, std::max(to, 0.0), frame.depth_m[i]));
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(frame.layers->transmittance[3 * i + c], expected, 1e-3)
          << model << ": pixel " << i << ", " << frame.depth_m[i] << " m to the height " << to;
  }
  EXPECT_GT(pixels, 500);
  return highest - lowest;
}

TEST(ClosedFormFrames, GroundIsSeenThroughTheAirAtItsOwnHeight) {
  const Preset preset = grey_haze();
  Renderer renderer;
  Shared<double> shared;
  const double scale_height = shared.nielsen_aerosol_scale_height();
  const double relief =
      expect_transmittance(renderer, "nielsen", preset, [&](double from, double to, double length) {
        return shared.nielsen_terrain_depth(from, to, length, scale_height);
      });
  EXPECT_GT(relief, 1000) << "m: the heights of the ground must differ for the test to see them";
  expect_transmittance(renderer, "nielsen:mean-height", preset,
                       [&](double from, double to, double length) {
                         return shared.nielsen_mean_height_depth(from, to, length, scale_height);
                       });
  expect_transmittance(renderer, "hoffman-preetham", preset,
                       [](double, double, double length) { return length; });
}

// Against sums of 400 steps by the densities themselves, along a path over which the height changes
// evenly.
TEST(ClosedFormFrames, PreethamsPathsGatherWhatTheirAirScatters) {
  const Preset preset = shipped("earth-hazy");
  const AtmosphereTables tables = tables_by("preetham", preset);
  Renderer renderer;
  renderer.set_atmosphere(preset, tables);
  const FrameOptions options = options_of("valley");
  const Frame frame = renderer.draw(options);
  const double mu_s = std::cos(options.sun_zenith), altitude = options.camera.altitude_m;
  const literature::AirAtNodes air =
      literature::air_at_nodes(preset.atmosphere, tables.color.nodes);
  const NodeValues sky = lookup_irradiance(tables, altitude, mu_s);
  Shared<double> shared;
  double worst = 0;
  int compared = 0;
  for (std::size_t i = 0; i < frame.depth_m.size(); i += 3) {
    if (!std::isfinite(frame.depth_m[i])) continue;
    const double zenith = frame.view_zenith_deg[i] * kDegree, length = frame.depth_m[i];
    const double to = std::max(Shared<double>{}.height_after(preset.atmosphere.bottom_radius_m,
                                                             altitude, std::cos(zenith), length),
                               0.0);
    const double nu = std::cos(zenith) * mu_s + std::sin(zenith) * std::sin(options.sun_zenith) *
                                                    std::cos(frame.view_azimuth_deg[i] * kDegree);
    double luminance = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double mass = shared.relative_air_mass(mu_s);
      const double beam = std::exp(-mass * (air.air[k] * air.air_scale_height_m +
                                            air.aerosol[k] * air.aerosol_scale_height_m));
      const double diffuse = sky[k] / (2 * std::numbers::pi);
      const double air_light =
          beam * shared.rayleigh_phase(tables.phases.depolarisation, nu) + diffuse;
      const double aerosol_light =
          beam * phase_value(phase_at(tables.phases.others[0], tables.color.nodes[k].wavelength_nm),
                             nu) +
          diffuse;
      double depth = 0, sum = 0;
      constexpr int kSteps = 400;
      for (int step = 0; step < kSteps; ++step) {
        const double h = altitude + (step + 0.5) / kSteps * (to - altitude);
        const double of_air = air.air[k] * std::exp(-h / air.air_scale_height_m),
                     of_aerosol = air.aerosol[k] * std::exp(-h / air.aerosol_scale_height_m);
        const double of_step = (of_air + of_aerosol) * length / kSteps;
        sum += (of_air * air_light + of_aerosol * aerosol_light) * length / kSteps *
               std::exp(-depth - 0.5 * of_step);
        depth += of_step;
      }
      luminance += tables.color.xyz_from_nodes[1][k] * sum;
    }
    const double drawn = 0.2126729 * frame.layers->in_scatter[3 * i] +
                         0.7151522 * frame.layers->in_scatter[3 * i + 1] +
                         0.0721750 * frame.layers->in_scatter[3 * i + 2];
    worst = std::max(worst, std::abs(drawn / luminance - 1));
    ++compared;
  }
  std::printf("[preetham] light of %d paths, worst error %.2g\n", compared, worst);
  EXPECT_GT(compared, 200);
  constexpr double kEightSteps = 5e-3;  // and floats of short paths
  EXPECT_LT(worst, kEightSteps);
}

// The direct light of dry ground is the beam's, Lambert's law; the rest of the reflected light is
// ambient.
TEST(ClosedFormFrames, DirectLightIsTheBeamsShareOfTheReflected) {
  Preset preset = grey_haze();
  preset.atmosphere.sea = false;
  Renderer renderer;
  renderer.set_atmosphere(preset, tables_by("nielsen", preset));
  FrameOptions options = options_of("valley");
  options.sun_zenith = 80 * kDegree;  // slopes face away from it
  const Frame frame = renderer.draw(options);
  const FrameLayers& layers = *frame.layers;
  const auto luminance = [](const std::vector<float>& rgb, std::size_t i) {
    return 0.2126 * rgb[3 * i] + 0.7152 * rgb[3 * i + 1] + 0.0722 * rgb[3 * i + 2];
  };
  int lit = 0, unlit = 0;
  double least = 1e9, most = 0;
  for (std::size_t i = 0; i < frame.depth_m.size(); ++i) {
    if (!std::isfinite(frame.depth_m[i])) continue;
    const double facing = layers.normal[3 * i] * std::sin(options.sun_zenith) +
                          layers.normal[3 * i + 2] * std::cos(options.sun_zenith);
    const double direct = luminance(layers.direct, i), reflected = luminance(layers.reflected, i);
    EXPECT_LE(direct, reflected * (1 + 1e-5)) << i;
    if (facing < -0.01) {
      EXPECT_EQ(direct, 0) << i;
      ++unlit;
    } else if (facing > 0.1) {
      const double beam = direct / (facing * luminance(layers.albedo, i) *
                                    luminance(layers.transmittance, i) / std::numbers::pi);
      least = std::min(least, beam);
      most = std::max(most, beam);
      ++lit;
    }
  }
  EXPECT_GT(lit, 300);
  EXPECT_GT(unlit, 10);
  // Colours are sums over wavelengths, of which the luminance of a product is not quite that.
  constexpr double kProducts = 0.02;
  const ColorRule color = color_rule(refs::standard_spectral_data());
  const double expected =
      Shared<double>{}.nielsen_sunlight(nielsen_aerosol(preset.atmosphere).mie_multiplier) *
      std::accumulate(color.xyz_from_nodes[1].begin(), color.xyz_from_nodes[1].end(), 0.0);
  EXPECT_NEAR(least / expected, 1, kProducts) << least << " lx";
  EXPECT_NEAR(most / expected, 1, kProducts) << most << " lx";
}

TEST(ClosedFormFrames, RefuseNightAndSpace) {
  const Preset preset = grey_haze();
  Renderer renderer;
  renderer.set_atmosphere(preset, tables_by("nielsen", preset));
  FrameOptions options = options_of("10km");
  options.sun_zenith = 90 * kDegree;
  EXPECT_THROW(renderer.draw(options), std::invalid_argument);
  options.sun_zenith = 60 * kDegree;
  options.second_sun = SecondSun{95 * kDegree, 1, 0.2};
  EXPECT_THROW(renderer.draw(options), std::invalid_argument);
  EXPECT_THROW(renderer.draw(options_of("orbit")), std::invalid_argument);
}

// Neither the sky nor the clouds, nor what the sun does not reach.
TEST(ClosedFormFrames, NoPixelIsBlack) {
  const Preset preset = shipped("nielsen-2003");
  Renderer renderer;
  renderer.set_atmosphere(preset, tables_by("nielsen", preset));
  FrameOptions options = options_of("valley");
  options.shadows = true;
  options.clouds = {CloudLayer{}};
  const Frame frame = renderer.draw(options);
  const auto [darkest, brightest] = std::ranges::minmax(frame.luminance);
  EXPECT_GT(darkest, 10) << "cd/m^2";
  EXPECT_LT(brightest, 1e5) << "cd/m^2";
}

// As with the other models: no turbidity, and the ground alone has light.
TEST(ClosedFormFrames, WithoutAirPreethamHasADarkSky) {
  Preset preset = shipped("earth-clear");
  preset.atmosphere.constituents.clear();
  Renderer renderer;
  renderer.set_atmosphere(preset, tables_by("preetham", preset));
  const Frame frame = renderer.draw(options_of("valley"));
  int skies = 0, lit = 0;
  for (std::size_t i = 0; i < frame.depth_m.size(); ++i) {
    const float luminance = frame.luminance[i];
    EXPECT_EQ(frame.layers->in_scatter[3 * i + 1], 0) << "pixel " << i;
    if (std::isfinite(frame.depth_m[i])) {
      EXPECT_TRUE(std::isfinite(luminance) && luminance >= 0) << luminance << " cd/m^2";
      lit += luminance > 0;
    } else {
      ++skies;
    }
  }
  EXPECT_GT(skies, 100);
  EXPECT_GT(lit, 100);
}

}  // namespace
}  // namespace skyfit
