#include "atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <system_error>

#include "coupling/errors.h"

namespace vesiflow::coupling {
namespace {

// Without it the rename can reach the disk before the data does, and a power cut leaves an empty file.
bool flush_to_disk(const std::filesystem::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool flushed = fsync(descriptor) == 0;
  close(descriptor);
  return flushed;
}

}  // namespace

void write_atomically(const std::filesystem::path& target,
                      const std::function<void(const std::filesystem::path&)>& write) {
  std::filesystem::path temporary = target;
  temporary += ".part";
  std::error_code error;
  try {
    write(temporary);
    if (!flush_to_disk(temporary)) throw FileError(fmt::format("{}: cannot be written to disk", temporary.string()));
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
    std::ofstream stream(temporary, std::ios::binary);
    stream << text << std::flush;
    if (!stream) throw FileError(fmt::format("{}: cannot be written: disk full, or no permission", target.string()));
  });
}

}  // namespace vesiflow::coupling
