// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/run.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <optional>

#include "files/atomic_file.h"
#include "files/file_error.h"
#include "files/hdf5_file.h"
#include "phase_timer.h"
#include "run/checkpoint.h"
#include "run/errors.h"
#include "run/last_checkpoint.h"
#include "run/recorder.h"
#include "run/report.h"
#include "run/results.h"
#include "run/run_folder.h"
#include "run/run_log.h"
#include "run/run_status.h"
#include "run/start_from.h"
#include "run/stop_request.h"

namespace vesiflow::run {
namespace {

class Run {
 public:
  Run(SceneSimulation& simulation, const RunOptions& options)
      : simulation_(simulation),
        options_(options),
        folder_(options),
        checkpoint_(simulation, options, folder_),
        record_(simulation.scene()) {}

  RunStatus execute();
  [[noreturn]] void fail(const FileError& error);
  /// What no library has thrown, but a function of the program: the folder says so and keeps what can be kept.
  void abandon(const std::string& reason);

 private:
  bool is_complete() const;
  void start();
  std::string scene_text() const;
  RunStatus take_steps();
  void take_step();
  bool may_go_back() const;
  void go_back(const coupling::SimulationStopped& reason);
  std::optional<RunStatus> wants_to_end() const;
  void finish(const std::string& status);
  void finish_stopped(const std::string& reason);
  [[noreturn]] void stop(const coupling::SimulationStopped& reason);
  void report() const;
  void report_quality() const;
  void say_how_to_go_on(RunStatus end) const;

