// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// Which frame is shown, and playing them as a film; whoever wants to know is told.

const filmSeconds = 6;
const slowest = 4; // frames in a second
const fastest = 30;

export class Clock {
  constructor(times) {
    this.times = times;
    this.frame = 0;
    this.isPlaying = false;
    this.listeners = [];
  }

  onChange(listener) {
    this.listeners.push(listener);
  }
  get time() {
    return this.times[this.frame] ?? 0;
  }
  get last() {
    return Math.max(0, this.times.length - 1);
  }

  show(frame) {
    const wanted = Math.min(this.last, Math.max(0, Math.round(frame)));
    if (wanted === this.frame) return;
    this.frame = wanted;
    this.tell();
  }

  /** The frame nearest to a time. */
  showTime(time) {
    let best = 0;
    this.times.forEach((t, f) => {
      if (Math.abs(t - time) < Math.abs(this.times[best] - time)) best = f;
    });
    this.show(best);
  }

  toggle() {
    this.isPlaying = !this.isPlaying && this.times.length > 1;
    if (this.isPlaying) {
      if (this.frame === this.last) this.frame = 0;
      this.previous = undefined;
      requestAnimationFrame((now) => this.turn(now));
    }
    this.tell();
  }

  turn(now) {
    if (!this.isPlaying) return;
    const rate = Math.min(fastest, Math.max(slowest, this.times.length / filmSeconds));
    this.previous ??= now;
    const steps = Math.floor(((now - this.previous) * rate) / 1000);
    if (steps > 0) {
      this.previous += (steps * 1000) / rate;
      this.frame = (this.frame + steps) % this.times.length;
      this.tell();
    }
    requestAnimationFrame((next) => this.turn(next));
  }

  tell() {
    for (const listener of this.listeners) listener(this);
  }
}
