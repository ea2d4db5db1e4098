// The film's state, apart from the document: its group, the pen, and changes from the panel.
import { signal } from '@preact/signals';
import { newItem } from '../../state/document.ts';
import { dispatch, endGesture, groupOf, requestFrame, choose, type Pen } from '../../state/store.ts';
import { kCurve } from './curve.ts';
import type { Example } from './gallery.ts';
import { curveOf, kDefaultSettings, type FilmSettings } from './settings.ts';

export const kMode = 'film';

export const film = groupOf(kMode, kDefaultSettings);

export const pen = signal<Pen>({ count: 24, smoothing: 0.4 });

/** Changes settings; those of one `gesture` are one step until the change that is not `passing`. */
export function setFilm(settings: Partial<FilmSettings>, gesture?: string, passing = false): void {
  dispatch({ type: 'set', group: film.peek().id, settings }, gesture);
  if (gesture !== undefined && !passing) endGesture();
}

export const itemsOf = (example: Example, variant?: number) =>
  example.curves(variant).map((points) => newItem(kCurve, curveOf(points)));

export const nameOf = ({ title }: Example, variant?: number): string => (variant === undefined ? title : `${title} (${variant})`);

export function openExample(example: Example, variant: number | undefined): void {
  choose();
  dispatch({
    type: 'open',
    group: film.peek().id,
    name: nameOf(example, variant),
    items: itemsOf(example, variant),
    settings: example.settings,
  });
  requestFrame(example.view);
}
