#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>

#include "steady_run.h"

/// What the programs that take a flow to its steady state share.
struct SteadyArguments {
  double reynolds_number = 1;
  SteadyOptions steady;
  int threads = 1;
  bool json = false, quiet = false;
};

/// Adds --reynolds-number, --time-step, --courant-number, --tolerance, --end, --threads, --json and --quiet, with the values
/// the arguments have as defaults. `tolerance` says what the change is measured by.
void declare(CLI::App& command_line, SteadyArguments& arguments, const std::string& tolerance);

/// Parses and checks; false if only help was asked for, which is then printed. Sets the number of threads.
/// Throws CommandLineError.
bool parse(CLI::App& command_line, int argc, char** argv, SteadyArguments& arguments);

/// Throws CommandLineError with the option, the value and what is allowed, unless ok.
void require(bool ok, const std::string& option, double given, const std::string& allowed);
