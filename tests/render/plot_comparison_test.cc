// SPDX-License-Identifier: Apache-2.0
// The comparison figure is written whole in every format or not at all, and its panels state the
// RMS of their samples.
#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "model/registry.h"
#include "plot_samples.h"
#include "render/plot/comparison.h"
#include "render/plot/figure_style.h"
#include "render/plot/gnuplot.h"
#include "render/plot/hemisphere_maps.h"

namespace skyfit::plot {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using ::testing::StrEq;
using ::testing::ThrowsMessage;
using ::testing::UnorderedElementsAre;

const std::vector<double> kNineSuns = {0, 10, 20, 30, 40, 50, 60, 70, 80};

// Runs the figure with a gnuplot of the test's choice.
class OtherGnuplot {
 public:
  explicit OtherGnuplot(const std::string& program) {
    setenv("SKYFIT_GNUPLOT", program.c_str(), 1);
  }
  ~OtherGnuplot() { unsetenv("SKYFIT_GNUPLOT"); }
};

unsigned big_endian(const std::string& bytes, std::size_t at) {
  unsigned value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

TEST_F(PlotTest, EveryFormatIsWritten) {
  write_comparison(comparison_at(kNineSuns),
                   {folder_ / "c.svg", folder_ / "c.png", folder_ / "c.pdf"});
  EXPECT_THAT(names(), UnorderedElementsAre("c.svg", "c.png", "c.pdf"));
  const std::string png = bytes_of(folder_ / "c.png"), svg = bytes_of(folder_ / "c.svg");
  ASSERT_THAT(png, StartsWith("\x89PNG\r\n\x1a\n"));
  EXPECT_EQ(png.substr(12, 4), "IHDR");
  EXPECT_EQ(big_endian(png, 16), 1600u);
  EXPECT_GT(big_endian(png, 20), 900u);
  EXPECT_GT(png.size(), 100000u);
  EXPECT_THAT(svg, StartsWith("<?xml"));
  EXPECT_THAT(svg, ::testing::EndsWith("</svg>\n\n"));
  EXPECT_THAT(bytes_of(folder_ / "c.pdf"), StartsWith("%PDF-"));
}

TEST_F(PlotTest, TextOfTheFigureIsComplete) {
  write_comparison(comparison_at(kNineSuns), {folder_ / "c.svg"});
  const std::string svg = bytes_of(folder_ / "c.svg");
  EXPECT_THAT(svg, HasSubstr("with 'quotes', {braces}, $dollars and a \\ backslash"));
  for (const char* text : {"sun zenith 0°", "sun zenith 80°", "view zenith", "zenith luminance",
                           "fitted", "reference", "ln(model / reference)", "4.0"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(svg, ::testing::Not(HasSubstr("start values"))) << "there are none";
}

// Where a text of an SVG file begins, or for a centred one its centre, px.
double place_of(const std::string& svg, const std::string& text) {
  const std::size_t at = svg.find(text);
  EXPECT_NE(at, svg.npos) << text;
  const std::size_t moved = svg.rfind("translate(", at);
  EXPECT_NE(moved, svg.npos) << text;
  return std::stod(svg.substr(moved + std::string_view("translate(").size()));
}

TEST_F(PlotTest, LegendOfSeveralFitsStaysBesideTheMaps) {
  Comparison comparison = comparison_at({20, 50});
  comparison.curves.front().label = "cie:12, two lobes";
  comparison.curves.front().plane.front().weight = 0;
  comparison.curves.push_back(curve_at({30, 80}, 0.1));
  comparison.curves.back().label = "cie:3, two lobes";
  write_comparison(comparison, {folder_ / "c.svg"});
  const std::string svg = bytes_of(folder_ / "c.svg");
  constexpr double kPanels = 910, kMark = 36, kText = 250;  // px; what a text takes at most
  for (const char* text :
       {"reference of cie:12, two lobes", "reference of cie:3, two lobes", "left out of the fit"}) {
    EXPECT_GT(place_of(svg, text), kMark) << text;
    EXPECT_LT(place_of(svg, text), kPanels - kText) << text;
  }
}

TEST_F(PlotTest, AnyNumberOfSunsAndCurvesIsDrawn) {
  for (const std::vector<double>& suns : {std::vector<double>{40}, {20, 60}, {0, 15, 30, 45, 60}}) {
    Comparison comparison = comparison_at(suns);
    comparison.curves.push_back(curve_at(suns, 0.1));
    write_comparison(comparison, {folder_ / "c.png"});
    EXPECT_GT(std::filesystem::file_size(folder_ / "c.png"), 20000u);
  }
}

TEST_F(PlotTest, ManySunsAreThinnedAndItIsSaid) {
  std::vector<double> suns;
  for (int i = 0; i < 40; ++i) suns.push_back(2.0 * i);
  const Comparison comparison = comparison_at(suns);
  EXPECT_EQ(sun_panels(comparison).size(), kMaxPanels);
  EXPECT_EQ(sun_panels(comparison).back().sun_zenith_deg, 78);
  write_comparison(comparison, {folder_ / "c.svg"});
  EXPECT_THAT(bytes_of(folder_ / "c.svg"), HasSubstr("16 of 40 sun positions shown"));
}

// By hand: plane sqrt((2^2 + 4^2) / 2) % = sqrt(10) %, sky sqrt((2^2 + 4^2 + 6^2) / 3) %; a sample
// off the plane is not in the panel, one without weight in neither.
TEST(SunPanels, StateTheRmsOfTheirSamples) {
  Comparison comparison;
  Curve curve{"c", {}, {}};
  curve.plane = {sample_at(30, 10, 0, 0.02), sample_at(30, 10, 180, -0.04),
                 sample_at(30, 10, 90, 0.06), sample_at(30, 30, 0, 5),
                 sample_at(50, 20, 360, 0.01)};
  curve.plane[3].weight = 0;
  curve.hemisphere = curve.plane;
  comparison.curves = {curve};
  const auto panels = sun_panels(comparison);
  ASSERT_EQ(panels.size(), 2u);
  EXPECT_NEAR(panels[0].rms_plane_percent[0], std::sqrt(10.0), 1e-12);
  EXPECT_NEAR(panels[0].rms_hemisphere_percent[0], std::sqrt(56.0 / 3), 1e-12);
  EXPECT_NEAR(panels[1].rms_plane_percent[0], 1.0, 1e-12);
}

// The patches of Tregenza's rows cover the hemisphere once: areas on the map add up to the disc's.
TEST(HemispherePatches, CoverTheHemisphereOnce) {
  const auto sky = curve_at({40}, 0.1).hemisphere;
  const auto patches = patches_of(sky);
  ASSERT_EQ(patches.size(), 145u);
  double area = 0;
  for (const Patch& patch : patches) {
    area += patch.width_deg / 360 *
            (std::pow(patch.outer_zenith_deg, 2) - std::pow(patch.inner_zenith_deg, 2));
    EXPECT_LE(patch.inner_zenith_deg, patch.sample->view_zenith_deg);
    EXPECT_GE(patch.outer_zenith_deg, patch.sample->view_zenith_deg);
  }
  EXPECT_NEAR(area, 90.0 * 90.0, 1e-9);
}

TEST(HemispherePatches, ScatteredSamplesHaveNone) {
  EXPECT_THAT(
      patches_of({sample_at(0, 10, 3, 0), sample_at(0, 50, 77, 0), sample_at(0, 61, 200, 0)}),
      IsEmpty());
}

TEST(Style, DivergingColorIsNeutralAtZeroAndClamped) {
  EXPECT_EQ(diverging_color(0, 5), "#f7f7f7");
  EXPECT_EQ(diverging_color(5, 5), "#b2182b");
  EXPECT_EQ(diverging_color(-99, 5), "#2166ac");
}

TEST(Style, LogTicksLieInsideAndEndsAreBare) {
  for (const Tick& tick : log_ticks(0.1, 100)) {
    EXPECT_GE(tick.position, 0.1 * (1 - 1e-12));
    EXPECT_LE(tick.position, 100 * (1 + 1e-12));
    if (tick.position < 0.11 || tick.position > 90) {
      EXPECT_EQ(tick.label, "");
    }
  }
}

// `skyfit compare` draws them all by default.
TEST(PlotComparison, EveryModelFindsAColour) {
  EXPECT_LE(sky_models().size(), kMaxCurves);
  EXPECT_EQ(kCurveColors.size(), kMaxCurves);
}

TEST_F(PlotTest, BadFiguresAreRefusedAndLeaveNothing) {
  Comparison negative = comparison_at({30});
  negative.curves[0].plane[0].model = -1;
  EXPECT_THAT([&] { write_comparison(negative, {folder_ / "c.svg"}); },
              ThrowsMessage<std::invalid_argument>(
                  StrEq("figure: model = -1 in \"fitted\" at sun zenith 30, view zenith "
                        "85, azimuth 180 deg: expected a number > 0")));
  EXPECT_THAT([&] { write_comparison(Comparison(), {folder_ / "c.svg"}); },
              ThrowsMessage<std::invalid_argument>(StrEq("figure: 0 curves: expected 1 to 11")));
  EXPECT_THAT(
      [&] {
        write_comparison(comparison_at({30}), {folder_ / "c.svg", folder_ / "c.gif"});
      },
      ThrowsMessage<std::invalid_argument>(
          HasSubstr("extension \".gif\": expected .svg, .png or .pdf")));
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(PlotTest, AllFilesAppearOrNone) {
  EXPECT_THAT(
      [&] {
        write_comparison(comparison_at({30}), {folder_ / "c.svg", folder_ / "none/c.png"});
      },
      ThrowsMessage<std::runtime_error>(
          HasSubstr("none/c.png: cannot be written: No such file or directory")));
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(PlotTest, MissingGnuplotIsOneClearLine) {
  const OtherGnuplot other((folder_ / "no-gnuplot").string());
  EXPECT_THAT([&] { write_comparison(comparison_at({30}), {folder_ / "c.svg"}); },
              ThrowsMessage<std::runtime_error>(
                  HasSubstr("no-gnuplot: no such program; figures need gnuplot 5.4 (package "
                            "gnuplot-nox)")));
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(PlotTest, AFailingOrIdleGnuplotLeavesTheOldFigure) {
  std::ofstream(folder_ / "c.svg") << "the old one";
  for (const char* program : {"false", "true"}) {
    const OtherGnuplot other(program);
    EXPECT_THROW(write_comparison(comparison_at({30}), {folder_ / "c.svg"}), std::runtime_error);
    EXPECT_EQ(bytes_of(folder_ / "c.svg"), "the old one");
    EXPECT_THAT(names(), UnorderedElementsAre("c.svg"));
  }
}

TEST_F(PlotTest, HalfAPictureIsNoFigure) {
  std::ofstream(folder_ / "gnuplot.sh") << "#!/bin/sh\n"
                                           "printf '<svg>half' > 0.svg\n"
                                           "exit 0\n";
  std::filesystem::permissions(folder_ / "gnuplot.sh", std::filesystem::perms::owner_all);
  const OtherGnuplot other((folder_ / "gnuplot.sh").string());
  EXPECT_THAT([&] { write_comparison(comparison_at({30}), {folder_ / "c.svg"}); },
              ThrowsMessage<std::runtime_error>(
                  HasSubstr("c.svg: cannot be written: gnuplot left half a picture")));
  EXPECT_THAT(names(), UnorderedElementsAre("gnuplot.sh"));
}

// Text that would be a command, an escape or an end of something if it were syntax anywhere.
const std::vector<std::string> kHostile = {
    "|touch pwned;#",
    "`touch pwned`",
    "$(touch pwned)",
    "'; !touch pwned\n#",
    "\n!touch pwned\n",
    "\nEOD\nsystem('touch pwned')\n",
    "'.system('touch pwned').'",
    "\"; system 'touch pwned'; \"",
    "a\\",
    "'\\'",
    "a''; !touch pwned; ''",
    "@ARG0 {/Symbol x}_{^&~} %s %d",
    "]]></svg><script>&amp;",
    "~root",
    "\xff\xfe\x1b[2J\x00x",
};

TEST_F(PlotTest, NoTextOfAUserIsSyntax) {
  for (std::string text : kHostile) {
    // gnuplot runs in a folder that goes: a command would leave its trace in this one.
    if (const std::size_t word = text.find("pwned"); word != text.npos)
      text.insert(word, folder_.string() + "/");
    Comparison comparison = comparison_at({30});
    comparison.title = comparison.subtitle = comparison.reference_label = text;
    for (Curve& curve : comparison.curves) curve.label = text;
    const std::filesystem::path svg = folder_ / "c.svg";
    write_comparison(comparison, {svg});
    const std::string picture = bytes_of(svg);
    EXPECT_EQ(picture.find("<script>"), picture.npos) << text;
    EXPECT_EQ(picture.find('\x1b'), picture.npos) << text;
    EXPECT_THAT(names(), UnorderedElementsAre("c.svg")) << text;
  }
  // Quotes, braces and the like are drawn as they are.
  Comparison comparison = comparison_at({30});
  comparison.title = "it's {a}_b^c @d `e` \\n %f";
  write_comparison(comparison, {folder_ / "c.svg"});
  EXPECT_THAT(bytes_of(folder_ / "c.svg"), HasSubstr("it's {a}_b^c @d `e` \\n %f"));
}

TEST_F(PlotTest, NoNameOfAFileIsSyntax) {
  for (std::string text : kHostile) {
    std::ranges::replace(text, '/', ':');
    std::ranges::replace(text, '\0', ':');
    const std::filesystem::path inner = folder_ / ("d" + text), bare = folder_ / text;
    for (const auto& directory : {inner, bare}) {
      std::filesystem::create_directory(directory);
      for (const char* extension : {".svg", ".png", ".pdf"}) {
        const std::filesystem::path file = directory / (text + extension);
        write_comparison(comparison_at({30}), {file});
        EXPECT_GT(std::filesystem::file_size(file), 1000u) << file;
      }
      std::filesystem::remove_all(directory);
    }
    EXPECT_THAT(names(), IsEmpty()) << text;
  }
}

TEST(Gnuplot, ItsOwnWordsReachTheUser) {
  EXPECT_THAT([] { run_gnuplot("set terminal nonsense\n", "."); },
              ThrowsMessage<std::runtime_error>(HasSubstr("exit status 1: ")));
}

TEST(Gnuplot, TextIsOneLineOfPlainCharacters) {
  EXPECT_EQ(gnuplot_quoted("it's\na °C"), "\"it\\047s a °C\"");
}

}  // namespace
}  // namespace skyfit::plot
