// SPDX-License-Identifier: Apache-2.0
// `skyfit campaign`: fits many measured skies in one way.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/fit_request.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "data_refs/irradiance.h"
#include "data_refs/joint_reference.h"
#include "data_refs/measured_formats.h"
#include "data_refs/spectra.h"
#include "fit/campaign/run.h"
#include "model/base/text.h"
#include "model/base/whole_file.h"
#include "render/plot/measured_figures.h"
#include "render/plot/results.h"

namespace skyfit::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char *kNetcdf = "campaign.nc", *kCsv = "campaign.csv", *kText = "campaign.txt",
                     *kSvg = "campaign.svg", *kPng = "campaign.png", *kScript = "campaign.slurm";

struct CampaignArguments {
  std::string plan, out, shard;
  int slurm = 0, threads = default_threads();
  bool merge = false;
};

// Directories that are made where they are missing, and go again where nothing is put into them.
class MadeDirectories {
 public:
  explicit MadeDirectories(const fs::path& directory) {
    for (fs::path at = fs::absolute(directory).lexically_normal(); !fs::exists(at);
         at = at.parent_path())
      made_.push_back(at);
    fs::create_directories(directory);
  }
  ~MadeDirectories() {
    std::error_code not_empty;
    for (const fs::path& at : made_) fs::remove(at, not_empty);
  }
  MadeDirectories(const MadeDirectories&) = delete;
  MadeDirectories& operator=(const MadeDirectories&) = delete;

 private:
  std::vector<fs::path> made_;  // the deepest first
};

// The options of `skyfit fit` that a plan states.
class HowToFit {
 public:
  // What is wrong with them is said before the work, with the plan's line.
  explicit HowToFit(const fit::CampaignPlan& plan) : kind_(plan.kind) {
    try {
      take(plan);
    } catch (const std::exception& error) {
      throw std::invalid_argument(
          fmt::format("{}: options: {}", plan.place_of_option(error.what()), error.what()));
    }
  }

  // The table beside the skies, which is read once.
  void read_irradiances(const fit::CampaignPlan& plan) {
    if (plan.irradiances.empty()) return;
    try {
      irradiances_ = refs::irradiance_table(plan.folder / plan.irradiances, import_);
    } catch (const std::exception& error) {
      throw std::invalid_argument(
          fmt::format("{}: irradiances: {}", plan.irradiances_place, error.what()));
    }
  }

  refs::Reference read(const fs::path& file) const {
    return kind_ == fit::InputKind::kIrradiances ? refs::irradiance_table(file, import_)
                                                 : refs::load_measured_sky(file, import_);
  }
  fit::Outcome fit(const fit::Task& task) const {
    refs::Reference reference =
        fit::task_reference(task, [this](const fs::path& file) { return read(file); });
    if (irradiances_)
      reference = refs::with_irradiances_of_scans(std::move(reference), *irradiances_);
    const FitRequest request = fit_request(arguments_, std::move(reference), app_);
    return fit::outcome_of(task, finished_fit(request, *request.model).result);
  }

 private:
  void take(const fit::CampaignPlan& plan) {
    add_fit_options(app_, arguments_);
    app_.add_option("--model", arguments_.model);
    add_refraction_option(app_, arguments_.refraction);
    add_scalar_option(app_, arguments_.scalar);
    app_.set_help_flag();
    expect_options(plan.options);
    std::vector<std::string> reversed(plan.options.rbegin(), plan.options.rend());
    app_.parse(reversed);
    arguments_.threads = 1;  // the tasks run beside each other
    import_ = parse_import_options(arguments_.import);
    const auto model =
        sky_model_named(arguments_.model, refs::standard_spectral_data(), arguments_.threads,
                        transfer_of(arguments_.scalar), arguments_.refraction);
    fit_options(arguments_, *model, app_);
  }

