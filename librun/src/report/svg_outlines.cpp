// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "report/svg_plots.h"
#include "vesicle/spherical_harmonics.h"

namespace vesiflow::run {
namespace {

// Of the meshes that are cut, where vesicles are few and large on the page, and where they are many.
constexpr int fine_latitudes = 32, coarse_latitudes = 16;
constexpr std::size_t few_vesicles = 8;
constexpr std::size_t most_outlines = 128;

struct Point {
  double x = 0.0, z = 0.0;
};
using Outline = std::vector<Point>;

// The cut of a closed mesh by the plane of constant y through its middle, as closed lines. Each cell is two triangles; a triangle that is
// cut joins two of its edges, and each edge is one of two triangles.
class Cutter {
 public:
  Cutter(const Eigen::ArrayXXd& points, int latitudes) : points_(points), longitudes_(2 * latitudes) {
    const int longitudes = longitudes_;
    y_ = points.col(1).mean() + 1e-9;  // not through markers
    for (int i = 0; i < longitudes; ++i) {
      const int e = (i + 1) % longitudes;
      for (int j = 0; j + 1 < latitudes; ++j) {
        cut({at(j, i), at(j + 1, i), at(j + 1, e)});
        cut({at(j, i), at(j + 1, e), at(j, e)});
      }
      // The caps at the poles, as fans from their first markers.
      cut({at(0, 0), at(0, i), at(0, e)});
      cut({at(latitudes - 1, 0), at(latitudes - 1, e), at(latitudes - 1, i)});
    }
  }

  std::vector<Outline> outlines() {
    std::vector<Outline> all;
    while (!next_.empty()) {
      Outline outline;
      for (Edge edge = next_.begin()->first;;) {
        const auto here = next_.find(edge);
        if (here == next_.end() || here->second.empty()) break;
        const Edge other = here->second.back();
        outline.push_back(crossing(edge));
        remove(edge, other);
        edge = other;
      }
      if (outline.size() > 2) all.push_back(std::move(outline));
    }
    return all;
  }

 private:
  using Edge = std::pair<int, int>;

  int at(int j, int i) const { return j * longitudes_ + i; }
  static Edge edge_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

  void cut(const std::array<int, 3>& corners) {
    std::vector<Edge> cuts;
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = corners[k], b = corners[(k + 1) % 3];
      if (a != b && (points_(a, 1) < y_) != (points_(b, 1) < y_)) cuts.push_back(edge_of(a, b));
    }
    if (cuts.size() != 2 || cuts[0] == cuts[1]) return;
    next_[cuts[0]].push_back(cuts[1]);
    next_[cuts[1]].push_back(cuts[0]);
  }

  void remove(const Edge& a, const Edge& b) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      std::vector<Edge>& list = next_[from];
      if (const auto found = std::ranges::find(list, to); found != list.end()) list.erase(found);
      if (list.empty()) next_.erase(from);
    }
  }

  Point crossing(const Edge& edge) const {
    const double a = points_(edge.first, 1) - y_, b = points_(edge.second, 1) - y_, share = a / (a - b);
    const auto mix = [&](int c) { return (1.0 - share) * points_(edge.first, c) + share * points_(edge.second, c); };
    return {.x = mix(0), .z = mix(2)};
  }

  const Eigen::ArrayXXd& points_;
  int longitudes_;
  double y_ = 0.0;
  std::map<Edge, std::vector<Edge>> next_;
};

std::vector<Outline> outlines_of(const MembraneCourse::Frame& frame) {
  const int latitudes = frame.vesicles.size() <= few_vesicles ? fine_latitudes : coarse_latitudes;
  const vesicle::SphereGrid grid(latitudes);
  std::vector<Outline> all;
  for (std::size_t v = 0; v < std::min(frame.vesicles.size(), most_outlines); ++v) {
    const vesicle::Coefficients coefficients = complex_coefficients(frame.vesicles[v].leftCols(3));
    const vesicle::SphericalHarmonics harmonics(coefficients.degrees(), grid);
    Eigen::ArrayXXd points(grid.size(), 3);
    harmonics.synthesis(coefficients, points);
    for (Outline& outline : Cutter(points, latitudes).outlines()) all.push_back(std::move(outline));
  }
  return all;
}

}  // namespace

std::string svg_outlines(const MembraneCourse& course) {
  if (course.frames.empty()) return "";
  const std::set<std::size_t> chosen = {0, course.frames.size() / 2, course.frames.size() - 1};
  std::vector<std::vector<Outline>> panels;
  Point low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  for (const std::size_t f : chosen) {
    panels.push_back(outlines_of(course.frames[f]));
    for (const Outline& outline : panels.back())
      for (const Point& p : outline) {
        low = {std::min(low.x, p.x), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.z, p.z)};
      }
  }
  if (!(high.x > low.x) || !(high.z > low.z)) return "";
  const double scale = 260.0 / std::max(high.x - low.x, high.z - low.z), margin = 12.0;
  const double width = scale * (high.x - low.x) + 2.0 * margin, height = scale * (high.z - low.z) + 2.0 * margin;
  std::string text;
  std::size_t panel = 0;
  for (const std::size_t f : chosen) {
    const double time = course.frames[f].time;
    text += fmt::format(
        "<figure><svg class=\"outline\" viewBox=\"0 0 {:.1f} {:.1f}\" width=\"{:.0f}\" role=\"img\" aria-label=\"cuts "
        "through the "
        "membranes at time {:.4g}\">",
        width, height, width, time);
    for (const Outline& outline : panels[panel++]) {
      text += "<path class=\"membrane\" d=\"M";
      for (const Point& p : outline)
        text += fmt::format("{:.1f} {:.1f} ", margin + scale * (p.x - low.x), height - margin - scale * (p.z - low.z));
      text += "Z\"/>";
    }
    text += fmt::format("</svg><figcaption>t = {:.4g}</figcaption></figure>\n", time);
  }
  return text;
}

}  // namespace vesiflow::run
