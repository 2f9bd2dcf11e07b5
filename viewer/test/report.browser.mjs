// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// Reports in a real browser. The runs are in the folder REPORTS: tank_treading, eight, blow_up (test/browser.sh makes them); pictures of
// what was seen are left there.
import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { after, before, test } from "node:test";
import { apart, launch, open, pixels } from "./browser.mjs";

const folder = process.env.REPORTS;
if (!folder) throw new Error("REPORTS: the folder of the runs is not given");
const report = (run) => `${folder}/${run}/report.html`;
const summaryOf = (run) => JSON.parse(readFileSync(`${folder}/${run}/summary.json`, "utf8"));
const mostBytes = 3_000_000;

let browser;
before(async () => {
  browser = await launch();
});
after(async () => {
  await browser.close();
});

// Draws now and takes a picture of the view alone, without what lies over it.
async function pictureOfView(page) {
  await page.evaluate(() => {
    for (const part of document.querySelectorAll(".stage > :not(canvas:first-child)")) part.style.visibility = "hidden";
    globalThis.vesiflow.view.stage.render();
  });
  const png = await page.locator(".stage canvas").first().screenshot();
  await page.evaluate(() => {
    for (const part of document.querySelectorAll(".stage > *")) part.style.visibility = "";
  });
  return pixels(browser, png);
}

