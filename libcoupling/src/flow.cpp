#include "coupling/flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupling/errors.h"
#include "fluid/convection_stability.h"
#include "fluid/duct_series.h"

namespace vesiflow::coupling {
namespace {

using fluid::Vector3;

constexpr std::array<bool, 3> along_all{true, true, true}, along_x_and_y{true, true, false},
    along_x{true, false, false};
constexpr std::array<bool, 3> about_all{true, true, true}, about_y{false, true, false},
    about_y_and_z{false, true, true};

Flow rest() {
  return {.velocity = [](const Vector3&, double) { return Vector3{}; },
          .may_be_periodic = along_all,
          .may_be_mirrored = about_all,
          .description = "none: the walls are at rest"};
}

Flow shear(double rate) {
  return {.velocity =
              [rate](const Vector3& x, double) {
                return Vector3{rate * x[2], 0.0, 0.0};
              },
          .may_be_periodic = along_x_and_y,
          .may_be_mirrored = about_y,
          .greatest_gradient = std::abs(rate),
          .description = "steady shear, evaluated once"};
}

Flow oscillating_shear(double rate, double omega) {
  return {.velocity =
              [rate, omega](const Vector3& x, double t) {
                return Vector3{rate * std::cos(omega * t) * x[2], 0.0, 0.0};
              },
          .steady = false,
          .may_be_periodic = along_x_and_y,
          .may_be_mirrored = about_y,
          .greatest_gradient = std::abs(rate),
          .angular_frequency = omega,
          .description = fmt::format("shear oscillating with angular frequency {:g}", omega)};
}

Flow extension(double rate, Extension kind, const Vector3& lower) {
  const Vector3 rates = kind == Extension::planar ? Vector3{rate, 0.0, -rate} : Vector3{rate, -rate / 2, -rate / 2};
  return {.velocity =
              [rates](const Vector3& x, double) {
                return Vector3{rates[0] * x[0], rates[1] * x[1], rates[2] * x[2]};
              },
          .may_be_mirrored = {lower[0] == 0.0, lower[1] == 0.0, lower[2] == 0.0},
          .greatest_gradient = std::abs(rate),
          .description =
              fmt::format("steady {} extension, evaluated once", kind == Extension::planar ? "planar" : "uniaxial")};
}

struct Centre {
  double middle, half;
};
Centre centre_of(const Scene& scene, std::size_t axis) {
  const double low = scene.domain.lower[axis], high = scene.domain.upper[axis];
  if (scene.domain.mirror[axis]) return {low, high - low};
  return {0.5 * (low + high), 0.5 * (high - low)};
}

Flow plane_poiseuille(double peak, const Centre& z) {
  return {.velocity =
              [peak, z](const Vector3& x, double) {
                const double s = (x[2] - z.middle) / z.half;
                return Vector3{peak * (1.0 - s * s), 0.0, 0.0};
              },
          .may_be_periodic = along_x_and_y,
          .may_be_mirrored = about_y_and_z,
          .driving_force = 2.0 * peak / (z.half * z.half),
          .greatest_gradient = 2.0 * std::abs(peak) / z.half,
          .description = "steady plane Poiseuille, evaluated once"};
}

// The series costs a microsecond or more. Grids are walked along x, on which it does not depend: one value is remembered.
class DuctVelocity {
 public:
  DuctVelocity(double peak, const Centre& y, const Centre& z)
      : series_(y.half, z.half), peak_(peak), y_(y), z_(z), last_y_(y.middle), last_z_(z.middle), last_(peak) {}
  Vector3 operator()(const Vector3& x, double) {
    if (x[1] != last_y_ || x[2] != last_z_) {
      last_y_ = x[1];
      last_z_ = x[2];
      last_ = peak_ * series_.velocity(x[1] - y_.middle, x[2] - z_.middle);
    }
    return {last_, 0.0, 0.0};
  }

