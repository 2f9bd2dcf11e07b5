// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "steady_options.h"

void declare(CommandLine& command_line, SteadyArguments& arguments, const std::string& tolerance) {
  SteadyOptions& steady = arguments.steady;
  command_line.add_option("--reynolds-number", arguments.reynolds_number, "Reynolds number")->capture_default_str();
  command_line.add_option("--time-step", steady.time_step, "fixed time step (default: by the Courant number)");
  command_line.add_option("--courant-number", steady.courant_number, "largest dt (|u|/dx + |v|/dy + |w|/dz)")
      ->capture_default_str();
  command_line.add_option("--tolerance", steady.tolerance, "steady at this change " + tolerance)->capture_default_str();
  command_line.add_option("--end", steady.end, "stop at this time even if not steady")->capture_default_str();
  command_line.add_json(arguments.json);
}

bool read(CommandLine& command_line, int argc, char** argv, SteadyArguments& arguments) {
  if (!command_line.read(argc, argv)) return false;
  const SteadyOptions& steady = arguments.steady;
  require_positive("--reynolds-number", arguments.reynolds_number);
  require_positive("--time-step", steady.time_step.value_or(1));
  require(steady.courant_number > 0 && steady.courant_number <= 1, "--courant-number", steady.courant_number,
          "in (0, 1]");
  require_positive("--tolerance", steady.tolerance);
  require_positive("--end", steady.end);
  arguments.steady.progress = !command_line.is_quiet();
  return true;
}
