// SPDX-License-Identifier: Apache-2.0
// What a frame may have besides size, camera and sun, a row each: shadows, clouds, a second sun and
// so on. From the rows follow the options of `skyfit render` with their help and with what they go
// together, the names along the axes of strips and grids, the limits of numbers, the names that
// shaders are compiled with, what a frame that was drawn is known by, and a table of
// docs/rendering.md.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/render.h"

namespace skyfit {

struct FeatureOption {
  std::string name;       // "--moonlight"
  std::string type = {};  // of its value, in the help; empty: a flag, or the words
  std::string meaning;    // one sentence or two
  std::vector<std::string> needs = {}, excludes = {};  // other options
  bool repeats = false;                                // may be typed several times
};

struct FeatureWord {
  std::string_view word;
  int value;  // of an enumeration, or 0 and 1
};

struct FeatureLimits {
  double lower, upper;
  std::string_view unit;  // "1": none
  bool is_whole = false;

  bool hold(double value) const;
  std::string text() const;  // "0 to 30 m/s"
};

// What a program of the atmosphere's passes is compiled for.
struct FeatureShader {
  const FrameOptions& options;
  const ColorRule& color;        // of the tables
  bool reads_volume = false;     // of the air before the ground
  bool has_shadow_maps = false;  // that reach into the frame
};

struct RenderFeature {
  std::string_view name;               // what it sets in FrameOptions
  std::string_view group;              // of the options in the help
  std::vector<FeatureOption> options;  // the first asks for the feature
  std::string_view caption = {};       // along an axis of a strip or a grid; empty: it is on none

  // One value: a flag, 0 or 1; a choice of `words`; or a number within `limits`, nothing where the
  // renderer chooses it. Features of several numbers have neither: their options are read by
  // cli/render_scene.cc and validate() knows their limits.
  std::optional<double> (*get)(const FrameOptions&) = nullptr;
  void (*set)(FrameOptions&, double) = nullptr;
  std::vector<FeatureWord> words = {};
  std::optional<FeatureLimits> limits = {};
  // Of several numbers: all that its pixels follow from; null where the frame has none.
  nlohmann::ordered_json (*numbers)(const FrameOptions&) = nullptr;

  // Names, or a name and a value, for #define; none where the feature is off. Null: shaders do not
  // know it.
  std::vector<std::string> (*defines)(const FeatureShader&) = nullptr;
};

std::span<const RenderFeature> render_features();

// All that the pixels of a frame follow from, of one feature.
nlohmann::ordered_json feature_key(const RenderFeature& feature, const FrameOptions& options);

// What all features ask of a program.
std::vector<std::string> feature_defines(const FeatureShader& shader);

}  // namespace skyfit
