// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/run.h"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <memory>
#include <new>

#include "files/atomic_file.h"
#include "files/file_error.h"
#include "files/folder_lock.h"
#include "files/hdf5_file.h"
#include "files/snapshot_files.h"
#include "phase_timer.h"
#include "run/checkpoint.h"
#include "run/errors.h"
#include "run/progress.h"
#include "run/results.h"
#include "run/run_status.h"
#include "run/shell_words.h"
#include "run/start_from.h"
#include "run/stop_request.h"
#include "standard_streams.h"

namespace vesiflow::run {
namespace {

// Whether the step that ended at `time` is the one for a multiple of `every`: the nearest of equal steps, and the first at or
// beyond it where steps are adaptive and the next is not known.
bool due(double every, double time, double dt, bool adaptive) {
  if (every <= 0.0) return false;
  if (adaptive) {
    constexpr double round_off = 1e-9;
    return std::floor(time / every + round_off) > std::floor((time - dt) / every + round_off);
  }
  return std::floor((time + 0.5 * dt) / every) > std::floor((time - 0.5 * dt) / every);
}

// Enters an account of output, less what is measured for it: that is a phase of its own.
class OutputTimer {
 public:
  OutputTimer(fluid::PhaseAccount& account, const SceneSimulation& simulation)
      : account_(account), simulation_(simulation), measured_before_(measured()), timer_(account) {}
  ~OutputTimer() { account_.seconds -= measured() - measured_before_; }
  OutputTimer(const OutputTimer&) = delete;
  OutputTimer& operator=(const OutputTimer&) = delete;

 private:
  double measured() const { return simulation_.phases().diagnostics.seconds; }

  fluid::PhaseAccount& account_;
  const SceneSimulation& simulation_;
  double measured_before_;
  PhaseTimer<fluid::PhaseAccount> timer_;
};

class Run {
 public:
  Run(SceneSimulation& simulation, const RunOptions& options)
      : simulation_(simulation), options_(options), directory_(options.directory), record_(simulation.scene()) {}

  RunStatus execute();
  [[noreturn]] void fail(const FileError& error);

 private:
  std::filesystem::path checkpoint_file() const { return directory_ / "checkpoint.h5"; }
  std::filesystem::path named_checkpoint() const { return options_.directory / "checkpoint.h5"; }  // as the user has it
  bool continues_own_directory() const {
    std::error_code error;
    return options_.checkpoint && std::filesystem::equivalent(*options_.checkpoint, checkpoint_file(), error);
  }

  // Whether what the run begins with is in its folder, where another run may be writing it.
  bool begins_in_own_directory() const;

  void take_folder();
  void restore();
  bool is_complete() const;
  void start();
  std::string scene_text() const;
  void rewind_files();
  void log_redistributions();
  void log_start();
  void record(bool last);
  void announce(RunOutput output) const;
  void take_step();
  void go_back(const coupling::SimulationStopped& reason);
  std::optional<RunStatus> wants_to_end() const;
  bool spoilt();
  void warn_of_resolution();
  void checkpoint();
  void finish(const std::string& status);
  void finish_stopped(const std::string& reason);
  [[noreturn]] void stop(const coupling::SimulationStopped& reason);
  bool may_go_back() const;
  void report_quality();
  bool can_go_on() const;
  std::string command_to_go_on() const;
  void say_how_to_go_on(RunStatus end) const;

