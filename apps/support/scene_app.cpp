#include "scene_app.h"

#include <fmt/format.h>
#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "coupling/checkpoint.h"
#include "coupling/errors.h"
#include "coupling/flow.h"
#include "coupling/plan.h"
#include "coupling/run.h"
#include "memory_use.h"
#include "passive_waiting.h"
#include "streams.h"

using namespace vesiflow::coupling;

namespace {

struct Arguments {
  std::string scene;
  std::string directory;
  std::string checkpoint;
  std::string start_from;
  Overrides overrides;
  int threads = omp_get_max_threads();
  bool plan = false;
  bool quiet = false;
};

void declare(CLI::App& command_line, Arguments& arguments) {
  command_line.add_option("scene", arguments.scene, "scene file (docs/scene.md); with --restart it may be left out");
  command_line.add_option("--out", arguments.directory, "folder for the results (default out/NAME_OF_SCENE)");
  command_line.add_option("--set", arguments.overrides, "override a key of the scene: --set time.end=2.0 (repeatable)")
      ->allow_extra_args(false);
  command_line.add_option("--threads", arguments.threads, "threads (default: all cores)")->check(CLI::Range(1, 1024));
  command_line.add_option("--restart", arguments.checkpoint, "continue from this checkpoint.h5");
  command_line
      .add_option("--start-from", arguments.start_from,
                  "begin at t = 0 with vesicles and velocity of the end of this run: its folder or a checkpoint")
      ->excludes("--restart")
      ->needs("scene");
  command_line.add_flag("--plan", arguments.plan, "print what would be computed and written, then exit");
  command_line.add_flag("--quiet", arguments.quiet, "no progress");
}

Scene scene_of(const Arguments& arguments) {
  if (!arguments.scene.empty()) return load_scene(arguments.scene, arguments.overrides);
  if (arguments.checkpoint.empty()) throw SceneError("a scene file is needed (or --restart with a checkpoint)");
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

std::filesystem::path directory_of(const Arguments& arguments) {
  if (!arguments.directory.empty()) return arguments.directory;
  if (arguments.scene.empty()) return std::filesystem::absolute(arguments.checkpoint).parent_path();
  return std::filesystem::path("out") / std::filesystem::path(arguments.scene).stem();
}

// What of the command line is not in a checkpoint.
std::vector<std::string> command_to_repeat(const char* program, const Arguments& arguments) {
  std::vector<std::string> words{program};
  if (arguments.threads != omp_get_num_procs())
    words.insert(words.end(), {"--threads", std::to_string(arguments.threads)});
  if (arguments.quiet) words.emplace_back("--quiet");
  return words;
}

}  // namespace

int run_scene_app(const SceneApp& app, int argc, char** argv) {
  Arguments arguments;
  CLI::App command_line(app.description, app.name);
  declare(command_line, arguments);
  try {
    command_line.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return command_line.exit(error) == 0 ? exit_code::success : exit_code::bad_input;
  }
  wait_passively(argv);
  return_large_blocks();

  const std::string name = arguments.scene.empty() ? arguments.checkpoint : arguments.scene;
  const Scene scene = scene_of(arguments);
  require_flow(app, scene, name);
  omp_set_num_threads(arguments.threads);
  if (arguments.plan) {
    if (const std::string reason = put_out(describe_plan(scene, arguments.threads)); !reason.empty())
      throw FileError("standard output: the plan cannot be written: " + reason);
    return exit_code::success;
  }

  if (const std::string warning = memory_warning(scene); !warning.empty()) say("warning: {}\n", warning);
  Simulation simulation(scene);
  RunOptions options;
  options.program = app.name;
  options.scene_file = name;
  options.directory = directory_of(arguments);
  if (!arguments.checkpoint.empty()) options.checkpoint = arguments.checkpoint;
  if (!arguments.start_from.empty()) options.start_from = arguments.start_from;
  options.quiet = arguments.quiet;
  options.command = command_to_repeat(argv[0], arguments);
  const RunStatus status = run(simulation, options);
  if (!arguments.quiet) put_out(fmt::format("results in {}\n", options.directory.string()));
  return exit_code::of(status);
}
