#include "hdf5_file.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <utility>

#include "coupling/errors.h"

namespace vesiflow::coupling {
namespace {

// Closes an HDF5 identifier when it goes out of scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

hid_t creating_groups() {
  const hid_t list = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(list, 1);
  return list;
}

hid_t simple_space(const Hdf5File::Shape& shape) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  return H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr);
}

// Without the time of writing, the same results are the same file.
hid_t timeless() {
  const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_obj_track_times(list, false);
  return list;
}

bool write_dataset(hid_t file, const std::string& name, hid_t type, const void* values, const Hdf5File::Shape& shape) {
  const Handle space(simple_space(shape), H5Sclose);
  const Handle links(creating_groups(), H5Pclose);
  const Handle creation(timeless(), H5Pclose);
  const Handle set(H5Dcreate2(file, name.c_str(), type, space, links, creation, H5P_DEFAULT), H5Dclose);
  return set.valid() && H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0;
}

// The object of that name, made as a group if there is none.
Handle object(hid_t file, const std::string& name) {
  if (name != "/" && H5Lexists(file, name.c_str(), H5P_DEFAULT) <= 0) {
    const Handle links(creating_groups(), H5Pclose);
    const Handle group(H5Gcreate2(file, name.c_str(), links, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  }
  return Handle(H5Oopen(file, name.c_str(), H5P_DEFAULT), H5Oclose);
}

bool write_attribute(hid_t file, const std::string& group, const std::string& name, hid_t type, hid_t space,
                     const void* value) {
  const Handle target = object(file, group);
  if (!target.valid()) return false;
  if (H5Aexists(target, name.c_str()) > 0) H5Adelete(target, name.c_str());
  const Handle attribute(H5Acreate2(target, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute.valid() && H5Awrite(attribute, type, value) >= 0;
}

bool is_scalar(hid_t attribute) {
  const Handle space(H5Aget_space(attribute), H5Sclose);
  return space.valid() && H5Sget_simple_extent_npoints(space) == 1;
}

// HDF5 writes as many values as the attribute has, wherever they end.
bool read_attribute(hid_t file, const std::string& group, const std::string& name, hid_t type, void* value) {
  const Handle attribute(H5Aopen_by_name(file, group.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute.valid() && is_scalar(attribute) && H5Aread(attribute, type, value) >= 0;
}

// A file that claims to hold more than this is damaged: what it holds is not packed.
std::uint64_t largest_size(const std::filesystem::path& path) {
  std::error_code unknown;
  const std::uintmax_t bytes = std::filesystem::file_size(path, unknown);
  return unknown ? 0 : bytes;
}

}  // namespace

bool have_hdf5() {
  return true;
}

Hdf5File::Hdf5File(const std::filesystem::path& path, Mode mode) : path_(path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // failures become exceptions, not print-outs
  const std::string name = path.string();
  switch (mode) {
    case Mode::create:
      file_ = H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
      break;
    case Mode::append:
      file_ = H5Fopen(name.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
      break;
    case Mode::read:
      file_ = H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
      break;
  }
  if (file_ < 0) {
    const char* what = mode == Mode::create ? "cannot be created" : "cannot be read: missing, truncated or not HDF5";
    fail(what);
  }
}

Hdf5File::~Hdf5File() {
  H5Fclose(file_);
}

void Hdf5File::fail(const std::string& what) const {
  throw FileError(fmt::format("{}: {}", path_.string(), what));
}

void Hdf5File::write(const std::string& name, const double* values, const Shape& shape) {
  if (!write_dataset(file_, name, H5T_NATIVE_DOUBLE, values, shape)) fail(name + " cannot be written");
}
void Hdf5File::write(const std::string& name, const float* values, const Shape& shape) {
  if (!write_dataset(file_, name, H5T_NATIVE_FLOAT, values, shape)) fail(name + " cannot be written");
}
void Hdf5File::write(const std::string& name, const std::int32_t* values, const Shape& shape) {
  if (!write_dataset(file_, name, H5T_NATIVE_INT32, values, shape)) fail(name + " cannot be written");
}

void Hdf5File::attribute(const std::string& group, const std::string& name, double value) {
  const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose);
  if (!write_attribute(file_, group, name, H5T_NATIVE_DOUBLE, scalar, &value)) fail(name + " cannot be written");
}
void Hdf5File::attribute(const std::string& group, const std::string& name, std::int64_t value) {
  const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose);
  if (!write_attribute(file_, group, name, H5T_NATIVE_INT64, scalar, &value)) fail(name + " cannot be written");
}
void Hdf5File::attribute(const std::string& group, const std::string& name, const std::vector<double>& values) {
  const Handle space(simple_space({values.size()}), H5Sclose);
  if (!write_attribute(file_, group, name, H5T_NATIVE_DOUBLE, space, values.data())) fail(name + " cannot be written");
}
void Hdf5File::attribute(const std::string& group, const std::string& name, const std::string& value) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, value.size() + 1);
  const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose);
  if (!write_attribute(file_, group, name, type, scalar, value.c_str())) fail(name + " cannot be written");
}

Hdf5File::Shape Hdf5File::shape(const std::string& name) const {
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.valid()) fail(name + " is missing");
  const Handle space(H5Dget_space(set), H5Sclose);
  const int dimensions = H5Sget_simple_extent_ndims(space);
  if (dimensions < 0) fail(name + " cannot be read: the file is damaged");
  std::vector<hsize_t> extent(static_cast<std::size_t>(dimensions));
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  return {extent.begin(), extent.end()};
}

std::vector<double> Hdf5File::read(const std::string& name) const {
  const std::uint64_t largest = largest_size(path_);
  std::uint64_t size = 1;
  for (const std::uint64_t n : shape(name)) {
    if (n > 0 && size > largest / n) fail(name + " claims to be larger than the file: the file is damaged");
    size *= n;
  }
  std::vector<double> values(size);
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail(name + " cannot be read: the file is damaged");
  return values;
}

double Hdf5File::read_number(const std::string& group, const std::string& name) const {
  double value = 0.0;
  if (!read_attribute(file_, group, name, H5T_NATIVE_DOUBLE, &value)) fail(name + " is missing or no number");
  return value;
}

std::int64_t Hdf5File::read_integer(const std::string& group, const std::string& name) const {
  std::int64_t value = 0;
  if (!read_attribute(file_, group, name, H5T_NATIVE_INT64, &value)) fail(name + " is missing or no number");
  return value;
}

std::string Hdf5File::read_text(const std::string& group, const std::string& name) const {
  const Handle attribute(H5Aopen_by_name(file_, group.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) fail(name + " is missing");
  const Handle type(H5Aget_type(attribute), H5Tclose);
  const bool is_text = is_scalar(attribute) && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
  if (!is_text) fail(name + " is no text");
  const std::size_t size = H5Tget_size(type);
  if (size > largest_size(path_)) fail(name + " claims to be larger than the file: the file is damaged");
  std::string value(size, '\0');
  if (H5Aread(attribute, type, value.data()) < 0) fail(name + " cannot be read");
  return value.substr(0, value.find('\0'));
}

bool Hdf5File::exists(const std::string& name) const {
  return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5File::children(const std::string& group) const {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  if (exists(group))
    H5Literate_by_name(file_, group.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names, H5P_DEFAULT);
  return names;
}

void Hdf5File::remove(const std::string& name) {
  if (H5Ldelete(file_, name.c_str(), H5P_DEFAULT) < 0) fail(name + " cannot be removed");
}

}  // namespace vesiflow::coupling
