#include "shape_following.h"

#include <cmath>
#include <cstdlib>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "gmres.h"
#include "vesicle/conservation.h"
#include "vesicle/rigid_motion.h"
#include "vesicle/spherical_harmonics.h"

namespace vesiflow::coupling {
namespace {

using vesicle::Coefficients;
using vesicle::ScalarField;
using vesicle::VectorField;

double env(const char* name, double value) {
  const char* text = std::getenv(name);
  return text ? std::atof(text) : value;
}

class ShapeFollowing final : public MembraneMotion {
 public:
  ShapeFollowing(const Scene& scene, std::size_t vesicle, const vesicle::Membrane& membrane)
      : scene_(scene),
        degrees_(int(env("DEG", vesicle::two_thirds_degrees(scene.latitudes(vesicle))))),
        harmonics_(degrees_, membrane.surface().grid(), 4),
        positions_(membrane.positions()),
        strain_(ScalarField::Zero(positions_.rows())),
        position_step_(VectorField::Zero(positions_.rows(), 3)),
        strain_step_(ScalarField::Zero(positions_.rows())),
        velocity_(positions_.rows(), 3),
        mesh_(positions_.rows(), 3),
        gradient_(positions_.rows(), 3),
        divergence_(positions_.rows()),
        rates_(positions_.rows(), 4),
        steps_(positions_.rows(), 4),
        theta_(positions_.rows(), 4),
        phi_(positions_.rows(), 4) {
    vesicle::Conserved conserved;
    conserved.volume = membrane.initial_volume();
    if (env("AREA", 1) > 0) conserved.area = membrane.initial_area();
    conservation_.emplace(membrane.surface().grid(), conserved, int(env("SMOOTH", degrees_ / 2)));
    radius_ = std::sqrt(membrane.initial_area() / (4 * M_PI));
  }

  bool predict(double dt, vesicle::Membrane& membrane) override {
    const double r = ratio(dt);
    if (fresh_) {
      positions_ = membrane.positions();
      membrane.update_geometry();
      strain_ = (membrane.surface().area_weight() / membrane.target_areas()).log();
      fresh_ = false;
    }
    velocity_ = positions_ + r * position_step_;
    divergence_ = strain_ + r * strain_step_;
    membrane.move_to(velocity_, divergence_);
    predicted_strain_ = divergence_;
    has_owed_ = false;
    if (owed_coefficients_.degrees() > 0 && scene_.fluid.inertia != fluid::Inertia::none && env("TH", 1) > 0) {
      has_owed_ = true;
      const double re = scene_.fluid.reynolds_number / dt * env("TH", 1);
      work_ = owed_coefficients_;
      as_vector(work_) *= re * (1 + r);
      if (older_owed_.degrees() > 0) as_vector(work_) -= re * r * r / (1 + r) * as_vector(older_owed_);
      harmonics_.synthesis(work_, steps_);
      membrane.surface().projector_divergence(steps_.col(3), owed_);
      owed_ += steps_.leftCols<3>();
    }
    return true;
  }

