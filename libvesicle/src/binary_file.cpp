#include "binary_file.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace vesiflow::vesicle {

std::string contents_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream || std::filesystem::is_directory(path)) fail_in(path, "cannot be read: no such file, or no permission");
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) fail_in(path, "reading failed");
  return bytes;
}

void fail_in(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + ": " + what);
}

}  // namespace vesiflow::vesicle
