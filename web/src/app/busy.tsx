// The progress over the scene, for work that takes long enough to be noticed, and the one button that ends it.
import { useEffect, useState } from 'preact/hooks';
import { busy, endShownWork } from '../state/work.ts';

const kBusyAfterMs = 400;

export function Busy() {
  const work = busy.value;
  const state = work?.state.value;
  const since = state?.phase === 'running' ? state.since : null;
  const [late, setLate] = useState<number | null>(null);
  useEffect(() => {
    if (since === null) return;
    const timer = setTimeout(() => {
      setLate(since);
    }, kBusyAfterMs);
    return () => {
      clearTimeout(timer);
    };
  }, [since]);
  if (work === null || state?.phase !== 'running' || late !== since) return null;
  return (
    <div class="busy floating">
      <progress aria-label={`${work.verb}, over the scene`} max={1} value={state.fraction} />
      <span>{Math.floor(100 * state.fraction)} %</span>
      <button type="button" class="button small" onClick={() => { endShownWork(); }}>
        Cancel
      </button>
    </div>
  );
}