  void advance(double dt, const VelocityAt& velocity_at, vesicle::Membrane& membrane,
               MarkerVelocities& velocities) override {
    const vesicle::Surface& surface = membrane.surface();
    tension_ = std::max(0.0, membrane.tension().maxCoeff());
    {
      const ScalarField& h = surface.mean_curvature();
      const double mean = (h * surface.area_weight()).sum() / surface.area();
      curvature_variance_ = 4 * ((h - mean).square() * surface.area_weight()).sum() / surface.area();
      if (env("VERB", 0) > 0) std::fprintf(stderr, "4 var H %.3f\n", curvature_variance_);
    }
    velocity_at(surface.positions(), velocities.fluid);
    find_rates(surface, velocities);
    surface.gradient(predicted_strain_, gradient_);
    rates_.leftCols<3>() = mesh_;
    rates_.col(3) = divergence_ - ((velocity_ - mesh_) * gradient_).rowwise().sum();
    velocities.mesh = mesh_;

    const double r = ratio(dt), a0 = (1 + 2 * r) / (1 + r), a1 = r * r / (1 + r);
    harmonics_.analysis(rates_, rate_coefficients_);
    steps_.leftCols<3>() = position_step_;
    steps_.col(3) = strain_step_;
    harmonics_.analysis(steps_, step_coefficients_);
    // slip in the coordinates of the mesh
    gradient_ = velocity_ - mesh_;
    slip_theta_ = dt * (gradient_ * surface.geometry().dual_theta()).rowwise().sum();
    slip_phi_ = dt * (gradient_ * surface.geometry().dual_phi()).rowwise().sum();
    work_.resize(degrees_, 4);
    if (scale_.size() == 0) {
      scale_.resize(size_of(work_));
    }
    work_.set_zero();
    for (int n = 0; n < degrees_; ++n) {
      const double bending = bending_stiffness(n, dt, a0) + dt * damping(n),
                   tension = tension_stiffness(n, dt, a0) + dt * damping(n);
      for (int m = 0; m <= n; ++m)
        for (int f = 0; f < 4; ++f)
          work_(f, n, m) = {1 / (a0 + (f < 3 ? bending : tension)), 1 / (a0 + (f < 3 ? bending : tension))};
    }
    scale_ = as_vector(work_);
    positions_and_strain_.resize(positions_.rows(), 4);
    positions_and_strain_.leftCols<3>() = surface.positions();
    positions_and_strain_.col(3) = predicted_strain_;
    harmonics_.analysis(positions_and_strain_, work_);
    for (int n = 0; n < degrees_; ++n)
      for (int m = 0; m <= n; ++m)
        for (int f = 0; f < 4; ++f) rate_coefficients_(f, n, m) -= damping(n) * work_(f, n, m);
    right_ = ((a1 - a0 * r) * as_vector(step_coefficients_) + dt * as_vector(rate_coefficients_)).cwiseProduct(scale_);
    const auto apply = [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) {
      as_vector(work_) = x;
      harmonics_.gradient(work_, theta_, phi_);
      for (int f = 0; f < 4; ++f) theta_.col(f) = slip_theta_ * theta_.col(f) + slip_phi_ * phi_.col(f);
      harmonics_.analysis(theta_, work_);
      y = x + as_vector(work_).cwiseProduct(scale_);
    };
    const auto report = gmres_.solve(apply, right_, env("TOL", 1e-4), solution_);
    if (env("VERB", 0) > 0)
      std::fprintf(stderr, "gmres %d %.1e |eta| %.2e\n", report.iterations, report.residual, solution_.norm());
    // impulses owed
    work_ = step_coefficients_;
    as_vector(step_coefficients_) = r * as_vector(step_coefficients_) + solution_;
    if (owed_coefficients_.degrees() > 0) older_owed_ = owed_coefficients_;
    owed_coefficients_.resize(degrees_, 4);
    for (int n = 0; n < degrees_; ++n)
      for (int m = 0; m <= n; ++m)
        for (int f = 0; f < 4; ++f) {
          const auto change = step_coefficients_(f, n, m) - r * work_(f, n, m);
          owed_coefficients_(f, n, m) =
              f < 3 ? -env("CB", 1.5) * normal_force(n) * responses_[n].normal2 / responses_[n].normal * change
                    : (n == 0 ? env("C0", 1.5) * responses_[2].normal2 / responses_[2].normal
                              : env("CG", 1.5) * responses_[n].along2 / responses_[n].along) *
                          scene_.membrane.sigma0 * change;
        }
    harmonics_.synthesis(step_coefficients_, steps_);
    position_step_ = steps_.leftCols<3>();
    strain_step_ = steps_.col(3);
    gradient_ = positions_ + position_step_ - surface.positions();
    velocity_ = gradient_;
    conservation_->correct_displacement(surface, gradient_);
    if (env("OC", 1) > 0) {
      velocity_ = gradient_ - velocity_;
      harmonics_.analysis(velocity_, velocity_coefficients_);
      for (int n = 0; n < degrees_; ++n)
        for (int m = 0; m <= n; ++m)
          for (int f = 0; f < 3; ++f) {
            const auto& q = responses_[std::max(n, 2)];
            owed_coefficients_(f, n, m) +=
                env("OC", 1) * a0 / dt * q.normal2 / (q.normal * q.normal) * velocity_coefficients_(f, n, m);
          }
    }
    gradient_ += surface.positions();
    position_step_ = gradient_ - positions_;
    positions_ = gradient_;
    strain_ += strain_step_;
    previous_dt_ = dt;
    membrane.move_to(positions_, strain_);
  }

  void mesh_velocity(double, vesicle::Membrane& membrane, MarkerVelocities& velocities) override {
    find_rates(membrane.surface(), velocities);
    velocities.mesh = mesh_;
  }

  void restart() override {
    fresh_ = true;
    previous_dt_ = 0;
    position_step_.setZero();
    strain_step_.setZero();
  }

  const VectorField* owed_force() const override { return has_owed_ ? &owed_ : nullptr; }

 private:
  static Eigen::Index size_of(const Coefficients& c) {
    return Eigen::Index(2) * c.fields() * c.degrees() * (c.degrees() + 1) / 2;
  }
  static Eigen::Map<Eigen::VectorXd> as_vector(Coefficients& c) {
    return {reinterpret_cast<double*>(c.block(0, 0)), size_of(c)};
  }
  double ratio(double dt) const { return previous_dt_ > 0 ? dt / previous_dt_ : 0.0; }

