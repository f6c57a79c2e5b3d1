// SPDX-License-Identifier: Apache-2.0
// The program between other programs: presets on the standard input, files on the standard output,
// arrays for NumPy, and how much it says.
#include <cstring>
#include <regex>

#include "tests/cli/program.h"

namespace skyfit::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class PipesTest : public ProgramTest {};

const std::vector<std::string> kSky = {"sky", "--sun-zenith-deg", "40", "--view-zenith-deg", "30"};
const std::vector<std::string> kMap = {"sky-map",          "earth-clear", "--model",
                                       "hoffman-preetham", "--size",      "16",
                                       "--sun-zenith-deg", "40"};

std::vector<std::string> with(std::vector<std::string> arguments,
                              const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// What NumPy reads: shape and numbers, by the definition of the format (NEP 1).
struct Array {
  std::vector<int> shape;
  std::vector<float> values;
};
Array array_of(const std::string& bytes) {
  EXPECT_THAT(bytes, StartsWith(std::string("\x93NUMPY\x01\x00", 8)));
  const std::size_t length =
      static_cast<unsigned char>(bytes[8]) + 256u * static_cast<unsigned char>(bytes[9]);
  EXPECT_EQ((10 + length) % 64, 0u);
  const std::string header = bytes.substr(10, length);
  EXPECT_EQ(header.back(), '\n');
  std::smatch found;
  Array array;
  const std::regex kHeader(
      R"(\{'descr': '<f4', 'fortran_order': False, 'shape': \((\d+), (\d+), (\d+), \), \}\s*)");
  if (!std::regex_match(header, found, kHeader)) {
    ADD_FAILURE() << header;
    return array;
  }
  for (std::size_t k = 1; k <= 3; ++k) array.shape.push_back(std::stoi(found[k]));
  array.values.resize((bytes.size() - 10 - length) / sizeof(float));
  std::memcpy(array.values.data(), bytes.data() + 10 + length, array.values.size() * sizeof(float));
  return array;
}

TEST_F(PipesTest, APresetComesFromTheStandardInput) {
  const Outcome shipped = run({"presets", "earth-hazy"});
  ASSERT_EQ(shipped.status, 0) << shipped.err;
  const std::string file = write("p.json", shipped.out).string();
  const Outcome piped = run(with(kSky, {"--preset", "-"}), {}, {}, file),
                named = run(with(kSky, {"--preset", "earth-hazy"}));
  ASSERT_EQ(piped.status, 0) << piped.err;
  EXPECT_EQ(piped.out, named.out);
  EXPECT_THAT(run({"check", "-"}, {}, {}, file).out, StartsWith("-: valid preset"));
}

TEST_F(PipesTest, AnEmptyStandardInputIsNoPreset) {
  expect_refusal(with(kSky, {"--preset", "-"}), {"stdin", "expected a preset"});
}

TEST_F(PipesTest, AFileGoesToTheStandardOutputAndTheRestToStderr) {
  const Outcome exported = run({"export", "earth-clear", "--to", "calcmysky", "--out", "-.atmo"}),
                shorter = run({"export", "earth-clear", "--to", "calcmysky", "--out", "-"});
  ASSERT_EQ(exported.status, 0) << exported.err;
  EXPECT_THAT(exported.out, StartsWith("# Atmosphere of the preset earth-clear"));
  EXPECT_THAT(exported.err, HasSubstr("loss by what it cannot hold"));
  EXPECT_EQ(shorter.out, exported.out);
  EXPECT_TRUE(files().empty());
  write("b.atmo", exported.out);
  const Outcome back = run({"import", "-"}, {}, {}, (folder_ / "b.atmo").string()),
                from_file = run({"import", "b.atmo"});
  ASSERT_EQ(back.status, 0) << back.err;
  EXPECT_EQ(back.out, from_file.out);
}

TEST_F(PipesTest, OnlyOneFileFitsOnTheStandardOutput) {
  expect_refusal({"export", "earth-clear", "--to", "mitsuba", "--out", "-.xml"},
                 {"--out", "\"-.xml\"", "expected a file"});
  expect_refusal({"export", "earth-clear", "--to", "mitsuba", "--out", "-"},
                 {"--out", "\"-\"", "expected a file"});
  expect_refusal({"render", "--preset", "earth-clear", "--panels", "--out", "-.png"},
                 {"--panels", "expected files"});
}

TEST_F(PipesTest, AMapIsAnArray) {
  const Outcome map = run(with(kMap, {"--out", "-.npy"}));
  ASSERT_EQ(map.status, 0) << map.err;
  const Array array = array_of(map.out);
  EXPECT_EQ(array.shape, (std::vector<int>{16, 32, 3}));
  ASSERT_EQ(array.values.size(), 16u * 32 * 3);
  for (const float light : array.values) EXPECT_GE(light, 0);
  // The same as in the file of a picture.
  ASSERT_EQ(run(with(kMap, {"--out", "map.npy"})).status, 0);
  EXPECT_EQ(read("map.npy"), map.out);
}

TEST_F(PipesTest, QuietLeavesWarningsOutAndVerboseTellsOfWork) {
  const std::vector<std::string> warned = {
      "compare", "--reference",    "cie:12", "--models", "hoffman-preetham", "--sun-zenith-deg",
      "40",      "--latitude-deg", "50",     "--out",    "result",           "--force"};
  const Outcome normal = run(warned), quiet = run(with({"--quiet"}, warned)),
                verbose = run(with({"--verbose"}, warned));
  ASSERT_EQ(normal.status, 0) << normal.err;
  EXPECT_THAT(normal.err, HasSubstr("warning: --latitude-deg"));
  EXPECT_EQ(quiet.err, "");
  EXPECT_NE(quiet.out, "");
  EXPECT_THAT(verbose.err, ::testing::ContainsRegex("skyfit: comparing with cie:12: [0-9.]+ s\n"));
}

}  // namespace
}  // namespace skyfit::cli
