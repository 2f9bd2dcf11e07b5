// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Public functions that take arrays look at their shapes, and name the argument, what was found and what is wanted.
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support.h"
#include "vesicle/diagnostics.h"
#include "vesicle/mesh_energy.h"
#include "vesicle/resampling.h"
#include "vesicle/rigid_motion.h"
#include "vesicle/surface_file.h"
#include "vesicle/triangle_mesh.h"

namespace vesiflow::vesicle::argument_shapes_test {
namespace {

constexpr int latitudes = 8, other_latitudes = 10;  // of 128 and 200 markers

struct Case {
  const char* what;
  std::function<void()> call;
  std::vector<std::string> said;  // parts of the message
};

/// Surfaces, fields and objects on one grid, and surfaces and fields on another.
struct ArgumentShapes : ::testing::Test {
  static Surface surface_on(const SphereGrid& grid) {
    Surface surface(grid);
    surface.update(spheroid(grid, 0.7));
    return surface;
  }

  const SphereGrid grid{latitudes}, other{other_latitudes};
  const SphereGrid wide{4, 32};  // as many markers as `grid`
  const Surface surface = surface_on(grid), other_surface = surface_on(other), wide_surface = surface_on(wide);
  const Coefficients coefficients = surface.position_coefficients();
  ScalarField scalar = ScalarField::Ones(grid.size()), wrong_scalar = ScalarField::Ones(other.size());
  VectorField vector = VectorField::Ones(grid.size(), 3), wrong_vector = VectorField::Ones(other.size(), 3);
  Eigen::ArrayXXd two_columns = Eigen::ArrayXXd::Zero(grid.size(), 2);
  ScalarField scalar_result;
  VectorField vector_result;
  Coefficients coefficients_result;
  Membrane membrane{surface.positions(), latitudes, {.volume = VolumeControl::none}};

