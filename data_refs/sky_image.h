// SPDX-License-Identifier: Apache-2.0
// An image of the sky (OpenEXR or Radiance HDR) becomes luminances averaged over bins. The
// facts of import_option_table() state the projection (image_directions.h), the unit or the lumen
// per watt, and the sun or time and place. Loads OpenImageIO (image/image_module.h).
//
// Luminance of a pixel: its channel Y, or 0.2126 R + 0.7152 G + 0.0722 B (sRGB), or 0.265 R +
// 0.670 G + 0.065 B (Radiance's primaries), or by the chromaticities that an EXR file or PRIMARIES
// of a Radiance file states, times `calibration`, times `lumen_per_watt` where the pixels are
// radiances. Of a Radiance file EXPOSURE and COLORCORR are undone, the order of its pixels and VIEW
// are obeyed (radiance_header.h). An image twice as wide as high is a panorama and wants to be
// called one.
//
// Bins: rows about bin_deg high (6 deg where it is not stated) of cells about as wide, or the
// patches of Tregenza with 12; numbered from 1 by rows from the horizon and from north clockwise. A
// bin has the mean luminance, by solid angle, of its usable pixels and looks into their mean
// direction. It is not used when less than half of it is; saturated, masked, not finite, not
// positive pixels and those near the sun are not.
#pragma once

#include <filesystem>
#include <string>

#include "data_refs/image/image_module.h"
#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

// Whether a file begins as OpenEXR or Radiance HDR do.
bool is_sky_image(const std::filesystem::path& file);

// As they stand in an image file. Throws std::runtime_error when it cannot be read.
Image pixels_of(const std::filesystem::path& file);

// Throws std::invalid_argument `file: field = value: expected ...`, std::runtime_error when the
// file cannot be read.
Reference load_sky_image(const std::filesystem::path& file, const ImportOptions& options);

// The same from pixels. `is_radiance_hdr` chooses the primaries; `mask`, if given, has the size of
// the image, and its pixels below one half are not used.
Reference sky_image_reference(const Image& image, const Image* mask, bool is_radiance_hdr,
                              const std::string& source, const ImportOptions& facts);

}  // namespace skyfit::refs
