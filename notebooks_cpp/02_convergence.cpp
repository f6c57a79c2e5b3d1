// SPDX-License-Identifier: Apache-2.0
// %% [markdown]
// # How the reference model converges
//
// The model `reference` divides the air into levels, the zenith angle into streams, the phase
// function into Legendre moments and the azimuth into Fourier modes. This notebook varies each of
// these numbers alone, compares with a solution that is fine in all of them, and then takes the
// light apart by how often it met air or ground. What is measured here is the error of the
// discretisation, not that of the physics: docs/accuracy.md has the comparison with Monte Carlo.

// %%
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "model/solver/reference_model.h"
#include "notebooks_cpp/notebook.h"
#include "render/plot/figure_file.h"
#include "render/plot/legend.h"
#include "render/plot/script.h"

using namespace skyfit;

constexpr double kDegree = std::numbers::pi / 180;
const WavelengthNode kGreen{550, 0};

// Prints what was checked; a check that fails ends the notebook.
void check(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error("does not hold: " + what);
  std::cout << "holds: " << what << '\n';
}

// Radiance per unit solar irradiance (1/sr) at 550 nm.
std::vector<double> radiances(const Atmosphere<double>& air, const std::vector<SkyPoint>& points,
                              ReferenceOptions options) {
  options.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return ReferenceModel(options).radiance(air, {&kGreen, 1}, points, {}).value;
}

// %% [markdown]
// A figure is a row of panels that share their logarithmic ordinate.

// %%
struct Curve {
  plot::Mark mark;
  std::string_view color;
  std::vector<std::array<double, 2>> points;
};

struct Panel {
  std::string abscissa;
  std::array<double, 2> range;
  bool logarithmic;
  std::vector<plot::Tick> ticks;
  std::vector<Curve> curves;
};

void draw_axes(plot::Script& script, const Panel& panel, const plot::Box& box,
               const std::array<double, 2>& ordinate, bool leftmost) {
  script.begin_axes(box);
  script.line("set border 15 lc rgb '{}' lw 0.8; set logscale y", plot::kFrameColor);
  if (panel.logarithmic) script.line("set logscale x");
  script.line("set xrange [{:.9g}:{:.9g}]; set yrange [{:.9g}:{:.9g}]", panel.range[0],
              panel.range[1], ordinate[0], ordinate[1]);
  script.line("set grid xtics ytics lt 1 lw 0.6 lc rgb '{}' back", plot::kGridColor);
  const auto list = [](const std::vector<plot::Tick>& ticks, bool labels) {
    std::string text;
    for (const plot::Tick& tick : ticks)
      text += fmt::format("{}'{}' {:.9g} {}", text.empty() ? "" : ", ", labels ? tick.label : "",
                          tick.position, tick.label.empty() ? 1 : 0);
    return text;
  };
  script.line("set xtics scale 0.5,0.3 nomirror ({})", list(panel.ticks, true));
  script.line("set ytics scale 0.5,0.3 nomirror ({})",
              list(plot::log_ticks(ordinate[0], ordinate[1]), leftmost));
  script.text_label(box.left + box.width / 2, box.bottom - 40, panel.abscissa, "center font ',12'");
}

void draw_curves(plot::Script& script, const std::vector<Curve>& curves) {
  std::string plots;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    script.line("$c{} << EOD", i);
    for (const auto& [x, y] : curves[i].points) script.line("{:.9g} {:.9g}", x, y);
    script.line("EOD");
    const bool solid = curves[i].mark == plot::Mark::kSolidLine;
    plots += fmt::format("{} $c{} with {} {} notitle", i == 0 ? "plot" : ",", i,
                         solid ? "linespoints" : "lines",
                         plot::mark_style(curves[i].mark, curves[i].color));
  }
  script.line("{}", plots);
}

