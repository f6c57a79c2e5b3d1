// SPDX-License-Identifier: Apache-2.0
// What an engine draws with the files of `skyfit tables` is what `skyfit sky` says: the written
// tables are read from their files into textures, and the written GLSL, and the written HLSL by way
// of SPIR-V, look them up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <numbers>

#include "model/base/input_file.h"
#include "model/base/process.h"
#include "model/base/temporary_directory.h"
#include "model/base/whole_file.h"
#include "render/engine/table_errors.h"
#include "render/page/page_errors.h"
#include "tests/render/engine_table_files.h"
#include "tests/render/gl_fixture.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;
constexpr double kDegree = std::numbers::pi / 180;

TableSizes sizes_named(std::string_view name) {
  for (const TableSizesEntry& entry : table_sizes()) {
    if (entry.name == name) return entry.sizes;
  }
  throw std::logic_error("no such sizes");
}

const AtmosphereTables& medium_tables() {
  static const AtmosphereTables made = tables_of(shipped("earth-clear"), sizes_named("medium"));
  return made;
}

GLuint uploaded(const FileTexels& file) {
  GLuint id = 0;
  const bool flat = file.depth == 1;
  glCreateTextures(flat ? GL_TEXTURE_2D : GL_TEXTURE_3D, 1, &id);
  const GLenum format = file.half ? GL_RGBA16F : GL_RGBA32F,
               type = file.half ? GL_HALF_FLOAT : GL_FLOAT;
  const auto width = static_cast<GLsizei>(file.width), height = static_cast<GLsizei>(file.height),
             depth = static_cast<GLsizei>(file.depth);
  if (flat) {
    glTextureStorage2D(id, 1, format, width, height);
    glTextureSubImage2D(id, 0, 0, 0, width, height, GL_RGBA, type, file.texels.data());
  } else {
    glTextureStorage3D(id, 1, format, width, height, depth);
    glTextureSubImage3D(id, 0, 0, 0, 0, width, height, depth, GL_RGBA, type, file.texels.data());
  }
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTextureParameteri(id, wrap, GL_CLAMP_TO_EDGE);
  check_gl("a table from its file");
  return id;
}

class Drawn : public ::testing::Test {
 protected:
  // The tables of a folder as textures, at their units and by their names.
  std::vector<GlTexture> bind(const Written& written) {
    std::vector<GlTexture> textures;
    for (const EngineTable& table : written.engine.tables) {
      textures.emplace_back(uploaded(read_dds(written.text(std::string(table.name) + ".dds"))));
      glBindTextureUnit(static_cast<GLuint>(textures.size() - 1), textures.back().id());
    }
    return textures;
  }
  std::unique_ptr<GlContext> context_ = make_osmesa_context();
};

// x: cosines of the zenith angles of view and sun, azimuth between them, height of the eye in km.
const std::string kLuminance =
    "vec3 view = vec3(sqrt(1.0 - x.x * x.x), 0.0, x.x);\n"
    "float across = sqrt(1.0 - x.y * x.y);\n"
    "vec3 sun = vec3(across * cos(x.z), across * sin(x.z), x.y);\n"
    "y = vec4(skyfit_luminance(view, sun, x.w), 1.0);";

std::vector<float> inputs_of(std::span<const SkyPoint> points) {
  std::vector<float> inputs;
  for (const SkyPoint& p : points) {
    inputs.insert(
        inputs.end(),
        {static_cast<float>(std::cos(p.view_zenith)), static_cast<float>(std::cos(p.sun_zenith)),
         static_cast<float>(p.relative_azimuth), static_cast<float>(1e-3 * p.altitude_m)});
  }
  return inputs;
}

// Of linear Rec. 709.
std::vector<double> luminances_of(const std::vector<float>& rgb) {
  std::vector<double> luminances;
  for (std::size_t i = 0; i < rgb.size(); i += 4) {
    luminances.push_back(0.2126729 * rgb[i] + 0.7151522 * rgb[i + 1] + 0.0721750 * rgb[i + 2]);
  }
  return luminances;
}

struct Skies {
  const char* what;
  double altitude_m;
  std::vector<double> suns_deg, views_deg;
  double rms, worst;  // at most
};

