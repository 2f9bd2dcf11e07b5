// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/binary_file.h"

#include <iterator>
#include <stdexcept>
#include <system_error>

namespace vesiflow::vesicle {

std::ifstream opened(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  // Before it is opened: a pipe would wait for its writer.
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    fail_in(path, "cannot be read: a folder, a pipe or a device; give a file on a disk");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail_in(path, "cannot be read: no such file, or no permission");
  return stream;
}

std::string contents_of(const std::filesystem::path& path) {
  std::ifstream stream = opened(path);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) fail_in(path, "reading failed");
  return bytes;
}

void fail_in(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + ": " + what);
}

}  // namespace vesiflow::vesicle
