// SPDX-License-Identifier: Apache-2.0
// `skyfit doctor`: what of an installation works.
#include <fmt/format.h>

#include <cstddef>
#include <functional>
#include <span>
#include <stdexcept>

#include "cli/commands.h"
#include "cli/output.h"
#include "model/base/content_cache.h"
#include "model/base/process.h"
#include "model/base/text.h"
#include "model/version.h"
#include "render/render.h"

namespace skyfit::cli {
namespace {

// What `program --version` (or the like) says first. Throws std::runtime_error where it cannot run.
std::string program_version(std::string_view name, const std::string& option) {
  const auto program = program_in_path(name);
  if (!program) throw std::runtime_error("no such program");
  const Outcome outcome = run({*program, {option}, {}, {}});
  if (!outcome.succeeded()) throw std::runtime_error(outcome.ending());
  return printable(outcome.output.substr(0, outcome.output.find('\n')));
}

// A line of the doctor's; whether it is well.
bool examine(std::string_view what, const std::function<std::string()>& look) {
  try {
    print(fmt::format("ok      {}: {}\n", what, look()));
    return true;
  } catch (const std::exception& error) {
    print(fmt::format("missing {}: {}\n", what, error.what()));
    return false;
  }
}

std::string renderer_of(GraphicsDevice device) {
  return fmt::format("draws with {}", printable(Renderer({}, device).device()));
}

// Where the cache is and how large; that there is none is no fault.
std::string cache_line() {
  const auto directory = user_cache_directory();
  if (!directory) return fmt::format("none    cache of frames and particles: {}\n", kNoCachePlace);
  constexpr double kMegabyte = 1e6;
  ContentCache cache(*directory);
  cache.find(CacheKey("doctor"), [](std::size_t, std::uint64_t) { return std::span<std::byte>(); });
  if (const auto trouble = cache.trouble())
    return fmt::format("none    cache of frames and particles: {}\n", printable(*trouble));
  const ContentCache::Usage usage = cache.usage();
  return fmt::format(
      "ok      cache of frames and particles: {}, {} entries, {:.1f} MB of at most {:.0f} MB\n",
      printable(directory->string()), usage.entries, static_cast<double>(usage.bytes) / kMegabyte,
      static_cast<double>(cache.limit_bytes()) / kMegabyte);
}

void run_doctor() {
  print(fmt::format("skyfit {}\n", kVersion));
  bool well = examine("figures (gnuplot)", [] { return program_version("gnuplot", "--version"); });
  well &= examine("frames, software", [] { return renderer_of(GraphicsDevice::kSoftware); });
  examine("frames by EGL, a GPU or Mesa (--gpu)", [] { return renderer_of(GraphicsDevice::kGpu); });
  well &= examine("digital elevation models", [] { return dem_library(); });
  examine("videos (ffmpeg)", [] { return program_version("ffmpeg", "-version"); });
  print(cache_line());
  if (!well) throw std::runtime_error("something that skyfit needs is missing");
}

}  // namespace

void add_doctor_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("doctor", "Says what of this installation works.");
  command.footer("The exit status is 1 where something is missing that figures or frames need.");
  command.callback([] { run_doctor(); });
}

}  // namespace skyfit::cli
