// SPDX-License-Identifier: Apache-2.0
// What the header of a Radiance picture (#?RADIANCE) says beside its pixels' format: variables that
// change how the pixels are to be read, the order of the pixels, and the view. Variables that begin
// with a tab belong to pictures that this one was made from.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "data_refs/image/image_module.h"
#include "data_refs/import_options.h"

namespace skyfit::refs {

struct RadianceHeader {
  double exposure = 1;                               // product of EXPOSURE=
  std::array<double, 3> colour_correction{1, 1, 1};  // product of COLORCORR=
  std::optional<Chromaticities> primaries;           // PRIMARIES=
  bool is_xyz = false;                               // FORMAT=32-bit_rle_xyze
  std::string view;                                  // the last VIEW=, empty: none
  std::string order;                                 // "-Y +X", as the line of the size has it
};

// Throws std::invalid_argument `file: "LINE": expected ...`.
RadianceHeader read_radiance_header(const std::filesystem::path& file);

// The picture, whose rows and columns come in another order, with the upper left pixel first.
// `order` is one of the eight of Radiance.
Image upright(const Image& image, const std::string& order);

// The facts with what the view states: the projection and where north is. Throws
// std::invalid_argument when the view is no fisheye of the sky or differs from the facts.
ImportOptions with_view(const ImportOptions& facts, const std::string& view,
                        const std::string& source);

}  // namespace skyfit::refs
