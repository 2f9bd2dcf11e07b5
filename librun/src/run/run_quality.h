// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "run/scene_simulation.h"

namespace vesiflow::run {

/// How far the numbers of a run can be trusted: its greatest errors so far, and warnings where one of them, or a number of the scene, is beyond
/// what the studies of docs/validation.md and docs/stability.md cover.
class RunQuality {
 public:
  /// What is held against a limit for each vesicle.
  enum Quantity {
    area,
    volume,
    local_area,
    surface_divergence,
    spectrum_tail,
    unresolved_bending,
    velocity_noise,
    courant_number,
    quantities
  };

  /// Where and when a quantity was above its limit.
  struct Excess {
    std::size_t worst_vesicle = 0;
    long first_step = -1, last_step = -1;  ///< -1: never
    double first_time = 0.0, last_time = 0.0;
    std::vector<bool> vesicles;  ///< that had it
  };

  /// Greatest values, and least distances, over what has been observed; of all vesicles.
  struct Errors {
    /// |relative| of whole vesicles; max_local_area_error, where there is a tension; of the membrane's velocity, in 1/t_c, after the tenth
    /// step, as the shape has not answered before; of the spectrum; share of the bending force beyond the mesh; share of a membrane's
    /// velocity that changes from step to step and back, after the tenth step; dt times the membranes' greatest speed over the spacing.
    std::array<double, quantities> greatest{};
    std::array<Excess, quantities> excesses;
    long last_step = 0;       ///< that was observed
    double divergence = 0.0;  ///< |div u| of the fluid
    /// Least distance, in spacings, of a membrane to another one and to a wall; infinite where there is none.
    double membrane_gap = std::numeric_limits<double>::infinity(), wall_gap = membrane_gap;
  };

  explicit RunQuality(const Scene& scene);

  /// After every step: what is at hand without measuring.
  void observe_step(const SceneSimulation& simulation);
  /// With what measure() and coupling::nearest_distances() have given.
  void observe(SceneSimulation& simulation, std::span<const vesicle::Diagnostics> all,
               std::span<const double> distances);

  const Errors& errors() const { return errors_; }
  /// Goes back to errors of before: what came later did not happen.
  void restore(const Errors& errors) { errors_ = errors; }
  /// Numbers of the scene: g and its limit, steps over those at which the explicit convection is stable, estimated error of the grid.
  struct SceneNumbers {
    double tension_number, stable_tension_number;  ///< the second infinite where there is no limit
    double convection_step_ratio;                  ///< largest step over the stable one; 0 without convection
    /// Relative, of angles and frequencies in steady flow (validation/studies/thickening.md); none for sharp membranes,
    /// whose error is of second order in the spacing and not measured yet.
    std::optional<double> grid_error;
  };
  SceneNumbers scene_numbers() const;

  /// A sentence for each number that is out of range: where, when and what to do.
  std::vector<std::string> warnings() const;

 private:
  void raise(Quantity quantity, std::size_t vesicle, double value, const SceneSimulation& simulation);

  const Scene& scene_;
  Errors errors_;
  long steps_ = 0;  // observed
};

}  // namespace vesiflow::run
