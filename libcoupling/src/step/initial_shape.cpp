// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coupling/initial_shape.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>

#include "coupling/errors.h"
#include "coupling/overlap.h"
#include "forces/periodic_images.h"
#include "vesicle/shapes.h"
#include "vesicle/sphere_grid.h"
#include "vesicle/surface.h"

namespace vesiflow::coupling {
vesicle::VectorField checked_markers(const SimulationParameters& parameters, std::size_t i) {
  const VesicleParameters& vesicle = parameters.vesicles[i];
  try {
    vesicle::VectorField markers = initial_markers(vesicle, parameters.latitudes(i));
    // The others are always surfaces.
    const bool is_free_form = vesicle.shape == Shape::harmonics || vesicle.surface;
    if (is_free_form) vesicle::Surface(parameters.latitudes(i)).update(markers);
    return markers;
  } catch (const std::logic_error& error) {
    const char* parameter = vesicle.surface ? "surface" : vesicle.shape == Shape::harmonics ? "harmonics" : "shape";
    throw ParameterError(fmt::format("vesicles.{}.{}: {}", i, parameter, error.what()));
  }
}

vesicle::VectorField initial_markers(const VesicleParameters& start, int latitudes) {
  const vesicle::SphereGrid grid(latitudes);
  vesicle::Placement placement;
  placement.effective_radius = start.radius;
  placement.centre = vesicle::Vector3(start.centre.data());
  placement.rotation = Eigen::AngleAxisd(start.rotation_deg * std::numbers::pi / 180.0,
                                         vesicle::Vector3(start.rotation_axis.data()).normalized())
                           .toRotationMatrix();
  switch (start.shape) {
    case Shape::prolate:
      return start.reduced_volume ? vesicle::prolate(grid, *start.reduced_volume, placement)
                                  : vesicle::spheroid(grid, *start.aspect_ratio, placement);
    case Shape::oblate:
      return start.reduced_volume ? vesicle::oblate(grid, *start.reduced_volume, placement)
                                  : vesicle::spheroid(grid, 1.0 / *start.aspect_ratio, placement);
    case Shape::ellipsoid:
      return vesicle::ellipsoid(grid, vesicle::Vector3(start.axes->data()), placement);
    case Shape::biconcave:
      return vesicle::biconcave_disc(grid, placement);
    case Shape::harmonics:
      return vesicle::perturbed_sphere(grid, start.harmonics, placement);
    case Shape::coefficients:
    case Shape::mesh:
      return vesicle::shape_from_coefficients(grid, *start.surface, placement);
    case Shape::sphere:
      break;
  }
  return vesicle::sphere(grid, placement);
}

void check_apart(const SimulationParameters& parameters) {
  const fluid::Grid grid(parameters.domain.lower, parameters.domain.upper, parameters.domain.cells,
                         {.periodic = parameters.domain.periodic});
  std::vector<vesicle::VectorField> markers;
  std::vector<vesicle::Surface> surfaces;
  for (std::size_t i = 0; i < parameters.vesicles.size(); ++i) {
    markers.push_back(initial_markers(parameters.vesicles[i], parameters.latitudes(i)));
    surfaces.emplace_back(parameters.latitudes(i));
    try {
      surfaces.back().update(markers.back());
    } catch (const std::logic_error& error) {  // too small or too large for its areas to be numbers
      throw ParameterError(
          fmt::format("vesicles.{}.radius = {:g}: {}", i, parameters.vesicles[i].radius, error.what()));
    }
  }
  for (std::size_t a = 0; a < markers.size(); ++a)
    for (std::size_t b = a; b < markers.size(); ++b)
      for_each_image(grid, Bounds(markers[a]), Bounds(markers[b]), 0.0, [&](const vesicle::Vector3& shift) {
        const bool is_itself = a == b && shift.isZero(0.0);
        if (is_itself || !(overlap(surfaces[a], markers[b], shift) || overlap(surfaces[b], markers[a], -shift))) return;
        const char* image = shift.isZero(0.0) ? "" : " (repeated along a periodic axis)";
        throw ParameterError(fmt::format("vesicles.{} and vesicles.{}{} overlap; move one of them (centre){}", a, b,
                                         image, a == b ? " or enlarge the box" : ""));
      });
}

}  // namespace vesiflow::coupling
