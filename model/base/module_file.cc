// SPDX-License-Identifier: Apache-2.0
#include "model/base/module_file.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <system_error>
#include <vector>

namespace skyfit {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> candidates(const std::string& file) {
  std::vector<fs::path> files;
  std::error_code none;
  fs::path directory = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (int level = 0; level < 3 && !directory.empty(); ++level) {
    files.push_back(directory / file);
    files.push_back(directory / SKYFIT_MODULE_SUBDIR / file);
    directory = directory.parent_path();
  }
  files.push_back(fs::path(SKYFIT_MODULE_DIR) / file);
  return files;
}

}  // namespace

const void* open_module(const std::string& name) {
  const std::string file_name = name + ".so";
  for (const fs::path& file : candidates(file_name)) {
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
