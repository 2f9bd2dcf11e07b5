// Checkpoints that are good HDF5 files with wrong contents. Each of these cases was found by fuzz/checkpoint_contents.cpp, or
// while writing it.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "coupling/checkpoint.h"
#include "coupling/errors.h"
#include "hdf5_file.h"
#include "small_scene.h"
#include "snapshot_series.h"

namespace vesiflow::coupling {
namespace {

namespace fs = std::filesystem;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
const Overrides tiny{"domain.cells=12", "mesh.latitudes=8", "mesh.tangential_degrees=8", "membrane.g=2"};

class DamagedCheckpoint : public testing::Test {
 protected:
  DamagedCheckpoint()
      : path_(fs::temp_directory_path() / ("vesiflow_damaged_" + std::to_string(getpid()) + ".h5")),
        simulation_(small_scene(tiny)) {
    simulation_.step();
    simulation_.step();
    write_checkpoint(path_, simulation_);
  }
  ~DamagedCheckpoint() override { fs::remove(path_); }

  // The scene of the tests with another way to move the markers.
  void use(const std::string& markers) {
    Overrides overrides = tiny;
    overrides.push_back("time.markers=" + markers);
    other_.emplace(small_scene(overrides));
    other_->step();
    other_->step();
    write_checkpoint(path_, *other_);
  }

  Hdf5File open() const { return {path_, Hdf5File::Mode::append}; }

  std::string complaint() {
    try {
      read_checkpoint_scene(path_);
      restore_checkpoint(path_, other_ ? *other_ : simulation_);
    } catch (const SceneError& error) {
      const std::string what = error.what();
      return what.substr(what.find(path_.filename().string()) + path_.filename().string().size());
    }
    return "none";
  }

  // A value of a data set of n, made nan or another number.
  void set_first(const std::string& name, double value) {
    auto file = open();
    std::vector<double> values = file.read(name);
    const auto shape = file.shape(name);
    values.at(0) = value;
    file.remove(name);
    file.write(name, values.data(), shape);
  }

  fs::path path_;
  Simulation simulation_;
  std::optional<Simulation> other_;
};

TEST_F(DamagedCheckpoint, IsNotThisOne) {
  EXPECT_EQ(complaint(), "none");
}

// HDF5 would write all of them where one is expected.
TEST_F(DamagedCheckpoint, ManyNumbersWhereOneIsExpected) {
  open().attribute("/", "time", std::vector<double>(1000, 1.0));
  EXPECT_EQ(complaint(), ": time is missing or no number");
}

TEST_F(DamagedCheckpoint, ANumberWhereTextIsExpected) {
  open().attribute("/", "scene", std::int64_t{7});
  EXPECT_EQ(complaint(), ": scene is no text");
}

TEST_F(DamagedCheckpoint, TextWithoutAnEnd) {
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Adelete(file, "scene");
  const hid_t type = H5Tcopy(H5T_C_S1), scalar = H5Screate(H5S_SCALAR);
  H5Tset_size(type, 5);
  H5Tset_strpad(type, H5T_STR_SPACEPAD);
  const hid_t attribute = H5Acreate2(file, "scene", type, scalar, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, type, "[time");
  H5Aclose(attribute);
  H5Sclose(scalar);
  H5Tclose(type);
  H5Fclose(file);
  EXPECT_NE(complaint().find("not valid TOML"), std::string::npos) << complaint();
}

// Made without its storage it takes no room in the file.
TEST_F(DamagedCheckpoint, ADataSetLargerThanTheFile) {
  for (const std::vector<hsize_t>& extent :
       {std::vector<hsize_t>{hsize_t{1} << 40}, {hsize_t{1} << 40, hsize_t{1} << 24}}) {
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    H5Ldelete(file, "/pressure", H5P_DEFAULT);
    const hid_t space = H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr);
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    const std::vector<hsize_t> chunk(extent.size(), 4);
    H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
    H5Dclose(H5Dcreate2(file, "/pressure", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, properties, H5P_DEFAULT));
    H5Pclose(properties);
    H5Sclose(space);
    H5Fclose(file);
    EXPECT_EQ(complaint(), ": /pressure claims to be larger than the file: the file is damaged");
  }
}

TEST_F(DamagedCheckpoint, AMembraneOutsideTheBox) {
  set_first("/vesicle_0/positions", 50.0);
  EXPECT_NE(complaint().find("the checkpoint is damaged: marker 0 is at x = 50"), std::string::npos) << complaint();
}

TEST_F(DamagedCheckpoint, AMembraneWithoutAGeometry) {
  auto file = open();
  const std::vector<double> nowhere(3 * 128, 0.0);
  file.remove("/vesicle_0/positions");
  file.write("/vesicle_0/positions", nowhere.data(), {nowhere.size()});
  EXPECT_NE(complaint().find("the checkpoint is damaged: "), std::string::npos) << complaint();
}

TEST_F(DamagedCheckpoint, AHistoryThatIsNotFinite) {
  use("ab2");
  EXPECT_EQ(complaint(), "none");
  set_first("/vesicle_0/motion_history", nan_value);
  EXPECT_EQ(complaint(), ": the checkpoint is damaged: the history of the markers has a value that is not finite");
}

TEST_F(DamagedCheckpoint, AHistoryWithCountsThatAreNone) {
  use("shape_following");
  EXPECT_EQ(complaint(), "none");
  set_first("/vesicle_0/motion_history", -1.0);
  EXPECT_NE(complaint().find("shape_following: a history of a step of -1"), std::string::npos) << complaint();
}

TEST_F(DamagedCheckpoint, OrSnapshotsWithAStepThatIsNone) {
  Hdf5File(path_, Hdf5File::Mode::create).attribute("/steps/last", "time", 1.0);
  try {
    stored_steps(path_);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("/steps/last is no step"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace vesiflow::coupling