std::vector<SkyPoint> points_of(const Skies& skies) {
  std::vector<SkyPoint> points;
  for (const double sun : skies.suns_deg) {
    for (const double view : skies.views_deg) {
      for (const double azimuth : {0.0, 20.0, 60.0, 120.0, 180.0})
        points.push_back({skies.altitude_m, sun * kDegree, view * kDegree, azimuth * kDegree});
    }
  }
  return points;
}

// What docs/tables.md states; of medium tables in half precision.
std::vector<Skies> measured_skies() {
  const std::vector<double> day = {0, 30, 60, 75, 84, 88}, dusk = {90, 92, 94, 96},
                            up = {3, 30, 55, 75, 85, 89}, down = {91.5, 95, 110, 140, 177};
  return {{"the sky from the ground, suns 0 to 88 deg", 0, day, up, 0.002, 0.006},
          {"the sky from the ground, suns 90 to 96 deg", 0, dusk, up, 0.004, 0.012},
          {"the sky from 10 km, suns 0 to 88 deg", 10e3, day, up, 0.004, 0.006},
          {"the ground from 1 km, suns 0 to 84 deg", 1e3, {0, 30, 60, 75, 84}, down, 0.005, 0.01},
          {"the ground from 10 km, suns 0 to 84 deg",
           10e3,
           {0, 30, 60, 75, 84},
           {95, 110, 140, 177},
           0.004,
           0.006},
          {"the planet from 400 km, suns 0 to 84 deg",
           400e3,
           {0, 30, 60, 75, 84},
           {115, 130, 150, 177},
           0.004,
           0.007},
          {"the limb from 400 km, suns 0 to 84 deg",
           400e3,
           {0, 30, 60, 75, 84},
           {108.5, 109, 109.5},
           0.008,
           0.03}};
}

TEST_F(Drawn, LuminanceIsThatOfTheModel) {
  const Written written(shipped("earth-clear"), medium_tables(), "dds", TablePrecision::kHalf);
  const auto textures = bind(written);
  const std::vector<Skies> all = measured_skies();
  std::vector<SkyPoint> points;  // of all: the model then solves its field once
  for (const Skies& skies : all) {
    const std::vector<SkyPoint> more = points_of(skies);
    points.insert(points.end(), more.begin(), more.end());
  }
  const std::vector<double> expected = reference_luminances(
      shipped("earth-clear").atmosphere, refs::standard_spectral_data(), points, 2);
  const std::vector<double> drawn =
      luminances_of(run_glsl(written.text("sky.glsl"), kLuminance, inputs_of(points)));
  std::size_t begin = 0;
  for (const Skies& skies : all) {
    const std::size_t count = points_of(skies).size();
    const LuminanceError error = luminance_error(std::span(drawn).subspan(begin, count),
                                                 std::span(expected).subspan(begin, count));
    begin += count;
    std::printf("[ measured ] %s: %.2f %% rms, %.2f %% at worst\n", skies.what, 100 * error.rms,
                100 * error.worst);
    EXPECT_LT(error.rms, skies.rms) << skies.what;
    EXPECT_LT(error.worst, skies.worst) << skies.what;
  }
}

