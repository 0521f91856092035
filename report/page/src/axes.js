// Logarithmic axes that keep a place for zero.
import {extent} from 'd3-array';
import {axisBottom, axisLeft} from 'd3-axis';
import {scaleLog} from 'd3-scale';
import {select} from 'd3-selection';
import {count, significant} from './format.js';

const GUTTER = 26; // pixels at the low end for values that are zero
const ZERO = 8; // pixels from the low end to those

/** Whether a value has a place on an axis; unknown and negative ones have none. */
export const hasPlace = (value) => typeof value === 'number' && value >= 0;

/**
 * A scale for the values of `of` in `runs`, all of which have a place, from pixel `low` to pixel
 * `high`: {place(run), scale, zero: whether some value is 0, low, of}.
 */
export function logScale(runs, of, low, high) {
  const values = runs.map((run) => run[of.key]);
  const positive = values.filter((value) => value > 0).map((value) => value * of.scale);
  const zero = positive.length < values.length;
  const start = low + (zero ? GUTTER * Math.sign(high - low) : 0);
  const scale = scaleLog().domain(padded(positive)).range([start, high]);
  const place = (run) =>
    run[of.key] === 0 ? low + ZERO * Math.sign(high - low) : scale(run[of.key] * of.scale);
  return {place, scale, zero, low, of};
}

/** A tenth of the span around the values, and no less than a factor of 1.5 in all. */
function padded(values) {
  if (values.length === 0) return [0.1, 10];
  const [lowest, highest] = extent(values);
  const margin = Math.max((highest / lowest) ** 0.06, 1.22);
  return [lowest / margin, highest * margin];
}

/** Ticks worth a label: 1, 2, 5 of each decade, or 1 alone over many decades. */
function labelled(scale) {
  const [lowest, highest] = scale.domain();
  const decades = Math.log10(highest / lowest);
  const mantissas = decades > 3.2 ? [1] : decades > 1.7 ? [1, 3] : decades > 0.7 ? [1, 2, 5] : null;
  if (!mantissas) return scale.copy().ticks(6);
  const ticks = [];
  for (let power = Math.floor(Math.log10(lowest)); power <= Math.log10(highest); power += 1) {
    for (const mantissa of mantissas) ticks.push(Number(`${mantissa}e${power}`));
  }
  return ticks.filter((tick) => tick >= lowest && tick <= highest);
}

/** "0.002", "50", "300 k": as short as the number allows. */
function tickText(of, value) {
  if (of.format === count) return count(value).replace(/\.?0+(?= )/, '');
  if (value >= 1e-4 && value < 1e5) return String(Number(value.toPrecision(3)));
  return significant(value, 3).replace(/\.?0+e/, 'e');
}

function drawAxis(group, axis, zeroAt, horizontal) {
  select(group).call(axis);
  if (zeroAt === null) return;
  select(group)
    .append('text')
    .attr('class', 'zero')
    .text('0')
    .attr('fill', 'currentColor')
    .attr(horizontal ? 'x' : 'y', zeroAt)
    .attr(horizontal ? 'y' : 'x', horizontal ? 9 : -9)
    .attr('dy', horizontal ? '0.71em' : '0.32em')
    .attr('text-anchor', horizontal ? 'middle' : 'end');
}

/** Draws both axes with grid lines into two empty groups. `box`: {left, right, top, bottom}. */
export function drawAxes(xGroup, yGroup, x, y, box) {
  const bottom = axisBottom(x.scale)
    .tickValues(labelled(x.scale))
    .tickFormat((value) => tickText(x.of, value))
    .tickSizeInner(-(box.bottom - box.top))
    .tickSizeOuter(0)
    .tickPadding(8);
  const left = axisLeft(y.scale)
    .tickValues(labelled(y.scale))
    .tickFormat((value) => tickText(y.of, value))
    .tickSizeInner(-(box.right - box.left))
    .tickSizeOuter(0)
    .tickPadding(8);
  drawAxis(xGroup, bottom, x.zero ? x.low + ZERO : null, true);
  drawAxis(yGroup, left, y.zero ? y.low - ZERO : null, false);
}
