// SPDX-License-Identifier: Apache-2.0
#include "fit/exchange/netcdf/netcdf_module.h"

#include <fmt/format.h>
#include <hdf5.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace skyfit::fit {
namespace {

constexpr std::size_t kIncrement = 1 << 16;  // bytes by which a file in memory grows

// A file without content that keeps the order of what is put into it, as the NetCDF-4 format asks
// and nc_create_mem() does not; no memory where HDF5 refuses.
NC_memio empty_image() {
  constexpr unsigned kOrder = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;
  NC_memio image{};
  const hid_t creation = H5Pcreate(H5P_FILE_CREATE), access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_link_creation_order(creation, kOrder);
  H5Pset_attr_creation_order(creation, kOrder);
  H5Pset_obj_track_times(creation, false);  // the same content is the same bytes
  H5Pset_fapl_core(access, kIncrement, false);
  const hid_t file = H5Fcreate("empty", H5F_ACC_TRUNC, creation, access);
  H5Fflush(file, H5F_SCOPE_LOCAL);
  if (const ssize_t size = H5Fget_file_image(file, nullptr, 0); size > 0) {
    image.size = static_cast<std::size_t>(size);
    image.memory = std::malloc(image.size);  // netCDF reallocates it
    if (image.memory != nullptr) H5Fget_file_image(file, image.memory, image.size);
  }
  H5Fclose(file);
  H5Pclose(access);
  H5Pclose(creation);
  return image;
}

// Of a file in memory, whose block is longer; 0 where HDF5 refuses.
std::size_t bytes_in(const NC_memio& image) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access, kIncrement, false);
  H5Pset_file_image(access, image.memory, image.size);
  const hid_t file = H5Fopen("image", H5F_ACC_RDONLY, access);
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  H5Fclose(file);
  H5Pclose(access);
  return size > 0 ? static_cast<std::size_t>(size) : 0;
}

