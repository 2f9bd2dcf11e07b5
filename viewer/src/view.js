// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// The view of the membranes: what is in the scene, and what the reader chooses of it.
import { scaleOf, drawTable } from "./colours.js";
import { save } from "./downloads.js";
import { choice, figures, make, tick } from "./elements.js";
import { MembraneMeshes } from "./membranes.js";
import { quantities, Slice } from "./slice.js";
import { Stage, views } from "./stage.js";
import { boxOf, wholeBox } from "./surroundings.js";

const hasBox = (box) => Array.isArray(box?.lower) && Array.isArray(box?.upper);

export class View {
  /** Throws where the browser has no WebGL. */
  constructor(root, data, clock) {
    this.clock = clock;
    this.choices = { field: "tension", lines: false, box: true, plane: 0, fluid: "none", streamlines: false };
    this.clockText = make("div", { class: "clock", "aria-live": "off" });
    this.scales = [this.scaleBox(), this.scaleBox()];
    this.element = make("div", { class: "stage", role: "img", tabindex: "0" }, this.clockText, ...this.scales.map((scale) => scale.box));
    root.replaceChildren(this.element);
    this.stage = new Stage(this.element);
    this.setData(data);
    root.append(this.timeControls(), this.choicesControls(), this.help());
    clock.onChange(() => this.follow());
    this.stage.dark.addEventListener("change", () => this.addBox());
    this.fit();
    this.follow();
  }

  setData(data) {
    this.data = data;
    if (this.meshes) {
      this.stage.scene.remove(this.meshes.group, this.slice.group);
      this.meshes.dispose();
    }
    const box = hasBox(data.box) ? data.box : null;
    this.box = box;
    this.meshes = new MembraneMeshes(data.membranes, box);
    this.slice = new Slice(data.fluid, box);
    this.stage.scene.add(this.meshes.group, this.slice.group);
    this.addBox();
    this.choices.plane = Math.min(this.choices.plane, Math.max(0, data.fluid.planes.length - 1));
    this.meshes.drawLines(this.choices.lines);
    this.shownFrame = -1;
  }

  addBox() {
    if (this.boxGroup) this.stage.scene.remove(this.boxGroup);
    this.boxGroup = null;
    if (this.box) {
      this.boxGroup = boxOf(this.box, this.stage.isDark);
      this.boxGroup.visible = this.choices.box;
      this.stage.scene.add(this.boxGroup);
    }
    this.stage.draw();
  }

  scaleBox() {
    const parts = { title: make("div"), map: make("canvas", { "aria-hidden": "true" }), low: make("span"), high: make("span") };
    parts.box = make("div", { class: "scale" }, parts.title, parts.map, make("div", { class: "ends" }, parts.low, parts.high));
    return parts;
  }

  showScale(parts, title, scale) {
    parts.box.hidden = !scale;
    if (!scale) return;
    parts.title.textContent = title;
    parts.low.textContent = figures(scale.low, 3);
    parts.high.textContent = figures(scale.high, 3);
    drawTable(parts.map, scale.map);
  }

  get field() {
    return this.data.membranes.field(this.choices.field);
  }
  get scale() {
    return scaleOf(this.field.low, this.field.high);
  }

  /** Brings the scene to the frame of the clock. */
  follow() {
    const { frame, time } = this.clock;
    if (frame !== this.shownFrame) {
      this.shownFrame = frame;
      this.meshes.show(frame, this.field, this.scale);
      this.showFluid();
    }
    this.updateTexts(frame, time);
    this.stage.draw();
  }

  updateTexts(frame, time) {
    this.clockText.textContent = `t = ${figures(time)}`;
    this.showScale(this.scales[0], `${this.field.label} (${this.field.unit})`, this.scale);
    if (this.scrubber) {
      this.scrubber.max = String(this.clock.last);
      this.scrubber.value = String(frame);
      this.scrubber.setAttribute("aria-valuetext", `time ${figures(time)}, frame ${frame + 1} of ${this.clock.last + 1}`);
      this.playButton.textContent = this.clock.isPlaying ? "Pause" : "Play";
      this.timeText.textContent = `${frame + 1}/${this.clock.last + 1}`;
    }
    this.element.setAttribute(
      "aria-label",
      `${this.data.membranes.count} membrane${this.data.membranes.count === 1 ? "" : "s"} at time ${figures(time)}, coloured by ${this.field.label} from ${figures(this.scale.low, 3)} to ${figures(this.scale.high, 3)}`,
    );
  }