// Hull of the points (x, y), against the clock.
function hullOf(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const cross = (o, a, b) => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  const half = (list) => {
    const hull = [];
    for (const p of list) {
      while (hull.length > 1 && cross(hull.at(-2), hull.at(-1), p) <= 0) hull.pop();
      hull.push(p);
    }
    return hull.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

// Distance into a convex hull, negative outside.
function depthIn(hull, [x, y]) {
  let depth = Infinity;
  hull.forEach((a, k) => {
    const b = hull[(k + 1) % hull.length];
    depth = Math.min(depth, ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / Math.hypot(b[0] - a[0], b[1] - a[1]));
  });
  return depth;
}

// Where the vertices of a vesicle are on the view.
const projected = (page, vesicle) =>
  page.evaluate((v) => {
    const { view } = globalThis.vesiflow;
    const { geometry, meshes } = view.meshes.vesicles[v];
    const { array } = geometry.attributes.position;
    const shift = meshes[0].position.toArray();
    const points = [];
    for (let k = 0; k < array.length; k += 3) points.push(view.stage.project([0, 1, 2].map((c) => array[k + c] + shift[c])));
    return points;
  }, vesicle);

// Volume and area within the triangles that are drawn.
const measured = (page, vesicle) =>
  page.evaluate((v) => {
    const { geometry } = globalThis.vesiflow.view.meshes.vesicles[v];
    const p = geometry.attributes.position.array;
    const n = geometry.attributes.normal.array;
    const index = geometry.index.array;
    let volume = 0;
    let area = 0;
    let least = 1;
    const at = (a, i) => [a[3 * i], a[3 * i + 1], a[3 * i + 2]];
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    for (let k = 0; k < index.length; k += 3) {
      const [a, b, c] = [0, 1, 2].map((d) => at(p, index[k + d]));
      const [e, f] = [b, c].map((q) => q.map((x, d) => x - a[d]));
      const cross = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
      const size = Math.hypot(...cross);
      volume += dot(a, cross) / 6;
      area += size / 2;
      if (size > 1e-6) for (let d = 0; d < 3; ++d) least = Math.min(least, dot(cross, at(n, index[k + d])) / size);
    }
    return { volume, area, least };
  }, vesicle);

async function choose(page, label, value) {
  await page.getByLabel(label, { exact: true }).selectOption(value);
}

test("the quickstart: smooth membrane where it should be, of the volume and area that the run reports", async (t) => {
  const { page, faults } = await open(browser, report("tank_treading"));
  const [vesicle] = summaryOf("tank_treading").vesicles;
  const { volume, area, least } = await measured(page, 0);
  assert.ok(Math.abs(volume / vesicle.volume - 1) < 3e-3, `${volume} ${vesicle.volume}`); // of a mesh of 64 x 128 facets
  assert.ok(Math.abs(area / vesicle.area - 1) < 3e-3, `${area} ${vesicle.area}`);
  assert.ok(least > 0.99, `normals are off the facets by ${(Math.acos(least) * 180) / Math.PI} degrees`);

  await page.getByLabel("Box", { exact: true }).uncheck();
  const picture = await pictureOfView(page);
  const background = Math.round(picture.height / 2) * picture.width + 20;
  const hull = hullOf(await projected(page, 0));
  let [inside, hit, outside, stray] = [0, 0, 0, 0];
  const colours = new Set();
  const edge = 12; // corners are round
  for (let y = edge; y < picture.height - edge; ++y)
    for (let x = edge; x < picture.width - edge; ++x) {
      const i = y * picture.width + x;
      const depth = depthIn(hull, [x + 0.5, y + 0.5]);
      const isDrawn = apart(picture.data, i, picture.data, background) > 12;
      if (depth > 2) {
        ++inside;
        if (isDrawn) ++hit;
        colours.add((picture.data[4 * i] >> 3) | ((picture.data[4 * i + 1] >> 3) << 5) | ((picture.data[4 * i + 2] >> 3) << 10));
      }
      if (depth < -2) {
        ++outside;
        if (isDrawn) ++stray;
      }
    }
  assert.ok(inside > 10_000, `only ${inside} pixels are within the outline`);
  assert.ok(hit / inside > 0.999, `${hit} of ${inside} pixels within the outline are drawn`);
  assert.equal(stray, 0, `${stray} of ${outside} pixels outside are not background`);
  assert.ok(colours.size > 40, `only ${colours.size} colours`);
  const bytes = statSync(report("tank_treading")).size;
  assert.ok(bytes <= mostBytes, `${bytes} bytes`);
  t.diagnostic(`${bytes} bytes; first frame after ${await page.evaluate(() => document.documentElement.dataset.firstFrame)} ms`);
  await page.getByLabel("Box", { exact: true }).check();
  await page.screenshot({ path: `${folder}/desktop.png` });
  assert.deepEqual(faults, []);
  await page.close();
});

test("the inclination of what is drawn is that of the summary", async () => {
  const { page, faults } = await open(browser, report("tank_treading"));
  await choose(page, "View", "along y");
  const points = await projected(page, 0);
  // Direction of the farthest two points, from the left to the right.
  let best = [0, 0, 0];
  for (const p of points) for (const q of points) if (Math.hypot(q[0] - p[0], q[1] - p[1]) > best[0]) best = [Math.hypot(q[0] - p[0], q[1] - p[1]), q[0] - p[0], p[1] - q[1]];
  const angle = (Math.atan(best[2] / best[1]) * 180) / Math.PI;
  assert.ok(Math.abs(angle - summaryOf("tank_treading").vesicles[0].inclination_angle_deg) < 2.5, String(angle));
  assert.deepEqual(faults, []);
  await page.close();
});

test("the bending energy of the curvature that is drawn is that of the summary", async () => {
  const { page, faults } = await open(browser, report("tank_treading"));
  await choose(page, "Colour", "mean_curvature");
  const energy = await page.evaluate(() => {
    const { geometry } = globalThis.vesiflow.view.meshes.vesicles[0];
    const p = geometry.attributes.position.array;
    const curvature = geometry.attributes.value.array;
    const index = geometry.index.array;
    let sum = 0;
    for (let k = 0; k < index.length; k += 3) {
      const [a, b, c] = [0, 1, 2].map((d) => [...p.slice(3 * index[k + d], 3 * index[k + d] + 3)]);
      const [e, f] = [b, c].map((q) => q.map((x, d) => x - a[d]));
      const area = Math.hypot(e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]) / 2;
      const mean = (curvature[index[k]] + curvature[index[k + 1]] + curvature[index[k + 2]]) / 3;
      sum += 0.5 * mean ** 2 * area;
    }
    return sum;
  });
  assert.ok(Math.abs(energy / summaryOf("tank_treading").vesicles[0].bending_energy - 1) < 5e-3, String(energy));
  assert.deepEqual(faults, []);
  await page.close();
});

test("numbers on the page are those of summary.json", async () => {
  const { page, faults } = await open(browser, report("tank_treading"));
  const summary = summaryOf("tank_treading");
  const text = (selector) => page.locator(selector).innerText();
  for (const name of ["inclination_angle_deg", "tank_treading_frequency", "reduced_volume", "bending_energy", "tension_max"])
    assert.equal(Number(await text(`#results tr[data-name="${name}"] td`)), Number(summary.vesicles[0][name].toPrecision(5)), name);
  for (const name of ["local_area", "courant_number"])
    assert.equal(Number(await text(`#trust tr[data-name="${name}"] td:nth-child(2)`)), Number(summary.largest_errors[name].toPrecision(5)), name);
  assert.equal(await text("#status"), summary.status);
  // The plot's value at the last frame is that of the end.
  assert.equal(Number(await text('.chart[data-name="inclination_angle_deg"] output')), Number(summary.vesicles[0].inclination_angle_deg.toPrecision(4)));
  assert.match(await text("#repeat"), new RegExp(summary.git_revision));
  assert.deepEqual(faults, []);
  await page.close();
});

test("scrubbing, playing, keys", async () => {
  const { page, faults } = await open(browser, report("tank_treading"));
  const frame = () => page.evaluate(() => globalThis.vesiflow.clock.frame);
  const clock = page.locator(".clock");
  const last = await frame();
  assert.equal(last, 16);
  const end = await pictureOfView(page);
  await page.getByLabel("time", { exact: true }).fill("0");
  assert.equal(await clock.innerText(), "t = 0");
  assert.equal(await page.locator('.chart[data-name="inclination_angle_deg"] output').innerText(), "90");
  const start = await pictureOfView(page);
  let changed = 0;
  for (let i = 0; i < end.width * end.height; ++i) if (apart(start.data, i, end.data) > 20) ++changed;
  assert.ok(changed > 5000, `${changed} pixels differ`);
  await page.locator("h1").click();
  await page.keyboard.press("ArrowRight");
  assert.equal(await frame(), 1);
  assert.equal(await clock.innerText(), "t = 0.5");
  await page.keyboard.press("ArrowLeft");
  assert.equal(await frame(), 0);
  await page.keyboard.press("Space");
  await page.waitForFunction(() => globalThis.vesiflow.clock.frame > 1);
  assert.equal(await page.locator("button.main").innerText(), "Pause");
  await page.keyboard.press("Space");
  const stopped = await frame();
  await page.waitForTimeout(600);
  assert.equal(await frame(), stopped);
  // A click into a plot shows the frame of that time.
  await page.locator(".chart .u-over").first().click();
  assert.equal(await clock.innerText(), "t = 4");
  assert.deepEqual(faults, []);
  await page.close();
});

test("every part can be reached by the keyboard, and one sees where one is", async () => {
  const { page, faults } = await open(browser, report("tank_treading"));
  const seen = [];
  for (let k = 0; k < 22; ++k) {
    await page.keyboard.press("Tab");
    seen.push(
      await page.evaluate(() => {
        const focus = document.activeElement;
        const outline = getComputedStyle(focus);
        const name = focus.getAttribute("aria-label") ?? focus.closest("label")?.innerText.trim().split("\n")[0] ?? focus.innerText.split("\n")[0];
        return { name, isVisible: outline.outlineStyle !== "none" && parseFloat(outline.outlineWidth) >= 2 };
      }),
    );
  }
  const names = seen.map(({ name }) => name);
  for (const part of ["Play", "time", "Mesh lines", "Streamlines", "Box", "Fit vesicles", "Fit box", "PNG", "motion", "errors", "all"])
    assert.ok(names.includes(part), `${part} is not among ${names.join(", ")}`);
  assert.ok(names[0].startsWith("1 membrane at time 8, coloured by tension"), names[0]);
  assert.ok(seen.every(({ isVisible }) => isVisible), JSON.stringify(seen.filter(({ isVisible }) => !isVisible)));
  assert.deepEqual(faults, []);
  await page.close();
});

test("colours, mesh lines, fluid", async () => {
  const { page, faults } = await open(browser, report("tank_treading"), { colorScheme: "dark" });
  let before = await pictureOfView(page);
  const differs = async (least, what) => {
    const now = await pictureOfView(page);
    let changed = 0;
    for (let i = 0; i < now.width * now.height; ++i) if (apart(now.data, i, before.data) > 10) ++changed;
    assert.ok(changed > least, `${what}: ${changed} pixels differ`);
    before = now;
  };
  const title = page.locator(".scale").first().locator("div").first();
  for (const [name, label] of [["mean_curvature", "mean curvature (1/r)"], ["local_area_error", "local area error (relative)"], ["speed", "speed (r / time)"]]) {
    await choose(page, "Colour", name);
    assert.equal(await title.innerText(), label);
    await differs(3000, name);
  }
  // The mean curvature of what is drawn: its mean over the poles' axis is about that of a sphere of the same volume.
  await page.getByLabel("Mesh lines", { exact: true }).check();
  await differs(1500, "lines");
  await choose(page, "Fluid", "speed");
  await differs(100_000, "speed");
  await page.getByLabel("Streamlines", { exact: true }).check();
  await differs(3000, "streamlines");
  await page.screenshot({ path: `${folder}/dark.png` });
  await choose(page, "Fluid", "pressure");
  await differs(100_000, "pressure");
  await choose(page, "Plane", "1");
  await differs(50_000, "plane");
  assert.deepEqual(faults, []);
  await page.close();
});

test("the fluid far from the vesicle is the shear flow of the scene", async () => {
  const { page } = await open(browser, report("tank_treading"));
  const { z, u } = await page.evaluate(() => {
    const { fluid } = globalThis.vesiflow.data;
    const plane = fluid.planes.find(({ axis }) => axis === 1);
    const [first] = plane.velocity(fluid.times.length - 1);
    const rows = [...Array(plane.points[1]).keys()];
    return {
      z: rows.map((j) => plane.lower[1] + ((j + 0.5) * (plane.upper[1] - plane.lower[1])) / plane.points[1]),
      u: rows.map((j) => first[j * plane.points[0] + 2]),
    };
  });
  z.forEach((height, j) => assert.ok(Math.abs(u[j] - height) < 0.12, `u(${height}) = ${u[j]}`));
  await page.close();
});

test("what is saved is what the run wrote", async () => {
  const { page, faults } = await open(browser, report("tank_treading"));
  const saved = async (name) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name, exact: true }).click()]);
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  };
  assert.equal((await saved("diagnostics.csv")).bytes.toString(), readFileSync(`${folder}/tank_treading/diagnostics.csv`, "utf8"));
  assert.equal((await saved("scene.toml")).bytes.toString(), readFileSync(`${folder}/tank_treading/scene.toml`, "utf8"));
  assert.deepEqual(JSON.parse((await saved("summary.json")).bytes.toString()), summaryOf("tank_treading"));
  const picture = await saved("PNG");
  assert.match(picture.name, /^tank_treading_t8\.png$/);
  const { width, data } = await pixels(browser, picture.bytes);
  assert.ok(width > 600);
  let drawn = 0;
  for (let i = 0; i < data.length / 4; ++i) if (apart(data, i, data, 20) > 30) ++drawn;
  assert.ok(drawn > 10_000);
  assert.deepEqual(faults, []);
  await page.close();
});

