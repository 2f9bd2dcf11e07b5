// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Checkpoints that are good HDF5 files with wrong contents, and states that are none. Each case was found by
// fuzz/checkpoint_contents.cpp or fuzz/state.cpp, or while writing them.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "run/checkpoint.h"
#include "run/errors.h"
#include "support/small_scene.h"

namespace vesiflow::run::checkpoint_contents_test {
namespace {

namespace fs = std::filesystem;

Scene tiny(const std::string& markers) {
  return coupling::small_scene(
      {"domain.cells=12", "mesh.latitudes=8", "mesh.tangential_degrees=8", "membrane.g=2", "time.markers=" + markers});
}

class CheckpointContents : public testing::Test {
 protected:
  CheckpointContents()
      : path_(fs::temp_directory_path() / ("vesiflow_contents_" + std::to_string(getpid()) + ".h5")),
        simulation_(tiny("euler")) {
    simulation_.step();
    write_checkpoint(path_, simulation_);
  }
  ~CheckpointContents() override { fs::remove(path_); }

  // In the place of an attribute of the root one of this type and extent.
  void replace(const char* name, hid_t type, hid_t space, const void* values) const {
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    H5Adelete(file, name);
    const hid_t attribute = H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Awrite(attribute, type, values), 0);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Fclose(file);
  }

  std::string complaint() {
    try {
      restore_checkpoint(path_, simulation_);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "none";
  }
  void expect_complaint(const std::string& part) {
    const std::string what = complaint();
    EXPECT_NE(what.find(part), std::string::npos) << what;
  }

  fs::path path_;
  SceneSimulation simulation_;
};

TEST_F(CheckpointContents, AreGoodHere) {
  EXPECT_EQ(complaint(), "none");
}

// HDF5 would write all of them where one is expected.
TEST_F(CheckpointContents, ManyNumbersWhereOneIsExpected) {
  const std::vector<double> values(1000, 1.0);
  const hsize_t extent = values.size();
  replace("time", H5T_NATIVE_DOUBLE, H5Screate_simple(1, &extent, nullptr), values.data());
  expect_complaint("time of / cannot be read");
}

TEST_F(CheckpointContents, ANumberWhereTextIsExpected) {
  const std::int64_t value = 7;
  replace("scene", H5T_NATIVE_INT64, H5Screate(H5S_SCALAR), &value);
  expect_complaint("scene of / is not a text");
}

// Its length in memory is that of a pointer.
TEST_F(CheckpointContents, TextOfVariableLength) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  const char* text = "[time]";
  replace("scene", type, H5Screate(H5S_SCALAR), &text);
  H5Tclose(type);
  expect_complaint("scene of / is not a text");
}

TEST_F(CheckpointContents, TextWithoutAnEnd) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, 5);
  H5Tset_strpad(type, H5T_STR_SPACEPAD);
  replace("scene", type, H5Screate(H5S_SCALAR), "[time");
  H5Tclose(type);
  expect_complaint("not valid TOML");
}

// Made without its storage it takes no room in the file.
TEST_F(CheckpointContents, ADataSetLargerThanTheFile) {
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Ldelete(file, "/pressure", H5P_DEFAULT);
  const hsize_t extent = hsize_t{1} << 40, chunk = 4;
  const hid_t space = H5Screate_simple(1, &extent, nullptr);
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(properties, 1, &chunk);
  H5Dclose(H5Dcreate2(file, "/pressure", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties, H5P_DEFAULT));
  H5Pclose(properties);
  H5Sclose(space);
  H5Fclose(file);
  expect_complaint("/pressure has 1099511627776 values");
}

