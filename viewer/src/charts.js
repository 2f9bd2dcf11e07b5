// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// Plots of every column of diagnostics.csv against time, linked to the frame that is shown.
import uPlot from "uplot";
import chartStyle from "uplot/dist/uPlot.min.css";
import { figures, make } from "./elements.js";

const mostLines = 8;
const height = 168;
const roundOff = 1e-10;

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// Lines of a column: one for each vesicle or, of many, the least, the mean and the greatest.
function linesOf(rows, name) {
  const columns = rows.vesicles.map((vesicle) => vesicle[name]);
  if (columns.length <= mostLines)
    return columns.map((values, v) => ({ label: columns.length === 1 ? "" : `vesicle ${v}`, values, stroke: `--c${v}`, width: 1.6 }));
  const count = Math.min(...columns.map((column) => column.length));
  const over = (reduce) =>
    Array.from({ length: count }, (_, k) => {
      const values = columns.map((column) => column[k]).filter((value) => value !== null);
      return values.length > 0 ? reduce(values) : null;
    });
  return [
    { label: "mean", values: over((v) => v.reduce((a, b) => a + b) / v.length), stroke: "--c0", width: 2 },
    { label: "least", values: over((v) => v.reduce((a, b) => Math.min(a, b))), stroke: "--c5", width: 1 },
    { label: "greatest", values: over((v) => v.reduce((a, b) => Math.max(a, b))), stroke: "--c1", width: 1 },
  ];
}

// Where all values are the same but for round-off, that is not drawn as if it were a course of things.
function range(_, low, high) {
  if (low === null || high === null) return [0, 1];
  const largest = Math.max(Math.abs(low), Math.abs(high));
  const span = high - low;
  if (largest < roundOff) return [-roundOff, roundOff];
  if (span <= 1e-9 * largest) return [low - 0.05 * largest - 1e-12, high + 0.05 * largest + 1e-12];
  return [low - 0.06 * span, high + 0.06 * span];
}

class Chart {
  constructor(charts, name, { label, unit }) {
    this.charts = charts;
    this.lines = linesOf(charts.data.rows, name);
    this.value = make("output");
    this.place = make("div");
    this.element = make("div", { class: "chart", "data-name": name }, make("h3", {}, `${label} `, ...(unit ? [make("small", {}, unit)] : []), this.value), this.place);
  }

  draw() {
    const { data, clock, sync } = this.charts;
    const axis = { stroke: colour("--soft"), grid: { stroke: colour("--line"), width: 0.7 }, ticks: { stroke: colour("--line"), width: 0.7 }, font: "11px system-ui, sans-serif" };
    const times = data.rows.vesicles[0].time;
    const short = (_, values) => values.map((value) => (value === null ? "" : figures(value, 3)));
    this.plot?.destroy();
    this.plot = new uPlot(
      {
        width: this.place.clientWidth || 320,
        height,
        legend: { show: false },
        cursor: { sync: { key: sync.key }, y: false, drag: { x: false, y: false }, points: { size: 5 } },
        scales: { x: { time: false }, y: { range } },
        axes: [{ ...axis, size: 26, values: short }, { ...axis, size: 58, values: short }],
        series: [{}, ...this.lines.map(({ label, stroke, width }) => ({ label, stroke: colour(stroke), width, points: { show: times.length < 3 }, spanGaps: false }))],
        hooks: { draw: [(plot) => this.mark(plot)] },
      },
      [times, ...this.lines.map((line) => line.values.slice(0, times.length))],
      this.place,
    );
    this.plot.over.addEventListener("click", (event) => clock.showTime(this.plot.posToVal(event.offsetX, "x")));
    this.follow();
  }

  // The time of the frame that is shown.
  mark(plot) {
    const x = Math.round(plot.valToPos(this.charts.time, "x", true));
    const { ctx, bbox } = plot;
    if (x < bbox.left - 1 || x > bbox.left + bbox.width + 1) return;
    ctx.save();
    ctx.strokeStyle = colour("--accent");
    ctx.lineWidth = 2;
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.restore();
  }

  follow() {
    const values = this.lines[0].values;
    this.value.textContent = this.lines.length === 1 || this.lines[0].label === "mean" ? figures(values[this.charts.row]) : "";
    this.plot?.redraw(false, false);
  }
}

export class Charts {
  constructor(root, data, clock) {
    this.root = root;
    this.data = data;
    this.clock = clock;
    this.sync = uPlot.sync("time");
    document.head.append(make("style", {}, chartStyle));
    this.groups = [...new Set(Object.values(data.quantities).map(({ group }) => group))];
    this.group = this.groups[0];
    this.build();
    clock.onChange(() => this.follow());
    globalThis.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    let width = root.clientWidth;
    new ResizeObserver(() => {
      if (root.clientWidth === width) return;
      width = root.clientWidth;
      this.draw();
    }).observe(root);
  }

  get time() {
    return this.clock.time;
  }

  setData(data) {
    this.data = data;
    this.build();
  }

  build() {
    const button = (group) =>
      make("button", { type: "button", "aria-pressed": String(group === this.group), onclick: () => this.choose(group) }, group);
    this.buttons = [...this.groups, "all"].map(button);
    this.grid = make("div", { class: "charts" });
    this.root.replaceChildren(make("div", { class: "controls", role: "group", "aria-label": "which numbers" }, ...this.buttons), this.legend(), this.grid);
    this.choose(this.group);
  }

  legend() {
    const names = linesOf(this.data.rows, "time").filter(({ label }) => label);
    return make("p", { class: "legend" }, ...names.map(({ label, stroke }) => {
      const mark = make("i");
      mark.style.background = `var(${stroke})`;
      return make("span", {}, mark, label);
    }), make("span", {}, "time to the right, in units of 1/shear rate; choose a point to see its frame"));
  }

  choose(group) {
    this.group = group;
    for (const button of this.buttons) button.setAttribute("aria-pressed", String(button.textContent === group));
    const shown = Object.entries(this.data.quantities).filter(([, quantity]) => group === "all" || quantity.group === group);
    this.charts = shown.map(([name, quantity]) => new Chart(this, name, quantity));
    this.grid.replaceChildren(...this.charts.map((chart) => chart.element));
    this.draw();
  }

  draw() {
    this.follow();
    for (const chart of this.charts) chart.draw();
  }

  // The row whose time is nearest to that of the frame.
  follow() {
    const times = this.data.rows.vesicles[0].time;
    this.row = 0;
    times.forEach((time, k) => {
      if (Math.abs(time - this.time) < Math.abs(times[this.row] - this.time)) this.row = k;
    });
    for (const chart of this.charts ?? []) chart.follow();
  }
}
