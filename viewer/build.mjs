// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// Makes dist/viewer.js, the one script of a report, with the licences of what is in it.
import { build } from "esbuild";
import { readFileSync } from "node:fs";

const licences = ["three", "uplot"].map((name) => `${name}: ${readFileSync(`node_modules/${name}/LICENSE`, "utf8").trim().replaceAll("\u00a9", "(c)")}`);

await build({
  entryPoints: ["src/main.js"],
  outfile: "dist/viewer.js",
  bundle: true,
  minify: true,
  format: "iife",
  target: ["chrome111", "firefox113", "safari16.4"],
  charset: "ascii",
  loader: { ".css": "text" },
  legalComments: "none",
  footer: { js: `/*! Licences of what is in this script.\n\n${licences.join("\n\n")}\n*/` },
});
