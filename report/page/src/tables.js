// The tables besides: baselines, extremes, features. Their columns are the table's own.
import {el} from './dom.js';
import {count, mebibytes, significant, UNKNOWN} from './format.js';

const COUNTS = /^(rays|samples|.*_points|points|grids|micropolygons|pixels)$/;
const VERDICT = /verdict/i;
const CONCLUSION = /verdict|^needs$/i; // what one looks for first

/** What the end of a column's name says of its unit, where the column has none of its own. */
const UNIT_ENDINGS = [
  [/_bytes$/, 'MiB'],
  [/_mib$/, 'MiB'],
  [/_percent$/, '%'],
  [/_s$/, 's'],
];

function unitText({name, unit}) {
  if (/^bytes$/i.test(unit ?? '')) return 'MiB';
  return unit || UNIT_ENDINGS.find(([ending]) => ending.test(name))?.[1];
}

/** "time_saved_percent" as "time saved", "rel_mse" as "relMSE". */
function nameText({name}) {
  const [ending] = UNIT_ENDINGS.find(([end]) => end.test(name)) ?? [/$/];
  return name.replace(ending, '').replaceAll('rel_mse', 'relMSE').replaceAll('_', ' ');
}

function cellText(value, column) {
  if (value === null || value === undefined) return UNKNOWN;
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  if (typeof value !== 'number') return String(value);
  if (/^bytes$/i.test(column.unit ?? '') || /_bytes$/.test(column.name)) return mebibytes(value);
  return column.whole || COUNTS.test(column.name) ? count(value) : significant(value);
}

const VERDICTS = [
  ['bad', /\b(fail\w*|error\w*|bad|wrong|broken|crash\w*|unusable|timed? ?out|degenerates?|no)\b/i],
  ['fair', /\b(slow\w*|warn\w*|fair|weak|degrad\w*|worse|limit\w*|partly|costly)\b/i],
  ['good', /\b(ok|good|pass\w*|fine|safe|sound|yes|robust|holds?|better|best)\b/i],
];

/** A class for the colour of a verdict: bad, fair or good; none when its words say neither. */
export const verdictClass = (text) =>
  VERDICTS.find(([, words]) => words.test(String(text)))?.[0] ?? 'none';

const verdict = (text, label = text) =>
  el('span', {class: `verdict ${verdictClass(text)}`}, label);

/**
 * The columns to show, each with its place in a row: what a row is about, what is concluded of it,
 * then all others in which any row has something.
 */
function shownColumns(columns, rows) {
  const known = (value) => value !== null && value !== undefined && value !== '';
  const shown = columns
    .map((column, index) => ({
      ...column,
      index,
      numeric: rows.some((row) => typeof row[index] === 'number'),
      whole: rows.every(({[index]: value}) => typeof value !== 'number' || Number.isInteger(value)),
      judges: VERDICT.test(column.name),
      concludes: CONCLUSION.test(column.name),
    }))
    .filter(({index}) => index === 0 || rows.length === 0 || rows.some((row) => known(row[index])));
  const [first, ...others] = shown;
  return first
    ? [first, ...others.filter((one) => one.concludes), ...others.filter((one) => !one.concludes)]
    : [];
}

function headerCell(column) {
  const unit = unitText(column);
  return el(
    'th',
    {scope: 'col', class: column.numeric ? 'number' : null},
    nameText(column),
    unit ? el('small', {}, unit) : null,
  );
}

function cell(value, column, place) {
  const text = cellText(value, column);
  if (place === 0) return el('th', {scope: 'row'}, text);
  if (column.judges && text !== UNKNOWN) return el('td', {}, verdict(text));
  return el('td', {class: column.numeric ? 'number' : 'text'}, text);
}

/** "146 rows: 140 pass, 6 fail": how often each verdict was given, the bad ones first. */
function tally(columns, rows) {
  const judge = columns.find((column) => column.judges);
  if (!judge) return null;
  const numbers = new Map();
  for (const row of rows) {
    const text = cellText(row[judge.index], judge);
    numbers.set(text, (numbers.get(text) ?? 0) + 1);
  }
  const order = ['bad', 'fair', 'none', 'good'];
  const sorted = [...numbers].sort(
    ([a], [b]) => order.indexOf(verdictClass(a)) - order.indexOf(verdictClass(b)),
  );
  if (sorted.length > 6) return null; // sentences rather than classes
  return el(
    'span',
    {class: 'tally'},
    sorted.map(([text, number]) => verdict(text, `${number} ${text}`)),
  );
}

function section({title, columns = [], rows = [], notes = []}) {
  const shown = shownColumns(columns, rows);
  return el(
    'section',
    {'aria-label': title},
    el('h2', {}, title, tally(shown, rows)),
    el(
      'div',
      {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': title},
      el(
        'table',
        {class: 'beside'},
        el('thead', {}, el('tr', {}, shown.map(headerCell))),
        el(
          'tbody',
          {},
          rows.map((row) =>
            el(
              'tr',
              {},
              shown.map((column, place) => cell(row[column.index], column, place)),
            ),
          ),
        ),
      ),
    ),
    notes.map((note) => el('p', {class: 'note'}, note)),
  );
}

export const showTables = (root, table) => root.append(...table.tables.map(section));
