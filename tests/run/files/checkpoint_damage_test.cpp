// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "files/hdf5_file.h"
#include "run/checkpoint.h"
#include "run/errors.h"
#include "support/small_scene.h"

namespace vesiflow::run::checkpoint_damage_test {
namespace {

namespace fs = std::filesystem;

// The smallest that has every data set a checkpoint can have, but that of a surface from a file.
Scene tiny_scene() {
  return coupling::small_scene({"domain.cells=8", "mesh.latitudes=8", "mesh.tangential_degrees=6", "time.step=1/32",
                                "time.adaptive=true", "time.markers=strain_relaxation", "membrane.integral_rate=2",
                                "membrane.g=1"});
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return bytes.str();
}

void put(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

// Every number of a state, to compare two to the last bit.
std::vector<double> numbers_of(const coupling::SimulationState& state) {
  std::vector<double> all{state.clock.time, state.clock.previous_time, state.clock.time_step,
                          static_cast<double>(state.clock.steps)};
  const auto add = [&all](const auto& values) { all.insert(all.end(), values.data(), values.data() + values.size()); };
  for (const fluid::FaceVector* u : {&state.velocity, &state.previous_velocity}) {
    add(u->x);
    add(u->y);
    add(u->z);
  }
  add(state.pressure);
  add(state.step_control);
  for (const coupling::VesicleState& v : state.vesicles) {
    add(v.membrane.positions);
    for (const auto* field :
         {&v.membrane.target_areas, &v.membrane.initial_areas, &v.membrane.lagged_strain, &v.membrane.integral_tension})
      add(*field);
    add(v.motion_history);
    all.insert(all.end(), {v.membrane.initial_volume, static_cast<double>(v.redistributions)});
  }
  return all;
}

class CheckpointDamage : public testing::Test {
 protected:
  CheckpointDamage()
      : folder_(fs::temp_directory_path() / ("vesiflow_damage_" + std::to_string(getpid()))),
        file_(folder_ / "checkpoint.h5"),
        simulation_(tiny_scene()),
        other_(tiny_scene()) {
    fs::create_directories(folder_);
    for (int i = 0; i < 3; ++i) simulation_.step();
    write_checkpoint(file_, simulation_);
    bytes_ = bytes_of(file_);
    original_ = numbers_of(simulation_.state());
  }
  ~CheckpointDamage() override { fs::remove_all(folder_); }

  // The message with which these bytes are refused; empty if they are read as the original, "silent" if as another.
  std::string outcome(const std::string& bytes) {
    put(file_, bytes);
    try {
      restore_checkpoint(file_, other_);
      const std::vector<double> read = numbers_of(other_.state());
      const bool same = read.size() == original_.size() &&
                        std::memcmp(read.data(), original_.data(), read.size() * sizeof(double)) == 0;
      return same ? "" : "silent";
    } catch (const SceneError& error) {
      return error.what();
    }
  }

  void expect_refused_or_same(const std::string& bytes, const std::string& what) {
    const std::string message = outcome(bytes);
    EXPECT_NE(message, "silent") << what;
    if (message.empty()) return;
    ++refused_;
    EXPECT_NE(message.find(file_.string()), std::string::npos) << what << ": " << message;
  }

  void flip_every(std::size_t stride) {
    constexpr std::array masks{0x01, 0x80, 0xff, 0x10};
    long tried = 0;
    for (std::size_t at = 0; at < bytes_.size(); at += stride, ++tried) {
      std::string bytes = bytes_;
      bytes[at] = static_cast<char>(bytes[at] ^ masks[static_cast<std::size_t>(tried) % masks.size()]);
      expect_refused_or_same(bytes, "byte " + std::to_string(at));
    }
    std::cout << refused_ << " of " << tried << " flipped bytes were refused\n";
    EXPECT_GT(refused_, 9 * tried / 10);  // the rest is padding
  }

  std::string damaged(std::size_t at, std::size_t count, char value) const {
    std::string bytes = bytes_;
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), std::min(count, bytes.size() - at), value);
    return bytes;
  }

