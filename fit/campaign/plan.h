// SPDX-License-Identifier: Apache-2.0
// The plan of a campaign: many measured skies, fitted in one way. A JSON file, docs/campaigns.md.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "data_refs/samples.h"
#include "model/base/input_file.h"

namespace skyfit::fit {

enum class InputKind {
  kSkies,       // data_refs/measured_formats.h
  kIrradiances  // tables of data_refs/irradiance.h
};

enum class Grouping {
  kFile,  // the scans of one file, jointly
  kScan,  // every scan by itself
  kDay,   // those of one day of mean solar time at one site
  kSite   // those of one site
};

struct CampaignPlan {
  std::filesystem::path folder;     // of the plan
  std::vector<std::string> inputs;  // files and folders, or patterns with * ? [], in that folder
  InputKind kind = InputKind::kSkies;
  Grouping group = Grouping::kFile;
  std::string inputs_place;          // "plan.json:2", for messages
  std::string irradiances;           // a table beside the skies, in that folder; empty: none
  std::string irradiances_place;     // as inputs_place
  std::vector<std::string> options;  // arguments of skyfit fit
  std::map<std::string, std::string> option_places;  // by name, and of all by ""

  // Where the option stands that a message about the options names first.
  std::string place_of_option(std::string_view message) const;
  int tasks_per_file = 64;  // results that are written together
};

// Throws std::invalid_argument or std::runtime_error with one line that names file, line, field,
// value and expectation.
CampaignPlan load_plan(const std::filesystem::path& file);

// What one fit is made of.
struct Task {
  struct Part {
    std::filesystem::path file;
    std::vector<int> scans;  // of the file; empty: all
  };
  std::string name;  // "scans/0930.csv", "scans/day.csv[2]", "2013-05-27 at 42.4476,-76.4810"
  std::vector<Part> parts;
  std::string problem;  // why it cannot be fitted, found when it was grouped; else empty
  std::string key;      // changes with the plan's options, what the files hold and the version
};

// The files and folders of the inputs, each once, as the plan names them, sorted. Throws
// std::invalid_argument where an input names no file, or one that `named` forbids.
std::vector<std::string> input_files(const CampaignPlan& plan, NamedFiles named);

using ReadSky = std::function<refs::Reference(const std::filesystem::path&)>;

// The tasks in the order of their names. Grouping by anything but the file reads every file once,
// on `threads` threads. Throws std::invalid_argument where an input names no file, or one that
// `named` forbids (model/base/input_file.h).
std::vector<Task> tasks_of(const CampaignPlan& plan, NamedFiles named, const ReadSky& read,
                           int threads);

// The scans of a task as one reference.
refs::Reference task_reference(const Task& task, const ReadSky& read);

}  // namespace skyfit::fit
