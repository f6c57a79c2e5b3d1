// SPDX-License-Identifier: Apache-2.0
#include "room_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <stdexcept>

namespace skyfit::house {
namespace fs = std::filesystem;
namespace {

const std::vector<std::string> kMath = {"Eigen", "nlohmann", "fmt", "tbb", "oneapi", "hwy"};
const std::vector<std::string> kMathLibraries = {
    "Eigen3::", "nlohmann_json::", "fmt::", "TBB::", "hwy", "Threads::"};

// Every one below the top floor of model/.
const std::vector<std::string> kModelRooms = {
    "model/shared",     "model/base",   "model/numerics", "model/geometry",  "model/atmosphere",
    "model/photometry", "model/solver", "model/tables",   "model/literature"};

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

bool is_source(const fs::path& file) {
  static const std::vector<std::string> extensions = {".h",    ".hpp",  ".cc",   ".cpp",  ".inc",
                                                      ".glsl", ".vert", ".frag", ".comp", ".geom"};
  return std::ranges::count(extensions, file.extension().string()) > 0;
}

bool matches(const std::string& name, const std::string& pattern) {
  return pattern.ends_with('*') ? name.starts_with(pattern.substr(0, pattern.size() - 1))
                                : name == pattern;
}

// The room that a path below the top belongs to: the longest of the rules' folders that holds it,
// or "".
std::string room_of(const std::string& path, std::span<const RoomRule> rules) {
  std::string room;
  for (const RoomRule& rule : rules) {
    if (path.starts_with(rule.room + "/") && rule.room.size() > room.size()) room = rule.room;
  }
  return room;
}

// Headers of the standard library and of POSIX: no folder and no extension, or a lower-case name
// such as dlfcn.h.
bool is_system_header(const std::string& name) {
  static const std::regex system(
      "[a-z0-9_]+|(dlfcn|elf|link|unistd|fcntl|glob|signal|spawn|stdlib|string|immintrin)\\.h|sys/"
      "[a-z]+\\.h");
  return std::regex_match(name, system);
}

bool may_include(const std::string& included, bool quoted, const fs::path& top,
                 const fs::path& includer, const RoomRule& rule, std::span<const RoomRule> rules) {
  // A rule may allow one file of a room.
  if (std::ranges::count(rule.rooms, included) > 0) return true;
  const std::string room = room_of(included, rules);
  if (!room.empty()) return room == rule.room || std::ranges::count(rule.rooms, room) > 0;
  if (fs::exists(includer.parent_path() / included)) {
    const fs::path target = fs::weakly_canonical(includer.parent_path() / included);
    const std::string inside = fs::relative(target, fs::weakly_canonical(top)).generic_string();
    const std::string neighbour = room_of(inside, rules);
    return neighbour == rule.room || std::ranges::count(rule.rooms, neighbour) > 0;
  }
  if (is_system_header(included)) return !quoted;
  const std::string first = included.substr(0, included.find('/'));
  return std::ranges::any_of(rule.externals,
                             [&](const std::string& pattern) { return matches(first, pattern); });
}

}  // namespace

std::span<const RoomRule> room_rules() {
  static const std::vector<RoomRule> rules = {
      {"model/shared", {}, {}, {}},
      {"model/base", {}, kMath + std::vector<std::string>{"xxhash.h", "zip.h"}, {}},
      {"model/numerics", {}, kMath, {}},
      {"model/geometry", {"model/shared", "model/numerics"}, kMath, {}},
      {"model/atmosphere",
       {"model/shared", "model/base", "model/numerics", "model/geometry"},
       kMath,
       {}},
      {"model/photometry", {"model/numerics", "model/atmosphere", "model/sky_model.h"}, kMath, {}},
      {"model/solver",
       {"model/shared", "model/numerics", "model/geometry", "model/atmosphere",
        "model/sky_model.h"},
       kMath,
       {}},
      {"model/tables",
       {"model/shared", "model/base", "model/numerics", "model/geometry", "model/atmosphere",
        "model/photometry", "model/solver", "model/sky_model.h"},
       kMath,
       {}},
      {"model/literature",
       {"model/shared", "model/numerics", "model/geometry", "model/atmosphere",
        "model/sky_model.h"},
       kMath,
       {}},
      {"model", kModelRooms, kMath,
       kMathLibraries + std::vector<std::string>{"dl", "PkgConfig::xxHash", "PkgConfig::minizip"}},
      {"data_refs",
       kModelRooms + std::vector<std::string>{"model", "data_refs/image", "fit/exchange/netcdf"},
       kMath, kMathLibraries + std::vector<std::string>{"skyfit::model"}},
      {"data_refs/image",
       {},
       kMath + std::vector<std::string>{"OpenImageIO"},
       kMathLibraries + std::vector<std::string>{"OpenImageIO::"}},
      {"fit", kModelRooms + std::vector<std::string>{"model", "data_refs", "fit/exchange/netcdf"},
       kMath + std::vector<std::string>{"ceres", "glog", "pugixml.hpp", "toml++"},
       kMathLibraries + std::vector<std::string>{"skyfit::model", "skyfit::refs",
                                                 "Ceres::", "pugixml::", "tomlplusplus::"}},
      {"fit/exchange/netcdf",
       {},
       kMath + std::vector<std::string>{"netcdf.h", "netcdf_mem.h", "hdf5.h"},
       kMathLibraries + std::vector<std::string>{"PkgConfig::netCDF"}},
      {"render/dem",
       {},
       kMath + std::vector<std::string>{"cpl_*", "gdal*", "ogr_*"},
       kMathLibraries + std::vector<std::string>{"GDAL::"}},
      {"render", kModelRooms + std::vector<std::string>{"model", "render/dem"},
       kMath + std::vector<std::string>{"glm", "glad", "GL", "EGL", "KHR", "OpenImageIO", "OpenEXR",
                                        "Imath", "Imf*", "tiny_obj_loader.h", "zlib.h"},
       kMathLibraries + std::vector<std::string>{"skyfit::model", "skyfit::render", "skyfit_render",
                                                 "skyfit_glad",
                                                 "glm::", "OpenImageIO::", "OpenEXR::", "Imath::",
                                                 "tinyobjloader::", "ZLIB::", "PkgConfig::OSMesa",
                                                 "PkgConfig::EGL", "OpenGL::"}},
      {"render/plot", kModelRooms + std::vector<std::string>{"model", "data_refs"}, kMath,
       kMathLibraries + std::vector<std::string>{"skyfit::model", "skyfit::refs"}},
      {"cli",
       kModelRooms + std::vector<std::string>{"model", "data_refs", "fit", "fit/exchange/netcdf",
                                              "render", "render/plot"},
       kMath + std::vector<std::string>{"CLI"},
       kMathLibraries + std::vector<std::string>{"CLI11::", "skyfit::", "skyfit_cli"}},
      {"python",
       kModelRooms + std::vector<std::string>{"model", "data_refs", "fit", "render", "cli"},
       kMath + std::vector<std::string>{"CLI", "pybind11"},
       kMathLibraries +
           std::vector<std::string>{"CLI11::", "skyfit::", "skyfit_cli", "pybind11::", "Python::"}},
  };
  return rules;
}

std::vector<fs::path> room_sources(const fs::path& top, const RoomRule& rule,
                                   std::span<const RoomRule> rules) {
  std::vector<fs::path> sources;
  if (!fs::exists(top / rule.room)) return sources;
  for (const auto& entry : fs::recursive_directory_iterator(top / rule.room)) {
    const std::string path = fs::relative(entry.path(), top).generic_string();
    if (entry.is_regular_file() && is_source(entry.path()) && room_of(path, rules) == rule.room) {
      sources.push_back(entry.path());
    }
  }
  std::ranges::sort(sources);
  return sources;
}

std::vector<std::string> include_violations(const fs::path& top, std::span<const RoomRule> rules) {
  static const std::regex include(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"])re");
  std::vector<std::string> violations;
  for (const RoomRule& rule : rules) {
    for (const fs::path& file : room_sources(top, rule, rules)) {
      std::ifstream in(file);
      std::string line;
      for (int number = 1; std::getline(in, line); ++number) {
        std::smatch match;
        if (!std::regex_search(line, match, include)) continue;
        if (may_include(match[2], match[1] == "\"", top, file, rule, rules)) continue;
        violations.push_back(fmt::format("{}:{}: includes {}, which {} may not use",
                                         fs::relative(file, top).generic_string(), number,
                                         match[2].str(), rule.room));
      }
    }
  }
  return violations;
}

std::vector<std::string> link_violations(const fs::path& links, std::span<const RoomRule> rules) {
  std::ifstream in(links);
  if (!in) throw std::runtime_error(links.string() + ": cannot be read");
  std::vector<std::string> violations;
  std::string room, target, library;
  while (in >> room >> target >> library) {
    const auto rule = std::ranges::find(rules, room, &RoomRule::room);
    if (rule == rules.end()) {
      violations.push_back(fmt::format("{}: no rule for this room", room));
      continue;
    }
    // $<BUILD_INTERFACE:x> and $<LINK_ONLY:x> are judged by x.
    if (library.starts_with("$<")) {
      const std::size_t start = library.find(':') + 1;
      library = library.substr(start, library.rfind('>') - start);
    }
    const bool allowed = library == "skyfit_warnings" ||
                         std::ranges::any_of(rule->libraries, [&](const std::string& prefix) {
                           return library.starts_with(prefix);
                         });
    if (!allowed)
      violations.push_back(fmt::format("{}: {} links {}, which it may not", room, target, library));
  }
  return violations;
}

}  // namespace skyfit::house
