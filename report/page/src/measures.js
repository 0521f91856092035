// What was measured of a run: how it is called, its unit, how it is written.
import {significant, count, mebibytes, percent} from './format.js';

/**
 * Those looked for first come first. `scale` turns a value of the table into `unit`; `short`: its name
 * in a heading; `what` explains it.
 */
export const MEASURES = [
  {
    key: 'frame_s',
    name: 'frame time',
    short: 'frame',
    unit: 's',
    scale: 1,
    format: significant,
    cost: true,
    what: 'time to render the frame, wall clock, median of the repeats',
  },
  {
    key: 'rel_mse',
    name: 'relMSE',
    short: 'relMSE',
    unit: '',
    scale: 1,
    format: significant,
    error: true,
    what: 'mean of (a − b)² / (b² + 0.01), b the reference',
  },
  {
    key: 'visible',
    name: 'visible',
    short: 'visible',
    unit: '%',
    scale: 100,
    format: percent,
    error: true,
    what: 'pixels in which a viewer would see the difference',
  },
  {
    key: 'rmse',
    name: 'RMSE',
    short: 'RMSE',
    unit: '',
    scale: 1,
    format: significant,
    error: true,
    what: 'root of the mean squared difference from the reference',
  },
  {
    key: 'cpu_s',
    name: 'CPU time',
    short: 'CPU',
    unit: 's',
    scale: 1,
    format: significant,
    cost: true,
    what: 'processor time of all threads',
  },
  {
    key: 'peak_bytes',
    name: 'memory',
    short: 'memory',
    unit: 'MiB',
    scale: 2 ** -20,
    format: mebibytes,
    cost: true,
    what: 'most memory resident at once',
  },
  {
    key: 'shaded_points',
    name: 'shaded points',
    short: 'points',
    unit: '',
    scale: 1,
    format: count,
    cost: true,
    what: 'points at which shaders ran',
  },
  {
    key: 'rays',
    name: 'rays',
    short: 'rays',
    unit: '',
    scale: 1,
    format: count,
    cost: true,
    what: 'rays traced',
  },
  {
    key: 'samples',
    name: 'samples',
    short: 'samples',
    unit: '',
    scale: 1,
    format: count,
    what: 'visibility samples of the frame',
  },
  {
    key: 'ste',
    name: 'STE',
    short: 'STE',
    unit: '%',
    scale: 100,
    format: percent,
    what: 'sample test efficiency: samples covered, of those tested against micropolygons',
  },
];

export const COSTS = MEASURES.filter((measure) => measure.cost);
export const ERRORS = MEASURES.filter((measure) => measure.error);

export const measure = (key) => MEASURES.find((candidate) => candidate.key === key);

/** "frame time (s)". */
export const title = (of) => (of.unit ? `${of.name} (${of.unit})` : of.name);

/** Half of what the repeats' frame times span, over their median; null when it ran once. */
export function spread(run) {
  const times = run.frame_s_all ?? [];
  if (times.length < 2 || !(run.frame_s > 0)) return null;
  return (Math.max(...times) - Math.min(...times)) / 2 / run.frame_s;
}

/** How sure a frame time is: " ±3 %", or that it was taken once. */
export function spreadText(run) {
  const share = spread(run);
  if (share !== null) return ` ±${significant(share * 100, 1)} %`;
  return run.frame_s_all?.length === 1 ? ', once' : '';
}

/** "1.43 s", "0.00204". */
export function written(of, run) {
  const text = of.format(run[of.key]);
  return of.unit && typeof run[of.key] === 'number' ? `${text} ${of.unit}` : text;
}