  // U filtered, its divergence, and the velocity of the mesh that follows the shape.
  void find_rates(const vesicle::Surface& surface, const MarkerVelocities& velocities) {
    harmonics_.analysis(velocities.fluid, velocity_coefficients_);
    harmonics_.synthesis(velocity_coefficients_, velocity_);
    surface.divergence(velocity_, divergence_);
    normal_velocity_ = (velocity_ * surface.normal()).rowwise().sum();
    const vesicle::RigidMotion rigid = vesicle::rigid_motion_of_shape(surface, normal_velocity_);
    for (Eigen::Index k = 0; k < mesh_.rows(); ++k) {
      const Eigen::Vector3d n = surface.normal().row(k).matrix().transpose();
      const Eigen::Vector3d x = surface.positions().row(k).matrix().transpose();
      const Eigen::Vector3d v = rigid.velocity + rigid.angular_velocity.cross(x - rigid.centre);
      mesh_.row(k) = (v + (normal_velocity_(k) - v.dot(n)) * n).transpose().array();
    }
  }

  // Responses of a plane membrane, a sheet smeared by the delta function, per degree.
  struct Response {
    double along = 0, along2 = 0, normal = 0, normal2 = 0;
  };
  void find_responses(double dt, double a0) {
    if (dt == response_dt_ && a0 == response_a0_) return;
    response_dt_ = dt;
    response_a0_ = a0;
    const double mu = 0.5 * (1 + scene_.fluid.viscosity_ratio);
    const double a = scene_.fluid.inertia == fluid::Inertia::none ? 0 : scene_.fluid.reynolds_number * a0 / dt;
    const double h = scene_.spacing() * env("KER", 1);
    responses_.resize(degrees_);
    for (int n = 0; n < degrees_; ++n) {
      const double k = (n + 0.5) / radius_;
      Response r;
      // kz = k tan(t)
      const int points = 400;
      for (int i = 0; i < points; ++i) {
        const double t = (i + 0.5) * M_PI / 2 / points, kz = k * std::tan(t),
                     w = M_PI / 2 / points * k / std::pow(std::cos(t), 2) / M_PI;
        const double kk = k * k + kz * kz, d = a + mu * kk, phi = std::exp(-0.3818 * kz * kz * h * h);
        r.along += w * phi * kz * kz / (kk * d);
        r.along2 += w * phi * kz * kz / (kk * d * d);
        r.normal += w * phi * k * k / (kk * d);
        r.normal2 += w * phi * k * k / (kk * d * d);
      }
      const double in_plane = std::max(std::exp(-env("INP", 0.19) * k * k * h * h), env("FLOOR", 0.1));
      r.along *= in_plane;
      r.normal *= in_plane;
      r.along2 *= in_plane;
      r.normal2 *= in_plane;
      responses_[n] = r;
    }
  }
  double tension_stiffness(int n, double dt, double a0) {
    find_responses(dt, a0);
    const double k = (n + 0.5) / radius_;
    if (n == 0 && env("N0", 1) > 0)
      return env("C0", 1.5) * dt * scene_.membrane.sigma0 * curvature_variance_ * responses_[2].normal;
    return env("CG", 1.5) * dt * scene_.membrane.sigma0 * k * k * responses_[n].along;
  }
  double damping(int n) const { return env("GAM", 0) * std::pow(n / (degrees_ - 1.0), env("POW", 8)); }
  double normal_force(int n) const {
    const double k = (n + 0.5) / radius_;
    return k * k * (k * k / (4 * scene_.membrane.capillary_number) + tension_);
  }
  double bending_stiffness(int n, double dt, double a0) {
    find_responses(dt, a0);
    return env("CB", 1.5) * dt * normal_force(n) * responses_[n].normal;
  }
  std::vector<Response> responses_;
  double response_dt_ = 0, response_a0_ = 0;

  Scene scene_;
  int degrees_;
  vesicle::SphericalHarmonics harmonics_;
  std::optional<vesicle::ConservationProjection> conservation_;
  VectorField positions_;
  ScalarField strain_, predicted_strain_;
  VectorField position_step_;
  ScalarField strain_step_;
  VectorField velocity_, mesh_, gradient_;
  ScalarField divergence_, normal_velocity_;
  Eigen::ArrayXXd rates_, steps_;
  Coefficients velocity_coefficients_, rate_coefficients_, step_coefficients_;
  Eigen::ArrayXXd positions_and_strain_;
  Coefficients work_, owed_coefficients_, older_owed_;
  VectorField owed_;
  bool has_owed_ = false;
  Eigen::VectorXd scale_, right_, solution_;
  ScalarField slip_theta_, slip_phi_;
  Eigen::ArrayXXd theta_, phi_;
  Gmres gmres_{40};
  double tension_ = 0, curvature_variance_ = 0;
  double radius_ = 1, previous_dt_ = 0;
  bool fresh_ = true;
};

}  // namespace

std::unique_ptr<MembraneMotion> make_shape_following(const Scene& scene, std::size_t vesicle,
                                                     const vesicle::Membrane& membrane) {
  return std::make_unique<ShapeFollowing>(scene, vesicle, membrane);
}

}  // namespace vesiflow::coupling
