// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "files/hdf5_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <new>
#include <string_view>
#include <utility>

#include "run/errors.h"
#include "system_message.h"

namespace vesiflow::run {
namespace {

// Closes an HDF5 identifier when it goes out of scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// What the system said of the call that failed last, such as "No space left on device"; that of memory is not in HDF5's text.
// Empty if it was not the system.
std::string system_error() {
  struct Cause {
    int number = 0;
    bool lock = false;
  } cause;
  const auto find = [](unsigned, const H5E_error2_t* entry, void* found) -> herr_t {
    const std::string_view text = entry->desc != nullptr ? entry->desc : "";
    constexpr std::string_view label = "errno = ";
    int& number = static_cast<Cause*>(found)->number;
    if (entry->maj_num == H5E_RESOURCE && text.find("memory allocation failed") != std::string_view::npos)
      number = ENOMEM;
    const std::size_t at = text.find(label);
    if (at == std::string_view::npos) return 0;
    std::from_chars(text.data() + at + label.size(), text.data() + text.size(), number);
    static_cast<Cause*>(found)->lock = text.find("lock file") != std::string_view::npos;
    return 1;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find, &cause);
  if (cause.number == 0) return "";
  return system_message(cause.number) +
         (cause.lock ? "; it cannot be locked, which is not needed: set HDF5_USE_FILE_LOCKING=FALSE in the environment"
                     : "");
}

// Opening a file takes HDF5 some megabytes; where there are none, 1.10.8 crashes (H5AC_create).
void require_memory() {
  constexpr std::size_t bytes = 4 << 20;
  void* volatile probe = std::malloc(bytes);
  if (probe == nullptr) throw std::bad_alloc();
  std::free(probe);
}

// The format of HDF5 1.10, whichever newer library writes it: its metadata have checksums. No locks: what is written is beside
// the file that others read and takes its place when it is whole, and some file systems have none.
Handle checksummed_access() {
  const hid_t list = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(list, H5F_LIBVER_V110, H5F_LIBVER_V110);
#if H5_VERSION_GE(1, 10, 7) && !(H5_VERSION_GE(1, 12, 0) && H5_VERSION_LE(1, 12, 0))
  H5Pset_file_locking(list, false, true);
#endif
  return Handle(list, H5Pclose);
}

// Without the time of writing, the same results are the same file.
Handle timeless(hid_t kind) {
  const hid_t list = H5Pcreate(kind);
  H5Pset_obj_track_times(list, false);
  return Handle(list, H5Pclose);
}

hid_t simple_space(const Hdf5File::Shape& shape) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  return H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr);
}

// Slabs of whole rows, of about equal size and no more than the cache of a data set holds.
std::vector<hsize_t> chunk_of(const Hdf5File::Shape& shape, std::uint64_t bytes) {
  constexpr std::uint64_t cache_bytes = 1 << 20;
  std::vector<hsize_t> chunk(shape.begin(), shape.end());
  const std::uint64_t slabs = std::min<std::uint64_t>(shape[0], (bytes + cache_bytes - 1) / cache_bytes);
  chunk[0] = (shape[0] + slabs - 1) / slabs;
  return chunk;
}

// Only data in chunks have checksums.
Handle checksummed(const Hdf5File::Shape& shape, hid_t type) {
  Handle creation = timeless(H5P_DATASET_CREATE);
  std::uint64_t bytes = H5Tget_size(type);
  for (const std::uint64_t n : shape) bytes *= n;
  if (bytes > 0) {
    const std::vector<hsize_t> chunk = chunk_of(shape, bytes);
    H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data());
    H5Pset_fletcher32(creation);
  }
  return creation;
}

// Makes the groups above an object.
bool make_parents(hid_t file, const std::string& name) {
  for (std::size_t end = name.find('/', 1); end != std::string::npos; end = name.find('/', end + 1)) {
    const std::string group = name.substr(0, end);
    if (H5Lexists(file, group.c_str(), H5P_DEFAULT) > 0) continue;
    const Handle creation = timeless(H5P_GROUP_CREATE);
    const Handle made(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose);
    if (!made.valid()) return false;
  }
  return true;
}

}  // namespace

