// SPDX-License-Identifier: Apache-2.0
// A temporary directory goes with its owner, however that ends.
#include "model/base/temporary_directory.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <set>

namespace skyfit {
namespace {

namespace fs = std::filesystem;

class TemporaryDirectoryTest : public ::testing::Test {
 protected:
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(top_.path()), fs::directory_iterator{}));
  }

  // Ends a child with a signal while it owns a directory with files; its wait status.
  int end_owner(int signal) const {
    int ready[2];
    if (::pipe(ready) != 0) return -1;
    const pid_t child = ::fork();
    if (child == 0) {
      clean_up_on_signals();
      const TemporaryDirectory owned(top_.path());
      fs::create_directories(owned.path() / "result/inner");
      std::ofstream(owned.path() / "result/inner/file") << "half";
      fs::create_directory_symlink("/", owned.path() / "link");
      if (::write(ready[1], "x", 1) == 1)
        for (;;) ::pause();
      ::_exit(1);
    }
    char byte = 0;
    EXPECT_EQ(::read(ready[0], &byte, 1), 1);
    EXPECT_EQ(entries(), 1u);
    ::kill(child, signal);
    int status = 0;
    ::waitpid(child, &status, 0);
    ::close(ready[0]);
    ::close(ready[1]);
    return status;
  }

  const TemporaryDirectory top_;
};

TEST_F(TemporaryDirectoryTest, GoesWithItsObject) {
  {
    const TemporaryDirectory one(top_.path()), two(top_.path());
    EXPECT_NE(one.path(), two.path());
    std::ofstream(one.path() / "file") << "text";
    EXPECT_EQ(entries(), 2u);
  }
  EXPECT_EQ(entries(), 0u);
}

TEST_F(TemporaryDirectoryTest, GoesWithASignal) {
  for (const auto& [signal, status] : {std::pair{SIGINT, 130}, {SIGTERM, 143}, {SIGHUP, 129}}) {
    const int ended = end_owner(signal);
    EXPECT_TRUE(WIFEXITED(ended));
    EXPECT_EQ(WEXITSTATUS(ended), status);
    EXPECT_EQ(entries(), 0u);
  }
}

TEST_F(TemporaryDirectoryTest, OfAKilledOwnerGoesWithTheNextOne) {
  EXPECT_TRUE(WIFSIGNALED(end_owner(SIGKILL)));
  EXPECT_EQ(entries(), 1u);
  const TemporaryDirectory next(top_.path());
  EXPECT_EQ(entries(), 1u);
  EXPECT_TRUE(fs::exists(next.path()));
}

TEST_F(TemporaryDirectoryTest, OfAnotherNameStays) {
  for (const char* name : {"results", ".skyfit-cache", ".skyfit-12-ab", ".skyfit--abcdef"})
    fs::create_directory(top_.path() / name);
  std::ofstream(top_.path() / ".skyfit-notes") << "a file of the user";
  const TemporaryDirectory one(top_.path());
  EXPECT_EQ(entries(), 6u);
}

}  // namespace
}  // namespace skyfit