  SceneSimulation& simulation_;
  const RunOptions& options_;
  RunFolder folder_;
  LastCheckpoint checkpoint_;
  RunRecord record_;
  std::optional<Recorder> recorder_;  // once there is something to record
  std::optional<RunLog> log_;         // the same
  bool is_between_steps_ = true;      // the state is whole
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
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

// Whether there is nothing to compute, and the results are those of this end. Others are not: of a run that was killed before its
// last summary, or of one that went on from here, whose checkpoint was exchanged for an earlier one.
bool Run::is_complete() const {
  return simulation_.finished() && folder_.has_its_checkpoint() && is_completed(folder_.path(), simulation_.steps());
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
  folder_.take();
  const std::filesystem::path& folder = folder_.path();
  remove_leftovers(folder);
  const bool own = folder_.has_its_checkpoint();
  if (own) checkpoint_.mark_current();
  if (!own) {
    if (const auto moved = move_earlier_results(folder)) {
      spdlog::info("earlier results were moved to {}", moved->string());
      checkpoint_.forget_what_was_moved();
    }
  }
  if (options_.start_from) write_checkpoint(folder / "start.h5", simulation_);
  recorder_.emplace(Recorder::Parts{simulation_, options_, folder_, checkpoint_, record_});
  if (own) recorder_->rewind();
  write_text_atomically(folder / "scene.toml", scene_text());
  write_summary(folder, options_, simulation_, record_);
}

std::string Run::scene_text() const {
  const char* const remark =
      "# This run started from another one, which summary.json names: its vesicles and its velocity were those, not "
      "what\n"
      "# follows. start.h5 repeats it.\n";
  return (simulation_.started_from() != nullptr ? remark : "") + to_toml(simulation_.scene());
}

void Run::finish(const std::string& status) {
  folder_.require_held();
  recorder_->list_snapshots();
  record_.status = status;
  write_summary(folder_.path(), options_, simulation_, record_);
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
      simulation_.time(), reason.what(), reason.advice(), checkpoint_.description());
  finish_stopped(message);
  report();
  throw coupling::SimulationStopped(message, reason.advice());
}

// Everything else is on disk by now: a report that cannot be written is no reason for the run to fail.
void Run::report() const {
  if (!simulation_.scene().output.report) return;
  const std::filesystem::path file = folder_.path() / report_name;
  try {
    folder_.require_held();
    write_report(folder_.path(), file);
    if (!options_.quiet) spdlog::info("report in {}", (options_.directory / report_name).string());
  } catch (const std::exception& reason) {
    spdlog::warn("there is no report: {}", reason.what());
  }
}

void Run::fail(const FileError& error) {
  if (!recorder_) throw error;  // nothing has been computed yet
  const std::string message =
      checkpoint_.can_be_continued()
          ? fmt::format("{}\n  last good checkpoint: {}; when the cause is gone, go on with {}", error.what(),
                        checkpoint_.description(), checkpoint_.command_to_continue())
          : fmt::format("{}\n  last good checkpoint: none yet", error.what());
  finish_stopped(message);
  throw FileError(message);
}

void Run::abandon(const std::string& reason) {
  if (!recorder_) return;  // nothing has been computed yet
  try {
    if (log_) log_->finish();
    folder_.require_held();
    if (is_between_steps_ && simulation_.scene().output.checkpoint_every > 0.0 &&
        checkpoint_.step() < simulation_.steps())
      recorder_->write_checkpoint();
  } catch (const std::exception&) {
  }
  finish_stopped(
      fmt::format("after step {} at t = {:.6g} a function of the program failed: {}\n  last good checkpoint: {}",
                  simulation_.steps(), simulation_.time(), reason, checkpoint_.description()));
  report();
}

void Run::take_step() {
  const PhaseTimer timer(record_.wall);
  is_between_steps_ = false;
  simulation_.step();
  is_between_steps_ = true;
  ++record_.steps_taken;
  record_.interface_passes += simulation_.interface_passes();
  record_.quality.observe_step(simulation_);
  log_->say_step(simulation_);
  if (options_.after_step) options_.after_step(simulation_);
  recorder_->write_what_is_due(simulation_.finished(), *log_);
}

bool Run::may_go_back() const {
  const Scene::Ending& limits = simulation_.scene().ending;
  return limits.on_blowup == OnBlowUp::reduce_step && static_cast<int>(record_.retries.size()) < limits.retries &&
         checkpoint_.can_go_back();
}

void Run::go_back(const coupling::SimulationStopped& reason) {
  folder_.require_held();
  RunRecord::Retry retry = checkpoint_.go_back(reason, record_.quality);
  recorder_->rewind();
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

void Run::report_quality() const {
  for (const std::string& warning : record_.quality.warnings()) spdlog::warn("{}", warning);
}

void Run::say_how_to_go_on(RunStatus end) const {
  spdlog::warn("{} at step {}, t = {:.6g} of {:g}\n  {}", end_of(end).cause, simulation_.steps(), simulation_.time(),
               simulation_.scene().time.end,
               checkpoint_.can_be_continued()
                   ? "go on with: " + checkpoint_.command_to_continue()
                   : "there is nothing to go on from: output.checkpoint_every = 0 writes no checkpoints");
}

// From the state at the start to the end, or to where the run is told to end.
RunStatus Run::take_steps() {
  try {
    const PhaseTimer timer(record_.wall);
    recorder_->write_what_is_due(simulation_.finished(), *log_);
  } catch (const coupling::SimulationStopped& reason) {
    stop(reason);
  }
  std::optional<RunStatus> end;
  while (!simulation_.finished() && !(end = wants_to_end())) {
    try {
      take_step();
    } catch (const coupling::SimulationStopped& reason) {
      log_->finish();
      if (!may_go_back()) stop(reason);
      go_back(reason);
    }
  }
  log_->finish();
  return end.value_or(RunStatus::completed);
}

RunStatus Run::execute() {
  require_hdf5(simulation_.scene().output);
  const StopRequest guard;
  if (folder_.has_the_beginning()) folder_.take();
  checkpoint_.restore();
  if (is_complete()) {
    spdlog::info(
        "this run is complete at t = {:.6g}, nothing is computed or written; to go on, set a later time.end: --set "
        "time.end={:g}",
        simulation_.time(), 2.0 * simulation_.time());
    return RunStatus::completed;
  }
  start();
  log_.emplace(options_.quiet, simulation_);
  const RunStatus end = take_steps();
  if (end != RunStatus::completed) recorder_->write_what_is_due(true, *log_);
  finish(end_of(end).name);
  report();
  report_quality();
  if (end != RunStatus::completed) say_how_to_go_on(end);
  return end;
}

}  // namespace

RunStatus run(SceneSimulation& simulation, const RunOptions& options) {
  Run run(simulation, options);
  try {
    return run.execute();
  } catch (const coupling::ParameterError& error) {  // a solver that is refused: it is made in the first step
    throw SceneError(error.what());
  } catch (const FileError& error) {
    run.fail(error);
  } catch (const std::filesystem::filesystem_error& failure) {
    run.fail(file_error(failure));
  } catch (const coupling::SimulationStopped&) {
    throw;  // it is in the folder
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    run.abandon(error.what());
    throw;
  }
}

}  // namespace vesiflow::run
