#include "membrane_motion.h"

#include "coupling/marker_integrator.h"
#include "shape_following.h"

namespace vesiflow::coupling {
namespace {

// The paper's: markers move with the filtered velocity of the fluid, by an integrator that knows neither vesicle nor grid,
// and target areas follow their slip.
class MaterialMotion final : public MembraneMotion {
 public:
  MaterialMotion(const Scene& scene, const vesicle::Membrane& membrane)
      : positions_(membrane.positions()),
        integrator_(make_marker_integrator(scene.time.markers, static_cast<std::size_t>(positions_.size()))) {
    filtered_velocity_ = [this](std::span<const double> state, std::span<double> velocity) {
      (*step_.velocity_at)(Eigen::Map<const vesicle::VectorField>(state.data(), positions_.rows(), 3),
                           step_.velocities->fluid);
      mesh_velocity(step_.dt, *step_.membrane, *step_.velocities);
      Eigen::Map<vesicle::VectorField>(velocity.data(), positions_.rows(), 3) = step_.velocities->mesh;
    };
  }

  void advance(double dt, const VelocityAt& velocity_at, vesicle::Membrane& membrane,
               MarkerVelocities& velocities) override {
    step_ = {dt, &velocity_at, &membrane, &velocities};
    positions_ = membrane.positions();
    integrator_->advance(dt, filtered_velocity_, {positions_.data(), static_cast<std::size_t>(positions_.size())});
    membrane.advance(positions_, velocities.fluid, velocities.mesh, dt);
  }

  void mesh_velocity(double dt, vesicle::Membrane& membrane, MarkerVelocities& velocities) override {
    membrane.filter_velocity(velocities.fluid, dt, velocities.mesh);
  }

  std::span<const double> history() const override { return integrator_->history(); }
  void restore_history(double dt, std::span<const double> history) override {
    integrator_->restore_history(dt, history);
  }
  void restart() override { integrator_->restart(); }

 private:
  // What the integrator's callback needs of the step under way; the callback is made once, so that steps do not allocate.
  struct Step {
    double dt = 0.0;
    const VelocityAt* velocity_at = nullptr;
    vesicle::Membrane* membrane = nullptr;
    MarkerVelocities* velocities = nullptr;
  };

  vesicle::VectorField positions_;
  std::unique_ptr<MarkerIntegrator> integrator_;
  MarkerVelocity filtered_velocity_;
  Step step_;
};

}  // namespace

std::unique_ptr<MembraneMotion> make_membrane_motion(const Scene& scene, std::size_t vesicle,
                                                     const vesicle::Membrane& membrane) {
  if (scene.time.markers == "shape_following") return std::make_unique<ShapeFollowing>(scene, vesicle, membrane);
  return std::make_unique<MaterialMotion>(scene, membrane);
}

}  // namespace vesiflow::coupling
