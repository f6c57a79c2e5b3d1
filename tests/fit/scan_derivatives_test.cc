// SPDX-License-Identifier: Apache-2.0
// Derivatives of the rows by every unknown agree with central differences of the rows themselves.
#include <gtest/gtest.h>

#include "tests/fit/scans.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

// The pointing's own differences reach over 0.25 deg: relative error of the third derivative.
constexpr double kPointingDifference = 1e-3;
constexpr double kExact = 1e-6;

Unknown unknown_of(std::variant<Parameter, Instrument> what, int scan, double lower, double upper) {
  return {{lower, upper, false, std::nullopt}, what, scan};
}

class ScanDerivativesTest : public testing::TestWithParam<Unknown> {};

TEST_P(ScanDerivativesTest, AgreeWithDifferences) {
  const ToySky model;
  const Unknown unknown = GetParam();
  const Dataset data =
      dataset(synthetic_scans(model, true_atmosphere(2), {}), refs::standard_spectral_data(), {});
  SkyState state = start_state(true_atmosphere(2), 2);
  for (auto& instrument : state.instrument)
    instrument[static_cast<std::size_t>(Instrument::kAzimuthOffset)] = 0.1;
  const SampleValues values = sky_values(model, data, state, {unknown});
  const double at = get_unknown(state, unknown), step = 1e-4 * (unknown.upper - unknown.lower);
  const auto moved = [&](double by) {
    const Eigen::VectorXd scaled = Eigen::VectorXd::Constant(1, unknown.scaled(at + by));
    return sky_values(model, data, with_unknowns(state, {unknown}, scaled), {}).value;
  };
  const Eigen::VectorXd expected = (moved(step) - moved(-step)) / (2 * step);
  const bool exact = std::holds_alternative<Parameter>(unknown.what) ||
                     std::get<Instrument>(unknown.what) == Instrument::kScale;
  EXPECT_LT((values.derivative.col(0) - expected).norm(),
            (exact ? kExact : kPointingDifference) * expected.norm());
  EXPECT_GT(expected.norm(), 0);
}

INSTANTIATE_TEST_SUITE_P(Unknowns, ScanDerivativesTest,
                         testing::Values(unknown_of(Parameter::kMiePhaseG2, kAllScans, 0, 0.6),
                                         unknown_of(Parameter::kMieScattering, 1, 1e-5, 3e-4),
                                         unknown_of(Instrument::kAzimuthOffset, 1, -1, 1),
                                         unknown_of(Instrument::kAzimuthOffset, kAllScans, -1, 1),
                                         unknown_of(Instrument::kTiltNorth, 0, -0.1, 0.1),
                                         unknown_of(Instrument::kTiltEast, kAllScans, -0.1, 0.1),
                                         unknown_of(Instrument::kScale, 0, 0.5, 2)));

// A tilt of the axis toward a direction raises what is stated as the zenith there.
TEST(PointedTest, AxisLeansTowardNorthAndEast) {
  const double sun_azimuth = 1.2;  // the sun's azimuth from north
  const SkyPoint north = pointed({0, 0.5, 0, 0}, sun_azimuth, {0, 0.1, 0, 1});
  EXPECT_NEAR(north.view_zenith, 0.1, 1e-12);
  EXPECT_NEAR(north.relative_azimuth, -1.2, 1e-12);
  const SkyPoint east = pointed({0, 0.5, 0, 0}, sun_azimuth, {0, 0, 0.1, 1});
  EXPECT_NEAR(east.view_zenith, 0.1, 1e-12);
  EXPECT_NEAR(
      std::remainder(east.relative_azimuth - (std::numbers::pi / 2 - 1.2), 2 * std::numbers::pi), 0,
      1e-12);
  const SkyPoint turned = pointed({0, 0.5, 0.7, 0.2}, sun_azimuth, {0.3, 0, 0, 1});
  EXPECT_EQ(turned.view_zenith, 0.7);
  EXPECT_NEAR(turned.relative_azimuth, 0.5, 1e-12);
}

}  // namespace
}  // namespace skyfit::fit
