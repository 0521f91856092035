// What the plot says of the run under the pointer. Its height does not depend on what it says.
import {el} from './dom.js';
import {MEASURES, spreadText, written} from './measures.js';

const SHOWN = [
  'frame_s',
  'cpu_s',
  'peak_bytes',
  'shaded_points',
  'rays',
  'rel_mse',
  'rmse',
  'visible',
];

/** What else is to be said of a run. */
function remarks(run) {
  const all = [
    run.pareto && 'on the Pareto front',
    run.limited_by_reference && "its error is hidden by the reference's own",
  ];
  return all
    .filter(Boolean)
    .map((text) => `  · ${text}`)
    .join('');
}

export function createReading(table, state) {
  const name = el('div', {class: 'reading-name'});
  const options = el('code', {class: 'reading-options'});
  const values = new Map(SHOWN.map((key) => [key, el('dd', {'data-measure': key})]));
  const list = el(
    'dl',
    {},
    SHOWN.map((key) => {
      const of = MEASURES.find((candidate) => candidate.key === key);
      return el('div', {title: of.what}, el('dt', {}, of.short), values.get(key));
    }),
  );

  function show() {
    const run = table.runs.find((candidate) => candidate.id === state.get('read'));
    name.textContent = run ? `${run.id} ${run.label}${remarks(run)}` : 'Point at a run to read it';
    options.textContent = run
      ? (run.options ?? []).join(' ')
      : 'click: image A, with shift: B; arrow keys: next run';
    for (const [key, cell] of values) {
      const of = MEASURES.find((candidate) => candidate.key === key);
      cell.textContent = run ? written(of, run) + (key === 'frame_s' ? spreadText(run) : '') : '–';
    }
  }
  state.listen(['read'], show);
  show();
  return el('div', {class: 'reading', 'aria-live': 'polite'}, name, options, list);
}
