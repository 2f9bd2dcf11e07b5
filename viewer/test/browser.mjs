// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// Opens pages in headless Chromium, and keeps account of what they print and ask for.
import { chromium } from "playwright-core";
import { existsSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const executablePath = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find((path) => path && existsSync(path));

// WebGL by software: machines that test have no graphics.
const withWebGl = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const withoutWebGl = ["--disable-gpu", "--disable-3d-apis"];

export async function launch({ webgl = true } = {}) {
  if (!executablePath) throw new Error("no Chromium: apt-get install --no-install-recommends chromium, or name it in CHROMIUM");
  return chromium.launch({ executablePath, args: ["--no-sandbox", ...(webgl ? withWebGl : withoutWebGl)] });
}

/** Opens a report. `faults` gathers errors and what would have gone over a network. */
export async function open(browser, file, { width = 1280, height = 900, colorScheme = "light", address } = {}) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme, acceptDownloads: true });
  const faults = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && faults.push(message.text()));
  page.on("pageerror", (error) => faults.push(error.message));
  page.on("request", (request) => {
    const to = new URL(request.url());
    if (!["file:", "blob:", "data:"].includes(to.protocol) && !(address && to.href.startsWith(address))) faults.push(`asks for ${to.href}`);
  });
  await page.goto(address ?? pathToFileURL(resolve(file)).href);
  await page.waitForFunction(() => globalThis.vesiflow !== undefined || document.querySelector("#viewer .message"), null, { timeout: 30_000 });
  return { page, faults };
}

/** The pixels of a picture as PNG: width, height, and four bytes each. By a page of its own, which no policy of a report concerns. */
export async function pixels(browser, png) {
  const page = await browser.newPage();
  const result = await page.evaluate(async (source) => {
    const image = new Image();
    image.src = source;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = image.width;
    canvas.height = image.height;
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    let text = "";
    for (let i = 0; i < data.length; i += 8192) text += String.fromCharCode(...data.subarray(i, i + 8192));
    return { width: image.width, height: image.height, text: btoa(text) };
  }, `data:image/png;base64,${png.toString("base64")}`);
  await page.close();
  return { width: result.width, height: result.height, data: Buffer.from(result.text, "base64") };
}

/** Largest difference of a colour's three parts. */
export const apart = (a, i, b, j = i) => Math.max(...[0, 1, 2].map((c) => Math.abs(a[4 * i + c] - b[4 * j + c])));
