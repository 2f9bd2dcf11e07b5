// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

#include "command_line.h"
#include "steady_run.h"

/// What the programs that take a flow to its steady state share.
struct SteadyArguments {
  double reynolds_number = 1;
  SteadyOptions steady;
  bool json = false;
};

/// Adds --reynolds-number, --time-step, --courant-number, --tolerance, --end and --json, with the values the arguments have as
/// defaults. `tolerance` says what the change is measured by.
void declare(CommandLine& command_line, SteadyArguments& arguments, const std::string& tolerance);

/// Reads the command line and checks what was declared above; false if only help was asked for.
/// Throws CommandLineError.
bool read(CommandLine& command_line, int argc, char** argv, SteadyArguments& arguments);
