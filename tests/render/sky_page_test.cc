// SPDX-License-Identifier: Apache-2.0
// The page of a sky: one file that asks nothing of a network, whose tables say what the reference
// says, whose shaders are GLSL ES 3.00 as are all shared formulas. What a browser makes of it:
// tests/cli/view_in_browser_test.cc.
#include "render/page/sky_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/glsl/table_defines.h"
#include "render/page/table_packing.h"
#include "tests/render/gl_fixture.h"

namespace skyfit {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::array kSliders = {Parameter::kGroundAlbedo};

Preset hostile_preset() {
  Preset preset = shipped("earth-clear");
  preset.name = "<script>alert(1)</script>\"";
  preset.note = "</script><img alt=x>";
  return preset;
}

const SkyPage& page() {
  static const SkyPage made = [] {
    const Preset preset = hostile_preset();
    return sky_page({.preset = preset,
                     .spectra = refs::standard_spectral_data(),
                     .sliders = page_sliders(preset.atmosphere, kSliders),
                     .threads = 2});
  }();
  return made;
}

TEST(SkyPage, IsOneSmallFileWithoutANetwork) {
  constexpr std::size_t kMostBytes = 8'000'000;
  std::string html = page().html;
  EXPECT_LT(html.size(), kMostBytes);
  const std::string cited = "https://bottosson.github.io/posts/oklab/";  // in a comment
  html.erase(html.find(cited), cited.size());
  for (const char* link : {"http:", "https:", "src=", "@import", "{{", "import("})
    EXPECT_EQ(html.find(link), std::string::npos) << link;
}

TEST(SkyPage, TakesNoMarkupFromAPreset) {
  EXPECT_THAT(page().html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page().html, Not(HasSubstr("<img")));
  EXPECT_THAT(page().html, HasSubstr("&lt;script>alert(1)&lt;/script>&quot;"));
}

TEST(SkyPage, HoldsThePreset) {
  EXPECT_THAT(page().html, HasSubstr("href=\"data:application/json;base64," +
                                     base64(preset_to_json(hostile_preset())) + "\""));
}

TEST(SkyPage, SaysWhatTheReferenceSays) {
  constexpr double kPromised = 0.03;  // what docs/view.md promises for this preset
  for (const WorstError& worst : page().errors.preset) EXPECT_LT(worst.error, kPromised);
  ASSERT_EQ(page().errors.tabulated.size(), 1);
  EXPECT_LT(page().errors.tabulated[0], kPromised);
  EXPECT_LT(page().errors.half_way[0], kPromised);
}

TEST(SkyPage, NamesTheSliderThatCannotBeMoved) {
  const Preset preset = shipped("thin-cloud");
  const Parameter top = parameter_from_name("cloud.top_m");
  const double bottom = preset.atmosphere.top_radius_m - preset.atmosphere.bottom_radius_m;
  try {
    sky_page({.preset = preset,
              .spectra = refs::standard_spectral_data(),
              .sliders = {{top, 8000, 10000, 2 * bottom, true}},
              .threads = 2});
    FAIL() << "a cloud above the atmosphere";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("the slider cloud.top_m = "));
  }
}

TEST(TablePacking, LosesHalfAStep) {
  Table table{3, 2, 2, {}};
  for (int i = 0; i < 48; ++i) table.rgba.push_back(static_cast<float>(std::sin(1.7 * i)));
  constexpr Packing kPacking{.step = 1.0 / 64};
  const Table decoded = as_decoded(table, kPacking);
  for (std::size_t i = 0; i < table.rgba.size(); ++i)
    EXPECT_LE(std::abs(decoded.rgba[i] - table.rgba[i]), 0.5 * kPacking.step * 1.0001);
}

TEST(TablePacking, RefusesWhatHasNoSteps) {
  const Table infinite{1, 1, 1, {0, 1, 2, INFINITY}};
  EXPECT_THROW(packed(infinite, {}), std::runtime_error);
}

