// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "files/snapshot_series.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "run/errors.h"

namespace vesiflow::run::snapshot_series_test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Bytes that this process has given to the system to write.
double bytes_written() {
  std::istringstream counts(text_of("/proc/self/io"));
  std::string name;
  double value = 0.0;
  while (counts >> name >> value)
    if (name == "wchar:") return value;
  return 0.0;
}

class Snapshots : public testing::Test {
 protected:
  // In memory where that can be: files are flushed to disk, which takes long.
  Snapshots()
      : folder_((fs::exists("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path()) /
                ("vesiflow_snapshots_" + std::to_string(getpid()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Snapshots() override { fs::remove_all(folder_); }
  void SetUp() override {
    if (!have_hdf5()) GTEST_SKIP() << "built without HDF5";
  }

  SnapshotSeries series() const {
    return {folder_,
            {.name = "thing",
             .head = [](Hdf5File& list) { list.attribute("/", "things", std::int64_t{7}); },
             .fill = [](Hdf5File& snapshot) { snapshot.write("/values", std::vector<double>(8192).data(), {8192}); },
             .xdmf =
                 [](const std::string& file, long, double time) {
                   return "<" + file + " at " + std::to_string(time) + std::string(300, ' ') + ">\n";
                 }}};
  }
  fs::path snapshot(const char* step) const { return folder_ / "snapshots" / ("thing_" + std::string(step) + ".h5"); }
  // How many snapshots the lists name; -1 if they do not agree.
  int listed() const {
    const Hdf5File list(folder_ / "thing.h5", Hdf5File::Mode::read);
    const std::string text = text_of(folder_ / "thing.xdmf");
    int count = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "snapshots")) {
      const std::string name = entry.path().filename().string(), step = name.substr(6, 9);
      const bool in_list = list.exists("/steps/" + step),
                 in_text = text.find("<snapshots/" + name) != std::string::npos;
      if (in_list != in_text) return -1;
      if (in_list) {
        EXPECT_EQ(list.size("/steps/" + step + "/values"), 8192U);
      }
      count += in_list;
    }
    return count;
  }

  fs::path folder_;
};

/// All that is written, lists included. Each is 67 kB; with copies of what is there, the last ones would take 20 MB.
TEST_F(Snapshots, CostTheSameHoweverManyThereAre) {
  SnapshotSeries all = series();
  constexpr int block = 60;
  std::vector<double> cost;
  for (int step = 0; step < 5 * block; ++step) {
    if (step % block == 0) cost.push_back(bytes_written());
    all.write(step, 0.1 * step);
  }
  cost.push_back(bytes_written());
  for (std::size_t k = 1; k < 5; ++k)
    EXPECT_NEAR((cost[k + 1] - cost[k]) / (cost[2] - cost[1]), 1.0, 0.05) << "snapshots from " << block * k;
}

TEST_F(Snapshots, AreListedAtOnceWhileTheyAreFewAndAtTheLatestWhenAsked) {
  SnapshotSeries all = series();
  for (int step = 0; step < 120; ++step) {
    all.write(step, step);
    if (step == 4 || step == 49) {
      ASSERT_EQ(listed(), step + 1);
    }
    if (step == 60 || step == 119) {
      ASSERT_GE(listed(), (step + 1) - (step + 1) / 50);
    }
  }
  all.list();
  EXPECT_EQ(listed(), 120);
}

TEST_F(Snapshots, AreFoundAgainWhateverTheListsSay) {
  {
    SnapshotSeries first = series();
    for (const long step : {0L, 8L, 1234567890L}) first.write(step, 0.5);
  }
  std::ofstream(folder_ / "snapshots" / "thing_note.h5") << "not a snapshot";
  std::ofstream(folder_ / "snapshots" / "other_000000099.h5") << "of another series";
  fs::remove(folder_ / "thing.h5");
  fs::remove(folder_ / "thing.xdmf");
  SnapshotSeries again = series();
  EXPECT_EQ(again.last_step(), 1234567890L);
  again.drop_after(1234567890L);
  const Hdf5File list(folder_ / "thing.h5", Hdf5File::Mode::read);
  EXPECT_EQ(list.read_integer("/", "things"), 7);
  EXPECT_EQ(list.read_number("/steps/000000008", "time"), 0.5);
  EXPECT_TRUE(list.exists("/steps/1234567890"));
  EXPECT_NE(text_of(folder_ / "thing.xdmf").find("thing_000000008.h5"), std::string::npos);
}

TEST_F(Snapshots, OfLaterStepsAreDroppedAndNoOthersTouched) {
  SnapshotSeries all = series();
  for (const int step : {0, 4, 8, 12}) all.write(step, step);
  const std::string kept = text_of(snapshot("000000004"));
  all.drop_after(7);
  EXPECT_EQ(all.last_step(), 4);
  EXPECT_EQ(listed(), 2);
  EXPECT_FALSE(fs::exists(snapshot("000000008")));
  EXPECT_FALSE(fs::exists(snapshot("000000012")));
  all.write(8, 8.5);
  EXPECT_EQ(text_of(snapshot("000000004")), kept);
  EXPECT_EQ(Hdf5File(folder_ / "thing.h5", Hdf5File::Mode::read).read_number("/steps/000000008", "time"), 8.5);
}

TEST_F(Snapshots, AreNamedByNoListWhenTheyAreGone) {
  const auto expect_none_listed = [&] {
    EXPECT_FALSE(Hdf5File(folder_ / "thing.h5", Hdf5File::Mode::read).exists("/steps"));
    EXPECT_EQ(text_of(folder_ / "thing.xdmf").find("thing_0"), std::string::npos);
  };
  SnapshotSeries all = series();
  for (const int step : {4, 8}) all.write(step, step);
  all.drop_after(3);
  expect_none_listed();
  all.write(4, 4.0);
  EXPECT_EQ(listed(), 1);
  fs::remove_all(folder_ / "snapshots");  // to save room
  series().drop_after(8);
  expect_none_listed();
}

TEST_F(Snapshots, ThatCannotBeReadOrRemovedAreErrorsOfFiles) {
  SnapshotSeries all = series();
  all.write(8, 8.0);
  fs::remove(snapshot("000000008"));
  fs::create_directories(snapshot("000000008") / "in the way");
  EXPECT_THROW(all.drop_after(0), FileError);
  fs::remove_all(folder_ / "snapshots");
  std::ofstream(folder_ / "snapshots") << "not a folder";
  EXPECT_THROW(series(), FileError);
}

/// Versions before kept the snapshots in the file that is a list now: it is not written over.
TEST_F(Snapshots, OfEarlierVersionsAreRefusedAndKept) {
  {
    Hdf5File earlier(folder_ / "thing.h5", Hdf5File::Mode::create);
    earlier.attribute("/", "format", std::int64_t{1});
    earlier.attribute("/steps/000000000", "time", 0.0);
    earlier.close();
  }
  const std::string before = text_of(folder_ / "thing.h5");
  try {
    series();
    FAIL() << "should have been refused";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("format 1, this version goes on with format 2 only; restart into another"),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(text_of(folder_ / "thing.h5"), before);
}

}  // namespace
}  // namespace vesiflow::run::snapshot_series_test
