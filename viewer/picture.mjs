// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// Takes a picture of a report in headless Chromium, as PNG or, by its name, JPEG:
//   node viewer/picture.mjs out/tank_treading_coarse/report.html picture.png [--width N] [--height N] [--dark] [--view] [--CHOICE VALUE ...]
// CHOICE is one of field, lines, box, plane, fluid, streamlines (of the view, with the values of viewer/src/view.js), frame, look (a name of
// its directions), fit (vesicles or box) and zoom (a factor). --view takes the view alone, without the page around it.
import { launch, open } from "./test/browser.mjs";

const [report, picture, ...options] = process.argv.slice(2);
const chosen = {};
while (options.length > 0) {
  const name = options.shift().replace(/^--/, "");
  chosen[name] = options.length === 0 || options[0].startsWith("--") ? true : options.shift();
}
if (!report || !picture) {
  console.error("usage: node viewer/picture.mjs REPORT PICTURE [--width N] [--height N] [--dark] [--view] [--CHOICE VALUE ...]");
  process.exit(2);
}

const { width = 1280, height = 900, dark, view, ...choices } = chosen;
const browser = await launch();
try {
  const { page, faults } = await open(browser, report, { width: Number(width), height: Number(height), colorScheme: dark ? "dark" : "light" });
  await page.evaluate(({ choices: all, alone }) => {
    const { view: shown, clock } = globalThis.vesiflow;
    if (alone) {
      document.body.replaceChildren(shown.element);
      Object.assign(document.body.style, { margin: 0, overflow: "hidden" });
      Object.assign(shown.element.style, { height: "100vh", borderRadius: 0 });
      shown.stage.resize();
    }
    const { frame, look, fit, zoom, ...rest } = all;
    for (const [name, value] of Object.entries(rest)) shown.choose(name, value === "false" ? false : name === "plane" ? Number(value) : value);
    shown.fit(fit, look);
    if (zoom) {
      shown.stage.camera.zoom = Number(zoom);
      shown.stage.camera.updateProjectionMatrix();
    }
    if (frame !== undefined) clock.show(Number(frame));
    shown.stage.render();
  }, { choices, alone: Boolean(view) });
  await page.waitForTimeout(300);
  const isJpeg = /\.jpe?g$/.test(picture);
  await page.screenshot({ path: picture, type: isJpeg ? "jpeg" : "png", ...(isJpeg ? { quality: 88 } : {}) });
  if (faults.length > 0) throw new Error(faults.join("\n"));
} finally {
  await browser.close();
}
