// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// Brings a report to life. What fails leaves the part of the page that it would have replaced.
import { Charts } from "./charts.js";
import { Clock } from "./clock.js";
import { readData } from "./data.js";
import { downloadButtons } from "./downloads.js";
import { make } from "./elements.js";
import { listenToKeys } from "./keys.js";
import { listenToServer, takeTexts } from "./live.js";
import { View } from "./view.js";

const root = document.documentElement;

function hasWebGl() {
  return Boolean(document.createElement("canvas").getContext("webgl2"));
}

function say(place, text) {
  place.replaceChildren(make("p", { class: "message", role: "status" }, text));
}

function startView(data, clock) {
  const place = document.getElementById("viewer");
  if (data.membranes.frames === 0) return null;
  if (!hasWebGl()) {
    say(place, "This browser has no WebGL 2, so the membranes cannot be turned; what follows are cuts through them.");
    return null;
  }
  const view = new View(place, data, clock);
  view.stage.render();
  root.classList.add("has-view");
  root.dataset.firstFrame = performance.now().toFixed(0);
  return view;
}

function startCharts(data, clock) {
  if (data.rows.vesicles.length === 0) return null;
  const charts = new Charts(document.getElementById("charts"), data, clock);
  root.classList.add("has-charts");
  return charts;
}

function start() {
  let data = readData(document);
  const clock = new Clock(data.membranes.frames > 0 ? data.membranes.times : (data.rows.vesicles[0]?.time ?? []));
  clock.frame = clock.last;
  let view = startView(data, clock);
  let charts = startCharts(data, clock);
  listenToKeys(clock);
  document.getElementById("repeat")?.append(downloadButtons(data));
  // For tests and for whoever writes scripts for a page.
  globalThis.vesiflow = { get data() { return data; }, clock, get view() { return view; }, get charts() { return charts; } };
  if (!data.live) return;
  listenToServer((page) => {
    const wasAtEnd = clock.frame === clock.last;
    const hadView = view !== null;
    takeTexts(page);
    data = readData(page);
    document.getElementById("repeat")?.append(downloadButtons(data));
    clock.times = data.membranes.frames > 0 ? data.membranes.times : (data.rows.vesicles[0]?.time ?? []);
    clock.frame = wasAtEnd ? clock.last : Math.min(clock.frame, clock.last);
    if (hadView && data.membranes.frames > 0) view.setData(data);
    else view ??= startView(data, clock);
    if (charts) charts.setData(data);
    else charts = startCharts(data, clock);
    clock.tell();
  });
}

try {
  start();
} catch (error) {
  console.error(error);
  say(document.getElementById("viewer"), `The viewer could not start: ${error.message}. What follows are cuts through the membranes.`);
}
