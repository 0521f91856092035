// The top of the page: what was rendered, on what, how good the reference is, what came out.
import {el} from './dom.js';
import {significant} from './format.js';

function fact(name, ...content) {
  return el('div', {}, el('dt', {}, name), el('dd', {}, ...content));
}

function machineText({cpu, cores}) {
  return [cpu, cores && `${cores} ${cores === 1 ? 'core' : 'cores'}`].filter(Boolean).join(', ');
}

function referenceFacts(reference) {
  const error =
    typeof reference.rel_mse === 'number'
      ? `relMSE about ${significant(reference.rel_mse)} by its own estimate: errors near it cannot be told from it`
      : 'its own error is not known';
  return [
    fact(
      'Reference',
      `${reference.spp ?? '?'} samples per pixel, ${significant(reference.frame_s)} s. ${error[0].toUpperCase()}${error.slice(1)}.`,
    ),
    reference.options?.length
      ? fact('Its options', el('code', {}, reference.options.join(' ')))
      : null,
  ];
}

function knobList(knobs) {
  return el(
    'details',
    {class: 'knobs'},
    el('summary', {}, `${knobs.length} knobs were turned`),
    el(
      'ul',
      {},
      knobs.map((knob) =>
        el(
          'li',
          {},
          el('b', {}, knob.name),
          `: ${knob.what ?? ''}; `,
          (knob.values ?? []).join(', '),
          knob.default !== undefined ? ` (default ${knob.default})` : '',
        ),
      ),
    ),
  );
}

export function showSummary(root, table) {
  const name = (table.scene ?? '').split('/').pop() || 'scene';
  const failed = table.runs.filter((run) => !run.ok).length;
  document.title = `${name}: error against cost`;
  root.append(
    el('h1', {}, name, el('span', {}, ' error against cost')),
    table.words.length
      ? el(
          'ul',
          {class: 'words'},
          table.words.map((line) => el('li', {}, line)),
        )
      : '',
    el(
      'dl',
      {class: 'facts'},
      fact(
        'Scene',
        el('code', {}, table.scene ?? ''),
        table.scene_hash ? el('span', {class: 'faint'}, ` hash ${table.scene_hash}`) : '',
      ),
      fact('Machine', machineText(table.machine)),
      fact('Made', [table.software, table.created].filter(Boolean).join(', ')),
      fact('Runs', `${table.runs.length}${failed ? `, of which ${failed} failed` : ''}`),
      ...referenceFacts(table.reference),
    ),
    table.knobs.length ? knobList(table.knobs) : '',
  );
}