void draw_figure(const std::filesystem::path& png, const std::string& ordinate_title,
                 const std::array<double, 2>& ordinate, const std::vector<Panel>& panels,
                 const std::vector<plot::LegendEntry>& legend) {
  const double left = 90, gap = 16, bottom = 60, width = 300, height = 340;
  const double right = left + width * static_cast<double>(panels.size());
  plot::Script script(right, bottom + height + 44, {});
  script.line("set multiplot");
  script.begin_axes({0, 0, script.width(), script.height()});
  script.text_label(22, bottom + height / 2, ordinate_title, "center rotate by 90 font ',12'");
  plot::draw_legend(script, plot::legend_rows(legend, right - left, script.sheet()),
                    (left + right) / 2, bottom + height + 22);
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const plot::Box box{left + width * static_cast<double>(i), bottom, width - gap, height};
    draw_axes(script, panels[i], box, ordinate, i == 0);
    draw_curves(script, panels[i].curves);
  }
  script.line("unset multiplot");
  plot::write_figure(plot::figure_of(script), {png});
}

// %% [hidden]
void run_notebook(notebook::Page& page) {
  // %% [markdown]
  // ## Three atmospheres, many directions
  //
  // Air of the Earth with an aerosol of three optical depths, over ground of albedo 0.2. The
  // directions include what is hard: a sun zenith angle of 88 degrees, where horizontal coupling
  // matters, and lines of sight one degree above the horizon.

  // %%
  page.cell();
  const std::array<std::string, 3> names = {"clear", "haze", "thick haze"};
  const std::array<double, 3> depths = {0.005, 0.2, 1.0};
  std::array<Atmosphere<double>, 3> airs;
  for (std::size_t i = 0; i < airs.size(); ++i) {
    airs[i].at("mie").single_scattering_albedo = 0.95;
    airs[i].at("mie").amount = 0.95 * depths[i] / airs[i].at("mie").profile.scale_height_m;
    airs[i].at("mie").angstrom_exponent = 1;
    airs[i].ground_albedo = 0.2;
    std::cout << fmt::format("{:<11} aerosol optical depth {:.3f} at 550 nm\n", names[i],
                             depths[i]);
  }
  std::vector<SkyPoint> points;
  for (const double altitude : {0.0, 10e3})
    for (const double sun : {0, 30, 60, 80, 88})
      for (const double view : {0, 20, 40, 60, 75, 85, 89})
        for (const double azimuth : {0, 90, 180})
          points.push_back({altitude, sun * kDegree, view * kDegree, azimuth * kDegree});
  std::cout << points.size() << " directions\n";

  // %% [markdown]
  // ## The fine solution
  //
  // It has three times the default's streams and moments, more than three times its levels, and
  // every azimuth mode. The error of the default against it:

  // %%
  page.cell();
  const ReferenceOptions standard;
  ReferenceOptions fine;
  fine.streams = 24;
  fine.moments = 48;
  fine.levels = 96;
  fine.tolerance = 1e-9;
  std::array<std::vector<double>, 3> truth;
  for (std::size_t i = 0; i < airs.size(); ++i) truth[i] = radiances(airs[i], points, fine);

  struct Change {
    double rms = 0, worst = 0;  // relative
  };
  const auto change = [&](std::size_t air, const ReferenceOptions& options) {
    const std::vector<double> coarse = radiances(airs[air], points, options);
    Change result;
    for (std::size_t i = 0; i < coarse.size(); ++i) {
      const double relative = std::abs(coarse[i] / truth[air][i] - 1);
      result.rms += relative * relative / static_cast<double>(coarse.size());
      result.worst = std::max(result.worst, relative);
    }
    result.rms = std::sqrt(result.rms);
    return result;
  };
  std::array<Change, 3> of_default;
  std::cout << "relative change of the radiance, default against fine\n"
               "atmosphere      rms (%)  worst (%)\n";
  for (std::size_t i = 0; i < airs.size(); ++i) {
    of_default[i] = change(i, standard);
    std::cout << fmt::format("{:<14} {:>8.3f} {:>10.3f}\n", names[i], 100 * of_default[i].rms,
                             100 * of_default[i].worst);
  }

  // %% [markdown]
  // ## One number at a time
  //
  // A solver of $n$ streams per hemisphere carries at most $2n$ moments. Where a number would
  // violate that, its partner follows: fewer streams mean fewer moments, more moments mean more
  // streams.
  // Every curve ends where the error of the other numbers, which stay at their defaults, takes
  // over.

  // %%
  page.cell();
  struct Knob {
    std::string title, abscissa;
    std::vector<ReferenceOptions> settings;
    double (*value)(const ReferenceOptions&);
    std::array<double, 2> range;
  };
  std::vector<Knob> knobs = {
      {"levels", "levels", {}, [](const auto& o) { return 1.0 * o.levels; }, {10, 90}},
      {"streams",
       "streams per hemisphere",
       {},
       [](const auto& o) { return 1.0 * o.streams; },
       {3, 25}},
      {"moments", "moments", {}, [](const auto& o) { return 1.0 * o.moments; }, {3, 55}},
      {"tolerance",
       "tolerance of the modes",
       {},
       [](const auto& o) { return o.tolerance; },
       {5e-7, 0.2}}};
  const auto add = [&](std::size_t knob, auto set) {
    knobs[knob].settings.push_back(standard);
    set(knobs[knob].settings.back());
  };
  for (const int levels : {12, 16, 20, 28, 40, 56, 80})
    add(0, [&](ReferenceOptions& o) { o.levels = levels; });
  for (const int streams : {4, 6, 8, 12, 16, 20})
    add(1, [&](ReferenceOptions& o) {
      o.streams = streams;
      o.moments = std::min(standard.moments, 2 * streams);
    });
  for (const int moments : {4, 6, 8, 12, 16, 24, 40})
    add(2, [&](ReferenceOptions& o) {
      o.moments = moments;
      o.streams = std::max(standard.streams, moments / 2);
    });
  for (const double tolerance : {1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 1e-4, 1e-6})
    add(3, [&](ReferenceOptions& o) { o.tolerance = tolerance; });

  std::vector<Panel> panels;
  for (const Knob& knob : knobs) {
    Panel panel{knob.abscissa, knob.range, true, plot::log_ticks(knob.range[0], knob.range[1]), {}};
    for (const plot::Mark mark : {plot::Mark::kSolidLine, plot::Mark::kDashedLine})
      for (std::size_t i = 0; i < airs.size(); ++i)
        panel.curves.push_back({mark, plot::kCurveColors[i], {}});
    std::cout << fmt::format("{:<10}", knob.title);
    for (const std::string& name : names) std::cout << fmt::format("{:>11} rms, worst (%)", name);
    std::cout << '\n';
    for (const ReferenceOptions& options : knob.settings) {
      const double value = knob.value(options);
      std::cout << fmt::format("{:<10.6g}", value);
      for (std::size_t i = 0; i < airs.size(); ++i) {
        const Change found = change(i, options);
        std::cout << fmt::format("{:>17.3f} {:>8.3f}", 100 * found.rms, 100 * found.worst);
        panel.curves[i].points.push_back({value, 100 * found.rms});
        panel.curves[airs.size() + i].points.push_back({value, 100 * found.worst});
      }
      std::cout << '\n';
    }
    std::cout << '\n';
    panels.push_back(panel);
  }
  std::vector<plot::LegendEntry> legend;
  for (std::size_t i = 0; i < airs.size(); ++i) {
    legend.push_back({plot::Mark::kSolidLine, plot::kCurveColors[i], names[i] + ", rms"});
    legend.push_back({plot::Mark::kDashedLine, plot::kCurveColors[i], "worst"});
  }
  draw_figure(page.scratch("convergence.png"), "change against the fine solution (%)", {0.005, 200},
              panels, legend);
  page.figure(page.scratch("convergence.png"));

  // %% [markdown]
  // ## Orders of scattering
  //
  // Order $k$ is light that met air or ground exactly $k$ times; the first is single scattering.
  // In the long run each order passes on the same share of the one before: the deeper the air, the
  // larger the share, and the more orders a method would need that adds them up. The model does
  // not: it solves for all of them at once.

  // %%
  page.cell();
  constexpr int kOrders = 20, kShown = 8, kDrawn = 12;
  const std::vector<SkyPoint> looks = {{0, 60 * kDegree, 0, 0},
                                       {0, 60 * kDegree, 80 * kDegree, 180 * kDegree}};
  Panel by_order{"", {0.5, kDrawn + 0.5}, false, {}, {}};
  for (int order = 1; order <= kDrawn; ++order)
    by_order.ticks.push_back({1.0 * order, fmt::format("{}", order)});
  std::vector<Panel> order_panels(looks.size(), by_order);
  order_panels[0].abscissa = "order, view zenith 0°";
  order_panels[1].abscissa = "order, view zenith 80°";
  std::array<std::array<std::array<double, kOrders + 1>, 2>, 3> percent{};  // 0: all orders
  for (std::size_t i = 0; i < airs.size(); ++i) {
    const std::vector<double> whole = radiances(airs[i], looks, standard);
    for (Panel& panel : order_panels)
      panel.curves.push_back({plot::Mark::kSolidLine, plot::kCurveColors[i], {}});
    ReferenceOptions single = standard;
    for (single.order = 1; single.order <= kOrders; ++single.order) {
      const std::vector<double> part = radiances(airs[i], looks, single);
      for (std::size_t k = 0; k < looks.size(); ++k) {
        const double share = 100 * part[k] / whole[k];
        percent[i][k][single.order] = share;
        percent[i][k][0] += share;
        if (single.order <= kDrawn)
          order_panels[k].curves[i].points.push_back({1.0 * single.order, share});
      }
    }
  }
  std::cout << "share of the radiance (%) by order, from the ground, sun zenith 60 deg;\n"
               "view zenith 0 deg | view zenith 80 deg, away from the sun\n"
               "order   ";
  for (const std::string& name : names) std::cout << fmt::format("{:>20}", name);
  std::cout << '\n';
  const auto row = [&](const std::string& title, int order) {
    std::cout << fmt::format("{:<8}", title);
    for (const auto& air : percent)
      std::cout << fmt::format("{:>10.3f} |{:>8.3f}", air[0][order], air[1][order]);
    std::cout << '\n';
  };
  for (int order = 1; order <= kShown; ++order) row(fmt::format("{}", order), order);
  row(fmt::format("1 .. {}", kOrders), 0);
  std::vector<plot::LegendEntry> order_legend;
  for (std::size_t i = 0; i < airs.size(); ++i)
    order_legend.push_back({plot::Mark::kSolidLine, plot::kCurveColors[i], names[i]});
  draw_figure(page.scratch("orders.png"), "share of the radiance (%)", {1e-6, 200}, order_panels,
              order_legend);
  page.figure(page.scratch("orders.png"));

  // %% [markdown]
  // ## What must hold
  //
  // The default is made for clear air and haze. On the command line, `skyfit sky --orders N` prints
  // orders of scattering.

  // %%
  page.cell();
  check(of_default[0].rms < 0.01, "clear: the default is within 1 % rms of the fine solution");
  check(of_default[1].rms < 0.01, "haze: the default is within 1 % rms of the fine solution");
  for (std::size_t i = 0; i < airs.size(); ++i)
    for (std::size_t k = 0; k < looks.size(); ++k)
      check(std::abs(percent[i][k][0] - 100) < 0.2,
            fmt::format("{}, direction {}: {} orders make the whole within 0.2 %", names[i], k + 1,
                        kOrders));

  // %% [hidden]
}
