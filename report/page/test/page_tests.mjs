// Summary and tables of the page of the fixture.
import assert from 'node:assert/strict';
import {resize} from './resize.mjs';

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
      const start = shown[1].replace(/ …$/, '');
      assert.ok(start.length < 140 && notes[2].startsWith(start), start);
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
        await resize(page, {width, height: 900});
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
        await resize(page, {width, height: 900});
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
      assert.equal(await page.innerText('#tables thead th:nth-child(6) small'), '%');
      assert.equal(await page.innerText('#tables tbody td >> nth=1'), '200 k');
      assert.match(await page.innerText('#tables .tally'), /1 failed\s*5 ok/);
    },
  ],

  [
    'tables besides keep their first column in sight, and align words among numbers as these',
    async (page) => {
      await resize(page, {width: 390, height: 900});
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
        await resize(page, {width, height: 900});
        const wider = await page.evaluate(
          () => document.documentElement.scrollWidth - window.innerWidth,
        );
        assert.ok(wider <= 0, `${wider} pixels too wide at ${width}`);
      }
    },
  ],
];
