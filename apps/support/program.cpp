#include "program.h"

#include <fmt/format.h>

#include <cstdio>

int run_program(const std::function<ExitCode()>& body) {
  const auto fail = [](ExitCode code, const char* prefix, const std::exception& error) {
    fmt::print(stderr, "{}{}\n", prefix, error.what());
    return code;
  };
  try {
    return body();
  } catch (const CommandLineError& error) {
    return fail(bad_input, "", error);
  } catch (const std::invalid_argument& error) {  // the library refuses a value
    return fail(bad_input, "", error);
  } catch (const FileError& error) {
    return fail(file_error, "", error);
  } catch (const std::exception& error) {
    return fail(internal_error, "error: ", error);
  }
}
