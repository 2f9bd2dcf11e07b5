#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "equilibrium.h"

namespace equilibrium {

struct Arguments {
  Branch branch = Branch::prolate;
  std::vector<double> reduced_volumes;
  int latitudes = 32;
  Method method = Method::gradient_flow;
  double tolerance = 1e-9;
  int most_iterations = 0;
  std::filesystem::path output;  ///< empty: no files
  bool json = false, verbose = false, quiet = false;
};

/// What the command line asks for cannot be done. The message names the option, the value and what is allowed.
class CommandLineError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The reduced volumes of "0.9" or of "FROM:TO:STEP", both ends included, in either direction.
/// @throws CommandLineError
std::vector<double> parse_reduced_volumes(const std::string& text);

/// False if only help was asked for, which is then printed.
/// @throws CommandLineError
bool parse_command_line(int argc, char** argv, Arguments& arguments);

}  // namespace equilibrium
