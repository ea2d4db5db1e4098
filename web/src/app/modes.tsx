// The page's two modes. That of polygons is fetched when it is first wanted.
import { effect, signal } from '@preact/signals';
import { dismissNotice, mode, say, type Mode } from '../state/store.ts';

type PolygonModule = typeof import('./polygon.tsx');

/** The mode of polygons, once it is there. */
export const polygonModule = signal<PolygonModule | null>(null);

/** The part of the address that asks for polygons. */
const kHash = '#polygon';

/** Follows the address, in which the mode stands, and fetches what the mode needs. */
export function followMode(): void {
  const read = (): void => {
    mode.value = location.hash === kHash ? 'polygon' : 'film';
  };
  read();
  window.addEventListener('hashchange', read);
  effect(() => {
    if (mode.value !== 'polygon' || polygonModule.peek() !== null) return;
    import('./polygon.tsx').then(
      (module) => (polygonModule.value = module),
      () => {
        say('The mode of polygons could not be loaded.', 'error');
        chooseMode('film');
      },
    );
  });
}

function chooseMode(chosen: Mode): void {
  location.hash = chosen === 'polygon' ? kHash : '';
}

const kModes: readonly { id: Mode; label: string; title: string }[] = [
  { id: 'film', label: 'Film', title: 'Surfaces between curves in space' },
  { id: 'polygon', label: 'Polygon', title: 'Triangles of polygons with holes in the plane' },
];

export function ModeSwitch() {
  return (
    <div class="modes" role="group" aria-label="Mode">
      {kModes.map(({ id, label, title }) => (
        <button
          key={id}
          type="button"
          title={title}
          aria-pressed={mode.value === id}
          onClick={() => {
            // What it says is about the mode that is left.
            dismissNotice();
            chooseMode(id);
          }}
        >
          {label}
        </button>
      ))}
    </div>
  );
}