  // Known ones, with a value where they take one.
  void expect_options(const std::vector<std::string>& options) const {
    for (std::size_t i = 0; i < options.size(); ++i) {
      if (!options[i].starts_with("--")) continue;
      const CLI::Option* const option = app_.get_option_no_throw(options[i]);
      const std::string name = options[i].substr(2);
      constexpr std::array kSingle = {"--bootstrap", "--profile", "--hold-out", "--sun-zenith-deg",
                                      "--sampling"};
      if (option == nullptr || std::ranges::count(kSingle, options[i]) > 0)
        throw std::invalid_argument(
            fmt::format("{}: expected an option of skyfit fit that is about how to fit many skies",
                        in_quotes(name)));
      const bool has_value = i + 1 < options.size() && !options[i + 1].starts_with("--");
      if (has_value != (option->get_items_expected_max() > 0))
        throw std::invalid_argument(
            fmt::format("{}: expected {}", name, has_value ? "true or false" : "a value"));
    }
  }

  fit::InputKind kind_;
  CLI::App app_;
  FitArguments arguments_;
  refs::ImportOptions import_;
  std::optional<refs::Reference> irradiances_;
};

fit::Shard parse_shard(const std::string& text) {
  if (text.empty()) return {};
  constexpr const char* kExpected = "expected K/N, 1 <= K <= N, such as 3/10";
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) throw UsageError("--shard", text, kExpected);
  const double index = parse_number("--shard", text.substr(0, slash)),
               count = parse_number("--shard", text.substr(slash + 1));
  constexpr double kMost = 1e6;
  if (index < 1 || index > count || count > kMost || index != std::floor(index) ||
      count != std::floor(count))
    throw UsageError("--shard", text, kExpected);
  return {static_cast<int>(index), static_cast<int>(count)};
}

std::string slurm_script(const CampaignArguments& arguments) {
  const std::string program = fs::read_symlink("/proc/self/exe").string(),
                    plan = fs::absolute(arguments.plan).string(),
                    out = fs::absolute(arguments.out).string();
  const char* const allowed = named_files() == NamedFiles::kAnywhere ? " --allow-paths" : "";
  const std::string command = fmt::format("{}{} campaign {} --out {}", shell_quoted(program),
                                          allowed, shell_quoted(plan), shell_quoted(out));
  if (command.find('\n') != std::string::npos)
    throw UsageError("--slurm", command, "expected paths without line breaks");
  return fmt::format(
      "#!/bin/bash\n"
      "# Submit with sbatch; when the array is done: {} --merge\n"
      "#SBATCH --job-name=skyfit\n"
      "#SBATCH --array=1-{}\n"
      "#SBATCH --cpus-per-task={}\n"
      "cd {} || exit 1\n"
      "exec {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" --threads \"$SLURM_CPUS_PER_TASK\"\n",
      command, arguments.slurm, arguments.threads, shell_quoted(fs::current_path().string()),
      command, arguments.slurm);
}

// The misfit and the unknowns over the time of the tasks; nothing where no time is known.
std::vector<plot::MeasuredOutcome> over_time(const std::vector<fit::Outcome>& outcomes) {
  std::vector<plot::MeasuredOutcome> points;
  for (const fit::Outcome& outcome : outcomes) {
    if (!outcome.reason.empty() || !std::isfinite(outcome.time)) continue;
    plot::MeasuredOutcome point;
    point.scans.push_back(
        {outcome.task, fit::iso_time(outcome), outcome.luminance, outcome.spectral});
    point.unknowns.push_back({"misfit", "%", 0, outcome.misfit(), fit::Outcome::kNone});
    for (const fit::Outcome::Value& value : outcome.unknowns) {
      if (value.name.find('[') == std::string::npos)
        point.unknowns.push_back({value.name, value.unit, 0, value.value, value.sigma});
    }
    points.push_back(std::move(point));
  }
  return points;
}

void leave_summary(const CampaignArguments& arguments, const fit::CampaignRun& run) {
  const std::vector<fit::Outcome> outcomes = fit::merged(run);
  const std::string text = fit::campaign_text(outcomes);
  const fs::path out = arguments.out;
  fit::NetcdfFile file =
      fit::netcdf_of(outcomes, fmt::format("A campaign of {} tasks", outcomes.size()));
  std::string options;
  for (const std::string& option : run.plan.options)
    options += (options.empty() ? "" : " ") + shell_quoted(option);
  file.attributes.emplace_back("options", options);
  fit::write_netcdf(out / kNetcdf, file);
  write_whole_file(out / kCsv, fit::campaign_csv(outcomes));
  write_whole_file(out / kText, text);
  print(text);
  const std::vector<plot::MeasuredOutcome> points = over_time(outcomes);
  if (points.size() > 1) plot::write_figure(plot::series_figure(points), {out / kSvg, out / kPng});
  if (std::ranges::all_of(outcomes, [](const auto& outcome) { return !outcome.reason.empty(); }))
    throw std::runtime_error(fmt::format("{}: the result is complete but holds no fit: {}",
                                         arguments.out, outcomes.front().reason));
}

