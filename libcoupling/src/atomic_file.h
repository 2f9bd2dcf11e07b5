#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace vesiflow::coupling {

/// Lets `write` fill a file of a temporary name beside `target`, then renames it over `target`: whoever reads sees
/// the old file or the new one, whole. The temporary file is removed when `write` throws.
/// \throws FileError when the file cannot be written
void write_atomically(const std::filesystem::path& target,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same for text.
void write_text_atomically(const std::filesystem::path& target, const std::string& text);

}  // namespace vesiflow::coupling
