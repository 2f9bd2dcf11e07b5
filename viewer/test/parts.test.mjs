// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// What the page computes, without a browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { colourOf, scaleOf, tables } from "../src/colours.js";
import { Clock } from "../src/clock.js";
import { Membranes, rowsOf } from "../src/data.js";
import { legendre, SphereMesh } from "../src/harmonics.js";
import { streamlines } from "../src/streamlines.js";

const at = (n, m) => (n * (n + 1)) / 2 + m;

test("the functions are orthonormal, and positive next to the north pole", () => {
  const degrees = 12;
  const points = 4000; // of the midpoint rule
  const sums = new Map();
  for (let k = 0; k < points; ++k) {
    const theta = (Math.PI * (k + 0.5)) / points;
    const { P } = legendre(degrees, theta);
    for (const m of [0, 1, 5])
      for (let n = m; n < degrees; ++n)
        for (let l = m; l <= n; ++l) {
          const key = `${m} ${n} ${l}`;
          sums.set(key, (sums.get(key) ?? 0) + 2 * Math.PI * P[at(n, m)] * P[at(l, m)] * Math.sin(theta) * (Math.PI / points));
        }
    if (k === 0) for (let n = 0; n < degrees; ++n) for (let m = 0; m <= n; ++m) assert.ok(P[at(n, m)] > 0 || m > 8);
  }
  for (const [key, sum] of sums) {
    const [, n, l] = key.split(" ");
    assert.ok(Math.abs(sum - (n === l ? 1 : 0)) < 1e-5, `${key}: ${sum}`);
  }
});

test("derivatives are those of the functions", () => {
  const h = 1e-5;
  for (const theta of [0.4, 1.3, 2.9]) {
    const [low, here, high] = [theta - h, theta, theta + h].map((t) => legendre(14, t));
    for (let k = 0; k < here.P.length; ++k)
      assert.ok(Math.abs((high.P[k] - low.P[k]) / (2 * h) - here.D[k]) < 1e-7 * (1 + Math.abs(here.D[k])), `${theta} ${k}`);
  }
});

// x = a sin(theta) cos(phi) ...: three coefficients of degree 1.
function ellipsoid(a, b, c) {
  const unit = Math.sqrt((4 * Math.PI) / 3);
  const columns = [0, 1, 2].map(() => new Float32Array(9));
  columns[0][2] = a * unit;
  columns[1][3] = b * unit;
  columns[2][1] = c * unit;
  return columns;
}

test("surfaces have the points and the normals of their harmonics", () => {
  const [a, b, c] = [1.5, 0.9, 0.7];
  const mesh = new SphereMesh(24, 48, 3);
  const positions = new Float32Array(3 * mesh.size);
  const normals = new Float32Array(3 * mesh.size);
  mesh.surface(ellipsoid(a, b, c), positions, normals, { theta: new Float32Array(3 * mesh.size), phi: new Float32Array(3 * mesh.size) });
  for (let k = 0; k < 3 * mesh.size; k += 3) {
    const [x, y, z] = positions.slice(k, k + 3);
    assert.ok(Math.abs((x / a) ** 2 + (y / b) ** 2 + (z / c) ** 2 - 1) < 1e-5);
    const n = [x / a ** 2, y / b ** 2, z / c ** 2];
    const length = Math.hypot(...n);
    for (let d = 0; d < 3; ++d) assert.ok(Math.abs(normals[k + d] - n[d] / length) < 2e-4, `${k}: ${normals[k + d]} ${n[d] / length}`);
  }
});

test("triangles close the surface and look outwards", () => {
  const mesh = new SphereMesh(40, 80, 3);
  const positions = new Float32Array(3 * mesh.size);
  [0, 1, 2].forEach((d) => mesh.values(ellipsoid(1, 1, 1)[d], positions, 3, d));
  let volume = 0;
  const index = mesh.indices();
  const point = (i) => [...positions.slice(3 * i, 3 * i + 3)];
  for (let k = 0; k < index.length; k += 3) {
    const [p, q, r] = [point(index[k]), point(index[k + 1]), point(index[k + 2])];
    volume += (p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0])) / 6;
  }
  assert.ok(Math.abs(volume / ((4 / 3) * Math.PI) - 1) < 0.01, String(volume));
});

