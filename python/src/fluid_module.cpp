// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// vesiflow._fluid: libfluid for vesiflow/fluid.py, which documents it.
#include "fluid/elliptic_solver.h"

#include <pybind11/stl.h>

#include "fields.h"
#include "fluid/navier_stokes.h"
#include "fluid/operators.h"
#include "fluid/stokes.h"
#include "fluid/version.h"

namespace vesiflow::python {
namespace {

using namespace fluid;

// The enumerator of a name.
template <class Enum, std::size_t count>
Enum chosen(const std::string& name, const std::array<const char*, count>& names, const char* what) {
  std::string allowed;
  for (std::size_t i = 0; i < count; ++i) {
    if (name == names[i]) return static_cast<Enum>(i);
    allowed += (i > 0 ? ", " : "") + std::string(names[i]);
  }
  throw std::invalid_argument(std::string(what) + " = \"" + name + "\": allowed are " + allowed);
}

SolverOptions options_of(const std::string& name) {
  constexpr std::array<const char*, 4> names{"auto", "fft", "cholmod", "pcg"};
  return default_options(chosen<SolverKind>(name, names, "solver"));
}

// A number, or values at the cells.
Viscosity viscosity_of(const py::object& value, const Grid& grid) {
  if (PyNumber_Check(value.ptr()) && !py::isinstance<py::array>(value)) return value.cast<double>();
  auto field = std::make_shared<Field<Cell>>(grid);
  copy_to(value.cast<Columns>(), field->points(), "viscosity");
  extend_to_ghosts(*field);
  return field;
}

BoundaryVelocity boundary_of(const py::object& function) {
  if (function.is_none()) return nullptr;
  return VectorCallback(function.cast<py::function>(), "the velocity of the walls");
}

void copy_to(const py::sequence& components, FaceVector& field, const char* name) {
  if (py::len(components) != 3)
    throw std::invalid_argument(std::string(name) + " must be three arrays, of the components x, y and z");
  const auto points = field.points();
  for (std::size_t axis = 0; axis < 3; ++axis) python::copy_to(components[axis].cast<Columns>(), points[axis], name);
}

py::array copy_of(const ConstView& points) {
  Columns copy({points.extent[0], points.extent[1], points.extent[2]});
  double* to = copy.mutable_data();
  for (int k = 0; k < points.extent[2]; ++k)
    for (int j = 0; j < points.extent[1]; ++j, to += points.extent[0])
      std::copy_n(points.row(j, k), points.extent[0], to);
  return copy;
}

py::tuple copy_of(const FaceVector& field) {
  return py::make_tuple(copy_of(field.x.points()), copy_of(field.y.points()), copy_of(field.z.points()));
}

void bind_grid(py::module_& m) {
  py::class_<Grid>(m, "Grid")
      .def(py::init([](const Vector3& lower, const Vector3& upper, const std::array<int, 3>& cells,
                       const std::array<bool, 3>& periodic, const std::array<bool, 3>& mirror) {
        return Grid(lower, upper, cells, {periodic, mirror});
      }))
      .def_readonly("lower", &Grid::lower)
      .def_readonly("upper", &Grid::upper)
      .def_readonly("cells", &Grid::cells)
      .def_readonly("periodic", &Grid::periodic)
      .def_readonly("mirror", &Grid::mirror)
      .def("positions", [](const Grid& grid, int centring) {
        // One array of positions for each axis.
        const auto place = static_cast<Centring>(centring);
        const std::array<int, 3> extent = point_extent(grid, place);
        py::list axes;
        for (int axis = 0; axis < 3; ++axis) {
          py::array_t<double> points(extent[axis]);
          for (int i = 0; i < extent[axis]; ++i) points.mutable_at(i) = point_position(grid, place, i, i, i)[axis];
          axes.append(points);
        }
        return py::tuple(axes);
      });
  m.def("max_divergence", [](const Grid& grid, const py::sequence& velocity) {
    FaceVector u(grid);
    copy_to(velocity, u, "velocity");
    return max_divergence(u);
  });
}

class ScalarSolver {
 public:
  ScalarSolver(const Grid& grid, const std::string& boundary, double alpha, const py::object& mu,
               const std::string& solver)
      : problem_(grid, Centring::cell,
                 chosen<BoundaryCondition>(boundary, std::array<const char*, 2>{"dirichlet", "neumann"}, "boundary"),
                 alpha, viscosity_of(mu, grid)),
        solver_(make_elliptic_solver(problem_, options_of(solver))) {}

  py::tuple solve(const Columns& rhs) {
    Field<Cell> b(problem_.grid), x(problem_.grid);
    python::copy_to(rhs, b.points(), "rhs");
    const SolveReport report = [&] {
      const py::gil_scoped_release unlocked;
      return solver_->solve(b.unknowns(), x.unknowns());
    }();
    py::dict said;
    said["iterations"] = report.iterations;
    said["converged"] = report.converged;
    said["removed_mean"] = report.removed_mean[0];
    said["relative_residual"] = relative_residual(problem_, b.unknowns(), x.unknowns());
    return py::make_tuple(copy_of(ConstView(x.points())), said);
  }
  std::string name() const { return solver_->name(); }

