// The comparison of images: pixels of the canvas against what the fixture's formulas give.
import assert from 'node:assert/strict';
import {resize} from './resize.mjs';

const [WIDTH, HEIGHT] = [64, 36];

/** Linear R, G, B of pixel (x, y) of run k of the fixture; 0 is the reference. */
function linear(run, x, y) {
  const gain = run === 0 ? 1 : 1 + run / 16;
  return [(gain * (x + 0.5)) / WIDTH, (gain * (y + 0.5)) / HEIGHT, gain / 4];
}

function srgb(value) {
  const v = Math.min(Math.max(value, 0), 1);
  return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
}

function linearOfSrgb(code) {
  const v = code / 255;
  return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
}

/** The colour on the canvas in the middle of pixel (x, y) of the image, which fills it. */
const pixel = (page, x, y) =>
  page.evaluate(
    ([u, v]) => {
      const canvas = document.querySelector('.stage canvas');
      const place = [Math.floor(u * canvas.width), Math.floor(v * canvas.height)];
      return [...canvas.getContext('2d').getImageData(...place, 1, 1).data].slice(0, 3);
    },
    [(x + 0.5) / WIDTH, (y + 0.5) / HEIGHT],
  );

function near(colour, expected, tolerance, what) {
  const worst = Math.max(...colour.map((value, c) => Math.abs(value - expected[c])));
  assert.ok(
    worst <= tolerance,
    `${what}: ${colour}, expected ${expected.map((value) => value.toFixed(1))}`,
  );
}

/** Does something that paints anew, and waits until it has. */
async function painted(page, action) {
  const before = await page.getAttribute('#compare', 'data-shown');
  await action();
  await page.waitForFunction(
    (shown) => document.querySelector('#compare').dataset.shown !== shown,
    before,
  );
}

const choose = (page, name, value) =>
  painted(page, () => page.selectOption(`select[aria-label="${name}"]`, value));

const setExposure = (page, stops) =>
  painted(page, () => page.locator('input[aria-label="Exposure in stops"]').fill(String(stops)));

/** What the page says of pixel (x, y) of the image under the pointer. */
async function readPixel(page, x, y) {
  const box = await page.locator('.stage').boundingBox();
  await page.mouse.move(
    box.x + ((x + 0.5) / WIDTH) * box.width,
    box.y + ((y + 0.5) / HEIGHT) * box.height,
  );
  return page.innerText('.pixel');
}

async function dragSlider(page, fraction) {
  const stage = await page.locator('.stage').boundingBox();
  const handle = await page.locator('.handle').boundingBox();
  const y = stage.y + stage.height / 2;
  await page.mouse.move(handle.x + handle.width / 2, y);
  await page.mouse.down();
  await page.mouse.move(stage.x + fraction * stage.width, y, {steps: 5});
  await page.mouse.up();
}

/** Checks that run `a` is left of `split`, in pixels of the image, and `b` right of it. */
async function checkSplit(page, a, b, split) {
  for (const y of [0, 17, 35]) {
    for (const x of [1, 12, 20, 30, 34, 45, 62]) {
      if (Math.abs(x + 0.5 - split) < 2) continue;
      const run = x < split ? a : b;
      near(
        await pixel(page, x, y),
        linear(run, x, y).map(srgb),
        1,
        `run ${run} at (${x}, ${y}), split at ${split}`,
      );
    }
  }
}

