// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "run/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "files/atomic_file.h"
#include "report/base64.h"
#include "report/embedded.h"
#include "report/escaped_text.h"
#include "report/page_data.h"
#include "report/page_sections.h"
#include "report/svg_plots.h"
#include "vesiflow/version.h"

namespace vesiflow::run {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t least_bytes = 100'000;
// Of what a page has room for beside the viewer: the rest is for the membranes.
constexpr std::size_t share_of_rows = 5, share_of_fluid = 5;  // a fifth each
constexpr std::size_t least_bytes_of_vesicle = 400;           // in a frame, before any are read

void check(const ReportOptions& options) {
  if (options.most_frames < 1)
    throw std::invalid_argument(fmt::format("ReportOptions::most_frames = {}: must be >= 1", options.most_frames));
  if (options.bytes < least_bytes)
    throw std::invalid_argument(fmt::format("ReportOptions::bytes = {}: must be >= {}", options.bytes, least_bytes));
}

std::size_t vesicles_of(const StoredRun& run) {
  const auto found = run.summary.find("vesicles");
  return found != run.summary.end() && found->is_array() ? std::max<std::size_t>(1, found->size()) : 1;
}

// Text of base64 is a third longer than the bytes.
std::size_t binary(std::size_t text) {
  return text / 4 * 3;
}

// All but the membranes' bytes, which take what is left.
ReportContents contents_of(StoredRun run, const ReportOptions& options, std::size_t bytes) {
  ReportContents contents{.run = std::move(run), .diagnostics = {}, .course = {}, .membranes = {}, .fluid = {}};
  contents.diagnostics = diagnostics_rows(contents.run.diagnostics, bytes / share_of_rows);
  contents.fluid = read_fluid_planes(contents.run, binary(bytes / share_of_fluid));
  const std::size_t fit = binary(bytes) / (least_bytes_of_vesicle * vesicles_of(contents.run));
  contents.course =
      read_membranes(contents.run, std::clamp<std::size_t>(fit, 1, static_cast<std::size_t>(options.most_frames)));
  return contents;
}

// What the packing itself takes beside its bytes: a time and a step of each frame, the widths of each field of each vesicle.
std::size_t bytes_of_description(const MembraneCourse& course) {
  constexpr std::size_t of_frame = 40, of_vesicle = 500, others = 4000;
  return of_frame * course.frames.size() + of_vesicle * course.latitudes.size() + others;
}

// A page does nothing but run this one script, and asks nobody for anything; a live one asks its own server.
std::string policy(bool live, const std::string& viewer_sha256) {
  std::string script = "'none'";
  if (!viewer_sha256.empty()) {
    std::vector<std::uint8_t> digest;
    for (std::size_t i = 0; i + 1 < viewer_sha256.size(); i += 2) {
      std::uint8_t byte = 0;
      std::from_chars(viewer_sha256.data() + i, viewer_sha256.data() + i + 2, byte, 16);
      digest.push_back(byte);
    }
    script = fmt::format("'sha256-{}'", base64(digest));
  }
  return fmt::format(
      "default-src 'none'; script-src {}; style-src 'unsafe-inline'; img-src data: blob:; connect-src {}; base-uri "
      "'none'; "
      "form-action 'none'",
      script, live ? "'self'" : "'none'");
}

std::string view_section(const ReportContents& contents) {
  const std::string outlines = svg_outlines(contents.course), plots = svg_plots(contents.diagnostics);
  std::string text =
      "<section id=\"view\" aria-labelledby=\"view-title\"><h2 id=\"view-title\">Membranes</h2>\n<div "
      "id=\"viewer\"></div>\n";
  text += "<div id=\"outlines\" class=\"figures\">";
  text +=
      outlines.empty()
          ? "<p>There are no snapshots of the membranes to draw.</p>"
          : "<p class=\"note\">Cuts through the membranes, each by the plane of constant y through its middle; x to "
            "the right, z upwards.</p>\n" +
                outlines;
  text +=
      "</div></section>\n<section id=\"plots\" aria-labelledby=\"plots-title\"><h2 id=\"plots-title\">Numbers against "
      "time</h2>\n<div "
      "id=\"charts\"></div>\n<div id=\"static-plots\" class=\"figures\">";
  text += plots.empty() ? "<p>There are no numbers against time to draw.</p>" : plots;
  return text + "</div></section>\n";
}

std::string data_of(const ReportContents& contents, bool live) {
  return json_in_html(page_data(contents, live).dump(-1, ' ', /*ensure_ascii=*/true, Json::error_handler_t::replace));
}

std::string page(StoredRun run, const ReportOptions& options) {
  const std::string viewer = embedded_viewer(), style = embedded_style();
  const std::size_t always = viewer.size() + style.size();
  const auto left_of = [&](std::size_t used) {
    return options.bytes > used + least_bytes / 4 ? options.bytes - used : least_bytes / 4;
  };
  ReportContents contents = contents_of(std::move(run), options, left_of(always));
  const StoredRun& stored = contents.run;
  const std::string name = stored.folder.filename().string();
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" "
      "content=\"{}\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta "
      "name=\"generator\" "
      "content=\"Vesiflow {}\">\n<title>{} \u2013 Vesiflow report</title>\n<style>{}</style></head>\n<body>\n",
      policy(options.live, viewer.empty() ? "" : embedded_viewer_sha256()), VESIFLOW_VERSION, escaped(name), style);
  text += heading(stored) + "<main>" + view_section(contents) + results_section(stored) + trust_section(stored) +
          phases_section(stored) + scene_section(stored) + repeat_section(stored);
  if (!viewer.empty()) {
    const std::size_t others = data_of(contents, options.live).size() + bytes_of_description(contents.course);
    contents.membranes = pack_membranes(contents.course, binary(left_of(text.size() + viewer.size() + others)));
  }
  text += about_section(contents, !viewer.empty()) + "</main>\n";
  if (!viewer.empty())
    text += "<script type=\"application/json\" id=\"report-data\">" + data_of(contents, options.live) +
            "</script>\n<script>" + viewer + "</script>\n";
  return text + "</body></html>\n";
}

}  // namespace

bool report_has_viewer() {
  return !embedded_viewer().empty();
}

std::string report_of(const std::filesystem::path& directory, const ReportOptions& options) {
  check(options);
  // Of a folder given as "." or "out/" too, the name.
  std::error_code keeps_the_name_given;
  const std::filesystem::path whole = std::filesystem::canonical(directory, keeps_the_name_given);
  return page(read_stored_run(keeps_the_name_given ? directory : whole), options);
}

void write_report(const std::filesystem::path& directory, const std::filesystem::path& file,
                  const ReportOptions& options) {
  write_text_atomically(file, report_of(directory, options));
}

}  // namespace vesiflow::run
