#include "program.h"

#include <fmt/format.h>

#include <cstdio>
#include <new>

int run_program(const std::function<ExitCode()>& body) {
  const auto fail = [](ExitCode code, const char* message, const char* prefix = "") {
    fmt::print(stderr, "error: {}{}\n", prefix, message);
    return code;
  };
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