QuietHdf5::QuietHdf5() {
  unsigned is_new = 1;
  H5Eauto_is_v2(H5E_DEFAULT, &is_new);
  if (is_new == 0)
    H5Eget_auto1(&old_print_, &data_);
  else
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietHdf5::~QuietHdf5() {
  if (old_print_ != nullptr)
    H5Eset_auto1(old_print_, data_);
  else
    H5Eset_auto2(H5E_DEFAULT, print_, data_);
}

bool have_hdf5() {
  return true;
}

void spare_hdf5_at_exit() {
  H5dont_atexit();
}

Hdf5File::Hdf5File(const std::filesystem::path& path, Mode mode) : path_(path) {
  require_memory();
  const std::string name = path.string();
  const Handle access = checksummed_access(), creation = timeless(H5P_FILE_CREATE);
  file_ = mode == Mode::create ? H5Fcreate(name.c_str(), H5F_ACC_TRUNC, creation, access)
                               : H5Fopen(name.c_str(), H5F_ACC_RDONLY, access);
  // Before anything is closed, which would forget the cause.
  if (file_ < 0) fail(mode == Mode::create ? "cannot be created" : "cannot be read: missing, truncated or not HDF5");
}

Hdf5File::~Hdf5File() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::close() {
  if (H5Fflush(file_, H5F_SCOPE_GLOBAL) < 0) fail("cannot be written");
  if (H5Fclose(std::exchange(file_, -1)) < 0) fail("cannot be written");
}

void Hdf5File::fail(const std::string& what) const {
  const std::string cause = system_error();
  throw FileError(fmt::format("{}: {}{}{}", path_.string(), what, cause.empty() ? "" : ": ", cause));
}

void Hdf5File::write_values(const std::string& name, std::int64_t type, const void* values, const Shape& shape) {
  if (!make_parents(file_, name)) fail(name + " cannot be written");
  const Handle space(simple_space(shape), H5Sclose);
  const Handle creation = checksummed(shape, type);
  const hid_t set = H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  if (set < 0) fail(name + " cannot be written");
  const Handle closing(set, H5Dclose);
  // What is still in memory is written here, where its failure can be told.
  if (H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0 || H5Dflush(set) < 0)
    fail(name + " cannot be written");
}

void Hdf5File::write(const std::string& name, const double* values, const Shape& shape) {
  write_values(name, H5T_NATIVE_DOUBLE, values, shape);
}
void Hdf5File::write(const std::string& name, const float* values, const Shape& shape) {
  write_values(name, H5T_NATIVE_FLOAT, values, shape);
}
void Hdf5File::write(const std::string& name, const std::int32_t* values, const Shape& shape) {
  write_values(name, H5T_NATIVE_INT32, values, shape);
}

void Hdf5File::write_attribute(const std::string& group, const std::string& name, std::int64_t type, const Shape& shape,
                               const void* value) {
  if (!make_parents(file_, group + "/")) fail(name + " cannot be written");
  const Handle target(H5Oopen(file_, group.c_str(), H5P_DEFAULT), H5Oclose);
  const Handle space(shape.empty() ? H5Screate(H5S_SCALAR) : simple_space(shape), H5Sclose);
  const Handle attribute(H5Acreate2(target, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid() || H5Awrite(attribute, type, value) < 0) fail(name + " cannot be written");
}

void Hdf5File::attribute(const std::string& group, const std::string& name, double value) {
  write_attribute(group, name, H5T_NATIVE_DOUBLE, {}, &value);
}
void Hdf5File::attribute(const std::string& group, const std::string& name, std::int64_t value) {
  write_attribute(group, name, H5T_NATIVE_INT64, {}, &value);
}
void Hdf5File::attribute(const std::string& group, const std::string& name, const std::vector<double>& values) {
  write_attribute(group, name, H5T_NATIVE_DOUBLE, {values.size()}, values.data());
}
void Hdf5File::attribute(const std::string& group, const std::string& name, const std::string& value) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, value.size() + 1);
  write_attribute(group, name, type, {}, value.c_str());
}

std::uint64_t Hdf5File::size(const std::string& name) const {
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.valid()) fail(name + " is missing or damaged");
  const Handle space(H5Dget_space(set), H5Sclose);
  const hssize_t values = H5Sget_simple_extent_npoints(space);
  if (values < 0) fail(name + " is damaged");
  return static_cast<std::uint64_t>(values);
}

