// The top of the page: what came out, what makes it less sure, what was measured and on what.
import {el} from './dom.js';
import {significant} from './format.js';
import {countsText} from './outcome.js';

const WORDS_SHOWN = 4; // the table has the most telling ones first
const NOTES_SHOWN = 3;
const LONG_NOTE = 120; // characters

function fact(name, ...content) {
  return el('div', {}, el('dt', {}, name), el('dd', {}, ...content));
}

function machineText({cpu, cores}) {
  return [cpu, cores && `${cores} ${cores === 1 ? 'core' : 'cores'}`].filter(Boolean).join(', ');
}

function referenceText({reference, runs}) {
  const error =
    typeof reference.rel_mse === 'number'
      ? `RelMSE about ${significant(reference.rel_mse)} by its own estimate: errors near it cannot be told from it`
      : 'Its own error is not known';
  const limited = runs.filter((run) => run.ok && run.limited_by_reference).length;
  const hidden = limited ? ` It hides that of ${limited} ${limited === 1 ? 'run' : 'runs'}.` : '';
  return `${reference.spp ?? '?'} samples per pixel, ${significant(reference.frame_s)} s. ${error}.${hidden}`;
}

/** A list of which the first `shown` items are open and the others folded. */
function foldedList(items, shown, what) {
  const rest = items.slice(shown);
  return [
    el('ul', {}, items.slice(0, shown)),
    rest.length
      ? el(
          'details',
          {},
          el('summary', {}, `${rest.length} more ${what}${rest.length === 1 ? '' : 's'}`),
          el('ul', {}, rest),
        )
      : null,
  ];
}

/** A note; of a long one, as a list of what was not run, the start, and all of it unfolded. */
function noteItem(note) {
  if (note.length <= LONG_NOTE) return el('li', {}, note);
  const start = note.slice(0, note.lastIndexOf(' ', LONG_NOTE)).replace(/[,;:]?$/, ' …');
  const all = el('details', {}, el('summary', {}, start), el('p', {}, note));
  return el('li', {class: 'long'}, all);
}

function knobItem(knob) {
  return el(
    'li',
    {},
    el('b', {}, knob.name),
    `: ${knob.what ?? ''}; `,
    (knob.values ?? []).join(', '),
    knob.default !== undefined ? ` (default ${knob.default})` : '',
  );
}

/** What one needs to do it again. */
function particulars(table) {
  const {scene, scene_hash: hash, reference, knobs, software, created} = table;
  return el(
    'details',
    {class: 'particulars'},
    el('summary', {}, 'How it was measured'),
    el(
      'dl',
      {class: 'facts'},
      fact('Scene', el('code', {}, scene ?? ''), hash ? ` hash ${hash}` : ''),
      fact('Made', [software, created].filter(Boolean).join(', ')),
      reference.options?.length
        ? fact('Options of the reference', el('code', {}, reference.options.join(' ')))
        : null,
      knobs.length ? fact('Knobs turned', el('ul', {}, knobs.map(knobItem))) : null,
    ),
  );
}

/** Notes in the order of what they put in doubt: that a knob has nothing to do comes last. */
function byWeight(notes) {
  const light = (note) => / is left out: /.test(note);
  return [...notes.filter((note) => !light(note)), ...notes.filter(light)];
}

function box(className, heading, items, shown, what) {
  if (items.length === 0) return null;
  return el('div', {class: className}, heading, foldedList(items, shown, what));
}

export function showSummary(root, table) {
  const name = (table.scene ?? '').split('/').pop() || 'scene';
  document.title = `${name}: error against cost`;
  const words = table.words.map((line) => el('li', {}, line));
  const notes = byWeight(table.notes).map(noteItem);
  const facts = el(
    'dl',
    {class: 'facts'},
    fact('Runs', countsText(table.runs)),
    fact('Reference', referenceText(table)),
    fact('Machine', machineText(table.machine)),
  );
  root.append(
    el('h1', {}, name, el('span', {}, ' error against cost')),
    el(
      'div',
      {class: 'top'},
      box('words', null, words, WORDS_SHOWN, 'finding'),
      el(
        'div',
        {},
        facts,
        particulars(table),
        box('notes', el('b', {}, 'Keep in mind'), notes, NOTES_SHOWN, 'note'),
      ),
    ),
  );
}
