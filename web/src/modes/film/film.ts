// The film's state, apart from the document: its group, the pen, and changes from the panel.
import { signal } from '@preact/signals';
import { newItem } from '../../state/document.ts';
import { beginWith, groupOf, openItems, setIn, type Opening, type Pen } from '../../state/store.ts';
import { kCurve } from './curve.ts';
import { kGallery, type Example } from './gallery.ts';
import { curveOf, kDefaultSettings, type FilmSettings } from './settings.ts';

export const kMode = 'film';

export const film = groupOf(kMode, kDefaultSettings);

export const pen = signal<Pen>({ count: 24, smoothing: 0.4 });

/** Changes settings; those of one `gesture` are one step until the change that is not `passing`. */
export function setFilm(settings: Partial<FilmSettings>, gesture?: string, passing = false): void {
  setIn(film.peek(), settings, gesture, passing);
}

function openingOf(example: Example, variant: number | undefined): Opening {
  const { title, settings, view } = example;
  return {
    name: variant === undefined ? title : `${title} (${variant})`,
    items: example.curves(variant).map((points) => newItem(kCurve, curveOf(points))),
    settings,
    view,
  };
}

export function openExample(example: Example, variant: number | undefined): void {
  openItems(film.peek(), openingOf(example, variant));
}

/** The first example, as what was there from the beginning. */
export function beginWithExample(): void {
  const [first] = kGallery;
  beginWith(film.peek(), openingOf(first, first.variants?.values[0]));
}
