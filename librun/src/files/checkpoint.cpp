// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "files/atomic_file.h"
#include "files/hdf5_file.h"
#include "files/state_checksum.h"
#include "run/errors.h"
#include "scene/scene_file.h"
#include "scene/scene_keys.h"

namespace vesiflow::run {
namespace {

constexpr std::int64_t checkpoint_format = 5;

template <class Centring>
void write_field(Hdf5File& file, const std::string& name, const fluid::Field<Centring>& field) {
  file.write(name, field.data(),
             {static_cast<std::uint64_t>(field.extent(2) + 2), static_cast<std::uint64_t>(field.extent(1) + 2),
              static_cast<std::uint64_t>(field.extent(0) + 2)});
}

void write_velocity(Hdf5File& file, const std::string& name, const fluid::FaceVector& u) {
  write_field(file, name + "/x", u.x);
  write_field(file, name + "/y", u.y);
  write_field(file, name + "/z", u.z);
}

void write_array(Hdf5File& file, const std::string& name, const double* values, Eigen::Index size) {
  file.write(name, values, {static_cast<std::uint64_t>(size)});
}

void read_into(const Hdf5File& file, const std::string& name, double* values, std::size_t size,
               const std::filesystem::path& path) {
  if (const std::uint64_t stored = file.size(name); stored != size)
    throw FileError(fmt::format("{}: {} has {} values, expected {}", path.string(), name, stored, size));
  std::ranges::copy(file.read(name), values);
}

template <class Centring>
void read_field(const Hdf5File& file, const std::string& name, fluid::Field<Centring>& field,
                const std::filesystem::path& path) {
  read_into(file, name, field.data(), field.size(), path);
}

void read_velocity(const Hdf5File& file, const std::string& name, fluid::FaceVector& u,
                   const std::filesystem::path& path) {
  read_field(file, name + "/x", u.x, path);
  read_field(file, name + "/y", u.y, path);
  read_field(file, name + "/z", u.z, path);
}

/// Of VesicleState::inner_velocities.
constexpr std::array<const char*, 3> inner_names{"/inner_velocity", "/previous_inner_velocity",
                                                 "/earlier_inner_velocity"};

void write_vesicle(Hdf5File& file, const std::string& group, const coupling::VesicleState& state) {
  const auto& m = state.membrane;
  write_array(file, group + "/positions", m.positions.data(), m.positions.size());
  write_array(file, group + "/target_areas", m.target_areas.data(), m.target_areas.size());
  write_array(file, group + "/initial_areas", m.initial_areas.data(), m.initial_areas.size());
  if (m.lagged_strain.size() > 0)
    write_array(file, group + "/lagged_strain", m.lagged_strain.data(), m.lagged_strain.size());
  if (m.integral_tension.size() > 0)
    write_array(file, group + "/integral_tension", m.integral_tension.data(), m.integral_tension.size());
  file.attribute(group, "initial_volume", m.initial_volume);
  file.attribute(group, "redistributions", state.redistributions);
  if (!state.motion_history.empty())
    write_array(file, group + "/motion_history", state.motion_history.data(),
                static_cast<Eigen::Index>(state.motion_history.size()));
  if (state.interface_velocity.size() > 0)
    write_array(file, group + "/interface_velocity", state.interface_velocity.data(), state.interface_velocity.size());
  if (state.previous_interface_velocity.size() > 0)
    write_array(file, group + "/previous_interface_velocity", state.previous_interface_velocity.data(),
                state.previous_interface_velocity.size());
  for (std::size_t i = 0; i < state.inner_velocities.size(); ++i) {
    const std::vector<double>& row = state.inner_velocities[i];
    write_array(file, group + inner_names.at(i), row.data(), static_cast<Eigen::Index>(row.size()));
  }
}

coupling::VesicleState read_vesicle(const Hdf5File& file, const std::string& group, Eigen::Index markers,
                                    const std::filesystem::path& path) {
  coupling::VesicleState state;
  auto& m = state.membrane;
  m.positions.resize(markers, 3);
  m.target_areas.resize(markers);
  m.initial_areas.resize(markers);
  const auto size = static_cast<std::size_t>(markers);
  read_into(file, group + "/positions", m.positions.data(), 3 * size, path);
  read_into(file, group + "/target_areas", m.target_areas.data(), size, path);
  read_into(file, group + "/initial_areas", m.initial_areas.data(), size, path);
  const auto read_optional = [&](const std::string& name, vesicle::ScalarField& field) {
    if (!file.exists(group + name)) return;
    field.resize(markers);
    read_into(file, group + name, field.data(), size, path);
  };
  read_optional("/lagged_strain", m.lagged_strain);
  read_optional("/integral_tension", m.integral_tension);
  m.initial_volume = file.read_number(group, "initial_volume");
  state.redistributions = file.read_integer(group, "redistributions");
  if (file.exists(group + "/motion_history")) state.motion_history = file.read(group + "/motion_history");
  const auto read_velocity = [&](const std::string& name, vesicle::VectorField& field) {
    if (!file.exists(group + name)) return;
    field.resize(markers, 3);
    read_into(file, group + name, field.data(), 3 * size, path);
  };
  read_velocity("/interface_velocity", state.interface_velocity);  // of sharp membranes between two viscosities
  read_velocity("/previous_interface_velocity", state.previous_interface_velocity);
  for (const char* name : inner_names)  // of those in a fluid with inertia
    if (file.exists(group + name)) state.inner_velocities.push_back(file.read(group + name));
  return state;
}

std::string start_name(std::size_t vesicle) {
  return fmt::format("/start/vesicle_{}", vesicle);
}

void write_start(Hdf5File& file, const coupling::Start& start) {
  file.attribute("/start", "run", start.run);
  file.attribute("/start", "time", start.time);
  file.attribute("/start", "steps", start.steps);
  for (std::size_t i = 0; i < start.membranes.size(); ++i)
    write_vesicle(file, start_name(i), {start.membranes[i], {}, 0, {}});
}

std::shared_ptr<const coupling::Start> read_start(const Hdf5File& file, const Scene& scene,
                                                  const std::filesystem::path& path) {
  if (!file.exists("/start")) return nullptr;
  auto start = std::make_shared<coupling::Start>();
  start->run = file.read_text("/start", "run");
  start->time = file.read_number("/start", "time");
  start->steps = file.read_integer("/start", "steps");
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
    const Eigen::Index latitudes = scene.latitudes(i);
    start->membranes.push_back(read_vesicle(file, start_name(i), 2 * latitudes * latitudes, path).membrane);
  }
  return start;
}

// What may differ between the run that wrote a checkpoint and the one that continues it.
bool may_differ(const std::string& key) {
  return key == "title" || key == "time.end" || key.starts_with("limits.") || key.starts_with("output.");
}

bool same_surface(const std::optional<vesicle::Coefficients>& a, const std::optional<vesicle::Coefficients>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  if (a->degrees() != b->degrees()) return false;
  for (int field = 0; field < 3; ++field)
    for (int n = 0; n < a->degrees(); ++n)
      for (int m = 0; m <= n; ++m)
        if ((*a)(field, n, m) != (*b)(field, n, m)) return false;
  return true;
}

void check_same_scene(const Scene& written, const Scene& now, const std::filesystem::path& path) {
  if (written.vesicles.size() != now.vesicles.size())
    throw SceneError(fmt::format("{}: was written with {} vesicles, this scene has {}", path.string(),
                                 written.vesicles.size(), now.vesicles.size()));
  auto before = scene_values(written), after = scene_values(now);
  for (const auto& [key, value] : before) after.try_emplace(key, "absent");
  for (const auto& [key, other_value] : after) {
    if (may_differ(key)) continue;
    const std::string& value = before.try_emplace(key, "absent").first->second;
    if (other_value != value)
      throw SceneError(fmt::format(
          "{}: was written with {} = {}, this scene has {}; a restart keeps everything but title, "
          "time.end, limits and output\n  --start-from in the place of --restart begins a new run, at t = 0, with "
          "these vesicles and this velocity",
          path.string(), key, value, other_value));
  }
  for (std::size_t i = 0; i < written.vesicles.size(); ++i)
    if (!same_surface(written.vesicles[i].surface, now.vesicles[i].surface))
      throw SceneError(
          fmt::format("{}: was written with another surface in vesicles.{}.file; restart without the scene "
                      "file, or give back the old file",
                      path.string(), i));
}

std::string surface_name(std::size_t vesicle) {
  return fmt::format("/vesicle_{}/initial_surface", vesicle);
}

// A row of 3 fields times real and imaginary part for each (n, m): n ascending, m = 0 .. n.
void write_surface(Hdf5File& file, const std::string& name, const vesicle::Coefficients& surface) {
  std::vector<double> values;
  for (int n = 0; n < surface.degrees(); ++n)
    for (int m = 0; m <= n; ++m)
      for (int field = 0; field < 3; ++field) {
        values.push_back(surface(field, n, m).real());
        values.push_back(surface(field, n, m).imag());
      }
  file.write(name, values.data(), {values.size() / 6, 3, 2});
}

vesicle::Coefficients read_surface(const Hdf5File& file, const std::string& name, const std::filesystem::path& path) {
  const std::vector<double> values = file.read(name);
  int degrees = 1;
  while (std::size_t(degrees) * std::size_t(degrees + 1) * 3 < values.size()) ++degrees;
  vesicle::Coefficients surface(degrees, 3);
  if (std::size_t(degrees) * std::size_t(degrees + 1) * 3 != values.size())
    throw FileError(
        fmt::format("{}: {} has {} values, no number of degrees has that many", path.string(), name, values.size()));
  const double* value = values.data();
  for (int n = 0; n < degrees; ++n)
    for (int m = 0; m <= n; ++m)
      for (int field = 0; field < 3; ++field, value += 2) surface(field, n, m) = {value[0], value[1]};
  return surface;
}

void require_checksum(const Hdf5File& file, const std::string& name, std::int64_t sum, const std::string& what,
                      const std::filesystem::path& path) {
  if (file.read_integer("/", name) != sum)
    throw FileError(fmt::format("{}: {} is not what was written: blocks of the file are lost, or were exchanged",
                                path.string(), what));
}

void require_format(const Hdf5File& file, const std::filesystem::path& path) {
  const std::int64_t format = file.read_integer("/", "format");
  if (format != checkpoint_format)
    throw SceneError(
        fmt::format("{}: checkpoint of format {}, this version reads format {}: finish the run with the version of the "
                    "program that wrote it, which summary.json names, or start anew from its scene.toml",
                    path.string(), format, checkpoint_format));
}

Scene scene_of(const Hdf5File& file, const std::filesystem::path& path, const Overrides& overrides = {}) {
  require_format(file, path);
  const std::string text = file.read_text("/", "scene");
  return parse_scene(text, path.string(), overrides, [&](Scene& scene) {
    for (std::size_t i = 0; i < scene.vesicles.size(); ++i)
      if (file.exists(surface_name(i))) scene.vesicles[i].surface = read_surface(file, surface_name(i), path);
    require_checksum(file, "scene_checksum", checksum_of(scene, text), "the scene", path);
  });
}

// To a reader an unusable checkpoint is bad input, like a wrong scene: nothing of the user's has been touched.
template <class Read>
auto as_input(const Read& read) {
  try {
    return read();
  } catch (const FileError& error) {
    throw SceneError(fmt::format(
        "{}\n  this checkpoint cannot be used: take a copy of it or an earlier one, or start anew from the scene",
        error.what()));
  }
}

constexpr const char* mean_flow_name = "/mean_flow";
/// Of SimulationState::outer_velocities, and the length of the step from the third to the second.
constexpr std::array<const char*, 3> outer_names{"/outer_velocity", "/previous_outer_velocity",
                                                 "/earlier_outer_velocity"};
constexpr const char* earlier_step_name = "/earlier_step";

coupling::SimulationState read_state(const Hdf5File& file, const Scene& scene, const std::filesystem::path& path) {
  const fluid::Grid grid = coupling::grid_of(scene);
  coupling::SimulationState state{
      fluid::FaceVector(grid), fluid::FaceVector(grid), fluid::Field<fluid::Cell>(grid), {}, {}, {}, {}, {}};
  state.clock = {.time = file.read_number("/", "time"),
                 .previous_time = file.read_number("/", "previous_time"),
                 .time_step = file.read_number("/", "time_step"),
                 .steps = file.read_integer("/", "steps")};
  read_velocity(file, "/velocity", state.velocity, path);
  read_velocity(file, "/previous_velocity", state.previous_velocity, path);
  read_field(file, "/pressure", state.pressure, path);
  if (file.exists("/step_control")) state.step_control = file.read("/step_control");
  if (file.exists(mean_flow_name))  // of sharp membranes between two viscosities, without walls and inertia
    read_into(file, mean_flow_name, state.mean_flow.data(), state.mean_flow.size(), path);
  for (const char* name : outer_names)  // of sharp membranes between two viscosities, with inertia
    if (file.exists(name)) read_velocity(file, name, state.outer_velocities.emplace_back(grid), path);
  if (file.exists(earlier_step_name)) read_into(file, earlier_step_name, &state.earlier_step, 1, path);
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i) {
    const Eigen::Index latitudes = scene.latitudes(i);
    state.vesicles.push_back(read_vesicle(file, fmt::format("/vesicle_{}", i), 2 * latitudes * latitudes, path));
  }
  state.start = read_start(file, scene, path);
  require_checksum(file, "state_checksum", checksum_of(state), "the state", path);
  return state;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const SceneSimulation& simulation) {
  const coupling::SimulationState state = simulation.state();
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    Hdf5File file(temporary, Hdf5File::Mode::create);
    file.attribute("/", "format", checkpoint_format);
    const Scene& scene = simulation.scene();
    const std::string text = to_toml(scene);
    file.attribute("/", "scene", text);
    file.attribute("/", "scene_checksum", checksum_of(scene, text));
    file.attribute("/", "state_checksum", checksum_of(state));
    file.attribute("/", "time", state.clock.time);
    file.attribute("/", "previous_time", state.clock.previous_time);
    file.attribute("/", "time_step", state.clock.time_step);
    file.attribute("/", "steps", static_cast<std::int64_t>(state.clock.steps));
    write_velocity(file, "/velocity", state.velocity);
    write_velocity(file, "/previous_velocity", state.previous_velocity);
    write_field(file, "/pressure", state.pressure);
    if (state.mean_flow != fluid::Vector3{})
      write_array(file, mean_flow_name, state.mean_flow.data(), static_cast<Eigen::Index>(state.mean_flow.size()));
    for (std::size_t i = 0; i < state.outer_velocities.size(); ++i)
      write_velocity(file, outer_names.at(i), state.outer_velocities[i]);
    if (state.earlier_step != 0.0) write_array(file, earlier_step_name, &state.earlier_step, 1);
    if (!state.step_control.empty())
      write_array(file, "/step_control", state.step_control.data(),
                  static_cast<Eigen::Index>(state.step_control.size()));
    for (std::size_t i = 0; i < state.vesicles.size(); ++i)
      write_vesicle(file, fmt::format("/vesicle_{}", i), state.vesicles[i]);
    if (state.start) write_start(file, *state.start);
    for (std::size_t i = 0; i < scene.vesicles.size(); ++i)
      if (const auto& surface = scene.vesicles[i].surface) write_surface(file, surface_name(i), *surface);
    file.close();
  });
}

