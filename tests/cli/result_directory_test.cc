// SPDX-License-Identifier: Apache-2.0
// A result directory appears whole or not at all, replaces an earlier result only, and never a
// stranger's file.
#include <gmock/gmock.h>
#include <stdlib.h>

#include <fstream>
#include <sstream>

#include "cli/output.h"

namespace skyfit::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ResultDirectoryTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "skyfit-result-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    top_ = name;
  }
  void TearDown() override { fs::remove_all(top_); }

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
      const ResultDirectory result(directory, kNames, force);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "was accepted";
  }
  static void publish(const fs::path& directory, const std::string& text, bool force = false) {
    ResultDirectory(directory, kNames, force).publish([&](const fs::path& staging) {
      write_text(staging / "a.txt", text);
      write_text(staging / "b.txt", text);
    });
  }

  inline static const std::vector<std::string> kNames = {"a.txt", "b.txt"};
  fs::path top_;
};

TEST_F(ResultDirectoryTest, NewDirectoriesAppearWithTheirParents) {
  publish(top_ / "x" / "y" / "", "1");
  EXPECT_THAT(entries(top_), ElementsAre("x"));
  EXPECT_THAT(entries(top_ / "x" / "y"), ElementsAre("a.txt", "b.txt"));
}

TEST_F(ResultDirectoryTest, AnEarlierResultIsReplaced) {
  publish(top_ / "r", "1");
  publish(top_ / "r", "2");
  EXPECT_EQ(read(top_ / "r" / "a.txt"), "2");
  EXPECT_THAT(entries(top_), ElementsAre("r"));
}

TEST_F(ResultDirectoryTest, AFailureLeavesTheEarlierResultAndNothingElse) {
  publish(top_ / "r", "1");
  for (const char* name : {"r", "new", "deep/new"}) {
    const ResultDirectory result(top_ / name, kNames, false);
    EXPECT_THROW(result.publish([](const fs::path& staging) {
      write_text(staging / "a.txt", "2");
      throw std::runtime_error("halfway");
    }),
                 std::runtime_error);
  }
  EXPECT_EQ(read(top_ / "r" / "a.txt"), "1");
  EXPECT_THAT(entries(top_), ElementsAre("r"));
}

TEST_F(ResultDirectoryTest, StrangersAreNotTouchedWithoutForce) {
  fs::create_directory(top_ / "r");
  std::ofstream(top_ / "r" / "thesis.tex") << "words";
  EXPECT_THAT(refusal(top_ / "r", false), HasSubstr("holds thesis.tex"));
  publish(top_ / "r", "1", true);
  EXPECT_THAT(entries(top_ / "r"), ElementsAre("a.txt", "b.txt", "thesis.tex"));
  EXPECT_EQ(read(top_ / "r" / "thesis.tex"), "words");
}

TEST_F(ResultDirectoryTest, AFolderNamedLikeAResultIsAStranger) {
  fs::create_directories(top_ / "r" / "a.txt");
  EXPECT_THAT(refusal(top_ / "r", false), HasSubstr("holds a.txt"));
}

TEST_F(ResultDirectoryTest, LinksAreFollowed) {
  fs::create_directory(top_ / "real");
  fs::create_directory_symlink(top_ / "real", top_ / "link");
  publish(top_ / "link", "1");
  EXPECT_TRUE(fs::is_symlink(top_ / "link"));
  EXPECT_THAT(entries(top_ / "real"), ElementsAre("a.txt", "b.txt"));
}

TEST_F(ResultDirectoryTest, RefusesWhatCannotBeWrittenBeforeTheWork) {
  std::ofstream(top_ / "file") << "text";
  EXPECT_THAT(refusal(top_ / "file", false), HasSubstr("expected a directory"));
  EXPECT_THAT(refusal(top_ / "file" / "below", false), HasSubstr("cannot be written"));
  EXPECT_THAT(refusal("/proc/skyfit", false), HasSubstr("cannot be written"));
  EXPECT_THAT(refusal("", false), HasSubstr("expected a name"));
  EXPECT_THAT(entries(top_), ElementsAre("file"));
}

TEST_F(ResultDirectoryTest, TheCheckAloneChangesNothing) {
  EXPECT_EQ(refusal(top_ / "x" / "y", false), "was accepted");
  EXPECT_THAT(entries(top_), IsEmpty());
}

TEST_F(ResultDirectoryTest, FilesAreRefusedBeforeTheWork) {
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

}  // namespace
}  // namespace skyfit::cli
