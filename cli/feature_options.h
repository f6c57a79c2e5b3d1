// SPDX-License-Identifier: Apache-2.0
// The options of `skyfit render` that stand in the rows of render/features/render_features.h.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "render/render.h"

namespace skyfit::cli {

void add_feature_options(CLI::App& command);

// A frame with what was typed of the features of one value. Throws UsageError.
FrameOptions frame_with_features(const CLI::App& command);

// An option and another that it needs, or that it goes without.
struct OptionPair {
  std::string option, other;
};
std::vector<OptionPair> feature_needs();
std::vector<OptionPair> feature_excludes();

}  // namespace skyfit::cli
