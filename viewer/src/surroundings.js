// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// The box, its walls, and the directions.
import {
  BackSide, BoxGeometry, BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineDashedMaterial, LineSegments, Mesh, MeshBasicMaterial,
} from "three";

/** Corners of the box with its mirror images. */
export function wholeBox(box) {
  return { low: box.lower.map((l, d) => (box.mirror?.[d] ? 2 * l - box.upper[d] : l)), high: [...box.upper] };
}

/** Edges; drawn in full where walls meet, dashed where the box repeats. Walls are faint, and seen from inside only. */
export function boxOf(box, isDark) {
  const group = new Group();
  const { low, high } = wholeBox(box);
  const colour = isDark ? "#8b98a9" : "#66717f";
  const solid = [];
  const dashed = [];
  for (let axis = 0; axis < 3; ++axis)
    for (const a of [low, high])
      for (const b of [low, high]) {
        const [d, e] = [0, 1, 2].filter((other) => other !== axis);
        const start = [0, 0, 0];
        start[axis] = low[axis];
        start[d] = a[d];
        start[e] = b[e];
        const end = [...start];
        end[axis] = high[axis];
        (box.periodic?.[d] && box.periodic?.[e] ? dashed : solid).push(...start, ...end);
      }
  const linesOf = (points, material) => {
    const lines = new LineSegments(new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(points), 3)), material);
    lines.computeLineDistances();
    return lines;
  };
  const size = Math.max(...high.map((h, d) => h - low[d]));
  group.add(linesOf(solid, new LineBasicMaterial({ color: colour })));
  group.add(linesOf(dashed, new LineDashedMaterial({ color: colour, dashSize: size / 60, gapSize: size / 60 })));
  for (let axis = 0; axis < 3; ++axis) {
    if (box.periodic?.[axis]) continue;
    const extent = high.map((h, d) => (d === axis ? 1e-3 * size : h - low[d]));
    for (const side of box.mirror?.[axis] ? [high] : [low, high]) {
      const wall = new Mesh(new BoxGeometry(...extent), new MeshBasicMaterial({ color: colour, transparent: true, opacity: 0.07, side: BackSide, depthWrite: false }));
      wall.position.fromArray(high.map((h, d) => (d === axis ? side[d] : (h + low[d]) / 2)));
      group.add(wall);
    }
  }
  return group;
}

const directions = [
  { name: "x", colour: { light: "#b3261e", dark: "#ff8f85" } },
  { name: "y", colour: { light: "#12703f", dark: "#63d297" } },
  { name: "z", colour: { light: "#0b57b0", dark: "#82b6ff" } },
];

/** Draws the directions as the camera sees them into a corner of a 2-D canvas. */
export function drawCompass(context, camera, isDark, size) {
  const { elements: e } = camera.matrixWorldInverse;
  context.clearRect(0, 0, size, size);
  context.lineWidth = size / 40;
  context.font = `600 ${size / 6}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  const ends = directions.map((direction, d) => ({ ...direction, x: e[4 * d], y: e[4 * d + 1], z: e[4 * d + 2] }));
  ends.sort((a, b) => a.z - b.z);
  for (const { name, colour, x, y } of ends) {
    context.strokeStyle = context.fillStyle = isDark ? colour.dark : colour.light;
    context.beginPath();
    context.moveTo(size / 2, size / 2);
    context.lineTo(size / 2 + 0.29 * size * x, size / 2 - 0.29 * size * y);
    context.stroke();
    context.fillText(name, size / 2 + 0.39 * size * x, size / 2 - 0.39 * size * y);
  }
}