  // Where a data set of these values begins in the file.
  std::size_t place_of(const double* values) const {
    return bytes_.find(std::string(reinterpret_cast<const char*>(values), 40 * sizeof(double)));
  }

  fs::path folder_, file_;
  SceneSimulation simulation_, other_;
  std::string bytes_;
  std::vector<double> original_;
  long refused_ = 0;
};

// In every kind of place; data sets lie next to what describes them.
TEST_F(CheckpointDamage, AFlippedByteIsRefusedOrUnused) {
  flip_every(137);
}

// Two minutes: run it by name with --gtest_also_run_disabled_tests when the format changes.
TEST_F(CheckpointDamage, DISABLED_EveryFlippedByteIsRefusedOrUnused) {
  flip_every(1);
}

// What a disk makes of a block it has lost.
TEST_F(CheckpointDamage, ZerosAndOnesInPlaceOfABlockAreRefusedOrUnused) {
  std::size_t count = 512;
  for (std::size_t at = 0; at < bytes_.size(); at += 4 * count / 3) {
    for (const char value : {'\0', '\xff'})
      expect_refused_or_same(damaged(at, count, value), std::to_string(count) + " bytes from " + std::to_string(at));
    count = count == 4096 ? 512 : 2 * count;
  }
  EXPECT_GT(refused_, 0);
}

TEST_F(CheckpointDamage, ATruncatedFileIsRefused) {
  for (std::size_t size = 0; size < bytes_.size(); size += bytes_.size() / 40)
    EXPECT_NE(outcome(bytes_.substr(0, size)).find(file_.string()), std::string::npos) << size;
  EXPECT_NE(outcome(bytes_.substr(0, bytes_.size() - 1)), "");
}

TEST_F(CheckpointDamage, TheMessageNamesTheDataSetAndWhatToDo) {
  const coupling::SimulationState state = simulation_.state();
  const auto expect_named = [&](const double* values, const char* name) {
    const std::size_t at = place_of(values);
    const std::string message = outcome(damaged(at + 9, 1, static_cast<char>(~bytes_[at + 9])));
    for (const char* part : {name, "damaged", "start anew from the scene"})
      EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect_named(state.velocity.x.data(), "/velocity/x");
  expect_named(state.velocity.z.data(), "/velocity/z");
  expect_named(state.vesicles[0].membrane.positions.data(), "/vesicle_0/positions");
  expect_named(state.vesicles[0].membrane.lagged_strain.data(), "/vesicle_0/lagged_strain");
}

/// HDF5's checksum of zeros is zero, and one data set is as sound as the other: only the sum of the values tells.
TEST_F(CheckpointDamage, WhatTheChecksumsOfDataSetsCannotTellIsRefused) {
  const coupling::SimulationState state = simulation_.state();
  const std::size_t stored = state.velocity.x.size() * sizeof(double) + 4;
  const std::size_t x = place_of(state.velocity.x.data()), previous = place_of(state.previous_velocity.x.data());
  EXPECT_NE(outcome(damaged(x, stored, '\0')).find("the state is not what was written"), std::string::npos);
  std::string exchanged = bytes_;
  std::swap_ranges(exchanged.begin() + static_cast<std::ptrdiff_t>(x),
                   exchanged.begin() + static_cast<std::ptrdiff_t>(x + stored),
                   exchanged.begin() + static_cast<std::ptrdiff_t>(previous));
  EXPECT_NE(exchanged, bytes_);
  EXPECT_NE(outcome(exchanged).find("the state is not what was written"), std::string::npos);
}

TEST_F(CheckpointDamage, AnotherFormatIsRefusedByName) {
  {
    Hdf5File file(file_, Hdf5File::Mode::create);
    file.attribute("/", "format", std::int64_t{4});
    file.close();
  }
  const std::string message = outcome(bytes_of(file_));
  for (const char* part : {"format 4, this version reads format 5", "version of the program that wrote it"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST_F(CheckpointDamage, WrittenAgainItIsTheSameFile) {
  write_checkpoint(file_, simulation_);
  EXPECT_EQ(bytes_of(file_), bytes_);
}

}  // namespace
}  // namespace vesiflow::run::checkpoint_damage_test
