// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "completion.h"

#include <fmt/format.h>

namespace {

// Fills COMPREPLY with what bash's compgen gives, spaces in names kept.
std::string fill(const std::string& compgen_options) {
  return fmt::format(R"(mapfile -t COMPREPLY < <(compgen {} -- "$word"))", compgen_options);
}

constexpr const char* names_of_files = "; compopt -o filenames 2>/dev/null";

// What to do for the value of an option, or for an argument.
std::string action(const CLI::Option& option, const std::map<std::string, std::vector<std::string>>& words) {
  const std::string type = option.get_type_name();
  const auto of_option = words.find(option.get_name());
  std::string compgen;
  if (of_option != words.end()) compgen += fmt::format("-W '{}' ", fmt::join(of_option->second, " "));
  if (type == "FILE") compgen += "-f ";
  if (type == "FOLDER") compgen += "-d ";
  if (type == "bash") compgen += "-W bash ";
  if (compgen.empty()) return ":";
  const bool wants_more = of_option != words.end() && of_option->second.front().ends_with('=');
  compgen.pop_back();
  return fill(compgen) + (wants_more                           ? "; compopt -o nospace 2>/dev/null"
                          : type == "FILE" || type == "FOLDER" ? names_of_files
                                                               : "");
}

}  // namespace

std::string bash_completion(const CLI::App& program, const std::map<std::string, std::vector<std::string>>& words) {
  const std::string& name = program.get_name();
  std::string cases, options, argument = ":";
  for (const CLI::Option* option : program.get_options()) {
    if (option->get_positional()) {
      argument = action(*option, words);
      continue;
    }
    options += fmt::format(" --{}", option->get_lnames().front());
    if (option->get_items_expected_max() > 0)
      cases += fmt::format("    {}) {}; return ;;\n", option->get_name(), action(*option, words));
  }
  return fmt::format(
      "# Completion of {0} in bash: source <({0} --completion bash)\n"
      "_vesiflow_{0}() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}}\n"
      "  COMPREPLY=()\n"
      "  case ${{COMP_WORDS[COMP_CWORD - 1]}} in\n"
      "{1}"
      "  esac\n"
      "  if [[ $word == -* ]]; then\n"
      "    {2}\n"
      "    return\n"
      "  fi\n"
      "  {3}\n"
      "}}\n"
      "complete -F _vesiflow_{0} {0}\n",
      name, cases, fill(fmt::format("-W '{}'", options.substr(1))), argument);
}
