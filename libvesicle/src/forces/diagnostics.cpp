// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vesicle/diagnostics.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "check.h"
#include "vesicle/bending.h"
#include "vesicle/mesh_quality.h"
#include "vesicle/shapes.h"

namespace vesiflow::vesicle {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

void fit_ellipsoid(VolumeMoments& moments) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments.second_moments);
  for (int axis = 0; axis < 3; ++axis) {  // the solver sorts upwards
    // The solid ellipsoid with semi-axis a has the second moment V a^2 / 5 along it.
    moments.semi_axes[axis] = std::sqrt(5 * solver.eigenvalues()[2 - axis] / moments.volume);
    moments.directions.col(axis) = solver.eigenvectors().col(2 - axis);
  }
}

/// Not so of a membrane that has turned inside out or crosses itself.
bool are_of_a_body(const VolumeMoments& moments) {
  return moments.volume > 0 && moments.semi_axes.allFinite() && moments.semi_axes[2] > 0;
}

}  // namespace

VolumeMoments volume_moments(const Surface& surface) {
  // div(x) = 3, div(x x_a) = 4 x_a and div(x x_a x_b) = 5 x_a x_b turn volume integrals into surface ones.
  // Taken about the mean marker, so that a far-off vesicle loses no digits.
  const VectorField& x = surface.positions();
  const VectorField& n = surface.normal();
  const Vector3 origin = surface.integral(x) / surface.area();
  double volume = 0;
  Vector3 first = Vector3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (Eigen::Index k = 0; k < x.rows(); ++k) {
    const Vector3 r = x.row(k).matrix().transpose() - origin;
    const double flux = r.dot(n.row(k).matrix().transpose()) * surface.area_weight()[k];
    volume += flux / 3;
    first += flux / 4 * r;
    second += flux / 5 * r * r.transpose();
  }
  VolumeMoments moments;
  moments.volume = volume;
  const Vector3 offset = first / volume;
  moments.centroid = origin + offset;
  moments.second_moments = second - volume * offset * offset.transpose();
  fit_ellipsoid(moments);
  return moments;
}

double deformation(const VolumeMoments& moments) {
  const double longest = moments.semi_axes[0];
  const double shortest = moments.semi_axes[2];
  check_argument(std::isfinite(longest) && longest > 0, "longest semi-axis", longest, "finite and > 0");
  check_argument(shortest >= 0 && shortest <= longest, "shortest semi-axis", shortest, "in [0, longest]");
  return (longest - shortest) / (longest + shortest);
}

double excess_area(double area, double volume) {
  check_argument(std::isfinite(area) && area > 0, "area", area, "finite and > 0");
  check_argument(std::isfinite(volume) && volume > 0, "volume", volume, "finite and > 0");
  const double radius = std::cbrt(3 * volume / (4 * std::numbers::pi));
  return area / (radius * radius) - 4 * std::numbers::pi;
}

double inclination_angle(const VolumeMoments& moments) {
  constexpr double tolerance = 1e-8;
  const double x = moments.directions(0, 0);
  const double z = moments.directions(2, 0);
  const double gap = moments.semi_axes[0] - moments.semi_axes[1];
  if (!(gap > tolerance * moments.semi_axes[0]) || !(std::hypot(x, z) > tolerance)) return undefined;
  // An axis has no sign: of the two directions take the one with x > 0, or z > 0 if it is vertical.
  return x < 0 || (x == 0 && z < 0) ? std::atan2(-z, -x) : std::atan2(z, x);
}

double tank_treading_frequency(const Surface& surface, const Vector3& centroid, const VectorField& velocity) {
  check_argument(centroid.allFinite(), "centroid", centroid.transpose(), "finite");
  check_markers(velocity, "velocity", surface.grid().size());
  check_finite(velocity, "a velocity");
  constexpr double excluded_share = 1e-3;
  const double excluded_radius = excluded_share * std::sqrt(surface.area() / (4 * std::numbers::pi));
  const VectorField& x = surface.positions();
  const ScalarField& areas = surface.area_weight();
  const Vector3 mean = surface.integral(velocity) / surface.area();
  double sum = 0;
  double area = 0;
  for (Eigen::Index k = 0; k < x.rows(); ++k) {
    const double rx = x(k, 0) - centroid[0];
    const double rz = x(k, 2) - centroid[2];
    const double r2 = rx * rx + rz * rz;
    if (r2 < excluded_radius * excluded_radius) continue;
    const double moment = rz * (velocity(k, 0) - mean[0]) - rx * (velocity(k, 2) - mean[2]);
    sum += std::abs(moment) / r2 * areas[k];
    area += areas[k];
  }
  return area > 0 ? sum / area : undefined;
}

Diagnostics measure(const Membrane& membrane, const VectorField& marker_velocity,
                    const VectorField& membrane_velocity) {
  const Surface& surface = membrane.surface();
  const ScalarField& areas = surface.area_weight();
  const VolumeMoments moments = volume_moments(surface);
  Diagnostics d;
  d.area = surface.area();
  d.volume = surface.volume();
  d.reduced_volume = d.volume > 0 ? reduced_volume(d.area, d.volume) : undefined;
  d.excess_area = d.volume > 0 ? excess_area(d.area, d.volume) : undefined;
  d.area_error = d.area / membrane.initial_area() - 1;
  d.volume_error = d.volume / membrane.initial_volume() - 1;
  d.centroid = moments.centroid;
  d.second_moments = moments.second_moments;
  d.semi_axes = moments.semi_axes;
  d.directions = moments.directions;
  d.deformation = are_of_a_body(moments) ? deformation(moments) : undefined;
  d.inclination_angle = inclination_angle(moments);
  d.tank_treading_frequency = tank_treading_frequency(surface, moments.centroid, marker_velocity);
  d.surface_divergence_max = surface.max_divergence(membrane_velocity);
  d.max_local_area_error = (areas / membrane.target_areas() - 1).abs().maxCoeff();
  d.max_label_area_error = (areas / membrane.initial_areas() - 1).abs().maxCoeff();
  d.bending_energy = bending_energy(surface, membrane.parameters().spontaneous_curvature);
  d.elastic_energy = membrane.elastic_energy();
  d.tension_min = membrane.tension().minCoeff();
  d.tension_max = membrane.tension().maxCoeff();
  d.resolution = resolution(surface);
  const MeshQuality mesh = mesh_quality(surface);
  d.spectrum_tail = mesh.spectrum_tail;
  d.mesh_aspect_ratio = mesh.aspect_ratio;
  d.mesh_area_ratio = mesh.area_ratio;
  return d;
}

}  // namespace vesiflow::vesicle
