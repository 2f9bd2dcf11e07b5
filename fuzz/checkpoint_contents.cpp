// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Checkpoints that are good HDF5 files with wrong contents: data sets and attributes that are missing, of another shape or
// type, links that lead nowhere, values that are none, another scene. An input is a list of choices. What is in a checkpoint
// is read off a good one, so that the target follows its format.
#include <fuzzer/FuzzedDataProvider.h>
#include <hdf5.h>

#include <limits>
#include <string>

#include "checkpoint_case.h"
#include "input_file.h"
#include "one_thread.h"

namespace vesiflow::fuzz {
namespace {

class Id {
 public:
  explicit Id(hid_t id) : id_(id) {}
  ~Id() {
    if (id_ >= 0) H5Idec_ref(id_);
  }
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
};

struct Attribute {
  std::string object, name;
};
struct Contents {
  std::vector<std::string> objects;  // but for the root
  std::vector<Attribute> attributes;
};

Contents contents_of(const std::filesystem::path& path) {
  Contents contents;
  const Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  const auto visit = [](hid_t root, const char* name, const H5O_info_t*, void* to) -> herr_t {
    auto& found = *static_cast<Contents*>(to);
    if (std::string(name) != ".") found.objects.emplace_back(name);
    const Id object(H5Oopen(root, name, H5P_DEFAULT));
    std::pair<std::string, std::vector<Attribute>*> target(name, &found.attributes);
    const auto visit_attribute = [](hid_t, const char* attribute, const H5A_info_t*, void* pair) -> herr_t {
      const auto& [owner, list] = *static_cast<decltype(target)*>(pair);
      list->push_back({owner, attribute});
      return 0;
    };
    return H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit_attribute, &target);
  };
  check(H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, visit, &contents) >= 0, "the contents of a checkpoint are listed");
  return contents;
}

