// SPDX-License-Identifier: Apache-2.0
// A damaged or cut NetCDF file of a classic format is refused before the library reads it.
#include "data_refs/netcdf_header.h"

#include <gmock/gmock.h>

#include <stdexcept>
#include <string>

#include "fit/exchange/netcdf/netcdf_module.h"
#include "model/base/module_file.h"
#include "model/base/temporary_directory.h"
#include "model/base/whole_file.h"

namespace skyfit::refs {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string number(unsigned value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16),
          static_cast<char>(value >> 8), static_cast<char>(value)};
}
std::string name(std::string text) {
  const auto length = static_cast<unsigned>(text.size());
  text.resize((text.size() + 3) / 4 * 4, '\0');
  return number(length) + text;
}

// CDF-1 with two records of `time`, of a short each, and a fixed `level` of three floats.
std::string sound_file() {
  constexpr unsigned kDimension = 10, kVariable = 11, kAttribute = 12, kShort = 3, kFloat = 5;
  std::string head = "CDF\x01" + number(2) + number(kDimension) + number(2) + name("time") +
                     number(0) + name("level") + number(3) + number(kAttribute) + number(1) +
                     name("note") + number(2) + name("hi") + number(kVariable) + number(2);
  const std::string time = name("time") + number(1) + number(0) + number(0) + number(0) +
                           number(kShort) + number(4),
                    level = name("level") + number(1) + number(1) + number(0) + number(0) +
                            number(kFloat) + number(12);
  const auto begin = static_cast<unsigned>(head.size() + time.size() + level.size() + 8);
  return head + time + number(begin + 12) + level + number(begin) + std::string(12 + 4, '\1');
}

class NetcdfHeader : public ::testing::Test {
 protected:
  // Empty where it is taken.
  std::string complaint(const std::string& bytes) const {
    write_file(directory_.path() / "a.nc", bytes);
    try {
      require_sound_netcdf(directory_.path() / "a.nc");
    } catch (const std::invalid_argument& error) {
      const std::string message = error.what(), file = (directory_.path() / "a.nc").string();
      EXPECT_THAT(message, StartsWith(file + ": NetCDF header: "));
      return message.substr(file.size());
    }
    return {};
  }
  TemporaryDirectory directory_;
};

TEST_F(NetcdfHeader, OfASoundFileIsTaken) {
  EXPECT_EQ(complaint(sound_file()), "");
  EXPECT_EQ(complaint("\x89HDF\r\n\x1a\n"), "");
  EXPECT_EQ(complaint("text"), "");
}

// Wherever it is cut, it is no whole file.
TEST_F(NetcdfHeader, OfACutFileIsRefused) {
  const std::string whole = sound_file();
  for (std::size_t size = 4; size < whole.size(); ++size)
    EXPECT_THAT(complaint(whole.substr(0, size)), HasSubstr("expected")) << size;
  EXPECT_THAT(complaint(whole.substr(0, whole.size() - 1)), HasSubstr("the file has"));
}

// Counts that ask for more than the file holds, types and dimensions that there are not; the
// library reads or refuses the rest, and neither crashes nor asks for more memory than there is.
TEST_F(NetcdfHeader, OfADamagedFileIsRefusedOrItIsReadable) {
  const std::string whole = sound_file();
  const auto& module = module_named<fit::NetcdfModule>("skyfit_netcdf_module");
  int refused = 0, read = 0;
  for (std::size_t at = 4; at < whole.size() - 16; ++at) {
    std::string damaged = whole;
    damaged[at] = '\x7f';
    if (!complaint(damaged).empty()) {
      ++refused;
      continue;
    }
    try {
      module.read(directory_.path() / "a.nc");
      ++read;
    } catch (const std::runtime_error&) {
    }
  }
  // Letters of names and the sizes that nobody reads may be anything.
  EXPECT_GT(refused, static_cast<int>(whole.size()) / 2);
  EXPECT_GT(read, 10);
}

}  // namespace
}  // namespace skyfit::refs
