// SPDX-License-Identifier: Apache-2.0
// Files and result directories appear whole or not at all, replace an earlier result only, and
// never a stranger's file. A disk that is full, played by a limit of the size of a file, leaves
// what was there.
#include "model/base/whole_file.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <fstream>
#include <sstream>

#include "model/base/temporary_directory.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

class WholeFileTest : public ::testing::Test {
 protected:
  std::vector<std::string> entries(const fs::path& directory) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory))
      names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }
  static std::string read(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  std::string refusal(const fs::path& directory, bool force) const {
    try {
      const WholeDirectory result(directory, kNames, force);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "was accepted";
  }
  static void publish(const fs::path& directory, const std::string& text, bool force = false) {
    WholeDirectory(directory, kNames, force).publish([&](const fs::path& staging) {
      write_file(staging / "a.txt", text);
      write_file(staging / "b.txt", text);
    });
  }

  inline static const std::vector<std::string> kNames = {"a.txt", "b.txt"};
  const TemporaryDirectory temporary_;
  const fs::path top_ = temporary_.path();
};

TEST_F(WholeFileTest, NewDirectoriesAppearWithTheirParents) {
  publish(top_ / "x" / "y" / "", "1");
  EXPECT_THAT(entries(top_), ElementsAre("x"));
  EXPECT_THAT(entries(top_ / "x" / "y"), ElementsAre("a.txt", "b.txt"));
}

TEST_F(WholeFileTest, AnEarlierResultIsReplaced) {
  publish(top_ / "r", "1");
  publish(top_ / "r", "2");
  EXPECT_EQ(read(top_ / "r" / "a.txt"), "2");
  EXPECT_THAT(entries(top_), ElementsAre("r"));
}

TEST_F(WholeFileTest, AFailureLeavesTheEarlierResultAndNothingElse) {
  publish(top_ / "r", "1");
  for (const char* name : {"r", "new", "deep/new"}) {
    const WholeDirectory result(top_ / name, kNames, false);
    EXPECT_THROW(result.publish([](const fs::path& staging) {
      write_file(staging / "a.txt", "2");
      throw std::runtime_error("halfway");
    }),
                 std::runtime_error);
  }
  EXPECT_EQ(read(top_ / "r" / "a.txt"), "1");
  EXPECT_THAT(entries(top_), ElementsAre("r"));
}

TEST_F(WholeFileTest, StrangersAreNotTouchedWithoutForce) {
  fs::create_directory(top_ / "r");
  std::ofstream(top_ / "r" / "thesis.tex") << "words";
  EXPECT_THAT(refusal(top_ / "r", false), HasSubstr("holds thesis.tex"));
  publish(top_ / "r", "1", true);
  EXPECT_THAT(entries(top_ / "r"), ElementsAre("a.txt", "b.txt", "thesis.tex"));
  EXPECT_EQ(read(top_ / "r" / "thesis.tex"), "words");
}

TEST_F(WholeFileTest, AFolderNamedLikeAResultIsAStranger) {
  fs::create_directories(top_ / "r" / "a.txt");
  EXPECT_THAT(refusal(top_ / "r", false), HasSubstr("holds a.txt"));
}

TEST_F(WholeFileTest, LinksAreFollowed) {
  fs::create_directory(top_ / "real");
  fs::create_directory_symlink(top_ / "real", top_ / "link");
  publish(top_ / "link", "1");
  EXPECT_TRUE(fs::is_symlink(top_ / "link"));
  EXPECT_THAT(entries(top_ / "real"), ElementsAre("a.txt", "b.txt"));
}

TEST_F(WholeFileTest, RefusesWhatCannotBeWrittenBeforeTheWork) {
  std::ofstream(top_ / "file") << "text";
  EXPECT_THAT(refusal(top_ / "file", false), HasSubstr("expected a directory"));
  EXPECT_THAT(refusal(top_ / "file" / "below", false), HasSubstr("cannot be written"));
  EXPECT_THAT(refusal("/proc/skyfit", false), HasSubstr("cannot be written"));
  EXPECT_THAT(refusal("", false), HasSubstr("expected a name"));
  EXPECT_THAT(entries(top_), ElementsAre("file"));
}

TEST_F(WholeFileTest, TheCheckAloneChangesNothing) {
  EXPECT_EQ(refusal(top_ / "x" / "y", false), "was accepted");
  EXPECT_THAT(entries(top_), IsEmpty());
}

TEST_F(WholeFileTest, FilesAreRefusedBeforeTheWork) {
  const auto file_refusal = [](const fs::path& file) -> std::string {
    try {
      require_writable_file(file);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "was accepted";
  };
  EXPECT_EQ(file_refusal(top_ / "frame.png"), "was accepted");
  EXPECT_THAT(file_refusal(top_), HasSubstr("this is a directory"));
  EXPECT_THAT(file_refusal(top_ / "missing" / "frame.png"), HasSubstr("folder does not exist"));
  EXPECT_THAT(file_refusal("/proc/frame.png"), HasSubstr("cannot be written"));
  EXPECT_THAT(entries(top_), IsEmpty());
}

// Files cannot grow beyond it while it lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit = {bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(WholeFileTest, AFullDiskLeavesTheOldFile) {
  const fs::path file = top_ / "a.txt";
  write_whole_file(file, "old");
  {
    const FileSizeLimit limit(1000);
    EXPECT_THAT(
        [&] { write_whole_file(file, std::string(2000, 'x')); },
        ThrowsMessage<std::runtime_error>(file.string() + ": cannot be written: File too large"));
  }
  EXPECT_EQ(read(file), "old");
  EXPECT_THAT(entries(top_), ElementsAre("a.txt"));
}

TEST_F(WholeFileTest, AFullDiskIsToldByTheNameOfTheUser) {
  const fs::path result = top_ / "r";
  const FileSizeLimit limit(1000);
  EXPECT_THAT([&] { publish(result, std::string(2000, 'x')); },
              ThrowsMessage<std::runtime_error>((result / "a.txt").string() +
                                                ": cannot be written: File too large"));
  EXPECT_THAT(entries(top_), IsEmpty());
}

TEST_F(WholeFileTest, SeveralFilesOfSeveralFolders) {
  fs::create_directory(top_ / "inner");
  WholeFiles whole({top_ / "a.txt", top_ / "inner/b.txt"});
  whole.write(0, "a");
  EXPECT_THROW(whole.publish(), std::runtime_error);  // the second one is missing
  EXPECT_FALSE(fs::exists(top_ / "a.txt"));
  whole.make(1, [](const fs::path& file) { std::ofstream(file) << "b"; });
  whole.publish();
  EXPECT_EQ(read(top_ / "a.txt") + read(top_ / "inner/b.txt"), "ab");
}

TEST_F(WholeFileTest, TemporaryNamesHoldNoTextOfTheUser) {
  const WholeFiles whole({top_ / "|touch x;#~.svg"});
  EXPECT_EQ(whole.temporary(0).filename(), "0.svg");
}

TEST_F(WholeFileTest, PipesAndDevicesAreNotReplaced) {
  ASSERT_EQ(::mkfifo((top_ / "pipe.svg").c_str(), 0600), 0);
  EXPECT_THAT([&] { write_whole_file(top_ / "pipe.svg", "x"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("this is a pipe or a device")));
}

}  // namespace
}  // namespace skyfit
