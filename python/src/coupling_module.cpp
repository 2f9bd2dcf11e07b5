// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// vesiflow._coupling: libcoupling for vesiflow/coupling.py, which documents it.
#include <omp.h>
#include <pybind11/stl.h>

#include <numbers>

#include "coupling/errors.h"
#include "coupling/flow.h"
#include "coupling/simulation.h"
#include "coupling/version.h"
#include "errors.h"
#include "fields.h"
#include "forces.h"
#include "parameters.h"

namespace vesiflow::python {
namespace {

using coupling::Flow;
using coupling::Simulation;
using coupling::SimulationParameters;

// The array of a membrane by its name. Those that need the geometry of the present time bring it up to date.
py::array membrane_array(py::object self, std::size_t vesicle, const std::string& name) {
  auto& simulation = self.cast<Simulation&>();
  if (vesicle >= simulation.vesicle_count()) throw py::index_error("there is no membrane " + std::to_string(vesicle));
  if (name == "velocity") return read_only_view(simulation.marker_velocity(vesicle), self);
  const vesicle::Membrane& membrane = simulation.membrane(vesicle);
  const vesicle::Surface& surface = membrane.surface();
  if (name == "positions") return read_only_view(membrane.positions(), self);
  if (name == "force") return read_only_view(membrane.force(), self);
  if (name == "tension") return read_only_view(membrane.tension(), self);
  if (name == "target_areas") return read_only_view(membrane.target_areas(), self);
  if (name == "normal") return read_only_view(surface.normal(), self);
  if (name == "area_weight") return read_only_view(surface.area_weight(), self);
  if (name == "mean_curvature") return read_only_view(surface.mean_curvature(), self);
  if (name == "gaussian_curvature") return read_only_view(surface.gaussian_curvature(), self);
  throw std::invalid_argument("a membrane has no array " + name);
}

// The numbers of docs/results.md, by their names there.
py::dict record_of(const vesicle::Diagnostics& d) {
  py::dict all;
  all["inclination_angle_deg"] = d.inclination_angle * 180.0 / std::numbers::pi;
  all["tank_treading_frequency"] = d.tank_treading_frequency;
  all["area_error"] = d.area_error;
  all["volume_error"] = d.volume_error;
  all["max_local_area_error"] = d.max_local_area_error;
  all["max_label_area_error"] = d.max_label_area_error;
  all["surface_divergence_max"] = d.surface_divergence_max;
  all["bending_energy"] = d.bending_energy;
  all["elastic_energy"] = d.elastic_energy;
  all["reduced_volume"] = d.reduced_volume;
  all["excess_area"] = d.excess_area;
  all["deformation"] = d.deformation;
  all["area"] = d.area;
  all["volume"] = d.volume;
  for (int axis = 0; axis < 3; ++axis) all[("centroid_" + std::string(1, "xyz"[axis])).c_str()] = d.centroid[axis];
  for (int axis = 0; axis < 3; ++axis) all[("semi_axis_" + std::to_string(axis + 1)).c_str()] = d.semi_axes[axis];
  all["tension_min"] = d.tension_min;
  all["tension_max"] = d.tension_max;
  all["spectrum_tail"] = d.spectrum_tail;
  all["unresolved_bending"] = d.resolution.unresolved;
  all["needed_latitudes"] = static_cast<double>(d.resolution.needed_latitudes);
  all["mesh_aspect_ratio"] = d.mesh_aspect_ratio;
  all["mesh_area_ratio"] = d.mesh_area_ratio;
  return all;
}

py::list measured(Simulation& simulation) {
  const auto [all, distances] = [&simulation] {
    const py::gil_scoped_release unlocked;
    return std::pair(simulation.measure(), simulation.nearest_distances());
  }();
  py::list rows;
  for (std::size_t i = 0; i < all.size(); ++i) {
    py::dict row = record_of(all[i]);
    if (all.size() > 1) row["min_distance"] = distances[i];
    rows.append(row);
  }
  return rows;
}

void bind_flows(py::module_& m) {
  py::class_<SimulationParameters>(m, "Parameters")
      .def(py::init([](const py::dict& values) { return parameters_of(values); }))
      .def("dict", [](const SimulationParameters& parameters) { return dict_of(parameters); });
  py::class_<Flow>(m, "Flow")
      .def_readonly("description", &Flow::description)
      .def("set_start_at_rest", [](Flow& flow, bool at_rest) {
        flow.start = at_rest ? coupling::FlowStart::rest : coupling::FlowStart::flow;
      });
  m.def("flow_at_rest", [](const SimulationParameters&) { return coupling::flow_at_rest(); });
  m.def("shear_flow", [](const SimulationParameters& p, double rate) { return coupling::shear_flow(rate, p.domain); });
  m.def("oscillating_shear_flow", [](const SimulationParameters& p, double rate, double angular_frequency) {
    return coupling::oscillating_shear_flow(rate, angular_frequency, p.domain);
  });
  m.def("extension_flow", [](const SimulationParameters& p, double rate, bool uniaxial) {
    return coupling::extension_flow(rate, uniaxial ? coupling::Extension::uniaxial : coupling::Extension::planar,
                                    p.domain);
  });
  m.def("plane_poiseuille_flow", [](const SimulationParameters& p, double peak_velocity) {
    return coupling::plane_poiseuille_flow(peak_velocity, p.domain);
  });
  m.def("duct_flow", [](const SimulationParameters& p, double peak_velocity) {
    return coupling::duct_flow(peak_velocity, p.domain);
  });
  m.def("custom_flow", [](py::function velocity, bool unsteady, const std::array<bool, 3>& may_be_periodic,
                          double driving_force, double greatest_gradient) {
    Flow flow = coupling::custom_flow(VectorCallback(std::move(velocity), "a flow"),
                                      unsteady ? fluid::WallMotion::unsteady : fluid::WallMotion::steady);
    flow.may_be_periodic = may_be_periodic;
    flow.driving_force = driving_force;
    flow.greatest_gradient = greatest_gradient;
    return flow;
  });
}

void bind_simulation(py::module_& m) {
  py::class_<BorrowedSurface, std::shared_ptr<BorrowedSurface>>(m, "BorrowedSurface")
      .def("field", &BorrowedSurface::field)
      .def("area", &BorrowedSurface::area)
      .def("volume", &BorrowedSurface::volume);
  py::class_<Simulation>(m, "Simulation")
      .def(py::init([](const SimulationParameters& parameters, const Flow& flow) {
        const py::gil_scoped_release unlocked;
        return std::make_unique<Simulation>(parameters, flow);
      }))
      .def("step", &Simulation::step, py::call_guard<py::gil_scoped_release>())
      .def("finished", &Simulation::finished)
      .def("time", &Simulation::time)
      .def("steps", &Simulation::steps)
      .def("time_step", &Simulation::time_step)
      .def("last_step", &Simulation::last_step)
      .def("set_time_step", &Simulation::set_time_step)
      .def("parameters", [](const Simulation& simulation) { return dict_of(simulation.parameters()); })
      .def("flow_description", [](const Simulation& simulation) { return simulation.flow().description; })
      .def("flow_velocity", [](const Simulation& simulation, const std::array<double, 3>& x,
                               double time) { return simulation.flow().velocity(x, time); })
      .def("add_force",
           [](Simulation& simulation, py::function force) { simulation.add_force(membrane_force(std::move(force))); })
      .def("set_fluid_force",
           [](Simulation& simulation, const py::object& force, bool of_arrays) {
             if (force.is_none())
               simulation.set_fluid_force(nullptr);
             else if (of_arrays)
               simulation.set_fluid_force(FaceForce(force.cast<py::function>(), simulation.fluid().grid()));
             else
               simulation.set_fluid_force(VectorCallback(force.cast<py::function>(), "a force on the fluid"));
           })
      .def("vesicle_count", &Simulation::vesicle_count)
      .def("membrane_array", &membrane_array)
      .def("latitudes",
           [](Simulation& simulation, std::size_t i) { return simulation.membrane(i).surface().grid().latitudes(); })
      .def("measure", &measured)
      .def("nearest_distances", &Simulation::nearest_distances)
      .def("max_divergence", &Simulation::max_divergence)
      .def("velocity_noise", &Simulation::velocity_noise)
      .def("redistributions", &Simulation::redistributions)
      .def("rejected_steps", &Simulation::rejected_steps)
      .def("start_parts", &Simulation::start_parts)
      .def("velocity", [](py::object self) { return read_only_view(self.cast<Simulation&>().fluid_velocity(), self); })
      .def("pressure",
           [](py::object self) { return read_only_view(self.cast<Simulation&>().fluid().pressure().points(), self); })
      .def("viscosity",
           [](py::object self) -> py::object {
             const auto* field = self.cast<Simulation&>().viscosity();
             if (field == nullptr) return py::none();
             return read_only_view(field->points(), self);
           })
      .def("phases", [](const Simulation& simulation) {
        py::dict seconds;
        const coupling::Phases phases = simulation.phases();
        coupling::visit_phases(phases, [&seconds](const char* name, const fluid::PhaseAccount& account) {
          seconds[name] = account.seconds;
        });
        return seconds;
      });
}

}  // namespace

PYBIND11_MODULE(_coupling, m) {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const coupling::ParameterError& error) {
      set_error("ParameterError", error.what(), error.mistakes());
    } catch (const coupling::SimulationStopped& error) {
      set_error("SimulationStopped", error.what(), error.advice());
    }
  });
  bind_flows(m);
  bind_simulation(m);
  m.def("threads", [] { return omp_get_max_threads(); });
  m.def("set_threads", [](int threads) { omp_set_num_threads(threads); });
  m.def("version", [] { return std::string(coupling::version()); });
  m.def("built_with", [] { return std::string(coupling::built_with()); });
}

}  // namespace vesiflow::python