std::vector<double> Hdf5File::read(const std::string& name) const {
  // What was never written takes no room in the file, but could ask for any amount of memory.
  const std::uint64_t values = size(name);
  hsize_t file_bytes = 0;
  H5Fget_filesize(file_, &file_bytes);
  if (values > file_bytes) fail(fmt::format("{} has {} values, more than the file has bytes", name, values));
  std::vector<double> read(values);
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, read.data()) < 0)
    fail(name + " cannot be read: the file is damaged");
  return read;
}

Hdf5File::Shape Hdf5File::shape(const std::string& name) const {
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.valid()) fail(name + " is missing or damaged");
  const Handle space(H5Dget_space(set), H5Sclose);
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  if (extent.empty() || H5Sget_simple_extent_dims(space, extent.data(), nullptr) < 0) fail(name + " is damaged");
  return Shape(extent.begin(), extent.end());
}

std::vector<double> Hdf5File::read_block(const std::string& name, const Shape& start, const Shape& count) const {
  const Shape all = shape(name);
  bool inside = start.size() == all.size() && count.size() == all.size();
  std::uint64_t values = 1;
  for (std::size_t d = 0; inside && d < all.size(); ++d) {
    inside = count[d] <= all[d] && start[d] <= all[d] - count[d];
    values *= count[d];
  }
  if (!inside) fail(name + " is smaller than what is to be read of it");
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle from(H5Dget_space(set), H5Sclose), to(simple_space(count), H5Sclose);
  const std::vector<hsize_t> first(start.begin(), start.end()), extent(count.begin(), count.end());
  std::vector<double> block(values);
  if (H5Sselect_hyperslab(from, H5S_SELECT_SET, first.data(), nullptr, extent.data(), nullptr) < 0 ||
      H5Dread(set, H5T_NATIVE_DOUBLE, to, from, H5P_DEFAULT, block.data()) < 0)
    fail(name + " cannot be read: the file is damaged");
  return block;
}

void Hdf5File::read_attribute(const std::string& group, const std::string& name, std::int64_t type, void* value,
                              std::size_t count) const {
  const Handle attribute(H5Aopen_by_name(file_, group.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) fail(fmt::format("{} of {} is missing or damaged", name, group));
  const Handle space(H5Aget_space(attribute), H5Sclose);
  if (H5Sget_simple_extent_npoints(space) != static_cast<hssize_t>(count) || H5Aread(attribute, type, value) < 0)
    fail(fmt::format("{} of {} cannot be read: the file is damaged", name, group));
}

double Hdf5File::read_number(const std::string& group, const std::string& name) const {
  double value = 0.0;
  read_attribute(group, name, H5T_NATIVE_DOUBLE, &value);
  return value;
}

std::int64_t Hdf5File::read_integer(const std::string& group, const std::string& name) const {
  std::int64_t value = 0;
  read_attribute(group, name, H5T_NATIVE_INT64, &value);
  return value;
}

std::vector<double> Hdf5File::read_numbers(const std::string& group, const std::string& name, std::size_t count) const {
  std::vector<double> values(count);
  read_attribute(group, name, H5T_NATIVE_DOUBLE, values.data(), count);
  return values;
}

std::string Hdf5File::read_text(const std::string& group, const std::string& name) const {
  const Handle attribute(H5Aopen_by_name(file_, group.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) fail(fmt::format("{} of {} is missing or damaged", name, group));
  const Handle type(H5Aget_type(attribute), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0)
    fail(fmt::format("{} of {} is not a text of fixed length", name, group));
  std::string value(H5Tget_size(type), '\0');
  read_attribute(group, name, type, value.data());
  value.resize(std::min(value.size(), value.find('\0')));
  return value;
}

bool Hdf5File::exists(const std::string& name) const {
  const htri_t found = H5Lexists(file_, name.c_str(), H5P_DEFAULT);
  if (found < 0) fail(name + " cannot be looked up: the file is damaged");
  return found > 0;
}

void Hdf5File::link(const std::string& name, const std::string& other_file) {
  if (!make_parents(file_, name) ||
      H5Lcreate_external(other_file.c_str(), "/", file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0)
    fail(name + " cannot be written");
}

}  // namespace vesiflow::run
