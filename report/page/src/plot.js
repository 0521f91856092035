// Error against cost, log-log: a series for each setting, the Pareto front, a reading of one run.
import {select as pick} from 'd3-selection';
import {
  curveStepAfter,
  line,
  symbol,
  symbolCircle,
  symbolCross,
  symbolDiamond,
  symbolSquare,
  symbolTriangle,
} from 'd3-shape';
import {drawAxes, hasPlace, logScale} from './axes.js';
import {el, labelled, select} from './dom.js';
import {COSTS, ERRORS, measure, title} from './measures.js';
import {createReading} from './reading.js';
import {groupings, paretoFront, seriesOf} from './series.js';

const HEIGHT = 380;
const REACH = 28; // pixels within which a pointer finds a point
const SYMBOLS = [symbolCircle, symbolSquare, symbolTriangle, symbolDiamond, symbolCross];
const COLOURS = 10; // custom properties --series-0 ... of style.css

/** The first series, the default, has the colour of text; others one of ten colours, then shapes. */
function styleOf(index) {
  if (index === 0) return {colour: 'var(--ink)', shape: symbol(symbolCircle, 64)()};
  const shape = SYMBOLS[(index - 1 + Math.floor((index - 1) / COLOURS)) % SYMBOLS.length];
  return {colour: `var(--series-${(index - 1) % COLOURS})`, shape: symbol(shape, 52)()};
}

export function showPlot(root, table, state) {
  const svg = pick(el('div'))
    .append('svg')
    .attr('role', 'group')
    .attr('aria-label', 'Plot of the runs');
  const frame = el('div', {class: 'plot-frame', style: `height:${HEIGHT}px`}, svg.node());
  const legend = el('div', {class: 'legend'});
  const note = el('p', {class: 'note'});
  const hidden = new Set();
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
        select('Colours', groupings(table), '', (value) => {
          hidden.clear();
          state.set({grouping: value});
        }),
      ),
    ),
    frame,
    legend,
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
    const series = seriesOf(table, state.get('grouping')).map((one, index) => ({
      ...one,
      ...styleOf(index),
    }));

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
    const visible = series.filter((one) => !hidden.has(one.name));
    const path = line(x.place, y.place);
    for (const one of visible) {
      for (const joined of one.lines) {
        svg
          .append('path')
          .attr('class', 'series-line')
          .attr('d', path(joined.filter(placed)))
          .style('stroke', one.colour);
      }
    }
    points = visible.flatMap((one) =>
      one.runs.filter(placed).map((run) => ({run, one, x: x.place(run), y: y.place(run)})),
    );
    drawPoints();
    drawLegend(series);
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

  function drawPoints() {
    svg
      .append('g')
      .selectAll('path')
      .data(points)
      .join('path')
      .attr('class', 'point')
      .attr('d', (point) => point.one.shape)
      .attr('transform', (point) => `translate(${point.x},${point.y})`)
      .style('fill', (point) => point.one.colour)
      .attr('tabindex', 0)
      .attr('role', 'button')
      .attr('data-run', (point) => point.run.id)
      .attr('aria-label', (point) => `run ${point.run.id}: ${point.run.label}`)
      .on('focus', (_, point) => state.set({read: point.run.id}))
      .on('keydown', (event, point) => {
        if (event.key === 'Enter' || event.key === ' ') choose(event, point);
      });
    svg.append('g').attr('class', 'marks');
  }

  function choose(event, point) {
    event.preventDefault();
    state.set({read: point.run.id, [event.shiftKey ? 'b' : 'a']: point.run.id});
  }

  function drawLegend(series) {
    legend.replaceChildren(
      el('span', {class: 'key front-key'}, 'Pareto front'),
      ...series.map((one) => {
        const icon = pick(el('span'))
          .append('svg')
          .attr('width', 12)
          .attr('height', 12)
          .attr('aria-hidden', 'true');
        icon
          .append('path')
          .attr('d', one.shape)
          .attr('transform', 'translate(6,6)')
          .style('fill', one.colour);
        return el(
          'button',
          {
            type: 'button',
            class: 'key',
            'aria-pressed': String(!hidden.has(one.name)),
            title: 'Show or hide this series',
            onclick: () => {
              if (!hidden.delete(one.name)) hidden.add(one.name);
              draw();
            },
          },
          icon.node(),
          one.name,
        );
      }),
    );
  }

  /** Rings around the run that is read and the two that are compared. */
  function mark() {
    const marks = svg.select('.marks');
    marks.selectAll('*').remove();
    const at = (id) => points.find((point) => point.run.id === id);
    const read = at(state.get('read'));
    if (read)
      marks
        .append('circle')
        .attr('class', 'read')
        .attr('cx', read.x)
        .attr('cy', read.y)
        .attr('r', 9);
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
    if (point) state.set({read: point.run.id});
  });
  svg.on('click', (event) => {
    const point = nearest(event);
    if (point) choose(event, point);
  });
  state.listen(['x', 'y', 'grouping'], draw);
  state.listen(['read', 'a', 'b'], mark);
  new ResizeObserver(draw).observe(frame);
}
