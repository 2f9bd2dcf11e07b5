// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
import { make } from "./elements.js";

/** Lets the browser store what was made in the page. */
export function save(blob, name) {
  const address = URL.createObjectURL(blob);
  const link = make("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** Buttons for what the page holds as text. */
export function downloadButtons(data) {
  const files = [
    ["diagnostics.csv", data.diagnostics, "text/csv"],
    ["scene.toml", data.scene, "text/plain"],
    ["summary.json", JSON.stringify(data.summary, null, 2), "application/json"],
  ];
  const buttons = files
    .filter(([, text]) => text && text !== "{}")
    .map(([name, text, type]) => make("button", { type: "button", onclick: () => save(new Blob([text], { type }), name) }, name));
  return make("div", { class: "controls", id: "downloads" }, make("span", {}, "Save:"), ...buttons);
}
