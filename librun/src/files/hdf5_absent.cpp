// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Stands in for hdf5_file.cpp in builds without HDF5.
#include "files/hdf5_file.h"
#include "run/errors.h"

namespace vesiflow::run {

QuietHdf5::QuietHdf5() = default;
QuietHdf5::~QuietHdf5() = default;

bool have_hdf5() {
  return false;
}

void spare_hdf5_at_exit() {}

Hdf5File::Hdf5File(const std::filesystem::path& path, Mode) : path_(path) {
  fail(
      "needs HDF5, and this build has none: configure with -DVESIFLOW_WITH_HDF5=ON, or switch off what asks for it "
      "(output.vesicle_every, output.fluid_every and output.checkpoint_every = 0)");
}
Hdf5File::~Hdf5File() = default;
void Hdf5File::fail(const std::string& what) const {
  throw FileError(path_.string() + ": " + what);
}

void Hdf5File::close() {
  fail("no HDF5");
}
void Hdf5File::write(const std::string&, const double*, const Shape&) {
  fail("no HDF5");
}
void Hdf5File::write(const std::string&, const float*, const Shape&) {
  fail("no HDF5");
}
void Hdf5File::write(const std::string&, const std::int32_t*, const Shape&) {
  fail("no HDF5");
}
void Hdf5File::attribute(const std::string&, const std::string&, double) {
  fail("no HDF5");
}
void Hdf5File::attribute(const std::string&, const std::string&, std::int64_t) {
  fail("no HDF5");
}
void Hdf5File::attribute(const std::string&, const std::string&, const std::vector<double>&) {
  fail("no HDF5");
}
void Hdf5File::attribute(const std::string&, const std::string&, const std::string&) {
  fail("no HDF5");
}
std::vector<double> Hdf5File::read(const std::string&) const {
  fail("no HDF5");
}
std::vector<double> Hdf5File::read_block(const std::string&, const Shape&, const Shape&) const {
  fail("no HDF5");
}
Hdf5File::Shape Hdf5File::shape(const std::string&) const {
  fail("no HDF5");
}
std::vector<double> Hdf5File::read_numbers(const std::string&, const std::string&, std::size_t) const {
  fail("no HDF5");
}
std::uint64_t Hdf5File::size(const std::string&) const {
  fail("no HDF5");
}
double Hdf5File::read_number(const std::string&, const std::string&) const {
  fail("no HDF5");
}
std::int64_t Hdf5File::read_integer(const std::string&, const std::string&) const {
  fail("no HDF5");
}
std::string Hdf5File::read_text(const std::string&, const std::string&) const {
  fail("no HDF5");
}
bool Hdf5File::exists(const std::string&) const {
  fail("no HDF5");
}
void Hdf5File::link(const std::string&, const std::string&) {
  fail("no HDF5");
}

}  // namespace vesiflow::run