// What is wrong with the state of a run that was changed in this way; "nothing" if it is restored.
std::string wrong_with(const std::string& markers, const std::function<void(coupling::VesicleState&)>& change) {
  SceneSimulation simulation(tiny(markers));
  simulation.step();
  simulation.step();
  coupling::SimulationState state = simulation.state();
  change(state.vesicles.at(0));
  try {
    simulation.restore(state);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing";
}

TEST(DamagedState, HistoriesMustBeFiniteWithCountsThatAreCounts) {
  constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
  const auto with = [](std::size_t place, double value) {
    return [=](coupling::VesicleState& vesicle) { vesicle.motion_history.at(place) = value; };
  };
  for (const char* markers : {"ab2", "shape_following"}) {
    EXPECT_EQ(wrong_with(markers, [](coupling::VesicleState&) {}), "nothing");
    EXPECT_EQ(wrong_with(markers, with(5, nan_value)), "the history of the markers has a value that is not finite");
  }
  // The length of a step and two counts.
  for (const std::size_t place : {0U, 1U, 2U}) {
    const std::string what = wrong_with("shape_following", with(place, -1.0));
    EXPECT_NE(what.find("shape_following: a history of a step of"), std::string::npos) << what;
  }
  EXPECT_NE(wrong_with("shape_following", with(1, 1e300)), "nothing");
}

// Whether the file has a data set of that name.
bool has_data(const fs::path& path, const char* name) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const bool has = H5Lexists(file, name, H5P_DEFAULT) > 0;
  H5Fclose(file);
  return has;
}

// What only sharp membranes between two viscosities have is no part of other files, which are what they were before there was any.
TEST_F(CheckpointContents, OnlyInterfacesOfTwoViscositiesHaveAVelocity) {
  EXPECT_TRUE(has_data(path_, "/vesicle_0/positions"));
  EXPECT_FALSE(has_data(path_, "/vesicle_0/interface_velocity"));
  SceneSimulation sharp(coupling::small_scene({"domain.cells=12", "mesh.latitudes=8", "mesh.tangential_degrees=8",
                                               "time.markers=shape_following", "coupling.method=sharp",
                                               "fluid.inertia=none", "fluid.viscosity_ratio=5"}));
  for (int step = 0; step < 2; ++step) sharp.step();
  write_checkpoint(path_, sharp);
  EXPECT_TRUE(has_data(path_, "/vesicle_0/interface_velocity"));
  const coupling::SimulationState state = read_checkpoint(path_).state;
  EXPECT_TRUE((state.vesicles[0].interface_velocity == sharp.state().vesicles[0].interface_velocity).all());
  ASSERT_GT(state.vesicles[0].previous_interface_velocity.rows(), 0);
  EXPECT_TRUE(
      (state.vesicles[0].previous_interface_velocity == sharp.state().vesicles[0].previous_interface_velocity).all());
  EXPECT_TRUE((state.vesicles[0].interface_velocity == sharp.marker_velocity(0)).all());

  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Ldelete(file, "/vesicle_0/interface_velocity", H5P_DEFAULT);
  H5Fclose(file);
  EXPECT_THROW(restore_checkpoint(path_, sharp), SceneError);
}

TEST_F(CheckpointContents, OnlyInterfacesOfTwoViscositiesWithInertiaHaveAnInside) {
  EXPECT_FALSE(has_data(path_, "/outer_velocity"));
  EXPECT_FALSE(has_data(path_, "/vesicle_0/inner_velocity"));
  SceneSimulation sharp(coupling::small_scene(
      {"domain.cells=12", "mesh.latitudes=8", "mesh.tangential_degrees=8", "time.markers=shape_following",
       "coupling.method=sharp", "fluid.inertia=full", "fluid.viscosity_ratio=5", "fluid.reynolds_number=1"}));
  for (int step = 0; step < 3; ++step) sharp.step();
  write_checkpoint(path_, sharp);
  const coupling::SimulationState written = sharp.state(), read = read_checkpoint(path_).state;
  ASSERT_EQ(read.outer_velocities.size(), 3U);
  EXPECT_EQ(read.earlier_step, written.earlier_step);
  EXPECT_GT(read.earlier_step, 0.0);
  for (const std::size_t i : {0U, 1U, 2U}) {
    const auto &a = written.outer_velocities[i].y, &b = read.outer_velocities[i].y;
    EXPECT_TRUE(std::equal(a.data(), a.data() + a.size(), b.data()));
  }
  ASSERT_EQ(read.vesicles[0].inner_velocities.size(), 3U);
  EXPECT_GT(read.vesicles[0].inner_velocities[0].size(), 6U);
  EXPECT_EQ(read.vesicles[0].inner_velocities, written.vesicles[0].inner_velocities);
  restore_checkpoint(path_, sharp);

  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Ldelete(file, "/vesicle_0/inner_velocity", H5P_DEFAULT);
  H5Fclose(file);
  EXPECT_THROW(restore_checkpoint(path_, sharp), SceneError);
}

}  // namespace
}  // namespace vesiflow::run::checkpoint_contents_test