test("packed coefficients are read back: widths, signs, frames", () => {
  const bytes = [0x9c, 0xff, 0x05, 0xfb, 0x7f, 0x64, 0x00, 0x01, 0x02, 0x03]; // two frames of: -100 | 5 -5 127
  const membranes = new Membranes({
    times: [0, 1],
    fields: [{ name: "tension", components: 1 }],
    packings: [[{ quantum: 0.5, widths: "21" }]],
    bytes: Buffer.from(bytes).toString("base64"),
  });
  assert.equal(membranes.stride, 5);
  assert.deepEqual([...membranes.coefficients(0, 0).columns[0]], [-50, 2.5, -2.5, 63.5]);
  assert.deepEqual([...membranes.coefficients(1, 0).columns[0]], [50, 0.5, 1, 1.5]);
});

test("rows of diagnostics.csv become columns of each vesicle", () => {
  const rows = rowsOf("step,time,vesicle,a\n0,0,0,1\n0,0,1,\n5,0.5,0,3\n5,0.5,1,4\n");
  assert.deepEqual(rows.vesicles[0].a, [1, 3]);
  assert.deepEqual(rows.vesicles[1].a, [null, 4]);
  assert.equal(rowsOf("").vesicles.length, 0);
});

test("colours grow lighter, and about zero they are lightest in the middle", () => {
  const lightness = (table, i) => 0.2126 * (table[4 * i] / 255) ** 2.2 + 0.7152 * (table[4 * i + 1] / 255) ** 2.2 + 0.0722 * (table[4 * i + 2] / 255) ** 2.2;
  for (let i = 4; i < 256; i += 4) assert.ok(lightness(tables.sequential, i) > lightness(tables.sequential, i - 4), String(i));
  for (let i = 4; i < 128; i += 4) assert.ok(lightness(tables.diverging, i) > lightness(tables.diverging, i - 4), String(i));
  for (let i = 132; i < 256; i += 4) assert.ok(lightness(tables.diverging, i) < lightness(tables.diverging, i - 4), String(i));
  assert.deepEqual(colourOf(1, 0, 0), [255, 255, 255]);
  assert.deepEqual(scaleOf(-2, 3), { map: "diverging", low: -3, high: 3 });
  assert.deepEqual(scaleOf(-0.1, 3), { map: "sequential", low: -0.1, high: 3 });
  const level = scaleOf(1, 1);
  assert.ok(level.low < 1 && level.high > 1);
});

test("streamlines of a rotation are circles, and keep apart", () => {
  const n = 40;
  const plane = { lower: [-1, -1], upper: [1, 1], points: [n, n] };
  const u = new Float32Array(n * n);
  const v = new Float32Array(n * n);
  for (let j = 0; j < n; ++j)
    for (let i = 0; i < n; ++i) {
      u[j * n + i] = -(-1 + (2 * (j + 0.5)) / n);
      v[j * n + i] = -1 + (2 * (i + 0.5)) / n;
    }
  const lines = streamlines(plane, u, v, 0.2);
  assert.ok(lines.length >= 4);
  for (const line of lines) {
    const radii = line.map(([x, y]) => Math.hypot(x, y));
    assert.ok(Math.max(...radii) - Math.min(...radii) < 0.02, `${Math.min(...radii)} ${Math.max(...radii)}`);
    // Against the clock.
    const [a, b] = [line[0], line[1]];
    assert.ok(a[0] * b[1] - a[1] * b[0] > 0);
  }
  for (const one of lines)
    for (const other of lines)
      if (one !== other) for (const p of one) for (const q of other) assert.ok(Math.hypot(p[0] - q[0], p[1] - q[1]) > 0.05);
});

test("the clock stays between its ends and finds the nearest time", () => {
  const clock = new Clock([0, 0.5, 2]);
  let told = 0;
  clock.onChange(() => ++told);
  clock.show(7);
  assert.equal(clock.frame, 2);
  clock.show(5);
  clock.showTime(0.9);
  assert.equal(clock.frame, 1);
  assert.equal(told, 2);
});
