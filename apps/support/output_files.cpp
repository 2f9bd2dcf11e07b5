// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "output_files.h"

#include <fmt/format.h>

#include <fstream>

#include "program.h"

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw FileError(fmt::format("--out {}: cannot be made: {}", folder.string(), error.message()));
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text;
  stream.close();
  if (!stream) throw FileError(fmt::format("{}: cannot be written there", file.string()));
}
