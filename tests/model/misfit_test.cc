// SPDX-License-Identifier: Apache-2.0
// A misfit is percent up to 50 and above that the factor exp(percent / 100), without a unit.
#include "model/base/misfit.h"

#include <gtest/gtest.h>

#include <limits>

namespace skyfit {
namespace {

TEST(Misfit, IsPercentUpToFifty) {
  EXPECT_EQ(log_misfit(3.96, 1), "4.0");
  EXPECT_EQ(log_misfit_with_unit(3.96, 2), "3.96 %");
  EXPECT_EQ(log_misfit_with_unit(50, 1), "50.0 %");
  EXPECT_EQ(log_misfit_with_unit(-50, 1), "-50.0 %");
}

TEST(Misfit, IsAFactorAbove) {
  EXPECT_EQ(log_misfit_with_unit(60, 2), "×1.82");  // exp(0.6) = 1.822
  EXPECT_EQ(log_misfit(-110, 2), "×0.333");         // exp(-1.1) = 0.3329
  EXPECT_EQ(log_misfit_with_unit(250, 1), "×12");   // exp(2.5) = 12.18
}

TEST(Misfit, HasSignificantDigitsWhereTheyAreAsked) {
  EXPECT_EQ(log_misfit_digits(3.96412, 4), "3.964");
  EXPECT_EQ(log_misfit_digits_with_unit(27.734, 3), "27.7 %");
  EXPECT_EQ(log_misfit_digits_with_unit(60, 3), "×1.82");
  EXPECT_EQ(log_misfit_digits(std::numeric_limits<double>::quiet_NaN(), 3), "-");
}

TEST(Misfit, WhatIsNotFiniteStays) {
  EXPECT_FALSE(is_factor(std::numeric_limits<double>::infinity()));
  EXPECT_EQ(log_misfit(std::numeric_limits<double>::quiet_NaN(), 1), "nan");
}

}  // namespace
}  // namespace skyfit