Scene read_checkpoint_scene(const std::filesystem::path& path, const Overrides& overrides) {
  return as_input([&] { return scene_of(Hdf5File(path, Hdf5File::Mode::read), path, overrides); });
}

CheckpointContents read_checkpoint(const std::filesystem::path& path) {
  return as_input([&] {
    const Hdf5File file(path, Hdf5File::Mode::read);
    Scene scene = scene_of(file, path);
    coupling::SimulationState state = read_state(file, scene, path);
    return CheckpointContents{std::move(scene), std::move(state)};
  });
}

void restore_checkpoint(const std::filesystem::path& path, SceneSimulation& simulation) {
  const coupling::SimulationState state = as_input([&] {
    const Hdf5File file(path, Hdf5File::Mode::read);
    check_same_scene(scene_of(file, path), simulation.scene(), path);
    return read_state(file, simulation.scene(), path);
  });
  try {
    simulation.restore(state);
  } catch (const std::logic_error& error) {  // a value that cannot be, a membrane without a geometry
    throw SceneError(fmt::format("{}: the checkpoint is damaged: {}", path.string(), error.what()));
  } catch (const coupling::SimulationStopped& error) {  // a marker outside the box
    throw SceneError(fmt::format("{}: the checkpoint is damaged: {}", path.string(), error.what()));
  }
}

}  // namespace vesiflow::run
