// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene_app.h"

#include <fmt/format.h>

#include <algorithm>

#include "command_line.h"
#include "coupling/flow.h"
#include "memory_use.h"
#include "run/checkpoint.h"
#include "run/errors.h"
#include "run/plan.h"
#include "run/run.h"
#include "streams.h"

using namespace vesiflow::run;

namespace {

struct Arguments {
  std::string scene;
  std::string out;
  std::string checkpoint;
  std::string start_from;
  Overrides overrides;
  bool plan = false;
};

void declare(CommandLine& command_line, Arguments& arguments) {
  command_line.require_arguments();
  command_line
      .add_option("scene", arguments.scene,
                  "scene file (docs/scene.md), or a folder with a scene.toml; may be left out with --restart")
      ->type_name("FILE");
  command_line.add_out(arguments.out,
                       "the results (default: out/NAME_OF_SCENE, with --restart the checkpoint's folder)");
  command_line.add_option("--set", arguments.overrides, "override a key of the scene: --set time.end=2.0 (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command_line
      .add_option("--restart", arguments.checkpoint, "continue from this checkpoint.h5, or from that of a folder")
      ->type_name("FILE");
  command_line
      .add_option("--start-from", arguments.start_from,
                  "begin at t = 0 with vesicles and velocity of the end of this run: its folder or a checkpoint")
      ->type_name("FILE")
      ->excludes("--restart")
      ->needs("scene");
  command_line.add_flag("--plan", arguments.plan, "print what would be computed and written, then exit");
  std::vector<std::string> keys;
  for (const SceneKey& key : scene_keys())
    keys.push_back((key.name.starts_with("vesicles.") ? "vesicles.0" + key.name.substr(8) : key.name) + "=");
  command_line.complete("--set", keys);
}

// What the shell takes apart in `--set key = value`, and in `--set key= value`, is one word again.
std::vector<std::string> with_spaces_around_equals(int argc, char** argv) {
  const std::vector<std::string> given(argv + 1, argv + argc);
  std::vector<std::string> words;
  for (std::size_t i = 0; i < given.size(); ++i) {
    words.push_back(given[i]);
    if (given[i] != "--set" || ++i == given.size()) continue;
    std::string item = given[i];
    if (item.find('=') == std::string::npos && i + 1 < given.size() && given[i + 1].starts_with('='))
      item += given[++i];
    if (item.ends_with('=') && i + 1 < given.size() && !given[i + 1].starts_with("--")) item += given[++i];
    words.push_back(item);
  }
  return words;
}

bool is_folder(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

constexpr const char* checkpoint_name = "checkpoint.h5";

bool read(CommandLine& command_line, int argc, char** argv, Arguments& arguments) {
  try {
    if (!command_line.read(argv, with_spaces_around_equals(argc, argv))) return false;
  } catch (const CommandLineError& error) {
    throw SceneError(error.what());
  }
  if (is_folder(arguments.checkpoint))
    arguments.checkpoint = (std::filesystem::path(arguments.checkpoint) / checkpoint_name).string();
  return true;
}

Scene scene_of(const Arguments& arguments) {
  if (!arguments.scene.empty()) return load_scene(arguments.scene, arguments.overrides);
  if (arguments.checkpoint.empty())
    throw SceneError("a scene file is needed, or --restart with a checkpoint (--help shows how)");
  return read_checkpoint_scene(arguments.checkpoint, arguments.overrides);
}

void require_flow(const SceneApp& app, const Scene& scene, const std::string& file) {
  flow_of(scene);  // refuses what only a program can give
  const auto is_that = [&](const SceneApp::NamedFlow& flow) { return flow.type == scene.flow.type; };
  if (app.flows.empty() || std::ranges::any_of(app.flows, is_that)) return;
  std::string names;
  for (const auto& flow : app.flows) names += fmt::format("{}\"{}\"", names.empty() ? "" : " or ", flow.name);
  throw SceneError(fmt::format("{}: flow.type: {} computes {} only; use the app vesicles, which computes any", file,
                               app.name, names));
}

// A run goes on in its own folder. A checkpoint by another name is a copy: what lies beside it is not of its run.
std::filesystem::path directory_of(const Arguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  const std::filesystem::path checkpoint = arguments.checkpoint;
  if (checkpoint.filename() == checkpoint_name)
    return checkpoint.has_parent_path() ? checkpoint.parent_path() : std::filesystem::path(".");
  const std::filesystem::path named =
      std::filesystem::path(arguments.scene.empty() ? arguments.checkpoint : arguments.scene).lexically_normal();
  const std::filesystem::path last = named.has_filename() ? named : named.parent_path();
  return "out" / (is_folder(named) ? std::filesystem::absolute(last).lexically_normal().filename() : last.stem());
}

// What a run goes on or starts from, before anything is planned or computed.
void check_source(const Arguments& arguments, const std::filesystem::path& directory) {
  if (!arguments.checkpoint.empty()) read_checkpoint_scene(arguments.checkpoint);
  if (arguments.start_from.empty()) return;
  const std::filesystem::path source = arguments.start_from;
  const std::filesystem::path folder = is_folder(source) ? source : source.parent_path();
  std::error_code error;
  if (std::filesystem::equivalent(folder.empty() ? "." : folder, directory, error))
    throw SceneError(
        fmt::format("--start-from {}: is the folder that the results go to, from which its own are moved aside; choose "
                    "another with "
                    "--out",
                    arguments.start_from));
  read_checkpoint_scene(is_folder(source) ? source / checkpoint_name : source);
}

// What of the command line is not in a checkpoint.
std::vector<std::string> command_to_repeat(const char* program, const CommandLine& command_line) {
  std::vector<std::string> words{program};
  if (command_line.chooses_threads()) words.insert(words.end(), {"--threads", std::to_string(command_line.threads())});
  if (command_line.is_quiet()) words.emplace_back("--quiet");
  return words;
}

}  // namespace

int run_scene_app(const SceneApp& app, int argc, char** argv) {
  Arguments arguments;
  CommandLine command_line(app.name, app.description);
  declare(command_line, arguments);
  if (!read(command_line, argc, argv, arguments)) return exit_code::success;
  return_large_blocks();

  const std::string name = arguments.scene.empty() ? arguments.checkpoint : arguments.scene;
  const Scene scene = scene_of(arguments);
  require_flow(app, scene, name);
  const std::filesystem::path directory = directory_of(arguments);
  check_source(arguments, directory);
  if (arguments.plan) {
    if (const std::string reason = put_out(describe_plan(scene, command_line.threads(), directory)); !reason.empty())
      throw vesiflow::run::FileError("standard output: the plan cannot be written: " + reason);
    return exit_code::success;
  }

  if (const std::string warning = memory_warning(scene); !warning.empty()) say("warning: {}\n", warning);
  SceneSimulation simulation(scene);
  RunOptions options;
  options.program = app.name;
  options.scene_file = name;
  options.directory = directory;
  if (!arguments.checkpoint.empty()) options.checkpoint = arguments.checkpoint;
  if (!arguments.start_from.empty()) options.start_from = arguments.start_from;
  options.quiet = command_line.is_quiet();
  options.command = command_to_repeat(argv[0], command_line);
  const RunStatus status = run(simulation, options);
  if (!options.quiet) put_out(fmt::format("results in {}\n", directory.string()));
  return exit_code::of(status);
}
