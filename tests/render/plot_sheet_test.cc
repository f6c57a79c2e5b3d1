// SPDX-License-Identifier: Apache-2.0
// A figure on a page has the width and the size of text that were asked for, all of its text lies
// on the page, and it shows the panels that were chosen.
#include <gmock/gmock.h>

#include <regex>

#include "plot_samples.h"
#include "render/plot/fisheye.h"
#include "render/plot/measured_figures.h"
#include "render/plot/polarisation_maps.h"
#include "render/plot/sheet.h"

namespace skyfit::plot {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

Sheet page(double width_mm, double font_pt, std::vector<int> panels = {}) {
  return {width_mm, font_pt, 1, true, std::move(panels)};
}

// 72 points and 25.4 mm are an inch; kTextPixels are the size of the text.
TEST(Sheet, IsAsWideAsItsMillimetresHoldText) {
  EXPECT_NEAR(page(25.4, 12).width_px(1000), 72, 1e-9);
  EXPECT_NEAR(page(25.4, 6).width_px(1000), 144, 1e-9);
  EXPECT_EQ(Sheet().width_px(1000), 1000);
}

TEST(Sheet, LinesAreNoWiderThanAsked) {
  const Sheet sheet = page(85, 8);
  const std::string text = "RMS log error 3.82 % in the panels, 4.25 % over the whole sky";
  std::string joined;
  for (const std::string& line : wrapped(text, 100, sheet)) {
    EXPECT_LE(text_width_px(line, sheet), 100) << line;
    EXPECT_FALSE(line.starts_with("%")) << line;
    joined += (joined.empty() ? "" : " ") + line;
  }
  EXPECT_EQ(joined, text);
  EXPECT_EQ(wrapped("abcdefghijklmnopqrstuvwxyz", 10 * sheet.character_px(), sheet).front(),
            "abcdefg...");
}

TEST(Sheet, ChoosesPanelsByNumber) {
  const std::vector<std::string> names = {"a", "b", "c"};
  EXPECT_THAT(page(85, 8, {3, 1}).chosen(names), ElementsAre(2, 0));
  EXPECT_THAT(Sheet().chosen(names), ElementsAre(0, 1, 2));
  EXPECT_THAT([&] { page(85, 8, {4}).chosen(names); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("panel 4: expected one of 1 (a), 2 (b), 3 (c)")));
}

double number(const std::string& text, const std::string& pattern) {
  std::smatch match;
  if (!std::regex_search(text, match, std::regex(pattern))) {
    ADD_FAILURE() << pattern << " is missing";
    return 0;
  }
  return std::stod(match[1]);
}

TEST_F(PlotTest, ThePageHasItsSizeInEveryFormat) {
  const auto file = [&](const char* extension) { return folder_ / ("c" + std::string(extension)); };
  write_comparison(comparison_at({30, 60}), {file(".svg"), file(".pdf"), file(".png")},
                   page(85, 8));
  const std::string svg = bytes_of(file(".svg"));
  EXPECT_EQ(number(svg, "width=\"([0-9.]+)mm\""), 85);
  constexpr double kWholePixels = 0.01;  // of the canvas
  const double points_per_pixel = 85 / 25.4 * 72 / number(svg, "viewBox=\"0 0 ([0-9]+) ");
  EXPECT_NEAR(number(svg, "font-size=\"(12[0-9.]*)\"") * points_per_pixel, 8, 8 * kWholePixels);
  EXPECT_NEAR(number(bytes_of(file(".pdf")), "MediaBox \\[ 0 0 ([0-9.]+)"), 85 / 25.4 * 72, 1);
  const std::string png = bytes_of(file(".png"));
  const int width = static_cast<unsigned char>(png[18]) * 256 + static_cast<unsigned char>(png[19]);
  EXPECT_NEAR(width, 85 / 25.4 * 300, 1);  // pixels per inch
}

// Letters of DejaVu Sans are on average wider than this; so text that is on the page here may touch
// its edge, but text that is not is cut.
constexpr double kNarrowLetters = 0.5;  // of the size

// What of the figure's text leaves the canvas.
std::vector<std::string> text_off_the_page(const std::string& svg) {
  const double width = number(svg, "viewBox=\"0 0 ([0-9]+) "),
               height = number(svg, "viewBox=\"0 0 [0-9]+ ([0-9]+)");
  static const std::regex kText(
      "translate\\(([-0-9.]+),([-0-9.]+)\\)( rotate\\(([-0-9.]+)\\))?\"[^>]*font-size=\"([0-9.]+)"
      "\"[^>]*text-anchor=\"([a-z]+)\">\\s*<text>(?:<tspan[^>]*>)?([^<]*)<");
  std::vector<std::string> off;
  int labels = 0;
  for (std::sregex_iterator match(svg.begin(), svg.end(), kText), end; match != end; ++match) {
    const std::smatch& m = *match;
    ++labels;
    const std::string text = m[7];
    const auto letters = std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; });
    const double length = kNarrowLetters * std::stod(m[5]) * static_cast<double>(letters);
    const double before = m[6] == "start" ? 0 : m[6] == "middle" ? length / 2 : length;
    const bool upright = m[4].matched && std::abs(std::stod(m[4])) > 45;
    const double x = std::stod(m[1]), y = std::stod(m[2]);
    const bool inside = upright ? y + before <= height && y + before - length >= 0 && x >= 0
                                : x - before >= 0 && x - before + length <= width && y <= height;
    if (!inside || y < 0 || x > width) off.push_back(text);
  }
  EXPECT_GT(labels, 5);
  return off;
}

