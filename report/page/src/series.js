// Runs as series of a plot, how each is drawn, and the Pareto front of two measures.
import {min} from 'd3-array';
import {
  symbol,
  symbolCircle,
  symbolCross,
  symbolDiamond,
  symbolSquare,
  symbolStar,
  symbolTriangle,
  symbolWye,
} from 'd3-shape';

const SAMPLES = 'spp';
const SHAPES = [
  symbolCircle,
  symbolSquare,
  symbolTriangle,
  symbolDiamond,
  symbolCross,
  symbolStar,
  symbolWye,
];
const COLOURS = 10; // custom properties --series-0 ... of style.css

/** Knobs of a run apart from the number of samples, as pairs of name and value. */
const turned = (run) => Object.entries(run.settings ?? {}).filter(([name]) => name !== SAMPLES);

const written = (settings) => settings.map(([name, value]) => `${name}=${value}`).join(' ');

/** What colours stand for: every setting, or the values of one knob. Pairs of key and text. */
export function groupings(table) {
  const knobs = table.knobs.filter((knob) => knob.name !== SAMPLES);
  return [['', 'each setting'], ...knobs.map((knob) => [knob.name, `values of ${knob.name}`])];
}

/**
 * The series of a run: {name, kind, knob, value}. kind: default, value or others; with a grouping
 * `others` are the runs that turn other knobs than it. knob is empty where several are turned.
 */
function placeOf(run, grouping, defaults) {
  const settings = turned(run);
  if (settings.length === 0) {
    const value = defaults.get(grouping);
    return {name: value === undefined ? 'default' : `default (${value})`, kind: 'default'};
  }
  if (!grouping) {
    const name = written(settings);
    if (settings.length > 1) return {name, kind: 'value', knob: '', value: name};
    return {name, kind: 'value', knob: settings[0][0], value: settings[0][1]};
  }
  const value = run.settings[grouping];
  return value === undefined
    ? {name: 'other knobs', kind: 'others'}
    : {name: `${grouping}=${value}`, kind: 'value', knob: grouping, value};
}

/**
 * Series in the order in which the table has them, the default first, others last:
 * [{name, kind, knob, value, runs, lines, colour, shape}]. `lines` join runs that differ in the
 * number of samples alone.
 */
export function seriesOf(table, grouping) {
  const defaults = new Map(grouping ? table.knobs.map((knob) => [knob.name, knob.default]) : []);
  const series = new Map();
  for (const run of table.runs) {
    if (!run.ok) continue;
    const place = placeOf(run, grouping, defaults);
    if (!series.has(place.name)) series.set(place.name, {...place, runs: [], lines: new Map()});
    const one = series.get(place.name);
    one.runs.push(run);
    const settings = written(turned(run));
    one.lines.set(settings, [...(one.lines.get(settings) ?? []), run]);
  }
  const order = ['default', 'value', 'others'];
  const sorted = [...series.values()].sort((a, b) => order.indexOf(a.kind) - order.indexOf(b.kind));
  return styled(sorted.map((one) => ({...one, lines: [...one.lines.values()].map(bySamples)})));
}

const bySamples = (runs) =>
  [...runs].sort((a, b) => Number(a.settings?.[SAMPLES]) - Number(b.settings?.[SAMPLES]));

/**
 * Of several knobs each has a colour and its values have shapes; of one, each value has both. The
 * default has the colour of text, what is beside the point that of the axes.
 */
function styled(series) {
  const values = series.filter((one) => one.kind === 'value');
  const families = [...new Set(values.map((one) => one.knob || one.name))];
  const family = (one) => families.indexOf(one.knob || one.name);
  return series.map((one) => {
    if (one.kind === 'default') return {...one, colour: 'var(--ink)', shape: drawn(0, 64)};
    if (one.kind === 'others') return {...one, colour: 'var(--faint)', shape: drawn(0, 18)};
    const own = values.filter((other) => family(other) === family(one)).indexOf(one);
    const hue = families.length > 1 ? family(one) : own;
    return {...one, colour: `var(--series-${hue % COLOURS})`, shape: drawn(own, 52)};
  });
}

/** Path of a symbol, its area in pixels. */
const drawn = (index, area) => symbol(SHAPES[index % SHAPES.length], area)();

/** Runs that none other beats in both measures, by rising cost. */
export function paretoFront(runs, x, y) {
  const sorted = runs
    .filter((run) => typeof run[x] === 'number' && typeof run[y] === 'number')
    .sort((a, b) => a[x] - b[x] || a[y] - b[y]);
  const front = [];
  for (const run of sorted) {
    if (front.length === 0 || run[y] < min(front, (other) => other[y])) front.push(run);
  }
  return front;
}
