// SPDX-License-Identifier: Apache-2.0
// The rows of render/features/render_features.h: what is set is read back, a frame without features
// asks shaders for nothing, and shaders know every name that a row defines.
#include "render/features/render_features.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <regex>
#include <set>

#include "data_refs/spectra.h"
#include "model/photometry/photometry.h"
#include "render/glsl/shader_text.h"
#include "render/sky_map/mapped_frame.h"

namespace skyfit {
namespace {

const ColorRule& color() {
  static const ColorRule kRule = color_rule(refs::standard_spectral_data());
  return kRule;
}

// Every value that a row of one value can be asked for: the ends of a number's limits.
std::vector<double> values_of(const RenderFeature& feature) {
  if (feature.limits) return {feature.limits->lower, feature.limits->upper};
  std::vector<double> values;
  for (const FeatureWord& word : feature.words) values.push_back(word.value);
  return values.empty() ? std::vector<double>{0, 1} : values;
}

TEST(RenderFeatures, WhatIsSetIsReadBackAndIsAnotherKey) {
  for (const RenderFeature& feature : render_features()) {
    ASSERT_EQ(feature.set == nullptr, feature.numbers != nullptr) << feature.name;
    if (feature.set == nullptr) continue;
    std::vector<nlohmann::ordered_json> keys;
    for (const double value : values_of(feature)) {
      FrameOptions options;
      feature.set(options, value);
      EXPECT_EQ(feature.get(options), value) << feature.name;
      if (options.projection != PictureProjection::kPerspective)
        options.width = entry_of(options.projection).make(options.height, 1)->width();
      validate(options);
      const auto key = feature_key(feature, options);
      EXPECT_THAT(keys, testing::Not(testing::Contains(key))) << feature.name;
      keys.push_back(key);
    }
    if (!feature.limits) continue;
    FrameOptions beyond;
    feature.set(beyond, feature.limits->upper + 1);
    EXPECT_THROW(validate(beyond), std::invalid_argument) << feature.name;
  }
}

// By `asked`, in its own row alone.
void expect_in_key(std::string_view name, const FrameOptions& asked) {
  for (const RenderFeature& feature : render_features())
    EXPECT_EQ(feature_key(feature, asked) != feature_key(feature, {}), feature.name == name)
        << feature.name << " of " << name;
}

TEST(RenderFeatures, OfSeveralNumbersAreInTheKey) {
  FrameOptions clouds, moon, sun;
  clouds.clouds = {CloudLayer{}};
  moon.moon = Moon{};
  sun.second_sun = SecondSun{};
  expect_in_key("clouds", clouds);
  expect_in_key("moon", moon);
  expect_in_key("second_sun", sun);
}

std::vector<std::string> names(const FeatureShader& shader) {
  std::vector<std::string> defined = feature_defines(shader);
  for (std::string& name : defined) name.resize(std::min(name.size(), name.find(' ')));
  return defined;
}

TEST(RenderFeatures, ShadersAreCompiledForThoseThatAreOn) {
  using testing::ElementsAre;
  using testing::IsEmpty;
  FrameOptions options;
  EXPECT_THAT(names({options, color()}), IsEmpty());
  options.shadows = true;
  EXPECT_THAT(names({options, color()}), IsEmpty());  // no map reaches the frame
  options.clouds = {CloudLayer{}};
  EXPECT_THAT(names({options, color(), false, true}),
              ElementsAre("SHADOWS", "CLOUD_SHADOWS", "CLOUDS"));
  options = {};
  options.second_sun = SecondSun{};
  EXPECT_THAT(names({options, color()}), ElementsAre("SECOND_SUN"));
  options.moon = Moon{};
  EXPECT_THAT(names({options, color()}), ElementsAre("SECOND_SUN"));  // this moon lights nothing
}

// A name that no shader asks for would be a feature that does nothing.
TEST(RenderFeatures, ShadersKnowEveryNameThatIsDefined) {
  std::set<std::string> defined;
  const auto add = [&](const FrameOptions& options) {
    for (const std::string& name : names({options, color(), true, true})) defined.insert(name);
  };
  for (const RenderFeature& feature : render_features()) {
    if (feature.set == nullptr) continue;
    for (const double value : values_of(feature)) {
      FrameOptions options;
      feature.set(options, value);
      add(options);
    }
  }
  FrameOptions several;
  several.shadows = true;
  several.clouds = {CloudLayer{}};
  several.moon = Moon{.lights = true};
  add(several);
  EXPECT_THAT(defined, testing::IsSupersetOf({"CLOUD_SHADOWS", "CLOUDS", "SECOND_SUN",
                                              "SECOND_COLOR", "MOON_RADIUS"}));
  for (const std::string& name : defined) {
    const std::regex asked(R"(#if(def|\b.*\bdefined).*\b)" + name + R"(\b)");
    EXPECT_TRUE(std::ranges::any_of(embedded_shaders(), [&](const ShaderSource& shader) {
      return std::regex_search(shader.text.begin(), shader.text.end(), asked);
    })) << name;
  }
}

}  // namespace
}  // namespace skyfit
