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
  EXPECT_EQ(log_misfit(-110, 2), "×0.33");          // exp(-1.1) = 0.333
  EXPECT_EQ(log_misfit_with_unit(250, 1), "×12.2");
}

TEST(Misfit, WhatIsNotFiniteStays) {
  EXPECT_FALSE(is_factor(std::numeric_limits<double>::infinity()));
  EXPECT_EQ(log_misfit(std::numeric_limits<double>::quiet_NaN(), 1), "nan");
}

}  // namespace
}  // namespace skyfit
