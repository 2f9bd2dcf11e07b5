// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// A plane of the fluid in the scene: speed or pressure as colours, and streamlines of the velocity in the plane.
import {
  BufferAttribute, BufferGeometry, ClampToEdgeWrapping, DataTexture, DataUtils, DoubleSide, GLSL3, Group, HalfFloatType, LinearFilter,
  LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, RedFormat, ShaderMaterial,
} from "three";
import { isLight, scaleOf } from "./colours.js";
import { textures } from "./membranes.js";
import { streamlines } from "./streamlines.js";

const vertexShader = `
out vec2 place;
void main() {
  place = uv;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
const fragmentShader = `
uniform sampler2D field, colours;
uniform float low, high;
in vec2 place;
out vec4 colour;
void main() {
  float value = clamp((texture(field, place).r - low) / (high - low), 0.002, 0.998);
  colour = vec4(texture(colours, vec2(value, 0.5)).rgb, 1.0);
  colour = linearToOutputTexel(colour);
}`;

/** Names and units of what a plane can be coloured by. */
export const quantities = {
  speed: { label: "speed of the fluid", unit: "r / time" },
  pressure: { label: "pressure of the fluid", unit: "viscosity / time" },
};

// Lines so far apart, as a share of the longer edge.
const apartShare = 1 / 34;

export class Slice {
  constructor(fluid, box) {
    this.fluid = fluid;
    this.box = box;
    this.group = new Group();
    this.ranges = new Map();
  }

  get isThere() {
    return this.fluid.planes.length > 0 && this.fluid.times.length > 0;
  }

  /** The snapshot nearest in time. */
  snapshotAt(time) {
    let best = 0;
    this.fluid.times.forEach((t, s) => {
      if (Math.abs(t - time) < Math.abs(this.fluid.times[best] - time)) best = s;
    });
    return best;
  }

  /** Ends of the colours: the same for all times of a plane. */
  scale(plane, quantity) {
    const name = `${plane.axis} ${quantity}`;
    if (!this.ranges.has(name)) {
      const all = [];
      this.fluid.times.forEach((_, s) => all.push(...plane[quantity](s)));
      all.sort((a, b) => a - b);
      const at = (share) => all[Math.round(share * (all.length - 1))];
      this.ranges.set(name, quantity === "speed" ? { map: "sequential", low: 0, high: at(0.995) || 1 } : scaleOf(at(0.005), at(0.995)));
    }
    return this.ranges.get(name);
  }

  /** Draws plane number `number` at that time; nothing where `quantity` is "none" and there are no lines. */
  show(number, time, quantity, withLines) {
    this.clear();
    if (!this.isThere || (quantity === "none" && !withLines)) return;
    const plane = this.fluid.planes[number];
    const snapshot = this.snapshotAt(time);
    const values = quantity === "none" ? null : plane[quantity](snapshot);
    const scale = values && this.scale(plane, quantity);
    const parts = new Group();
    if (values) parts.add(this.colouredPlane(plane, values, scale));
    if (withLines) parts.add(...this.lines(plane, snapshot, values, scale));
    for (const image of this.images(plane, parts)) this.group.add(image);
    this.drawn = parts.children;
  }

  // With images in planes of symmetry that the plane crosses.
  images(plane, parts) {
    let all = [parts];
    for (const axis of plane.axes.filter((a) => this.box?.mirror?.[a])) {
      const mirrored = all.map((image) => {
        const copy = image.clone();
        copy.scale.setComponent(axis, -copy.scale.getComponent(axis));
        copy.position.setComponent(axis, 2 * this.box.lower[axis] - copy.position.getComponent(axis));
        return copy;
      });
      all = [...all, ...mirrored];
    }
    return all;
  }

  clear() {
    for (const part of this.drawn ?? []) {
      part.geometry.dispose();
      part.material.uniforms?.field?.value.dispose();
      part.material.dispose();
    }
    this.drawn = [];
    this.group.clear();
  }

  // A point of the plane in space.
  point(plane, x, y) {
    const p = [0, 0, 0];
    p[plane.axis] = plane.position;
    p[plane.axes[0]] = x;
    p[plane.axes[1]] = y;
    return p;
  }

  colouredPlane(plane, values, scale) {
    const field = new DataTexture(Uint16Array.from(values, DataUtils.toHalfFloat), ...plane.points, RedFormat, HalfFloatType);
    field.minFilter = field.magFilter = LinearFilter;
    field.wrapS = field.wrapT = ClampToEdgeWrapping;
    field.needsUpdate = true;
    const geometry = new BufferGeometry();
    const corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
    const place = (c, d) => plane.lower[d] + c[d] * (plane.upper[d] - plane.lower[d]);
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(corners.flatMap((c) => this.point(plane, place(c, 0), place(c, 1)))), 3));
    geometry.setAttribute("uv", new BufferAttribute(new Float32Array(corners.flat()), 2));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    const uniforms = { field: { value: field }, colours: { value: textures[scale.map] }, low: { value: scale.low }, high: { value: scale.high } };
    const material = new ShaderMaterial({
      glslVersion: GLSL3, vertexShader, fragmentShader, uniforms, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2,
    });
    return new Mesh(geometry, material);
  }

  // Lines and their heads: grey where they are alone, and on colours white on what is dark, dark on what is light.
  lines(plane, snapshot, values, scale) {
    const velocity = plane.velocity(snapshot);
    const edge = Math.max(plane.upper[0] - plane.lower[0], plane.upper[1] - plane.lower[1]);
    const apart = edge * apartShare;
    const lines = streamlines(plane, velocity[plane.axes[0]], velocity[plane.axes[1]], apart);
    const ends = [];
    const heads = [];
    for (const line of lines) {
      for (let k = 0; k + 1 < line.length; ++k) ends.push(...this.point(plane, ...line[k]), ...this.point(plane, ...line[k + 1]));
      heads.push(...this.head(plane, line, 0.24 * apart));
    }
    const colourAt = (x, y) => {
      if (!values) return [0.2, 0.24, 0.31];
      const [i, j] = [x, y].map((c, d) => Math.min(plane.points[d] - 1, Math.max(0, Math.floor(((c - plane.lower[d]) / (plane.upper[d] - plane.lower[d])) * plane.points[d]))));
      const share = (values[j * plane.points[0] + i] - scale.low) / (scale.high - scale.low);
      return isLight(scale.map, share) ? [0.01, 0.02, 0.03] : [1, 1, 1];
    };
    const geometryOf = (points) => {
      const colours = [];
      for (let k = 0; k < points.length; k += 3) colours.push(...colourAt(points[k + plane.axes[0]], points[k + plane.axes[1]]));
      return new BufferGeometry()
        .setAttribute("position", new BufferAttribute(new Float32Array(points), 3))
        .setAttribute("color", new BufferAttribute(new Float32Array(colours), 3));
    };
    const material = { vertexColors: true, transparent: true, opacity: values ? 0.75 : 0.9 };
    return [
      new LineSegments(geometryOf(ends), new LineBasicMaterial(material)),
      new Mesh(geometryOf(heads), new MeshBasicMaterial({ ...material, side: DoubleSide })),
    ];
  }

  // An arrow head in the middle of a line.
  head(plane, line, size) {
    const k = Math.floor(line.length / 2);
    const [a, b] = [line[Math.max(0, k - 1)], line[Math.min(line.length - 1, k + 1)]];
    const length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
    const [dx, dy] = [(size * (b[0] - a[0])) / length, (size * (b[1] - a[1])) / length];
    const [x, y] = line[k];
    return [
      ...this.point(plane, x + dx, y + dy),
      ...this.point(plane, x - 0.5 * dx - 0.55 * dy, y - 0.5 * dy + 0.55 * dx),
      ...this.point(plane, x - 0.5 * dx + 0.55 * dy, y - 0.5 * dy - 0.55 * dx),
    ];
  }
}