export const compareTests = [
  [
    'image A is left of the slider, image B right of it',
    async (page) => {
      await checkSplit(page, 1, 0, 32);
      await dragSlider(page, 0.25);
      await checkSplit(page, 1, 0, 16);
      await choose(page, 'Image B', '0010');
      await checkSplit(page, 1, 10, 16);
      await page.focus('.handle');
      await page.keyboard.press('End');
      assert.equal(await page.getAttribute('.handle', 'aria-valuenow'), '100');
      await checkSplit(page, 1, 10, 64);
      await page.keyboard.press('Home');
      for (let i = 0; i < 25; i += 1) await page.keyboard.press('ArrowRight');
      await checkSplit(page, 1, 10, 32);
      await painted(page, () => page.click('button[aria-label="Swap A and B"]'));
      await checkSplit(page, 10, 1, 32);
    },
  ],

  [
    'a stop of exposure doubles what is shown',
    async (page) => {
      const before = (await pixel(page, 20, 10)).map(linearOfSrgb);
      await setExposure(page, 1);
      const after = (await pixel(page, 20, 10)).map(linearOfSrgb);
      after.forEach((value, c) =>
        assert.ok(Math.abs(value / before[c] - 2) < 0.03, `${before} became ${after}`),
      );
      await setExposure(page, -2);
      near(
        await pixel(page, 20, 10),
        linear(1, 20, 10).map((value) => srgb(value / 4)),
        1,
        'two stops down',
      );
    },
  ],

  [
    'values that are no numbers are magenta, huge ones white, negative ones black',
    async (page) => {
      await choose(page, 'Image A', '0005');
      near(await pixel(page, 10, 5), [255, 0, 255], 0, 'NaN');
      near(await pixel(page, 20, 5), [255, 255, 255], 0, '1e30');
      assert.match(await readPixel(page, 10, 5), /^\(10, 5\) +A NaN  NaN  NaN +B 0\.164 /);
      assert.match(await readPixel(page, 30, 5), /A ∞ /);
      assert.match(await readPixel(page, 40, 5), /A −1\.00 /);
      near(await pixel(page, 30, 5), [255, 0, 255], 0, 'infinity in one channel');
      near(await pixel(page, 11, 5), linear(5, 11, 5).map(srgb), 1, 'beside NaN');
      await page.focus('.handle');
      await page.keyboard.press('End');
      near(await pixel(page, 40, 5), [0, 0, 0], 0, 'negative');
      await choose(page, 'View of image A', 'absolute');
      near(await pixel(page, 10, 5), [255, 0, 255], 0, 'error of NaN');
      near(await pixel(page, 20, 5), [255, 255, 184], 0, 'error of 1e30: the end of the ramp');
    },
  ],

  [
    'relative errors are in false colour, with their scale and their values',
    async (page) => {
      const error = (x, y) =>
        linear(1, x, y).map(
          (a, c) => (a - linear(0, x, y)[c]) / Math.sqrt(linear(0, x, y)[c] ** 2 + 0.01),
        );
      await choose(page, 'View of image A', 'absolute');
      await choose(page, 'Error scale', '0.1');
      const read = async (x, y) => {
        const [, value] = /A (\S+)/.exec(await readPixel(page, x, y));
        return Number(value.replace('−', '-'));
      };
      const absolute = Math.sqrt(error(9, 30).reduce((sum, e) => sum + e * e, 0) / 3);
      assert.ok(
        Math.abs((await read(9, 30)) / absolute - 1) < 0.02,
        `${await read(9, 30)}, expected ${absolute}`,
      );
      assert.match(await page.innerText('.layer-legend >> nth=0'), /0\s*5 %\s*≥ 10 %/);
      const strong = await pixel(page, 25, 30);
      await choose(page, 'Error scale', '1');
      const weak = await pixel(page, 25, 30);
      assert.ok(
        strong.reduce((a, b) => a + b) > weak.reduce((a, b) => a + b) + 50,
        `${strong} is not brighter than ${weak}`,
      );

      await choose(page, 'View of image A', 'signed');
      const signed = error(9, 30).reduce((sum, e) => sum + e, 0) / 3;
      assert.ok(Math.abs((await read(9, 30)) / signed - 1) < 0.02);
      const [red, , blue] = await pixel(page, 9, 30); // brighter than the reference: warm
      assert.ok(red > blue, `${red}, ${blue}`);
    },
  ],

  [
    'heat maps are black at zero, pale at the highest, and share a scale',
    async (page) => {
      await choose(page, 'View of image A', 'heat:tests');
      near(await pixel(page, 0, 20), [0, 0, 0], 0, 'no tests');
      const alone = await pixel(page, 30, 20);
      const legend = page.locator('.layer-legend >> nth=0');
      assert.match(await legend.innerText(), /tests per pixel.*black is none; mean 31\.5/);
      const ticks = legend.locator('.ticks span');
      assert.deepEqual(await ticks.allInnerTexts(), ['1.00', '7.94', '63.0']);
      await choose(page, 'Image B', '0004');
      await choose(page, 'View of image B', 'heat:tests');
      near(await pixel(page, 63, 20), [255, 255, 184], 1, 'most tests');
      assert.match(await page.innerText('.layer-legend >> nth=0'), /252/);
      const shared = await pixel(page, 30, 20);
      assert.ok(
        shared.reduce((a, b) => a + b) < alone.reduce((a, b) => a + b),
        `${shared} is not darker than ${alone}`,
      );
      assert.deepEqual(
        await page.$$eval('select[aria-label="View of image B"] option', (options) =>
          options.map((o) => o.value),
        ),
        ['picture', 'signed', 'absolute', 'heat:tests'],
      );
    },
  ],

  [
    'zooming keeps the point under the pointer, and fit goes back',
    async (page) => {
      const box = await page.locator('.stage').boundingBox();
      const scale = () => page.locator('.stage').getAttribute('data-scale').then(Number);
      const fitted = await scale();
      await page.mouse.move(
        box.x + (10.5 / WIDTH) * box.width,
        box.y + (20.5 / HEIGHT) * box.height,
      );
      const under = await page.innerText('.pixel');
      assert.match(under, /^\(10, 20\)/);
      await page.mouse.down();
      await page.mouse.up(); // the wheel is the image's from now on
      for (let i = 0; i < 4; i += 1) await page.mouse.wheel(0, -100);
      await page.waitForFunction(
        (before) => Number(document.querySelector('.stage').dataset.scale) > 2 * before,
        fitted,
      );
      await page.mouse.move(
        box.x + (10.5 / WIDTH) * box.width + 1,
        box.y + (20.5 / HEIGHT) * box.height,
      );
      assert.equal(await page.innerText('.pixel'), under);
      await page.click('button[aria-label="Fit the view"]');
      assert.equal(await scale(), fitted);
      await checkSplit(page, 1, 0, 32);
    },
  ],

  [
    'the wheel passes over the image unless it was pressed on, and again when the pointer has left',
    async (page) => {
      await resize(page, {width: 800, height: 500});
      const state = () =>
        page.evaluate(() => [
          Math.round(window.scrollY),
          Number(document.querySelector('.stage').dataset.scale),
        ]);
      await page.locator('.stage').scrollIntoViewIfNeeded();
      const over = async () => {
        const box = await page.locator('.stage').boundingBox();
        await page.mouse.move(box.x + 100, box.y + 100);
      };
      const wheel = async (dy) => {
        const before = await state();
        await page.mouse.wheel(0, dy);
        await page.waitForFunction(
          ([y, scale]) =>
            Math.round(window.scrollY) !== y ||
            Number(document.querySelector('.stage').dataset.scale) !== scale,
          before,
        );
        const after = await state();
        return {scrolled: after[0] !== before[0], zoomed: after[1] !== before[1]};
      };
      await over();
      assert.deepEqual(await wheel(-60), {scrolled: true, zoomed: false});
      await over();
      await page.mouse.down();
      await page.mouse.up();
      assert.deepEqual(await wheel(-60), {scrolled: false, zoomed: true});
      await page.mouse.move(5, 5);
      await over();
      assert.deepEqual(await wheel(60), {scrolled: true, zoomed: false});
    },
  ],

  [
    'a finger scrolls past the image until it is zoomed in on, and the hint is not cut',
    async (page) => {
      await resize(page, {width: 390, height: 844});
      const action = () => page.$eval('.stage canvas', (canvas) => canvas.style.touchAction);
      assert.equal(await action(), 'pan-y');
      await page.click('button[aria-label="Zoom in"]');
      assert.equal(await action(), 'none');
      for (const line of ['.pixel', '.reading-options', '.reading-name']) {
        const [wide, high] = await page.$eval(line, (text) => [
          text.scrollWidth - text.clientWidth,
          text.scrollHeight - text.clientHeight,
        ]);
        assert.ok(wide <= 0 && high <= 0, `${line} lacks ${wide} by ${high} pixels`);
      }
    },
  ],

  [
    'an image larger than a page holds is shown smaller, which the page says',
    async (page) => {
      assert.match(await page.innerText('#compare .reduced'), /mean of up to 2 × 2 pixels/);
      await choose(page, 'Image A', '0011');
      await choose(page, 'Image B', '0011');
      const {ratio, middle} = await page.$eval('.stage canvas', (canvas) => ({
        ratio: canvas.clientWidth / canvas.clientHeight,
        middle: [
          ...canvas
            .getContext('2d')
            .getImageData(Math.floor(canvas.width / 2), Math.floor(canvas.height / 4), 1, 1).data,
        ].slice(0, 3),
      }));
      assert.ok(Math.abs(ratio / (1282 / 4) - 1) < 0.3, `${ratio}`);
      const gain = 1 + 11 / 16; // at half the width, in the upper of the two rows left of four
      near(middle, [gain / 2, gain / 4, gain / 4].map(srgb), 2, 'the middle');
    },
  ],

  [
    'the layout stays while one looks around',
    async (page) => {
      const tops = () =>
        page.$$eval('section', (sections) =>
          sections.map((section) => section.getBoundingClientRect().top + window.scrollY),
        );
      await resize(page, {width: 800, height: 900}); // all in one column
      const before = await tops();
      await page.hover('.point[data-run="0009"]', {force: true});
      await page.hover('.stage');
      for (const view of ['absolute', 'signed', 'heat:tests']) {
        await choose(page, 'View of image A', view);
        assert.deepEqual(await tops(), before, view);
      }
    },
  ],
];