test("eight vesicles: each is drawn inside the box, of its volume", async (t) => {
  const { page, faults } = await open(browser, report("eight"));
  const summary = summaryOf("eight");
  const { box } = await page.evaluate(() => globalThis.vesiflow.data);
  for (let v = 0; v < 8; ++v) {
    const { volume } = await measured(page, v);
    assert.ok(Math.abs(volume / summary.vesicles[v].volume - 1) < 6e-3, `${v}: ${volume}`);
    const centre = await page.evaluate((n) => {
      const { centre: c, shift } = globalThis.vesiflow.view.meshes.vesicles[n];
      return c.map((x, d) => x + shift[d]);
    }, v);
    centre.forEach((x, d) => assert.ok(x >= box.lower[d] && x <= box.upper[d], `${v}: ${centre}`));
    // Modulo the periods the centroid of the summary, which is one of the volume.
    centre.forEach((x, d) => {
      const period = box.periodic[d] ? box.upper[d] - box.lower[d] : Infinity;
      const off = Math.abs(x - summary.vesicles[v].centroid[d]);
      const rest = Number.isFinite(period) ? Math.min(off % period, period - (off % period)) : off;
      assert.ok(rest < 0.05, `${v}: ${centre} ${summary.vesicles[v].centroid}`);
    });
  }
  assert.equal(await page.locator(".chart").first().locator("canvas").count(), 1);
  assert.equal(await page.locator(".legend span").count(), 9);
  const bytes = statSync(report("eight")).size;
  assert.ok(bytes <= mostBytes, `${bytes} bytes`);
  t.diagnostic(`${bytes} bytes; first frame after ${await page.evaluate(() => document.documentElement.dataset.firstFrame)} ms`);
  await page.screenshot({ path: `${folder}/eight.png` });
  assert.deepEqual(faults, []);
  await page.close();
});