 private:
  fluid::DuctSeries series_;
  double peak_;
  Centre y_, z_;
  double last_y_, last_z_, last_;
};

Flow duct(double peak, const Centre& y, const Centre& z) {
  const fluid::DuctSeries series(y.half, z.half);
  // Steepest in the middle of a wall.
  constexpr double near = 1e-3;
  const double slope = std::max(series.velocity(y.half * (1.0 - near), 0.0) / (near * y.half),
                                series.velocity(0.0, z.half * (1.0 - near)) / (near * z.half));
  return {.velocity = DuctVelocity(peak, y, z),
          .may_be_periodic = along_x,
          .may_be_mirrored = about_y_and_z,
          .driving_force = peak * series.pressure_gradient(),
          .greatest_gradient = std::abs(peak) * slope,
          .description = "steady duct flow, evaluated once"};
}

// Distance of the box's farthest point from the origin along an axis.
double reach(const Scene& scene, std::size_t axis) {
  return std::max(std::abs(scene.domain.lower[axis]), std::abs(scene.domain.upper[axis]));
}

double greatest_speed(const Scene& scene) {
  const Scene::Flow& flow = scene.flow;
  switch (flow.type) {
    case FlowType::shear:
    case FlowType::oscillating_shear:
      return std::abs(flow.rate) * reach(scene, 2);
    case FlowType::extension:
      return std::abs(flow.rate) * (flow.extension == Extension::planar
                                        ? std::max(reach(scene, 0), reach(scene, 2))
                                        : std::max({reach(scene, 0), reach(scene, 1) / 2, reach(scene, 2) / 2}));
    case FlowType::plane_poiseuille:
    case FlowType::duct:
      return std::abs(flow.peak_velocity);
    case FlowType::rest:
    case FlowType::custom:
      break;
  }
  return 0.0;
}

Flow named_flow(const Scene& scene) {
  const Scene::Flow& flow = scene.flow;
  switch (flow.type) {
    case FlowType::rest:
      return rest();
    case FlowType::shear:
      return shear(flow.rate);
    case FlowType::oscillating_shear:
      return oscillating_shear(flow.rate, flow.angular_frequency);
    case FlowType::extension:
      return extension(flow.rate, flow.extension, scene.domain.lower);
    case FlowType::plane_poiseuille:
      return plane_poiseuille(flow.peak_velocity, centre_of(scene, 2));
    case FlowType::duct:
      return duct(flow.peak_velocity, centre_of(scene, 1), centre_of(scene, 2));
    case FlowType::custom:
      break;
  }
  throw SceneError(
      "flow.type = \"custom\": stands for the flow of a program of one's own (docs/first_app.md); a scene file can "
      "name "
      "rest, shear, oscillating_shear, extension, plane_poiseuille or duct");
}

}  // namespace

Flow flow_of(const Scene& scene) {
  Flow flow = named_flow(scene);
  flow.greatest_speed = greatest_speed(scene);
  return flow;
}

double stable_convection_step(const Scene& scene) {
  if (scene.fluid.inertia != fluid::Inertia::full) return std::numeric_limits<double>::infinity();
  double least = std::numeric_limits<double>::infinity(), largest_viscosity = 1.0;
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i)
    largest_viscosity = std::max(largest_viscosity, scene.viscosity_ratio(i));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double h = (scene.domain.upper[axis] - scene.domain.lower[axis]) / scene.domain.cells[axis];
    least = std::min(least, fluid::stable_convection_step(greatest_speed(scene), h, scene.fluid.reynolds_number,
                                                          largest_viscosity, scene.fluid.viscous_treatment));
  }
  return least;
}

Flow custom_flow(const fluid::BoundaryVelocity& velocity, bool steady) {
  return {.velocity = velocity,
          .steady = steady,
          .may_be_periodic = along_all,
          .may_be_mirrored = about_all,
          .description = steady ? "custom, evaluated once" : "custom, evaluated in each step"};
}

}  // namespace vesiflow::coupling
