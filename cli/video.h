// SPDX-License-Identifier: Apache-2.0
// A video of numbered pictures, by ffmpeg.
#pragma once

#include <filesystem>
#include <string>

namespace skyfit::cli {

// DIR/frame_00000.png .. to DIR/sequence.mp4 (H.264, 4:2:0, even sides), whole or not at all.
// Throws std::runtime_error with ffmpeg's own words.
std::filesystem::path make_video(const std::filesystem::path& ffmpeg,
                                 const std::filesystem::path& directory, int frames,
                                 double frames_per_second);

// The command that a user would type to make it.
std::string video_command(const std::filesystem::path& directory, int frames,
                          double frames_per_second);

}  // namespace skyfit::cli
