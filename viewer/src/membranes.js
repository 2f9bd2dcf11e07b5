// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// The membranes in the scene: smooth meshes from their harmonics, coloured by a field through a table in the shader.
import { BufferAttribute, BufferGeometry, DataTexture, GLSL3, Group, LinearFilter, Mesh, ShaderMaterial, SRGBColorSpace } from "three";
import { tables } from "./colours.js";
import { SphereMesh } from "./harmonics.js";

const vertexShader = `
in float value;
in vec2 labels;
out vec3 vNormal;
out vec3 vEye;
out float vValue;
out vec2 vLabels;
void main() {
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  vNormal = normalMatrix * normal;
  vEye = eye.xyz;
  vValue = value;
  vLabels = labels;
  gl_Position = projectionMatrix * eye;
}`;

// Lit from the upper left of the reader, with a little light from below and a soft gloss. Lines are those of the mesh, one pixel wide.
const fragmentShader = `
uniform sampler2D colours;
uniform float low, high, lines;
uniform vec2 meshSize;
in vec3 vNormal;
in vec3 vEye;
in float vValue;
in vec2 vLabels;
out vec4 colour;
float lineAt(float at) {
  float away = abs(at - round(at)) / max(fwidth(at), 1e-6);
  return 1.0 - smoothstep(0.5, 1.4, away);
}
void main() {
  vec3 n = normalize(vNormal);
  vec3 v = normalize(-vEye);
  if (dot(n, v) < 0.0) n = -n;
  vec3 key = normalize(vec3(-0.45, 0.65, 0.62));
  float diffuse = max(dot(n, key), 0.0);
  float sky = 0.5 + 0.5 * n.y;
  float gloss = pow(max(dot(n, normalize(key + v)), 0.0), 38.0);
  float rim = pow(1.0 - max(dot(n, v), 0.0), 3.0);
  vec3 base = texture(colours, vec2(clamp((vValue - low) / (high - low), 0.002, 0.998), 0.5)).rgb;
  if (lines > 0.5) {
    // Rows at the nodes of Gauss and Legendre, nearly (j + 3/4) pi/(N + 1/2); every other, or as many as can be told apart.
    float row = (vLabels.x / 3.14159265 * (meshSize.x + 0.5) - 0.75) / 2.0;
    float column = vLabels.y / 6.28318531 * meshSize.y / 2.0;
    float strength = max(lineAt(row), lineAt(column)) * (1.0 - smoothstep(0.25, 0.6, max(fwidth(row), fwidth(column))));
    base = mix(base, vec3(0.02), 0.6 * strength);
  }
  vec3 lit = base * (0.34 + 0.22 * sky + 0.58 * diffuse) + vec3(0.10) * gloss + base * 0.10 * rim;
  colour = vec4(lit, 1.0);
  colour = linearToOutputTexel(colour);
}`;

