// A kind of object for tests of the page's state: lists of dots on the x axis.
import { newItem, type Item, type Kind, type Place } from '../../web/src/state/document.js';

/** `[parts][dots]` places on the axis. */
export type Dots = readonly (readonly number[])[];

const startsOf = (dots: Dots): number[] => [0, ...dots.map((_, part) => dots.slice(0, part + 1).flat().length)];

/** The dots with their part and number, and whether a place names them. */
function marked(dots: Dots, places: readonly Place[]): { x: number; isNamed: boolean }[][] {
  const starts = startsOf(dots);
  return dots.map((part, p) =>
    part.map((x, i) => ({ x, isNamed: places.some(({ part: of, handle }) => of === p && (handle ?? starts[p] + i) === starts[p] + i) })),
  );
}

export const dots: Kind<Dots> = {
  name: 'dots',
  boxOf: (shape) => ({ low: [Math.min(...shape.flat()), 0, 0], high: [Math.max(...shape.flat()), 0, 0] }),
  partStarts: startsOf,
  handleAt: (shape, handle) => [shape.flat()[handle], 0, 0],
  move: (shape, places, [by]) => marked(shape, places).map((part) => part.map(({ x, isNamed }) => (isNamed ? x + by : x))),
  remove(shape, places) {
    const kept = marked(shape, places).map((part) => part.filter(({ isNamed }) => !isNamed).map(({ x }) => x));
    const left = kept.filter((part) => part.length > 0);
    return left.length === 0 ? null : left;
  },
  read: (saved) => (Array.isArray(saved) && saved.every(Array.isArray) ? (saved as Dots) : null),
};

export const dotsItem = (...shape: Dots): Item<Dots> => newItem(dots, shape);
