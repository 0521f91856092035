// What colours of a layer mean. All legends are of one height.
import {HEAT_FLOOR} from './colour.js';
import {el} from './dom.js';
import {significant, stops} from './format.js';

function gradient(ramp, from = 0) {
  const colours = Array.from(
    {length: 25},
    (_, i) => `rgb(${ramp(from + ((1 - from) * i) / 24).join(' ')})`,
  );
  return `linear-gradient(to right, ${colours.join(', ')})`;
}

/** A bar of the ramp from `from` on, with ticks: [position in 0..1, text]. */
function scaleBar(ramp, ticks, from = 0) {
  return el(
    'div',
    {class: 'scale'},
    el('div', {class: 'bar', style: `background: ${gradient(ramp, from)}`}),
    el(
      'div',
      {class: 'ticks'},
      ticks.map(([position, text]) =>
        el('span', {style: `left: ${(position * 100).toFixed(2)}%`}, text),
      ),
    ),
  );
}

const asPercent = (value) => `${significant(value * 100, 2).replace(/\.0$/, '')} %`;

/** Values above zero, from one end of the bar to the other: zero is black, and said in words. */
function heatTicks({scale}) {
  const {lowest, highest} = scale;
  if (!(highest > lowest)) return [[0, significant(highest)]];
  return [
    [0, significant(lowest)],
    [0.5, significant(Math.sqrt(lowest * highest))],
    [1, significant(highest)],
  ];
}

function heatBar({scale, ramp}) {
  if (!(scale.highest > 0)) return null; // all black
  return scaleBar(ramp, heatTicks({scale}), scale.highest > scale.lowest ? HEAT_FLOOR : 1);
}

const CONTENT = {
  picture: ({exposure}) => [
    el(
      'p',
      {},
      `linear R G B as sRGB, exposure ${stops(exposure)} EV; magenta: not a number, or infinite`,
    ),
  ],
  signed: ({range, ramp}) => [
    el('p', {}, 'mean of (a − r) / √(r² + 0.01), r the reference'),
    scaleBar(ramp, [
      [0, `−${asPercent(range)}`],
      [0.5, '0'],
      [1, `+${asPercent(range)}`],
    ]),
  ],
  absolute: ({range, ramp}) => [
    el('p', {}, 'root of the mean of (a − r)² / (r² + 0.01)'),
    scaleBar(ramp, [
      [0, '0'],
      [0.5, asPercent(range / 2)],
      [1, `≥ ${asPercent(range)}`],
    ]),
  ],
  heat: (legend) => [
    el(
      'p',
      {},
      `${legend.unit}, logarithmic, black is none; mean ${significant(legend.scale.mean)}`,
    ),
    heatBar(legend),
  ],
};

/** Shows the legend of `layer` in `root`. */
export function showLegend(root, letter, layer) {
  root.replaceChildren(
    el('b', {title: layer.name}, `${letter}  ${layer.name}`),
    ...(layer.problem
      ? [el('p', {class: 'problem'}, layer.problem)]
      : CONTENT[layer.legend.kind](layer.legend).filter(Boolean)),
  );
}
