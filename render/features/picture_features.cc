// SPDX-License-Identifier: Apache-2.0
#include "model/geometry/map_projection.h"
#include "render/features/feature_rows.h"

namespace skyfit {
namespace {

constexpr std::string_view kGroup = "Picture";

using Defines = std::vector<std::string>;

RenderFeature aerial() {
  return with_value(
      [](auto& options) -> auto& { return options.aerial; },
      {.name = "aerial",
       .group = kGroup,
       .options = {{.name = "--aerial",
                    .meaning = "Light of the air before the ground: by pixel, or faster from a "
                               "volume of 32 x 32 x 16. It is by pixel with meshes, a moon or a "
                               "second sun, in projections, above 12 km, where the ground may rise "
                               "above the air, "
                               "and under atmospheres with a dense layer, as of cloud"}},
       .caption = "aerial",
       .words = {word("pixel", AerialPerspective::kPerPixel),
                 word("volume", AerialPerspective::kVolume)},
       .defines = [](const FeatureShader& shader) {
         return shader.reads_volume ? Defines{"VOLUME"} : Defines{};
       }});
}

RenderFeature glare() {
  return with_value(
      [](auto& options) -> auto& { return options.glare; },
      {.name = "glare",
       .group = kGroup,
       .options = {{.name = "--glare",
                    .meaning = "Light of the sun that the eye scatters over the PNG, by the CIE's "
                               "glare function (CIE 146:2002)"}},
       .caption = "glare",
       .words = {word("eye", Glare::kEye), word("none", Glare::kNone)}});
}

RenderFeature layers() {
  return with_value(
      [](auto& options) -> auto& { return options.layers; },
      {.name = "layers",
       .group = kGroup,
       .options = {{.name = "--layers",
                    .meaning = "Add to the EXR: light of the air and of the ground, transmittance, "
                               "normal, albedo"}},
       .defines = [](const FeatureShader& shader) {
         return shader.options.layers ? Defines{"LAYERS"} : Defines{};
       }});
}

RenderFeature projection() {
  std::vector<FeatureWord> words = {word("perspective", PictureProjection::kPerspective)};
  for (const MapProjectionEntry& entry : map_projections())
    words.push_back({entry.name, static_cast<int>(words.size())});
  return with_value(
      [](auto& options) -> auto& { return options.projection; },
      {.name = "projection",
       .group = kGroup,
       .options = {{.name = "--projection",
                    .meaning = "How directions become pixels: perspective, or all directions as "
                               "skyfit sky-map lays them out, whose north is here the camera's "
                               "azimuth or heading; fisheye, about the zenith, and angular, about "
                               "the direction of view, take any --field-of-view-deg up to 360",
                    .excludes = {"--overview-m"}}},
       .words = words});
}

}  // namespace

std::vector<RenderFeature> picture_features() {
  return {projection(), aerial(), glare(), layers()};
}

}  // namespace skyfit