function textureOf(map) {
  const texture = new DataTexture(tables[map], 256, 1);
  texture.colorSpace = SRGBColorSpace;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

export const textures = { sequential: textureOf("sequential"), diverging: textureOf("diverging") };

// As fine as the number of vesicles allows at the speed of a film.
const latitudesFor = (count) => (count <= 2 ? 64 : count <= 8 ? 44 : count <= 32 ? 28 : 20);

export class MembraneMeshes {
  constructor(membranes, box) {
    this.membranes = membranes;
    this.box = box;
    this.group = new Group();
    const latitudes = latitudesFor(membranes.count);
    const degrees = Math.max(1, ...membranes.vesicles.map((vesicle) => vesicle.degrees));
    this.sphere = new SphereMesh(latitudes, 2 * latitudes, degrees);
    this.work = { theta: new Float64Array(3 * this.sphere.size), phi: new Float64Array(3 * this.sphere.size) };
    const index = new BufferAttribute(this.sphere.indices(), 1);
    const labels = new BufferAttribute(this.labels(), 2);
    this.vesicles = membranes.vesicles.map((_, v) => this.vesicle(index, labels, membranes.latitudes[v]));
  }

  labels() {
    const { rows, columns, theta } = this.sphere;
    const list = new Float32Array(2 * rows * columns);
    for (let j = 0, k = 0; j < rows; ++j)
      for (let i = 0; i < columns; ++i, k += 2) {
        list[k] = theta[j];
        list[k + 1] = (2 * Math.PI * i) / (columns - 1);
      }
    return list;
  }

  vesicle(index, labels, latitudes) {
    const geometry = new BufferGeometry();
    geometry.setIndex(index);
    for (const [name, size] of [["position", 3], ["normal", 3], ["value", 1]])
      geometry.setAttribute(name, new BufferAttribute(new Float32Array(size * this.sphere.size), size));
    geometry.setAttribute("labels", labels);
    const material = new ShaderMaterial({
      glslVersion: GLSL3,
      vertexShader,
      fragmentShader,
      side: 2,
      uniforms: {
        colours: { value: textures.sequential },
        low: { value: 0 },
        high: { value: 1 },
        lines: { value: 0 },
        meshSize: { value: [latitudes, 2 * latitudes] },
      },
    });
    const meshes = this.images().map((axes) => {
      const mesh = new Mesh(geometry, material);
      mesh.frustumCulled = false;
      mesh.userData.axes = axes;
      this.group.add(mesh);
      return mesh;
    });
    return { geometry, material, meshes, centre: [0, 0, 0], low: [0, 0, 0], high: [0, 0, 0] };
  }

  // The vesicle and its images in the planes of symmetry: which axes of each are mirrored.
  images() {
    const mirrored = [0, 1, 2].filter((axis) => this.box?.mirror?.[axis]);
    let all = [[]];
    for (const axis of mirrored) all = [...all, ...all.map((axes) => [...axes, axis])];
    return all;
  }

  /** Brings all vesicles to a frame, coloured by that field. */
  show(frame, field, scale) {
    this.vesicles.forEach((vesicle, v) => {
      const { columns } = this.membranes.coefficients(frame, v);
      const attributes = vesicle.geometry.attributes;
      this.sphere.surface(columns, attributes.position.array, attributes.normal.array, this.work);
      this.sphere.values(columns[field.first], attributes.value.array);
      attributes.position.needsUpdate = attributes.normal.needsUpdate = attributes.value.needsUpdate = true;
      vesicle.columns = columns;
      this.measure(vesicle, columns);
      this.place(vesicle);
    });
    this.colour(scale);
  }

  /** Colours the frame that is shown by another field. */
  recolour(field, scale) {
    for (const vesicle of this.vesicles) {
      this.sphere.values(vesicle.columns[field.first], vesicle.geometry.attributes.value.array);
      vesicle.geometry.attributes.value.needsUpdate = true;
    }
    this.colour(scale);
  }

  colour(scale) {
    for (const { material } of this.vesicles) {
      material.uniforms.colours.value = textures[scale.map];
      material.uniforms.low.value = scale.low;
      material.uniforms.high.value = scale.high;
    }
  }

  drawLines(on) {
    for (const { material } of this.vesicles) material.uniforms.lines.value = on ? 1 : 0;
  }

  measure(vesicle, columns) {
    const positions = vesicle.geometry.attributes.position.array;
    for (let c = 0; c < 3; ++c) {
      let low = Infinity;
      let high = -Infinity;
      for (let k = c; k < positions.length; k += 3) {
        low = Math.min(low, positions[k]);
        high = Math.max(high, positions[k]);
      }
      vesicle.low[c] = low;
      vesicle.high[c] = high;
      vesicle.centre[c] = columns[c][0] / Math.sqrt(4 * Math.PI);
    }
  }

  // Whole, inside the box: one that left through a periodic end comes back through the other. One that does not lie across a plane of
  // symmetry has an image behind it.
  place(vesicle) {
    const { box } = this;
    const shift = [0, 1, 2].map((axis) => {
      if (!box?.periodic?.[axis]) return 0;
      const length = box.upper[axis] - box.lower[axis];
      return -length * Math.floor((vesicle.centre[axis] - box.lower[axis]) / length);
    });
    for (const mesh of vesicle.meshes) {
      const { axes } = mesh.userData;
      const scale = [1, 1, 1];
      const position = [...shift];
      for (const axis of axes) {
        scale[axis] = -1;
        position[axis] = 2 * box.lower[axis] - shift[axis];
      }
      mesh.scale.fromArray(scale);
      mesh.position.fromArray(position);
      const tolerance = 1e-3 * (vesicle.high[0] - vesicle.low[0]);
      mesh.visible = axes.every((axis) => vesicle.low[axis] + shift[axis] > box.lower[axis] - tolerance);
    }
    vesicle.shift = shift;
  }

  /** Corners around all that is shown. */
  bounds() {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (const vesicle of this.vesicles)
      for (const mesh of vesicle.meshes)
        if (mesh.visible)
          for (let c = 0; c < 3; ++c) {
            const ends = [vesicle.low[c], vesicle.high[c]].map((x) => mesh.scale.getComponent(c) * x + mesh.position.getComponent(c));
            low[c] = Math.min(low[c], ...ends);
            high[c] = Math.max(high[c], ...ends);
          }
    return { low, high };
  }

  dispose() {
    for (const { geometry, material } of this.vesicles) {
      geometry.dispose();
      material.dispose();
    }
  }
}
