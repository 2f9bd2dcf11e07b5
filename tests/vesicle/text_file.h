// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace vesiflow::vesicle::testing {

/// A file with this text in the folder for temporary files, removed at the end.
class TextFile {
 public:
  explicit TextFile(const std::string& name, const std::string& text = "")
      : path_(std::filesystem::temp_directory_path() / ("vesiflow_" + std::to_string(getpid()) + "_" + name)) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TextFile() { std::filesystem::remove(path_); }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// What `read` complains about in a file with this text, from the name of the file on; "accepted" if nothing.
template <class Read>
std::string complaint_about(const std::string& name, const std::string& text, const Read& read) {
  const TextFile file(name, text);
  try {
    read(file.path());
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    const std::size_t start = what.find(name);
    return start == std::string::npos ? what : what.substr(start);
  }
  return "accepted";
}

}  // namespace vesiflow::vesicle::testing