void run(const CampaignArguments& arguments) {
  const fit::CampaignPlan plan = fit::load_plan(arguments.plan);
  const fit::Shard shard = parse_shard(arguments.shard);
  HowToFit how(plan);
  const MadeDirectories made(arguments.out);
  require_writable_file(fs::path(arguments.out) / kCsv);
  if (arguments.slurm > 0) {
    fit::input_files(plan, named_files());
    const fs::path script = fs::path(arguments.out) / kScript;
    write_whole_file(script, slurm_script(arguments));
    print(fmt::format("sbatch {}\n", shell_quoted(script.string())));
    return;
  }
  const std::vector<fit::Task> tasks = fit::tasks_of(
      plan, named_files(), [&](const fs::path& file) { return how.read(file); }, arguments.threads);
  how.read_irradiances(plan);
  const fit::CampaignRun campaign{plan, tasks, arguments.out};
  if (!arguments.merge) {
    Progress progress("fitting");
    fit::run_campaign(
        campaign, shard, arguments.threads, [&](const fit::Task& task) { return how.fit(task); },
        [&](std::size_t done, std::size_t all) {
          progress.show(static_cast<double>(done) / static_cast<double>(all),
                        fmt::format("{} of {} tasks", done, all));
        });
  }
  if (arguments.merge || arguments.shard.empty()) leave_summary(arguments, campaign);
}

}  // namespace

void add_campaign_command(CLI::App& app) {
  const auto arguments = std::make_shared<CampaignArguments>();
  CLI::App* const command =
      app.add_subcommand("campaign", "Fits many measured skies in one way, each by itself.");
  command->add_option("plan", arguments->plan, "Files, grouping and options (docs/campaigns.md)")
      ->required()
      ->type_name("PLAN");
  command->add_option("--out", arguments->out, "Directory of the results; what is there stays")
      ->required()
      ->type_name("DIR");
  auto* const shard = command
                          ->add_option("--shard", arguments->shard,
                                       "Only the K-th of N parts, for one of several machines that "
                                       "share DIR; merge\nwhen all have run")
                          ->type_name("K/N");
  auto* const merge =
      command->add_flag("--merge", arguments->merge, "Only put the results of all parts together")
          ->excludes(shard);
  command
      ->add_option("--slurm", arguments->slurm,
                   "Only write DIR/campaign.slurm, a job array of N parts")
      ->type_name("N")
      ->check(CLI::Range(1, 100'000).description(""))
      ->excludes(shard)
      ->excludes(merge);
  add_threads_option(*command, arguments->threads);
  command->footer(
      "A plan:\n"
      "  {\"skyfit_campaign\": 1, \"inputs\": [\"scans/*.csv\"], \"group\": \"day\",\n"
      "   \"options\": {\"lobes\": 1, \"fix\": [\"ground.albedo=0.2\"]}}\n"
      "Groups: file (the default), scan, day, site. Options are those of skyfit fit. With\n"
      "\"kind\": \"irradiances\" the inputs are tables of irradiances, as of skyfit fit\n"
      "--irradiance, of which every line is a scan. \"irradiances\" names such a table beside "
      "skies,\n"
      "of which the lines of the minute of a scan are fitted with it.\n"
      "\n"
      "Leaves campaign.nc (NetCDF), campaign.csv, campaign.txt and, where times are known,\n"
      "campaign.svg and campaign.png. A task that cannot be fitted is recorded with its reason\n"
      "and stops no other; the exit status is 1 where none could be fitted. Run again, the\n"
      "command does what is missing or changed: results are written in files of 64 tasks in\n"
      "DIR/tasks, each complete or absent.\n"
      "\n"
      "Examples:\n"
      "  skyfit campaign plan.json --out campaign\n"
      "  skyfit campaign plan.json --out campaign --shard 3/10\n"
      "  skyfit campaign plan.json --out campaign --slurm 100");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace skyfit::cli
