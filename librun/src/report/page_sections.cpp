// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report/page_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "files/shell_words.h"
#include "report/escaped_text.h"
#include "report/quantities.h"

namespace vesiflow::run {
namespace {

using Json = StoredRun::Json;

constexpr std::size_t most_columns = 8;  // vesicles that a table shows one by one

std::string section(const char* id, const char* title, const std::string& body) {
  return fmt::format("<section id=\"{0}\" aria-labelledby=\"{0}-title\"><h2 id=\"{0}-title\">{1}</h2>\n{2}</section>\n",
                     id, title, body);
}

std::string number(const Json& value) {
  if (value.is_number_integer()) return value.dump();
  if (value.is_number()) return fmt::format("{:.5g}", value.get<double>());
  if (value.is_null()) return "–";
  return escaped(value.is_string() ? value.get<std::string>() : value.dump());
}

const Json& at(const Json& object, const char* key) {
  static const Json none;
  if (!object.is_object()) return none;
  const auto found = object.find(key);
  return found == object.end() ? none : *found;
}

std::string name_cell(const Quantity& quantity) {
  return fmt::format("<th scope=\"row\">{}{}</th>", escaped(quantity.label),
                     quantity.unit.empty() ? "" : fmt::format(" <small>{}</small>", escaped(quantity.unit)));
}

// A vector of summary.json as the columns that diagnostics.csv has of it.
Json flattened(const Json& vesicle) {
  Json flat = Json::object();
  if (!vesicle.is_object()) return flat;
  for (const auto& [name, value] : vesicle.items()) {
    if (!value.is_array()) {
      flat[name] = value;
      continue;
    }
    for (std::size_t i = 0; i < value.size(); ++i)
      flat[name == "centroid" ? fmt::format("centroid_{}", i < 3 ? "xyz"[i] : '?')
                              : fmt::format("semi_axis_{}", i + 1)] = value[i];
  }
  return flat;
}

std::string range_cells(const std::vector<Json>& vesicles, const std::string& name) {
  double low = INFINITY, high = -INFINITY, sum = 0.0;
  int count = 0;
  for (const Json& vesicle : vesicles)
    if (const Json& value = at(vesicle, name.c_str()); value.is_number()) {
      low = std::min(low, value.get<double>());
      high = std::max(high, value.get<double>());
      sum += value.get<double>();
      ++count;
    }
  if (count == 0) return "<td>–</td><td>–</td><td>–</td>";
  return fmt::format("<td>{:.5g}</td><td>{:.5g}</td><td>{:.5g}</td>", low, sum / count, high);
}

std::string list_of(const Json& sentences) {
  std::string items;
  for (const Json& sentence : sentences)
    if (sentence.is_string()) items += fmt::format("<li>{}</li>\n", escaped(sentence.get<std::string>()));
  return items;
}

// Retries of limits.on_blowup = reduce_step.
std::string retries_of(const Json& retries) {
  std::string items;
  for (const Json& retry : retries)
    items +=
        fmt::format("<li>Step {} at t = {} could not be taken: {}. The run went on from step {} with step {}.</li>\n",
                    number(at(retry, "step")), number(at(retry, "time")), number(at(retry, "cause")),
                    number(at(retry, "from_step")), number(at(retry, "time_step")));
  return items.empty() ? "" : "<h3>Steps that were taken again</h3><ul>" + items + "</ul>\n";
}

std::string phase_label(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

// Which word of the status is good, which bad; the rest is neither.
const char* status_class(const std::string& status) {
  if (status == "completed") return "good";
  if (status == "stopped") return "bad";
  return "open";
}

// From the folder itself, so that the page names no path of the machine that it was made on.
std::string command_to_repeat(const StoredRun& run) {
  const std::string program = run.text("program").empty() ? "vesicles" : run.text("program");
  const std::string name = run.folder.filename().string();
  std::vector<std::string> words = {program, "scene.toml"};
  if (at(run.summary, "started_from").is_object()) words = {program, "--restart", "start.h5"};
  words.insert(words.end(), {"--out", "../" + name + "_again"});
  if (const Json& threads = at(run.summary, "threads"); threads.is_number_integer())
    words.insert(words.end(), {"--threads", threads.dump()});
  return shell_line(std::vector<std::string>{"cd", name}) + "\n" + shell_line(words);
}

}  // namespace

std::string heading(const StoredRun& run) {
  const Json given = run.parameter("title");
  const std::string name = run.folder.filename().string();
  const std::string title = given.is_string() && !given.get<std::string>().empty() ? given.get<std::string>() : name;
  const std::string status = run.text("status").empty() ? "unknown" : run.text("status");
  std::string text = fmt::format("<header><p class=\"kind\">Vesiflow report</p><h1>{}</h1>\n", escaped(title));
  text += fmt::format("<p class=\"facts\"><span class=\"status {}\" id=\"status\">{}</span>", status_class(status),
                      escaped(status));
  if (const double time = run.number("time"); std::isfinite(time))
    text += fmt::format(" <span>t = {:.6g} after {} steps</span>", time, number(at(run.summary, "steps")));
  if (const Json& vesicles = at(run.summary, "vesicles"); vesicles.is_array())
    text += fmt::format(" <span>{} vesicle{}</span>", vesicles.size(), vesicles.size() == 1 ? "" : "s");
  if (const Json cells = run.parameter("domain.cells"); cells.is_array() && cells.size() == 3)
    text += fmt::format(" <span>{} × {} × {} cells</span>", number(cells[0]), number(cells[1]), number(cells[2]));
  if (const double seconds = run.number("wall_seconds"); std::isfinite(seconds))
    text += fmt::format(" <span>{:.3g} s of computing</span>", seconds);
  text += fmt::format(" <span class=\"folder\">{}</span></p>\n", escaped(name));
  if (const std::string reason = run.text("stop_reason"); !reason.empty())
    text += fmt::format(
        "<div class=\"stopped\" role=\"note\"><strong>The run could not go on.</strong><pre>{}</pre></div>\n",
        escaped(reason));
  return text + "</header>\n";
}

std::string results_section(const StoredRun& run) {
  const Json& all = at(run.summary, "vesicles");
  if (!all.is_array() || all.empty())
    return section("results", "What came out", "<p>The folder has no summary of vesicles.</p>\n");
  std::vector<Json> vesicles;
  std::set<std::string> known;
  for (const Json& vesicle : all) vesicles.push_back(flattened(vesicle));
  const bool each = vesicles.size() <= most_columns;
  std::string head = "<th scope=\"col\">number</th>";
  for (std::size_t v = 0; each && v < vesicles.size(); ++v)
    head += vesicles.size() == 1 ? std::string("<th scope=\"col\">value</th>")
                                 : fmt::format("<th scope=\"col\">vesicle {}</th>", v);
  if (!each) head += "<th scope=\"col\">least</th><th scope=\"col\">mean</th><th scope=\"col\">greatest</th>";
  std::string rows;
  const auto row = [&](const Quantity& quantity) {
    const std::string name(quantity.name);
    rows += fmt::format("<tr data-name=\"{}\">{}", escaped(name), name_cell(quantity));
    if (each)
      for (const Json& vesicle : vesicles) rows += fmt::format("<td>{}</td>", number(at(vesicle, name.c_str())));
    else
      rows += range_cells(vesicles, name);
    rows += "</tr>\n";
  };
  for (const Quantity& quantity : vesicle_quantities()) {
    known.emplace(quantity.name);
    if (vesicles.front().contains(quantity.name)) row(quantity);
  }
  for (const auto& [name, value] : vesicles.front().items())
    if (!known.contains(name)) row(quantity_of(vesicle_quantities(), name));
  return section(
      "results", "What came out",
      fmt::format("<p>Numbers at t = {}. Lengths are in effective radii r, times in units of 1/shear rate, stresses in "
                  "viscosity/time.</p>\n<div "
                  "class=\"wide\"><table{}><thead><tr>{}</tr></thead><tbody>{}</tbody></table></div>\n",
                  number(at(run.summary, "time")), vesicles.size() == 1 ? " class=\"single\"" : "", head, rows));
}

std::string trust_section(const StoredRun& run) {
  std::string body;
  const std::string warnings = list_of(at(run.summary, "warnings"));
  if (!warnings.empty())
    body += "<h3>Warnings</h3><ul class=\"warnings\">" + warnings + "</ul>\n";
  else if (at(run.summary, "warnings").is_array())
    body += "<p class=\"no-warnings\">No warnings: no number is beyond what the studies of the method cover.</p>\n";
  body += retries_of(at(run.summary, "retries"));
  if (const Json& error = at(at(run.summary, "scene_numbers"), "grid_error"); error.is_number())
    body += fmt::format(
        "<p>The thickness of the membrane on this grid is estimated to change inclination and frequency of "
        "tank-treading by {:.2g} % (at equal viscosities).</p>\n",
        100.0 * error.get<double>());
  std::string rows;
  const Json& errors = at(run.summary, "largest_errors");
  for (const Quantity& quantity : error_quantities())
    if (errors.is_object() && errors.contains(quantity.name))
      rows +=
          fmt::format("<tr data-name=\"{}\">{}<td>{}</td><td class=\"words\">{}</td></tr>\n", escaped(quantity.name),
                      name_cell(quantity), number(errors[std::string(quantity.name)]), escaped(quantity.group));
  if (!rows.empty())
    body +=
        "<div class=\"wide\"><table><thead><tr><th scope=\"col\">largest over the run</th><th "
        "scope=\"col\">value</th><th "
        "scope=\"col\">what it is</th></tr></thead><tbody>" +
        rows + "</tbody></table></div>\n";
  return section("trust", "How far it can be trusted",
                 body.empty() ? "<p>The folder has no summary of errors.</p>\n" : body);
}

std::string phases_section(const StoredRun& run) {
  std::vector<std::pair<double, std::string>> phases;
  const Json& all = at(run.summary, "phase_seconds");
  if (all.is_object())
    for (const auto& [name, seconds] : all.items())
      if (seconds.is_number() && seconds.get<double>() > 0.0) phases.emplace_back(seconds.get<double>(), name);
  if (phases.empty()) return section("phases", "Where the time went", "<p>The folder has no summary of phases.</p>\n");
  std::ranges::sort(phases, std::greater());
  const double wall = std::max(run.number("wall_seconds"), phases.front().first);
  std::string rows;
  for (const auto& [seconds, name] : phases)
    rows += fmt::format(
        "<tr data-name=\"{}\"><th scope=\"row\">{}</th><td>{:.3g} s</td><td>{:.1f} %</td><td class=\"bar\"><svg "
        "viewBox=\"0 0 100 6\" "
        "preserveAspectRatio=\"none\" aria-hidden=\"true\"><rect width=\"{:.2f}\" height=\"6\"/></svg></td></tr>\n",
        escaped(name), escaped(phase_label(name)), seconds, 100.0 * seconds / wall,
        100.0 * seconds / phases.front().first);
  return section(
      "phases", "Where the time went",
      fmt::format(
          "<p>{:.3g} s with {} threads, {} s a step, since the start or the last restart.</p>\n<div "
          "class=\"wide\"><table><thead><tr><th scope=\"col\">phase</th><th scope=\"col\">time</th><th "
          "scope=\"col\">share</th><th aria-hidden=\"true\"></th></tr></thead><tbody>{}</tbody></table></div>\n",
          run.number("wall_seconds"), number(at(run.summary, "threads")), number(at(run.summary, "seconds_per_step")),
          rows));
}

std::string scene_section(const StoredRun& run) {
  std::string body;
  const auto add = [&](const char* title, const std::string& text) {
    if (!text.empty())
      body += fmt::format("<details><summary>{}</summary><pre class=\"text\" tabindex=\"0\">{}</pre></details>\n",
                          title, escaped(text));
  };
  add("The scene with every key, as it was run", run.scene);
  add("Its plan, as the program that made this page plans it: resolution, what each step computes and skips, and what "
      "it takes",
      run.plan);
  return section("scene", "What was asked", body.empty() ? "<p>The folder has no scene.</p>\n" : body);
}

std::string repeat_section(const StoredRun& run) {
  std::string body = fmt::format("<pre class=\"text\" tabindex=\"0\">{}</pre>\n<dl>", escaped(command_to_repeat(run)));
  const auto fact = [&](const char* name, const std::string& value) {
    if (!value.empty()) body += fmt::format("<dt>{}</dt><dd>{}</dd>", name, escaped(value));
  };
  fact("version", run.text("version"));
  fact("revision", run.text("git_revision"));
  fact("scene file", run.text("scene"));
  if (const Json& start = at(run.summary, "started_from"); start.is_object())
    fact("started from", fmt::format("{} at t = {}", number(at(start, "run")), number(at(start, "time"))));
  return section("repeat", "How to repeat it",
                 body +
                     "</dl>\n<p>The same revision, built for the same processor, gives the same bits for any number of "
                     "threads.</p>\n");
}

std::string about_section(const ReportContents& contents, bool has_viewer) {
  const MembraneCourse& course = contents.course;
  std::string items;
  const auto say = [&](const std::string& sentence) { items += fmt::format("<li>{}</li>\n", sentence); };
  if (!has_viewer)
    say("This page has no view to turn and no plots to point at: the program was built without the viewer. To have it, "
        "run "
        "<code>scripts/install-deps.sh --viewer</code> and <code>scripts/viewer.sh</code>, build again, and write the "
        "page anew "
        "with <code>report FOLDER</code>.");
  if (!contents.membranes.frames.empty()) {
    say(fmt::format("It holds {} of the {} snapshots of the membranes{}.", contents.membranes.frames.size(),
                    course.stored, contents.membranes.frames.size() < course.stored ? ", chosen evenly" : ""));
    say(
        fmt::format("Membranes are stored as coefficients of spherical harmonics, rounded so that positions are off by "
                    "{:.1e} r, and fields "
                    "by {:.1g} % of their range (root mean square).",
                    contents.membranes.error[0],
                    100.0 * contents.membranes.error[2] /
                        std::max({course.ranges[2].typical, contents.membranes.error[2], 1e-300})));
  }
  if (!contents.fluid.times.empty())
    say(fmt::format("It holds {} plane{} of the fluid, in {} of the {} snapshots.", contents.fluid.planes.size(),
                    contents.fluid.planes.size() == 1 ? "" : "s", contents.fluid.times.size(), contents.fluid.stored));
  if (contents.diagnostics.times > 0)
    say(fmt::format("It holds {} of the {} times of diagnostics.csv.", contents.diagnostics.times,
                    contents.diagnostics.stored_times));
  std::string missing;
  for (const auto* list : {&contents.run.missing, &course.missing, &contents.fluid.missing})
    for (const std::string& sentence : *list) missing += fmt::format("<li>{}</li>\n", escaped(sentence));
  if (!missing.empty()) missing = "<h3>What is missing</h3><ul class=\"missing\">" + missing + "</ul>\n";
  return section("about", "About this page", missing + "<ul>" + items + "</ul>\n");
}

}  // namespace vesiflow::run
