// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "program.h"

/// The command line of a program, the same in all: help of one layout, options that several have under one name, errors of one
/// form. Every program has --threads, --quiet, --version, --completion and --help.
class CommandLine : public CLI::App {
 public:
  CommandLine(const std::string& name, const std::string& description);

  /// --out FOLDER, for `what`.
  CLI::Option* add_out(std::string& folder, const std::string& what);
  /// --json: results on standard output for programs to read, in place of tables.
  CLI::Option* add_json(bool& json);
  /// An option, or with a name without dashes an argument, that is one of several words.
  CLI::Option* add_choice(const std::string& option, std::string& word, const std::vector<std::string>& words,
                          const std::string& what);
  /// What bash completes the value of an option with. Options of type FILE, FOLDER and one|another need none.
  void complete(const std::string& option, std::vector<std::string> words) { words_[option] = std::move(words); }
  /// Refuses to be called without any argument, with the help.
  void require_arguments() { arguments_required_ = true; }

  /// Parses and checks; false if only help, the version or the completion was asked for, which is then printed. Sets the number
  /// of threads. May start the program again, see passive_waiting.h.
  /// \throws CommandLineError
  bool read(int argc, char** argv);
  /// The same of other arguments than those that the program is started again with.
  bool read(char** argv, const std::vector<std::string>& arguments);

  int threads() const { return threads_; }
  /// Whether --threads was given.
  bool chooses_threads() const { return get_option("--threads")->count() > 0; }
  bool is_quiet() const { return quiet_; }

 private:
  void declare_common();
  void check_words() const;
  void check_missing_values() const;
  std::string explain(const CLI::ParseError& error, const std::vector<std::string>& arguments);
  std::string explain_unexpected(const std::string& argument) const;

  int threads_ = 1;
  bool quiet_ = false, arguments_required_ = false;
  std::string shell_;
  std::map<std::string, std::vector<std::string>> words_;
};

/// Throws CommandLineError with the option, the value and what is allowed, unless ok.
void require(bool ok, const std::string& option, double given, const std::string& allowed);

/// The same of a number that must be finite and > 0.
void require_positive(const std::string& option, double given);
