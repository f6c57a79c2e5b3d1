// SPDX-License-Identifier: Apache-2.0
#include "cli/video.h"

#include <fmt/format.h>

#include <vector>

#include "model/base/input_file.h"
#include "model/base/process.h"
#include "model/base/text.h"
#include "model/base/whole_file.h"

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

// The boxes of an MP4 file fill it, and one says where the frames are.
bool is_complete(const std::string& video) {
  bool has_index = false;
  std::size_t at = 0;
  while (at + 8 <= video.size()) {
    std::size_t size = 0, header = 4;
    const auto read = [&](std::size_t begin, std::size_t bytes) {
      size = 0;
      for (std::size_t i = begin; i < begin + bytes; ++i)
        size = size << 8 | static_cast<unsigned char>(video[i]);
    };
    read(at, header);
    if (size == 1 && at + 16 <= video.size()) read(at + 8, 8);
    has_index |= video.compare(at + 4, 4, "moov") == 0;
    if (size < 8 || size > video.size() - at) return false;
    at += size;
  }
  return has_index && at == video.size();
}

}  // namespace

fs::path make_video(const fs::path& ffmpeg, const fs::path& directory, int frames,
                    double frames_per_second) {
  const fs::path video = directory / kVideo;
  WholeFiles whole({video});
  // Where the frames lie, so that no name but our own is a pattern or a protocol to ffmpeg.
  const fs::path drawn = whole.temporary(0);
  const Outcome outcome = run(
      {ffmpeg,
       arguments({}, frames, frames_per_second, drawn.parent_path().filename() / drawn.filename()),
       "", directory});
  if (!outcome.succeeded()) {
    const auto words = trim(outcome.output);
    whole.fail(0, fmt::format("ffmpeg: {}: {}", outcome.ending(),
                              words.empty() ? "no message" : excerpt(split(words, '\n').front())));
  }
  if (!is_complete(read_file(drawn, "a film", kMostImageBytes)))
    whole.fail(0, "ffmpeg left half a film, as on a full disk");
  whole.publish();
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
