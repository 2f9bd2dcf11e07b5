// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
// Maps from a number in [0, 1] to a colour, computed in OKLab (B. Ottosson, "A perceptual color space for image processing", 2020).
// Their lightness is monotone, or has its peak in the middle, so that they are read with any colour vision and in grey.

const linearFromOklab = (L, a, b) => {
  const l = (L + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (L - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (L - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
};

const encoded = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);

/** sRGB in [0, 255] of lightness, chroma and hue in degrees; with less chroma where a screen has not that much. */
export function colourOf(L, chroma, hue) {
  const angle = (hue * Math.PI) / 180;
  for (let share = 1; ; share -= 0.02) {
    const rgb = linearFromOklab(L, share * chroma * Math.cos(angle), share * chroma * Math.sin(angle));
    if (share <= 0.02 || rgb.every((c) => c >= -1e-4 && c <= 1.0001))
      return rgb.map((c) => Math.round(255 * encoded(Math.min(1, Math.max(0, c)))));
  }
}

// From dark violet over teal to light yellow.
const sequential = (x) => colourOf(0.28 + 0.64 * x, 0.098 + 0.06 * (2 * x - 1) ** 2, 305 - 200 * x);

// Blue below the middle, orange above it.
const diverging = (x) => {
  const away = Math.abs(2 * x - 1);
  return colourOf(0.95 - 0.5 * away, 0.2 * away ** 0.9, x < 0.5 ? 255 : 45);
};

/** A map as 256 colours of four bytes. */
function tableOf(map) {
  const table = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) table.set([...map(i / 255), 255], 4 * i);
  return table;
}

export const tables = { sequential: tableOf(sequential), diverging: tableOf(diverging) };

/** Whether dark lines are better to be seen on the colour of x. */
export function isLight(name, x) {
  const i = 4 * Math.round(255 * Math.min(1, Math.max(0, x)));
  const [r, g, b] = tables[name].subarray(i, i + 3);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b > 135;
}

/** How a field is coloured: the map and the values at its ends. A field on both sides of zero is shown about zero. */
export function scaleOf(low, high) {
  const largest = Math.max(Math.abs(low), Math.abs(high));
  if (!(high > low) || high - low < 1e-6 * largest) {
    const half = Math.max(0.01 * largest, 1e-12);
    return { map: "sequential", low: low - half, high: high + half };
  }
  if (low < -0.25 * largest && high > 0.25 * largest) return { map: "diverging", low: -largest, high: largest };
  return { map: "sequential", low, high };
}

/** Draws the map into a canvas, from left to right. */
export function drawTable(canvas, name) {
  canvas.width = 256;
  canvas.height = 1;
  const context = canvas.getContext("2d");
  const image = context.createImageData(256, 1);
  image.data.set(tables[name]);
  context.putImageData(image, 0, 0);
}
