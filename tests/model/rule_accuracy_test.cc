// SPDX-License-Identifier: Apache-2.0
// The rules of model/photometry/photometry.h keep to the 5 nm sum where they are worst: through
// much ozone with the sun at the horizon and below, and by day in haze.
// rule_accuracy_everywhere_test.cc asks it of the whole domain.
#include "tests/model/rule_accuracy.h"

#include "tests/atmospheres.h"

namespace skyfit {
namespace {

TEST(SlowRuleAccuracy, ThroughMuchOzoneInTwilight) {
  Atmosphere<double> a;
  a.at("ozone").amount = 500;
  expect_rules_hold({{a, {10e3}, {88, 92}, {0, 80, 88, 90}}});
}

TEST(RuleAccuracy, ByDayInHaze) {
  Atmosphere<double> a;
  set_scattering(a.at("mie"), 550, 3e-4, 1.6);
  expect_rules_hold({{a, {0}, {0, 60, 85}, {0, 70, 90}}});
}

}  // namespace
}  // namespace skyfit
