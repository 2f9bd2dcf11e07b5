#include "program.h"

#include "streams.h"

void print_result(const std::string& text) {
  if (const std::string reason = put_out(text); !reason.empty())
    throw FileError("standard output: the result cannot be written: " + reason);
}

int run_program(const std::function<ExitCode()>& body) {
  const auto fail = [](ExitCode code, const char* prefix, const std::exception& error) {
    say("{}{}\n", prefix, error.what());
    return code;
  };
  keep_standard_streams();
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
