// SPDX-License-Identifier: Apache-2.0
#include "cli/video.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "render/plot/whole_files.h"

namespace skyfit::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVideo = "sequence.mp4";

// Sides that 4:2:0 can halve: one pixel more where they are odd.
std::vector<std::string> arguments(const fs::path& directory, int frames, double frames_per_second,
                                   const fs::path& video) {
  return {"-loglevel",
          "error",
          "-y",
          "-framerate",
          fmt::format("{:.9g}", frames_per_second),
          "-start_number",
          "0",
          "-i",
          (directory / "frame_%05d.png").string(),
          "-frames:v",
          fmt::to_string(frames),
          "-vf",
          "pad=ceil(iw/2)*2:ceil(ih/2)*2",
          "-c:v",
          "libx264",
          "-pix_fmt",
          "yuv420p",
          "-movflags",
          "+faststart",
          video.string()};
}

// Runs a program with stdin empty and both outputs in a file; its exit status.
int run(const fs::path& program, std::vector<std::string> texts, const fs::path& log) {
  texts.insert(texts.begin(), program.string());
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int error =
      posix_spawn(&child, program.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw std::runtime_error(
        fmt::format("{}: cannot run: {}", program.string(), std::strerror(error)));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

std::optional<fs::path> program_in_path(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder.empty() ? "." : folder) / name;
    if (!fs::is_directory(program) && ::access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

fs::path make_video(const fs::path& ffmpeg, const fs::path& directory, int frames,
                    double frames_per_second) {
  const fs::path video = directory / kVideo;
  plot::WholeFiles whole({video});
  // Not among the targets: it is removed in any case.
  const plot::WholeFiles log({directory / "ffmpeg.log"});
  const int status =
      run(ffmpeg, arguments(directory, frames, frames_per_second, whole.temporary(0)),
          log.temporary(0));
  if (status != 0) {
    std::string first;
    std::ifstream in(log.temporary(0));
    std::getline(in, first);
    throw std::runtime_error(fmt::format("{}: ffmpeg: exit status {}: {}", video.string(), status,
                                         first.empty() ? "no message" : first));
  }
  whole.commit();
  return video;
}

std::string video_command(const fs::path& directory, int frames, double frames_per_second) {
  std::string command = "ffmpeg";
  for (const std::string& text :
       arguments(directory, frames, frames_per_second, directory / kVideo)) {
    const bool plain = text.find_first_of(" ()*'\"\\$&;") == std::string::npos;
    command += plain ? " " + text : fmt::format(" \"{}\"", text);
  }
  return command;
}

}  // namespace skyfit::cli
