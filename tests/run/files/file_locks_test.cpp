// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// File systems without locks, and readers that hold some: a run needs none of its own.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>

#include "files/descriptor.h"
#include "files/hdf5_file.h"
#include "run/errors.h"
#include "run/run.h"
#include "support/small_scene.h"

namespace {
bool has_locks = true;
}

// Stands in for the system's, also in the libraries: some network file systems have no locks.
extern "C" int flock(int descriptor, int operation) noexcept {
  if (has_locks) return static_cast<int>(syscall(SYS_flock, descriptor, operation));
  errno = ENOLCK;
  return -1;
}

namespace vesiflow::run::file_locks_test {
namespace {

namespace fs = std::filesystem;

class FileLocks : public testing::Test {
 protected:
  FileLocks()
      : folder_(fs::temp_directory_path() / ("vesiflow_file_locks_" + std::to_string(getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
  }
  ~FileLocks() override {
    has_locks = true;
    fs::remove_all(folder_);
  }
  void SetUp() override {
    if (!have_hdf5()) GTEST_SKIP() << "built without HDF5";
    if (std::getenv("HDF5_USE_FILE_LOCKING") != nullptr) GTEST_SKIP() << "HDF5_USE_FILE_LOCKING is set";
  }

  RunStatus run_to(const char* end, bool restart) const {
    SceneSimulation simulation(coupling::small_scene(
        {"domain.cells=16", "mesh.latitudes=12", "mesh.tangential_degrees=8", "time.step=1/32", "membrane.g=4", end}));
    RunOptions options;
    options.directory = folder_;
    if (restart) options.checkpoint = folder_ / "checkpoint.h5";
    options.quiet = true;
    return run(simulation, options);
  }

  fs::path folder_;
};

TEST_F(FileLocks, AreNotNeeded) {
  has_locks = false;
  EXPECT_EQ(run_to("time.end=0.125", false), RunStatus::completed);
  EXPECT_EQ(run_to("time.end=0.25", true), RunStatus::completed);
}

TEST_F(FileLocks, OfReadersDoNotHurt) {
  run_to("time.end=0.125", false);
  const Descriptor checkpoint(open((folder_ / "checkpoint.h5").c_str(), O_RDONLY));
  const Descriptor membranes(open((folder_ / "vesicle.h5").c_str(), O_RDONLY));
  const Descriptor fluid(open((folder_ / "fluid.h5").c_str(), O_RDONLY));
  for (const int file : {int{checkpoint}, int{membranes}, int{fluid}}) ASSERT_EQ(flock(file, LOCK_EX | LOCK_NB), 0);
  EXPECT_EQ(run_to("time.end=0.25", true), RunStatus::completed);
}

// Where the environment asks for locks, in a process of its own, as HDF5 looks there once.
TEST_F(FileLocks, WhereAskedForAreNamedAsTheCauseWithTheWayOut) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto open_with_locks = [&] {
    setenv("HDF5_USE_FILE_LOCKING", "TRUE", 1);
    has_locks = false;
    fs::create_directories(folder_);
    try {
      const Hdf5File file(folder_ / "file.h5", Hdf5File::Mode::create);
    } catch (const FileError& error) {
      std::fputs(error.what(), stderr);
      _exit(0);
    }
    _exit(1);
  };
  EXPECT_EXIT(open_with_locks(), testing::ExitedWithCode(0),
              "file.h5: cannot be created: No locks available; .*HDF5_USE_FILE_LOCKING=FALSE");
}

}  // namespace
}  // namespace vesiflow::run::file_locks_test