  showFluid() {
    const { fluid, plane, streamlines } = this.choices;
    this.slice.show(plane, this.clock.time, fluid, streamlines);
    const isShown = fluid !== "none" && this.slice.isThere;
    const at = this.slice.isThere ? figures(this.data.fluid.times[this.slice.snapshotAt(this.clock.time)], 3) : "";
    this.showScale(this.scales[1], isShown ? `${quantities[fluid].label}, t = ${at} (${quantities[fluid].unit})` : "", isShown ? this.slice.scale(this.data.fluid.planes[plane], fluid) : null);
  }

  /** What is chosen changes; `part` is one of `choices`. */
  choose(part, value) {
    this.choices[part] = value;
    const input = this.inputs?.[part];
    if (input) input[input.type === "checkbox" ? "checked" : "value"] = value;
    if (part === "field") this.meshes.recolour(this.field, this.scale);
    if (part === "lines") this.meshes.drawLines(value);
    if (part === "box" && this.boxGroup) this.boxGroup.visible = value;
    if (["plane", "fluid", "streamlines"].includes(part)) this.showFluid();
    this.updateTexts(this.clock.frame, this.clock.time);
    this.stage.draw();
  }

  /** Looks at the vesicles in all frames, or at the box. */
  fit(what = "vesicles", view = "oblique") {
    this.viewName = view;
    const bounds = what === "box" && this.box ? wholeBox(this.box) : this.vesicleBounds();
    this.stage.look(views[view], bounds);
  }

  // Of some frames, the first and the last among them.
  vesicleBounds() {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    const { last } = this.clock;
    const some = Math.min(last, 8);
    for (let k = 0; k <= some; ++k) {
      this.meshes.show(Math.round((k * last) / Math.max(1, some)), this.field, this.scale);
      const bounds = this.meshes.bounds();
      for (let c = 0; c < 3; ++c) {
        low[c] = Math.min(low[c], bounds.low[c]);
        high[c] = Math.max(high[c], bounds.high[c]);
      }
    }
    this.shownFrame = -1;
    this.follow();
    return { low, high };
  }

  timeControls() {
    this.playButton = make("button", { type: "button", class: "main", onclick: () => this.clock.toggle() }, "Play");
    this.scrubber = make("input", { type: "range", min: "0", step: "1", "aria-label": "time", oninput: () => this.clock.show(Number(this.scrubber.value)) });
    this.timeText = make("span", { class: "frame" });
    return make("div", { class: "controls time" }, this.playButton, this.scrubber, this.timeText);
  }

  choicesControls() {
    const { data } = this;
    const fields = data.membranes.fields.filter((field) => field.components === 1).map((field) => [field.name, field.label]);
    const rows = [];
    this.inputs = {};
    const addChoice = (part, label, options, take = (value) => value) => {
      const { row, select } = choice(label, options, (value) => this.choose(part, take(value)));
      this.inputs[part] = select;
      rows.push(row);
    };
    const addTick = (part, label) => {
      const { row, box } = tick(label, this.choices[part], (on) => this.choose(part, on));
      this.inputs[part] = box;
      rows.push(row);
    };
    addChoice("field", "Colour", fields);
    addTick("lines", "Mesh lines");
    if (this.slice.isThere) {
      const shown = [["none", "none"], ...Object.entries(quantities).map(([name, { label }]) => [name, label.split(" ")[0]])];
      addChoice("fluid", "Fluid", shown);
      if (data.fluid.planes.length > 1)
        addChoice("plane", "Plane", data.fluid.planes.map((plane, p) => [p, `${"xyz"[plane.axis]} = ${figures(plane.position, 3)}`]), Number);
      addTick("streamlines", "Streamlines");
    }
    if (this.box) addTick("box", "Box");
    rows.push(choice("View", Object.keys(views).map((name) => [name, name]), (name) => this.fit(this.fitted, name)).row);
    const fitButton = (what, text) => make("button", { type: "button", onclick: () => this.fit((this.fitted = what), this.viewName) }, text);
    rows.push(fitButton("vesicles", "Fit vesicles"));
    if (this.box) rows.push(fitButton("box", "Fit box"));
    rows.push(make("button", { type: "button", onclick: () => this.savePicture() }, "PNG"));
    return make("div", { class: "controls" }, ...rows);
  }

  help() {
    return make("p", { class: "help" }, "Drag to turn, scroll or pinch to zoom, drag with the right button or two fingers to move. Keys: space plays, left and right arrows step, Home and End go to the ends.");
  }

  savePicture() {
    this.stage.render();
    this.stage.canvas.toBlob((blob) => save(blob, `${this.data.name}_t${figures(this.clock.time)}.png`));
  }
}
