// SPDX-License-Identifier: Apache-2.0
#include "model/base/npz_file.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "model/base/npy_file.h"
#include "model/base/whole_file.h"

namespace skyfit {
namespace {

// minizip: 0 is success, and lengths are unsigned.
void expect(bool success) {
  if (!success) throw std::runtime_error("the archive cannot be written");
}

void add_member(zipFile archive, const std::string& name, std::string_view bytes) {
  constexpr std::size_t kPiece = std::size_t{1} << 30;
  constexpr int kZip64 = 1;  // of members of 4 GiB and more
  const bool large = bytes.size() > std::numeric_limits<std::uint32_t>::max();
  const zip_fileinfo info{};  // no date: the same values are the same file
  expect(zipOpenNewFileInZip64(archive, name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr,
                               Z_DEFLATED, Z_DEFAULT_COMPRESSION, large ? kZip64 : 0) == ZIP_OK);
  for (; !bytes.empty(); bytes.remove_prefix(std::min(kPiece, bytes.size())))
    expect(zipWriteInFileInZip(archive, bytes.data(),
                               static_cast<unsigned>(std::min(kPiece, bytes.size()))) == ZIP_OK);
  expect(zipCloseFileInZip(archive) == ZIP_OK);
}

void write_archive(const std::filesystem::path& file, const std::vector<NamedArray>& arrays) {
  const zipFile archive = zipOpen64(file.c_str(), APPEND_STATUS_CREATE);
  expect(archive != nullptr);
  try {
    for (const NamedArray& array : arrays)
      add_member(archive, array.name + ".npy",
                 npy_bytes(array.shape, "<f8", sizeof(double), std::as_bytes(array.values)));
  } catch (...) {
    zipClose(archive, nullptr);
    throw;
  }
  expect(zipClose(archive, nullptr) == ZIP_OK);
}

}  // namespace

void write_npz(const std::filesystem::path& file, const std::vector<NamedArray>& arrays) {
  WholeFiles whole({file});
  try {
    write_archive(whole.temporary(0), arrays);
  } catch (const std::runtime_error& error) {
    whole.fail(0, error.what());
  }
  whole.publish();
}

}  // namespace skyfit
