// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Reading scene files.
#include "scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "run/errors.h"
#include "scene/accuracy.h"
#include "scene/coupling_choice.h"
#include "scene/key_suggestion.h"
#include "scene/scene_keys.h"
#include "scene/scene_mistakes.h"
#include "scene/scene_reader.h"
#include "scene/scene_surfaces.h"

namespace vesiflow::run {
namespace {

void refuse_unknown_keys(SceneDocument& document, const toml::table& table, const std::string& in_file,
                         const std::string& of_scene) {
  for (const auto& [name, node] : table)
    if (!is_scene_key(of_scene + std::string(name.str())))
      document.refuse_unknown(in_file + std::string(name.str()), node);
}

// Every key and table of the file that no scene has, but those of the vesicles.
void refuse_unknown(SceneDocument& document) {
  for (const auto& [name, node] : document.root()) {
    const std::string key(name.str()), prefix = key + ".";
    if (key == "vesicles" || is_scene_key(key)) continue;
    if (!is_scene_table(key))
      document.refuse_unknown(key, node);
    else if (node.is_table())
      refuse_unknown_keys(document, *node.as_table(), prefix, prefix);
    else
      document.refuse(key, node, fmt::format("must be one table of keys, headed [{}]", key));
  }
}

void read_vesicles(SceneDocument& document, Scene& scene) {
  const toml::node* node = document.find("vesicles");
  if (node == nullptr) {
    if (!document.misspells("vesicles"))
      document.add_mistake(fmt::format("{}: there is no [[vesicles]]; a scene needs at least one", document.name()));
    return;
  }
  if (!node->is_array_of_tables() || node->as_array()->empty())
    return document.refuse("vesicles", *node, "must be tables, each headed [[vesicles]]");
  const toml::array& list = *node->as_array();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string prefix = fmt::format("vesicles.{}.", i);
    SceneReader reader(document, prefix);
    visit_keys(scene.vesicles.emplace_back(), scene.surface_files.emplace_back(), reader);
    refuse_unknown_keys(document, *list.get(i)->as_table(), prefix, "vesicles.");
  }
}

// The degrees that are kept along a membrane cannot be more than it has.
void adapt_tangential_degrees(const SceneDocument& document, Scene& scene) {
  if (document.find("mesh.tangential_degrees") != nullptr) return;
  for (std::size_t i = 0; i < scene.vesicles.size(); ++i)
    scene.mesh.tangential_degrees = std::min(scene.mesh.tangential_degrees, scene.latitudes(i));
}

// Files are named relative to the folder of the scene.
std::string absolute_file(const std::string& file, const std::string& scene_name) {
  const std::filesystem::path folder = std::filesystem::path(scene_name).parent_path();
  return std::filesystem::absolute(folder / file).lexically_normal().string();
}

constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

}  // namespace

Scene parse_scene(const std::string& text, const std::string& name, const Overrides& overrides,
                  const std::function<void(Scene&)>& load_surfaces) {
  SceneDocument document(text, name, overrides);
  Scene scene;
  SceneReader reader(document, "");
  visit_preset(scene, reader);
  apply_preset(scene);
  visit_keys(scene, reader);
  refuse_unknown(document);
  read_vesicles(document, scene);
  document.refuse_mistakes();
  if (scene.method.accuracy != Accuracy::as_given) {
    coupling::Mistakes mistakes;
    mistakes.gather([&] { check_accuracy(scene); });
    refuse_scene(mistakes, name);
    apply_accuracy(scene);
    visit_keys(scene, reader);  // keys that are given win
  }
  adapt_tangential_degrees(document, scene);

  if (scene.g && document.find("membrane.sigma0") == nullptr)
    scene.membrane.sigma0 = *scene.g * 4.0 * scene.finest_spacing() / scene.time.step;
  for (SurfaceFile& surface : scene.surface_files)
    if (surface.file) surface.file = absolute_file(*surface.file, name);
  load_surfaces(scene);
  if (document.find("coupling.method") == nullptr) choose_coupling_method(scene);
  check_scene(scene, name);
  scene.g.reset();  // said; sigma0 is what counts from here on
  return scene;
}

Scene parse_scene(const std::string& text, const std::string& name, const Overrides& overrides) {
  return parse_scene(text, name, overrides, [&name](Scene& scene) { load_surfaces(scene, name); });
}

Scene load_scene(const std::filesystem::path& given, const Overrides& overrides) {
  std::error_code error;
  const bool is_folder = std::filesystem::is_directory(given, error);
  const std::filesystem::path file = is_folder ? given / "scene.toml" : given;
  std::ifstream stream(file);
  if (!stream && is_folder)
    throw SceneError(
        fmt::format("{}: is a folder without a scene.toml that can be read; name the scene file", given.string()));
  if (!stream) throw SceneError(fmt::format("{}: cannot be read: no such scene file, or no permission", file.string()));
  std::ostringstream text;
  text << stream.rdbuf();
  if (text.view().starts_with(hdf5_signature))
    throw SceneError(fmt::format("{}: is an HDF5 file, no scene; to go on from a checkpoint, give it with --restart {}",
                                 file.string(), file.string()));
  return parse_scene(text.str(), file.string(), overrides);
}

}  // namespace vesiflow::run
