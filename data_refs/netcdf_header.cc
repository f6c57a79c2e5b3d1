// SPDX-License-Identifier: Apache-2.0
#include "data_refs/netcdf_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "model/base/text.h"

namespace skyfit::refs {
namespace {

constexpr std::uint64_t kDimensions = 10, kVariables = 11, kAttributes = 12, kLongestName = 256;
constexpr std::size_t kLongestHeader = 1 << 24;

// Numbers are big-endian; counts and lengths of CDF-5 have 8 bytes, offsets have them from CDF-2
// on.
class Header {
 public:
  Header(std::string_view start, std::uint64_t file_bytes)
      : start_(start), file_bytes_(file_bytes), version_(start[3]), at_(4) {}

  void check() {
    records_ = count_or_streaming();
    list(kDimensions, [&] {
      name();
      lengths_.push_back(count());
    });
    list(kAttributes, [&] { attribute(); });
    list(kVariables, [&] { variable(); });
    expect_data();
  }

 private:
  [[noreturn]] static void fail(const std::string& what) { throw std::invalid_argument(what); }

  void expect(std::uint64_t bytes) const {
    if (bytes > start_.size() - at_)
      fail(fmt::format("the header goes on beyond byte {}: expected a whole file", start_.size()));
  }

  std::uint64_t number(int bytes) {
    expect(static_cast<std::uint64_t>(bytes));
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value << 8 | static_cast<unsigned char>(start_[at_++]);
    return value;
  }
  int count_bytes() const { return version_ == 5 ? 8 : 4; }
  // No more things, each of a byte at least, than the file has bytes.
  std::uint64_t bounded(std::uint64_t value, std::string_view what) const {
    if (value > file_bytes_)
      fail(fmt::format("{} {} in {} bytes: expected fewer", value, what, file_bytes_));
    return value;
  }
  std::uint64_t count() { return bounded(number(count_bytes()), "elements"); }
  // All bits are set while a file is written.
  std::uint64_t count_or_streaming() {
    const std::uint64_t value = number(count_bytes());
    const bool streaming = value == (version_ == 5 ? ~std::uint64_t{0} : 0xffffffffu);
    return streaming ? 0 : bounded(value, "records");
  }
  // In words of four bytes.
  void skip(std::uint64_t bytes) {
    const std::uint64_t padded = (bytes + 3) / 4 * 4;
    expect(padded);
    at_ += static_cast<std::size_t>(padded);
  }
  std::string name() {
    const std::uint64_t length = count();
    if (length == 0 || length > kLongestName)
      fail(fmt::format("a name of {} bytes: expected 1 to {}", length, kLongestName));
    const std::size_t begin = at_;
    skip(length);
    return std::string(start_.substr(begin, static_cast<std::size_t>(length)));
  }
  std::uint64_t type_bytes() {
    const std::uint64_t type = number(4);
    constexpr std::uint64_t kBytes[] = {1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    if (type < 1 || type > (version_ == 5 ? 11u : 6u))
      fail(fmt::format("a type {}: expected one of the format's", type));
    return kBytes[type - 1];
  }

  template <class Read>
  void list(std::uint64_t tag, Read read) {
    const std::uint64_t found = number(4), elements = count();
    if (found != tag && (found != 0 || elements != 0))
      fail(fmt::format("a list {}: expected {}, or an empty one", found, tag));
    for (std::uint64_t i = 0; i < elements; ++i) read();
  }
  void attribute() {
    name();
    const std::uint64_t bytes = type_bytes();
    skip(bytes * count());
  }
  void variable() {
    const std::string own = name();
    const std::uint64_t dimensions = count();
    bool has_records = false;
    double values = 1;
    for (std::uint64_t i = 0; i < dimensions; ++i) {
      const std::uint64_t index = count();
      if (index >= lengths_.size())
        fail(fmt::format("{}: dimension {}: expected one of {}", printable(own), index,
                         lengths_.size()));
      const std::uint64_t length = lengths_[static_cast<std::size_t>(index)];
      if (length == 0 && i == 0)
        has_records = true;
      else
        values *= static_cast<double>(length);
    }
    list(kAttributes, [&] { attribute(); });
    const double bytes = values * static_cast<double>(type_bytes());
    number(count_bytes());  // the same, padded, or too large for the field
    const std::uint64_t begin = number(version_ == 1 ? 4 : 8);
    data_.push_back({own, static_cast<double>(begin), bytes, has_records});
  }

  // Records hold one part of every variable that has them, in words where they are several.
  void expect_data() const {
    double record = 0;
    const auto several = std::ranges::count_if(data_, &Data::has_records);
    for (const Data& data : data_) {
      if (data.has_records) record += several > 1 ? std::ceil(data.bytes / 4) * 4 : data.bytes;
    }
    for (const Data& data : data_) {
      if (data.has_records && records_ == 0) continue;
      const double end = data.begin + data.bytes +
                         (data.has_records ? static_cast<double>(records_ - 1) * record : 0);
      if (end > static_cast<double>(file_bytes_))
        fail(fmt::format("{} goes on to byte {:.0f}, the file has {}: expected a whole file",
                         printable(data.name), end, file_bytes_));
    }
  }

  struct Data {
    std::string name;
    double begin, bytes;  // of one record where there are records
    bool has_records;
  };

  std::string_view start_;
  std::uint64_t file_bytes_, records_ = 0;
  int version_;
  std::size_t at_;
  std::vector<std::uint64_t> lengths_;  // of dimensions; 0 of the one of records
  std::vector<Data> data_;
};

}  // namespace

void require_sound_netcdf(const std::filesystem::path& file) {
  const auto bytes = static_cast<std::uint64_t>(std::filesystem::file_size(file));
  std::string start(static_cast<std::size_t>(std::min<std::uint64_t>(bytes, kLongestHeader)), '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  if (!in || start.size() < 4 || !start.starts_with("CDF") ||
      (start[3] != 1 && start[3] != 2 && start[3] != 5))
    return;
  try {
    Header(start, bytes).check();
  } catch (const std::invalid_argument& complaint) {
    throw std::invalid_argument(
        fmt::format("{}: NetCDF header: {}", file.string(), complaint.what()));
  }
}

}  // namespace skyfit::refs
