// Error against cost, log-log: a series for each setting, the Pareto front, a reading of one run.
import {select as pick} from 'd3-selection';
import {curveStepAfter, line} from 'd3-shape';
import {drawAxes, hasPlace, logScale} from './axes.js';
import {el, labelled, select} from './dom.js';
import {COSTS, ERRORS, measure, title} from './measures.js';
import {createReading} from './reading.js';
import {neighbour} from './roving.js';
import {groupings, paretoFront, seriesOf} from './series.js';
import {createSeriesLegend} from './series_legend.js';

const HEIGHT = 380;
const REACH = 28; // pixels within which a pointer finds a point
const MANY = 8; // series, from which on their lines step back behind their points

export function showPlot(root, table, state) {
  const svg = pick(el('div'))
    .append('svg')
    .attr('role', 'group')
    .attr('aria-label', 'Plot of the runs; arrow keys go from one to the next');
  const frame = el('div', {class: 'plot-frame', style: `height:${HEIGHT}px`}, svg.node());
  const legend = createSeriesLegend({onchoose: draw, onpoint: emphasise});
  const note = el('p', {class: 'note'});
  let series = [];
  let points = [];

  const axisSelect = (name, choices) =>
    select(
      `${name} axis`,
      choices.map((of) => [of.key, title(of)]),
      state.get(name),
      (value) => state.set({[name]: value}),
    );
  root.append(
    el('h2', {}, 'Error against cost'),
    el(
      'div',
      {class: 'controls'},
      labelled('across', axisSelect('x', COSTS)),
      labelled('up', axisSelect('y', ERRORS)),
      labelled(
        'colours',
        select('Colours', groupings(table), '', (value) => state.set({grouping: value})),
      ),
    ),
    frame,
    legend.root,
    createReading(table, state),
    note,
  );

  function draw() {
    const width = Math.max(frame.clientWidth, 320);
    const box = {left: 64, right: width - 14, top: 12, bottom: HEIGHT - 46};
    const [xOf, yOf] = [measure(state.get('x')), measure(state.get('y'))];
    const placed = (run) => hasPlace(run[xOf.key]) && hasPlace(run[yOf.key]);
    const runs = table.runs.filter((run) => run.ok);
    const x = logScale(runs.filter(placed), xOf, box.left, box.right);
    const y = logScale(runs.filter(placed), yOf, box.bottom, box.top);

    svg.attr('width', width).attr('height', HEIGHT).selectAll('*').remove();
    const axes = [0, 1].map((axis) =>
      svg
        .append('g')
        .attr('class', 'axis')
        .attr('transform', axis === 0 ? `translate(0,${box.bottom})` : `translate(${box.left},0)`)
        .node(),
    );
    drawAxes(axes[0], axes[1], x, y, box);
    svg
      .append('text')
      .attr('class', 'axis-title')
      .attr('x', (box.left + box.right) / 2)
      .attr('y', HEIGHT - 6)
      .attr('text-anchor', 'middle')
      .text(title(xOf));
    svg
      .append('text')
      .attr('class', 'axis-title')
      .attr('text-anchor', 'middle')
      .attr('transform', `translate(13,${(box.top + box.bottom) / 2}) rotate(-90)`)
      .text(title(yOf));

    drawFront(frontOf(runs.filter(placed), xOf.key, yOf.key), x, y, box);
    drawSeries(placed, x, y);
    const missing = runs.length - runs.filter(placed).length;
    note.textContent = missing
      ? `${missing} of ${runs.length} runs have no value on these axes and are not shown.`
      : '';
    mark();
  }

  /** The table's own front for the measures it is of; otherwise that of the axes shown. */
  function frontOf(runs, x, y) {
    const own = x === 'frame_s' && y === 'rel_mse' ? runs.filter((run) => run.pareto) : [];
    return paretoFront(own.length ? own : runs, x, y);
  }

  function drawFront(front, x, y, box) {
    if (front.length === 0) return;
    const corners = front.map((run) => [x.place(run), y.place(run)]);
    corners.unshift([corners[0][0], box.top]);
    corners.push([box.right, corners.at(-1)[1]]);
    svg.append('path').attr('class', 'front').attr('d', line().curve(curveStepAfter)(corners));
  }

  /** Series that are not chosen leave dots behind, which take part in nothing. */
  function drawSeries(placed, x, y) {
    const shown = series.filter((one) => legend.shows(one.name)).reverse(); // the default on top
    const ghosts = series.filter((one) => !legend.shows(one.name));
    const path = line(x.place, y.place);
    svg.classed('many', shown.length > MANY);
    svg
      .append('g')
      .selectAll('circle')
      .data(ghosts.flatMap((one) => one.runs.filter(placed)))
      .join('circle')
      .attr('class', 'ghost')
      .attr('cx', x.place)
      .attr('cy', y.place)
      .attr('r', 2);
    svg
      .append('g')
      .selectAll('path')
      .data(shown.flatMap((one) => one.lines.map((joined) => ({one, joined}))))
      .join('path')
      .attr('class', ({one}) => `series-line ${one.kind}`)
      .attr('data-series', ({one}) => one.name)
      .attr('d', ({joined}) => path(joined.filter(placed)))
      .style('stroke', ({one}) => one.colour);
    points = shown.flatMap((one) =>
      one.runs.filter(placed).map((run) => ({run, one, x: x.place(run), y: y.place(run)})),
    );
    drawPoints();
  }

  function drawPoints() {
    svg
      .append('g')
      .selectAll('path')
      .data(points)
      .join('path')
      .attr('class', (point) => `point ${point.one.kind}`)
      .attr('data-series', (point) => point.one.name)
      .attr('d', (point) => point.one.shape)
      .attr('transform', (point) => `translate(${point.x},${point.y})`)
      .style('fill', (point) => point.one.colour)
      .attr('role', 'button')
      .attr('data-run', (point) => point.run.id)
      .attr('aria-label', (point) => `run ${point.run.id}: ${point.run.label}`)
      .on('focus', (_, point) => read(point))
      .on('blur', () => emphasise(null))
      .on('keydown', (event, point) => {
        if (event.key === 'Enter' || event.key === ' ') choose(event, point);
        else move(event, point);
      });
    svg.append('g').attr('class', 'marks');
  }

  function read(point) {
    state.set({read: point.run.id});
    emphasise([point.one.name]);
  }

  function choose(event, point) {
    event.preventDefault();
    state.set({read: point.run.id, [event.shiftKey ? 'b' : 'a']: point.run.id});
  }

  function move(event, point) {
    const next = neighbour(points, point, event.key);
    if (!next) return;
    event.preventDefault();
    svg.selectAll('.point').filter((other) => other === next).node().focus();
  }

  /** Makes series stand out from the others; null: none does. */
  function emphasise(names) {
    svg.classed('emphasis', names !== null);
    svg.selectAll('[data-series]').classed('strong', function isStrong() {
      return names !== null && names.includes(this.dataset.series);
    });
  }

  /** Rings around the run that is read and the two that are compared. */
  function mark() {
    const marks = svg.select('.marks');
    marks.selectAll('*').remove();
    const at = (id) => points.find((point) => point.run.id === id);
    const now = at(state.get('read'));
    if (now)
      marks.append('circle').attr('class', 'read').attr('cx', now.x).attr('cy', now.y).attr('r', 9);
    const stop = now ?? at(state.get('a')) ?? points[0]; // where the tab key enters
    svg.selectAll('.point').attr('tabindex', (point) => (point === stop ? 0 : -1));
    for (const side of ['a', 'b']) {
      const point = at(state.get(side));
      if (!point) continue;
      marks
        .append('text')
        .attr('class', 'side')
        .attr('x', point.x + (side === 'a' ? -8 : 8))
        .attr('y', point.y - 8)
        .attr('text-anchor', side === 'a' ? 'end' : 'start')
        .text(side.toUpperCase());
    }
  }

  function nearest(event) {
    const bounds = svg.node().getBoundingClientRect();
    const distance = (point) =>
      Math.hypot(point.x - (event.clientX - bounds.left), point.y - (event.clientY - bounds.top));
    const best = points.reduce(
      (found, point) => (!found || distance(point) < distance(found) ? point : found),
      null,
    );
    return best && distance(best) <= REACH ? best : null;
  }

  svg.on('pointermove', (event) => {
    const point = nearest(event);
    svg.style('cursor', point ? 'pointer' : null);
    if (point) read(point);
    else emphasise(null);
  });
  svg.on('pointerleave', () => emphasise(null));
  svg.on('click', (event) => {
    const point = nearest(event);
    if (point) choose(event, point);
  });
  function regroup() {
    series = seriesOf(table, state.get('grouping'));
    legend.show(series);
  }
  state.listen(['grouping'], regroup);
  state.listen(['x', 'y', 'grouping'], draw);
  state.listen(['read', 'a', 'b'], mark);
  regroup();
  new ResizeObserver(draw).observe(frame);
}
