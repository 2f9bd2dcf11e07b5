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

// What may stand in a page of that size beside what always does.
std::size_t bytes_for_data(const ReportOptions& options, std::size_t always) {
  return options.bytes > always + least_bytes / 2 ? options.bytes - always : least_bytes / 2;
}

std::size_t vesicles_of(const StoredRun& run) {
  const auto found = run.summary.find("vesicles");
  return found != run.summary.end() && found->is_array() ? std::max<std::size_t>(1, found->size()) : 1;
}

ReportContents contents_of(StoredRun run, const ReportOptions& options, std::size_t bytes) {
  // Text of base64 is a third longer than the bytes.
  const auto binary = [](std::size_t text) { return text / 4 * 3; };
  ReportContents contents{.run = std::move(run), .diagnostics = {}, .course = {}, .membranes = {}, .fluid = {}};
  contents.diagnostics = diagnostics_rows(contents.run.diagnostics, bytes / share_of_rows);
  contents.fluid = read_fluid_planes(contents.run, binary(bytes / share_of_fluid));
  std::size_t used = contents.diagnostics.text.size();
  for (const FluidPlanes::Plane& plane : contents.fluid.planes) used += base64_size(plane.bytes.size());
  const std::size_t left = binary(bytes > used ? bytes - used : 0);
  const std::size_t fit = left / (least_bytes_of_vesicle * vesicles_of(contents.run));
  contents.course =
      read_membranes(contents.run, std::clamp<std::size_t>(fit, 1, static_cast<std::size_t>(options.most_frames)));
  contents.membranes = pack_membranes(contents.course, left);
  return contents;
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

std::string sections(const ReportContents& contents, bool has_viewer) {
  return heading(contents.run) + "<main>" + view_section(contents) + results_section(contents.run) +
         trust_section(contents.run) + phases_section(contents.run) + scene_section(contents.run) +
         repeat_section(contents.run) + about_section(contents, has_viewer) + "</main>\n";
}

std::string page(const ReportContents& contents, const ReportOptions& options) {
  const std::string viewer = embedded_viewer();
  const std::string name = contents.run.folder.filename().string();
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" "
      "content=\"{}\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta "
      "name=\"generator\" "
      "content=\"Vesiflow {}\">\n<title>{} – Vesiflow report</title>\n<style>{}</style></head>\n<body>\n",
      policy(options.live, viewer.empty() ? "" : embedded_viewer_sha256()), VESIFLOW_VERSION, escaped(name),
      embedded_style());
  text += sections(contents, !viewer.empty());
  if (!viewer.empty()) {
    const std::string json =
        page_data(contents, options.live).dump(-1, ' ', /*ensure_ascii=*/true, Json::error_handler_t::replace);
    text += "<script type=\"application/json\" id=\"report-data\">" + json_in_html(json) + "</script>\n<script>" +
            viewer + "</script>\n";
  }
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
  StoredRun run = read_stored_run(keeps_the_name_given ? directory : whole);
  // The scene and the tables stand in the page twice, for readers and for the viewer.
  const std::size_t always = embedded_viewer().size() + embedded_style().size() +
                             2 * (run.scene.size() + run.plan.size()) + 3 * run.summary.dump().size() + 60'000;
  return page(contents_of(std::move(run), options, bytes_for_data(options, always)), options);
}

void write_report(const std::filesystem::path& directory, const std::filesystem::path& file,
                  const ReportOptions& options) {
  write_text_atomically(file, report_of(directory, options));
}

}  // namespace vesiflow::run
