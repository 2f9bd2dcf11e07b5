#include "coupling/run.h"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <new>

#include "atomic_file.h"
#include "coupling/checkpoint.h"
#include "coupling/errors.h"
#include "hdf5_file.h"
#include "phase_timer.h"
#include "progress.h"
#include "results.h"
#include "snapshot_files.h"

namespace vesiflow::coupling {
namespace {

std::atomic<bool> interrupt_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // may be set in a signal handler

// Turns Ctrl-C and SIGTERM into a request to stop after the step under way. A second one kills as usual.
class InterruptGuard {
 public:
  InterruptGuard() {
    interrupt_requested = false;
    old_interrupt_ = std::signal(SIGINT, request);
    old_terminate_ = std::signal(SIGTERM, request);
  }
  ~InterruptGuard() {
    std::signal(SIGINT, old_interrupt_);
    std::signal(SIGTERM, old_terminate_);
  }
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  static void request(int signal) {
    interrupt_requested = true;
    std::signal(signal, SIG_DFL);
  }
  void (*old_interrupt_)(int);
  void (*old_terminate_)(int);
};

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
  OutputTimer(fluid::PhaseAccount& account, const Simulation& simulation)
      : account_(account), simulation_(simulation), measured_before_(measured()), timer_(account) {}
  ~OutputTimer() { account_.seconds -= measured() - measured_before_; }
  OutputTimer(const OutputTimer&) = delete;
  OutputTimer& operator=(const OutputTimer&) = delete;

 private:
  double measured() const { return simulation_.phases().diagnostics.seconds; }

  fluid::PhaseAccount& account_;
  const Simulation& simulation_;
  double measured_before_;
  PhaseTimer timer_;
};

class Run {
 public:
  Run(Simulation& simulation, const RunOptions& options)
      : simulation_(simulation), options_(options), directory_(options.directory) {}

  RunStatus execute();
  [[noreturn]] void fail(const FileError& error);

 private:
  std::filesystem::path checkpoint_file() const { return directory_ / "checkpoint.h5"; }
  bool continues_own_directory() const {
    std::error_code error;
    return options_.checkpoint && std::filesystem::equivalent(*options_.checkpoint, checkpoint_file(), error);
  }

  void start();
  void rewind_files();
  void log_redistributions();
  void record(bool last);
  void warn_of_resolution();
  void checkpoint();
  void finish(const std::string& status);
  [[noreturn]] void stop(const SimulationStopped& reason);

