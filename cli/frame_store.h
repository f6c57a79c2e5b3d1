// SPDX-License-Identifier: Apache-2.0
// The frames of a sequence in a directory, and frames.json, which says what each was drawn from: a
// frame that is there and was asked for in the same way is not drawn again.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/render_request.h"
#include "render/sequence/timeline.h"

namespace skyfit::cli {

// Of everything that the pixels of a frame depend on but the exposure: scene with the content of
// its files, camera, sun, timeline, picture, model and version. Textures that drawing would make
// are made by the constructor, so that they count from the first frame on.
class Fingerprints {
 public:
  explicit Fingerprints(const RenderRequest& request, const std::vector<TimelineStep>& timeline);
  std::string of(const Shot& shot, double time_s) const;

 private:
  const std::vector<TimelineStep>& timeline_;
  const int update_frames_;  // 0: tables do not depend on earlier frames
  const double frames_per_second_;
  nlohmann::ordered_json common_;
};

class FrameStore {
 public:
  struct Entry {
    std::string request;  // its fingerprint
    double metered = 0;   // its own exposure, m^2/cd
    double exposure = 0;  // that it was written with
  };

  // Makes the directory, which goes again if nothing is written. Throws std::runtime_error that
  // names what cannot be written or read.
  FrameStore(std::filesystem::path directory, std::vector<std::string> extensions);
  ~FrameStore();
  FrameStore(const FrameStore&) = delete;
  FrameStore& operator=(const FrameStore&) = delete;

  // What is known of a frame that was drawn for this request and whose files are there.
  std::optional<Entry> find(int frame, const std::string& request) const;

  // Writes the files and notes the entry; both or neither.
  void write(int frame, const Entry& entry, const Frame& picture, ToneOptions tone);

  // Whether the video that was noted last was of these frames as they are now.
  bool has_video(int frames, double frames_per_second) const;
  void note_video(int frames, double frames_per_second);

 private:
  std::string video_of(int frames, double frames_per_second) const;
  std::string manifest() const;
  std::vector<std::filesystem::path> files_of(int frame) const;

  std::filesystem::path directory_;
  std::vector<std::string> extensions_;
  nlohmann::ordered_json frames_;
  std::string video_;
  bool made_ = false;
};

}  // namespace skyfit::cli
