// SPDX-License-Identifier: Apache-2.0
#include "cli/video.h"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

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

// The boxes of an MP4 file, of big-endian sizes, fill it, and one says where the frames are.
bool is_complete(const fs::path& video) {
  std::error_code none;
  const std::uintmax_t end = fs::file_size(video, none);
  std::ifstream in(video, std::ios::binary);
  const auto big_endian = [&](int bytes) {
    std::uintmax_t number = 0;
    while (bytes-- > 0) number = number << 8 | static_cast<unsigned char>(in.get());
    return number;
  };
  bool has_index = false;
  for (std::uintmax_t at = 0; in.seekg(static_cast<std::streamoff>(at));) {
    if (at == end) return has_index;
    constexpr std::uintmax_t kLarge = 1;  // the size follows, in 8 bytes
    std::uintmax_t size = big_endian(4);
    std::string kind(4, '\0');
    in.read(kind.data(), 4);
    if (size == kLarge) size = big_endian(8);
    if (!in || size < 8 || size > end - at) return false;
    has_index |= kind == "moov";
    at += size;
  }
  return false;
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
  if (!is_complete(drawn)) whole.fail(0, "ffmpeg left half a video, as on a full disk");
  whole.publish();
  return video;
}

std::string video_command(const fs::path& directory, int frames, double frames_per_second) {
  constexpr std::string_view kPlain =
      "+,-./:=_%0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
  std::string command = "ffmpeg";
  for (const std::string& text :
       arguments(directory, frames, frames_per_second, directory / kVideo)) {
    const bool plain = text.find_first_not_of(kPlain) == std::string::npos;
    command += plain ? " " + text : " '";
    if (plain) continue;
    for (const char c : text) command += c == '\'' ? "'\\''" : std::string(1, c);
    command += '\'';
  }
  return command;
}

}  // namespace skyfit::cli