class Editor {
 public:
  Editor(const std::filesystem::path& path, const Contents& contents, FuzzedDataProvider& choices)
      : file_(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)), contents_(contents), choices_(choices) {}

  void edit() {
    switch (choices_.ConsumeIntegralInRange(0, 6)) {
      case 0:
        H5Ldelete(file_, object().c_str(), H5P_DEFAULT);
        break;
      case 1:
        replace_dataset(object());
        break;
      case 2:
        change_values(object());
        break;
      case 3:
        replace_by_link(object());
        break;
      case 4:
        H5Adelete_by_name(file_, attribute().object.c_str(), attribute().name.c_str(), H5P_DEFAULT);
        break;
      case 5:
        replace_attribute(attribute());
        break;
      default:
        change_scene();
    }
  }

 private:
  const std::string& object() { return pick(contents_.objects); }
  const Attribute& attribute() { return pick(contents_.attributes); }
  template <class T>
  const T& pick(const std::vector<T>& list) {
    return list[choices_.ConsumeIntegralInRange<std::size_t>(0, list.size() - 1)];
  }

  double number() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double awkward[] = {0.0,      -1.0,      1.0,   0.5,    std::numeric_limits<double>::quiet_NaN(),
                                  infinity, -infinity, 1e308, 1e-320, 3e9,
                                  -3e9,     1e19,      2.0};
    return choices_.PickValueInArray(awkward);
  }

  hid_t type() {
    const auto text = [](std::size_t size) {
      const hid_t copy = H5Tcopy(H5T_C_S1);
      H5Tset_size(copy, size);
      return copy;
    };
    switch (choices_.ConsumeIntegralInRange(0, 9)) {
      case 0:
        return H5Tcopy(H5T_NATIVE_INT32);
      case 1:
        return H5Tcopy(H5T_NATIVE_FLOAT);
      case 2:
        return H5Tcopy(H5T_STD_U64BE);
      case 3:
        return text(choices_.ConsumeIntegralInRange<std::size_t>(1, 64));
      case 4:
        return text(H5T_VARIABLE);
      case 5: {
        const hid_t compound = H5Tcreate(H5T_COMPOUND, 16);
        H5Tinsert(compound, "r", 0, H5T_NATIVE_DOUBLE);
        H5Tinsert(compound, "i", 8, H5T_NATIVE_DOUBLE);
        return compound;
      }
      case 6: {
        const hsize_t extent[] = {choices_.ConsumeIntegralInRange<hsize_t>(1, 1000)};
        return H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, extent);
      }
      case 7:
        return H5Tcreate(H5T_OPAQUE, choices_.ConsumeIntegralInRange<std::size_t>(1, 64));
      default:
        return H5Tcopy(H5T_NATIVE_DOUBLE);
    }
  }

  hid_t space() {
    const int kind = choices_.ConsumeIntegralInRange(0, 5);
    if (kind == 0) return H5Screate(H5S_NULL);
    if (kind == 1) return H5Screate(H5S_SCALAR);
    constexpr hsize_t extents[] = {0, 1, 2, 3, 14, 128, 384, 1 << 20, hsize_t{1} << 33, hsize_t{1} << 62};
    hsize_t extent[4];
    for (hsize_t& n : extent) n = choices_.PickValueInArray(extents);
    return H5Screate_simple(kind - 1, extent, nullptr);
  }

  /// Storage is made late, so that a data set of any extent costs nothing.
  void replace_dataset(const std::string& name) {
    H5Ldelete(file_, name.c_str(), H5P_DEFAULT);
    const Id of_type(type()), of_space(space()), properties(H5Pcreate(H5P_DATASET_CREATE));
    H5Pset_alloc_time(properties, H5D_ALLOC_TIME_LATE);
    const double fill = number();
    H5Pset_fill_value(properties, H5T_NATIVE_DOUBLE, &fill);
    if (choices_.ConsumeBool()) {
      const hsize_t chunk[4] = {4, 4, 4, 4};
      if (const int rank = H5Sget_simple_extent_ndims(of_space); rank > 0) H5Pset_chunk(properties, rank, chunk);
    }
    const Id made(H5Dcreate2(file_, name.c_str(), of_type, of_space, H5P_DEFAULT, properties, H5P_DEFAULT));
  }

  void change_values(const std::string& name) {
    const Id set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT));
    if (set < 0) return;
    const Id extent(H5Dget_space(set)), of_type(H5Dget_type(set));
    const hssize_t size = H5Sget_simple_extent_npoints(extent);
    constexpr hssize_t largest = 100000;
    if (size <= 0 || size > largest || H5Tget_class(of_type) != H5T_FLOAT) return;
    std::vector<double> values(static_cast<std::size_t>(size));
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    const std::size_t from = choices_.ConsumeIntegralInRange<std::size_t>(0, values.size() - 1);
    const std::size_t to = choices_.ConsumeBool() ? from + 1 : values.size();
    const bool scale = choices_.ConsumeBool();
    const double by = number();
    for (std::size_t i = from; i < to; ++i) values[i] = scale ? values[i] * by : by;
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }

  void replace_by_link(const std::string& name) {
    H5Ldelete(file_, name.c_str(), H5P_DEFAULT);
    switch (choices_.ConsumeIntegralInRange(0, 2)) {
      case 0:
        H5Lcreate_soft(("/" + object()).c_str(), file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
        break;
      case 1:
        H5Lcreate_hard(file_, object().c_str(), file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
        break;
      default:
        const Id group(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    }
  }

  void replace_attribute(const Attribute& old) {
    H5Adelete_by_name(file_, old.object.c_str(), old.name.c_str(), H5P_DEFAULT);
    const Id owner(H5Oopen(file_, old.object.c_str(), H5P_DEFAULT)), of_type(type()), of_space(space());
    constexpr hssize_t largest = 1 << 20;  // HDF5 takes the memory of an attribute when it is made
    if (H5Sget_simple_extent_npoints(of_space) > largest) return;
    const Id made(H5Acreate2(owner, old.name.c_str(), of_type, of_space, H5P_DEFAULT, H5P_DEFAULT));
    if (made < 0 || H5Tget_class(of_type) == H5T_STRING) return;
    const hssize_t size = H5Sget_simple_extent_npoints(of_space);
    if (H5Tget_class(of_type) == H5T_FLOAT && size > 0 && size <= 4096) {
      const std::vector<double> values(static_cast<std::size_t>(size), number());
      H5Awrite(made, H5T_NATIVE_DOUBLE, values.data());
    }
  }

  /// The text of a scene with a part replaced, its closing zero kept or not.
  void change_scene() {
    const Id owner(H5Oopen(file_, "/", H5P_DEFAULT));
    std::string text;
    {
      const Id old(H5Aopen(owner, "scene", H5P_DEFAULT));
      const Id of_type(H5Aget_type(old)), extent(H5Aget_space(old));
      const bool plain = H5Tget_class(of_type) == H5T_STRING && H5Tis_variable_str(of_type) == 0 &&
                         H5Sget_simple_extent_npoints(extent) == 1;
      if (plain) {
        text.resize(H5Tget_size(of_type));
        H5Aread(old, of_type, text.data());
      }
    }
    const std::size_t at = choices_.ConsumeIntegralInRange<std::size_t>(0, text.size());
    const auto removed = choices_.ConsumeIntegralInRange<std::size_t>(0, 40);
    text.replace(at, removed, choices_.ConsumeRandomLengthString(40));
    H5Adelete(owner, "scene");
    const Id of_type(H5Tcopy(H5T_C_S1)), scalar(H5Screate(H5S_SCALAR));
    H5Tset_size(of_type, text.size() + 1);
    H5Tset_strpad(of_type, choices_.ConsumeBool() ? H5T_STR_NULLTERM : H5T_STR_SPACEPAD);
    const Id made(H5Acreate2(owner, "scene", of_type, scalar, H5P_DEFAULT, H5P_DEFAULT));
    H5Awrite(made, of_type, text.c_str());
  }

  Id file_;
  const Contents& contents_;
  FuzzedDataProvider& choices_;
};

}  // namespace
}  // namespace vesiflow::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vesiflow::fuzz;
  static const InputFile file("checkpoint.h5");
  static CheckpointCase checkpoint(file.path());
  static const Contents contents = contents_of(file.path());
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  file.write({reinterpret_cast<const std::uint8_t*>(checkpoint.intact().data()), checkpoint.intact().size()});
  FuzzedDataProvider choices(data, size);
  {
    Editor editor(file.path(), contents, choices);
    while (choices.remaining_bytes() > 0) editor.edit();
  }
  const bool taken = checkpoint.restore(file.path());
  if (size == 0) check(taken, "an intact checkpoint is restored");
  return 0;
}
