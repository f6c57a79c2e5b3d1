// SPDX-License-Identifier: Apache-2.0
// The plan of a campaign becomes tasks; each is done once, whatever happens in between, and the
// results of all are the same by whichever way they were reached.
#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "fit/campaign/plan.h"
#include "fit/campaign/run.h"
#include "model/base/temporary_directory.h"
#include "model/base/whole_file.h"

namespace skyfit::fit {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class CampaignTest : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder() / name).parent_path());
    write_file(folder() / name, text);
  }
  const fs::path& folder() const { return temporary_.path(); }

  // A file holds lines `latitude longitude time`, each a scan.
  static refs::Reference read(const fs::path& file) {
    refs::Reference reference;
    std::istringstream lines(read_file(file, "a test"));
    double latitude = 0, longitude = 0;
    std::string time;
    while (lines >> latitude >> longitude >> time) {
      refs::Scan scan;
      scan.name = file.filename().string();
      if (time != "-") scan.time_utc = time;
      if (latitude != 0) {
        constexpr double kDegree = std::numbers::pi / 180;
        scan.site = refs::Site{latitude * kDegree, longitude * kDegree, 0};
      }
      refs::Sample sample;
      sample.value = 1;
      sample.scan = static_cast<int>(reference.scans.size());
      reference.samples.push_back(sample);
      reference.scans.push_back(scan);
    }
    if (reference.scans.empty()) throw std::invalid_argument("no scan");
    return reference;
  }
  std::vector<Task> tasks(const CampaignPlan& plan) const {
    return tasks_of(plan, NamedFiles::kInItsFolder, read, 2);
  }
  CampaignPlan plan(const std::string& json) const {
    write("plan.json", json);
    return load_plan(folder() / "plan.json");
  }
  CampaignPlan toml_plan(const std::string& toml) const {
    write("plan.toml", toml);
    return load_plan(folder() / "plan.toml");
  }
  static std::vector<std::string> names(const std::vector<Task>& tasks) {
    std::vector<std::string> list;
    for (const Task& task : tasks) list.push_back(task.name);
    return list;
  }
  // Deterministic, with unknowns that differ from task to task.
  static Outcome fake_fit(const Task& task) {
    if (task.name.find("bad") != std::string::npos) throw std::invalid_argument("bad\nsky");
    Outcome o;
    o.task = task.name;
    o.key = task.key;
    o.samples = static_cast<double>(task.name.size());
    o.rms_log = 2;
    o.unknowns = {{"mie.scattering", "1/m", 1e-5 * o.samples, Outcome::kNone, 1, 1}};
    if (task.name.size() % 2 == 0) {
      o.unknowns.push_back({"ground.albedo", "1", 0.2, 0.01, 0, 0});
      o.covariance_names = {"ground.albedo"};
      o.covariance = Eigen::MatrixXd::Constant(1, 1, 1e-4);
    }
    return o;
  }

 private:
  const TemporaryDirectory temporary_;
};

TEST_F(CampaignTest, GroupsScansByFileScanDayAndSite) {
  // Late in the evening by UTC it is the same day in America, and early in the morning the next.
  write("a.csv", "42 -76 2013-05-27T13:00:00Z 42 -76 2013-05-28T02:00:00Z");
  write("b.csv", "42 -76 2013-05-28T13:00:00Z 47 11 2013-05-27T13:00:00Z");
  write("a.csv.sidecar.json", "{}");
  const auto grouped = [&](const std::string& group) {
    return names(
        tasks(plan(R"({"skyfit_campaign": 1, "inputs": ["*.csv"], "group": ")" + group + "\"}")));
  };
  EXPECT_THAT(names(tasks(plan(R"({"skyfit_campaign": 1, "inputs": ["*.csv", "a.csv"]})"))),
              ElementsAre("a.csv", "b.csv"));
  // A file that has another name there is the same file.
  EXPECT_THAT(names(tasks(plan(R"({"skyfit_campaign": 1, "inputs": ["*.csv", "./a.csv"]})"))),
              ElementsAre("a.csv", "b.csv"));
  EXPECT_THAT(grouped("scan"), ElementsAre("a.csv[1]", "a.csv[2]", "b.csv[1]", "b.csv[2]"));
  EXPECT_THAT(grouped("day"),
              ElementsAre("2013-05-27 at 42.0000,-76.0000", "2013-05-27 at 47.0000,11.0000",
                          "2013-05-28 at 42.0000,-76.0000"));
  EXPECT_THAT(grouped("site"), ElementsAre("42.0000,-76.0000", "47.0000,11.0000"));
}

