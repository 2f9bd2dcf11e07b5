// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// States to restore a simulation to, with lists of other lengths and awkward numbers: what a checkpoint with good checksums
// could hold. Each is refused by what restore() promises, or a state from which the next step is made or stopped with a reason.
#include <fuzzer/FuzzedDataProvider.h>

#include <limits>

#include "checkpoint_case.h"
#include "one_thread.h"

namespace vesiflow::fuzz {
namespace {

class StateEditor {
 public:
  StateEditor(coupling::SimulationState& state, FuzzedDataProvider& choices) : state_(state), choices_(choices) {}

  void edit() {
    coupling::VesicleState& vesicle = state_.vesicles.front();
    vesicle::MembraneState& membrane = vesicle.membrane;
    switch (choices_.ConsumeIntegralInRange(0, 11)) {
      case 0:
        return change(state_.velocity.y.data(), state_.velocity.y.size());
      case 1:
        return change(state_.previous_velocity.x.data(), state_.previous_velocity.x.size());
      case 2:
        return change(state_.pressure.data(), state_.pressure.size());
      case 3:
        return change(membrane.positions.data(), std::size_t(membrane.positions.size()));
      case 4:
        return change(membrane.target_areas);
      case 5:
        return change(membrane.initial_areas);
      case 6:
        return change(membrane.integral_tension);
      case 7:
        return change(vesicle.motion_history);
      case 8:
        return change(state_.step_control);
      case 9:
        membrane.initial_volume = number(membrane.initial_volume);
        return;
      case 10:
        state_.clock.time = number(state_.clock.time);
        state_.clock.time_step = number(state_.clock.time_step);
        return;
      default:
        state_.clock.steps = choices_.ConsumeIntegral<std::int64_t>();
    }
  }

 private:
  double number(double old) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double awkward[] = {0.0,      -1.0,      1.0,   0.5,    std::numeric_limits<double>::quiet_NaN(),
                                  infinity, -infinity, 1e308, 1e-320, 1e155,
                                  3e9,      -3e9};
    const double chosen = choices_.PickValueInArray(awkward);
    return choices_.ConsumeBool() ? old * chosen : chosen;
  }

  void change(double* values, std::size_t size) {
    if (size == 0) return;
    const std::size_t from = choices_.ConsumeIntegralInRange<std::size_t>(0, size - 1);
    const std::size_t to = choices_.ConsumeBool() ? from + 1 : size;
    for (std::size_t i = from; i < to; ++i) values[i] = number(values[i]);
  }
  template <class List>
  void change(List& list) {
    if (choices_.ConsumeBool())
      change(list.data(), std::size_t(list.size()));
    else
      list = List(choices_.ConsumeIntegralInRange(0, 2000));
  }

  coupling::SimulationState& state_;
  FuzzedDataProvider& choices_;
};

}  // namespace
}  // namespace vesiflow::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vesiflow;
  static fuzz::Run run;
  FuzzedDataProvider choices(data, size);
  coupling::SimulationState state = run.state();
  fuzz::StateEditor editor(state, choices);
  while (choices.remaining_bytes() > 0) editor.edit();
  const bool taken = run.restore(state);
  if (size == 0) fuzz::check(taken, "an intact state is restored");
  return 0;
}
