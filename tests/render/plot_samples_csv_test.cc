// SPDX-License-Identifier: Apache-2.0
// samples.csv reads back to the same doubles, and a bad file is refused with its line and field.
#include <gmock/gmock.h>

#include "plot_samples.h"
#include "render/plot/samples_csv.h"

namespace skyfit::plot {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StrEq;
using ::testing::ThrowsMessage;

constexpr char kHeader[] =
    "scan,sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,wavelength_nm,reference,sigma,model,"
    "residual,weight";

std::vector<Sample> awkward_samples(bool with_start) {
  std::vector<Sample> samples;
  for (int i = 0; i < 50; ++i) {
    Sample sample = sample_at(i / 3.0, i * std::sqrt(2.0), i * 360.0 / 7, 0.1 * std::sin(i));
    sample.reference = std::pow(10.0, i - 25) / 3;
    sample.weight = i % 4;
    sample.scan = 1 + i / 10;
    sample.wavelength_nm = i % 2 * 550.5;
    sample.sigma = sample.reference / 7;
    if (with_start) sample.start_model = sample.reference * std::exp(1.0 / (i + 1));
    samples.push_back(sample);
  }
  return samples;
}

bool same_bits(const Sample& a, const Sample& b) {
  Sample left = a, right = b;
  const bool same_start =
      std::isnan(a.start_model) ? std::isnan(b.start_model) : a.start_model == b.start_model;
  left.start_model = right.start_model = 0;
  return same_start && left == right;
}

TEST_F(PlotTest, SamplesReadBackToTheSameDoubles) {
  for (const bool with_start : {false, true}) {
    const auto samples = awkward_samples(with_start);
    write_samples_csv(folder_ / "samples.csv", samples);
    const auto read = read_samples_csv(folder_ / "samples.csv");
    ASSERT_EQ(read.size(), samples.size());
    for (std::size_t i = 0; i < read.size(); ++i)
      EXPECT_TRUE(same_bits(read[i], samples[i])) << "row " << i;
    EXPECT_THAT(names(), ElementsAre("samples.csv"));
  }
}

TEST(SamplesCsv, IrradiancesKeepTheirNames) {
  std::vector<Sample> samples = awkward_samples(true);
  for (Sample& sample : samples) sample.irradiance = "diffuse_horizontal";
  const std::string text = samples_to_csv(samples);
  EXPECT_EQ(parse_samples_csv(text, "samples.csv"), samples);
  std::vector<Sample> beside_sky = samples;
  beside_sky.front().irradiance = "";
  EXPECT_EQ(parse_samples_csv(samples_to_csv(beside_sky), "samples.csv"), beside_sky);
  EXPECT_THAT(directions_only(beside_sky), ElementsAre(beside_sky.front()));
  EXPECT_EQ(irradiances_only(beside_sky).size(), samples.size() - 1);
  std::string wrong = text;
  wrong.replace(wrong.find("diffuse_horizontal"), 18, "diffuse");
  EXPECT_THAT([&] { parse_samples_csv(wrong, "samples.csv"); },
              ThrowsMessage<std::invalid_argument>(
                  StrEq("samples.csv:2: irradiance = \"diffuse\": expected one of direct_normal, "
                        "direct_horizontal, diffuse_horizontal, global_horizontal, or nothing")));
}

TEST(SamplesCsv, HeaderIsTheAgreedOne) {
  const auto first_line = [](const std::string& text) { return text.substr(0, text.find('\n')); };
  EXPECT_EQ(first_line(samples_to_csv(awkward_samples(false))), kHeader);
  EXPECT_EQ(first_line(samples_to_csv(awkward_samples(true))),
            std::string(kHeader) + ",start_model");
}

TEST(SamplesCsv, WindowsLineEndsAreLineEnds) {
  EXPECT_EQ(
      parse_samples_csv(std::string(kHeader) + "\r\n1,30,5,0,0,1,0.1,2,0.5,1\r\n", "s.csv").size(),
      1u);
}

struct BadFile {
  const char* body;
  const char* message;
};

class BadSamples : public ::testing::TestWithParam<BadFile> {};

TEST_P(BadSamples, IsRefusedWithLineAndField) {
  const std::string text = std::string(kHeader) + "\n" + GetParam().body;
  EXPECT_THAT([&] { parse_samples_csv(text, "s.csv"); },
              ThrowsMessage<std::invalid_argument>(StrEq(GetParam().message)));
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadSamples,
    ::testing::Values(
        BadFile{"", "s.csv: expected at least one sample"},
        BadFile{"1,30,5,0,0,1,0,2,0.5\n", "s.csv:2: expected 10 fields, got 9"},
        BadFile{"1,30,5,0,0,1,0,2,0.5,1\n1,30,5,0,0,abc,0,2,0.5,1\n",
                "s.csv:3: reference = \"abc\": expected a finite number"},
        BadFile{"1,30,5,0,0,1,0,nan,0.5,1\n", "s.csv:2: model = \"nan\": expected a finite number"},
        BadFile{"1,30,5,0,0,1,0,2,0.5,-1\n", "s.csv:2: weight = \"-1\": expected a number >= 0"},
        BadFile{"1,30,5,0,0,1,-2,2,0.5,1\n", "s.csv:2: sigma = \"-2\": expected a number >= 0"},
        BadFile{"0,30,5,0,0,1,0,2,0.5,1\n", "s.csv:2: scan = \"0\": expected a whole number >= 1"},
        BadFile{"1,200,5,0,0,1,0,2,0.5,1\n",
                "s.csv:2: sun_zenith_deg = \"200\": expected a number in 0..180"},
        BadFile{"1,30,5,0,0,1 cd,0,2,0.5,1\n",
                "s.csv:2: reference = \"1 cd\": expected a finite number"}));

// What a weight of 0 keeps may be negative; its residual is none.
TEST(SamplesCsv, NegativeValuesHaveNoResidual) {
  Sample sample = sample_at(30, 5, 0, 0);
  sample.reference = -1;
  sample.weight = 0;
  const std::string text = samples_to_csv({&sample, 1});
  EXPECT_NE(text.find(",nan,0\n"), std::string::npos) << text;
  EXPECT_EQ(parse_samples_csv(text, "s.csv")[0].reference, -1);
}

TEST(SamplesCsv, AForeignHeaderIsRefused) {
  EXPECT_THAT([] { parse_samples_csv("a,b\n1,2\n", "s.csv"); },
              ThrowsMessage<std::invalid_argument>(StrEq("s.csv:1: expected a column scan")));
}

TEST_F(PlotTest, MissingFolderLeavesNothing) {
  EXPECT_THAT(
      [&] { write_samples_csv(folder_ / "none/samples.csv", awkward_samples(false)); },
      ThrowsMessage<std::runtime_error>(StrEq((folder_ / "none/samples.csv").string() +
                                              ": cannot be written: No such file or directory")));
  EXPECT_THAT(names(), IsEmpty());
}

// sqrt((1 * 0.03^2 + 3 * 0.01^2) / 4) = sqrt(3e-4) = 1.7320508 %; the sample without weight does
// not count.
TEST(RmsLogPercent, IsTheWeightedRootMeanSquare) {
  std::vector<Sample> samples = {sample_at(0, 10, 0, 0.03), sample_at(0, 20, 0, -0.01),
                                 sample_at(0, 0, 0, 9)};
  samples[1].weight = 3;
  samples[2].weight = 0;
  EXPECT_NEAR(rms_log_percent(samples), 1.7320508075688772, 1e-12);
  EXPECT_TRUE(std::isnan(rms_log_percent({})));
}

}  // namespace
}  // namespace skyfit::plot
