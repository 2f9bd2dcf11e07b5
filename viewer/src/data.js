// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// What librun/src/report/page_data.cpp has written into the page.

const format = 1;

export function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** The data of a page; throws if it is of another format. */
export function readData(root) {
  const element = root.getElementById("report-data");
  if (!element) throw new Error("the page has no data");
  const data = JSON.parse(element.textContent);
  if (data.format !== format) throw new Error(`data of format ${data.format}, this viewer reads format ${format}`);
  data.membranes = new Membranes(data.membranes);
  data.fluid.planes = data.fluid.planes.map((plane) => new Plane(plane));
  data.rows = rowsOf(data.diagnostics);
  return data;
}

/** Where the membranes were: coefficients of each vesicle and frame. */
export class Membranes {
  constructor(json) {
    Object.assign(this, json);
    this.bytes = bytesOf(json.bytes);
    this.view = new DataView(this.bytes.buffer);
    this.columns = this.fields.reduce((sum, field) => sum + field.components, 0);
    let column = 0;
    for (const field of this.fields) {
      field.first = column;
      column += field.components;
    }
    let offset = 0;
    this.vesicles = this.packings.map((packings) => {
      const at = offset;
      let degrees = 1;
      packings.forEach((packing, f) => {
        degrees = Math.max(degrees, packing.widths.length);
        let bytes = 0;
        for (let n = 0; n < packing.widths.length; ++n) bytes += (2 * n + 1) * Number(packing.widths[n]);
        offset += bytes * this.fields[f].components;
      });
      return { packings, offset: at, degrees };
    });
    this.stride = offset;
  }

  get count() {
    return this.vesicles.length;
  }
  get frames() {
    return this.times.length;
  }
  field(name) {
    return this.fields.find((field) => field.name === name);
  }

  /** Coefficients of one vesicle: an array for each column, in it degree by degree, orders 0, cos 1, sin 1, cos 2 ... */
  coefficients(frame, vesicle) {
    const { packings, offset, degrees } = this.vesicles[vesicle];
    const columns = Array.from({ length: this.columns }, () => new Float32Array(degrees * degrees));
    let at = frame * this.stride + offset;
    packings.forEach((packing, f) => {
      for (let c = 0; c < this.fields[f].components; ++c) at = this.unpack(packing, at, columns[this.fields[f].first + c]);
    });
    return { degrees, columns };
  }

  unpack({ quantum, widths }, at, values) {
    for (let n = 0; n < widths.length; ++n) {
      const width = Number(widths[n]);
      for (let row = n * n; row < (n + 1) * (n + 1); ++row, at += width) {
        if (width === 1) values[row] = quantum * this.view.getInt8(at);
        else if (width === 2) values[row] = quantum * this.view.getInt16(at, true);
        else if (width === 4) values[row] = this.view.getFloat32(at, true);
      }
    }
    return at;
  }
}

/** A plane through the fluid at the times of data.fluid.times. */
export class Plane {
  constructor(json) {
    Object.assign(this, json);
    this.integers = new DataView(bytesOf(json.bytes).buffer);
    this.size = this.points[0] * this.points[1];
    /** The axes that lie in the plane. */
    this.axes = [0, 1, 2].filter((axis) => axis !== this.axis);
  }

  quantity(snapshot, number) {
    const quantum = number < 3 ? this.velocity_quantum : this.pressure_quantum;
    const values = new Float32Array(this.size);
    for (let k = 0; k < this.size; ++k) values[k] = quantum * this.integers.getInt16(2 * ((4 * snapshot + number) * this.size + k), true);
    return values;
  }
  velocity(snapshot) {
    return [0, 1, 2].map((component) => this.quantity(snapshot, component));
  }
  speed(snapshot) {
    const [u, v, w] = this.velocity(snapshot);
    return u.map((x, k) => Math.hypot(x, v[k], w[k]));
  }
  pressure(snapshot) {
    return this.quantity(snapshot, 3);
  }
}

/** Columns of diagnostics.csv by name, of each vesicle; what is not defined is null. */
export function rowsOf(text) {
  const [head, ...lines] = text.split("\n").filter((line) => line !== "");
  const names = head ? head.split(",") : [];
  const vesicles = [];
  for (const line of lines) {
    const cells = line.split(",");
    const vesicle = Number(cells[2]);
    vesicles[vesicle] ??= Object.fromEntries(names.map((name) => [name, []]));
    names.forEach((name, c) => vesicles[vesicle][name].push(cells[c] === "" ? null : Number(cells[c])));
  }
  return { names, vesicles: vesicles.filter(Boolean) };
}
