// SPDX-License-Identifier: Apache-2.0
// `skyfit campaign` fits what a plan names, leaves NetCDF, CSV, text and figure, and does nothing
// twice.
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/cli/program.h"

namespace skyfit::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class CampaignTest : public ProgramTest {
 protected:
  CampaignTest() {
    const std::string example = std::string(SKYFIT_EXAMPLES) + "sky_scan_145.csv";
    std::stringstream text;
    text << std::ifstream(example).rdbuf();
    std::string second = text.str();
    const std::string day = "2024-05-15";
    second.replace(second.find(day), day.size(), "2024-05-16");
    write("scans/a.csv", text.str());
    write("scans/b.csv", second);
    write("scans/c.csv", "no sky\n");
    write("plan.json",
          R"({"skyfit_campaign": 1, "inputs": ["scans/*.csv"], "tasks_per_file": 2,
              "options": {"lobes": 1, "starts": 1, "free": "mie.scattering"}})");
  }
  std::string in(const std::string& name) const { return (folder_ / name).string(); }
  std::string content(const std::string& name) const {
    std::stringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    return text.str();
  }
};

TEST_F(CampaignTest, LeavesOneResultOfAll) {
  const Outcome first = run({"campaign", in("plan.json"), "--out", in("out")});
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.out, StartsWith("3 tasks: 2 fitted, 0 of them outliers, 1 failed\n"));
  EXPECT_THAT(first.out, HasSubstr("scans/c.csv:1: "));
  for (const char* name : {"campaign.nc", "campaign.csv", "campaign.txt", "campaign.svg",
                           "campaign.png", "tasks/000000.nc", "tasks/000001.nc"})
    EXPECT_GT(std::filesystem::file_size(folder_ / "out" / name), 0u) << name;
  EXPECT_EQ(lines(content("out/campaign.csv")).size(), 4u);

  const auto written = std::filesystem::last_write_time(folder_ / "out/tasks/000000.nc");
  EXPECT_EQ(run({"campaign", in("plan.json"), "--out", in("out")}).out, first.out);
  EXPECT_EQ(std::filesystem::last_write_time(folder_ / "out/tasks/000000.nc"), written);

  for (const char* shard : {"2/2", "1/2"})
    EXPECT_EQ(run({"campaign", in("plan.json"), "--out", in("parts"), "--shard", shard}).status, 0);
  EXPECT_EQ(run({"campaign", in("plan.json"), "--out", in("parts"), "--merge"}).out, first.out);
  EXPECT_EQ(content("parts/campaign.nc"), content("out/campaign.nc"));
}

TEST_F(CampaignTest, WithoutAnyFitIsAnError) {
  write("none.json", R"({"skyfit_campaign": 1, "inputs": ["scans/c.csv"]})");
  const Outcome none = run({"campaign", in("none.json"), "--out", in("out")});
  EXPECT_EQ(none.status, 1);
  EXPECT_THAT(none.out, StartsWith("1 task: 0 fitted"));
  EXPECT_EQ(lines(none.err).size(), 1u) << none.err;
  EXPECT_THAT(none.err, HasSubstr("holds no fit: "));
  EXPECT_THAT(none.err, HasSubstr("scans/c.csv:1: "));
}

TEST_F(CampaignTest, FitsIrradiances) {
  std::filesystem::copy_file(std::string(SKYFIT_EXAMPLES) + "irradiances.csv",
                             folder_ / "sun@noon=1.csv");  // a name that is none of an hour
  write("days.json", R"({"skyfit_campaign": 1, "kind": "irradiances", "inputs": ["sun@*.csv"],
                         "group": "scan", "options": {"starts": 1}})");
  const Outcome done = run({"campaign", in("days.json"), "--out", in("days")});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, StartsWith("5 tasks: 5 fitted"));
  EXPECT_THAT(content("days/campaign.csv"), HasSubstr("mie.optical_depth"));
}

TEST_F(CampaignTest, FitsIrradiancesBesideSkies) {
  write("sun.csv",
        "# latitude_deg=47.5 longitude_deg=11\ntime,direct_normal_lx\n"
        "2024-05-15T10:00:00Z,95000\n2024-05-15T13:00:00Z,90000\n");
  const std::string plan = R"({"skyfit_campaign": 1, "inputs": ["scans/*.csv"],
      "irradiances": "IT", "options": {"lobes": 1, "starts": 1, "free": "mie.scattering"}})";
  const auto with = [&](const std::string& table) {
    std::string text = plan;
    write("both.json", text.replace(text.find("IT"), 2, table));
    return run({"campaign", in("both.json"), "--out", in("both")});
  };
  EXPECT_THAT(with("/sun.csv").err,
              HasSubstr("both.json:2: irradiances: /sun.csv: expected a file"));
  EXPECT_THAT(with("moon.csv").err, HasSubstr("both.json:2: irradiances: "));
  const Outcome done = with("sun.csv");
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("1 fitted"));
  EXPECT_THAT(done.out, HasSubstr("sun.csv: no irradiances are of the minute of a scan of"));
}

TEST_F(CampaignTest, WritesAJobArrayForSlurm) {
  const Outcome slurm =
      run({"campaign", in("plan.json"), "--out", in("o'ut"), "--slurm", "7", "--threads", "3"});
  EXPECT_EQ(slurm.status, 0) << slurm.err;
  const std::string script = content("o'ut/campaign.slurm");
  EXPECT_THAT(script, HasSubstr("#SBATCH --array=1-7\n#SBATCH --cpus-per-task=3\n"));
  EXPECT_THAT(script, HasSubstr("o'\\''ut' --shard \"$SLURM_ARRAY_TASK_ID/7\""));
  EXPECT_THAT(script, HasSubstr("\ncd "));
  EXPECT_THAT(script, Not(HasSubstr("--allow-paths")));
  EXPECT_EQ(run({"--allow-paths", "campaign", in("plan.json"), "--out", in("out"), "--slurm", "2"})
                .status,
            0);
  EXPECT_THAT(content("out/campaign.slurm"), HasSubstr("skyfit --allow-paths campaign "));
}

TEST_F(CampaignTest, SaysWhatIsWrongWithThePlan) {
  const auto complaint = [&](const std::string& plan, std::vector<std::string> more = {}) {
    write("bad.json", plan);
    std::vector<std::string> arguments = {"campaign", in("bad.json"), "--out", in("out")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_NE(outcome.status, 0);
    EXPECT_EQ(lines(outcome.err).size(), 1u) << outcome.err;
    return outcome.err;
  };
  const std::string good = R"({"skyfit_campaign": 1, "inputs": ["scans/a.csv"]})";
  EXPECT_THAT(complaint(R"({"skyfit_campaign": 1})"), HasSubstr("inputs"));
  EXPECT_THAT(complaint(R"({"skyfit_campaign": 1, "inputs": ["a"], "options": {"lobe": 1}})"),
              HasSubstr("bad.json:1: options: "));
  EXPECT_THAT(complaint(R"({"skyfit_campaign": 1, "inputs": ["a"], "options": {"help": true}})"),
              HasSubstr("bad.json:1: options: \"help\": expected an option of skyfit fit"));
  EXPECT_THAT(
      complaint(R"({"skyfit_campaign": 1, "inputs": ["a"], "options": {"bootstrap": 10}})"),
      HasSubstr("\"bootstrap\": expected an option of skyfit fit that is about how to fit many"));
  EXPECT_THAT(complaint("{\"skyfit_campaign\": 1, \"inputs\": [\"a\"],\n\"options\": {\n"
                        "\"starts\": 1,\n\"lobes\": 7}}"),
              HasSubstr("bad.json:4: options: fit.lobes = 7"));
  EXPECT_THAT(complaint(R"({"skyfit_campaign": 1, "inputs": ["a"], "options": {"lobes": true}})"),
              HasSubstr("bad.json:1: options: lobes: expected a value"));
  EXPECT_THAT(complaint(R"({"skyfit_campaign": 1, "inputs": ["a"], "options": {"scalar": "x"}})"),
              HasSubstr("bad.json:1: options: scalar: expected true or false"));
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, std::vector<std::string>{"--slurm", "2"}})
    EXPECT_THAT(complaint("{\"skyfit_campaign\": 1,\n\"inputs\": [\"a\"]}", more),
                HasSubstr("bad.json:2: inputs: a: expected a file or a pattern"));
  EXPECT_THAT(complaint(R"({"skyfit_campaign": 1, "inputs": ["a"], "kind": "moons"})"),
              HasSubstr("kind = \"moons\": expected one of skies, irradiances"));
  EXPECT_THAT(complaint(good, {"--shard", "3/2"}), HasSubstr("--shard \"3/2\": expected K/N"));
  EXPECT_THAT(complaint(good, {"--merge"}), HasSubstr("1 of 1 tasks are missing"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out")) << "an empty directory is left";
}

}  // namespace
}  // namespace skyfit::cli
