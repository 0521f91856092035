// Opens a page in headless Chromium and uses it as a reader would.
// usage: node browser.mjs --modules FOLDER --fixture REPORT_TESTS
// FOLDER holds node_modules; REPORT_TESTS is the C++ test program, which writes the page to open.
import {execFileSync} from 'node:child_process';
import {existsSync, mkdtempSync, rmSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';
import {compareTests} from './compare_tests.mjs';
import {pageTests} from './page_tests.mjs';
import {plotTests} from './plot_tests.mjs';

const CHROMIUM = '/usr/bin/chromium';
const FLAGS = [
  '--headless',
  '--no-sandbox',
  '--disable-gpu',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];

function argument(name) {
  const at = process.argv.indexOf(name);
  if (at < 0) throw new Error(`expected ${name} and a value`);
  return process.argv[at + 1];
}

/** The page of the fixture of tests/report/fixture.h. */
function writePage(program, folder) {
  execFileSync(resolve(program), ['A report holds its table and images*'], {
    env: {...process.env, TESSERA_REPORT_FIXTURE: folder},
    stdio: ['ignore', 'ignore', 'inherit'],
  });
  const page = join(folder, 'page.html');
  if (!existsSync(page)) throw new Error(`${program} did not write ${page}`);
  return page;
}

/** What a page must never do, gathered while it is open. */
function watch(page, url) {
  const complaints = [];
  page.on('console', (message) => complaints.push(`console ${message.type()}: ${message.text()}`));
  page.on('pageerror', (error) => complaints.push(`uncaught: ${error.message}`));
  page.on('dialog', (dialog) => {
    complaints.push(`dialog: ${dialog.message()}`);
    dialog.dismiss();
  });
  page.on('request', (request) => {
    if (request.url() !== url) complaints.push(`request: ${request.url().slice(0, 120)}`);
  });
  return complaints;
}

async function run(folder) {
  const {chromium} = createRequire(resolve(argument('--modules'), 'package.json'))(
    'playwright-core',
  );
  const file = writePage(argument('--fixture'), join(folder, 'fixture'));
  const url = pathToFileURL(file).href;
  const context = await chromium.launchPersistentContext(join(folder, 'profile'), {
    executablePath: CHROMIUM,
    headless: true,
    args: FLAGS,
    viewport: {width: 1280, height: 900},
  });
  let failures = 0;
  try {
    for (const [name, test] of [...pageTests, ...plotTests, ...compareTests]) {
      const page = await context.newPage();
      page.setDefaultTimeout(15000);
      const complaints = watch(page, url);
      try {
        await page.goto(url);
        await page.waitForSelector('#compare[data-shown]');
        await test(page);
        if (complaints.length) throw new Error(complaints.join('\n'));
        console.log(`ok      ${name}`);
      } catch (error) {
        failures += 1;
        console.log(`FAILED  ${name}\n${error.message}\n${complaints.join('\n')}`);
      }
      await page.close();
    }
  } finally {
    await context.close();
  }
  return failures;
}

if (!existsSync(CHROMIUM)) {
  console.error(`error: the test of the report's page needs ${CHROMIUM} (Debian: chromium)`);
  process.exit(1);
}
const folder = mkdtempSync(join(tmpdir(), 'tessera-report-'));
try {
  process.exitCode = (await run(folder)) === 0 ? 0 : 1;
} finally {
  rmSync(folder, {recursive: true, force: true, maxRetries: 5, retryDelay: 100});
}
