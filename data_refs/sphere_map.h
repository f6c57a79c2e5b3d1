// SPDX-License-Identifier: Apache-2.0
// A picture of all directions as `skyfit sky-map` writes it (model/geometry/map_projection.h):
// `angular`, a light probe, `cube`, six faces side by side, or `octahedral`. What lies below the
// horizon is no sky. North lies facts.north_deg right of where the projection has it; to the right
// of north lies east, or west where facts.east says "left" and the picture is seen from without.
#pragma once

#include <memory>
#include <string_view>

#include "data_refs/image_directions.h"
#include "model/geometry/map_projection.h"

namespace skyfit::refs {

bool is_sphere_map(std::string_view projection);

class SphereMap final : public ImageDirections {
 public:
  // facts.projection is one of them. Throws std::invalid_argument that begins with `source` when
  // the image has another shape.
  SphereMap(const ImportOptions& facts, int width, int height, std::string_view source);

  std::optional<PixelView> view(double x_px, double y_px) const override;

 private:
  std::unique_ptr<MapProjection> map_;
  double north_;
  bool east_is_left_;
};

}  // namespace skyfit::refs
