// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause

const steps = { ArrowLeft: -1, ArrowRight: 1, ArrowDown: -1, ArrowUp: 1, PageDown: -10, PageUp: 10 };

/** Keys of the whole page: arrows step, space plays, unless what has the focus has a use of its own for them. */
export function listenToKeys(clock) {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const focus = event.target;
    if (focus.matches?.("select, textarea, input:not([type=range]), pre, summary")) return;
    const isOnControl = focus.matches?.("button, input");
    const isOnView = focus.closest?.(".stage, .controls.time") !== null && focus.closest !== undefined;
    if (event.key === " " && !isOnControl) clock.toggle();
    else if (["ArrowLeft", "ArrowRight"].includes(event.key) || (isOnView && event.key in steps)) clock.show(clock.frame + steps[event.key]);
    else if (isOnView && event.key === "Home") clock.show(0);
    else if (isOnView && event.key === "End") clock.show(clock.last);
    else return;
    event.preventDefault();
  });
}
