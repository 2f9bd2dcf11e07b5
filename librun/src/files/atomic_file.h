// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace vesiflow::run {

/// Name under which a file is written before it is complete.
std::filesystem::path temporary_of(const std::filesystem::path& target);
bool is_temporary(const std::filesystem::path& file);

/// Lets `write` fill a file of that name beside `target`, then renames it over `target`: whoever reads sees
/// the old file or the new one, whole. The temporary file is removed when `write` throws.
/// \throws FileError when the file cannot be written
void write_atomically(const std::filesystem::path& target,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same for text.
void write_text_atomically(const std::filesystem::path& target, const std::string& text);

/// Writes the whole text, in more than one piece if the system takes less at once; false, with errno, if it cannot.
bool write_all(int descriptor, std::string_view text);

}  // namespace vesiflow::run
