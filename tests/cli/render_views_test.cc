// SPDX-License-Identifier: Apache-2.0
// Named views of `skyfit render` show what they say on a small planet, too.
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace skyfit::cli {
namespace {

using RenderViewsTest = ProgramTest;

// At the Earth's 400 km this picture would be black.
TEST_F(RenderViewsTest, TheLimbOfASmallPlanetIsInThePicture) {
  auto small = nlohmann::json::parse(run({"presets", "earth-clear"}).out);
  small["planet"]["bottom_radius_m"] = 300e3;
  small["planet"]["top_radius_m"] = 380e3;
  write("small.json", small.dump());
  const Outcome drawn =
      run({"render", "--preset", "small.json", "--model", "hillaire", "--table-size", "tiny",
           "--view", "limb", "--size", "31x18", "--samples-per-side", "1", "--out", "limb.npy"});
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  const std::string file = read("limb.npy");
  std::vector<float> light(std::size_t{31} * 18 * 3);
  ASSERT_GT(file.size(), light.size() * sizeof(float));
  std::memcpy(light.data(), file.data() + file.size() - light.size() * sizeof(float),
              light.size() * sizeof(float));
  const auto green = [&](int row) {
    return light[static_cast<std::size_t>(3 * (31 * row + 15) + 1)];
  };
  EXPECT_GT(green(17), 100) << "ground, cd/m^2";
  EXPECT_LT(green(0), 0.01F * green(17)) << "space";
}

}  // namespace
}  // namespace skyfit::cli
