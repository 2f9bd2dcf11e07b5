// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// Lines along a velocity in a plane, evenly apart: each grows from a seed both ways until it comes near another, leaves the plane or stops
// (after B. Jobard & W. Lefer, "Creating evenly-spaced streamlines of arbitrary density", 1997, with cells in place of distances).

class Flow {
  constructor(plane, u, v) {
    Object.assign(this, { plane, u, v });
    this.h = [0, 1].map((d) => (plane.upper[d] - plane.lower[d]) / plane.points[d]);
    this.fastest = 1e-300;
    for (let k = 0; k < u.length; ++k) this.fastest = Math.max(this.fastest, Math.hypot(u[k], v[k]));
  }

  isInside([x, y]) {
    const { lower, upper } = this.plane;
    return x >= lower[0] && x <= upper[0] && y >= lower[1] && y <= upper[1];
  }

  /** Velocity between the centres of cells. */
  at([x, y]) {
    const { lower, points } = this.plane;
    const place = (value, d) => Math.min(points[d] - 1, Math.max(0, (value - lower[d]) / this.h[d] - 0.5));
    const a = place(x, 0);
    const b = place(y, 1);
    const i = Math.min(points[0] - 2, Math.floor(a));
    const j = Math.min(points[1] - 2, Math.floor(b));
    const k = Math.max(0, j) * points[0] + Math.max(0, i);
    const s = a - i;
    const t = b - j;
    const mix = (f) => (1 - t) * ((1 - s) * f[k] + s * f[k + 1]) + t * ((1 - s) * f[k + points[0]] + s * f[k + points[0] + 1]);
    return [mix(this.u), mix(this.v)];
  }

  /** A step of so long a way along the flow, by the midpoint; null where it stands still. */
  step(point, way) {
    const direction = (velocity) => {
      const speed = Math.hypot(...velocity);
      return speed > 1e-4 * this.fastest ? velocity.map((c) => c / speed) : null;
    };
    const first = direction(this.at(point));
    if (!first) return null;
    const middle = direction(this.at([point[0] + (way / 2) * first[0], point[1] + (way / 2) * first[1]]));
    return middle && [point[0] + way * middle[0], point[1] + way * middle[1]];
  }
}

/** Lists of points (x, y) in the plane, each along the flow. `apart` is the distance of lines. */
export function streamlines(plane, u, v, apart) {
  const flow = new Flow(plane, u, v);
  const cell = apart / 2;
  const taken = new Map(); // of a cell: the line in it
  const key = ([x, y]) => `${Math.floor((x - plane.lower[0]) / cell)},${Math.floor((y - plane.lower[1]) / cell)}`;
  const isFree = (point, line) => {
    for (let dx = -1; dx <= 1; ++dx)
      for (let dy = -1; dy <= 1; ++dy) {
        const other = taken.get(key([point[0] + dx * cell, point[1] + dy * cell]));
        if (other !== undefined && other !== line) return false;
      }
    return true;
  };
  const way = Math.min(...flow.h) / 3;
  const most = Math.ceil((2 * (plane.upper[0] - plane.lower[0] + plane.upper[1] - plane.lower[1])) / way);

  const grow = (seed, sign, line) => {
    const points = [];
    const start = seed;
    let gone = 0;
    for (let point = seed; points.length < most; ) {
      point = flow.step(point, sign * way);
      if (!point || !flow.isInside(point) || !isFree(point, line)) break;
      points.push(point);
      gone += way;
      if (gone > 4 * apart && Math.hypot(point[0] - start[0], point[1] - start[1]) < way) break; // closed
    }
    return points;
  };

  const lines = [];
  const n = [0, 1].map((d) => Math.max(1, Math.round((plane.upper[d] - plane.lower[d]) / apart)));
  // Seeds from the middle outwards, so that lines there are the longest.
  const seeds = [];
  for (let j = 0; j < n[1]; ++j)
    for (let i = 0; i < n[0]; ++i)
      seeds.push([0, 1].map((d) => plane.lower[d] + (((d ? j : i) + 0.5) * (plane.upper[d] - plane.lower[d])) / n[d]));
  const middle = [0, 1].map((d) => (plane.lower[d] + plane.upper[d]) / 2);
  seeds.sort((a, b) => Math.hypot(a[0] - middle[0], a[1] - middle[1]) - Math.hypot(b[0] - middle[0], b[1] - middle[1]));
  for (const seed of seeds) {
    if (!isFree(seed, -1)) continue;
    const forth = grow(seed, 1, lines.length);
    const isClosed = forth.length > 0 && Math.hypot(forth.at(-1)[0] - seed[0], forth.at(-1)[1] - seed[1]) < 1.5 * way;
    const line = [...(isClosed ? [] : grow(seed, -1, lines.length)).reverse(), seed, ...forth];
    if (line.length * way < apart) continue;
    for (const point of line) taken.set(key(point), lines.length);
    lines.push(line);
  }
  return lines;
}
