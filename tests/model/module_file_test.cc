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

TEST(ModuleFile, ThatIsNoLibraryIsNamed) {
  const std::filesystem::path file =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "skyfit_text_module.so";
  std::ofstream(file) << "text";
  EXPECT_THAT([] { open_module("skyfit_text_module"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("skyfit_text_module.so")));
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace skyfit