TEST(TablePacking, IsBase64) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(PageSliders, ChangeSharesAreThoseOfAParabola) {
  const auto parabola = [](double t) { return 0.7 * t - 1.3 * t * t; };
  for (const bool logarithmic : {false, true}) {
    for (const double preset : {100.0, 300.0, 500.0}) {  // an end, between them, the other end
      const PageSlider slider{Parameter::kOzoneColumn, 100, preset, 500, logarithmic};
      const auto change = [&](double x) {
        return parabola(logarithmic ? std::log(x / preset) : (x - preset) / 100);
      };
      const auto [a, b] = slider.tabulated();
      for (const double value : {100.0, 170.0, 300.0, 410.0, 500.0}) {
        const auto [first, second] = change_shares(slider, value);
        EXPECT_NEAR(first * change(a) + second * change(b), change(value), 1e-12);
      }
    }
  }
}

TEST(PageSliders, StayWithinTheBoundsOfAFit) {
  const Atmosphere<double> atmosphere = shipped("earth-clear").atmosphere;
  for (const PageSlider& slider : page_sliders(atmosphere, parameters_of(atmosphere))) {
    const ParameterInfo info = parameter_info(slider.parameter);
    EXPECT_GE(slider.low, info.lower) << info.name;
    EXPECT_LE(slider.high, info.upper) << info.name;
    EXPECT_LT(slider.low, slider.high) << info.name;
  }
}

// Two layers of the same particles: a slider of the lobe of one would part a class of the tables.
TEST(PageSliders, LeaveOutPhaseFunctionsThatAreShared) {
  Atmosphere<double> atmosphere = shipped("hillaire-2020").atmosphere;
  EXPECT_THAT(main_parameters(atmosphere), testing::Contains(parameter_from_name("mie.phase.g")));
  atmosphere.constituents.push_back(atmosphere.at("mie"));
  atmosphere.constituents.back().name = "dust";
  const std::vector<Parameter> parameters = main_parameters(atmosphere);
  EXPECT_THAT(parameters, Not(testing::Contains(parameter_from_name("mie.phase.g"))));
  EXPECT_THAT(parameters, testing::Contains(parameter_from_name("dust.scattering")));
}

class EsShaders : public testing::Test {
 protected:
  // What the driver says of a shader; empty where it compiles.
  static std::string complaint(GLenum type, const ShaderText& source) {
    const GlShader shader(glCreateShader(type));
    const char* const text = source.text().c_str();
    glShaderSource(shader.id(), 1, &text, nullptr);
    glCompileShader(shader.id());
    GLint done = GL_FALSE;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &done);
    if (done == GL_TRUE) return "";
    std::string log(4096, '\0');
    glGetShaderInfoLog(shader.id(), static_cast<GLsizei>(log.size()), nullptr, log.data());
    return source.translated(log.c_str());
  }

  const std::unique_ptr<GlContext> context_ = make_osmesa_context();
};

TEST_F(EsShaders, EverySharedFormulaCompiles) {
  int files = 0;
  for (const ShaderSource& file : embedded_shaders()) {
    if (!file.path.starts_with("model/shared/")) continue;
    // The geometry and the mapping first, on which others stand, see model/shared/shared.h.
    const std::string text =
        "#include \"model/shared/geometry.glsl\"\n#include \"model/shared/mapping.glsl\"\n#include "
        "\"" +
        std::string(file.path) + "\"\nout vec4 y;\nvoid main() { y = vec4(0.0); }\n";
    const ShaderSource source{"test.frag", text};
    EXPECT_EQ(complaint(GL_FRAGMENT_SHADER,
                        ShaderText("test.frag", ShaderLanguage::kGlslEs300, {}, {&source, 1})),
              "")
        << file.path;
    ++files;
  }
  EXPECT_GE(files, 8);
}

TEST_F(EsShaders, ErrorsNameTheFile) {
  const ShaderSource source{"test.frag", "\nout vec4 y;\nvoid main() { y = vec4(oops); }\n"};
  EXPECT_THAT(complaint(GL_FRAGMENT_SHADER,
                        ShaderText("test.frag", ShaderLanguage::kGlslEs300, {}, {&source, 1})),
              HasSubstr("test.frag:3: "));
}

}  // namespace
}  // namespace skyfit
