// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "program.h"

#include <new>

#include "streams.h"

void print_result(const std::string& text) {
  if (const std::string reason = put_out(text); !reason.empty())
    throw FileError("standard output: the result cannot be written: " + reason);
}

int run_program(const std::function<ExitCode()>& body) {
  const auto fail = [](ExitCode code, const char* message, const char* prefix = "") {
    say("error: {}{}\n", prefix, message);
    return code;
  };
  vesiflow::keep_standard_streams();
  try {
    return body();
  } catch (const CommandLineError& error) {
    return fail(bad_input, error.what());
  } catch (const std::invalid_argument& error) {  // the library refuses a value
    return fail(bad_input, error.what());
  } catch (const std::domain_error& error) {  // or a surface
    return fail(bad_input, error.what());
  } catch (const Stopped& error) {
    return fail(stopped, error.what());
  } catch (const FileError& error) {
    return fail(file_error, error.what());
  } catch (const std::bad_alloc&) {
    return fail(out_of_memory, "out of memory: fewer cells or latitudes take less");
  } catch (const std::exception& error) {
    return fail(internal_error, error.what(), "internal error: ");
  }
}
