// SPDX-License-Identifier: Apache-2.0
// The formulas of model/shared/ give in GLSL what they give in C++: phase functions, geometry,
// mappings, table look-ups.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "model/shared/shared.h"
#include "model/tables/table_lookup.h"
#include "render/gl/atmosphere/atmosphere_pass.h"
#include "tests/atmospheres.h"
#include "tests/render/gl_fixture.h"

namespace skyfit {
namespace {

constexpr double kFloat = 4e-6;       // a dozen roundings of 6e-8
constexpr double kCoordinate = 2e-6;  // of 0..1: well below a hundredth of a texel of 256
constexpr double kRoot =
    8e-5;  // a hundredth of a texel of 128: near the zenith, the root of a distance's rounding
constexpr double kBottom = 6360, kThickness = 100;

class SharedFormulas : public ::testing::Test {
 protected:
  std::unique_ptr<GlContext> context_ = make_osmesa_context();
  Shared<double> shared_;
};

TEST_F(SharedFormulas, PhaseFunctions) {
  std::vector<float> inputs;
  for (const float g : {-0.6f, 0.0f, 0.3f, 0.76f, 0.95f}) {
    for (float nu = -1; nu <= 1; nu += 0.125f) inputs.insert(inputs.end(), {g, nu, 0.3f, 0.25f});
  }
  const auto outputs =
      run_glsl("#include \"model/shared/phase.glsl\"\n",
               "y = vec4(rayleigh_phase(x.w, x.y), cornette_shanks_phase(x.x, x.y), "
               "henyey_greenstein_phase(x.x, x.y), two_lobe_phase(1, x.x, x.z, x.w, x.y));",
               inputs);
  for (std::size_t i = 0; i < inputs.size(); i += 4) {
    const double g = inputs[i], nu = inputs[i + 1], g2 = inputs[i + 2], weight = inputs[i + 3];
    const double expected[4] = {
        shared_.rayleigh_phase(weight, nu), shared_.cornette_shanks_phase(g, nu),
        shared_.henyey_greenstein_phase(g, nu), shared_.two_lobe_phase(1, g, g2, weight, nu)};
    // Near nu = 1 the phase functions amplify the rounding of 1 + g^2 - 2 g nu.
    const double tolerance = kFloat * 4 / std::pow(1 - std::abs(g), 2);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(outputs[i + k] / expected[k], 1, tolerance) << "g = " << g << ", nu = " << nu;
    }
  }
}

TEST_F(SharedFormulas, PolarisingPhaseFunction) {
  std::vector<float> inputs;
  for (float nu = -1; nu <= 1; nu += 0.125f) inputs.insert(inputs.end(), {0, nu, 0, 0.25f});
  const auto outputs = run_glsl("#include \"model/shared/phase.glsl\"\n",
                                "y = vec4(rayleigh_polarising_phase(x.w, x.y));", inputs);
  for (std::size_t i = 0; i < inputs.size(); i += 4)
    EXPECT_NEAR(outputs[i], shared_.rayleigh_polarising_phase(0.25, inputs[i + 1]), kFloat);
}

std::vector<float> rays() {
  std::vector<float> inputs;
  for (const float h : {0.0f, 0.002f, 0.1f, 1.2f, 8.0f, 40.0f, 99.0f}) {
    for (const float mu : {-1.0f, -0.5f, -0.2f, -0.05f, 0.0f, 0.003f, 0.1f, 0.6f, 1.0f}) {
      for (const float mu_s : {-0.2f, -0.05f, 0.0f, 0.2f, 1.0f})
        inputs.insert(inputs.end(), {h, mu, mu_s, 0});
    }
  }
  return inputs;
}

TEST_F(SharedFormulas, Mappings) {
  const auto inputs = rays();
  constexpr double kDeck = 2;
  const auto outputs =
      run_glsl("#include \"model/shared/geometry.glsl\"\n#include \"model/shared/mapping.glsl\"\n",
               "bool hit = ray_hits_ground(x.x, x.y, 6360.0);\n"
               "float deck = x.z < 0.0 ? -1.0 : 2.0;\n"
               "y = vec4(texture_from_view(x.x, x.y, hit, 32.0, 64.0, 6360.0, 100.0, deck), "
               "unit_from_height(x.x, 100.0), "
               "unit_from_sun(sun_height(x.x, x.z, 6360.0), -0.2079), hit ? 1.0 : 0.0);",
               inputs);
  for (std::size_t i = 0; i < inputs.size(); i += 4) {
    const double h = inputs[i], mu = inputs[i + 1], mu_s = inputs[i + 2];
    const bool hit = shared_.ray_hits_ground(h, mu, kBottom);
    EXPECT_EQ(outputs[i + 3] > 0.5f, hit) << "h = " << h << ", mu = " << mu;
    EXPECT_NEAR(
        outputs[i],
        shared_.texture_from_view(h, mu, hit, 32, 64, kBottom, kThickness, mu_s < 0 ? -1 : kDeck),
        kRoot)
        << "h = " << h << ", mu = " << mu;
    EXPECT_NEAR(outputs[i + 1], shared_.unit_from_height(h, kThickness), kCoordinate);
    EXPECT_NEAR(outputs[i + 2],
                shared_.unit_from_sun(shared_.sun_height(h, mu_s, kBottom), -0.2079), kCoordinate);
  }
}

TEST_F(SharedFormulas, MappingsOfTheLiterature) {
  const auto inputs = rays();
  const auto outputs = run_glsl(
      "#include \"model/shared/geometry.glsl\"\n#include \"model/shared/mapping.glsl\"\n"
      "#include \"model/shared/bruneton_mapping.glsl\"\n"
      "#include \"model/shared/bodare_mapping.glsl\"\n",
      "float horizon = bodare_horizon(x.x, 6360.0);\n"
      "y = vec4(bruneton_unit_from_height(x.x, 6360.0, 100.0), "
      "bruneton_unit_from_sun(x.z, -0.2, 6360.0, 100.0), bodare_unit_from_sun(x.z), "
      "x.y > horizon ? bodare_unit_from_sky_view(x.y, horizon) "
      ": bodare_unit_from_ground_view(x.y, horizon));",
      inputs);
  constexpr double kFifthRoot = 0.02;  // of a cosine's rounding at the horizon: (1e-7)^0.2 / 2
  for (std::size_t i = 0; i < inputs.size(); i += 4) {
    const double h = inputs[i], mu = inputs[i + 1], mu_s = inputs[i + 2];
    const double horizon = shared_.bodare_horizon(h, kBottom);
    EXPECT_NEAR(outputs[i], shared_.bruneton_unit_from_height(h, kBottom, kThickness), kCoordinate);
    EXPECT_NEAR(outputs[i + 1], shared_.bruneton_unit_from_sun(mu_s, -0.2, kBottom, kThickness),
                4 * kCoordinate);
    EXPECT_NEAR(outputs[i + 2], shared_.bodare_unit_from_sun(mu_s), kCoordinate);
    EXPECT_NEAR(outputs[i + 3],
                mu > horizon ? shared_.bodare_unit_from_sky_view(mu, horizon)
                             : shared_.bodare_unit_from_ground_view(mu, horizon),
                std::abs(mu - horizon) < 1e-4 ? kFifthRoot : 1e-4)
        << "h = " << h << ", mu = " << mu;
  }
}

TEST_F(SharedFormulas, MappingsOfHillaire) {
  const auto inputs = rays();
  const auto outputs = run_glsl(
      "#include \"model/shared/geometry.glsl\"\n#include \"model/shared/mapping.glsl\"\n"
      "#include \"model/shared/hillaire_mapping.glsl\"\n",
      "float unit = hillaire_unit_from_view(x.y, x.x, 6360.0);\n"
      "y = vec4(hillaire_row_from_unit(unit, 108.0), "
      "hillaire_view_from_unit(hillaire_unit_from_row(20.0, 108.0), x.x, 6360.0), "
      "hillaire_unit_from_azimuth(x.z), "
      "hillaire_sample(hillaire_step_begin(7.0, 30.0), hillaire_step_begin(8.0, 30.0)));",
      inputs);
  // Of a row: the square root of a rounded angle at the horizon, of a rounded cosine at the zenith.
  constexpr double kSquareRoot = 0.05, kArcCosine = 1e-4;  // Mesa's is a polynomial
  for (std::size_t i = 0; i < inputs.size(); i += 4) {
    const double h = inputs[i], mu = inputs[i + 1], mu_s = inputs[i + 2];
    EXPECT_NEAR(
        outputs[i],
        shared_.hillaire_row_from_unit(shared_.hillaire_unit_from_view(mu, h, kBottom), 108),
        kSquareRoot)
        << "h = " << h << ", mu = " << mu;
    EXPECT_NEAR(
        outputs[i + 1],
        shared_.hillaire_view_from_unit(shared_.hillaire_unit_from_row(20, 108), h, kBottom),
        kArcCosine);
    EXPECT_NEAR(outputs[i + 2], shared_.hillaire_unit_from_azimuth(mu_s), 4e-4);
    EXPECT_NEAR(outputs[i + 3],
                shared_.hillaire_sample(shared_.hillaire_step_begin(7, 30),
                                        shared_.hillaire_step_begin(8, 30)),
                kCoordinate);
  }
}

TEST_F(SharedFormulas, ClosedFormsOfTheLiterature) {
  std::vector<float> inputs;
  for (const float height_m : {0.0f, 800.0f, 12000.0f}) {
    for (float mu = 0; mu <= 1; mu += 0.125f)
      inputs.insert(inputs.end(), {height_m, mu, 0.4f, 0.003f});
  }
  const auto outputs = run_glsl(
      "#include \"model/shared/closed_forms.glsl\"\n",
      "y = vec4(relative_air_mass(x.y), nielsen_sky_depth(x.y, nielsen_air_zenith_depth(x.x)), "
      "nielsen_asymmetry(x.x, x.y, x.w, 0.8), oneil_slant(x.y) + "
      "mixed_path_inscatter(1e-5, 0.1, 2e-5, 0.3, x.z));",
      inputs);
  for (std::size_t i = 0; i < inputs.size(); i += 4) {
    const double h = inputs[i], mu = inputs[i + 1];
    const double depth = shared_.nielsen_sky_depth(mu, shared_.nielsen_air_zenith_depth(h));
    EXPECT_NEAR(outputs[i] / shared_.relative_air_mass(mu), 1, 20 * kFloat) << "mu = " << mu;
    EXPECT_NEAR(outputs[i + 1] / depth, 1, 20 * kFloat) << "mu = " << mu;
    EXPECT_NEAR(outputs[i + 2], shared_.nielsen_asymmetry(h, mu, inputs[i + 3], 0.8), 10 * kFloat);
    const double sum =
        shared_.oneil_slant(mu) + shared_.mixed_path_inscatter(1e-5, 0.1, 2e-5, 0.3, inputs[i + 2]);
    EXPECT_NEAR(outputs[i + 3] / sum, 1, 20 * kFloat) << "mu = " << mu;
  }
}

TEST_F(SharedFormulas, GeometryKeepsItsDigitsNearTheGround) {
  const auto inputs = rays();
  const auto outputs =
      run_glsl("#include \"model/shared/geometry.glsl\"\n",
               "y = vec4(distance_to_outer_sphere(6360.0, x.x, x.y, 100.0), "
               "height_after(6360.0, x.x, x.y, 0.01), height_after(6360.0, x.x, x.y, 5.0), 0.0);",
               inputs);
  constexpr double kTenth = 1e-4;  // km
  for (std::size_t i = 0; i < inputs.size(); i += 4) {
    const double h = inputs[i], mu = inputs[i + 1];
    const double far = shared_.distance_to_outer_sphere(kBottom, h, mu, kThickness);
    EXPECT_NEAR(outputs[i], far, std::max(2 * kFloat * far, 1e-6))
        << "h = " << h << ", mu = " << mu;
    EXPECT_NEAR(outputs[i + 1], shared_.height_after(kBottom, h, mu, 0.01),
                1e-2 * kTenth + 1e-6 * h);
    EXPECT_NEAR(outputs[i + 2], shared_.height_after(kBottom, h, mu, 5), kTenth);
  }
}

void expect_equal_lookups(const AtmosphereTables& made,
                          TablePrecision precision = TablePrecision::kFloat) {
  Shared<double> shared;
  FrameGraph graph;
  const TableCodes codes = add_tables(made, graph, precision);
  const AtmosphereTables tables = in_precision(made, precision);
  const auto inputs = rays();
  const std::map<GLuint, const char*> names = {
      {0, "optical_depth"}, {1, "irradiance"},  {2, "rayleigh_like"},  {3, "single"},
      {4, "phase"},         {5, "sky_ray_air"}, {6, "sky_ray_aerosol"}};
  // One shader, so that the compiler drops no uniform; x.w says which function is asked for.
  const auto look_up = [&](float which) {
    std::vector<float> asked = inputs;
    for (std::size_t i = 3; i < asked.size(); i += 4) asked[i] = which;
    UniformBuffers blocks;
    std::vector<std::string> defined = atmosphere_defines(tables, codes);
    defined.emplace_back("SKY_RAYS 0");
    return run_glsl("#include \"render/shaders/sky_rays.glsl\"\n",
                    "bool hit = ray_hits_ground(x.x, x.y, bottom_km);\n"
                    "float nu = x.y * x.z + 0.3 * sqrt((1.0 - x.y * x.y) * (1.0 - x.z * x.z));\n"
                    "if (x.w == 0.0) y = radiance(scattering(Place(x.x, x.y, x.z), nu, hit), nu);\n"
                    "if (x.w == 1.0) y = sky_irradiance(x.x, x.z);\n"
                    "if (x.w == 2.0) y = sun_transmittance(x.x, x.z);\n"
                    "if (x.w == 3.0)\n"
                    "  y = radiance(sky_ray_scattering(Place(thickness_km, x.y, x.z), nu), nu);\n",
                    asked, defined, [&](GLuint program) {
                      bind_atmosphere(tables, program, blocks, codes);
                      for (const auto& [unit, name] : names) graph.bind(name, unit);
                    });
  };
  const auto radiances = look_up(0), irradiances = look_up(1), suns = look_up(2),
             outside = look_up(3);
  constexpr double kFilter = 2e-3;  // float coordinates times steps between texels, eight of them
  for (std::size_t i = 0; i < inputs.size(); i += 4) {
    const double h = 1e3 * inputs[i], mu = inputs[i + 1], mu_s = inputs[i + 2];
    const bool hit = shared.ray_hits_ground(h, mu, 1e3 * kBottom);
    const double nu = mu * mu_s + 0.3 * std::sqrt((1 - mu * mu) * (1 - mu_s * mu_s));
    const NodeValues radiance = lookup_radiance(tables, h, mu, mu_s, nu, hit);
    const NodeValues entering = lookup_radiance_from_outside(tables, mu, mu_s, nu);
    const NodeValues irradiance = lookup_irradiance(tables, h, mu_s);
    const NodeValues sun = lookup_sun_transmittance(tables, h, mu_s);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(radiances[i + k], radiance[k], kFilter * radiance[k] + 1e-7)
          << h << ' ' << mu << ' ' << mu_s;
      EXPECT_NEAR(outside[i + k], entering[k], kFilter * entering[k] + 1e-7) << mu << ' ' << mu_s;
      EXPECT_NEAR(irradiances[i + k], irradiance[k], kFilter * irradiance[k] + 1e-7)
          << h << ' ' << mu_s;
      EXPECT_NEAR(suns[i + k], sun[k], kFilter * sun[k] + 1e-5) << h << ' ' << mu_s;
    }
  }
}

