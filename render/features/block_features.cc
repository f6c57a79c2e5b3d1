// SPDX-License-Identifier: Apache-2.0
#include "render/features/feature_rows.h"

namespace skyfit {
namespace {

constexpr std::string_view kGroup = "Blocks of the ground";

RenderFeature lod_constant() {
  const FeatureLimits limits{kLeastLodConstant, kLargestLodConstant, "1"};
  return with_value(
      [](auto& options) -> auto& { return options.terrain.lod_constant; },
      {.name = "terrain.lod_constant",
       .group = kGroup,
       .options = {{.name = "--lod-constant",
                    .type = "C",
                    .meaning = fmt::format(
                        "A block of 33 x 33 vertices is divided while it is nearer than C edges "
                        "of its triangles, {}; by default as fine as the picture shows",
                        limits.text())}},
       .caption = "C",
       .limits = limits});
}

RenderFeature levels() {
  const FeatureLimits limits{1, kMostLevels, "1", true};
  return with_value(
      [](auto& options) -> auto& { return options.terrain.levels; },
      {.name = "terrain.levels",
       .group = kGroup,
       .options = {{.name = "--terrain-levels",
                    .type = "N",
                    .meaning = fmt::format("Levels of the planet's six trees of blocks, {}; by "
                                           "default as many as show details of 0.3 m",
                                           limits.text())}},
       .caption = "levels",
       .limits = limits});
}

RenderFeature culling() {
  return with_value(
      [](auto& options) -> auto& { return options.terrain.cull; },
      {.name = "terrain.cull",
       .group = kGroup,
       .options = {{.name = "--culling",
                    .meaning = "off: blocks that are outside the picture, behind the horizon or "
                               "behind nearer ground are drawn, too"}},
       .caption = "culling",
       .words = {{"on", 1}, {"off", 0}}});
}

RenderFeature wireframe() {
  return with_value([](auto& options) -> auto& { return options.terrain.wireframe; },
                    {.name = "terrain.wireframe",
                     .group = kGroup,
                     .options = {{.name = "--wireframe",
                                  .meaning = "The edges of the ground's triangles alone"}}});
}

RenderFeature block_boxes() {
  return with_value(
      [](auto& options) -> auto& { return options.terrain.boxes; },
      {.name = "terrain.boxes",
       .group = kGroup,
       .options = {{.name = "--block-boxes",
                    .meaning = "Boxes about the blocks, coloured by level (red, orange, yellow, "
                               "green, cyan, violet in turn), or drawn ones green, those outside "
                               "the picture red, behind the horizon blue"}},
       .caption = "boxes",
       .words = {word("none", BlockColors::kNone), word("level", BlockColors::kLevel),
                 word("culling", BlockColors::kCulling)}});
}

}  // namespace

std::vector<RenderFeature> block_features() {
  return {lod_constant(), levels(), culling(), wireframe(), block_boxes()};
}

}  // namespace skyfit
