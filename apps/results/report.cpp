// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// The report of a run that is under way or has ended: the page that a run writes at its end.
#include "run/report.h"

#include <fmt/format.h>

#include <filesystem>

#include "command_line.h"
#include "run/errors.h"
#include "run/run.h"
#include "streams.h"

namespace {

using namespace vesiflow::run;

struct Arguments {
  std::string folder;
  std::string file;
  int frames = ReportOptions{}.most_frames;
  bool live = false;
};

constexpr int most_frames = 10'000;

bool read(CommandLine& command_line, Arguments& arguments, int argc, char** argv) {
  command_line.require_arguments();
  command_line.add_option("folder", arguments.folder, "folder of a run, under way or ended")
      ->type_name("FOLDER")
      ->required();
  command_line.add_option("--file", arguments.file, "the page (default: report.html in the folder of the run)")
      ->type_name("FILE");
  command_line
      .add_option("--frames", arguments.frames, "snapshots of the membranes that the page holds at most, evenly chosen")
      ->capture_default_str();
  command_line.add_flag("--live", arguments.live, "a page for a server on this machine, which it asks for news");
  try {
    if (!command_line.read(argc, argv)) return false;
    require(arguments.frames >= 1 && arguments.frames <= most_frames, "--frames", arguments.frames,
            fmt::format("from 1 to {}", most_frames));
  } catch (const CommandLineError& error) {
    throw SceneError(error.what());
  }
  return true;
}

int report(int argc, char** argv) {
  Arguments arguments;
  CommandLine command_line(
      "report", "Writes the report of a run: one page with its membranes, numbers and scene, for any browser.");
  if (!read(command_line, arguments, argc, argv)) return exit_code::success;
  const std::filesystem::path file = arguments.file.empty() ? std::filesystem::path(arguments.folder) / report_name
                                                            : std::filesystem::path(arguments.file);
  write_report(arguments.folder, file, {.most_frames = arguments.frames, .live = arguments.live});
  if (!command_line.is_quiet())
    say("report in {}{}\n", file.string(),
        report_has_viewer() ? "" : "; it has no viewer, which scripts/viewer.sh makes for the next build");
  return exit_code::success;
}

}  // namespace

int main(int argc, char** argv) {
  return exit_code_of(report, argc, argv);
}
