// Summary, plot and tables of the page of the fixture.
import assert from 'node:assert/strict';

/** The table as the page holds it. */
export const tableOf = (page) =>
  page.evaluate(() => JSON.parse(document.getElementById('trade-table').textContent));

const rowIds = (page) =>
  page.$$eval('.runs tbody tr', (rows) => rows.map((row) => row.dataset.run));

/** Ids by a value, unknown ones last, failed runs after all; equal ones as they were. */
function expectedOrder(runs, valueOf, direction) {
  const known = (run) => valueOf(run) !== null && valueOf(run) !== undefined;
  const ok = runs.filter((run) => run.ok);
  const sorted = ok
    .filter(known)
    .sort((a, b) => direction * (valueOf(a) < valueOf(b) ? -1 : valueOf(a) > valueOf(b) ? 1 : 0));
  const others = [false, true].flatMap((left_out) =>
    runs.filter((run) => !run.ok && Boolean(run.not_run) === left_out),
  );
  return [...sorted, ...ok.filter((run) => !known(run)), ...others].map((run) => run.id);
}

async function clickAndRead(page, column) {
  await page.click(`.runs th[data-column=${column}] button`);
  return {
    order: await rowIds(page),
    sort: await page.getAttribute(`.runs th[data-column=${column}]`, 'aria-sort'),
  };
}

const pointIds = async (page) =>
  (await page.$$eval('.point', (points) => points.map((point) => point.dataset.run))).sort();

const key = (page, name) => page.locator(`.legend [data-series="${name}"]`);

