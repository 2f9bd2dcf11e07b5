// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

namespace vesiflow::fuzz {

/// A file that holds the input of one execution after another; in memory where the system has /dev/shm.
class InputFile {
 public:
  explicit InputFile(const std::string& name)
      : path_(folder() / ("vesiflow_fuzz_" + std::to_string(getpid()) + "_" + name)) {}
  ~InputFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

  void write(std::span<const std::uint8_t> bytes) const {
    std::ofstream stream(path_, std::ios::binary | std::ios::trunc);
    for (const std::uint8_t byte : bytes) stream.put(static_cast<char>(byte));
    if (!stream.flush()) std::abort();  // the machine's fault: no finding
  }

  std::string text() const {
    std::ifstream stream(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

 private:
  static std::filesystem::path folder() {
    const std::filesystem::path in_memory = "/dev/shm";
    return std::filesystem::is_directory(in_memory) ? in_memory : std::filesystem::temp_directory_path();
  }

  std::filesystem::path path_;
};

}  // namespace vesiflow::fuzz
