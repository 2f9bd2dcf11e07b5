// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// How programs end (run/run.h).
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <csignal>
#include <exception>
#include <memory>
#include <new>

#include "files/hdf5_file.h"
#include "run/errors.h"
#include "run/run.h"
#include "run/run_status.h"
#include "standard_streams.h"

namespace vesiflow::run {
namespace {

// Loggers have names of their own: a second one of that name is refused.
void set_logger() {
  constexpr const char* name = "vesiflow";
  const std::shared_ptr<spdlog::logger> known = spdlog::get(name);
  spdlog::set_default_logger(known ? known : spdlog::stderr_color_mt(name));
  spdlog::set_pattern("%^%l%$: %v");
}

}  // namespace

int exit_code::of(RunStatus status) {
  return end_of(status).exit_code;
}

int exit_code_of(int (*program)(int argc, char** argv), int argc, char** argv) {
  keep_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // beyond `ulimit -f` writing fails, instead of ending the program
  spare_hdf5_at_exit();
  try {
    set_logger();
    return program(argc, argv);
  } catch (const SceneError& error) {
    spdlog::error("{}", error.what());
    return exit_code::bad_input;
  } catch (const coupling::SimulationStopped& error) {
    spdlog::error("{}", error.what());
    return exit_code::stopped;
  } catch (const FileError& error) {
    spdlog::error("{}", error.what());
    return exit_code::file_error;
  } catch (const std::bad_alloc&) {
    spdlog::error(
        "out of memory: more is needed than the machine, or the limit set for the program (ulimit -v), has left\n"
        "  --plan says how much a scene takes: about in proportion to domain.cells and to the square of "
        "mesh.latitudes\n"
        "  what was written before is whole: go on with --restart from the last checkpoint");
    return exit_code::out_of_memory;
  } catch (const std::exception& error) {
    spdlog::error("internal error: {}", error.what());
    return exit_code::internal_error;
  }
}

}  // namespace vesiflow::run