  SceneSimulation& simulation_;
  const RunOptions& options_;
  std::optional<FolderLock> lock_;
  std::filesystem::path directory_;
  std::optional<DiagnosticsTable> table_;
  std::optional<SnapshotSeries> vesicle_snapshots_, fluid_snapshots_;
  std::optional<std::filesystem::path> last_checkpoint_;
  long checkpointed_step_ = -1;
  RunQuality::Errors errors_at_checkpoint_;
  bool warned_of_noise_ = false, warned_of_resolution_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<Progress> progress_;
  RunRecord record_;
};

// A build without HDF5 refuses a scene that asks for its files, before anything is touched.
void require_hdf5(const Scene::Output& output) {
  if (have_hdf5()) return;
  const auto refuse = [](const char* key, double every) {
    if (every > 0.0)
      throw SceneError(
          fmt::format("{} = {:g}: this build writes no HDF5; configure with -DVESIFLOW_WITH_HDF5=ON, or set "
                      "the key to 0",
                      key, every));
  };
  refuse("output.vesicle_every", output.vesicle_every);
  refuse("output.fluid_every", output.fluid_every);
  refuse("output.checkpoint_every", output.checkpoint_every);
}

bool Run::begins_in_own_directory() const {
  const auto& beginning = options_.checkpoint ? options_.checkpoint : options_.start_from;
  if (!beginning) return false;
  std::error_code error;
  const auto same = [&](const std::filesystem::path& a, const std::filesystem::path& b) {
    return std::filesystem::equivalent(a, b, error);
  };
  return same(*beginning, directory_) || same(*beginning, checkpoint_file()) ||
         same(std::filesystem::absolute(*beginning).parent_path(), directory_);
}

void Run::take_folder() {
  lock_.emplace(options_.directory);
  directory_ = lock_->folder();
  if (const auto& owner = lock_->taken_from()) spdlog::info("taken over from a run that is gone ({})", *owner);
}

void Run::restore() {
  if (!options_.checkpoint) return;
  restore_checkpoint(*options_.checkpoint, simulation_);
  last_checkpoint_ = *options_.checkpoint;
}

// Whether there is nothing to compute, and the results are those of this end. Others are not: of a run that was killed before its
// last summary, or of one that went on from here, whose checkpoint was exchanged for an earlier one.
bool Run::is_complete() const {
  return simulation_.finished() && continues_own_directory() && is_completed(directory_, simulation_.steps());
}

void Run::start() {
  if (options_.checkpoint)
    spdlog::info("continuing from {} at step {}, t = {:.6g}; results go on in {}", options_.checkpoint->string(),
                 simulation_.steps(), simulation_.time(), options_.directory.string());
  if (options_.start_from) {
    start_from(*options_.start_from, simulation_);
    const coupling::Start& start = *simulation_.started_from();
    spdlog::info("starting from {}, at its t = {:.6g} after {} steps", start.run, start.time, start.steps);
  }
  if (!lock_) take_folder();
  remove_leftovers(directory_);
  const bool own = continues_own_directory();
  if (own) checkpointed_step_ = simulation_.steps();
  if (!own) {
    if (const auto moved = move_earlier_results(directory_)) {
      spdlog::info("earlier results were moved to {}", moved->string());
      if (options_.checkpoint && !std::filesystem::exists(*options_.checkpoint)) last_checkpoint_.reset();
    }
  }
  if (options_.start_from) write_checkpoint(directory_ / "start.h5", simulation_);
  table_.emplace(directory_, simulation_.vesicle_count(), options_.diagnostics);
  vesicle_snapshots_.emplace(directory_, vesicle_snapshots(simulation_));
  fluid_snapshots_.emplace(directory_, fluid_snapshots(simulation_));
  if (own) rewind_files();
  write_text_atomically(directory_ / "scene.toml", scene_text());
  write_summary(directory_, options_, simulation_, record_);
}

std::string Run::scene_text() const {
  const char* const remark =
      "# This run started from another one, which summary.json names: its vesicles and its velocity were those, not "
      "what\n"
      "# follows. start.h5 repeats it.\n";
  return (simulation_.started_from() != nullptr ? remark : "") + to_toml(simulation_.scene());
}

// A run that went on after its last checkpoint has left rows and snapshots that will be computed again.
void Run::rewind_files() {
  table_->rewind(simulation_.steps());
  vesicle_snapshots_->drop_after(simulation_.steps());
  fluid_snapshots_->drop_after(simulation_.steps());
}

void Run::log_redistributions() {
  if (options_.quiet) return;
  for (const auto& [vesicle, report] : simulation_.last_redistributions()) {
    progress_->finish();
    spdlog::info(
        "t = {:.6g}: markers of vesicle {} redistributed, aspect ratio {:.3g} -> {:.3g}, spectrum tail {:.1e} -> "
        "{:.1e}, off the old surface by at most {:.1e}",
        simulation_.time(), vesicle, report.before.aspect_ratio, report.after.aspect_ratio, report.before.spectrum_tail,
        report.after.spectrum_tail, report.truncation);
  }
}

void Run::log_start() {
  if (options_.quiet || simulation_.steps() != 1 || simulation_.start_parts() == 0) return;
  progress_->finish();
  spdlog::info("shapes start far from rest: the first steps are taken in parts, the first of them in {}",
               simulation_.start_parts());
}

void Run::checkpoint() {
  table_->flush_to_disk();
  write_checkpoint(checkpoint_file(), simulation_);
  last_checkpoint_ = named_checkpoint();
  checkpointed_step_ = simulation_.steps();
  errors_at_checkpoint_ = record_.quality.errors();
  write_summary(directory_, options_, simulation_, record_);
}

void Run::announce(RunOutput output) const {
  if (options_.before_output) options_.before_output(simulation_, output);
}

// Writes what is due at the present time; at the end everything that is written at all.
void Run::record(bool last) {
  const Scene::Output& output = simulation_.scene().output;
  const long step = simulation_.steps();
  const double time = simulation_.time(), dt = simulation_.time_step();
  const bool adaptive = simulation_.scene().time.adaptive;
  const auto wanted = [&](double every) {
    return every > 0.0 && (last || step == 0 || due(every, time, dt, adaptive));
  };
  if (wanted(output.diagnostics_every) || wanted(output.vesicle_every) || wanted(output.fluid_every) ||
      wanted(output.checkpoint_every))
    lock_->require_held();
  if (wanted(output.diagnostics_every) && table_->last_step() < step) {
    announce(RunOutput::diagnostics);
    const OutputTimer timer(record_.output_table, simulation_);
    const std::vector<vesicle::Diagnostics> all = simulation_.measure();
    const std::vector<double> distances = simulation_.nearest_distances();
    table_->write(simulation_, all, distances);
    record_.quality.observe(simulation_, all, distances);
    warn_of_resolution();
  }
  if (wanted(output.vesicle_every) && vesicle_snapshots_->last_step() < step) {
    announce(RunOutput::vesicle_snapshot);
    const PhaseTimer timer(record_.output_vesicle);
    vesicle_snapshots_->write(step, time);
  }
  if (wanted(output.fluid_every) && fluid_snapshots_->last_step() < step) {
    announce(RunOutput::fluid_snapshot);
    const PhaseTimer timer(record_.output_fluid);
    fluid_snapshots_->write(step, time);
  }
  // At the start there is nothing to lose yet, but a state to go back to.
  const bool at_start = step == 0 && !last && simulation_.scene().ending.on_blowup == OnBlowUp::stop;
  if (wanted(output.checkpoint_every) && !at_start && checkpointed_step_ < step && !(spoilt() && !last)) {
    announce(RunOutput::checkpoint);
    const OutputTimer timer(record_.output_checkpoint, simulation_);
    checkpoint();
  }
}

// A checkpoint that may be the start of a blow-up would take the place of a good one.
bool Run::spoilt() {
  if (!simulation_.suspects_blow_up()) return false;
  if (!warned_of_noise_ && !options_.quiet) {
    progress_->finish();
    spdlog::warn(
        "t = {:.4g}: the velocity of a membrane is more noise than limits.velocity_noise allows; checkpoints wait "
        "until it is less",
        simulation_.time());
  }
  warned_of_noise_ = true;
  return true;
}

// Says once, of the vesicle that needs most, that meshes are too coarse for the shapes; not in the first steps, in which a shape that starts far
// from rest settles. The warnings at the end say how many they were.
void Run::warn_of_resolution() {
  constexpr long settling_steps = 10;
  if (warned_of_resolution_ || (simulation_.steps() > 0 && simulation_.steps() <= settling_steps)) return;
  std::size_t count = 0, worst = 0;
  vesicle::Resolution of_worst;
  for (std::size_t i = 0; i < simulation_.vesicle_count(); ++i) {
    const vesicle::Resolution resolution = vesicle::resolution(simulation_.membrane(i).surface());
    if (resolution.sufficient()) continue;
    if (count++ > 0 && !(resolution.unresolved > of_worst.unresolved)) continue;
    worst = i;
    of_worst = resolution;
  }
  if (count == 0) return;
  progress_->finish();
  spdlog::warn("vesicle {}{} at t = {:.4g}: {}; see mesh.latitudes", worst,
               count > 1 ? fmt::format(" and {} others", count - 1) : "", simulation_.time(),
               vesicle::resolution_warning(of_worst));
  warned_of_resolution_ = true;
}

void Run::finish(const std::string& status) {
  lock_->require_held();
  vesicle_snapshots_->list();
  fluid_snapshots_->list();
  record_.status = status;
  write_summary(directory_, options_, simulation_, record_);
}

// The reason goes into the summary if that can be written, which on a full disk it cannot.
void Run::finish_stopped(const std::string& reason) {
  record_.stop_reason = reason;
  try {
    finish("stopped");
  } catch (const FileError&) {
  }
}

void Run::stop(const coupling::SimulationStopped& reason) {
  const std::string message = fmt::format(
      "stopped in step {} at t = {:.6g}: {}\n  likely cause: {}\n  last good checkpoint: {}", simulation_.steps() + 1,
      simulation_.time(), reason.what(), reason.advice(), last_checkpoint_ ? last_checkpoint_->string() : "none yet");
  finish_stopped(message);
  throw coupling::SimulationStopped(message, reason.advice());
}

void Run::take_step() {
  const PhaseTimer timer(record_.wall);
  simulation_.step();
  ++record_.steps_taken;
  record_.quality.observe_step(simulation_);
  log_start();
  log_redistributions();
  progress_->update(simulation_);
  if (options_.after_step) options_.after_step(simulation_);
  record(simulation_.finished());
}

bool Run::may_go_back() const {
  const Scene::Ending& limits = simulation_.scene().ending;
  std::error_code error;
  return limits.on_blowup == OnBlowUp::reduce_step && static_cast<int>(record_.retries.size()) < limits.retries &&
         std::filesystem::exists(checkpoint_file(), error);
}

// The checkpoint may be of longer steps than those that have just failed.
void Run::go_back(const coupling::SimulationStopped& reason) {
  lock_->require_held();
  RunRecord::Retry retry{simulation_.steps() + 1, simulation_.time(), reason.what(), 0,
                         0.5 * simulation_.scene().time.step};
  simulation_.set_time_step(read_checkpoint_scene(checkpoint_file()).time.step);
  restore_checkpoint(checkpoint_file(), simulation_);
  simulation_.set_time_step(retry.time_step);
  retry.from_step = checkpointed_step_ = simulation_.steps();
  record_.quality.restore(errors_at_checkpoint_);
  rewind_files();
  spdlog::warn("step {} at t = {:.6g} cannot be taken: {}; going on from t = {:.6g} with time.step = {:.6g}",
               retry.step, retry.time, retry.cause, simulation_.time(), retry.time_step);
  record_.retries.push_back(std::move(retry));
}

std::optional<RunStatus> Run::wants_to_end() const {
  if (const auto status = status_of_signal(StopRequest::signal())) return status;
  const double limit = simulation_.scene().ending.wall_time;
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  if (limit > 0.0 && spent.count() >= limit) return RunStatus::out_of_time;
  return std::nullopt;
}

void Run::report_quality() {
  for (const std::string& warning : record_.quality.warnings()) spdlog::warn("{}", warning);
}

bool Run::can_go_on() const {
  std::error_code error;
  return last_checkpoint_ && std::filesystem::exists(*last_checkpoint_, error);
}

std::string Run::command_to_go_on() const {
  std::vector<std::string> words = options_.command;
  words.insert(words.end(), {"--restart", last_checkpoint_->string(), "--out", options_.directory.string()});
  return shell_line(words);
}

void Run::say_how_to_go_on(RunStatus end) const {
  spdlog::warn("{} at step {}, t = {:.6g} of {:g}\n  {}", end_of(end).cause, simulation_.steps(), simulation_.time(),
               simulation_.scene().time.end,
               can_go_on() ? "go on with: " + command_to_go_on()
                           : "there is nothing to go on from: output.checkpoint_every = 0 writes no checkpoints");
}

void Run::fail(const FileError& error) {
  if (!fluid_snapshots_) throw error;  // nothing has been computed yet
  const std::string message = can_go_on()
                                  ? fmt::format("{}\n  last good checkpoint: {}; when the cause is gone, go on with {}",
                                                error.what(), last_checkpoint_->string(), command_to_go_on())
                                  : fmt::format("{}\n  last good checkpoint: none yet", error.what());
  finish_stopped(message);
  throw FileError(message);
}

RunStatus Run::execute() {
  require_hdf5(simulation_.scene().output);
  const StopRequest guard;
  if (begins_in_own_directory()) take_folder();
  restore();
  if (is_complete()) {
    spdlog::info(
        "this run is complete at t = {:.6g}, nothing is computed or written; to go on, set a later time.end: --set "
        "time.end={:g}",
        simulation_.time(), 2.0 * simulation_.time());
    return RunStatus::completed;
  }
  start();
  progress_.emplace(options_.quiet, simulation_);
  try {
    const PhaseTimer timer(record_.wall);
    record(simulation_.finished());
  } catch (const coupling::SimulationStopped& reason) {
    stop(reason);
  }
  std::optional<RunStatus> end;
  while (!simulation_.finished() && !(end = wants_to_end())) {
    try {
      take_step();
    } catch (const coupling::SimulationStopped& reason) {
      progress_->finish();
      if (!may_go_back()) stop(reason);
      go_back(reason);
    }
  }
  progress_->finish();
  if (!end) end = RunStatus::completed;
  if (*end != RunStatus::completed) record(true);
  finish(end_of(*end).name);
  report_quality();
  if (*end != RunStatus::completed) say_how_to_go_on(*end);
  return *end;
}

// Loggers have names of their own: a second one of that name is refused.
void set_logger() {
  constexpr const char* name = "vesiflow";
  const std::shared_ptr<spdlog::logger> known = spdlog::get(name);
  spdlog::set_default_logger(known ? known : spdlog::stderr_color_mt(name));
  spdlog::set_pattern("%^%l%$: %v");
}

}  // namespace

RunStatus run(SceneSimulation& simulation, const RunOptions& options) {
  Run run(simulation, options);
  try {
    return run.execute();
  } catch (const FileError& error) {
    run.fail(error);
  } catch (const std::filesystem::filesystem_error& failure) {
    run.fail(file_error(failure));
  }
}

int exit_code::of(RunStatus status) {
  return end_of(status).exit_code;
}

int exit_code_of(int (*program)(int argc, char** argv), int argc, char** argv) {
  keep_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // beyond `ulimit -f` writing fails, instead of ending the program
  spare_hdf5_at_exit();
  try {
    set_logger();
    return program(argc, argv);
  } catch (const SceneError& error) {
    spdlog::error("{}", error.what());
    return exit_code::bad_input;
  } catch (const coupling::SimulationStopped& error) {
    spdlog::error("{}", error.what());
    return exit_code::stopped;
  } catch (const FileError& error) {
    spdlog::error("{}", error.what());
    return exit_code::file_error;
  } catch (const std::bad_alloc&) {
    spdlog::error(
        "out of memory: more is needed than the machine, or the limit set for the program (ulimit -v), has left\n"
        "  --plan says how much a scene takes: about in proportion to domain.cells and to the square of "
        "mesh.latitudes\n"
        "  what was written before is whole: go on with --restart from the last checkpoint");
    return exit_code::out_of_memory;
  } catch (const std::exception& error) {
    spdlog::error("internal error: {}", error.what());
    return exit_code::internal_error;
  }
}

}  // namespace vesiflow::run