 private:
  EllipticProblem problem_;
  std::unique_ptr<EllipticSolver> solver_;
};

class Stokes {
 public:
  Stokes(const Grid& grid, const py::object& viscosity, const py::object& boundary, double tolerance,
         int max_iterations)
      : walls_(grid, boundary_of(boundary)), solver_(grid, {tolerance, max_iterations}) {
    solver_.update(viscosity_of(viscosity, grid));
  }

  py::tuple solve(const py::object& force, const Vector3& uniform_force) {
    const Grid& grid = solver_.grid();
    FaceVector f(grid), u(grid);
    Field<Cell> p(grid);
    if (!force.is_none()) copy_to(force.cast<py::sequence>(), f, "force");
    const StokesReport report = [&] {
      const py::gil_scoped_release unlocked;
      return solver_.solve(f, walls_, u, p, uniform_force);
    }();
    py::dict said;
    said["iterations"] = report.iterations;
    said["converged"] = report.converged;
    said["residual"] = report.residual;
    said["divergence"] = report.divergence;
    return py::make_tuple(copy_of(u), copy_of(ConstView(p.points())), said);
  }

 private:
  WallVelocity walls_;
  StokesSolver solver_;
};

NavierStokes navier_stokes(const Grid& grid, double reynolds_number, const py::object& viscosity,
                           const std::string& inertia, const std::string& treatment, const std::string& velocity_solver,
                           const std::string& pressure_solver, const std::string& precision, const py::object& boundary,
                           bool unsteady) {
  FluidParameters parameters;
  parameters.reynolds_number = reynolds_number;
  parameters.viscosity = viscosity_of(viscosity, grid);
  parameters.inertia = chosen<Inertia>(inertia, std::array<const char*, 3>{"full", "unsteady", "none"}, "inertia");
  parameters.viscous_treatment = chosen<ViscousTreatment>(
      treatment, std::array<const char*, 3>{"explicit", "extrapolated", "implicit"}, "viscous_treatment");
  parameters.velocity_solver = options_of(velocity_solver);
  parameters.pressure_solver = options_of(pressure_solver);
  parameters.precision = chosen<Precision>(precision, std::array<const char*, 2>{"double", "mixed"}, "precision");
  return {grid, parameters, boundary_of(boundary), unsteady ? WallMotion::unsteady : WallMotion::steady};
}

void bind_solvers(py::module_& m) {
  py::class_<ScalarSolver>(m, "ScalarSolver")
      .def(py::init<const Grid&, const std::string&, double, const py::object&, const std::string&>())
      .def("solve", &ScalarSolver::solve)
      .def("name", &ScalarSolver::name);
  py::class_<Stokes>(m, "Stokes")
      .def(py::init<const Grid&, const py::object&, const py::object&, double, int>())
      .def("solve", &Stokes::solve);
  py::class_<NavierStokes>(m, "NavierStokes")
      .def(py::init(&navier_stokes))
      .def("set_velocity",
           [](NavierStokes& fluid, const py::function& velocity) {
             const VectorCallback function(velocity, "the velocity");
             fluid.set_velocity([&function](const Vector3& x) { return function(x, 0.0); });
           })
      .def("start_from",
           [](NavierStokes& fluid, const py::sequence& velocity) {
             FaceVector u(fluid.grid());
             copy_to(velocity, u, "velocity");
             fluid.start_from(u, Field<Cell>(fluid.grid()));
           })
      .def("step", &NavierStokes::step, py::call_guard<py::gil_scoped_release>())
      .def("set_force", [](NavierStokes& fluid, const py::sequence& force) { copy_to(force, fluid.force(), "force"); })
      .def("set_uniform_force", [](NavierStokes& fluid, const Vector3& force) { fluid.uniform_force() = force; })
      .def("velocity", [](py::object self) { return read_only_view(self.cast<NavierStokes&>().velocity(), self); })
      .def("pressure",
           [](py::object self) { return read_only_view(self.cast<NavierStokes&>().pressure().points(), self); })
      .def_property_readonly("time", [](const NavierStokes& fluid) { return fluid.time(); })
      .def_property_readonly("steps", [](const NavierStokes& fluid) { return fluid.steps(); })
      .def("max_divergence", [](const NavierStokes& fluid) { return max_divergence(fluid.velocity()); })
      .def("solver_names", [](const NavierStokes& fluid) {
        return py::make_tuple(fluid.velocity_solver_name(), fluid.pressure_solver_name());
      });
}

}  // namespace

PYBIND11_MODULE(_fluid, m) {
  bind_grid(m);
  bind_solvers(m);
  m.def("version", [] { return std::string(version()); });
  m.def("built_with", [] { return std::string(built_with()); });
}

}  // namespace vesiflow::python