  Simulation& simulation_;
  const RunOptions& options_;
  std::filesystem::path directory_;
  std::optional<DiagnosticsTable> table_;
  std::optional<VesicleSnapshots> vesicle_snapshots_;
  std::optional<FluidSnapshots> fluid_snapshots_;
  std::optional<std::filesystem::path> last_checkpoint_;
  long checkpointed_step_ = -1;
  std::vector<bool> warned_;  ///< of the resolution, per vesicle
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

void Run::start() {
  require_hdf5(simulation_.scene().output);
  if (options_.checkpoint) {
    restore_checkpoint(*options_.checkpoint, simulation_);
    last_checkpoint_ = *options_.checkpoint;
    spdlog::info("continuing from {} at step {}, t = {:.6g}", options_.checkpoint->string(), simulation_.steps(),
                 simulation_.time());
  }
  prepare_directory(directory_);
  const bool own = continues_own_directory();
  if (own) checkpointed_step_ = simulation_.steps();
  if (!own) {
    if (const auto moved = move_earlier_results(directory_)) {
      spdlog::info("earlier results were moved to {}", moved->string());
      if (options_.checkpoint && !std::filesystem::exists(*options_.checkpoint)) last_checkpoint_.reset();
    }
  }
  table_.emplace(directory_);
  vesicle_snapshots_.emplace(directory_);
  fluid_snapshots_.emplace(directory_);
  if (own) rewind_files();
  write_text_atomically(directory_ / "scene.toml", to_toml(simulation_.scene()));
  write_summary(directory_, options_, simulation_, record_);
}

// A run that went on after its last checkpoint has left rows and snapshots that will be computed again.
void Run::rewind_files() {
  table_->rewind(simulation_.steps());
  vesicle_snapshots_->rewind(simulation_);
  fluid_snapshots_->rewind(simulation_);
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

void Run::checkpoint() {
  table_->flush_to_disk();
  write_checkpoint(checkpoint_file(), simulation_);
  last_checkpoint_ = checkpoint_file();
  checkpointed_step_ = simulation_.steps();
  write_summary(directory_, options_, simulation_, record_);
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
  if (wanted(output.diagnostics_every) && table_->last_step() < step) {
    const OutputTimer timer(record_.output_table, simulation_);
    table_->write(simulation_);
    warn_of_resolution();
  }
  if (wanted(output.vesicle_every) && vesicle_snapshots_->last_step() < step) {
    const PhaseTimer timer(record_.output_vesicle);
    vesicle_snapshots_->write(simulation_);
  }
  if (wanted(output.fluid_every) && fluid_snapshots_->last_step() < step) {
    const PhaseTimer timer(record_.output_fluid);
    fluid_snapshots_->write(simulation_);
  }
  const bool at_start = step == 0 && !last;  // nothing to lose yet
  if (wanted(output.checkpoint_every) && !at_start && checkpointed_step_ < step) {
    const OutputTimer timer(record_.output_checkpoint, simulation_);
    checkpoint();
  }
}

// Says once for each vesicle that its mesh has become too coarse for its shape.
void Run::warn_of_resolution() {
  warned_.resize(simulation_.scene().vesicles.size());
  for (std::size_t i = 0; i < warned_.size(); ++i) {
    if (warned_[i]) continue;
    const std::string warning = vesicle::resolution_warning(vesicle::resolution(simulation_.membrane(i).surface()));
    if (warning.empty()) continue;
    progress_->finish();
    spdlog::warn("vesicle {} at t = {:.4g}: {}; see mesh.latitudes", i, simulation_.time(), warning);
    warned_[i] = true;
  }
}

void Run::finish(const std::string& status) {
  record_.status = status;
  write_summary(directory_, options_, simulation_, record_);
}

void Run::stop(const SimulationStopped& reason) {
  const std::string message = fmt::format(
      "stopped in step {} at t = {:.6g}: {}\n  likely cause: {}\n  last good checkpoint: {}", simulation_.steps() + 1,
      simulation_.time(), reason.what(), reason.advice(), last_checkpoint_ ? last_checkpoint_->string() : "none yet");
  record_.stop_reason = message;
  finish("stopped");
  throw SimulationStopped(message, reason.advice());
}

// The reason goes into the summary if that can be written, which on a full disk it cannot.
void Run::fail(const FileError& error) {
  if (!table_) throw error;  // nothing has been computed yet
  const std::string message =
      last_checkpoint_ ? fmt::format("{}\n  last good checkpoint: {}; when the cause is gone, go on with --restart {}",
                                     error.what(), last_checkpoint_->string(), last_checkpoint_->string())
                       : fmt::format("{}\n  last good checkpoint: none yet", error.what());
  record_.stop_reason = message;
  try {
    finish("stopped");
  } catch (const FileError&) {
  }
  throw FileError(message);
}

RunStatus Run::execute() {
  start();
  const InterruptGuard guard;
  progress_.emplace(options_.quiet, simulation_);
  try {
    PhaseTimer timer(record_.wall);
    record(simulation_.finished());
  } catch (const SimulationStopped& reason) {
    stop(reason);
  }
  while (!simulation_.finished() && !interrupt_requested) {
    try {
      const PhaseTimer timer(record_.wall);
      simulation_.step();
      ++record_.steps_taken;
      log_redistributions();
      progress_->update(simulation_);
      record(simulation_.finished());
    } catch (const SimulationStopped& reason) {
      progress_->finish();
      stop(reason);
    }
  }
  progress_->finish();
  const bool completed = simulation_.finished();
  if (!completed) record(true);
  finish(completed ? "completed" : "interrupted");
  return completed ? RunStatus::completed : RunStatus::interrupted;
}

}  // namespace

RunStatus run(Simulation& simulation, const RunOptions& options) {
  Run run(simulation, options);
  try {
    return run.execute();
  } catch (const FileError& error) {
    run.fail(error);
  }
}

int exit_code_of(int (*program)(int argc, char** argv), int argc, char** argv) {
  spdlog::set_default_logger(spdlog::stderr_color_st("vesiflow"));
  spdlog::set_pattern("%^%l%$: %v");
  std::signal(SIGXFSZ, SIG_IGN);  // beyond `ulimit -f` writing fails, instead of ending the program
  try {
    return program(argc, argv);
  } catch (const SceneError& error) {
    spdlog::error("{}", error.what());
    return exit_code::bad_input;
  } catch (const SimulationStopped& error) {
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

}  // namespace vesiflow::coupling
