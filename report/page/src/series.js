// Runs as series of a plot, and the Pareto front of two measures.
import {min} from 'd3-array';

const SAMPLES = 'spp';

/** Knobs of a run apart from the number of samples, as "hider=bbox"; "default" without any. */
export function settingsOf(run) {
  const others = Object.entries(run.settings ?? {}).filter(([name]) => name !== SAMPLES);
  return others.map(([name, value]) => `${name}=${value}`).join(' ') || 'default';
}

/** What colours stand for: every setting, or the values of one knob. Pairs of key and text. */
export function groupings(table) {
  const turned = table.knobs.filter((knob) => knob.name !== SAMPLES);
  return [['', 'each setting'], ...turned.map((knob) => [knob.name, `values of ${knob.name}`])];
}

function groupOf(run, grouping, defaults) {
  if (!grouping) return settingsOf(run);
  const value = run.settings?.[grouping];
  return value === undefined
    ? `${grouping}=${defaults.get(grouping) ?? 'default'} (default)`
    : `${grouping}=${value}`;
}

/**
 * Series in the order in which the table has them: [{name, runs, lines}]. `lines` join runs that
 * differ in the number of samples alone.
 */
export function seriesOf(table, grouping) {
  const defaults = new Map(table.knobs.map((knob) => [knob.name, knob.default]));
  const series = new Map();
  for (const run of table.runs) {
    if (!run.ok) continue;
    const name = groupOf(run, grouping, defaults);
    if (!series.has(name)) series.set(name, {name, runs: [], lines: new Map()});
    const one = series.get(name);
    one.runs.push(run);
    const settings = settingsOf(run);
    one.lines.set(settings, [...(one.lines.get(settings) ?? []), run]);
  }
  return [...series.values()].map((one) => ({
    ...one,
    lines: [...one.lines.values()].map(bySamples),
  }));
}

const bySamples = (runs) =>
  [...runs].sort((a, b) => Number(a.settings?.[SAMPLES]) - Number(b.settings?.[SAMPLES]));

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
