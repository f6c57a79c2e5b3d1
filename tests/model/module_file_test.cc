// SPDX-License-Identifier: Apache-2.0
// A module that is not there, or is no module, is one line that says so.
#include "model/base/module_file.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

namespace skyfit {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(ModuleFile, ThatIsNotThereIsNamed) {
  EXPECT_THAT(
      [] { open_module("skyfit_no_module"); },
      ThrowsMessage<std::runtime_error>("skyfit_no_module.so is not installed with this program"));
}

// The program of a test lies in a folder of the build directory.
const std::filesystem::path kTests = std::filesystem::read_symlink("/proc/self/exe").parent_path();

TEST(ModuleFile, ThatIsNoLibraryIsNamed) {
  const std::filesystem::path file = kTests.parent_path() / "skyfit_text_module.so";
  std::ofstream(file) << "text";
  EXPECT_THAT([] { open_module("skyfit_text_module"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("cannot load " + file.string())));
  std::filesystem::remove(file);
}

TEST(ModuleFile, IsNotLookedForElsewhere) {
  for (const auto& folder :
       {kTests, kTests.parent_path().parent_path(), std::filesystem::current_path()}) {
    if (folder == kTests.parent_path()) continue;
    const std::filesystem::path file = folder / "skyfit_other_module.so";
    std::ofstream(file) << "text";
    EXPECT_THAT([] { open_module("skyfit_other_module"); },
                ThrowsMessage<std::runtime_error>(HasSubstr("is not installed")));
    std::filesystem::remove(file);
  }
}

}  // namespace
}  // namespace skyfit
