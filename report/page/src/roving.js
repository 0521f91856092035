// One tab stop for many points: arrow keys go from one to the next.

const STEPS = {
  ArrowRight: ['x', 1],
  ArrowLeft: ['x', -1],
  ArrowDown: ['y', 1],
  ArrowUp: ['y', -1],
};

/**
 * The point that a key goes to from `point`: the next one along an axis, in pixels, or the first or
 * last across. Null for other keys and at the ends.
 */
export function neighbour(points, point, key) {
  const [axis, step] = STEPS[key] ?? ['x', 0];
  const other = axis === 'x' ? 'y' : 'x';
  const sorted = [...points].sort((a, b) => a[axis] - b[axis] || a[other] - b[other]);
  if (key === 'Home') return sorted[0] ?? null;
  if (key === 'End') return sorted.at(-1) ?? null;
  return step ? (sorted[sorted.indexOf(point) + step] ?? null) : null;
}
