// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "files/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "files/descriptor.h"
#include "run/errors.h"
#include "system_message.h"

namespace vesiflow::run {
namespace {

constexpr const char* temporary_ending = ".part";

// Without it the rename can reach the disk before the data does, and a power cut leaves an empty file.
void flush_to_disk(const std::filesystem::path& file) {
  const Descriptor descriptor(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!descriptor.valid() || fsync(descriptor) != 0)
    throw FileError(fmt::format("{}: cannot be written to disk: {}", file.string(), system_message()));
}

}  // namespace

std::filesystem::path temporary_of(const std::filesystem::path& target) {
  std::filesystem::path temporary = target;
  temporary += temporary_ending;
  return temporary;
}

bool is_temporary(const std::filesystem::path& file) {
  return file.extension() == temporary_ending;
}

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

void write_atomically(const std::filesystem::path& target,
                      const std::function<void(const std::filesystem::path&)>& write) {
  const std::filesystem::path temporary = temporary_of(target);
  std::error_code error;
  try {
    write(temporary);
    flush_to_disk(temporary);
    std::filesystem::rename(temporary, target);
  } catch (const std::filesystem::filesystem_error& failure) {
    std::filesystem::remove(temporary, error);
    throw FileError(fmt::format("{}: cannot be written: {}", target.string(), failure.code().message()));
  } catch (...) {
    std::filesystem::remove(temporary, error);
    throw;
  }
}

void write_text_atomically(const std::filesystem::path& target, const std::string& text) {
  write_atomically(target, [&](const std::filesystem::path& temporary) {
    const Descriptor descriptor(open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
    if (!descriptor.valid() || !write_all(descriptor, text))
      throw FileError(fmt::format("{}: cannot be written: {}", target.string(), system_message()));
  });
}

}  // namespace vesiflow::run
