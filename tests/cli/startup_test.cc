// SPDX-License-Identifier: Apache-2.0
// A command pays for what it uses: neither the start of the program nor a fit nor a measured sky
// that is no image loads the image and OpenGL libraries, whose mapping alone takes longer than a
// start may.
#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <iterator>

#include "tests/cli/program.h"

namespace skyfit::cli {
namespace {

using ::testing::HasSubstr;

constexpr std::array kHeavy = {"libOpenImageIO", "libOpenEXR", "libOSMesa", "libLLVM",
                               "libGL",          "libEGL",     "libgallium"};

void expect_nothing_heavy(const std::string& loader_log) {
  EXPECT_THAT(loader_log, HasSubstr("libstdc++.so"));  // or the log is not one
  for (const char* library : kHeavy)
    EXPECT_EQ(loader_log.find(library), std::string::npos) << library;
}

class StartupTest : public ProgramTest {
 protected:
  // Every library that the program loads while it runs, at its start or later, as the loader lists
  // them.
  std::string loaded_libraries(const std::vector<std::string>& arguments) const {
    const std::string prefix = (capture_ / "loader").string();
    const Outcome outcome = run(arguments, {"LD_DEBUG=files", "LD_DEBUG_OUTPUT=" + prefix});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    // gnuplot, when a command draws, has a log of its own; the program's names the program.
    std::string text;
    for (const auto& entry : std::filesystem::directory_iterator(capture_)) {
      if (!entry.path().filename().string().starts_with("loader.")) continue;
      std::ifstream in(entry.path());
      const std::string log((std::istreambuf_iterator<char>(in)), {});
      if (log.find(SKYFIT_PROGRAM) != std::string::npos) text += log;
    }
    return text;
  }
};

TEST_F(StartupTest, HelpLoadsNothingHeavy) { expect_nothing_heavy(loaded_libraries({"--help"})); }

TEST_F(StartupTest, AFitLoadsNothingHeavy) {
  expect_nothing_heavy(
      loaded_libraries({"fit", "--reference", "cie:12", "--sun-zenith-deg", "40", "--lobes", "1",
                        "--starts", "1", "--max-iterations", "2", "--out", "fitted"}));
}

TEST_F(StartupTest, AMeasuredSkyLoadsNothingHeavyUnlessItIsAnImage) {
  const std::string examples = SKYFIT_EXAMPLES;
  expect_nothing_heavy(loaded_libraries({"check", examples + "spectral_scan.csv"}));
  EXPECT_THAT(loaded_libraries({"check", examples + "fisheye.exr"}), HasSubstr("libOpenImageIO"));
}

// The figure is recorded, not asserted: it is the machine's.
TEST_F(StartupTest, TimeOfHelpIsRecorded) {
  double best_ms = 1e9;
  for (int i = 0; i < 10; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(run({"--help"}).status, 0);
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - begin;
    best_ms = std::min(best_ms, elapsed.count());
  }
  RecordProperty("help_milliseconds", std::to_string(best_ms));
}

}  // namespace
}  // namespace skyfit::cli
