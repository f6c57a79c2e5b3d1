// SPDX-License-Identifier: Apache-2.0
// A child process gets its input, folder and arguments as they are; what it prints and how it ended
// come back.
#include "model/base/process.h"

#include <gmock/gmock.h>

#include "model/base/temporary_directory.h"

namespace skyfit {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const std::filesystem::path kShell = "/bin/sh";

TEST(Process, ArgumentsAndInputArriveAsTheyAre) {
  const Outcome outcome =
      run({kShell, {"-c", "cat; printf '%s' \"$1\"", "sh", "| $(x) 'y'"}, "input\n", {}});
  EXPECT_TRUE(outcome.succeeded());
  EXPECT_EQ(outcome.output, "input\n| $(x) 'y'");
}

TEST(Process, RunsInItsFolder) {
  const TemporaryDirectory folder;
  EXPECT_EQ(run({kShell, {"-c", "pwd"}, "", folder.path()}).output, folder.path().string() + "\n");
}

TEST(Process, SaysHowItEnded) {
  EXPECT_EQ(run({kShell, {"-c", "exit 7"}, "", {}}).ending(), "exit status 7");
  const Outcome killed = run({kShell, {"-c", "kill -9 $$"}, "", {}});
  EXPECT_FALSE(killed.succeeded());
  EXPECT_EQ(killed.ending(), "ended by signal 9");
}

// More than a pipe or the memory for it holds; the end is what says why.
TEST(Process, KeepsTheEndOfALongOutput) {
  const Outcome outcome =
      run({kShell, {"-c", "head -c 1000000 /dev/zero | tr '\\0' x; echo end"}, "", {}});
  EXPECT_EQ(outcome.output.size(), std::size_t{1} << 16);
  EXPECT_TRUE(outcome.output.ends_with("xend\n"));
}

TEST(Process, InputThatIsNotReadDoesNotStopUs) {
  EXPECT_TRUE(run({kShell, {"-c", "exit 0"}, std::string(1'000'000, 'x'), {}}).succeeded());
}

TEST(Process, ProgramsThatCannotRunAreNamed) {
  EXPECT_THAT(
      [] {
        run({"/no/such", {}, "", {}});
      },
      ThrowsMessage<std::runtime_error>("/no/such: cannot run: No such file or directory"));
}

TEST(Process, ProgramsAreFoundInThePath) {
  EXPECT_TRUE(program_in_path("sh")->is_absolute());
  EXPECT_EQ(program_in_path("/bin/sh"), "/bin/sh");
  EXPECT_EQ(program_in_path("skyfit-no-such-program"), std::nullopt);
  EXPECT_EQ(program_in_path("/tmp"), std::nullopt);
}

}  // namespace
}  // namespace skyfit