// The ground as a thing behind the air is the ground of skyfit_luminance().
TEST_F(Drawn, AThingOnTheGroundIsSeenAsTheGround) {
  const Written written(shipped("earth-clear"), medium_tables(), "dds", TablePrecision::kHalf);
  const auto textures = bind(written);
  std::vector<float> inputs;
  for (const float mu_s : {1.0f, 0.5f, 0.1f}) {
    for (const float mu : {-0.9f, -0.4f, -0.15f}) inputs.insert(inputs.end(), {mu, mu_s, 1, 2});
  }
  // A thing of the ground's albedo at the ground's distance, in the light of sun and sky, is as
  // bright as skyfit_luminance() has the ground.
  const std::vector<float> shares =
      run_glsl(written.text("sky.glsl"),
               "vec3 view = vec3(sqrt(1.0 - x.x * x.x), 0.0, x.x);\n"
               "float across = sqrt(1.0 - x.y * x.y), r = bottom_km + x.w;\n"
               "vec3 sun = vec3(across * cos(x.z), across * sin(x.z), x.y);\n"
               "float d = distance_to_inner_sphere(bottom_km, x.w, x.x, 0.0);\n"
               "vec3 in_scatter, transmittance, near_light, near_through;\n"
               "skyfit_aerial_perspective(view, sun, x.w, d, in_scatter, transmittance);\n"
               "skyfit_aerial_perspective(view, sun, x.w, 0.0, near_light, near_through);\n"
               "vec3 up = normalize(vec3(0.0, 0.0, r) + d * view);\n"
               "float sun_z = dot(up, sun);\n"
               "vec3 lit = skyfit_sun_illuminance(sun_z, 0.0) * sun_z + "
               "skyfit_sky_illuminance(sun_z, 0.0);\n"
               "vec3 seen = in_scatter + transmittance * ground_albedo.rgb * lit * kInversePi;\n"
               "y = vec4(seen / skyfit_luminance(view, sun, x.w), length(near_light) + "
               "length(near_through - vec3(1.0)));",
               inputs);
  // Products by red, green and blue in the place of products by wavelength.
  constexpr double kThreeColours = 0.04;
  for (std::size_t i = 0; i < shares.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(shares[i + c], 1, kThreeColours)
          << "mu " << inputs[i] << ", mu_s " << inputs[i + 1] << ", channel " << c;
    EXPECT_EQ(shares[i + 3], 0) << "nothing lies before a thing at the eye";
  }
}

TEST_F(Drawn, TheSunsDiscIntegratesToItsIlluminance) {
  const Written written(shipped("earth-clear"), medium_tables(), "dds", TablePrecision::kHalf);
  const auto textures = bind(written);
  // Rings of equal width about a sun 40 degrees high, and one beside it.
  constexpr int kRings = 64;
  std::vector<float> inputs;
  for (int i = 0; i <= kRings; ++i)
    inputs.insert(inputs.end(), {(static_cast<float>(i) + 0.5f) / kRings, 0, 0, 0});
  const std::vector<float> light = run_glsl(
      written.text("sky.glsl"),
      "float high = radians(40.0), away = 0.00465479312 * x.x;\n"
      "vec3 sun = vec3(cos(high), 0.0, sin(high));\n"
      "vec3 view = vec3(sun.x * cos(away), sin(away), sun.z * cos(away));\n"
      "y = vec4(skyfit_sun_luminance(view, sun, 0.0), skyfit_sun_illuminance(sun.z, 0.0).g);",
      inputs);
  double sum = 0;
  const double radius = 0.00465479312, width = radius / kRings;
  for (std::size_t i = 0; i < kRings; ++i)
    sum += light[4 * i + 1] * 2 * std::numbers::pi *
           std::sin((static_cast<double>(i) + 0.5) * width) * width;
  EXPECT_NEAR(sum / light[3], 1, 2e-3);
  EXPECT_EQ(light[4 * kRings + 1], 0);
}

// Compiled from HLSL to SPIR-V by glslang and from there to GLSL by SPIRV-Cross.
std::string glsl_of(const std::string& hlsl, const fs::path& directory) {
  const fs::path source = directory / "test.hlsl", binary = directory / "test.spv",
                 result = directory / "test.comp";
  write_file(source, hlsl);
  const auto must = [](const char* program, const std::vector<std::string>& arguments) {
    const auto path = program_in_path(program);
    if (!path) throw std::runtime_error(std::string(program) + ": not installed, ./run packages");
    const Outcome outcome = run({*path, arguments, "", {}});
    if (!outcome.succeeded()) throw std::runtime_error(outcome.output);
  };
  must("glslangValidator", {"-D", "-V", "-S", "comp", "-e", "main", source, "-o", binary});
  must("spirv-cross", {"--version", "450", binary, "--output", result});
  return read_file(result, "GLSL", 1 << 24);
}

