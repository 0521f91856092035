// The tables besides: baselines, extremes, features. Their columns are the table's own.
import {el} from './dom.js';
import {count, mebibytes, significant, UNKNOWN} from './format.js';

const COUNTS = /^(rays|samples|.*_points|points|grids|micropolygons|pixels)$/;

function cellText(value, column) {
  if (value === null || value === undefined) return UNKNOWN;
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  if (typeof value !== 'number') return String(value);
  if (/^bytes$/i.test(column.unit ?? '') || /_bytes$/.test(column.name)) return mebibytes(value);
  return COUNTS.test(column.name) ? count(value) : significant(value);
}

function unitText(column) {
  return /^bytes$/i.test(column.unit ?? '') || (!column.unit && /_bytes$/.test(column.name))
    ? 'MiB'
    : column.unit;
}

const VERDICTS = [
  ['bad', /\b(fail\w*|error\w*|bad|wrong|broken|crash\w*|unusable|timed? ?out|degenerates?|no)\b/i],
  ['fair', /\b(slow\w*|warn\w*|fair|weak|degrad\w*|worse|limit\w*|partly|costly)\b/i],
  ['good', /\b(ok|good|pass\w*|fine|safe|sound|yes|robust|holds?|better|best)\b/i],
];

/** A class for the colour of a verdict: bad, fair or good; none when its words say neither. */
export const verdictClass = (text) =>
  VERDICTS.find(([, words]) => words.test(String(text)))?.[0] ?? 'none';

function cell(value, column) {
  const text = cellText(value, column);
  if (/verdict/i.test(column.name) && text !== UNKNOWN) {
    return el('td', {}, el('span', {class: `verdict ${verdictClass(text)}`}, text));
  }
  return el('td', {class: typeof value === 'number' || value === null ? 'number' : null}, text);
}

function section({title, columns = [], rows = [], notes = []}) {
  const numeric = columns.map((_, i) => rows.some((row) => typeof row[i] === 'number'));
  return el(
    'section',
    {'aria-label': title},
    el('h2', {}, title),
    el(
      'div',
      {class: 'scroll', tabindex: 0, role: 'region', 'aria-label': title},
      el(
        'table',
        {},
        el(
          'thead',
          {},
          el(
            'tr',
            {},
            columns.map((column, i) =>
              el(
                'th',
                {scope: 'col', class: numeric[i] ? 'number' : null},
                column.name.replaceAll('_', ' ').replace(/ (s|bytes)$/, ''),
                unitText(column) ? el('small', {}, unitText(column)) : null,
              ),
            ),
          ),
        ),
        el(
          'tbody',
          {},
          rows.map((row) =>
            el(
              'tr',
              {},
              columns.map((column, i) => cell(row[i], column)),
            ),
          ),
        ),
      ),
    ),
    notes.map((note) => el('p', {class: 'note'}, note)),
  );
}

export const showTables = (root, table) => root.append(...table.tables.map(section));
