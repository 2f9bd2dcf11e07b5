// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

// Scene files, with overrides in lines "--set key=value": each is refused by a SceneError that says why, or makes a
// scene that can be written, read back as the same scene, and planned.

#include <algorithm>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "check.h"
#include "one_thread.h"
#include "run/errors.h"
#include "run/plan.h"
#include "scene/scene_file.h"

namespace vesiflow::fuzz {
namespace {

using namespace run;

/// Stands in for reading the files of shapes: an input must not name files of the machine it runs on, and no scene shall take
/// longer to check than the next input is worth.
void refuse_files_and_costly(Scene& scene) {
  constexpr int most_markers = 2000;
  int markers = 0;
  for (std::size_t i = 0; i < scene.vesicles.size() && markers <= most_markers; ++i) {
    markers += 2 * scene.latitudes(i) * scene.latitudes(i);
    if (scene.surface_file(i).file) throw SceneError("a scene of this fuzz target reads no files");
  }
  if (markers > most_markers) throw SceneError("a scene of this fuzz target has at most 2000 markers");
}

struct Input {
  std::string text;
  Overrides overrides;
};

Input split(const std::string& whole) {
  constexpr std::string_view set = "--set ";
  Input input;
  std::istringstream lines(whole);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(set))
      input.overrides.push_back(line.substr(set.size()));
    else
      input.text += line + "\n";
  return input;
}

Scene parse(const std::string& text, const Overrides& overrides = {}) {
  return parse_scene(text, "scene.toml", overrides, refuse_files_and_costly);
}

void read(const Input& input) {
  Scene scene;
  try {
    scene = parse(input.text, input.overrides);
  } catch (const SceneError& error) {
    check(std::string_view(error.what()).size() > 10, "a refusal says why");
    return;
  }
  const std::string text = to_toml(scene);
  try {
    check(to_toml(parse(text)) == text, "a scene that is written reads back as the same scene");
  } catch (const SceneError& error) {
    check(false, error.what());
  }
  check(!describe_plan(scene, 2).empty(), "a scene that was read can be planned");
}

/// Keys with a list of words take one of them, others an awkward number.
std::string random_override(std::minstd_rand& random) {
  static const std::vector<SceneKey> keys = scene_keys();
  static const std::vector<std::string> numbers{"0",
                                                "-1",
                                                "1",
                                                "3",
                                                "8",
                                                "0.5",
                                                "1e-3",
                                                "1e-308",
                                                "1e308",
                                                "-1e308",
                                                "1e19",
                                                "2048",
                                                "1e155",
                                                "1e-155",
                                                "1000000.0",
                                                "[0,0,0]",
                                                "[1,1e9,1]",
                                                "\"1/96\"",
                                                "[[2,0,0.1]]",
                                                "true",
                                                "nan",
                                                "[8,8,8]",
                                                "[true,false,true]",
                                                "[false,false,true]",
                                                "[1e300,0,0]",
                                                "[1,1,1]",
                                                "\"x\\u0001\""};
  const auto pick = [&random](const auto& list) { return list[random() % list.size()]; };
  SceneKey key = pick(keys);
  if (constexpr std::string_view of_vesicle = "vesicles."; key.name.starts_with(of_vesicle))
    key.name.insert(of_vesicle.size(), random() % 4 == 0 ? "1." : "0.");
  std::string value = pick(numbers);
  const bool is_choice = key.default_value.starts_with('"') && key.allowed.find(',') != std::string::npos;
  if (is_choice && random() % 8 != 0) {
    std::vector<std::string> words;
    std::istringstream list(key.allowed);
    for (std::string word; std::getline(list >> std::ws, word, ',');) words.push_back(word);
    value = '"' + pick(words) + '"';
  }
  return "\n--set " + key.name + "=" + value + "\n";
}

}  // namespace
}  // namespace vesiflow::fuzz

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t largest);

/// Half of the time adds an override of some key, by the library's own list of them.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t largest,
                                               unsigned seed) {
  using namespace vesiflow::fuzz;
  std::minstd_rand random(seed);
  if (random() % 2 == 0) return LLVMFuzzerMutate(data, size, largest);
  const std::string added = random_override(random);
  if (size + added.size() > largest) return LLVMFuzzerMutate(data, size, largest);
  std::copy(added.begin(), added.end(), data + size);
  return size + added.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  vesiflow::fuzz::read(vesiflow::fuzz::split({reinterpret_cast<const char*>(data), size}));
  return 0;
}
