// SPDX-License-Identifier: Apache-2.0
// The Monte Carlo yardstick makes its table again, within its own errors: every 40th row.
#include "tests/model/monte_carlo.h"

#include <gtest/gtest.h>

#include <cmath>

#include "data_refs/spectra.h"
#include "tests/model/truth.h"

namespace skyfit::truth {
namespace {

TEST(MonteCarlo, MakesItsTableAgain) {
  constexpr long kHistories = 30000;
  constexpr double kSigmas = 4.5;  // of both errors together: one in 10^5 by chance
  const std::vector<Row> rows = read_rows("monte_carlo.csv");
  double squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < rows.size(); i += 40, ++count) {
    const MonteCarloCase c = monte_carlo_case(rows[i].field[0]);
    const WavelengthNode node =
        spectral_nodes(refs::standard_spectral_data(), {c.wavelength_nm}).front();
    const MonteCarloResult again =
        MonteCarlo(c.atmosphere, node).radiance(point_of(rows[i]), kHistories, i + 1);
    const double sigma = std::hypot(again.stderr_multiple, rows[i].number(7));
    const double off = (again.multiple - rows[i].number(6)) / sigma;
    EXPECT_LT(std::abs(off), kSigmas) << rows[i].field[0] << " row " << i;
    // Histories are stratified over the view ray, so that single scattering is nearly a quadrature.
    EXPECT_NEAR(again.single, rows[i].number(5), 0.005 * (again.single + again.multiple));
    squares += off * off;
  }
  ASSERT_GT(count, 20);
  EXPECT_LT(squares / count, 2.2);  // chi squared per row; 1 +- 0.27
}

}  // namespace
}  // namespace skyfit::truth
