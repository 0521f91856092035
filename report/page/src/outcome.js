// What became of a run: done, failed, or never run, as a budget was spent or the sweep ended.

export const OUTCOMES = ['ok', 'failed', 'not-run'];

export const outcome = (run) => (run.ok ? 'ok' : run.not_run ? 'not-run' : 'failed');

/** "47, of which 1 failed, 30 were not run". */
export function countsText(runs) {
  const number = (wanted) => runs.filter((run) => outcome(run) === wanted).length;
  const [failed, missing] = [number('failed'), number('not-run')];
  const parts = [
    failed && `${failed} failed`,
    missing && `${missing} ${missing === 1 ? 'was' : 'were'} not run`,
  ].filter(Boolean);
  return parts.length ? `${runs.length}, of which ${parts.join(', ')}` : String(runs.length);
}

/** Why a run has no numbers. */
export function reasonText(run) {
  if (outcome(run) === 'failed') return `failed: ${run.error || 'no message'}`;
  return run.error && run.error !== 'not run' ? `not run: ${run.error}` : 'not run';
}