test("a run that blew up: its page says so, shows the end, and is not taken over by its title", async () => {
  const { page, faults } = await open(browser, report("blow_up"));
  assert.equal(await page.locator("#status").innerText(), "stopped");
  assert.match(await page.locator(".stopped").innerText(), /likely cause/);
  assert.match(await page.title(), /^blow_up – Vesiflow report$/);
  assert.match(await page.locator("h1").innerText(), /<\/script><script>/);
  const picture = await pictureOfView(page);
  let drawn = 0;
  for (let i = 0; i < picture.width * picture.height; ++i) if (apart(picture.data, i, picture.data, 20 * picture.width + 20) > 30) ++drawn;
  assert.ok(drawn > 10_000);
  assert.deepEqual(faults, []);
  await page.close();
});

test("on a phone nothing is wider than the screen", async () => {
  for (const run of ["tank_treading", "eight", "blow_up"]) {
    const { page, faults } = await open(browser, report(run), { width: 390, height: 844 });
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390, run);
    const stage = await page.locator(".stage").boundingBox();
    assert.ok(stage.width > 300 && stage.height > 300);
    if (run === "tank_treading") await page.screenshot({ path: `${folder}/phone.png` });
    assert.deepEqual(faults, []);
    await page.close();
  }
});

test("without WebGL the page says so and shows cuts", async () => {
  const plain = await launch({ webgl: false });
  try {
    const { page } = await open(plain, report("tank_treading"));
    assert.match(await page.locator("#viewer .message").innerText(), /no WebGL 2/);
    assert.ok(await page.locator("#outlines svg").first().isVisible());
    assert.ok(await page.locator("#charts canvas").first().isVisible());
    await page.close();
  } finally {
    await plain.close();
  }
});

test("without JavaScript the page has cuts, plots and tables", async () => {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  await page.goto(`file://${report("tank_treading")}`);
  assert.ok(await page.locator("#outlines svg").first().isVisible());
  assert.ok(await page.locator("#static-plots svg").first().isVisible());
  assert.ok(await page.locator("#results table").isVisible());
  await context.close();
});
