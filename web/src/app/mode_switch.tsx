// The buttons of the modes. One that is on its way says so.
import { mode } from '../state/store.ts';
import type { Mode } from './mode.ts';
import { awaited, chooseMode } from './rooms.ts';

export function ModeSwitch({ modes }: { modes: readonly Mode[] }) {
  return (
    <div class="modes" role="group" aria-label="Mode">
      {modes.map(({ id, label, title }) => (
        <button
          key={id}
          type="button"
          title={title}
          aria-pressed={mode.value === id}
          aria-busy={awaited.value === id}
          onClick={() => {
            chooseMode(id);
          }}
        >
          {label}
        </button>
      ))}
    </div>
  );
}
