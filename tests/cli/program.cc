// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

extern char** environ;

namespace skyfit::cli {
namespace fs = std::filesystem;
namespace {

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

}  // namespace

Outcome ProgramTest::run(const std::vector<std::string>& arguments,
                         const std::vector<std::string>& environment, const std::string& out,
                         const std::string& in) const {
  std::vector<std::string> argv = {SKYFIT_PROGRAM};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  std::vector<std::string> env = environment;  // the first of a name counts
  env.emplace_back("XDG_CACHE_HOME=" SKYFIT_TEST_CACHES);
  env.emplace_back("MESA_SHADER_CACHE_DIR=" SKYFIT_TEST_CACHES);  // wherever the other is
  for (char** variable = environ; *variable != nullptr; ++variable) env.emplace_back(*variable);

  const fs::path out_file = out.empty() ? capture_ / "out" : fs::path(out),
                 err_file = capture_ / "err";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, in.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0600);
  posix_spawn_file_actions_addopen(&actions, 2, err_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0600);
  posix_spawn_file_actions_addchdir_np(&actions, folder_.c_str());
  pid_t child = 0;
  const int spawned = posix_spawn(&child, SKYFIT_PROGRAM, &actions, nullptr, pointers(argv).data(),
                                  pointers(env).data());
  posix_spawn_file_actions_destroy(&actions);
  if (spawned != 0) throw std::runtime_error("cannot run " SKYFIT_PROGRAM);
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, out.empty() ? text_of(out_file) : "",
          text_of(err_file)};
}

std::string ProgramTest::output(const std::vector<std::string>& arguments) const {
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  return outcome.out;
}

void ProgramTest::expect_refusal(const std::vector<std::string>& arguments,
                                 const std::vector<std::string>& texts) const {
  const std::set<std::string> before = files();
  const Outcome outcome = run(arguments);
  SCOPED_TRACE(::testing::PrintToString(arguments));
  EXPECT_GT(outcome.status, 0);
  EXPECT_THAT(outcome.err, ::testing::StartsWith("skyfit: error: "));
  EXPECT_EQ(lines(outcome.err).size(), 1u) << outcome.err;
  for (const std::string& text : texts) EXPECT_THAT(outcome.err, ::testing::HasSubstr(text));
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(files(), before);
}

fs::path ProgramTest::write(const std::string& name, const std::string& text) const {
  fs::create_directories((folder_ / name).parent_path());
  std::ofstream(folder_ / name, std::ios::binary) << text;
  return folder_ / name;
}

std::string ProgramTest::read(const std::string& name) const { return text_of(folder_ / name); }

std::set<std::string> ProgramTest::files() const {
  std::set<std::string> result;
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
    result.insert(fs::relative(entry.path(), folder_).generic_string());
  }
  return result;
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) result.push_back(line);
  return result;
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) result.push_back(field);
  return result;
}

}  // namespace skyfit::cli
