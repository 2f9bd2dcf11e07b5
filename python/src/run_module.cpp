// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// vesiflow._run: librun for vesiflow/run.py, which documents it.
#include "run/report.h"
#include "run/run.h"

#include <pybind11/stl.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "coupling/flow.h"
#include "errors.h"
#include "fields.h"
#include "run/checkpoint.h"
#include "run/plan.h"
#include "run/start_from.h"
#include "run/version.h"

namespace vesiflow::python {
namespace {

using namespace run;

constexpr std::array<const char*, 4> output_names{"diagnostics", "vesicle_snapshot", "fluid_snapshot", "checkpoint"};

// A function of Python for each step and output, which takes no simulation: the caller has it.
RunOptions options_of(const py::dict& given) {
  RunOptions options;
  options.program = given["program"].cast<std::string>();
  options.scene_file = given["scene_file"].cast<std::string>();
  options.directory = given["directory"].cast<std::string>();
  if (!given["checkpoint"].is_none()) options.checkpoint = given["checkpoint"].cast<std::string>();
  if (!given["start_from"].is_none()) options.start_from = given["start_from"].cast<std::string>();
  options.quiet = given["quiet"].cast<bool>();
  options.command = given["command"].cast<std::vector<std::string>>();
  if (!given["after_step"].is_none())
    options.after_step = [callback = Callback(given["after_step"].cast<py::function>())](const SceneSimulation&) {
      const py::gil_scoped_acquire lock;
      callback.function()();
    };
  if (!given["before_output"].is_none())
    options.before_output = [callback = Callback(given["before_output"].cast<py::function>())](const SceneSimulation&,
                                                                                               RunOutput output) {
      const py::gil_scoped_acquire lock;
      callback.function()(output_names[static_cast<std::size_t>(output)]);
    };
  for (const auto& [name, function] : given["diagnostics"].cast<py::dict>())
    options.diagnostics.push_back({name.cast<std::string>(), [callback = Callback(function.cast<py::function>())](
                                                                 SceneSimulation&, std::size_t vesicle) {
                                     const py::gil_scoped_acquire lock;
                                     return callback.function()(vesicle).cast<double>();
                                   }});
  return options;
}

void bind_scene(py::module_& m) {
  py::class_<Scene, coupling::SimulationParameters>(m, "Scene")
      .def(py::init<>())
      .def("to_toml", &to_toml)
      .def("plan", [](const Scene& scene, int threads,
                      const std::string& folder) { return describe_plan(scene, threads, folder); })
      .def("memory_warning", &memory_warning);
  m.def("load_scene", [](const std::string& file, const Overrides& overrides) { return load_scene(file, overrides); });
  m.def("parse_scene", [](const std::string& text, const std::string& name, const Overrides& overrides) {
    return parse_scene(text, name, overrides);
  });
  m.def("read_checkpoint_scene",
        [](const std::string& file, const Overrides& overrides) { return read_checkpoint_scene(file, overrides); });
  m.def("scene_keys", [] {
    py::list keys;
    for (const SceneKey& key : scene_keys()) keys.append(py::make_tuple(key.name, key.default_value, key.allowed));
    return keys;
  });
}

void bind_simulation(py::module_& m) {
  py::class_<SceneSimulation, coupling::Simulation>(m, "SceneSimulation")
      .def(py::init([](const Scene& scene) {
        const py::gil_scoped_release unlocked;
        return std::make_unique<SceneSimulation>(scene);
      }))
      .def(py::init([](const Scene& scene, const coupling::Flow& flow) {
        const py::gil_scoped_release unlocked;
        return std::make_unique<SceneSimulation>(scene, flow);
      }))
      .def("scene", &SceneSimulation::scene, py::return_value_policy::copy)
      .def("set_time_step", &SceneSimulation::set_time_step)
      .def("write_checkpoint",
           [](const SceneSimulation& simulation, const std::string& file) {
             const py::gil_scoped_release unlocked;
             write_checkpoint(file, simulation);
           })
      .def("restore_checkpoint",
           [](SceneSimulation& simulation, const std::string& file) {
             const py::gil_scoped_release unlocked;
             restore_checkpoint(file, simulation);
           })
      .def("start_from", [](SceneSimulation& simulation, const std::string& run) {
        const py::gil_scoped_release unlocked;
        start_from(run, simulation);
      });
  m.def("run", [](SceneSimulation& simulation, const py::dict& given) {
    const RunOptions options = options_of(given);
    const RunStatus status = [&] {
      const py::gil_scoped_release unlocked;
      return run::run(simulation, options);
    }();
    return py::make_tuple(name_of(status), exit_code::of(status));
  });
}

// Progress and warnings go to standard error, as those of the apps do.
void set_logger() {
  constexpr const char* name = "vesiflow";
  const std::shared_ptr<spdlog::logger> known = spdlog::get(name);
  spdlog::set_default_logger(known ? known : spdlog::stderr_color_mt(name));
  spdlog::set_pattern("%^%l%$: %v");
}

}  // namespace

PYBIND11_MODULE(_run, m) {
  py::module_::import("vesiflow._coupling");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const SceneError& error) {
      set_error("SceneError", error.what());
    } catch (const FileError& error) {
      set_error("FileError", error.what());
    }
  });
  set_logger();
  bind_scene(m);
  bind_simulation(m);
  m.def("write_report", [](const std::string& folder, const std::string& file, int most_frames, bool live) {
    const py::gil_scoped_release unlocked;
    write_report(folder, file, {.most_frames = most_frames, .live = live});
  });
  m.def("report_has_viewer", [] { return report_has_viewer(); });
  m.def("version", [] { return std::string(version()); });
  m.def("built_with", [] { return std::string(built_with()); });
}

}  // namespace vesiflow::python
