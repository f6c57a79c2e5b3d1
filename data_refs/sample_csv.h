// SPDX-License-Identifier: Apache-2.0
// A CSV of samples becomes a Reference, and a Reference such a CSV. Columns, in any order
// (data_refs/examples/ has a file that shows them):
//   sun_zenith_deg        0 <= . < 90: the sun stands above the horizon
//   view_zenith_deg       0 <= . < 90
//   relative_azimuth_deg  -360 .. 360, 0 = toward the sun; or sun_azimuth_deg and view_azimuth_deg,
//                         in one sense of turning
// and exactly one of
//   luminance_cd_m2       > 0
//   relative_luminance    > 0, free up to a factor per scan
//   spectral_radiance_w_m2_sr_nm  > 0, with wavelength_nm > 0
// Optional:
//   sigma                 > 0: one standard deviation in the unit of the value
//   q_over_i, u_over_i    -1 .. 1: Q / I and U / I in the meridian plane of the view, U > 0
//                         clockwise from up, as `skyfit sky --stokes` prints them; an empty field
//                         was not measured
//   dolp                  0 .. 1: the degree of linear polarisation, with neither of the two
//   q_over_i_sigma, u_over_i_sigma, dolp_sigma   > 0: one standard deviation of each
//   weight                >= 0, 1 when absent; 0 leaves the sample out, which may then have any
//                         value and a view zenith to 180
//   zero_weight_reason    why the weight is 0
//   direction             a whole number >= 0: that of the direction in its scan
//   scan                  label; samples of one scan share a luminance scale. When absent, every
//                         sun position is a scan; where every sample has one of its own, a scan
//                         ends where the sun jumps by 1 deg
//   time_utc, sun_distance_au, elevation_m   of the scan, as its first sample says
// Format of the text: data_refs/csv.h.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

// Throws std::invalid_argument with one line that names source, line, column, value and what was
// expected. Excluded samples are numbered from 0 in the order of the file.
Reference parse_sample_csv(std::string_view text, std::string_view source,
                           std::span<const ExcludedSample> excluded = {});

// With the columns that the reference has something to say in; numbers have nine digits. Its name
// and description are a comment.
std::string sample_csv_text(const Reference& reference);

}  // namespace skyfit::refs
