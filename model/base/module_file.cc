// SPDX-License-Identifier: Apache-2.0
#include "model/base/module_file.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

namespace skyfit {
namespace {

namespace fs = std::filesystem;

// The file that holds this code: the program, or a library that a program such as Python has
// loaded.
struct Holder {
  fs::path file;
  bool is_library;
};
Holder holder() {
  Dl_info info;
  link_map* map = nullptr;
  std::error_code none;
  const bool found = dladdr1(reinterpret_cast<const void*>(&holder), &info,
                             reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) != 0;
  // The program itself has no name there.
  if (found && map != nullptr && *map->l_name != '\0')
    return {fs::canonical(map->l_name, none), true};
  return {fs::read_symlink("/proc/self/exe", none), false};
}

// Where the build or the installation put the modules, in the order of trial. An installation may
// have been moved as a whole: its library directory is known relative to that of its programs.
std::vector<fs::path> module_directories() {
  std::error_code none;
  const auto [file, is_library] = holder();
  const fs::path build = fs::weakly_canonical(SKYFIT_MODULE_BUILD_DIR, none);
  std::vector<fs::path> directories;
  const fs::path folder = file.parent_path();
  if (is_library) directories.push_back(folder);
  if (folder.filename() == SKYFIT_PROGRAM_SUBDIR)
    directories.push_back(folder.parent_path() / SKYFIT_MODULE_SUBDIR);
  const bool is_of_build = std::ranges::mismatch(build, file).in1 == build.end();
  directories.emplace_back(is_of_build ? build : fs::path(SKYFIT_MODULE_DIR));
  return directories;
}

}  // namespace

const void* open_module(const std::string& name) {
  const std::string file_name = name + ".so";
  for (const fs::path& directory : module_directories()) {
    const fs::path file = directory / file_name;
    std::error_code none;
    if (!fs::exists(file, none)) continue;
    void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) throw std::runtime_error(fmt::format("cannot load {}", dlerror()));
    using Entry = const void* (*)();
    const auto entry = reinterpret_cast<Entry>(dlsym(handle, name.c_str()));
    if (entry == nullptr) {
      throw std::runtime_error(
          fmt::format("{}: belongs to another version of skyfit", file.string()));
    }
    return entry();
  }
  throw std::runtime_error(fmt::format("{} is not installed with this program", file_name));
}

}  // namespace skyfit
