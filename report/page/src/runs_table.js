// All runs, sorted by any column.
import {ascending} from 'd3-array';
import {el} from './dom.js';
import {UNKNOWN} from './format.js';
import {MEASURES} from './measures.js';
import {countsText, OUTCOMES, outcome, reasonText} from './outcome.js';

const UNIT_NAMES = {s: 's', '%': '%', MiB: 'MiB'};

const LIMITED = '~'; // as in the table that is printed

const COLUMNS = [
  {
    key: 'id',
    name: 'run',
    what: 'number of the run',
    value: (run) => run.id,
    text: (run) => run.id,
  },
  {
    key: 'label',
    name: 'settings',
    what: 'what was set; all else is as by default',
    value: (run) => run.label,
    text: (run) => run.label,
  },
  ...MEASURES.map((of) => ({
    ...of,
    name: of.short,
    number: true,
    value: (run) => run[of.key],
    text: (run) => of.format(run[of.key]),
  })),
  {
    key: 'pareto',
    name: 'front',
    what: 'on the Pareto front of frame time and relMSE',
    value: (run) => (run.pareto ? 0 : 1),
    text: (run) => (run.pareto ? '●' : ''),
  },
];

/** Numbers by size, text with its numbers by size ("spp=4" before "spp=16"); unknown ones last. */
function compare(a, b, direction) {
  const unknown = (value) => value === null || value === undefined;
  if (unknown(a) || unknown(b)) return ascending(unknown(a), unknown(b));
  const order = typeof a === 'string' ? a.localeCompare(b, 'en', {numeric: true}) : ascending(a, b);
  return order * direction;
}

const rank = (run) => OUTCOMES.indexOf(outcome(run));

function cells(run) {
  if (run.ok) {
    return COLUMNS.map((column) =>
      el(
        'td',
        {class: column.number ? 'number' : column.key},
        column.key === 'rel_mse' && run.limited_by_reference ? `${LIMITED} ` : '',
        column.text(run),
      ),
    );
  }
  return [
    el('td', {class: 'id'}, run.id),
    el('td', {class: 'label'}, run.label),
    el(
      'td',
      {class: 'reason', colspan: COLUMNS.length - 2},
      reasonText(run),
    ),
  ];
}

function headingText(runs) {
  const limited = runs.some((run) => run.ok && run.limited_by_reference);
  const legend = limited ? `; ${LIMITED}: the reference's own error hides that of the run` : '';
  return ` ${countsText(runs)}; a click on a heading sorts, what is not known last${legend}`;
}

export function showRuns(root, table, images, state) {
  const body = el('tbody');
  const rows = new Map(table.runs.map((run) => [run, row(run)]));
  const headers = new Map(COLUMNS.map((column) => [column, header(column)]));
  let sorted = {column: null, direction: 1};

  function row(run) {
    const side = (name) =>
      el(
        'button',
        {
          type: 'button',
          class: 'side-button',
          'data-side': name,
          title: `Show as image ${name.toUpperCase()}`,
          disabled: !images.has(run.image),
          onclick: () => state.set({[name]: run.id}),
        },
        name.toUpperCase(),
      );
    return el(
      'tr',
      {
        'data-run': run.id,
        class: run.ok ? null : outcome(run),
        onpointerenter: () => state.set({read: run.id}),
      },
      el('td', {class: 'sides'}, run.ok ? [side('a'), side('b')] : UNKNOWN),
      cells(run),
    );
  }

  function header(column) {
    return el(
      'th',
      {
        scope: 'col',
        'aria-sort': 'none',
        class: column.number ? 'number' : column.key,
        'data-column': column.key,
      },
      el(
        'button',
        {type: 'button', title: column.what, onclick: () => sort(column)},
        el('span', {class: 'arrow', 'aria-hidden': 'true'}),
        column.name,
        UNIT_NAMES[column.unit] ? el('small', {}, UNIT_NAMES[column.unit]) : null,
      ),
    );
  }

  function sort(column) {
    sorted = {column, direction: sorted.column === column ? -sorted.direction : 1};
    for (const [other, cell] of headers) {
      const order = sorted.direction > 0 ? 'ascending' : 'descending';
      cell.setAttribute('aria-sort', other === column ? order : 'none');
    }
    const order = [...table.runs].sort(
      (a, b) =>
        ascending(rank(a), rank(b)) || compare(column.value(a), column.value(b), sorted.direction),
    );
    body.append(...order.map((run) => rows.get(run)));
  }

  function mark() {
    for (const [run, element] of rows) {
      for (const button of element.querySelectorAll('.side-button')) {
        button.setAttribute('aria-pressed', String(state.get(button.dataset.side) === run.id));
      }
    }
  }

  body.append(...rows.values());
  root.append(
    el(
      'h2',
      {},
      `Runs`,
      el(
        'small',
        {},
        headingText(table.runs),
      ),
    ),
    el(
      'div',
      {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Table of all runs'},
      el(
        'table',
        {class: 'runs'},
        el(
          'thead',
          {},
          el('tr', {}, el('th', {class: 'sides', scope: 'col'}, 'image'), ...headers.values()),
        ),
        body,
      ),
    ),
  );
  state.listen(['a', 'b'], mark);
  mark();
}
