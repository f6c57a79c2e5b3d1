// SPDX-License-Identifier: Apache-2.0
// What the program does to files: names are never commands, data files name files of their own
// folder only, a full disk leaves the old result and a message, signals leave nothing behind.
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <thread>

#include "tests/cli/program.h"

namespace skyfit::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class FilesTest : public ProgramTest {
 protected:
  void fit(const std::string& directory) const {
    const Outcome outcome =
        run({"fit", "--reference", "cie:12", "--sun-zenith-deg", "40", "--lobes", "1", "--starts",
             "1", "--max-iterations", "2", "--free", "ground.albedo", "--model", "hoffman-preetham",
             "--out", directory});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }

  // Runs the program in a child where files cannot grow beyond `bytes`.
  Outcome run_on_full_disk(const std::vector<std::string>& arguments, rlim_t bytes) const {
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    const auto handler = ::signal(SIGXFSZ, SIG_DFL);
    const rlimit limit = {bytes, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const Outcome outcome = run(arguments);
    ::setrlimit(RLIMIT_FSIZE, &before);
    ::signal(SIGXFSZ, handler);
    return outcome;
  }

  // Starts the program, ends it with a signal once `ready`, and returns its wait status.
  int end_with(int signal, const std::vector<std::string>& arguments,
               const std::function<bool()>& ready) const {
    const pid_t child = ::fork();
    if (child == 0) {
      if (::chdir(folder_.c_str()) != 0) ::_exit(1);
      std::vector<std::string> texts = {SKYFIT_PROGRAM};
      texts.insert(texts.end(), arguments.begin(), arguments.end());
      std::vector<char*> pointers;
      for (std::string& text : texts) pointers.push_back(text.data());
      pointers.push_back(nullptr);
      ::signal(signal, SIG_DFL);  // a shell may have started the tests in the background
      ::execv(SKYFIT_PROGRAM, pointers.data());
      ::_exit(1);
    }
    for (int i = 0; i < 600 && !ready(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_TRUE(ready());
    ::kill(child, signal);
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
  }

  bool has_temporary() const {
    for (const std::string& name : files())
      if (name.find(".skyfit-") != name.npos) return true;
    return false;
  }
};

TEST_F(FilesTest, NamesAreNoCommands) {
  fit("fitted");
  for (const std::string& directory :
       std::vector<std::string>{"|touch pwned;#", "~", "$(touch pwned)", "`touch pwned`", "-x"}) {
    fs::create_directory(folder_ / directory);
    const Outcome outcome =
        run({"plot", "fitted", "--out", directory + "/a.png", "--out=./" + directory + "/a.svg"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(folder_ / directory / "a.png"));
    EXPECT_TRUE(fs::exists(folder_ / directory / "a.svg"));
  }
  fit("|touch pwned;");  // draws into a directory of that name
  EXPECT_TRUE(fs::exists(folder_ / "|touch pwned;/comparison.png"));
  for (const std::string& name : files()) EXPECT_NE(fs::path(name).filename(), "pwned");
  EXPECT_FALSE(has_temporary());
}

constexpr const char* kPresetWithCsv = R"({"skyfit_preset": 2, "name": "x",
  "planet": {"bottom_radius_m": 6360000, "top_radius_m": 6420000}, "constituents": [],
  "ground": {"albedo": 0.1, "spectrum": {"type": "tabulated", "csv": "%"}}})";

std::string preset_with(const std::string& csv) {
  std::string text = kPresetWithCsv;
  return text.replace(text.find('%'), 1, csv);
}

TEST_F(FilesTest, APresetReadsFilesOfItsFolderOnly) {
  const std::string table = "wavelength_nm,relative_albedo\n400,0.5\n700,1\n";
  write("data/table.csv", table);
  write("secret.csv", "SECRET=token\n1\n");
  fs::create_symlink("../secret.csv", folder_ / "data/link.csv");
  write("data/preset.json", preset_with("table.csv"));
  EXPECT_EQ(run({"check", "data/preset.json"}).status, 0);
  for (const std::string& name : {std::string("/proc/self/environ"), std::string("../secret.csv"),
                                  std::string("link.csv"), (folder_ / "secret.csv").string()}) {
    write("data/preset.json", preset_with(name));
    expect_refusal({"check", "data/preset.json"},
                   {"data/preset.json:3: ground.spectrum.csv = \"" + name.substr(0, 60),
                    "expected a file in the folder of the one that names it, or --allow-paths"});
    EXPECT_THAT(run({"check", "data/preset.json"}).err, Not(HasSubstr("SECRET")));
  }
  write("table.csv", table);
  write("data/preset.json", preset_with("../table.csv"));
  EXPECT_EQ(run({"check", "data/preset.json", "--allow-paths"}).status, 0);
  EXPECT_EQ(run({"--allow-paths", "check", "data/preset.json"}).status, 0);
}

TEST_F(FilesTest, ASidecarASequenceAndAMeshReadFilesOfTheirFolderOnly) {
  const std::string outside = (capture_ / "outside").string();
  std::ofstream(outside) << "SECRET";
  fs::copy_file(std::string(SKYFIT_EXAMPLES) + "fisheye.exr", folder_ / "sky.exr");
  std::ifstream in(std::string(SKYFIT_EXAMPLES) + "fisheye.exr.sidecar.json");
  std::string sidecar((std::istreambuf_iterator<char>(in)), {});
  sidecar.replace(sidecar.find("fisheye_mask.png"), 16, outside);
  write("sky.exr.sidecar.json", sidecar);
  expect_refusal({"check", "sky.exr"}, {"sky.exr.sidecar.json: mask = ", "--allow-paths"});

  write("sequence.json",
        R"({"skyfit_sequence": 1, "frames": 2, "frames_per_second": 25, "keyframes": [)"
        R"({"time_s": 0, "preset": ")" +
            outside + R"("}, {"time_s": 1}]})");
  expect_refusal({"render", "--sequence", "sequence.json", "--out-dir", "frames"},
                 {"sequence.json", "preset = ", "--allow-paths"});

  write("mesh.obj", "mtllib " + outside + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_refusal({"render", "--preset", "earth-clear", "--size", "16x16", "--mesh",
                  "mesh.obj@0,0,10", "--out", "frame.png"},
                 {"mesh.obj: mtllib ", "--allow-paths"});
}

