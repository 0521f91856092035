// The canvas with two layers and the slider between them: painting, zoom, pan, reading of a pixel.
import {el} from './dom.js';
import {createView} from './view.js';

const STEP = 0.02; // of the width, for an arrow key
const PAN = 40; // device pixels, for an arrow key

/** `onread(pixel)`: the pixel of the image under the pointer, or null. */
export function createStage(onread) {
  const canvas = el('canvas', {
    tabindex: 0,
    role: 'img',
    'aria-label':
      'Image A left of the slider, image B right of it. Arrow keys pan, plus and minus zoom, 0 fits.',
  });
  const handle = el(
    'div',
    {
      class: 'handle',
      role: 'slider',
      tabindex: 0,
      'aria-label': 'Where image A ends and B begins',
      'aria-valuemin': 0,
      'aria-valuemax': 100,
      'aria-orientation': 'horizontal',
    },
    el('span', {}, '⟺'),
  );
  const root = el('div', {class: 'stage'}, canvas, handle);
  const context = canvas.getContext('2d', {willReadFrequently: true});
  const view = createView();
  let layers = [];
  let split = 0.5;
  let taken = false; // the wheel is the image's, from a press on it until the pointer leaves

  const ratio = () => window.devicePixelRatio || 1;
  const sized = () => layers.find((layer) => layer.width);

  function draw() {
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    const edge = Math.round(split * canvas.width);
    drawLayer(layers[0], 0, edge);
    drawLayer(layers[1], edge, canvas.width);
    handle.style.left = `${split * 100}%`;
    handle.setAttribute('aria-valuenow', Math.round(split * 100));
    handle.setAttribute('aria-valuetext', `A to ${Math.round(split * 100)} percent of the width`);
    root.dataset.scale = view.scale;
    // A finger moves what is zoomed in on; the page otherwise.
    canvas.style.touchAction = view.fitted ? 'pan-y' : 'none';
  }

  /** Draws what of a layer is between two columns of the canvas. */
  function drawLayer(layer, from, to) {
    if (!layer?.picture || to <= from) return;
    context.save();
    context.beginPath();
    context.rect(from, 0, to - from, canvas.height);
    context.clip();
    context.imageSmoothingEnabled = view.scale < 1;
    context.imageSmoothingQuality = 'high';
    context.drawImage(
      layer.picture,
      view.x,
      view.y,
      layer.width * view.scale,
      layer.height * view.scale,
    );
    context.restore();
  }

  function resize() {
    const image = sized();
    if (image) root.style.aspectRatio = `${image.width} / ${image.height}`;
    canvas.width = Math.max(1, Math.round(root.clientWidth * ratio()));
    canvas.height = Math.max(1, Math.round(root.clientHeight * ratio()));
    view.resize(canvas, image ?? canvas);
    draw();
  }

  function point(event) {
    const bounds = canvas.getBoundingClientRect();
    return {x: (event.clientX - bounds.left) * ratio(), y: (event.clientY - bounds.top) * ratio()};
  }

  function moveSplit(to) {
    split = Math.min(Math.max(to, 0), 1);
    draw();
  }

  /** Follows the pointer from a press on `element` to its release. */
  function drag(element, onmove) {
    element.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      element.setPointerCapture(event.pointerId);
      let before = point(event);
      const move = (moved) => {
        const now = point(moved);
        onmove(now, before);
        before = now;
      };
      element.addEventListener('pointermove', move);
      element.addEventListener(
        'lostpointercapture',
        () => element.removeEventListener('pointermove', move),
        {once: true},
      );
    });
  }

  drag(handle, (now) => moveSplit(now.x / canvas.width));
  drag(canvas, (now, before) => {
    view.pan(now.x - before.x, now.y - before.y);
    draw();
  });
  function take(now) {
    taken = now;
    root.classList.toggle('taken', now);
  }
  canvas.addEventListener('pointerdown', () => take(true));
  root.addEventListener('pointerleave', () => take(false));
  canvas.addEventListener(
    'wheel',
    (event) => {
      if (!taken && !event.ctrlKey) return; // a reader on the way down the page
      const [at, before] = [point(event), view.scale];
      view.zoomAt(at.x, at.y, 2 ** (-Math.sign(event.deltaY) / 3));
      if (view.scale === before && !event.ctrlKey) return; // as small as it gets
      event.preventDefault();
      draw();
    },
    {passive: false},
  );
  canvas.addEventListener('pointermove', (event) => {
    const at = point(event);
    onread(view.pixelAt(at.x, at.y));
  });
  canvas.addEventListener('pointerleave', () => onread(null));

  function zoom(factor) {
    view.zoomAt(canvas.width / 2, canvas.height / 2, factor);
    draw();
  }
  const fit = () => {
    view.fit();
    draw();
  };
  const pan = (dx, dy) => {
    view.pan(dx, dy);
    draw();
  };
  keys(handle, {
    ArrowLeft: () => moveSplit(split - STEP),
    ArrowRight: () => moveSplit(split + STEP),
    ArrowDown: () => moveSplit(split - STEP),
    ArrowUp: () => moveSplit(split + STEP),
    PageDown: () => moveSplit(split - 0.1),
    PageUp: () => moveSplit(split + 0.1),
    Home: () => moveSplit(0),
    End: () => moveSplit(1),
  });
  keys(canvas, {
    ArrowLeft: () => pan(PAN, 0),
    ArrowRight: () => pan(-PAN, 0),
    ArrowUp: () => pan(0, PAN),
    ArrowDown: () => pan(0, -PAN),
    '+': () => zoom(1.5),
    '=': () => zoom(1.5),
    '-': () => zoom(1 / 1.5),
    0: fit,
  });
  new ResizeObserver(resize).observe(root);

  return {
    root,
    zoom,
    fit,
    /** One pixel of the image is one of the screen. */
    actualSize: () => zoom(1 / view.scale),
    /** Shows layers A and B; the view stays where it is unless their size changes. */
    show(newLayers) {
      const before = sized();
      layers = newLayers;
      const now = sized();
      if (before?.width !== now?.width || before?.height !== now?.height) resize();
      else draw();
    },
  };
}

function keys(element, actions) {
  element.addEventListener('keydown', (event) => {
    const action = actions[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
  });
}
