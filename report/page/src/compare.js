// Two images laid over each other: which, how they are shown, what their colours mean.
import {el, fillSelect, labelled, select} from './dom.js';
import {stops} from './format.js';
import {gather, paintLayers, viewsOf} from './layers.js';
import {showLegend} from './legend.js';
import {createStage} from './stage.js';
import {REFERENCE} from './state.js';

const RANGES = [0.01, 0.03, 0.1, 0.3, 1, 3, 10];

const HINT = 'Point at a pixel to read it; drag pans; after a click the wheel zooms';

const viewName = {a: 'viewA', b: 'viewB'};

function sideControls(side, table, images, state) {
  const choices = table.runs
    .filter((run) => images.has(run.image))
    .map((run) => [run.id, `${run.id}  ${run.label}`]);
  if (images.has(table.reference.file)) choices.unshift([REFERENCE, 'reference']);
  const letter = side.toUpperCase();
  const image = select(`Image ${letter}`, choices, state.get(side), (id) =>
    state.set({[side]: id}),
  );
  const view = select(`View of image ${letter}`, [], 'picture', (value) =>
    state.set({[viewName[side]]: value}),
  );

  function update() {
    const run = table.runs.find((candidate) => candidate.id === state.get(side));
    const views = viewsOf(run, images);
    image.value = state.get(side);
    if (!views.some(([key]) => key === state.get(viewName[side])))
      state.set({[viewName[side]]: 'picture'});
    fillSelect(view, views, state.get(viewName[side]));
  }
  state.listen([side, viewName[side]], update);
  update();
  return el('div', {class: 'side-controls'}, el('b', {}, letter), image, view);
}

function exposureControl(state) {
  const text = el('output', {}, '±0 EV');
  const slider = el('input', {
    type: 'range',
    min: -8,
    max: 8,
    step: 0.25,
    value: 0,
    'aria-label': 'Exposure in stops',
    oninput: () => state.set({exposure: Number(slider.value)}),
    ondblclick: () => state.set({exposure: 0}),
  });
  state.listen(['exposure'], () => {
    slider.value = state.get('exposure');
    text.textContent = `${stops(state.get('exposure'))} EV`;
  });
  return el(
    'label',
    {class: 'field', title: 'A double click resets it'},
    el('span', {}, 'exposure'),
    slider,
    text,
  );
}

/** Says that large images are not held at their own size. */
function reduced(catalogue) {
  const numbers = Object.values(catalogue.images).map(({reduction}) => reduction ?? 1);
  const most = Math.max(1, ...numbers);
  if (most === 1) return null;
  const some = numbers.some((reduction) => reduction !== most) ? ' up to' : '';
  return el(
    'p',
    {class: 'note reduced'},
    `Large images are held smaller here: a pixel is the mean of${some} ${most} × ${most} pixels, and its error that of the mean, which is less noisy. The numbers of the runs are those of the full images.`,
  );
}

function leftOut(catalogue) {
  const {left_out: images = [], budget_bytes: budget} = catalogue;
  if (images.length === 0) return null;
  return el(
    'details',
    {class: 'left-out'},
    el(
      'summary',
      {},
      `${images.length} images are not in this page, which holds ${Math.round(budget / 1e6)} MB of them`,
    ),
    el('p', {}, images.map((image) => image.what).join(', ')),
  );
}

export function showCompare(root, table, catalogue, images, state) {
  const legends = [el('div', {class: 'layer-legend'}), el('div', {class: 'layer-legend'})];
  const reading = el('p', {class: 'pixel'});
  let layers = [];
  let round = 0;

  const stage = createStage((pixel) => {
    const values =
      pixel && layers.map((layer, i) => `${'AB'[i]} ${layer.read ? readAt(layer, pixel) : '–'}`);
    reading.textContent = pixel
      ? `(${pixel.x}, ${pixel.y})   ${values.join('   ')}`
      : HINT;
  });

  const readAt = (layer, {x, y}) =>
    x < layer.width && y < layer.height ? layer.read(y * layer.width + x) : '–';

  async function update() {
    round += 1;
    const mine = round;
    const sides = await Promise.all([
      gather(state.get('a'), state.get('viewA'), table, images),
      gather(state.get('b'), state.get('viewB'), table, images),
    ]);
    if (mine !== round) return; // something else was chosen meanwhile
    layers = paintLayers(sides, {exposure: state.get('exposure'), range: state.get('range')});
    layers.forEach((layer, i) => showLegend(legends[i], 'AB'[i], layer));
    stage.show(layers);
    root.dataset.shown = String(mine);
  }

  const button = (text, title, onclick) =>
    el('button', {type: 'button', title, 'aria-label': title, onclick}, text);
  root.append(
    el('h2', {}, 'Images'),
    sideControls('a', table, images, state),
    sideControls('b', table, images, state),
    el(
      'div',
      {class: 'controls'},
      exposureControl(state),
      labelled(
        'error scale',
        select(
          'Error scale',
          RANGES.map((range) => [range, `${range * 100} %`]),
          state.get('range'),
          (value) => state.set({range: Number(value)}),
        ),
      ),
      el(
        'span',
        {class: 'buttons'},
        button('A⇄B', 'Swap A and B', () =>
          state.set({
            a: state.get('b'),
            b: state.get('a'),
            viewA: state.get('viewB'),
            viewB: state.get('viewA'),
          }),
        ),
        button('−', 'Zoom out', () => stage.zoom(1 / 1.5)),
        button('+', 'Zoom in', () => stage.zoom(1.5)),
        button('1:1', 'One pixel of the image to one of the screen', stage.actualSize),
        button('fit', 'Fit the view', stage.fit),
      ),
    ),
    stage.root,
    reading,
    el('div', {class: 'layer-legends'}, legends),
    reduced(catalogue) ?? '',
    leftOut(catalogue) ?? '',
  );
  reading.textContent = HINT;
  state.listen(['a', 'b', 'viewA', 'viewB', 'exposure', 'range'], update);
  update();
}
