// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "files/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "run/errors.h"

namespace vesiflow::run::atomic_file_test {
namespace {

namespace fs = std::filesystem;

class AtomicFile : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::temp_directory_path() / ("vesiflow_atomic_file_" + std::to_string(getpid()));
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }

  static std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory_), fs::directory_iterator{}));
  }

  fs::path directory_;
};

TEST_F(AtomicFile, TakesThePlaceOfTheOldOneWhole) {
  const fs::path file = directory_ / "a.txt";
  write_text_atomically(file, "first");
  EXPECT_EQ(text_of(file), "first");
  write_atomically(file, [&](const fs::path& temporary) {
    std::ofstream(temporary) << "second, longer";
    EXPECT_EQ(text_of(file), "first") << "the old one is there until the new one is whole";
  });
  EXPECT_EQ(text_of(file), "second, longer");
  EXPECT_EQ(files(), 1U);
}

// A reader that has opened the old file goes on reading it.
TEST_F(AtomicFile, LeavesReadersOfTheOldOneAlone) {
  const fs::path file = directory_ / "a.txt";
  write_text_atomically(file, "first");
  std::ifstream reader(file);
  write_text_atomically(file, "other");
  EXPECT_EQ((std::string{std::istreambuf_iterator<char>(reader), {}}), "first");
}

TEST_F(AtomicFile, LeavesTheOldOneWhenWritingFails) {
  const fs::path file = directory_ / "a.txt";
  write_text_atomically(file, "first");
  const auto fail_half_way = [&](const fs::path& temporary) {
    std::ofstream(temporary) << "half";
    throw FileError("no more room");
  };
  EXPECT_THROW(write_atomically(file, fail_half_way), FileError);
  EXPECT_EQ(text_of(file), "first");
  EXPECT_EQ(files(), 1U) << "nothing of the new one is left";
}

TEST_F(AtomicFile, NamesTheFileAndTheSystemsReason) {
  const fs::path file = directory_ / "missing" / "a.txt";
  try {
    write_text_atomically(file, "text");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace vesiflow::run::atomic_file_test
