// Pixels from values: sRGB, false colours. All paint into the bytes of an ImageData.
import {HALF_VALUES} from './data.js';

/** What no number stands for: NaN and infinities. */
export const NOT_FINITE = [255, 0, 255];

/** sRGB code 0..255 of a linear value, IEC 61966-2-1. */
export function srgbCode(linear) {
  if (!(linear > 0)) return 0;
  const code =
    linear <= 0.0031308 ? 12.92 * linear : 1.055 * Math.min(linear, 1) ** (1 / 2.4) - 0.055;
  return Math.round(255 * Math.min(code, 1));
}

/** Codes of all halves at an exposure in stops; -1 where there is no finite value. */
function codesOfHalves(exposure) {
  const gain = 2 ** exposure;
  return Int16Array.from(HALF_VALUES, (value) =>
    Number.isFinite(value) ? srgbCode(value * gain) : -1,
  );
}

export function paintColour(image, exposure, bytes) {
  const codes = codesOfHalves(exposure);
  const [red, green, blue] = image.planes;
  for (let i = 0, at = 0; i < red.length; i += 1, at += 4) {
    const r = codes[red[i]];
    const g = codes[green[i]];
    const b = codes[blue[i]];
    if (r < 0 || g < 0 || b < 0) putPixel(bytes, at, NOT_FINITE[0], NOT_FINITE[1], NOT_FINITE[2]);
    else putPixel(bytes, at, r, g, b);
  }
}

function putPixel(bytes, at, r, g, b) {
  bytes[at] = r;
  bytes[at + 1] = g;
  bytes[at + 2] = b;
  bytes[at + 3] = 255;
}

/** A ramp through evenly spaced colours as a function of [0, 1]. */
function ramp(stops) {
  const table = Array.from({length: 1024}, (_, i) => {
    const place = (i / 1023) * (stops.length - 1);
    const from = Math.min(Math.floor(place), stops.length - 2);
    return stops[from].map((value, c) =>
      Math.round(value + (stops[from + 1][c] - value) * (place - from)),
    );
  });
  return (position) => table[Math.round(1023 * Math.min(Math.max(position, 0), 1))];
}

/** Black over purple and orange to pale yellow, as the renderer's heat maps; L* rises evenly. */
export const HEAT = ramp([
  [0, 0, 0],
  [51, 18, 107],
  [133, 33, 115],
  [214, 71, 66],
  [247, 140, 26],
  [250, 204, 64],
  [255, 255, 184],
]);
/** Black at zero; below it blue to pale cyan, above it red to pale yellow. */
export const SIGNED = ramp([
  [190, 245, 255],
  [60, 160, 245],
  [25, 70, 170],
  [0, 0, 0],
  [165, 45, 25],
  [245, 135, 30],
  [255, 240, 170],
]);

/**
 * Errors of `image` against `reference`, a number a pixel; NaN where either is not finite.
 * signed: mean over R, G, B of (a - b) / sqrt(b^2 + 0.01). absolute: root of the mean of the squares
 * of these, so that the mean of its square over the picture is the relMSE.
 */
export function relativeErrors(image, reference, kind) {
  const length = image.width * image.height;
  const errors = new Float32Array(length);
  for (let i = 0; i < length; i += 1) {
    let sum = 0;
    for (let c = 0; c < 3; c += 1) {
      const b = HALF_VALUES[reference.planes[c][i]];
      const error = (HALF_VALUES[image.planes[c][i]] - b) / Math.sqrt(b * b + 0.01);
      sum += kind === 'signed' ? error : error * error;
    }
    errors[i] = kind === 'signed' ? sum / 3 : Math.sqrt(sum / 3);
  }
  return errors;
}

/** Scalars through `position` (value -> [0, 1]) and a ramp. */
export function paintScalar(values, position, colours, bytes) {
  for (let i = 0; i < values.length; i += 1) {
    const [r, g, b] = Number.isFinite(values[i]) ? colours(position(values[i])) : NOT_FINITE;
    putPixel(bytes, 4 * i, r, g, b);
  }
}

/** Where the lowest value above zero is on the ramp of a heat map, to be told from zero. */
export const HEAT_FLOOR = 0.08;

/** The scale of heat maps: {lowest above zero, highest, mean} over the finite values of all. */
export function heatScale(maps) {
  let [lowest, highest, sum, number] = [Infinity, 0, 0, 0];
  for (const map of maps) {
    for (const value of map.values) {
      if (!Number.isFinite(value)) continue;
      if (value > 0 && value < lowest) lowest = value;
      if (value > highest) highest = value;
      sum += value;
      number += 1;
    }
  }
  return {lowest: Math.min(lowest, highest), highest, mean: number ? sum / number : 0};
}

/** Position on the ramp: zero is 0, then the logarithm from HEAT_FLOOR to 1. */
export function heatPosition({lowest, highest}) {
  const span = Math.log(highest / lowest);
  return (value) => {
    if (!(value > 0)) return 0;
    return span > 0 ? HEAT_FLOOR + ((1 - HEAT_FLOOR) * Math.log(value / lowest)) / span : 1;
  };
}
