// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

/// Exit codes of the programs that run no scene: where these have them, those of run::exit_code (docs/architecture.md).
enum ExitCode { success = 0, internal_error = 1, bad_input = 2, stopped = 3, file_error = 4, out_of_memory = 5 };

/// What the command line asks for cannot be done. The message names the option, the value and what is allowed.
class CommandLineError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file or folder could not be written. The message names it.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The computation cannot go on. The message says why and what to change.
class Stopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes what the program was asked for to standard output. Throws FileError; a reader who has had enough (`| head`) is none.
void print_result(const std::string& text);

/// Runs the body; what it throws becomes an error on standard error and an exit code.
int run_program(const std::function<ExitCode()>& body);