class PageTest : public PlotTest {
 protected:
  void expect_on_page(const std::string& name, const Figure& figure) {
    write_figure(figure, {folder_ / "page.svg"});
    EXPECT_THAT(text_off_the_page(bytes_of(folder_ / "page.svg")), ::testing::IsEmpty()) << name;
  }
};
TEST_F(PageTest, HoldsTheTextOfMeasuredFigures) {
  const MeasuredOutcome fit = outcome(true);
  for (const MeasuredFigure& figure : measured_figures()) {
    if (!figure.can_draw(fit)) continue;
    expect_on_page(std::string(figure.name), draw(figure, {&fit, 1}, 1, page(180, 6)));
    expect_on_page(std::string(figure.name), draw(figure, {&fit, 1}, 1, page(85, 12)));
  }
  MeasuredOutcome irradiances = outcome(false);
  irradiances.irradiance_unit = "lx";
  irradiances.irradiances.swap(irradiances.samples);
  for (std::size_t i = 0; i < irradiances.irradiances.size(); ++i)
    irradiances.irradiances[i].irradiance = kIrradianceNames[i % kIrradianceNames.size()];
  expect_on_page("irradiances", irradiances_figure(irradiances, page(85, 12)));
}

TEST_F(PageTest, HoldsTheTextOfComparisons) {
  Comparison comparison = comparison_at({30, 80});
  expect_on_page("one curve", comparison_figure(comparison, page(85, 12)));
  for (const double residual : {0.1, 0.2, 0.7})
    comparison.curves.push_back(curve_at({30, 80}, residual));
  expect_on_page("four curves", comparison_figure(comparison, page(85, 12)));
}

TEST_F(PageTest, HoldsTheTextOfSkies) {
  const Sheet sheet = page(85, 12);
  PolarisedSky sky;
  sky.sun_zenith = 1.2;
  sky.wavelength_nm = 450;
  sky.q_u.assign(PolarisedSky::kZeniths * PolarisedSky::kAzimuths, {0.3, 0.1});
  sky.neutral_points.push_back({NeutralPointKind::kArago, 1.5, 3.14159, 0.35});
  expect_on_page("polarisation",
                 polarisation_figure("Polarisation of a sky", sky, PolarisationAngle::kIau, sheet));
  FisheyeSky white;
  white.rgb.assign(FisheyeSky::kZeniths * FisheyeSky::kAzimuths, {1, 1, 1});
  expect_on_page("fisheye", fisheye_figure({"Skies of the models, cie:12",
                                            {0, 20, 40, 60, 80},
                                            {{"hoffman-preetham", {white, {}, {}, {}, {}}}}},
                                           sheet));
}

TEST_F(PlotTest, ChosenPanelsAloneAreDrawn) {
  const MeasuredOutcome fit = outcome(true);
  const std::string body = spectra_figure(fit, 1, page(85, 8, {2})).body;
  EXPECT_THAT(body, HasSubstr("\"90° from the sun\""));
  EXPECT_THAT(body, Not(HasSubstr("low, across")));
  const Figure suns = comparison_figure(comparison_at({20, 40, 60}), page(180, 8, {3, 1}));
  EXPECT_THAT(suns.body, HasSubstr("2 of 3 sun positions shown"));
  EXPECT_LT(suns.body.find("60°"), suns.body.find("20°")) << "in the order that was asked for";
}

// Its directions are 80 deg from the zenith.
TEST_F(PlotTest, NamesOfDirectionsHold) {
  const std::string body = spectra_figure(outcome(true), 1).body;
  EXPECT_THAT(body, HasSubstr("\"nearest to the sun\""));
  EXPECT_THAT(body, Not(HasSubstr("\"zenith\"")));
}

// Luminances that are 3 times too bright have a factor; the axis is logarithmic.
TEST_F(PlotTest, LargeMisfitsAreFactors) {
  MeasuredOutcome fit = outcome(false);
  for (Sample& sample : fit.samples) sample.model = 3 * sample.reference;
  const std::string residuals = residuals_figure(fit).body;
  EXPECT_THAT(residuals, HasSubstr("set logscale y"));
  EXPECT_THAT(residuals, Not(HasSubstr("%\"")));
  EXPECT_THAT(maps_figure(fit).body, HasSubstr("×"));
  Comparison comparison = comparison_at({30});
  comparison.curves = {curve_at({30}, 0.6)};
  const std::string panels = comparison_figure(comparison).body;
  EXPECT_THAT(panels, HasSubstr("×1.8"));  // exp(0.6) = 1.82
  EXPECT_THAT(panels, Not(HasSubstr("60.0")));
}

}  // namespace
}  // namespace skyfit::plot