// An open file: every call is checked, the last one too. One to write is in memory: HDF5 keeps a
// file open that it could not write to a full disk, and crashes over it when the program ends.
class OpenFile {
 public:
  OpenFile(const std::filesystem::path& file, bool writes)
      : file_(file), doing_(writes ? "written" : "read") {
    // Of every thread, or HDF5 prints what it looked for in vain.
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    if (writes) {
      NC_memio empty = empty_image();
      if (empty.memory == nullptr) fail("HDF5 makes no file in memory");
      check(nc_open_memio(file.c_str(), NC_NETCDF4 | NC_WRITE, &empty, &id_));
    } else {
      check(nc_open(file.c_str(), NC_NOWRITE, &id_));
    }
    open_ = true;
  }
  ~OpenFile() {
    if (open_) nc_close(id_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int id() const { return id_; }
  void check(int status) const {
    if (status != NC_NOERR) fail(nc_strerror(status));
  }
  [[noreturn]] void fail(std::string_view reason) const {
    throw std::runtime_error(fmt::format("{}: cannot be {}: {}", file_.string(), doing_, reason));
  }
  void close() {
    open_ = false;
    check(nc_close(id_));
  }
  // The same of one to write.
  std::string close_to_bytes() {
    open_ = false;
    NC_memio written{};
    check(nc_close_memio(id_, &written));
    const std::unique_ptr<void, decltype(&std::free)> memory(written.memory, &std::free);
    const std::size_t size = bytes_in(written);
    if (size == 0) fail("HDF5 does not read what it wrote");
    return {static_cast<const char*>(memory.get()), size};
  }

 private:
  std::filesystem::path file_;
  std::string_view doing_;
  int id_ = -1;
  bool open_ = false;
};

void put_text(const OpenFile& file, int variable, const char* name, const std::string& text) {
  file.check(nc_put_att_text(file.id(), variable, name, text.size(), text.c_str()));
}

void define(const OpenFile& file, const NetcdfVariable& variable,
            const std::vector<int>& dimensions, int& id) {
  constexpr nc_type kTypes[] = {NC_DOUBLE, NC_INT, NC_STRING};  // by index of the variant
  const nc_type type = kTypes[variable.values.index()];
  file.check(nc_def_var(file.id(), variable.name.c_str(), type, static_cast<int>(dimensions.size()),
                        dimensions.data(), &id));
  const bool is_coordinate =
      variable.dimensions.size() == 1 && variable.dimensions.front() == variable.name;
  if (type == NC_DOUBLE && !is_coordinate) {  // a coordinate has no missing value
    constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
    file.check(nc_def_var_fill(file.id(), id, NC_FILL, &kMissing));
  }
  if (type != NC_STRING && !dimensions.empty()) {
    constexpr int kShuffle = 1, kDeflate = 1, kLevel = 1;
    file.check(nc_def_var_deflate(file.id(), id, kShuffle, kDeflate, kLevel));
  }
  put_text(file, id, "long_name", variable.long_name);
  if (!variable.units.empty()) put_text(file, id, "units", variable.units);
  if (!variable.coordinates.empty()) put_text(file, id, "coordinates", variable.coordinates);
}

void put(const OpenFile& file, int id, const NetcdfVariable& variable) {
  struct Put {
    const OpenFile& file;
    int id;
    void operator()(const std::vector<double>& v) const {
      file.check(nc_put_var_double(file.id(), id, v.data()));
    }
    void operator()(const std::vector<int>& v) const {
      file.check(nc_put_var_int(file.id(), id, v.data()));
    }
    void operator()(const std::vector<std::string>& v) const {
      std::vector<const char*> texts;
      for (const std::string& text : v) texts.push_back(text.c_str());
      file.check(nc_put_var_string(file.id(), id, texts.data()));
    }
  };
  std::visit(Put{file, id}, variable.values);
}

std::string bytes(const std::filesystem::path& path, const NetcdfFile& content) {
  OpenFile file(path, true);
  for (const auto& [name, text] : content.attributes) put_text(file, NC_GLOBAL, name.c_str(), text);
  std::vector<int> dimensions(content.dimensions.size()), variables;
  for (std::size_t i = 0; i < dimensions.size(); ++i)
    file.check(nc_def_dim(file.id(), content.dimensions[i].first.c_str(),
                          content.dimensions[i].second, &dimensions[i]));
  for (const NetcdfVariable& variable : content.variables) {
    std::vector<int> own;
    std::size_t size = 1;
    for (const std::string& name : variable.dimensions) {
      std::size_t i = 0;
      while (i < dimensions.size() && content.dimensions[i].first != name) ++i;
      if (i == dimensions.size()) file.fail("no dimension " + name);
      own.push_back(dimensions[i]);
      size *= content.dimensions[i].second;
    }
    if (std::visit([](const auto& v) { return v.size(); }, variable.values) != size)
      file.fail(fmt::format("{} has not {} values", variable.name, size));
    define(file, variable, own, variables.emplace_back());
  }
  file.check(nc_enddef(file.id()));
  for (std::size_t i = 0; i < variables.size(); ++i) put(file, variables[i], content.variables[i]);
  return file.close_to_bytes();
}

std::string text_attribute(const OpenFile& file, int variable, const char* name) {
  std::size_t length = 0;
  nc_type type = 0;
  if (nc_inq_att(file.id(), variable, name, &type, &length) != NC_NOERR || type != NC_CHAR)
    return {};
  std::string text(length, '\0');
  file.check(nc_get_att_text(file.id(), variable, name, text.data()));
  return text;
}

constexpr std::size_t kMostValues = std::size_t{1} << 28;  // of a variable

std::optional<double> number_attribute(const OpenFile& file, int variable, const char* name) {
  nc_type type = 0;
  std::size_t length = 0;
  if (nc_inq_att(file.id(), variable, name, &type, &length) != NC_NOERR) return {};
  if (type == NC_CHAR) {
    const std::string text = text_attribute(file, variable, name);
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0') return {};
    return number;
  }
  if (length != 1 || type == NC_STRING) return {};
  double value = 0;
  file.check(nc_get_att_double(file.id(), variable, name, &value));
  return value;
}

// What the numbers of a variable stand for, by the conventions of NetCDF: packed ones are unpacked,
// and what is missing is NaN. Of the whole file's attributes ARM's `missing_value` counts.
class Unpacking {
 public:
  Unpacking(const OpenFile& file, int variable, nc_type type)
      : scale_(number_attribute(file, variable, "scale_factor")),
        offset_(number_attribute(file, variable, "add_offset")) {
    for (const auto& [of, name] : {std::pair{variable, "_FillValue"},
                                   {variable, "missing_value"},
                                   {NC_GLOBAL, "missing_value"}}) {
      if (const auto value = number_attribute(file, of, name)) missing_.push_back(*value);
    }
    is_plain_ = !scale_ && !offset_ && missing_.empty();
    if (type == NC_FLOAT) missing_.push_back(double{NC_FILL_FLOAT});
    if (type == NC_DOUBLE) missing_.push_back(NC_FILL_DOUBLE);
    if (type == NC_SHORT) missing_.push_back(NC_FILL_SHORT);
    if (type == NC_INT) missing_.push_back(NC_FILL_INT);
  }

  bool is_plain() const { return is_plain_; }
  void apply(std::vector<double>& values) const {
    for (double& value : values) {
      const bool is_missing = std::ranges::any_of(missing_, [&](double missing) {
        return value == missing || value == double{static_cast<float>(missing)};
      });
      value = is_missing ? std::numeric_limits<double>::quiet_NaN()
                         : value * scale_.value_or(1) + offset_.value_or(0);
    }
  }

 private:
  std::optional<double> scale_, offset_;
  std::vector<double> missing_;
  bool is_plain_;
};

NetcdfVariable read_variable(const OpenFile& file, int id, const NetcdfFile& content) {
  char name[NC_MAX_NAME + 1];
  nc_type type = 0;
  int count = 0;
  file.check(nc_inq_var(file.id(), id, name, &type, &count, nullptr, nullptr));
  std::vector<int> dimensions(static_cast<std::size_t>(count));
  file.check(nc_inq_vardimid(file.id(), id, dimensions.data()));
  NetcdfVariable variable{name,
                          {},
                          {},
                          text_attribute(file, id, "long_name"),
                          text_attribute(file, id, "units"),
                          text_attribute(file, id, "coordinates")};
  std::size_t size = 1;
  for (const int d : dimensions) {
    const auto& [dimension, length] = content.dimensions[static_cast<std::size_t>(d)];
    variable.dimensions.push_back(dimension);
    if (length > kMostValues / std::max<std::size_t>(size, 1))
      file.fail(fmt::format("{}: expected at most {} values", name, kMostValues));
    size *= length;
  }
  const Unpacking unpacking(file, id, type);
  if (type == NC_CHAR) {
    // A text lies along the last dimension.
    std::string letters(size, '\0');
    file.check(nc_get_var_text(file.id(), id, letters.data()));
    const std::size_t length =
        dimensions.empty() ? 1
                           : content.dimensions[static_cast<std::size_t>(dimensions.back())].second;
    std::vector<std::string> values;
    for (std::size_t i = 0; length > 0 && i < size; i += length)
      values.emplace_back(letters.substr(i, length).c_str());
    if (!variable.dimensions.empty()) variable.dimensions.pop_back();
    variable.values = std::move(values);
  } else if (type == NC_DOUBLE || type == NC_FLOAT || type == NC_BYTE || type == NC_SHORT ||
             (type == NC_INT && !unpacking.is_plain())) {
    std::vector<double> values(size);
    file.check(nc_get_var_double(file.id(), id, values.data()));
    unpacking.apply(values);
    variable.values = std::move(values);
  } else if (type == NC_INT) {
    std::vector<int> values(size);
    file.check(nc_get_var_int(file.id(), id, values.data()));
    variable.values = std::move(values);
  } else if (type == NC_STRING) {
    std::vector<char*> texts(size);
    file.check(nc_get_var_string(file.id(), id, texts.data()));
    std::vector<std::string> values;
    for (const char* text : texts) values.emplace_back(text ? text : "");
    nc_free_string(size, texts.data());
    variable.values = std::move(values);
  } else {
    file.fail(
        fmt::format("{}: expected numbers of at most 32 bits, doubles or texts", variable.name));
  }
  return variable;
}

NetcdfFile read(const std::filesystem::path& path) {
  OpenFile file(path, false);
  int dimensions = 0, variables = 0, attributes = 0;
  file.check(nc_inq(file.id(), &dimensions, &variables, &attributes, nullptr));
  NetcdfFile content;
  char name[NC_MAX_NAME + 1];
  for (int i = 0; i < dimensions; ++i) {
    std::size_t length = 0;
    file.check(nc_inq_dim(file.id(), i, name, &length));
    content.dimensions.emplace_back(name, length);
  }
  for (int i = 0; i < attributes; ++i) {
    file.check(nc_inq_attname(file.id(), NC_GLOBAL, i, name));
    content.attributes.emplace_back(name, text_attribute(file, NC_GLOBAL, name));
  }
  for (int i = 0; i < variables; ++i) content.variables.push_back(read_variable(file, i, content));
  file.close();
  return content;
}

}  // namespace
}  // namespace skyfit::fit

extern "C" __attribute__((visibility("default"))) const void* skyfit_netcdf_module() {
  static constexpr skyfit::fit::NetcdfModule kModule = {skyfit::fit::NetcdfModule::kRevision,
                                                        skyfit::fit::bytes, skyfit::fit::read};
  return &kModule;
}
