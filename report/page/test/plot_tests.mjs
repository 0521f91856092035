// The plot of the page of the fixture and its legend.
import assert from 'node:assert/strict';
import {tableOf} from './page_tests.mjs';

const pointIds = async (page) =>
  (await page.$$eval('.point', (points) => points.map((point) => point.dataset.run))).sort();

const key = (page, name) => page.locator(`.legend [data-series="${name}"]`);

export const plotTests = [
  [
    'a point that is pointed at is read, one that is clicked becomes image A',
    async (page) => {
      const {runs} = await tableOf(page);
      const bounds = await page.locator('.point[data-run="0006"]').boundingBox();
      const at = [bounds.x + bounds.width / 2, bounds.y + bounds.height / 2];
      await page.mouse.move(...at);
      const run = runs.find((candidate) => candidate.id === '0006');
      assert.equal(await page.innerText('.reading-name'), `0006 ${run.label}`);
      assert.equal(await page.innerText('.reading-options'), run.options.join(' '));
      const read = async (key) => page.innerText(`.reading dd[data-measure=${key}]`);
      assert.equal(parseFloat(await read('frame_s')), Number(run.frame_s.toPrecision(3)));
      assert.equal(parseFloat(await read('rel_mse')), Number(run.rel_mse.toPrecision(3)));
      assert.match(await read('frame_s'), / s ±2 %$/); // half of the 4 % that its times span
      const cut = await page.$$eval('.reading dl div', (values) =>
        values.filter((value) => value.scrollWidth > value.clientWidth).map((v) => v.innerText),
      );
      assert.deepEqual(cut, []);
      assert.equal(await read('peak_bytes'), `${(run.peak_bytes / 2 ** 20).toFixed(1)} MiB`);
      await page.mouse.click(...at);
      assert.equal(await page.inputValue('select[aria-label="Image A"]'), '0006');
      await page.hover('.point[data-run="0004"]', {force: true});
      assert.match(await read('frame_s'), / s, once$/);
      await page.mouse.move(...at);
      await page.keyboard.down('Shift');
      await page.mouse.click(...at);
      await page.keyboard.up('Shift');
      assert.equal(await page.inputValue('select[aria-label="Image B"]'), '0006');
    },
  ],

  [
    'a click in the legend leaves one series alone, a click on another adds it',
    async (page) => {
      const all = await pointIds(page);
      assert.equal(all.length, 11);
      await key(page, 'hider=bbox').click();
      assert.deepEqual(await pointIds(page), ['0004', '0005', '0006']);
      assert.equal(await page.locator('.ghost').count(), 8);
      await key(page, 'default').click();
      assert.deepEqual((await pointIds(page)).slice(0, 4), ['0001', '0002', '0003', '0004']);
      assert.equal(await key(page, 'default').getAttribute('aria-pressed'), 'true');
      await page.click('.legend .all');
      assert.deepEqual(await pointIds(page), all);
      assert.equal(await key(page, 'default').getAttribute('aria-pressed'), 'false');
      await page.click('.legend .knob'); // all values of the hider
      assert.deepEqual(await pointIds(page), ['0004', '0005', '0006', '0007', '0008', '0009']);
      await page.focus('.legend .knob');
      await page.keyboard.press('Enter');
      assert.deepEqual(await pointIds(page), all);
      assert.ok(await page.$eval('.legend .knob', (knob) => knob === document.activeElement));
    },
  ],

  [
    'a series that is pointed at stands out, and so does that of a point',
    async (page) => {
      const strong = () =>
        page.$$eval('.point.strong', (points) => points.map((point) => point.dataset.run).sort());
      assert.deepEqual(await strong(), []);
      await key(page, 'hider=tct').hover();
      assert.deepEqual(await strong(), ['0007', '0008', '0009']);
      await page.hover('h1');
      assert.deepEqual(await strong(), []);
      await page.hover('.point[data-run="0004"]', {force: true});
      assert.deepEqual(await strong(), ['0004', '0005', '0006']);
    },
  ],

  [
    'values of one knob have colours, the default that of text, other knobs that of the axes',
    async (page) => {
      const fill = (id) =>
        page.$eval(`.point[data-run="${id}"]`, (point) => point.style.fill.replace(/\s/g, ''));
      await page.selectOption('select[aria-label="Colours"]', 'hider');
      assert.deepEqual(
        [await fill('0001'), await fill('0010'), await fill('0004'), await fill('0007')],
        ['var(--ink)', 'var(--faint)', 'var(--series-0)', 'var(--series-1)'],
      );
      assert.match(await page.innerText('.legend'), /default \(auto\)[^]*other knobs/);
      await page.selectOption('select[aria-label="Colours"]', ''); // now a colour is a knob
      assert.equal(await fill('0004'), await fill('0007'));
      assert.notEqual(await fill('0004'), await fill('0010'));
    },
  ],

  [
    'points are one tab stop, and arrow keys go from one to the next',
    async (page) => {
      const {runs} = await tableOf(page);
      const by = (measure) =>
        runs
          .filter((run) => run.ok)
          .sort((a, b) => a[measure] - b[measure])
          .map((run) => run.id);
      const focused = () => page.evaluate(() => document.activeElement.dataset.run);
      assert.equal(await page.locator('.point[tabindex="0"]').count(), 1);
      const costs = by('frame_s');
      await page.focus('.point[tabindex="0"]');
      await page.keyboard.press('Home');
      const walk = [await focused()];
      for (let i = 1; i < costs.length; i += 1) {
        await page.keyboard.press('ArrowRight');
        walk.push(await focused());
      }
      assert.deepEqual(walk, costs);
      assert.ok((await page.innerText('.reading-name')).startsWith(walk.at(-1)));
      await page.keyboard.press('ArrowRight'); // the end
      await page.keyboard.press('ArrowLeft');
      assert.equal(await focused(), costs.at(-2));
      const errors = by('rel_mse').reverse(); // downwards
      await page.focus(`.point[data-run="${errors[3]}"]`);
      await page.keyboard.press('ArrowDown');
      assert.equal(await focused(), errors[4]);
      await page.keyboard.press('Enter');
      assert.equal(await page.inputValue('select[aria-label="Image A"]'), errors[4]);
      assert.equal(await page.locator('.point[tabindex="0"]').count(), 1);
      await page.keyboard.press('Tab');
      assert.equal(await focused(), undefined);
    },
  ],

  [
    'points lie where their values say, on any axes',
    async (page) => {
      const {runs} = await tableOf(page);
      await page.selectOption('select[aria-label="x axis"]', 'shaded_points');
      await page.selectOption('select[aria-label="y axis"]', 'rmse');
      const places = await page.$$eval('.point', (points) =>
        points.map((point) => {
          const [, x, y] = /translate\((.*),(.*)\)/.exec(point.getAttribute('transform'));
          return {id: point.dataset.run, x: Number(x), y: Number(y)};
        }),
      );
      assert.equal(places.length, 11);
      const value = (id, key) => Math.log(runs.find((run) => run.id === id)[key]);
      // Three points lie on one line of log(value) against pixels when slopes between them agree.
      for (const [axis, key] of [
        ['x', 'shaded_points'],
        ['y', 'rmse'],
      ]) {
        const [first, last] = [places[0], places[2]];
        const slope = (last[axis] - first[axis]) / (value(last.id, key) - value(first.id, key));
        assert.ok(axis === 'x' ? slope > 0 : slope < 0);
        for (const place of places) {
          const expected = first[axis] + slope * (value(place.id, key) - value(first.id, key));
          assert.ok(Math.abs(place[axis] - expected) < 0.01, `run ${place.id}, ${key}`);
        }
      }
    },
  ],

  [
    'a value of zero has a place, an unknown one is said to be missing',
    async (page) => {
      await page.selectOption('select[aria-label="x axis"]', 'rays');
      await page.selectOption('select[aria-label="y axis"]', 'visible');
      assert.equal(await page.locator('.point').count(), 10);
      assert.equal(await page.locator('.axis .zero').count(), 1);
      assert.match(await page.innerText('#plot .note'), /^1 of 11 runs/);
    },
  ],
];