TEST_F(CampaignTest, ATaskHasItsScans) {
  write("a.csv", "42 -76 2013-05-27T13:00:00Z 47 11 2013-05-27T14:00:00Z");
  write("b.csv", "47 11 2013-05-27T15:00:00Z");
  const std::vector<Task> sites =
      tasks(plan(R"({"skyfit_campaign": 1, "inputs": ["*.csv"], "group": "site"})"));
  ASSERT_THAT(sites, SizeIs(2));
  const refs::Reference second = task_reference(sites[1], read);
  ASSERT_THAT(second.scans, SizeIs(2));
  EXPECT_EQ(second.scans[0].time_utc, "2013-05-27T14:00:00Z");
  EXPECT_EQ(second.scans[1].time_utc, "2013-05-27T15:00:00Z");
  EXPECT_EQ(second.samples[0].scan, 0);
  EXPECT_EQ(second.samples[1].scan, 1);
}

TEST_F(CampaignTest, WhatCannotBeGroupedIsATaskThatFails) {
  write("a.csv", "0 0 -");
  write("b.csv", "");
  const std::vector<Task> days =
      tasks(plan(R"({"skyfit_campaign": 1, "inputs": ["*.csv"], "group": "day"})"));
  ASSERT_THAT(days, SizeIs(2));
  EXPECT_THAT(days[0].problem, HasSubstr("its time is not known"));
  EXPECT_EQ(days[1].problem, "no scan");
  EXPECT_THROW(task_reference(days[0], read), std::invalid_argument);
}

TEST_F(CampaignTest, AKeyChangesWithOptionsFilesAndSidecars) {
  write("a.csv", "42 -76 2013-05-27T13:00:00Z");
  const auto key = [&](const std::string& options) {
    return tasks(plan(R"({"skyfit_campaign": 1, "inputs": ["a.csv"], "options": )" + options + "}"))
        .front()
        .key;
  };
  std::set<std::string> keys = {key("{}"), key(R"({"lobes": 1})"), key(R"({"lobes": 2})")};
  EXPECT_EQ(key("{}"), key("{}"));
  write("a.csv.sidecar.json", "{}");
  keys.insert(key("{}"));
  write("a.csv", "43 -76 2013-05-27T13:00:00Z");
  keys.insert(key("{}"));
  EXPECT_THAT(keys, SizeIs(5));
}

TEST_F(CampaignTest, OptionsAreThoseOfTheCommandLine) {
  const CampaignPlan read = plan(
      R"({"skyfit_campaign": 1, "inputs": ["a"],
          "options": {"fix": ["a=1", "b=2"], "lobes": 1, "no-priors": true, "scalar": false}})");
  EXPECT_THAT(read.options,
              ElementsAre("--fix", "a=1", "--fix", "b=2", "--lobes", "1", "--no-priors"));
}