GlProgram linked(const std::string& program) {
  const GlShader shader(glCreateShader(GL_COMPUTE_SHADER));
  const char* text = program.c_str();
  glShaderSource(shader.id(), 1, &text, nullptr);
  glCompileShader(shader.id());
  GlProgram result(glCreateProgram());
  glAttachShader(result.id(), shader.id());
  glLinkProgram(result.id());
  GLint done = GL_FALSE;
  glGetProgramiv(result.id(), GL_LINK_STATUS, &done);
  if (done != GL_TRUE) throw std::runtime_error(program);
  return result;
}

const std::string kHlslMain =
    "StructuredBuffer<float4> inputs : register(t10);\n"
    "RWStructuredBuffer<float4> outputs : register(u11);\n"
    "[numthreads(1, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {\n"
    "  float4 x = inputs[id.x];\n"
    "  float3 view = float3(sqrt(1.0 - x.x * x.x), 0.0, x.x);\n"
    "  float across = sqrt(1.0 - x.y * x.y);\n"
    "  float3 sun = float3(across * cos(x.z), across * sin(x.z), x.y);\n"
    "  float3 in_scatter, transmittance;\n"
    "  skyfit_aerial_perspective(view, sun, x.w, 0.0, in_scatter, transmittance);\n"
    "  outputs[id.x] = float4(skyfit_luminance(view, sun, x.w) * transmittance,\n"
    "                         skyfit_sun_luminance(view, sun, x.w).x + in_scatter.x);\n"
    "}\n";

// The luminances of kLuminance by the written HLSL.
std::vector<float> run_hlsl(const Written& written, const std::vector<float>& inputs) {
  const GlProgram program =
      linked(glsl_of(written.text("sky.hlsl") + kHlslMain, written.directory.path()));
  glUseProgram(program.id());
  for (std::size_t unit = 0; unit < written.engine.tables.size(); ++unit) {
    // SPIRV-Cross joins the names of a texture and its sampler; a size is asked of another one.
    const std::string combined =
        "SPIRV_Cross_Combined" + std::string(written.engine.tables[unit].name) + "_table";
    const auto location_with = [&](const char* sampler) {
      return glGetUniformLocation(program.id(), (combined + sampler).c_str());
    };
    const GLint texels = location_with("skyfit_linear_clamp"),
                size = location_with("SPIRV_Cross_DummySampler");
    EXPECT_GE(texels, 0) << combined;
    glUniform1i(texels, static_cast<GLint>(unit));
    if (size >= 0) glUniform1i(size, static_cast<GLint>(unit));
  }
  return run_compute(program, inputs, {10, 11});
}

// With three phase functions that are tables.
TEST_F(Drawn, HlslGivesWhatGlslGivesAndBothWhatTheTablesHold) {
  const Preset preset = shipped("titan");
  const AtmosphereTables tables = tables_of(preset, sizes_named("tiny"));
  const Written written(preset, tables, "dds", TablePrecision::kHalf);
  const auto textures = bind(written);
  const std::vector<SkyPoint> points =
      points_of({"", 5e3, {10, 70, 88, 93}, {10, 70, 89, 93, 120, 170}, 0, 0});
  const std::vector<float> inputs = inputs_of(points);
  const std::vector<float> glsl = run_glsl(written.text("sky.glsl"), kLuminance, inputs),
                           hlsl = run_hlsl(written, inputs);
  const AtmosphereTables read = in_precision(tables, TablePrecision::kHalf);
  const std::vector<double> drawn = luminances_of(glsl),
                            held = table_luminances(read, {}, read.phases, points);
  constexpr double kOrderOfSums = 1e-4;  // compilers may reorder them; logarithms of -20
  constexpr double kFilter = 3e-3;       // float coordinates times steps between texels
  for (std::size_t p = 0; p < points.size(); ++p) {
    // A channel near 0 is a difference of others.
    const float most = *std::max_element(&glsl[4 * p], &glsl[4 * p] + 3);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(hlsl[4 * p + c], glsl[4 * p + c], kOrderOfSums * most + 1e-6) << "point " << p;
    // Below the horizon the ground is seen as well.
    if (points[p].view_zenith < 89.5 * kDegree) {
      EXPECT_NEAR(drawn[p] / held[p], 1, kFilter) << "point " << p;
    }
  }
}

}  // namespace
}  // namespace skyfit
