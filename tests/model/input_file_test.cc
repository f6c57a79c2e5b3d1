// SPDX-License-Identifier: Apache-2.0
// Only regular files up to a size are read, and a data file names files of its own folder only.
#include "model/base/input_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

#include "model/base/temporary_directory.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class InputFile : public ::testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  static void expect_refusal(const fs::path& file, const std::string& reason) {
    EXPECT_THAT([&] { read_file(file, "a test"); },
                ThrowsMessage<std::runtime_error>(file.string() + ": cannot be read (" + reason +
                                                  "), expected a test"));
  }

  const TemporaryDirectory temporary_;
  const fs::path folder_ = temporary_.path();
};

TEST_F(InputFile, IsReadByteByByte) {
  const std::string bytes("a\0\r\n\xff", 5);
  EXPECT_EQ(read_file(write("x", bytes), "a test"), bytes);
  EXPECT_EQ(read_file(write("empty", ""), "a test"), "");
}

TEST_F(InputFile, ThatIsNoFileIsRefused) {
  expect_refusal(folder_ / "missing", "No such file or directory");
  expect_refusal(folder_, "Is a directory");
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  expect_refusal(folder_ / "pipe", "it is a pipe or a device");
  expect_refusal("/dev/zero", "it is a pipe or a device");
}

// A file of /proc says that it is empty and may hold more.
TEST_F(InputFile, ThatIsTooLargeIsRefused) {
  const fs::path large = write("large", "");
  fs::resize_file(large, kMostTextBytes + 1);
  expect_refusal(large, "it is larger than 256 MiB");
  EXPECT_THAT([] { read_file("/proc/self/maps", "a test", 100); },
              ThrowsMessage<std::runtime_error>(HasSubstr("it is larger than 0 MiB")));
}

TEST_F(InputFile, NamedByADataFileStaysInItsFolder) {
  fs::create_directories(folder_ / "data/inner");
  write("outside", "x");
  fs::create_symlink("../outside", folder_ / "data/link");
  fs::create_directory_symlink("..", folder_ / "data/up");
  fs::create_symlink("inner", folder_ / "data/sideways");
  fs::create_symlink("loop", folder_ / "data/loop");
  const fs::path data = folder_ / "data";
  for (const char* name : {"a.csv", "inner/a.csv", "sideways/a.csv", "./a.csv", "..a", "| x"})
    EXPECT_EQ(named_file(data, name, NamedFiles::kInItsFolder), data / name) << name;
  for (const char* name : {"/etc/passwd", "../outside", "inner/../../outside", "inner/..", "link",
                           "up/outside", "loop"})
    EXPECT_EQ(named_file(data, name, NamedFiles::kInItsFolder), std::nullopt) << name;
  EXPECT_EQ(named_file(data, "../outside", NamedFiles::kAnywhere), data / "../outside");
  // The system would open the folder, or a file whose name ends sooner.
  for (const std::string_view name : {std::string_view(), std::string_view("a.csv\0x", 7)}) {
    for (const NamedFiles allowed : {NamedFiles::kInItsFolder, NamedFiles::kAnywhere})
      EXPECT_EQ(named_file(data, name, allowed), std::nullopt);
  }
  EXPECT_EQ(named_file("", "a.csv", NamedFiles::kInItsFolder), "a.csv");
}

}  // namespace
}  // namespace skyfit