TEST_F(CampaignTest, BadPlansAreRefusedInALine) {
  const auto complaint = [&](const std::string& json) {
    try {
      tasks(plan(json));
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_THAT(complaint(R"({"skyfit_campaign": 1, "inputs": []})"),
              HasSubstr("at least one file or pattern"));
  EXPECT_THAT(complaint(R"({"skyfit_campaign": 2, "inputs": ["a"]})"), HasSubstr("expected 1"));
  EXPECT_THAT(complaint(R"({"skyfit_campaign": 1, "inputs": ["no*"]})"),
              HasSubstr("inputs: no*: expected a file or a pattern"));
  EXPECT_THAT(complaint(R"({"skyfit_campaign": 1, "inputs": ["a"], "group": "week"})"),
              HasSubstr("expected one of file, scan, day, site"));
  EXPECT_THAT(complaint(R"({"skyfit_campaign": 1, "inputs": ["/etc/passwd"]})"),
              HasSubstr("a file in the folder"));
  EXPECT_THAT(complaint(R"({"skyfit_campaign": 1, "inputs": ["a"], "tasks_per_file": 0.5})"),
              HasSubstr("a whole number"));
  EXPECT_THAT(complaint(R"({"skyfit_campaign": 1, "inputs": ["a"], "options": {"lobes": {}}})"),
              HasSubstr("options.lobes"));
}

TEST_F(CampaignTest, APlanMayBeToml) {
  write("a.csv", "42 -76 2013-05-27T13:00:00Z");
  const CampaignPlan json = plan(R"({"skyfit_campaign": 1, "inputs": ["*.csv"], "group": "day",
    "options": {"fix": ["a=1", "b=2"], "lobes": 1, "noise": 0.02, "no-priors": true}})");
  const CampaignPlan toml = toml_plan(
      "skyfit_campaign = 1  # of a comment nothing\ninputs = ['*.csv']\ngroup = 'day'\n"
      "[options]\nlobes = 1\nfix = ['a=1', 'b=2']\nno-priors = true\nnoise = 0.02\n");
  EXPECT_EQ(toml.options, json.options);
  EXPECT_EQ(toml.group, json.group);
  EXPECT_EQ(tasks(toml).at(0).key, tasks(json).at(0).key);
}

TEST_F(CampaignTest, BadTomlIsRefusedWithItsLine) {
  const auto complaint = [&](const std::string& text) {
    try {
      toml_plan(text);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const std::string begin = "skyfit_campaign = 1\ninputs = ['a']\n";
  EXPECT_THAT(complaint(begin + "group = 'week'"),
              HasSubstr("plan.toml:3: group = \"week\": expected one of file"));
  EXPECT_THAT(complaint(begin + "group = "), HasSubstr("plan.toml:3: expected TOML, got "));
  EXPECT_THAT(complaint(begin + "inputs = ['b']"), HasSubstr("plan.toml:3: expected TOML, got "));
  EXPECT_THAT(complaint(begin + "note = 2026-11-29"),
              HasSubstr("plan.toml:3: note: expected a text in quotes, a finite number"));
  EXPECT_THAT(complaint(begin + "[options]\nnoise = nan"),
              HasSubstr("plan.toml:4: options.noise: expected"));
  EXPECT_THAT(complaint(begin + "[options]\n[options.lobes]"),
              HasSubstr("plan.toml:4: options.lobes"));
  EXPECT_THAT(complaint("a = " + std::string(100'000, '[')),
              HasSubstr("plan.toml:1: expected TOML"));
}

class RunTest : public CampaignTest {
 protected:
  RunTest() {
    for (int i = 0; i < kFiles; ++i) write(fmt_name(i), "42 -76 2013-05-27T13:00:00Z");
  }
  static constexpr int kFiles = 11, kPerFile = 3;
  static std::string fmt_name(int i) {
    return (i == 4 ? "bad" : "sky") + std::string(static_cast<std::size_t>(i + 1), 'x') + ".csv";
  }
  CampaignPlan all() const {
    return plan(R"({"skyfit_campaign": 1, "inputs": ["*.csv"], "tasks_per_file": 3})");
  }
  // How many tasks were done.
  int run(const std::string& out, Shard shard = {}, int fail_at = -1) const {
    const CampaignPlan campaign = all();
    const std::vector<Task> list = tasks(campaign);
    std::atomic<int> done = 0;
    struct Killed {};  // nothing that a fit throws
    try {
      run_campaign(
          {campaign, list, folder() / out}, shard, 2,
          [&](const Task& task) {
            if (done++ == fail_at) throw Killed();
            return fake_fit(task);
          },
          [](std::size_t, std::size_t) {});
    } catch (const Killed&) {
    }
    return done;
  }
  std::string result(const std::string& out) const {
    const CampaignPlan campaign = all();
    const std::vector<Task> list = tasks(campaign);
    return campaign_csv(merged({campaign, list, folder() / out}));
  }
};

TEST_F(RunTest, WhatIsThereIsNotDoneAgain) {
  EXPECT_EQ(run("out"), kFiles);
  const std::string first = result("out");
  EXPECT_EQ(run("out"), 0);
  write("skyx.csv", "43 -76 2013-05-27T13:00:00Z");
  EXPECT_EQ(run("out"), 1);
  EXPECT_EQ(result("out"), first);
  // Another task in front moves all results by one.
  write("another.csv", "42 -76 2013-05-27T13:00:00Z");
  EXPECT_EQ(run("out"), 1);
  EXPECT_NE(result("out"), first);
  fs::remove(folder() / "another.csv");
  EXPECT_EQ(run("out"), 0);
  EXPECT_EQ(result("out"), first);
}

TEST_F(RunTest, ShardsAndResumedRunsGiveTheSame) {
  run("whole");
  const std::string whole = result("whole");
  for (const int k : {3, 1, 2}) run("shards", {k, 3});
  EXPECT_EQ(result("shards"), whole);
  run("resumed", {}, 5);
  EXPECT_THROW(result("resumed"), std::runtime_error);
  write_file(folder() / "resumed/tasks/000001.nc", "damaged");
  EXPECT_LE(run("resumed"), kFiles);
  EXPECT_EQ(result("resumed"), whole);
}

TEST_F(RunTest, ValuesAreOverTimeAndPlace) {
  run("out");
  const CampaignPlan campaign = all();
  const std::vector<Task> list = tasks(campaign);
  const NetcdfFile file = netcdf_of(merged({campaign, list, folder() / "out"}), "a test");
  const auto coordinates = [&](const std::string& name) {
    return std::ranges::find(file.variables, name, &NetcdfVariable::name)->coordinates;
  };
  EXPECT_EQ(coordinates("parameter_value"), "time latitude longitude elevation");
  EXPECT_EQ(coordinates("rms_log"), "time latitude longitude elevation");
  EXPECT_EQ(coordinates("time"), "");
  EXPECT_EQ(coordinates("parameter_unit"), "");
}

TEST_F(RunTest, AFailedTaskIsRecordedInALine) {
  run("out");
  EXPECT_THAT(result("out"), HasSubstr(fmt_name(4) + ",failed,bad sky,"));
}

TEST(Failure, NamesFilesFromTheFolderOfThePlan) {
  const Task task{.name = "scans/a.csv", .parts = {}, .problem = "", .key = "k"};
  const std::string reason =
      "/archive/2013/scans/a.csv:3: no sky; beside /archive/2013/scans/b.csv";
  EXPECT_EQ(failure_of(task, reason, "/archive/2013").reason,
            "scans/a.csv:3: no sky; beside scans/b.csv");
  EXPECT_EQ(failure_of(task, reason, {}).reason, reason);
}

TEST_F(RunTest, TheResultReadsAsItWasWritten) {
  std::vector<Outcome> outcomes;
  for (const Task& task : tasks(all())) {
    if (task.name.find("bad") == std::string::npos) {
      outcomes.push_back(fake_fit(task));
    } else {
      outcomes.push_back(failure_of(task, "a \"reason\", with commas", {}));
    }
  }
  const std::vector<Outcome> read = outcomes_of(netcdf_of(outcomes, "a test"), "a test");
  EXPECT_EQ(campaign_csv(read), campaign_csv(outcomes));
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].key, outcomes[i].key);
    EXPECT_EQ(read[i].covariance_names, outcomes[i].covariance_names);
    EXPECT_EQ(read[i].covariance.size(), outcomes[i].covariance.size());
  }
}

TEST(Summary, SaysHowManyDidNotConverge) {
  std::vector<Outcome> outcomes(3);
  for (Outcome& outcome : outcomes) outcome.rms_log = outcome.converged = 1;
  EXPECT_THAT(campaign_text(outcomes), Not(HasSubstr("NOT CONVERGED")));
  outcomes[1].converged = 0;
  EXPECT_THAT(campaign_text(outcomes), HasSubstr("NOT CONVERGED: 1 of those fitted"));
}

TEST_F(CampaignTest, OutliersAreFarAboveTheMedian) {
  // Median 3, median distance 1: above 3 + 5 x 1.4826.
  const auto flags_of = [](double largest) {
    std::vector<Outcome> outcomes;
    for (const double misfit : {1.0, 2.0, Outcome::kNone, 3.0, 4.0, largest}) {
      outcomes.emplace_back().rms_log = misfit;
      if (std::isnan(misfit)) outcomes.back().reason = "failed";
    }
    return outliers(outcomes);
  };
  EXPECT_THAT(flags_of(10.41), ElementsAre(0, 0, 0, 0, 0, 0));
  EXPECT_THAT(flags_of(10.42), ElementsAre(0, 0, 0, 0, 0, 1));
}

}  // namespace
}  // namespace skyfit::fit
