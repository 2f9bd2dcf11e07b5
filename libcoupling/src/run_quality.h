#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "coupling/simulation.h"

namespace vesiflow::coupling {

/// How far the numbers of a run can be trusted: its greatest errors so far, and warnings where one of them, or a number of the scene, is beyond
/// what the studies of docs/validation.md and docs/stability.md cover.
class RunQuality {
 public:
  /// Greatest values, and least distances, over what has been observed; of all vesicles.
  struct Errors {
    double area = 0.0, volume = 0.0;  ///< |relative|, of whole vesicles
    double local_area = 0.0;          ///< max_local_area_error, where there is a tension
    double surface_divergence =
        0.0;  ///< of the membrane's velocity, in 1/t_c; not at time 0, where the shape has not answered yet
    double spectrum_tail = 0.0;
    double unresolved_bending = 0.0;  ///< share of the bending force beyond the mesh
    double velocity_noise =
        0.0;  ///< share of a membrane's velocity that changes from step to step and back; after the tenth step
    double courant_number = 0.0;  ///< dt times the membranes' greatest speed over the spacing
    double divergence = 0.0;      ///< |div u| of the fluid
    /// Least distance, in spacings, of a membrane to another one and to a wall; infinite where there is none.
    double membrane_gap = std::numeric_limits<double>::infinity(), wall_gap = membrane_gap;
  };

  explicit RunQuality(const Scene& scene);

  /// After every step: what is at hand without measuring.
  void observe_step(const Simulation& simulation);
  /// With what measure() and nearest_distances() have given.
  void observe(Simulation& simulation, std::span<const vesicle::Diagnostics> all, std::span<const double> distances);

  const Errors& errors() const { return errors_; }
  /// Goes back to errors of before: what came later did not happen.
  void restore(const Errors& errors) { errors_ = errors; }
  /// Numbers of the scene: g and its limit, steps over those at which the explicit convection is stable, estimated error of the grid.
  struct SceneNumbers {
    double tension_number, stable_tension_number;  ///< the second infinite where there is no limit
    double convection_step_ratio;                  ///< largest step over the stable one; 0 without convection
    double grid_error;  ///< relative, of angles and frequencies in steady flow (validation/thickening.md)
  };
  SceneNumbers scene_numbers() const;

  /// A sentence for each number that is out of range, with what to do.
  std::vector<std::string> warnings() const;

 private:
  const Scene& scene_;
  Errors errors_;
  long steps_ = 0;  // observed
};

}  // namespace vesiflow::coupling
