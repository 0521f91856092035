// Where an image lies on a canvas: zoom and pan, in device pixels.

const MOST = 64; // device pixels for a pixel of the image

/** `scale`: device pixels for a pixel of the image; (x, y): where its top left corner is. */
export function createView() {
  const view = {scale: 1, x: 0, y: 0, fitted: true};
  let canvas = {width: 1, height: 1};
  let image = {width: 1, height: 1};

  const fitScale = () => Math.min(canvas.width / image.width, canvas.height / image.height);

  /** Keeps the picture centred where it is smaller than the canvas, else its edges outside. */
  function hold() {
    for (const [axis, size] of [
      ['x', 'width'],
      ['y', 'height'],
    ]) {
      const room = canvas[size] - image[size] * view.scale;
      view[axis] = room >= 0 ? room / 2 : Math.min(0, Math.max(room, view[axis]));
    }
  }

  return Object.assign(view, {
    /** The canvas or the image has another size: a fitted picture stays so. */
    resize(newCanvas, newImage) {
      canvas = newCanvas;
      image = newImage;
      if (view.fitted) view.fit();
      else hold();
    },
    fit() {
      view.scale = fitScale();
      view.fitted = true;
      hold();
    },
    /** Zooms by `factor` around a point of the canvas. */
    zoomAt(x, y, factor) {
      const scale = Math.min(
        Math.max(view.scale * factor, Math.min(fitScale(), 1)),
        Math.max(MOST, fitScale()),
      );
      view.x = x - (x - view.x) * (scale / view.scale);
      view.y = y - (y - view.y) * (scale / view.scale);
      view.scale = scale;
      view.fitted = Math.abs(scale - fitScale()) < 1e-9;
      hold();
    },
    pan(dx, dy) {
      view.x += dx;
      view.y += dy;
      hold();
    },
    /** Pixel of the image at a point of the canvas; null outside. */
    pixelAt(x, y) {
      const pixel = {
        x: Math.floor((x - view.x) / view.scale),
        y: Math.floor((y - view.y) / view.scale),
      };
      return pixel.x >= 0 && pixel.y >= 0 && pixel.x < image.width && pixel.y < image.height
        ? pixel
        : null;
    },
  });
}
