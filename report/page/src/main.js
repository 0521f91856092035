// Puts the page together.
import {showCompare} from './compare.js';
import {createImageStore, readCatalogue, readTable} from './data.js';
import {showPlot} from './plot.js';
import {showRuns} from './runs_table.js';
import {createState, REFERENCE} from './state.js';
import {showSummary} from './summary.js';
import {showTables} from './tables.js';

const table = readTable();
const catalogue = readCatalogue();
const images = createImageStore(catalogue);

/** The first run to look at: the default, else the Pareto front, else any that has its image. */
function firstRun() {
  const shown = table.runs.filter((run) => run.ok && images.has(run.image));
  const plain = (run) => Object.keys(run.settings ?? {}).every((name) => name === 'spp');
  return shown.find(plain) ?? shown.find((run) => run.pareto) ?? shown[0];
}

const state = createState({
  x: 'frame_s',
  y: 'rel_mse',
  grouping: '',
  read: null,
  a: firstRun()?.id ?? null,
  b: REFERENCE,
  viewA: 'picture',
  viewB: 'picture',
  exposure: 0,
  range: 0.3,
});

showSummary(document.getElementById('summary'), table);
showPlot(document.getElementById('plot'), table, state);
showCompare(document.getElementById('compare'), table, catalogue, images, state);
showRuns(document.getElementById('runs'), table, images, state);
showTables(document.getElementById('tables'), table);