TEST_F(SharedFormulas, TableLookups) {
  const AtmosphereTables tables = tables_of(shipped("earth-clear"), kSmallTables);
  for (const TablePrecisionEntry& entry : table_precisions()) {
    SCOPED_TRACE(entry.name);
    expect_equal_lookups(tables, entry.precision);
  }
}

TEST_F(SharedFormulas, TableLookupsOfTwoHenyeyGreensteinLobes) {
  Preset preset = shipped("earth-clear");
  preset.atmosphere.at("mie").phase.lobe = PhaseType::kHenyeyGreenstein;
  preset.atmosphere.at("rayleigh").phase.depolarisation = 0.03;
  expect_equal_lookups(tables_of(preset, kSmallTables));
}

TEST_F(SharedFormulas, TableLookupsOfTabulatedPhaseAndProfile) {
  Preset preset = shipped("earth-clear");
  PhaseFunction<double>& phase = preset.atmosphere.at("mie").phase;
  phase.type = PhaseType::kTabulated;
  phase.table = std::make_shared<const TabulatedPhase>(TwoColumns{
      {0, 5, 20, 60, 120, 150, 180}, {7.6, 2.28, 0.319, 0.0683, 0.0106, 0.00759, 0.0228}});
  preset.atmosphere.at("mie").profile = tabulated_profile(std::make_shared<const LinearProfile>(
      TwoColumns{{0, 1e3, 2e3, 3e3, 5e3}, {1, 0.8, 0, 0.3, 0}}));
  expect_equal_lookups(tables_of(preset, kSmallTables));
}

}  // namespace
}  // namespace skyfit
