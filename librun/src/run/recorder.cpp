// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/recorder.h"

#include <cmath>
#include <vector>

#include "files/snapshot_files.h"
#include "phase_timer.h"

namespace vesiflow::run {
namespace {

// Whether the step that ended at `time` is the one for a multiple of `every`: the nearest of equal steps, and the first at or
// beyond it where steps are adaptive and the next is not known.
bool is_due(double every, double time, double dt, bool adaptive) {
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

}  // namespace

Recorder::Recorder(const Parts& run)
    : run_(run),
      table_(run.folder.path(), run.simulation.vesicle_count(), run.options.diagnostics),
      vesicle_snapshots_(run.folder.path(), vesicle_snapshots(run.simulation)),
      fluid_snapshots_(run.folder.path(), fluid_snapshots(run.simulation)) {}

void Recorder::rewind() {
  const long step = run_.simulation.steps();
  table_.rewind(step);
  vesicle_snapshots_.drop_after(step);
  fluid_snapshots_.drop_after(step);
}

void Recorder::list_snapshots() {
  vesicle_snapshots_.list();
  fluid_snapshots_.list();
}

bool Recorder::wants(double every, bool last) const {
  const SceneSimulation& simulation = run_.simulation;
  if (every <= 0.0) return false;
  return last || simulation.steps() == 0 ||
         is_due(every, simulation.time(), simulation.time_step(), simulation.scene().time.adaptive);
}

void Recorder::announce(RunOutput output) const {
  if (run_.options.before_output) run_.options.before_output(run_.simulation, output);
}

void Recorder::write_what_is_due(bool last, RunLog& log) {
  const Scene::Output& output = run_.simulation.scene().output;
  const long step = run_.simulation.steps();
  const double time = run_.simulation.time();
  const bool wants_table = wants(output.diagnostics_every, last), wants_vesicles = wants(output.vesicle_every, last),
             wants_fluid = wants(output.fluid_every, last), wants_checkpoint = wants(output.checkpoint_every, last);
  if (wants_table || wants_vesicles || wants_fluid || wants_checkpoint) run_.folder.require_held();
  if (wants_table && table_.last_step() < step) {
    announce(RunOutput::diagnostics);
    write_diagnostics(log);
  }
  if (wants_vesicles && vesicle_snapshots_.last_step() < step) {
    announce(RunOutput::vesicle_snapshot);
    const PhaseTimer timer(run_.record.output_vesicle);
    vesicle_snapshots_.write(step, time);
  }
  if (wants_fluid && fluid_snapshots_.last_step() < step) {
    announce(RunOutput::fluid_snapshot);
    const PhaseTimer timer(run_.record.output_fluid);
    fluid_snapshots_.write(step, time);
  }
  // At the start there is nothing to lose yet, but a state to go back to.
  const bool at_start = step == 0 && !last && run_.simulation.scene().ending.on_blowup == OnBlowUp::stop;
  if (wants_checkpoint && !at_start && run_.checkpoint.step() < step && !(is_spoilt(log) && !last)) {
    announce(RunOutput::checkpoint);
    write_checkpoint();
  }
}

void Recorder::write_diagnostics(RunLog& log) {
  const OutputTimer timer(run_.record.output_table, run_.simulation);
  const std::vector<vesicle::Diagnostics> all = run_.simulation.measure();
  const std::vector<double> distances = run_.simulation.nearest_distances();
  table_.write(run_.simulation, all, distances);
  run_.record.quality.observe(run_.simulation, all, distances);
  log.warn_of_resolution(run_.simulation);
}

void Recorder::write_checkpoint() {
  const OutputTimer timer(run_.record.output_checkpoint, run_.simulation);
  table_.flush_to_disk();
  run_.checkpoint.write(run_.record.quality);
  write_summary(run_.folder.path(), run_.options, run_.simulation, run_.record);
}

// A checkpoint that may be the start of a blow-up would take the place of a good one.
bool Recorder::is_spoilt(RunLog& log) const {
  if (!run_.simulation.suspects_blow_up()) return false;
  log.warn_of_noise(run_.simulation);
  return true;
}

}  // namespace vesiflow::run
