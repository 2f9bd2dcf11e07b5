// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// A run under way, in the browser: what comes is shown, and what the reader has chosen stays.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdirSync, rmSync } from "node:fs";
import { request } from "node:http";
import { test } from "node:test";
import { launch, open } from "./browser.mjs";

const { REPORTS: folder, APPS: apps } = process.env;

const textOf = (address, headers) =>
  new Promise((done, fail) => {
    request(address, { headers }, (answer) => {
      let text = "";
      answer.on("data", (part) => (text += part));
      answer.on("end", () => done({ status: answer.statusCode, text }));
    })
      .on("error", fail)
      .end();
  });

const until = async (what, seconds = 60) => {
  for (const end = Date.now() + 1000 * seconds; Date.now() < end; await new Promise((done) => setTimeout(done, 200))) if (await what()) return;
  throw new Error(`not within ${seconds} s: ${what}`);
};

test("a run under way is shown as it goes on", async () => {
  const run = `${folder}/live`;
  rmSync(run, { recursive: true, force: true });
  mkdirSync(run, { recursive: true });
  const server = spawn("python3", ["../python/vesiflow/view.py", run, "--port", "0"], { env: { ...process.env, VESIFLOW_APPS: apps } });
  const browser = await launch();
  let simulation;
  try {
    const address = await new Promise((done, fail) => {
      let said = "";
      const listen = (text) => {
        said += text;
        const found = /http:\S+(?= )/.exec(said);
        if (found) done(found[0]);
      };
      server.stdout.on("data", listen);
      server.stderr.on("data", (text) => (said += text));
      server.on("exit", () => fail(new Error(`the server has ended: ${said}`)));
    });
    assert.match((await textOf(address)).text, /nothing to see yet/);
    assert.equal((await textOf(address, { Host: "evil.example" })).status, 403);
    assert.equal((await textOf(`${address}summary.json`)).status, 404);

    const scene = ["../scenes/tank_treading_coarse.toml", "--out", run, "--quiet", "--threads", "1", "--set", "time.end=1000"];
    simulation = spawn(`${apps}/shear_flow`, [...scene, "--set", "output.vesicle_every=1/24", "--set", "output.fluid_every=1", "--set", "output.checkpoint_every=0.1", "--set", "domain.cells=32"]);
    await until(async () => /id="report-data"/.test((await textOf(address)).text));
    const { page, faults } = await open(browser, "", { address });
    const frames = () => page.evaluate(() => globalThis.vesiflow.clock.times.length);
    const first = await frames();
    assert.equal(await page.locator("#status").innerText(), "running");
    await page.getByLabel("Colour", { exact: true }).selectOption("mean_curvature");
    await until(async () => (await frames()) > first + 2);
    assert.ok(await page.evaluate(() => globalThis.vesiflow.clock.frame === globalThis.vesiflow.clock.last)); // follows the end
    assert.equal(await page.locator(".scale div").first().innerText(), "mean curvature (1/r)");
    await page.getByLabel("time", { exact: true }).fill("1");
    const seen = await frames();
    simulation.kill("SIGINT");
    await until(async () => (await page.locator("#status").innerText()) === "interrupted");
    assert.equal(await page.evaluate(() => globalThis.vesiflow.clock.frame), 1); // stays where the reader is
    assert.ok((await frames()) >= seen);
    assert.deepEqual(faults, []);
  } finally {
    simulation?.kill("SIGKILL");
    server.kill();
    await browser.close();
  }
});
