// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// Of a run under way: the server on this machine is asked whether there is a newer page, whose data and tables then take the place of these.

const seconds = 2;

/** Calls `update` with the document of each newer page. */
export function listenToServer(update) {
  let version = null;
  const ask = async () => {
    try {
      const answer = await fetch("version", { cache: "no-store" });
      const now = answer.ok ? await answer.text() : version;
      if (version !== null && now !== version) {
        const page = await (await fetch("./", { cache: "no-store" })).text();
        update(new DOMParser().parseFromString(page, "text/html"));
      }
      version = now;
    } catch {
      // The server has ended; what the page has stays.
    }
    setTimeout(ask, 1000 * seconds);
  };
  ask();
}

/** Takes over what the page says in words. The view and the plots stay, with what the reader has chosen. */
export function takeTexts(page) {
  for (const id of ["results", "trust", "phases", "scene", "repeat", "about"]) {
    const [old, fresh] = [document.getElementById(id), page.getElementById(id)];
    if (!old || !fresh) continue;
    const areOpen = [...old.querySelectorAll("details")].map((part) => part.open);
    old.replaceChildren(...fresh.childNodes);
    old.querySelectorAll("details").forEach((part, k) => (part.open = areOpen[k] ?? false));
  }
  document.querySelector("header").replaceChildren(...page.querySelector("header").childNodes);
}
