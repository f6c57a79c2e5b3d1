// SPDX-License-Identifier: Apache-2.0
// The figures of measured skies: every figure is drawn by gnuplot, and what cannot be drawn is
// refused with one line.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "model/irradiance.h"
#include "plot_samples.h"
#include "render/plot/measured_figures.h"

namespace skyfit::plot {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST_F(PlotTest, EveryMeasuredFigureIsDrawn) {
  const MeasuredOutcome fit = outcome(true);
  for (const MeasuredFigure& figure : measured_figures()) {
    if (figure.name == "irradiances") continue;  // below
    EXPECT_TRUE(figure.can_draw(fit)) << figure.name;
    const auto file = folder_ / (std::string(figure.name) + ".png");
    write_figure(draw(figure, {&fit, 1}), {file});
    EXPECT_GT(std::filesystem::file_size(file), 5000u) << figure.name;
  }
}

TEST_F(PlotTest, IrradiancesHaveAFigureOfTheirOwnAndNoMaps) {
  MeasuredOutcome fit = outcome(false);
  EXPECT_FALSE(measured_figure("irradiances").can_draw(fit));
  EXPECT_THROW(irradiances_figure(fit), std::invalid_argument);
  fit.irradiance_unit = "lx";
  fit.irradiances.swap(fit.samples);
  for (std::size_t i = 0; i < fit.irradiances.size(); ++i)
    fit.irradiances[i].irradiance = kIrradianceNames[i % kIrradianceNames.size()];
  const auto file = folder_ / "irradiances.png";
  write_figure(draw(measured_figure("irradiances"), {&fit, 1}), {file});
  EXPECT_GT(std::filesystem::file_size(file), 5000u);
  EXPECT_FALSE(measured_figure("maps").can_draw(fit));
  EXPECT_THAT(
      [&] {
        draw(measured_figure("residuals"), {&fit, 1});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("irradiances have no directions")));
}

TEST_F(PlotTest, LuminancesHaveNoSpectra) {
  const MeasuredOutcome fit = outcome(false);
  EXPECT_FALSE(measured_figure("spectra").can_draw(fit));
  EXPECT_THROW(spectra_figure(fit, 1), std::invalid_argument);
  write_figure(residuals_figure(fit), {folder_ / "residuals.svg"});
  EXPECT_EQ(directions_of(fit).front().measured, fit.samples[0].reference);
}

TEST_F(PlotTest, WhatCannotBeDrawnIsRefused) {
  const MeasuredOutcome fit = outcome(true);
  EXPECT_THAT([&] { spectra_figure(fit, 3); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("scan 3: expected 1 to 2")));
  EXPECT_THAT([] { measured_figure("pie"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("expected one of maps, spectra")));
  const std::vector<MeasuredOutcome> two = {fit, fit};
  EXPECT_THROW(draw(measured_figure("maps"), two), std::invalid_argument);
  MeasuredOutcome timeless = fit;
  for (MeasuredScan& scan : timeless.scans) scan.time_utc.clear();
  EXPECT_FALSE(measured_figure("series").can_draw(timeless));
  EXPECT_THAT(
      [&] {
        series_figure({&timeless, 1});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("its time is not known")));
}

// As of a scan of the sky and one of irradiances, which has no pointing.
TEST_F(PlotTest, AnUnknownOfOneScanAloneIsNoSeries) {
  MeasuredOutcome fit = outcome(true);
  ASSERT_EQ(fit.scans.size(), 2u);
  ASSERT_TRUE(measured_figure("series").can_draw(fit));
  std::erase_if(fit.unknowns, [](const MeasuredUnknown& unknown) { return unknown.scan == 2; });
  ASSERT_TRUE(std::ranges::any_of(fit.unknowns, [](const auto& u) { return u.scan == 1; }));
  EXPECT_FALSE(measured_figure("series").can_draw(fit));
  EXPECT_THAT(
      [&] {
        series_figure({&fit, 1});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("no unknown of two scans")));
}

}  // namespace
}  // namespace skyfit::plot
