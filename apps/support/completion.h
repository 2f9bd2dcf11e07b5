// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

/// A bash script that completes the options of a program and their values: files and folders where an option takes FILE or FOLDER,
/// `words` where there are some for it (by the name of the option, or of the argument). A word that ends on = wants more.
std::string bash_completion(const CLI::App& program, const std::map<std::string, std::vector<std::string>>& words);
