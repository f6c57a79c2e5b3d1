// SPDX-License-Identifier: Apache-2.0
// The comparison figure: reference, fitted and start luminance over view zenith in the principal
// plane, one panel per sun position (Bruneton & Neyret 2008; Bodare & Sandberg 2014, Fig. 25),
// beside hemispherical maps of the residual.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "data_refs/samples.h"
#include "render/plot/figure_file.h"
#include "render/plot/samples_csv.h"

namespace skyfit::plot {

inline constexpr std::size_t kMaxCurves = 11;  // colours that stay apart
inline constexpr std::size_t kMapCurves = 4;   // curves whose maps of the sky find a place
inline constexpr std::size_t kMaxPanels =
    16;  // more suns than that: evenly chosen ones are shown, and it is said

// One model against the reference. `plane` feeds the panels (samples off the principal plane are
// left out of them), `hemisphere` the maps; a list may be empty, and one list may serve for both.
struct Curve {
  std::string label;  // legend, e.g. "fitted, two lobes"
  std::vector<Sample> plane;
  std::vector<Sample> hemisphere;
};

struct Comparison {
  std::string title;
  std::string subtitle;         // one line, may be empty
  std::string reference_label;  // legend, e.g. "reference cie:12"
  refs::Quantity quantity = refs::Quantity::kRelativeLuminance;
  double exclude_sun_deg =
      3;  // cone around the sun that is left out; shaded, and no line is drawn across it
  std::vector<Curve> curves;  // 1 .. kMaxCurves; start values are drawn when there is one curve
};

// The panels of one sun position: what the figure prints in it.
struct SunPanel {
  double sun_zenith_deg = 0;
  std::vector<double> rms_plane_percent,
      rms_hemisphere_percent;  // per curve; NaN: no samples with weight
};
std::vector<SunPanel> sun_panels(const Comparison& comparison);

// Whether the view lies in the sun's vertical plane (within 0.01 deg of azimuth), and the view
// zenith there: positive toward the sun, negative away from it.
bool in_principal_plane(const Sample& sample);
double signed_view_zenith_deg(const Sample& sample);
std::vector<Sample> plane_samples(const Curve& curve);  // those of `plane` that lie in the plane

// Throws std::invalid_argument with one line for a figure that cannot be drawn: no curves or too
// many, no samples, a value that is not positive.
void validate(const Comparison& comparison);

// The panels are the sun's positions. Throws as validate() and Sheet::chosen() do.
Figure comparison_figure(const Comparison& comparison, const Sheet& sheet = {});

// Writes the same figure to every file; the extension (.svg, .png, .pdf) chooses the format. All
// files appear whole, or none does. Throws as comparison_figure() and write_figure() do.
void write_comparison(const Comparison& comparison, const std::vector<std::filesystem::path>& files,
                      const Sheet& sheet = {});

}  // namespace skyfit::plot
