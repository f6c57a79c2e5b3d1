// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "cli/frame_statistics.h"
#include "cli/frame_store.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/render_arguments.h"
#include "cli/render_modes.h"
#include "cli/render_session.h"
#include "cli/video.h"
#include "model/base/process.h"
#include "model/base/text.h"
#include "render/sequence/exposure.h"

namespace skyfit::cli {
namespace {

// Exposures that differ less cannot be told apart in 8 bits.
constexpr double kSameExposure = 1e-6;

// Draws what is missing, frame by frame.
class Shooting {
 public:
  explicit Shooting(const RenderRequest& request)
      : request_(request),
        timeline_(timeline_of(request.sequence)),
        fingerprints_(request, timeline_),
        store_(request.out_dir, request.extensions),
        adaptation_(request.adaptation_s) {}

  int drawn() const { return drawn_; }
  const std::string& device() const { return device_; }
  const StatisticsTable& statistics() const { return statistics_; }
  const TimeAccount& time() const { return time_; }
  FrameStore& store() { return store_; }

  void frame(int number, Progress& progress) {
    const double time_s = request_.sequence.time_s(number);
    const Shot shot = shot_at(request_.sequence, time_s, sun_over);
    const std::string fingerprint = fingerprints_.of(shot, time_s);
    if (const auto kept = store_.find(number, fingerprint)) {
      const double exposure = exposure_after(number, kept->metered);
      const bool exposed = std::ranges::count(request_.extensions, ".png") > 0;
      if (!exposed || std::abs(kept->exposure / exposure - 1) < kSameExposure) return;
      draw(number, shot, time_s, fingerprint, exposure, progress);
      return;
    }
    draw(number, shot, time_s, fingerprint, {}, progress);
  }

 private:
  double exposure_after(int number, double metered) {
    if (request_.tone.exposure) return *request_.tone.exposure;
    return adaptation_.next(metered,
                            scene_seconds(request_.sequence, std::max(number - 1, 0), number));
  }

  // Without an exposure: that which follows from the frame.
  void draw(int number, const Shot& shot, double time_s, const std::string& fingerprint,
            std::optional<double> exposure, Progress& progress) {
    const int frames = request_.sequence.frames;
    const auto show = [&](double done) {
      progress.show((number + done) / frames, fmt::format("frame {} of {}", number + 1, frames));
    };
    show(0);
    time_.done("frames that are kept");
    if (!session_)
      session_.emplace(request_, timeline_, time_s, time_, [](double, std::string_view) {});
    const Frame picture = session_->draw(shot, time_s, show);
    const double metered = metered_exposure(picture);
    if (!exposure) exposure = exposure_after(number, metered);
    store_.write(number, {fingerprint, metered, *exposure}, picture, request_.tone);
    time_.done("files");
    ++drawn_;
    device_ = picture.statistics.device;
    if (request_.stats) print(statistics_.row(number, picture.statistics));
  }

  const RenderRequest& request_;
  TimeAccount time_;
  std::vector<TimelineStep> timeline_;
  Fingerprints fingerprints_;
  FrameStore store_;
  Adaptation adaptation_;
  StatisticsTable statistics_;
  std::optional<RenderSession> session_;  // opened by the first frame that is drawn
  std::string device_;
  int drawn_ = 0;
};

// The video, or how to make it: a clause for the summary.
std::string film(const RenderRequest& request, FrameStore& store) {
  if (std::ranges::count(request.extensions, ".png") == 0) return {};
  const std::filesystem::path directory = request.out_dir;
  const int frames = request.sequence.frames;
  const double rate = request.sequence.frames_per_second;
  const auto ffmpeg = program_in_path("ffmpeg");
  if (!ffmpeg) {
    fmt::print(stderr, "skyfit: no ffmpeg in PATH, so no video is made; to make it: {}\n",
               printable(video_command(directory, frames, rate)));
    return {};
  }
  const std::filesystem::path video = directory / "sequence.mp4";
  if (!std::filesystem::exists(video) || !store.has_video(frames, rate)) {
    make_video(*ffmpeg, directory, frames, rate);
    store.note_video(frames, rate);
  }
  return fmt::format(", video {}", video.string());
}

}  // namespace

void render_sequence(const RenderRequest& request) {
  const int frames = request.sequence.frames;
  Shooting shooting(request);
  {
    Progress progress("rendering");
    for (int i = 0; i < frames; ++i) shooting.frame(i, progress);
  }
  report_frames(shooting.statistics().medians(), shooting.device(), shooting.time(), request);
  print(fmt::format("{}: {} frames at {:.9g} per second, {} drawn, {} kept{}\n", request.out_dir,
                    frames, request.sequence.frames_per_second, shooting.drawn(),
                    frames - shooting.drawn(), film(request, shooting.store())));
}

}  // namespace skyfit::cli
