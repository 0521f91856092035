// The legend of the plot, by which series are chosen: none chosen is all of them.
import {select as pick} from 'd3-selection';
import {el} from './dom.js';

function icon(one) {
  const svg = pick(el('span'))
    .append('svg')
    .attr('width', 12)
    .attr('height', 12)
    .attr('aria-hidden', 'true');
  svg
    .append('path')
    .attr('d', one.shape)
    .attr('transform', 'translate(6,6)')
    .style('fill', one.colour);
  return svg.node();
}

/** Series in families: those of one knob together, all others each by itself. */
function families(series) {
  const byKnob = new Map();
  for (const one of series) {
    const key = one.knob || one.name;
    byKnob.set(key, [...(byKnob.get(key) ?? []), one]);
  }
  return [...byKnob];
}

/**
 * `onchoose()`: after other series were chosen. `onpoint(names)`: series pointed at, null when none
 * is. Returns {root, shows(name), show(series)}; `show` lists anew and forgets what was chosen.
 */
export function createSeriesLegend({onchoose, onpoint}) {
  const root = el('div', {class: 'legend', role: 'group', 'aria-label': 'Series shown'});
  const chosen = new Set();
  let keys = [];
  const all = el(
    'button',
    {type: 'button', class: 'key all', title: 'Every series', onclick: () => choose([], true)},
    'all',
  );

  function mark() {
    for (const [name, key] of keys) key.setAttribute('aria-pressed', String(chosen.has(name)));
    root.classList.toggle('some', chosen.size > 0);
    all.setAttribute('aria-pressed', String(chosen.size === 0));
  }

  /** Adds series to the chosen ones; takes them away where all of them were. */
  function choose(names, none = false) {
    const had = names.every((name) => chosen.has(name));
    if (none) chosen.clear();
    for (const name of names) {
      if (had) chosen.delete(name);
      else chosen.add(name);
    }
    mark();
    onchoose();
  }

  const pointing = (names) => ({
    onpointerenter: () => onpoint(names),
    onpointerleave: () => onpoint(null),
    onfocus: () => onpoint(names),
    onblur: () => onpoint(null),
  });

  function key(one, text) {
    const button = el(
      'button',
      {
        type: 'button',
        class: 'key',
        'data-series': one.name,
        'aria-label': one.name,
        title: `Only ${one.name}; a click on another adds it`,
        onclick: () => choose([one.name]),
        ...pointing([one.name]),
      },
      icon(one),
      text,
    );
    keys.push([one.name, button]);
    return button;
  }

  function family([knob, members]) {
    if (members.length === 1) return key(members[0], members[0].name);
    const names = members.map((one) => one.name);
    return el(
      'span',
      {class: 'family'},
      el(
        'button',
        {
          type: 'button',
          class: 'knob',
          title: `All values of ${knob}`,
          onclick: () => choose(names),
          ...pointing(names),
        },
        knob,
      ),
      members.map((one) => key(one, one.value)),
    );
  }

  return {
    root,
    shows: (name) => chosen.size === 0 || chosen.has(name),
    show(series) {
      chosen.clear();
      keys = [];
      root.replaceChildren(
        el('span', {class: 'key front-key'}, 'Pareto front'),
        series.length > 1 ? all : '',
        ...families(series).map(family),
      );
      mark();
    },
  };
}
