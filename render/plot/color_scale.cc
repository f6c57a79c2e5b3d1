// SPDX-License-Identifier: Apache-2.0
#include "render/plot/color_scale.h"

#include <algorithm>

namespace skyfit::plot {

double scale_title_px(const Box& box, const Script& script) {
  const double centre = box.left + box.width / 2;
  return script.sheet().on_page()
             ? std::min(1.25 * box.width, 2 * std::min(centre, script.width() - centre))
             : script.width();
}

void draw_color_scale(Script& script, const Box& box, const std::vector<Tick>& ticks,
                      std::string_view title, const std::function<std::string(double)>& color_at) {
  constexpr int kScaleSteps = 80;
  script.begin_axes(box);
  script.line("set border 15 lc rgb '{}' lw 0.8; set xrange [0:1]; set yrange [0:1]", kFrameColor);
  for (int i = 0; i < kScaleSteps; ++i) {
    const double left = static_cast<double>(i) / kScaleSteps;
    const std::string color = color_at(left + 0.5 / kScaleSteps);
    script.line(
        "set object rectangle from {:.9g},0 to {:.9g},1 behind fs solid border lc rgb '{}' fc rgb "
        "'{}'",
        left, left + 1.0 / kScaleSteps, color, color);
  }
  std::string tics;
  for (const Tick& tick : ticks) {
    if (tick.label.empty()) continue;
    tics += fmt::format("{}'{}' {:.6g}", tics.empty() ? "" : ", ", tick.label, tick.position);
  }
  script.line("set xtics ({}) scale 0.5 nomirror textcolor rgb '#202020' offset 0,0.3", tics);
  const Sheet& sheet = script.sheet();
  script.text_lines(box.left + box.width / 2, box.bottom - (sheet.on_page() ? 28 : 36),
                    scale_title_px(box, script), title, "center font text_font");
  script.line("plot NaN notitle");
}

}  // namespace skyfit::plot
