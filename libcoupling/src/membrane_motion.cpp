#include "membrane_motion.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "coupling/marker_integrator.h"
#include "implicit_motion.h"
#include "shape_following.h"
#include "step/step_error.h"
#include "transfer/mirror_symmetry.h"

namespace vesiflow::coupling {
namespace {

// The paper's: markers move with the filtered velocity of the fluid, by an integrator that knows neither vesicle nor grid,
// and target areas follow their slip.
class MaterialMotion final : public MembraneMotion {
 public:
  MaterialMotion(const SimulationParameters& parameters, std::size_t vesicle, const vesicle::Membrane& membrane)
      : interpolates_in_time_(parameters.time.fluid_velocity == FluidVelocity::interpolated),
        has_stages_(parameters.time.markers == MarkerMotion::arkode),
        symmetry_(parameters, membrane.positions()),
        positions_(membrane.positions()),
        displacement_(positions_),
        integrator_(
            make_marker_integrator(parameters.time.markers, static_cast<std::size_t>(positions_.size()),
                                   {parameters.time.relative_tolerance,
                                    parameters.time.absolute_tolerance * parameters.vesicles[vesicle].radius})) {
    if (parameters.time.adaptive) error_.emplace(positions_.rows());
    filtered_velocity_ = [this](double fraction, std::span<const double> state, std::span<double> velocity) {
      evaluate(fraction, Eigen::Map<const vesicle::VectorField>(state.data(), positions_.rows(), 3));
      Eigen::Map<vesicle::VectorField>(velocity.data(), positions_.rows(), 3) = step_.velocities->membrane;
    };
  }

  void advance(double dt, const VelocityAt& velocity_at, vesicle::Membrane& membrane,
               MarkerVelocities& velocities) override {
    step_ = {dt, &velocity_at, &membrane, &velocities};
    positions_ = membrane.positions();
    integrator_->advance(dt, filtered_velocity_, {positions_.data(), static_cast<std::size_t>(positions_.size())});
    displacement_ = positions_ - membrane.positions();
    // The velocities that go with the whole step, and not with the last stage of it.
    if (has_stages_) {
      positions_ = membrane.positions() + 0.5 * displacement_;
      evaluate(0.5, positions_);
    }
    membrane.correct_displacement(displacement_);
    symmetry_.apply(displacement_);
    positions_ = membrane.positions() + displacement_;
    membrane.advance(positions_, velocities.fluid, velocities.membrane, dt);
    if (error_) error_->add(dt, displacement_);
  }

  void mesh_velocity(double dt, vesicle::Membrane& membrane, MarkerVelocities& velocities) override {
    membrane.filter_velocity(velocities.fluid, dt, velocities.membrane);
  }

  std::optional<double> position_error() const override { return error_ ? error_->value() : std::nullopt; }
  MarkerStatistics statistics() const override { return integrator_->statistics(); }

  // Of the integrator, followed by that of the error.
  std::span<const double> history() const override {
    const auto of_integrator = integrator_->history();
    if (!error_ || !error_->has_history()) return of_integrator;
    history_.assign(of_integrator.begin(), of_integrator.end());
    const vesicle::VectorField& of_error = error_->history();
    history_.insert(history_.end(), of_error.data(), of_error.data() + of_error.size());
    return history_;
  }
  void restore_history(double dt, std::span<const double> history) override {
    if (error_) {
      const auto size = static_cast<std::size_t>(positions_.size());
      if (history.size() < size) throw std::invalid_argument("the history of the markers is too short");
      const std::size_t rest = history.size() - size;
      error_->restore_history(dt, Eigen::Map<const vesicle::VectorField>(history.data() + rest, positions_.rows(), 3));
      history = history.first(rest);
    }
    if (!history.empty()) integrator_->restore_history(dt, history);
  }
  void restart() override {
    integrator_->restart();
    if (error_) error_->restart();
  }

 private:
  // What the integrator's callback needs of the step under way; the callback is made once, so that steps do not allocate.
  struct Step {
    double dt = 0.0;
    const VelocityAt* velocity_at = nullptr;
    vesicle::Membrane* membrane = nullptr;
    MarkerVelocities* velocities = nullptr;
  };

  // Normals, areas and volume are those of the start of the step in all its stages.
  void evaluate(double fraction, const VelocityAt::Positions& positions) {
    (*step_.velocity_at)(interpolates_in_time_ ? fraction : 1.0, positions, step_.velocities->fluid);
    mesh_velocity(step_.dt, *step_.membrane, *step_.velocities);
  }

  bool interpolates_in_time_, has_stages_;
  MirrorSymmetry symmetry_;
  vesicle::VectorField positions_, displacement_;
  std::unique_ptr<MarkerIntegrator> integrator_;
  std::optional<StepError> error_;  // of adaptive steps
  MarkerVelocity filtered_velocity_;
  Step step_;
  mutable std::vector<double> history_;
};

}  // namespace

std::unique_ptr<MembraneMotion> make_membrane_motion(const SimulationParameters& parameters, const Flow& flow,
                                                     std::size_t vesicle, const vesicle::Membrane& membrane) {
  if (parameters.time.markers == MarkerMotion::shape_following)
    return std::make_unique<ShapeFollowing>(parameters, flow, vesicle, membrane);
  if (parameters.time.markers == MarkerMotion::implicit)
    return std::make_unique<ImplicitMotion>(parameters, flow, vesicle, membrane);
  return std::make_unique<MaterialMotion>(parameters, vesicle, membrane);
}

}  // namespace vesiflow::coupling
