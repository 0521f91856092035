// The two pictures of the comparison: what a side shows, painted at the image's own size.
import {HALF_VALUES} from './data.js';
import {
  HEAT,
  SIGNED,
  heatPosition,
  heatScale,
  paintColour,
  paintScalar,
  relativeErrors,
} from './colour.js';
import {pixelValue} from './format.js';
import {REFERENCE} from './state.js';

export const HEAT_UNITS = {
  tests: 'tests per pixel',
  shading: 'points shaded per pixel',
  extra: 'extra samples per pixel',
};

const ERRORS = {signed: 'relative error, signed', absolute: 'relative error, absolute'};

/** Views of a run or of the reference, as pairs of key and text. */
export function viewsOf(run, images) {
  const maps = Object.keys(run?.heatmaps ?? {}).filter((name) => images.has(heatKey(run, name)));
  const errors = run && images.has(run.image) ? Object.entries(ERRORS) : [];
  return [
    ['picture', 'picture'],
    ...errors,
    ...maps.map((name) => [`heat:${name}`, `heat map: ${name}`]),
  ];
}

const heatKey = (run, name) => `${run.heatmaps[name]}#${name}`;

const errorsOf = new WeakMap(); // image -> {signed, absolute}

function cachedErrors(image, reference, kind) {
  if (!errorsOf.has(image)) errorsOf.set(image, {});
  const known = errorsOf.get(image);
  known[kind] ??= relativeErrors(image, reference, kind);
  return known[kind];
}

/** What a side needs: {view, name, image, reference, map, problem}. */
export async function gather(id, view, table, images) {
  const run = table.runs.find((candidate) => candidate.id === id);
  const name = id === REFERENCE ? 'reference' : run ? `${run.id} ${run.label}` : 'nothing';
  const image = await images.load(id === REFERENCE ? table.reference.file : run?.image);
  const side = {view, name, image};
  if (view.startsWith('heat:'))
    return {...side, map: await images.load(heatKey(run, view.slice(5)))};
  if (!image) return {...side, problem: 'This image is not in the page.'};
  if (!ERRORS[view]) return side;
  const reference = await images.load(table.reference.file);
  if (!reference) return {...side, problem: 'The reference is not in the page.'};
  if (reference.width !== image.width || reference.height !== image.height) {
    return {...side, problem: 'The reference has another size.'};
  }
  return {...side, reference};
}

function painted({width, height}, paint) {
  const canvas = new OffscreenCanvas(width, height);
  const pixels = new ImageData(width, height);
  paint(pixels.data);
  canvas.getContext('2d').putImageData(pixels, 0, 0);
  return canvas;
}

function pictureLayer({image}, {exposure}) {
  const read = (i) => image.planes.map((plane) => pixelValue(HALF_VALUES[plane[i]])).join('  ');
  return {
    picture: painted(image, (bytes) => paintColour(image, exposure, bytes)),
    read,
    legend: {kind: 'picture', exposure},
  };
}

function errorLayer({image, reference, view}, {range}) {
  const values = cachedErrors(image, reference, view);
  const signed = view === 'signed';
  const position = signed ? (value) => 0.5 + value / (2 * range) : (value) => value / range;
  const ramp = signed ? SIGNED : HEAT;
  return {
    picture: painted(image, (bytes) => paintScalar(values, position, ramp, bytes)),
    read: (i) => pixelValue(values[i]),
    legend: {kind: view, range, ramp},
  };
}

function heatLayer({map, view}, scale) {
  const position = heatPosition(scale);
  return {
    picture: painted(map, (bytes) => paintScalar(map.values, position, HEAT, bytes)),
    read: (i) => pixelValue(map.values[i]),
    legend: {
      kind: 'heat',
      ramp: HEAT,
      scale,
      position,
      unit: HEAT_UNITS[view.slice(5)] ?? view.slice(5),
    },
  };
}

/**
 * Layers of both sides: {name, picture, width, height, read(index), legend} or {name, problem}.
 * Heat maps of one kind share a scale, so that their colours compare.
 */
export function paintLayers(sides, settings) {
  return sides.map((side) => {
    if (side.problem || (!side.image && !side.map))
      return {name: side.name, problem: side.problem ?? 'This image is not in the page.'};
    const {width, height} = side.map ?? side.image;
    const layer = side.map
      ? heatLayer(
          side,
          heatScale(
            sides
              .filter((other) => other.map && other.view === side.view)
              .map((other) => other.map),
          ),
        )
      : side.reference
        ? errorLayer(side, settings)
        : pictureLayer(side, settings);
    return {name: side.name, width, height, ...layer};
  });
}
