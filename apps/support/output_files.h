// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

/// Both throw FileError of program.h, naming the path.
void make_folder(const std::filesystem::path& folder);
void write_text(const std::filesystem::path& file, const std::string& text);
