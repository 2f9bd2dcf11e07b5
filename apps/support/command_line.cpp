// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>

#include "build_info.h"
#include "completion.h"
#include "passive_waiting.h"
#include "streams.h"
#include "vesiflow/version.h"

namespace {

constexpr int most_threads = 1024;
constexpr const char* see_help = "(--help lists the options)";

bool is_option(std::string_view argument) {
  return argument.starts_with("--");
}

// How many letters two names have in common at both ends: all but one or two where one is a slip of the other.
std::size_t likeness(std::string_view a, std::string_view b) {
  const std::size_t shorter = std::min(a.size(), b.size());
  std::size_t front = 0, back = 0;
  while (front < shorter && a[front] == b[front]) ++front;
  while (front + back < shorter && a[a.size() - 1 - back] == b[b.size() - 1 - back]) ++back;
  return front + back;
}

// What the name of a type in the help stands for.
std::string kind(const std::string& type) {
  if (type == "INT") return "a whole number";
  return type == "FLOAT" ? "a number" : type;
}

}  // namespace

CommandLine::CommandLine(const std::string& name, const std::string& description) : CLI::App(description, name) {
  threads_ = omp_get_max_threads();
  get_formatter()->label("INT", "N");
  get_formatter()->label("FLOAT", "X");
  get_formatter()->label("REQUIRED", "(required)");
}

// Last in the help, after the program's own.
void CommandLine::declare_common() {
  constexpr const char* group = "Options of all programs";
  add_option("--threads", threads_, "threads (default: all cores)")->group(group);
  add_flag("--quiet", quiet_, "results, warnings and errors only: no progress")->group(group);
  add_option("--completion", shell_, "print the completion for a shell and exit")->type_name("bash")->group(group);
  set_version_flag("--version",
                   fmt::format("{} of Vesiflow {}, revision {}", get_name(), VESIFLOW_VERSION, VESIFLOW_GIT_REVISION))
      ->description("print version and git revision and exit")
      ->group(group);
  set_help_flag("-h,--help", "print this and exit")->group(group);
}

CLI::Option* CommandLine::add_out(std::string& folder, const std::string& what) {
  return add_option("--out", folder, what)->type_name("FOLDER");
}

CLI::Option* CommandLine::add_json(bool& json) {
  return add_flag("--json", json, "results as JSON on standard output, in place of the tables");
}

CLI::Option* CommandLine::add_choice(const std::string& option, std::string& word,
                                     const std::vector<std::string>& words, const std::string& what) {
  complete(option, words);
  return add_option(option, word, what)->type_name(fmt::format("{}", fmt::join(words, "|")));
}

bool CommandLine::read(int argc, char** argv) {
  return read(argv, std::vector<std::string>(argv + 1, argv + argc));
}

bool CommandLine::read(char** argv, const std::vector<std::string>& arguments) {
  declare_common();
  if (arguments.empty() && arguments_required_) throw CommandLineError(fmt::format("nothing is asked for\n{}", help()));
  // Before the options that are required.
  if (const auto completion = std::ranges::find(arguments, "--completion"); completion != arguments.end()) {
    const std::string shell = completion + 1 == arguments.end() ? "" : *(completion + 1);
    if (shell != "bash") throw CommandLineError(fmt::format("--completion {}: must be bash", shell));
    print_result(bash_completion(*this, words_));
    return false;
  }
  try {
    parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::Success& asked) {
    exit(asked);
    return false;
  } catch (const CLI::ParseError& error) {
    throw CommandLineError(explain(error, arguments));
  }
  check_missing_values();
  check_words();
  require(threads_ >= 1 && threads_ <= most_threads, "--threads", threads_, fmt::format("from 1 to {}", most_threads));
  wait_passively(argv);
  if (const int cores = omp_get_num_procs(); threads_ > cores)
    say("warning: --threads {}: this program may use {} cores; more threads than that take turns\n", threads_, cores);
  omp_set_num_threads(threads_);
  return true;
}

// An option that is named where the value of another should be.
void CommandLine::check_missing_values() const {
  for (const CLI::Option* option : get_options())
    for (const std::string& result : option->results())
      if (is_option(result))
        throw CommandLineError(
            fmt::format("{}: its value is missing, what follows is {} {}", option->get_name(), result, see_help));
}

void CommandLine::check_words() const {
  for (const CLI::Option* option : get_options()) {
    const auto words = words_.find(option->get_name());
    if (words == words_.end() || option->get_type_name().find('|') == std::string::npos) continue;
    for (const std::string& result : option->results())
      if (std::ranges::find(words->second, result) == words->second.end())
        throw CommandLineError(
            fmt::format("{} {}: must be one of {}", option->get_name(), result, fmt::join(words->second, ", ")));
  }
}

std::string CommandLine::explain(const CLI::ParseError& error, const std::vector<std::string>& arguments) {
  const std::string text = error.what();
  // They are named first: an option that is missing may be one of them, misspelt.
  const std::vector<std::string> unused = remaining();
  if (const auto first = std::ranges::find_first_of(arguments, unused); first != arguments.end())
    return explain_unexpected(*first);
  constexpr std::string_view not_converted = "Could not convert: ";
  if (const std::size_t equals = text.find(" = "); text.starts_with(not_converted) && equals != std::string::npos) {
    const std::string name = text.substr(not_converted.size(), equals - not_converted.size());
    return fmt::format("{} {}: must be {}", name, text.substr(equals + 3), kind(get_option(name)->get_type_name()));
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
    if (const CLI::Option* option = get_option_no_throw(text.substr(0, text.find(':')))) {
      if (text.find("Most") != std::string::npos) return fmt::format("{}: may be given once only", option->get_name());
      return fmt::format("{}: {} missing, {} {}", option->get_name(),
                         option->get_items_expected_min() == 1
                             ? "its value is"
                             : fmt::format("of its {} values some are", option->get_items_expected_min()),
                         kind(option->get_type_name()), see_help);
    }
  return fmt::format("{} {}", text, see_help);
}

std::string CommandLine::explain_unexpected(const std::string& argument) const {
  if (!argument.starts_with('-'))
    return fmt::format("{}: is one argument more than this program takes {}", argument, see_help);
  const std::string name = argument.substr(0, argument.find('='));
  std::size_t most = (name.size() + 1) / 2;
  std::string nearest;
  for (const CLI::Option* option : get_options())
    for (const std::string& known : option->get_lnames())
      if (const std::size_t alike = likeness(name, "--" + known); alike > most && alike > 3) {
        most = alike;
        nearest = "--" + known;
      }
  return fmt::format("{}: there is no such option{} {}", name,
                     nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest), see_help);
}

void require(bool ok, const std::string& option, double given, const std::string& allowed) {
  if (!ok) throw CommandLineError(fmt::format("{} {}: must be {}", option, given, allowed));
}

void require_positive(const std::string& option, double given) {
  require(std::isfinite(given) && given > 0, option, given, "finite and > 0");
}
