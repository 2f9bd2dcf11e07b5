// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// vesiflow._vesicle: libvesicle for vesiflow/vesicle.py, which documents it.
#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include <filesystem>

#include "arrays.h"
#include "equilibrium.h"
#include "vesicle/bending.h"
#include "vesicle/diagnostics.h"
#include "vesicle/laplace_beltrami.h"
#include "vesicle/mesh_fit.h"
#include "vesicle/mesh_quality.h"
#include "vesicle/point_evaluation.h"
#include "vesicle/shapes.h"
#include "vesicle/spectrum.h"
#include "vesicle/surface.h"
#include "vesicle/surface_file.h"
#include "vesicle/tension.h"
#include "vesicle/triangle_mesh_file.h"
#include "vesicle/version.h"

namespace vesiflow::python {
namespace {

using namespace vesicle;

using ComplexArray = py::array_t<std::complex<double>, py::array::c_style | py::array::forcecast>;

// [n, m, field], zero for m > n.
ComplexArray array_of(const Coefficients& coefficients) {
  const py::ssize_t degrees = coefficients.degrees(), fields = coefficients.fields();
  ComplexArray array({degrees, degrees, fields});
  auto to = array.mutable_unchecked<3>();
  for (int n = 0; n < degrees; ++n)
    for (int m = 0; m < degrees; ++m)
      for (int f = 0; f < fields; ++f) to(n, m, f) = m <= n ? coefficients(f, n, m) : 0.0;
  return array;
}

Coefficients coefficients_of(const ComplexArray& array) {
  if (array.ndim() != 3 || array.shape(0) != array.shape(1))
    throw std::invalid_argument("coefficients have the shape " + shape_of(array) +
                                "; it must be (degrees, degrees, fields)");
  Coefficients coefficients(static_cast<int>(array.shape(0)), static_cast<int>(array.shape(2)));
  const auto from = array.unchecked<3>();
  for (int n = 0; n < coefficients.degrees(); ++n)
    for (int m = 0; m <= n; ++m)
      for (int f = 0; f < coefficients.fields(); ++f) coefficients(f, n, m) = from(n, m, f);
  return coefficients;
}

Eigen::Map<const Eigen::ArrayXXd> table_of(const Columns& array, const char* name) {
  if (array.ndim() != 2)
    throw std::invalid_argument(std::string(name) + " have the shape " + shape_of(array) +
                                "; it must be (markers, fields)");
  return {array.data(), array.shape(0), array.shape(1)};
}

Eigen::Map<Eigen::ArrayXXd> map_of(Columns& array) {
  return {array.mutable_data(), array.shape(0), array.shape(1)};
}

Vector3 vector_of(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}
std::array<double, 3> array_of(const Vector3& v) {
  return {v[0], v[1], v[2]};
}

Placement placement_of(double radius, const std::array<double, 3>& centre, const std::array<double, 9>& rotation) {
  Placement placement;
  placement.effective_radius = radius;
  placement.centre = vector_of(centre);
  placement.rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation.data());
  return placement;
}

void bind_harmonics(py::module_& m) {
  py::class_<SphereGrid>(m, "SphereGrid")
      .def(py::init<int>())
      .def(py::init<int, int>())
      .def_property_readonly("latitudes", &SphereGrid::latitudes)
      .def_property_readonly("longitudes", &SphereGrid::longitudes)
      .def_property_readonly("size", &SphereGrid::size)
      .def_property_readonly(
          "colatitude", [](py::object self) { return read_only_view(self.cast<SphereGrid&>().colatitude(), self); })
      .def_property_readonly("weight",
                             [](py::object self) { return read_only_view(self.cast<SphereGrid&>().weight(), self); });

  py::class_<SphericalHarmonics>(m, "SphericalHarmonics")
      .def(py::init<int, const SphereGrid&>())
      .def_property_readonly("degrees", &SphericalHarmonics::degrees)
      .def_property_readonly("grid", &SphericalHarmonics::grid, py::return_value_policy::reference_internal)
      .def("analysis",
           [](const SphericalHarmonics& harmonics, const Columns& values) {
             Coefficients coefficients;
             harmonics.analysis(table_of(values, "values"), coefficients);
             return array_of(coefficients);
           })
      .def("synthesis",
           [](const SphericalHarmonics& harmonics, const ComplexArray& array) {
             const Coefficients coefficients = coefficients_of(array);
             Columns values({static_cast<py::ssize_t>(harmonics.grid().size()), array.shape(2)});
             harmonics.synthesis(coefficients, map_of(values));
             return values;
           })
      .def("gradient", [](const SphericalHarmonics& harmonics, const ComplexArray& array) {
        const Coefficients coefficients = coefficients_of(array);
        const std::vector<py::ssize_t> shape{harmonics.grid().size(), array.shape(2)};
        Columns theta(shape), phi(shape);
        harmonics.gradient(coefficients, map_of(theta), map_of(phi));
        return py::make_tuple(theta, phi);
      });
  m.def("evaluate", [](const ComplexArray& array, const Columns& directions) {
    const Coefficients coefficients = coefficients_of(array);
    const VectorField points = vectors_of(directions, "directions");
    Columns values({static_cast<py::ssize_t>(points.rows()), array.shape(2)});
    PointEvaluation(coefficients.degrees()).values_at(coefficients, points, map_of(values));
    return values;
  });
  m.def("read_surface_coefficients",
        [](const std::string& file) { return array_of(read_surface_coefficients(std::filesystem::path(file))); });
  m.def("write_surface_coefficients", [](const std::string& file, const ComplexArray& array) {
    write_surface_coefficients(std::filesystem::path(file), coefficients_of(array));
  });
}

// A field of a surface by the name of the function that has it.
py::object field_of(const Surface& surface, const std::string& name,
                    const std::function<py::object(const ScalarField&)>& scalar,
                    const std::function<py::object(const VectorField&)>& vector) {
  if (name == "positions") return vector(surface.positions());
  if (name == "normal") return vector(surface.normal());
  if (name == "tangent_theta") return vector(surface.tangent_theta());
  if (name == "tangent_phi") return vector(surface.tangent_phi());
  if (name == "area_element") return scalar(surface.area_element());
  if (name == "area_weight") return scalar(surface.area_weight());
  if (name == "mean_curvature") return scalar(surface.mean_curvature());
  if (name == "gaussian_curvature") return scalar(surface.gaussian_curvature());
  throw std::invalid_argument("a surface has no field " + name);
}

void bind_surface(py::module_& m) {
  py::class_<Surface>(m, "Surface")
      .def(py::init<int>())
      .def("update",
           [](Surface& surface, const Columns& positions) { surface.update(vectors_of(positions, "positions")); })
      .def_property_readonly("grid", &Surface::grid, py::return_value_policy::reference_internal)
      .def("field",
           [](py::object self, const std::string& name) {
             const auto view = [&self](const auto& field) -> py::object { return read_only_view(field, self); };
             return field_of(self.cast<Surface&>(), name, view, view);
           })
      .def("coefficients", [](const Surface& surface) { return array_of(surface.position_coefficients()); })
      .def_property_readonly("area", &Surface::area)
      .def_property_readonly("volume", &Surface::volume)
      .def("integral",
           [](const Surface& surface, const Numbers& field) { return surface.integral(numbers_of(field, "field")); })
      .def("gradient",
           [](const Surface& surface, const Numbers& field) {
             VectorField result;
             surface.gradient(numbers_of(field, "field"), result);
             return copy_of(result);
           })
      .def("divergence",
           [](const Surface& surface, const Columns& field) {
             ScalarField result;
             surface.divergence(vectors_of(field, "field"), result);
             return copy_of(result);
           })
      .def("laplacian",
           [](const Surface& surface, const Numbers& field) {
             ScalarField result;
             LaplaceBeltrami(surface.grid()).apply(surface, numbers_of(field, "field"), result);
             return copy_of(result);
           })
      .def("laplacian_of_mean_curvature",
           [](const Surface& surface) {
             ScalarField result;
             LaplaceBeltrami(surface.grid()).of_mean_curvature(surface, result);
             return copy_of(result);
           })
      .def("bending_force",
           [](const Surface& surface, double capillary_number, double spontaneous_curvature) {
             VectorField force = VectorField::Zero(surface.grid().size(), 3);
             BendingForce(surface.grid(),
                          {.capillary_number = capillary_number, .spontaneous_curvature = spontaneous_curvature})
                 .add_to(surface, force);
             return copy_of(force);
           })
      .def("bending_energy",
           [](const Surface& surface, double spontaneous_curvature) {
             return bending_energy(surface, spontaneous_curvature);
           })
      .def("tension_force",
           [](const Surface& surface, const Numbers& tension) {
             VectorField force = VectorField::Zero(surface.grid().size(), 3);
             TensionForce({}).add_to(surface, numbers_of(tension, "tension"), force);
             return copy_of(force);
           })
      .def("elastic_tension",
           [](const Surface& surface, const Numbers& target_areas, double sigma0) {
             ScalarField tension;
             TensionForce({.sigma0 = sigma0}).evaluate(surface, numbers_of(target_areas, "target_areas"), tension);
             return copy_of(tension);
           })
      .def("moments",
           [](const Surface& surface) {
             const VolumeMoments moments = volume_moments(surface);
             py::dict all;
             all["volume"] = moments.volume;
             all["centroid"] = array_of(moments.centroid);
             all["semi_axes"] = array_of(moments.semi_axes);
             all["inclination_angle"] = inclination_angle(moments);
             all["deformation"] = deformation(moments);
             return all;
           })
      .def("resolution", [](const Surface& surface) {
        const Resolution found = resolution(surface);
        py::dict all;
        all["unresolved"] = found.unresolved;
        all["needed_latitudes"] = found.needed_latitudes;
        all["warning"] = resolution_warning(found);
        return all;
      });
  m.def("reduced_volume", &reduced_volume);
  m.def("excess_area", &excess_area);
}

void bind_shapes(py::module_& m) {
  using Three = std::array<double, 3>;
  using Nine = std::array<double, 9>;
  m.def("sphere", [](const SphereGrid& grid, double radius, const Three& centre, const Nine& rotation) {
    return copy_of(sphere(grid, placement_of(radius, centre, rotation)));
  });
  m.def("prolate", [](const SphereGrid& grid, double v, double radius, const Three& centre, const Nine& rotation) {
    return copy_of(prolate(grid, v, placement_of(radius, centre, rotation)));
  });
  m.def("oblate", [](const SphereGrid& grid, double v, double radius, const Three& centre, const Nine& rotation) {
    return copy_of(oblate(grid, v, placement_of(radius, centre, rotation)));
  });
  m.def("spheroid",
        [](const SphereGrid& grid, double aspect, double radius, const Three& centre, const Nine& rotation) {
          return copy_of(spheroid(grid, aspect, placement_of(radius, centre, rotation)));
        });
  m.def("ellipsoid",
        [](const SphereGrid& grid, const Three& axes, double radius, const Three& centre, const Nine& rotation) {
          return copy_of(ellipsoid(grid, vector_of(axes), placement_of(radius, centre, rotation)));
        });
  m.def("biconcave_disc", [](const SphereGrid& grid, double radius, const Three& centre, const Nine& rotation) {
    return copy_of(biconcave_disc(grid, placement_of(radius, centre, rotation)));
  });
  m.def("perturbed_sphere", [](const SphereGrid& grid, const std::vector<std::tuple<int, int, double>>& terms,
                               double radius, const Three& centre, const Nine& rotation) {
    std::vector<Harmonic> harmonics;
    for (const auto& [degree, order, amplitude] : terms) harmonics.push_back({degree, order, amplitude});
    return copy_of(perturbed_sphere(grid, harmonics, placement_of(radius, centre, rotation)));
  });
  m.def("shape_from_coefficients", [](const SphereGrid& grid, const ComplexArray& coefficients, double radius,
                                      const Three& centre, const Nine& rotation) {
    return copy_of(
        shape_from_coefficients(grid, coefficients_of(coefficients), placement_of(radius, centre, rotation)));
  });
}

void bind_meshes(py::module_& m) {
  using Triangles = py::array_t<int, py::array::f_style | py::array::forcecast>;
  m.def("read_mesh", [](const std::string& file) {
    const TriangleMesh mesh = read_triangle_mesh(std::filesystem::path(file));
    Triangles triangles({static_cast<py::ssize_t>(mesh.triangles.rows()), py::ssize_t{3}});
    std::copy_n(mesh.triangles.data(), mesh.triangles.size(), triangles.mutable_data());
    return py::make_tuple(copy_of(mesh.vertices), triangles);
  });
  m.def("fit_mesh", [](const Columns& vertices, const Triangles& triangles, std::optional<int> degrees, int latitudes) {
    if (triangles.ndim() != 2 || triangles.shape(1) != 3)
      throw std::invalid_argument("triangles have the shape " + shape_of(triangles) + "; it must be (triangles, 3)");
    TriangleMesh mesh;
    mesh.vertices = vectors_of(vertices, "vertices");
    mesh.triangles = Eigen::Map<const Eigen::Array<int, Eigen::Dynamic, 3>>(triangles.data(), triangles.shape(0), 3);
    const MeshFit fit = [&] {
      const py::gil_scoped_release unlocked;
      return fit_mesh(mesh, degrees.value_or(default_fit_degrees(mesh.vertices.rows(), latitudes)));
    }();
    py::dict all;
    all["coefficients"] = array_of(fit.surface);
    all["radius"] = fit.radius;
    all["rms_distance"] = fit.rms_distance;
    all["max_distance"] = fit.max_distance;
    all["area"] = fit.fitted.area;
    all["volume"] = fit.fitted.volume;
    all["mesh_area"] = fit.triangles.area;
    all["mesh_volume"] = fit.triangles.volume;
    all["description"] = description(fit);
    return all;
  });
}

void bind_equilibrium(py::module_& m) {
  m.def("equilibrium_shape", [](double reduced_volume, bool oblate, int latitudes, double tolerance) {
    equilibrium::ConstrainedEnergy energy(latitudes);
    const equilibrium::Equilibrium found = [&] {
      const py::gil_scoped_release unlocked;
      return equilibrium::find_equilibrium(energy, oblate ? equilibrium::Branch::oblate : equilibrium::Branch::prolate,
                                           reduced_volume, equilibrium::Method::gradient_flow,
                                           {.tolerance = tolerance, .most_iterations = 0, .progress = {}});
    }();
    py::dict all;
    all["positions"] = copy_of(energy.surface().positions());
    all["energy"] = found.energy;
    all["tension"] = found.tension;
    all["pressure"] = found.pressure;
    all["residual"] = found.residual;
    all["resolved"] = found.resolved();
    all["iterations"] = found.iterations;
    return all;
  });
}

}  // namespace

PYBIND11_MODULE(_vesicle, m) {
  bind_equilibrium(m);
  bind_harmonics(m);
  bind_surface(m);
  bind_shapes(m);
  bind_meshes(m);
  m.def("version", [] { return std::string(version()); });
  m.def("built_with", [] { return std::string(built_with()); });
}

}  // namespace vesiflow::python
