// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// The camera and what draws: only when something has changed.
import { Color, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { drawCompass } from "./surroundings.js";

export const views = {
  oblique: [0.34, -0.86, 0.38],
  "along y": [0, -1, 0],
  "along x": [1, 0, 0],
  "along z": [0, 0, 1],
};

export class Stage {
  /** Throws where the browser has no WebGL. */
  constructor(element) {
    this.element = element;
    this.renderer = new WebGLRenderer({ antialias: true });
    this.renderer.setPixelRatio(Math.min(2, globalThis.devicePixelRatio || 1));
    element.prepend(this.renderer.domElement);
    this.compass = document.createElement("canvas");
    this.compass.width = this.compass.height = 160;
    this.compass.className = "compass";
    this.compass.setAttribute("aria-hidden", "true");
    element.append(this.compass);
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(28, 1, 0.05, 2000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.draw());
    this.dark = globalThis.matchMedia("(prefers-color-scheme: dark)");
    this.dark.addEventListener("change", () => this.draw());
    new ResizeObserver(() => this.resize()).observe(element);
    this.bounds = { low: [-1, -1, -1], high: [1, 1, 1] };
    this.resize();
  }

  get isDark() {
    return this.dark.matches;
  }
  get canvas() {
    return this.renderer.domElement;
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Looks at what lies between two corners from one of the directions of `views`. */
  look(direction, { low, high } = this.bounds) {
    this.bounds = { low, high };
    const towards = new Vector3(...direction).normalize();
    const middle = new Vector3(...low.map((l, d) => (l + high[d]) / 2));
    this.camera.up.set(0, Math.abs(towards.z) > 0.99 ? 1 : 0, Math.abs(towards.z) > 0.99 ? 0 : 1);
    this.camera.position.copy(middle).add(towards);
    this.camera.lookAt(middle);
    this.camera.updateMatrixWorld();
    // As near as the corners allow.
    const half = Math.tan((this.camera.fov * Math.PI) / 360);
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const point = new Vector3(...low.map((l, d) => (corner & (1 << d) ? high[d] : l))).applyMatrix4(this.camera.matrixWorldInverse);
      const across = Math.max(Math.abs(point.x) / this.camera.aspect, Math.abs(point.y));
      distance = Math.max(distance, across / half + point.z + 1);
    }
    this.camera.position.copy(middle).addScaledVector(towards, 1.08 * distance);
    this.camera.near = distance / 200;
    this.camera.far = 40 * distance;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(middle);
    this.controls.update();
    this.draw();
  }

  /** Draws now, not with the next frame of the screen: pictures are taken of what is drawn. */
  render() {
    this.isWaiting = false;
    this.scene.background = new Color(this.isDark ? "#0c1015" : "#eef2f6");
    this.renderer.render(this.scene, this.camera);
    drawCompass(this.compass.getContext("2d"), this.camera, this.isDark, this.compass.width);
  }

  draw() {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => this.isWaiting && this.render());
  }

  /** Where a point of space is on the canvas, in CSS pixels from its upper left. */
  project(point) {
    const p = new Vector3(...point).project(this.camera);
    return [((p.x + 1) / 2) * this.element.clientWidth, ((1 - p.y) / 2) * this.element.clientHeight];
  }
}
