// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vesiflow::run {

/// While it lives, failures of HDF5 are not printed; then they are again, by whatever the host program had set.
class QuietHdf5 {
 public:
  QuietHdf5();
  ~QuietHdf5();
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;

 private:
  int (*print_)(std::int64_t, void*) = nullptr;  ///< H5E_auto2_t
  int (*old_print_)(void*) = nullptr;            ///< H5E_auto1_t, if the host uses the old interface
  void* data_ = nullptr;
};

/// The few things this library asks of HDF5. Names of groups and datasets are absolute paths; missing groups are
/// made. Every failure is a FileError naming the file, the object and what the system said. Built without HDF5, opening
/// a file throws. What is written has checksums: of the data (Fletcher-32, by chunks) and of the metadata (the file
/// format of HDF5 1.10); reading what has changed since fails. A block of zeros with its checksum is all that passes.
class Hdf5File {
 public:
  enum class Mode { create, read };
  using Shape = std::vector<std::uint64_t>;

  Hdf5File(const std::filesystem::path& path, Mode mode);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  void write(const std::string& name, const double* values, const Shape& shape);
  void write(const std::string& name, const float* values, const Shape& shape);
  void write(const std::string& name, const std::int32_t* values, const Shape& shape);
  void attribute(const std::string& group, const std::string& name, double value);
  void attribute(const std::string& group, const std::string& name, std::int64_t value);
  void attribute(const std::string& group, const std::string& name, const std::vector<double>& values);
  void attribute(const std::string& group, const std::string& name, const std::string& value);

  /// Makes `name` stand for the root of another file, whose path is taken from the folder of this one.
  void link(const std::string& name, const std::string& other_file);

  /// Ends the writing: only now is a full disk sure to have been noticed.
  void close();

  std::vector<double> read(const std::string& name) const;
  /// A block of a data set: `count` values along each axis from `start` on. Fails unless the block lies in the data set.
  std::vector<double> read_block(const std::string& name, const Shape& start, const Shape& count) const;
  /// How many values along each axis.
  Shape shape(const std::string& name) const;
  /// How many values a data set has.
  std::uint64_t size(const std::string& name) const;
  double read_number(const std::string& group, const std::string& name) const;
  std::int64_t read_integer(const std::string& group, const std::string& name) const;
  std::string read_text(const std::string& group, const std::string& name) const;
  /// An attribute of that many numbers.
  std::vector<double> read_numbers(const std::string& group, const std::string& name, std::size_t count) const;

  /// Whether its group, which must exist, has the object.
  bool exists(const std::string& name) const;

 private:
  [[noreturn]] void fail(const std::string& what) const;
  void write_values(const std::string& name, std::int64_t type, const void* values, const Shape& shape);
  void write_attribute(const std::string& group, const std::string& name, std::int64_t type, const Shape& shape,
                       const void* value);
  void read_attribute(const std::string& group, const std::string& name, std::int64_t type, void* value,
                      std::size_t count = 1) const;

  QuietHdf5 quiet_;  ///< failures become exceptions
  std::filesystem::path path_;
  std::int64_t file_ = -1;
};

/// Whether this build can write and read HDF5.
bool have_hdf5();

/// For programs, before anything is opened: HDF5 is not to clean up at exit. Every file is closed by then, but one that could
/// not be written, which HDF5 keeps and writes again, and 1.10.8 then crashes.
void spare_hdf5_at_exit();

}  // namespace vesiflow::run