  static void expect_refused(const std::vector<Case>& cases) {
    for (const Case& c : cases) {
      try {
        c.call();
        ADD_FAILURE() << c.what << ": taken";
      } catch (const std::invalid_argument& error) {
        for (const std::string& part : c.said)
          EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
              << c.what << ": \"" << error.what() << "\" does not say \"" << part << '"';
      } catch (const std::exception& error) {
        ADD_FAILURE() << c.what << ": " << error.what();
      }
    }
  }
};

TEST_F(ArgumentShapes, OfTransforms) {
  const SphericalHarmonics& harmonics = surface.harmonics();
  PointEvaluation evaluation(latitudes);
  Coefficients four_fields(latitudes, 4), few(latitudes - 1, 3);
  expect_refused({
      {"analysis", [&] { harmonics.analysis(wrong_vector, coefficients_result); }, {"values", "200", "128"}},
      {"synthesis", [&] { harmonics.synthesis(coefficients, wrong_vector); }, {"values", "200", "128"}},
      {"synthesis", [&] { harmonics.synthesis(coefficients, two_columns); }, {"values", "2 columns", "3"}},
      {"few degrees", [&] { harmonics.synthesis(few, vector); }, {"degrees", "7"}},
      {"gradient", [&] { harmonics.gradient(coefficients, vector, wrong_vector); }, {"phi", "200", "128"}},
      {"gradient", [&] { harmonics.gradient(coefficients, two_columns, vector); }, {"theta", "2 columns", "3"}},
      {"derivatives",
       [&] { harmonics.second_derivatives(coefficients, vector, vector, wrong_vector); },
       {"phi_phi", "200", "128"}},
      {"adjoint", [&] { harmonics.synthesis_adjoint(wrong_scalar, coefficients_result); }, {"values", "200", "128"}},
      {"adjoint",
       [&] { harmonics.gradient_adjoint(vector, two_columns, coefficients_result); },
       {"phi", "2 columns", "3"}},
      {"product", [&] { static_cast<void>(coefficients.dot(few)); }, {"degrees", "7"}},
      {"product", [&] { static_cast<void>(coefficients.dot(four_fields)); }, {"fields", "4"}},
      {"points", [&] { evaluation.values_at(coefficients, surface.normal(), wrong_vector); }, {"values", "200", "128"}},
      {"points", [&] { evaluation.values_at(coefficients, surface.normal(), two_columns); }, {"values", "2 col", "3"}},
      {"resampling", [&] { Resampling(grid, other).apply(wrong_vector, vector); }, {"values", "200", "128"}},
      {"resampling", [&] { Resampling(grid, other).apply(vector, vector); }, {"values", "128", "200"}},
  });
}

TEST_F(ArgumentShapes, OfSurfaces) {
  Surface changed(grid);
  SurfaceGeometry geometry(grid);
  LaplaceBeltrami laplacian(grid);
  expect_refused({
      {"update", [&] { changed.update(wrong_vector); }, {"positions", "200", "128"}},
      {"integral", [&] { static_cast<void>(surface.integral(wrong_scalar)); }, {"field", "200", "128"}},
      {"integral", [&] { static_cast<void>(surface.integral(wrong_vector)); }, {"field", "200", "128"}},
      {"flux", [&] { static_cast<void>(surface.flux(wrong_vector)); }, {"field", "200", "128"}},
      {"gradient", [&] { surface.gradient(wrong_scalar, vector_result); }, {"scalar", "200", "128"}},
      {"divergence", [&] { surface.divergence(wrong_vector, scalar_result); }, {"vector", "200", "128"}},
      {"max_divergence", [&] { static_cast<void>(surface.max_divergence(wrong_vector)); }, {"vector", "200", "128"}},
      {"projector", [&] { surface.projector_divergence(wrong_scalar, vector_result); }, {"scalar", "200", "128"}},
      {"geometry", [&] { geometry.update(other_surface.harmonics(), coefficients); }, {"harmonics", "10", "8"}},
      {"geometry", [&] { geometry.update(wide_surface.harmonics(), coefficients); }, {"harmonics", "32", "16"}},
      {"geometry",
       [&] { geometry.update(surface.harmonics(), Coefficients(latitudes, 2)); },
       {"fields of the positions", "2", "3"}},
      {"geometry", [&] { geometry.add_curvature(other_surface.harmonics(), coefficients); }, {"harmonics", "10", "8"}},
      {"laplacian", [&] { laplacian.apply(surface, wrong_scalar, scalar_result); }, {"scalar", "200", "128"}},
      {"laplacian", [&] { laplacian.apply(wide_surface, scalar, scalar_result); }, {"surface", "4 lat", "8 with 16"}},
      {"laplacian", [&] { laplacian.of_mean_curvature(other_surface, scalar_result); }, {"surface", "10", "8"}},
      {"rigid motion",
       [&] { static_cast<void>(rigid_motion_of_shape(surface, wrong_scalar)); },
       {"normal_velocity", "200", "128"}},
      {"spectrum", [&] { Spectrum(Coefficients(3, 1)); }, {"degrees", "3"}},
  });
}

TEST_F(ArgumentShapes, OfTheMesh) {
  MeshFilter filter(grid, FilterOrder::velocity_first, 6, 4);
  TargetAreaUpdate update(grid, SlipReference::interpolated);
  MeshRedistribution redistribution(latitudes);
  MeshEnergyDescent descent({.damping = 1});
  const SphericalHarmonics& there = other_surface.harmonics();
  expect_refused({
      {"filter", [&] { filter.apply(surface, wrong_vector, vector_result); }, {"velocity", "200", "128"}},
      {"filter", [&] { filter.apply(other_surface, vector, vector_result); }, {"surface", "10", "8"}},
      {"filter", [&] { filter.apply(wide_surface, vector, vector_result); }, {"surface", "4 lat", "8 with 16"}},
      {"areas", [&] { update.apply(surface, wrong_vector, vector, 1, 1, scalar); }, {"velocity", "200", "128"}},
      {"areas", [&] { update.apply(surface, vector, wrong_vector, 1, 1, scalar); }, {"filtered", "200", "128"}},
      {"areas", [&] { update.apply(surface, vector, vector, 1, 1, wrong_scalar); }, {"target_areas", "200", "128"}},
      {"areas",
       [&] { update.apply(other_surface, wrong_vector, wrong_vector, 1, 1, wrong_scalar); },
       {"surface", "10", "8"}},
      {"redistribution", [&] { redistribution.redistribute(other_surface); }, {"surface", "10", "8"}},
      {"redistribution", [&] { redistribution.redistribute(wide_surface); }, {"surface", "4 lat", "8 with 16"}},
      {"redistribution", [&] { redistribution.carry(wrong_scalar); }, {"field", "200", "128"}},
      {"descent", [&] { descent.force(there, surface, vector_result); }, {"transform", "10", "8"}},
      {"descent",
       [&] { descent.precondition(surface.harmonics(), surface, wrong_vector, vector_result); },
       {"field", "200", "128"}},
      {"descent",
       [&] { descent.apply_second_derivative(surface.harmonics(), surface, wrong_vector, vector_result); },
       {"field", "200", "128"}},
      {"descent", [&] { descent.direction(there, surface, vector_result); }, {"transform", "10", "8"}},
  });
}

TEST_F(ArgumentShapes, OfForces) {
  BendingForce bending(grid, {});
  TensionForce tension({});
  IntegralTension integral(grid, {.rate = 1, .degrees = 4});
  ConservationProjection projection(grid, {.volume = 1.0, .area = {}}), nothing(grid, {});
  expect_refused({
      {"bending", [&] { bending.add_to(surface, wrong_vector); }, {"force", "200", "128"}},
      {"bending", [&] { bending.add_to(other_surface, wrong_vector); }, {"surface", "10", "8"}},
      {"volume", [&] { add_volume_penalty(surface, 1, 1, wrong_vector); }, {"force", "200", "128"}},
      {"area", [&] { add_area_penalty(surface, 1, 1, wrong_vector); }, {"force", "200", "128"}},
      {"area", [&] { static_cast<void>(area_rate(surface, wrong_vector)); }, {"velocity", "200", "128"}},
      {"tension", [&] { tension.evaluate(surface, wrong_scalar, scalar_result); }, {"target_areas", "200", "128"}},
      {"tension", [&] { tension.add_to(surface, wrong_scalar, vector); }, {"tension", "200", "128"}},
      {"tension", [&] { tension.add_to(surface, scalar, wrong_vector); }, {"force", "200", "128"}},
      {"tension", [&] { static_cast<void>(tension.energy(surface, wrong_scalar)); }, {"target_areas", "200", "128"}},
      {"integral", [&] { integral.advance(wrong_scalar, 1, scalar); }, {"strain", "200", "128"}},
      {"integral", [&] { integral.advance(scalar, 1, wrong_scalar); }, {"multiplier", "200", "128"}},
      {"integral",
       [&] { static_cast<void>(IntegralTension::energy(surface, wrong_scalar, scalar)); },
       {"target_areas", "200", "128"}},
      {"integral",
       [&] { static_cast<void>(IntegralTension::energy(surface, scalar, wrong_scalar)); },
       {"multiplier", "200", "128"}},
      {"velocity", [&] { projection.correct_velocity(surface, 1, wrong_vector); }, {"velocity", "200", "128"}},
      {"velocity", [&] { projection.correct_velocity(other_surface, 1, wrong_vector); }, {"surface", "10", "8"}},
      {"rates", [&] { projection.remove_rates(surface, wrong_vector); }, {"velocity", "200", "128"}},
      {"rates", [&] { nothing.remove_rates(other_surface, wrong_vector); }, {"surface", "10", "8"}},
      {"displacement", [&] { projection.correct_displacement(surface, wrong_vector); }, {"displacement", "200", "128"}},
      {"displacement", [&] { nothing.correct_displacement(wide_surface, vector); }, {"surface", "4 lat", "8 with 16"}},
  });
}

TEST_F(ArgumentShapes, OfMembranes) {
  MeshRedistribution finer(other_latitudes);
  const MembraneState state = membrane.state();
  const auto with = [&](auto member, const auto& wrong) {
    MembraneState spoilt = state;
    spoilt.*member = wrong;
    return spoilt;
  };
  const auto restored = [&](auto member, const auto& wrong) {
    return [this, spoilt = with(member, wrong)] { membrane.restore(spoilt); };
  };
  const auto resampled = [&](auto member, const auto& wrong) {
    return [this, spoilt = with(member, wrong)] { resample(spoilt, grid, other); };
  };
  expect_refused({
      {"construction", [&] { Membrane(wrong_vector, latitudes, {}); }, {"positions", "200", "128"}},
      {"filter", [&] { membrane.filter_velocity(wrong_vector, 1, vector_result); }, {"velocity", "200", "128"}},
      {"displacement", [&] { membrane.correct_displacement(wrong_vector); }, {"displacement", "200", "128"}},
      {"advance", [&] { membrane.advance(wrong_vector, vector, vector, 1); }, {"new_positions", "200", "128"}},
      {"advance", [&] { membrane.advance(vector, wrong_vector, vector, 1); }, {"velocity", "200", "128"}},
      {"advance", [&] { membrane.advance(vector, vector, wrong_vector, 1); }, {"filtered", "200", "128"}},
      {"move", [&] { membrane.move_to(wrong_vector, scalar); }, {"positions", "200", "128"}},
      {"move", [&] { membrane.move_to(vector, wrong_scalar); }, {"strain", "200", "128"}},
      {"redistribute", [&] { membrane.redistribute(finer); }, {"surface", "8", "10"}},
      {"restore", restored(&MembraneState::positions, wrong_vector), {"positions", "200", "128"}},
      {"restore", restored(&MembraneState::target_areas, wrong_scalar), {"target_areas", "200", "128"}},
      {"restore", restored(&MembraneState::initial_areas, wrong_scalar), {"initial_areas", "200", "128"}},
      {"restore", restored(&MembraneState::lagged_strain, scalar), {"lagged_strain", "128", "0"}},
      {"restore", restored(&MembraneState::integral_tension, scalar), {"integral_tension", "128", "0"}},
      {"resample", resampled(&MembraneState::positions, wrong_vector), {"positions", "200", "128"}},
      {"resample", resampled(&MembraneState::target_areas, wrong_scalar), {"target_areas", "200", "128"}},
      {"resample", resampled(&MembraneState::initial_areas, wrong_scalar), {"initial_areas", "200", "128"}},
      {"resample", resampled(&MembraneState::lagged_strain, wrong_scalar), {"lagged_strain", "200", "128"}},
      {"resample", resampled(&MembraneState::integral_tension, wrong_scalar), {"integral_tension", "200", "128"}},
      {"resample", [&] { resample(state, other, other); }, {"positions", "128", "200"}},
      {"measure", [&] { measure(membrane, wrong_vector, vector); }, {"velocity", "200", "128"}},
      {"measure", [&] { measure(membrane, vector, wrong_vector); }, {"vector", "200", "128"}},
      {"tank treading",
       [&] { static_cast<void>(tank_treading_frequency(surface, Vector3::Zero(), wrong_vector)); },
       {"velocity", "200", "128"}},
  });
}

/// A membrane without tension does not use the velocities of a step, and looks at them all the same.
TEST_F(ArgumentShapes, OfMembranesWithoutTension) {
  Membrane soft(surface.positions(), latitudes, {.sigma0 = 0});
  expect_refused({
      {"advance", [&] { soft.advance(vector, wrong_vector, vector, 1); }, {"velocity", "200", "128"}},
      {"advance", [&] { soft.advance(vector, vector, wrong_vector, 1); }, {"filtered", "200", "128"}},
  });
}

TEST_F(ArgumentShapes, OfShapesAndFiles) {
  expect_refused({
      {"shape", [&] { shape_from_coefficients(grid, Coefficients(latitudes, 2)); }, {"fields", "2", "3"}},
      {"file", [&] { write_surface_coefficients("none", Coefficients(latitudes, 2)); }, {"fields", "2", "3"}},
  });
}

/// Vertex numbers are data of a file, and what is wrong with these is a std::domain_error.
TEST_F(ArgumentShapes, OfTriangles) {
  TriangleMesh mesh;
  mesh.vertices = VectorField::Random(4, 3);
  mesh.triangles.resize(2, 3);
  for (const int wrong : {4, -1}) {
    mesh.triangles << 0, 1, 2, 3, wrong, 1;
    for (const auto& check : {std::function<void()>([&] { check_no_crossings(mesh); }),
                              std::function<void()>([&] { enclosed_volume(mesh); })}) {
      try {
        check();
        ADD_FAILURE() << wrong << " was taken";
      } catch (const std::domain_error& error) {
        EXPECT_EQ(error.what(),
                  "triangle mesh: triangle 1 has vertex " + std::to_string(wrong) + ": must be in [0, 3]");
      }
    }
  }
}

}  // namespace
}  // namespace vesiflow::vesicle::argument_shapes_test
