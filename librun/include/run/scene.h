// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupling/flow.h"
#include "coupling/simulation_parameters.h"
#include "run/errors.h"
#include "run/export.h"

namespace vesiflow::run {

/// Where the defaults come from.
enum class Preset {
  standard,  ///< what this library recommends
  paper      ///< what the paper does
};
/// A target for the largest relative error, from which grid, mesh and step follow.
enum class Accuracy {
  as_given,        ///< no target: what the scene says
  per_cent,        ///< 1e-2
  per_mille,       ///< 1e-3
  tenth_per_mille  ///< 1e-4
};
/// The flow of a scene.
enum class FlowType {
  rest,               ///< coupling::flow_at_rest()
  shear,              ///< coupling::shear_flow()
  oscillating_shear,  ///< coupling::oscillating_shear_flow()
  extension,          ///< coupling::extension_flow()
  plane_poiseuille,   ///< coupling::plane_poiseuille_flow()
  duct,               ///< coupling::duct_flow()
  custom              ///< a flow that a program gives
};
/// What a run does that cannot go on.
enum class OnBlowUp {
  stop,        ///< it stops
  reduce_step  ///< it goes back to its last checkpoint and takes half the step
};

/// The file of shape coefficients or mesh that a vesicle starts from.
struct SurfaceFile {
  std::optional<std::string> file;  ///< absolute once a scene is loaded
  std::optional<int> fit_degrees;   ///< of the surface that is fitted to a mesh; as many as it determines unless given
};

/// Everything a scene file can say, with its defaults. docs/scene.md documents each key; names there and here are the
/// same, but that the keys of `limits` and `membrane.g` which concern no simulation are in `ending` and `g`.
struct VESIFLOW_RUN_EXPORT Scene : coupling::SimulationParameters {
  std::string title;  ///< one line, for people

  /// Presets.
  struct Method {
    Preset preset = Preset::standard;        ///< where defaults come from
    Accuracy accuracy = Accuracy::as_given;  ///< target for the error
  } method;                                  ///< presets

  /// The flow and its numbers.
  struct Flow {
    FlowType type = FlowType::shear;                              ///< which flow
    double rate = 1.0;                                            ///< of shear and extension
    double angular_frequency = 1.0;                               ///< of an oscillating shear
    coupling::Extension extension = coupling::Extension::planar;  ///< kind of extension
    double peak_velocity = 1.0;                                   ///< of plane Poiseuille and duct flow
    coupling::FlowStart start = coupling::FlowStart::flow;        ///< what the fluid does at t = 0
  } flow;                                                         ///< the flow
  std::optional<double> g;  ///< membrane.g = dt sigma0/(4 mu h): another way to give membrane.sigma0

  /// When and how a run ends, beside time.end.
  struct Ending {
    double wall_time = 0.0;  ///< limits.wall_time: seconds after which a run ends with a checkpoint; 0: none
    OnBlowUp on_blowup = OnBlowUp::stop;  ///< limits.on_blowup
    int retries = 3;                      ///< limits.retries: of on_blowup = reduce_step, in a run
  } ending;                               ///< when and how a run ends

  /// Intervals in time at which a run writes; 0 is never.
  struct Output {
    double diagnostics_every = 0.05;  ///< rows of diagnostics.csv
    double vesicle_every = 0.5;       ///< snapshots of the membranes
    double fluid_every = 4.0;         ///< snapshots of the fluid
    double checkpoint_every = 1.0;    ///< checkpoints
    bool report = true;               ///< output.report: a page at the end, see run/report.h
  } output;                           ///< what it writes, and when

  /// Of vesicles by number; it may be shorter than `vesicles`. Loading a scene reads VesicleParameters::surface from
  /// them; programs that fill a Scene themselves may set that instead.
  std::vector<SurfaceFile> surface_files;

  /// That of a vesicle, without a file where it has none.
  const SurfaceFile& surface_file(std::size_t vesicle) const;
};

/// The flow that the scene names, in its domain.
/// \throws SceneError for flow.type = "custom", which only a program can give.
VESIFLOW_RUN_EXPORT coupling::Flow flow_of(const Scene& scene);

/// `name=value` pairs as given with `--set`: `time.end=2`, `vesicles.0.radius=0.8`; the only vesicle needs no number.
using Overrides = std::vector<std::string>;

/// Reads and checks a scene; a folder stands for the scene.toml in it.
/// \throws SceneError of all mistakes, naming file, line, key, value and what is allowed.
VESIFLOW_RUN_EXPORT Scene load_scene(const std::filesystem::path& file, const Overrides& overrides = {});

/// The same from text; `name` stands for the file in messages.
VESIFLOW_RUN_EXPORT Scene parse_scene(const std::string& text, const std::string& name,
                                      const Overrides& overrides = {});

/// Checks every key, and what no single one can be blamed for: what coupling::check() does, and what only scenes have.
/// `name` stands for the file in messages. load_scene and SceneSimulation do so themselves.
/// \throws SceneError of all mistakes.
VESIFLOW_RUN_EXPORT void check_scene(const Scene& scene, const std::string& name);

/// The scene as a TOML file with every key; parses back to the same scene.
/// \throws SceneError for an enumeration with a value that has no name.
VESIFLOW_RUN_EXPORT std::string to_toml(const Scene& scene);

/// One key of a scene file, for documentation and its test.
struct SceneKey {
  std::string name;           ///< dotted
  std::string default_value;  ///< as written in TOML; empty where there is none
  std::string allowed;        ///< values that are allowed, in words
};
/// All keys.
VESIFLOW_RUN_EXPORT std::vector<SceneKey> scene_keys();

}  // namespace vesiflow::run