TEST_F(FilesTest, PipesAndDevicesAreRefused) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.json").c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo((folder_ / "pipe.csv").c_str(), 0600), 0);
  for (const std::string& file : std::vector<std::string>{"pipe.json", "pipe.csv", "/dev/zero"}) {
    const std::string reason = file + ": cannot be read (it is a pipe or a device)";
    expect_refusal({"check", file}, {reason});
    expect_refusal({"fit", "--reference", file, "--out", "x"}, {reason});
    expect_refusal({"sky", "--preset", file, "--sun-zenith-deg", "0", "--view-zenith-deg", "0"},
                   {reason});
    for (const char* option : {"--height-map", "--dem"})
      expect_refusal({"render", "--preset", "earth-clear", option, file, "--out", "x.png"},
                     {reason});
    expect_refusal({"render", "--sequence", file, "--out-dir", "x"}, {reason});
  }
}

TEST_F(FilesTest, ControlBytesDoNotReachTheTerminal) {
  write("x.json", "{\"\x1b[2J\\u001b]0;title\\u0007\": 1}");
  for (const std::string& file :
       std::vector<std::string>{"x.json", "\x1b[31mred.json", "\xff.json"}) {
    const Outcome outcome = run({"check", file});
    EXPECT_NE(outcome.status, 0);
    for (const char c : outcome.err) EXPECT_TRUE(c == '\n' || (c >= ' ' && c != '\x7f')) << file;
  }
}

TEST_F(FilesTest, AFullDiskLeavesTheOldFigureAndAMessage) {
  fit("fitted");
  for (const std::string& name :
       std::vector<std::string>{"figure.png", "figure.svg", "figure.pdf"}) {
    write(name, "the old one");
    const Outcome outcome = run_on_full_disk({"plot", "fitted", "--out", name}, 8192);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr(name + ": cannot be written: "));
    EXPECT_EQ(read(name), "the old one");
  }
  for (const std::string& name : std::vector<std::string>{"frame.png", "frame.exr"}) {
    write(name, "the old one");
    const Outcome outcome = run_on_full_disk(
        {"render", "--preset", "earth-clear", "--size", "160x90", "--out", name}, 4096);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr(name + ": cannot be written: "));
    EXPECT_EQ(read(name), "the old one");
  }
  EXPECT_FALSE(has_temporary());
}

// A whole line, and an exit of the program's own: HDF5 is not left with a file that it cannot
// close.
TEST_F(FilesTest, AFullDiskLeavesTheOldNetcdfAndAMessage) {
  write("sky.nc", "the old one");
  const Outcome outcome =
      run_on_full_disk({"-q", "sky", "--preset", "earth-clear", "--sun-zenith-deg", "40",
                        "--view-zenith-deg", "0:80:2", "--netcdf", "sky.nc"},
                       1024);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "skyfit: error: sky.nc: cannot be written: File too large\n");
  EXPECT_EQ(read("sky.nc"), "the old one");
  EXPECT_FALSE(has_temporary());
}

TEST_F(FilesTest, AFullDiskLeavesTheOldResultAndAMessage) {
  fit("fitted");
  const std::string before = read("fitted/report.json");
  const Outcome outcome =
      run_on_full_disk({"fit", "--reference", "cie:12", "--sun-zenith-deg", "40", "--lobes", "1",
                        "--starts", "1", "--max-iterations", "2", "--free", "ground.albedo",
                        "--model", "hoffman-preetham", "--out", "fitted"},
                       2000);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("fitted/"));
  EXPECT_THAT(outcome.err, HasSubstr("cannot be written: File too large"));
  EXPECT_EQ(read("fitted/report.json"), before);
  EXPECT_FALSE(has_temporary());
}

TEST_F(FilesTest, AFullDiskBehindStdoutIsAnError) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help"}, {"sky", "--help"}, {"--version"}, {"presets"}}) {
    const Outcome outcome = run(arguments, {}, "/dev/full");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("stdout: not everything could be written: No space left"));
  }
}

TEST_F(FilesTest, ASignalLeavesNothing) {
  for (const auto& [signal, status] : {std::pair{SIGINT, 130}, {SIGTERM, 143}}) {
    const int ended = end_with(signal,
                               {"render", "--preset", "earth-clear", "--size", "128x128", "--date",
                                "2024-06-21", "--time", "04:00..20:00", "--latitude-deg", "47",
                                "--longitude-deg", "8", "--frames", "200", "--out-dir", "frames"},
                               [&] { return fs::exists(folder_ / "frames/frames.json"); });
    EXPECT_TRUE(WIFEXITED(ended));
    EXPECT_EQ(WEXITSTATUS(ended), status);
    EXPECT_FALSE(has_temporary());
    fs::remove_all(folder_ / "frames");
  }
}

}  // namespace
}  // namespace skyfit::cli