export const pageTests = [
  [
    'the summary says what was rendered, on what, against what',
    async (page) => {
      const text = await page.innerText('#summary');
      for (const part of [
        '<fixture>.rib',
        'More samples & <less> error.',
        'a processor, 2 cores',
        '1024 samples per pixel',
        '13, of which 1 failed, 1 was not run',
        '1.00e−5',
      ]) {
        assert.ok(text.includes(part), `no "${part}" in: ${text}`);
      }
      assert.equal(await page.title(), '<fixture>.rib: error against cost');
      await page.click('.particulars summary');
      assert.match(await page.innerText('.particulars'), /0123456789abcdef[^]*--spp 1024/);
    },
  ],

  [
    'four findings are shown and the others folded, so that the plot starts on the first screen',
    async (page) => {
      assert.equal(await page.locator('.words li:visible').count(), 4);
      assert.equal(await page.innerText('.words summary'), '2 more findings');
      const plot = await page.locator('.plot-frame').boundingBox();
      assert.ok(plot.y < 450, `the plot starts at ${plot.y}`);
      await page.click('.words summary');
      assert.match(await page.innerText('.words'), /Finding 6 of the sweep/);
    },
  ],

  [
    'notes are shown: the grave ones first, long ones with their start',
    async (page) => {
      const {notes} = await tableOf(page);
      const shown = await page.locator('.notes > ul > li').allInnerTexts();
      assert.equal(shown.length, 3);
      assert.equal(shown[0], notes[1]);
      assert.ok(shown[1].length < 140 && notes[2].startsWith(shown[1].replace(/ …$/, '')), shown[1]);
      assert.equal(shown[2], notes[3]);
      await page.click('.notes .long summary');
      assert.ok((await page.innerText('.notes .long p')).endsWith('spp=40'));
      await page.click('.notes > details > summary');
      assert.ok((await page.innerText('.notes')).includes(notes[0]));
    },
  ],

  [
    'a run that was left out is not failed: grey, and after those that are',
    async (page) => {
      assert.equal(await page.innerText('.runs tr[data-run="0013"] .reason'), 'not run');
      const colour = (id) =>
        page
          .locator(`.runs tr[data-run="${id}"] .reason`)
          .evaluate((cell) => getComputedStyle(cell).color.match(/\d+/g).map(Number));
      const spread = ([r, g, b]) => Math.max(r, g, b) - Math.min(r, g, b);
      assert.ok(spread(await colour('0013')) < 40, `not run: ${await colour('0013')}`);
      assert.ok(spread(await colour('0012')) > 100, `failed: ${await colour('0012')}`);
      await page.click('.runs th[data-column=id] button');
      await page.click('.runs th[data-column=id] button');
      assert.deepEqual((await rowIds(page)).slice(-2), ['0012', '0013']);
      assert.equal(await page.locator('.point[data-run="0013"]').count(), 0);
    },
  ],

  [
    'text with markup is shown as text',
    async (page) => {
      assert.equal(
        await page.innerText('.runs tr[data-run="0008"] .label'),
        'hider=<b>tct</b></script><script>alert(1)</script><!-- spp=16',
      );
      assert.equal(
        await page.innerText('.runs tr[data-run="0012"] .reason'),
        'failed: no memory: <b>4 GiB</b> needed</script>',
      );
      assert.equal(await page.innerText('#tables tbody th'), 'blur of <i>1000</i> pixels');
      assert.equal(await page.locator('.runs b, #tables i').count(), 0);
    },
  ],

  [
    'the table sorts by numbers and by text, both ways',
    async (page) => {
      const {runs} = await tableOf(page);
      for (const column of ['frame_s', 'rays', 'rel_mse', 'id']) {
        for (const [direction, name] of [
          [1, 'ascending'],
          [-1, 'descending'],
        ]) {
          const {order, sort} = await clickAndRead(page, column);
          assert.equal(sort, name);
          assert.deepEqual(
            order,
            expectedOrder(runs, (run) => run[column], direction),
            `by ${column}, ${name}`,
          );
        }
      }
      assert.equal(await page.locator('.runs th:not([aria-sort=none])[data-column]').count(), 1);
      const {order} = await clickAndRead(page, 'label'); // 4 before 16 before 64
      assert.deepEqual(
        order.filter((id) => id < '0004'),
        ['0001', '0002', '0003'],
      );
    },
  ],

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

  [
    'a run whose error the reference hides is marked',
    async (page) => {
      assert.match(await page.innerText('#summary .facts'), /It hides that of 1 run\./);
      const {runs} = await tableOf(page);
      const marked = await page.$$eval('.runs tbody tr', (rows) =>
        rows.filter((row) => /~ \d/.test(row.innerText)).map((row) => row.dataset.run),
      );
      assert.deepEqual(
        marked,
        runs.filter((run) => run.limited_by_reference).map((run) => run.id),
      );
      assert.match(await page.innerText('#runs h2'), /~: the reference's own error/);
    },
  ],

  [
    'headings end where their numbers do, and time and error are seen on a telephone',
    async (page) => {
      await page.click('.runs th[data-column=cpu_s] button'); // the arrow takes no room
      for (const width of [1280, 390]) {
        await page.setViewportSize({width, height: 900});
        const gaps = await page.evaluate(() => {
          const end = (cell) => {
            const range = document.createRange();
            range.selectNodeContents(cell);
            return Math.max(...[...range.getClientRects()].map((box) => box.right));
          };
          const numbers = document.querySelectorAll('.runs tbody tr:first-child td.number');
          return [...document.querySelectorAll('.runs th.number')].map(
            (heading, i) => end(heading.querySelector('button')) - end(numbers[i]),
          );
        });
        assert.equal(gaps.length, 10);
        assert.ok(Math.max(...gaps.map(Math.abs)) <= 1, `at ${width}: ${gaps}`);
      }
      const [frame, error] = await page.$eval('.runs', (runs) => {
        const edge = runs.parentElement.getBoundingClientRect().right;
        return ['frame_s', 'rel_mse'].map(
          (column) =>
            edge - runs.querySelector(`th[data-column=${column}]`).getBoundingClientRect().right,
        );
      });
      assert.ok(frame > error && error >= 0, `${frame}, ${error}`);
    },
  ],

  [
    'tables besides show their verdicts without scrolling, next to what they are about',
    async (page) => {
      for (const width of [390, 1280, 1920]) {
        await page.setViewportSize({width, height: 900});
        const {right, edge} = await page.$eval('#tables .scroll', (frame) => ({
          right: frame.querySelector('td .verdict').getBoundingClientRect().right,
          edge: frame.getBoundingClientRect().right,
        }));
        assert.ok(right <= edge, `the verdict ends at ${right} of ${edge} at ${width}`);
      }
      const header = await page.locator('#tables thead th').allInnerTexts();
      const names = ['case', 'verdict', 'compared', 'frame', 'worst error', 'time saved', 'oracle'];
      assert.deepEqual(
        header.map((text) => text.replace(/\s*[s%]$/, '').trim()),
        names,
      );
      assert.equal(await page.locator('#tables thead th >> nth=5').locator('small').innerText(), '%');
      assert.equal(await page.innerText('#tables tbody td >> nth=1'), '200 k');
      assert.match(await page.innerText('#tables .tally'), /1 failed\s*5 ok/);
    },
  ],

  [
    'tables besides keep their first column in sight, and align words among numbers as these',
    async (page) => {
      await page.setViewportSize({width: 390, height: 900});
      const cells = () =>
        page.$eval('#tables .scroll', (frame) => {
          const [first, second] = frame.querySelectorAll('tbody tr:first-child > *');
          return [first, second].map((cell) => cell.getBoundingClientRect().left);
        });
      const before = await cells();
      const moved = await page.$eval('#tables .scroll', (frame) => {
        frame.scrollLeft = 120;
        return frame.scrollLeft;
      });
      assert.equal(moved, 120);
      assert.deepEqual(await cells(), [before[0], before[1] - 120]);
      const words = page.locator('#tables td', {hasText: 'at least 3.17'});
      assert.equal(await words.evaluate((cell) => getComputedStyle(cell).textAlign), 'right');
    },
  ],

  [
    'nothing overflows sideways, on wide and narrow screens',
    async (page) => {
      for (const width of [1920, 1280, 800, 390]) {
        await page.setViewportSize({width, height: 900});
        const wider = await page.evaluate(
          () => document.documentElement.scrollWidth - window.innerWidth,
        );
        assert.ok(wider <= 0, `${wider} pixels too wide at ${width}`);
      }
    },
  ],
];
