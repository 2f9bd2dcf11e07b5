// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "report/svg_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "report/escaped_text.h"
#include "report/quantities.h"
#include "report/thinning.h"

namespace vesiflow::run {
namespace {

constexpr double width = 340.0, height = 170.0, left = 58.0, right = 12.0, top = 26.0, bottom = 30.0;
constexpr std::size_t most_vesicles = 8, most_points = 200;
constexpr double round_off = 1e-10;

// The eight colours of Okabe & Ito (2008), which readers of any colour vision tell apart; the CSS class has the colour.
std::string line_class(std::size_t vesicle) {
  return fmt::format("line c{}", vesicle % most_vesicles);
}

struct Range {
  double low = INFINITY, high = -INFINITY;
  void take(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// Steps of 1, 2 or 5 times a power of ten, about four in the range.
double tick_step(double span) {
  const double power = std::pow(10.0, std::floor(std::log10(span / 4.0)));
  const double rest = span / 4.0 / power;
  return power * (rest < 1.5 ? 1.0 : rest < 3.5 ? 2.0 : rest < 7.5 ? 5.0 : 10.0);
}

// A plot of one column: its frame, ticks and a line for each vesicle.
class Plot {
 public:
  Plot(const DiagnosticsRows& rows, const Quantity& quantity) : quantity_(quantity) {
    const std::vector<double>&time = *rows.column("time"), &vesicle = *rows.column("vesicle"),
          &value = *rows.column(std::string(quantity.name));
    for (std::size_t k = 0; k < value.size(); ++k)
      if (std::isfinite(value[k]) && vesicle[k] >= 0.0 && vesicle[k] < static_cast<double>(most_vesicles)) {
        lines_[static_cast<std::size_t>(vesicle[k])].emplace_back(time[k], value[k]);
        times_.take(time[k]);
        values_.take(value[k]);
      }
    largest_ = values_;
    // What changes by round-off only is drawn as a level.
    const double least = std::max(1e-9 * std::max(std::abs(values_.low), std::abs(values_.high)), 1e-300);
    if (values_.high - values_.low < least) {
      const double margin = std::max(0.05 * std::abs(values_.high), 1e-12);
      values_ = {values_.low - margin, values_.high + margin};
    }
    if (!(times_.high > times_.low)) times_ = {times_.low - 0.5, times_.low + 0.5};
  }

  // Whether there is nothing to see: no values, or nothing but round-off.
  bool empty() const { return lines_.empty() || std::max(std::abs(largest_.low), std::abs(largest_.high)) < round_off; }

  std::string svg() const {
    const std::string title =
        quantity_.unit.empty() ? std::string(quantity_.label) : fmt::format("{} ({})", quantity_.label, quantity_.unit);
    std::string text = fmt::format(
        "<svg class=\"plot\" viewBox=\"0 0 {:g} {:g}\" role=\"img\" aria-label=\"{} against time\"><text x=\"{:g}\" "
        "y=\"15\" "
        "class=\"title\">{}</text>",
        width, height, escaped(title), left, escaped(title));
    text += ticks() + fmt::format("<rect class=\"frame\" x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\"/>", left,
                                  top, width - left - right, height - top - bottom);
    for (const auto& [vesicle, points] : lines_) {
      text += fmt::format("<polyline class=\"{}\" points=\"", line_class(vesicle));
      for (const std::size_t k : evenly_chosen(points.size(), most_points))
        text += fmt::format("{:.1f},{:.1f} ", x(points[k].first), y(points[k].second));
      text += "\"/>";
    }
    return text + "</svg>\n";
  }

 private:
  double x(double t) const { return left + (t - times_.low) / (times_.high - times_.low) * (width - left - right); }
  double y(double v) const {
    return height - bottom - (v - values_.low) / (values_.high - values_.low) * (height - top - bottom);
  }
  std::string ticks() const {
    std::string text;
    double step = tick_step(times_.high - times_.low);
    for (double t = std::ceil(times_.low / step) * step; t <= times_.high + 1e-9 * step; t += step)
      text += fmt::format("<text x=\"{:.1f}\" y=\"{:g}\" class=\"tick middle\">{:.4g}</text>", x(t),
                          height - bottom + 14.0, std::abs(t) < 1e-9 * step ? 0.0 : t);
    step = tick_step(values_.high - values_.low);
    for (double v = std::ceil(values_.low / step) * step; v <= values_.high + 1e-9 * step; v += step)
      text += fmt::format(
          "<path class=\"grid\" d=\"M{:g} {:.1f}H{:g}\"/><text x=\"{:g}\" y=\"{:.1f}\" class=\"tick "
          "end\">{:.4g}</text>",
          left, y(v), width - right, left - 5.0, y(v) + 3.5, std::abs(v) < 1e-9 * step ? 0.0 : v);
    return text +
           fmt::format("<text x=\"{:g}\" y=\"{:g}\" class=\"tick end\">time</text>", width - right, height - 3.0);
  }

  Quantity quantity_;
  std::map<std::size_t, std::vector<std::pair<double, double>>> lines_;
  Range times_, values_, largest_;
};

}  // namespace

std::string svg_plots(const DiagnosticsRows& rows) {
  constexpr std::array shown = {
      "inclination_angle_deg", "tank_treading_frequency", "centroid_x",  "centroid_z", "min_distance",
      "deformation",           "bending_energy",          "tension_max", "area_error", "volume_error",
      "max_local_area_error",  "unresolved_bending"};
  if (rows.column("time") == nullptr || rows.column("vesicle") == nullptr) return "";
  std::string text;
  for (const char* name : shown) {
    if (rows.column(name) == nullptr) continue;
    const Plot plot(rows, quantity_of(vesicle_quantities(), name));
    if (!plot.empty()) text += plot.svg();
  }
  return text;
}

}  // namespace vesiflow::run
