// SPDX-License-Identifier: Apache-2.0
// Pictures with a cache that is empty, full, damaged, switched off or impossible are the same file;
// --stats accounts for the wall time.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

#include "tests/cli/program.h"

namespace skyfit::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Of the table of wall time: the steps and the rest are the total, and the rest is small.
void expect_steps_add_up(const std::vector<std::string>& rows) {
  const auto head = std::ranges::find(rows, "wall time since the start of the process");
  ASSERT_NE(head, rows.end());
  double sum = 0, total = 0, rest = -1;
  for (auto row = head + 1; row != rows.end(); ++row) {
    const double seconds = std::strtod(row->substr(35).c_str(), nullptr);
    if (row->starts_with("  total ")) {
      total = seconds;
    } else {
      EXPECT_GE(seconds, 0) << *row;
      sum += seconds;
      if (row->starts_with("  rest ")) rest = seconds;
    }
  }
  const double rounding = 0.0005 * static_cast<double>(rows.end() - head);
  EXPECT_NEAR(sum, total, rounding);
  EXPECT_GT(total, 0);
  EXPECT_GE(rest, 0);
  EXPECT_LT(rest, 0.02 * total + rounding) << "what has no name";
}

class CacheTest : public ProgramTest {
 protected:
  // A picture of the model whose tables take least.
  Outcome render(const std::string& out, const std::vector<std::string>& more,
                 const std::vector<std::string>& environment) const {
    std::vector<std::string> arguments = {
        "render", "--preset", "earth-clear", "--model", "nielsen", "--view",
        "valley", "--size",   "32x18",       "--out",   out,       "--samples-per-side",
        "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments, environment);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome;
  }

  std::set<fs::path> entries() const {
    std::set<fs::path> files;
    for (const auto& entry : fs::directory_iterator(caches_.path() / "skyfit"))
      files.insert(entry.path());
    return files;
  }

  const TemporaryDirectory caches_;
  const std::vector<std::string> here_ = {"XDG_CACHE_HOME=" + caches_.path().string()};
};

TEST_F(CacheTest, APictureIsTheSameWithAndWithoutIt) {
  render("without.png", {"--no-cache"}, here_);
  EXPECT_FALSE(fs::exists(caches_.path() / "skyfit"));
  render("first.png", {}, here_);
  const std::set<fs::path> kept = entries();
  EXPECT_GT(kept.size(), 20u) << "tables, textures, blocks of terrain";
  render("second.png", {}, here_);
  EXPECT_EQ(entries(), kept) << "all was found";
  for (const fs::path& file : kept) {
    std::fstream damaged(file, std::ios::binary | std::ios::in | std::ios::out);
    damaged.seekp(static_cast<std::streamoff>(fs::file_size(file) / 2));
    damaged.put('!');
  }
  const Outcome outcome = render("damaged.png", {"--stats"}, here_);
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_EQ(entries(), kept) << "and replaced";
  expect_steps_add_up(lines(outcome.out));
  const std::string picture = read("without.png");
  for (const char* name : {"first.png", "second.png", "damaged.png"})
    EXPECT_TRUE(read(name) == picture) << name;
}

TEST_F(CacheTest, ASkyOfParticlesIsTheSameWithAndWithoutIt) {
  write("particles.json", R"({"skyfit_preset": 2, "name": "particles",
    "planet": {"bottom_radius_m": 6360000, "top_radius_m": 6460000}, "ground": {"albedo": 0.15},
    "constituents": [{"name": "fine", "volume_um3_per_um2": 0.025,
      "profile": {"type": "exponential", "scale_height_m": 1200},
      "phase": {"type": "size-distribution", "median_radius_um": 0.15, "width": 0.45,
                "material": "sulphate"}}]})");
  const auto sky = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"sky",
                                          "--preset",
                                          (folder_ / "particles.json").string(),
                                          "--sun-zenith-deg",
                                          "40",
                                          "--view-zenith-deg",
                                          "0:60:30",
                                          "--wavelength-nm",
                                          "440,550"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments, here_);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  const std::string computed = sky({"--no-cache"});
  EXPECT_FALSE(fs::exists(caches_.path() / "skyfit"));
  EXPECT_EQ(sky({}), computed);
  const std::set<fs::path> kept = entries();
  EXPECT_EQ(kept.size(), 2u) << "two wavelengths";
  EXPECT_EQ(sky({}), computed);
  EXPECT_EQ(entries(), kept);
}

TEST_F(CacheTest, NoPlaceForItIsToldWithTheStatisticsAlone) {
  const Outcome told = render("a.png", {"--stats"}, {"XDG_CACHE_HOME=", "HOME="});
  EXPECT_EQ(told.err, "skyfit: no cache: neither XDG_CACHE_HOME nor HOME is an absolute path\n");
  const fs::path file = write("file", "not a directory");
  EXPECT_THAT(render("b.png", {}, {"XDG_CACHE_HOME=" + file.string()}).err, IsEmpty());
  EXPECT_TRUE(read("a.png") == read("b.png"));
}

TEST_F(CacheTest, TheDoctorSaysWhereItIs) {
  const Outcome outcome = run({"doctor"}, here_);
  EXPECT_THAT(outcome.out, HasSubstr("ok      cache of frames and particles: " +
                                     (caches_.path() / "skyfit").string() +
                                     ", 0 entries, 0.0 MB of at most 2000 MB\n"));
}

TEST_F(CacheTest, TheDoctorNamesWhatDraws) {
  const std::string out = run({"doctor"}, here_).out;
  EXPECT_THAT(out,
              ContainsRegex("ok      frames, software: draws with .+, OpenGL 4\\..+, by OSMesa\n"));
  EXPECT_THAT(out, ContainsRegex("\\(--gpu\\): draws with .+, OpenGL 4\\..+, by EGL "));
}

}  // namespace
}  // namespace skyfit::cli
