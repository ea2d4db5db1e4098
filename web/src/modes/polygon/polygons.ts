// Polygons in the plane: the document, its commands and history, and what triangulating it comes to.
import { computed, signal } from '@preact/signals';
import {
  load,
  SoapfilmError,
  triangulatePolygon,
  triangulatePolygons,
  type FloodStep,
  type PolygonOptions,
} from 'soapfilm';
import type { Point2 } from '../shapes/plane.ts';
import { createHistory } from './history.ts';
import { say, type Tool } from './store.ts';

export type Ring = readonly Point2[];
/** The outer ring, then the holes. */
export type Polygon = readonly Ring[];

export type PolygonSettings = Required<Pick<PolygonOptions, 'method' | 'output' | 'quality' | 'repair'>>;

export interface PolygonDocument {
  readonly name: string;
  readonly polygons: readonly Polygon[];
  readonly settings: PolygonSettings;
}

/** A ring, or one of its vertices. */
export interface RingPlace {
  readonly polygon: number;
  readonly ring: number;
  /** Null: the whole ring. */
  readonly vertex: number | null;
}
type VertexPlace = RingPlace & { readonly vertex: number };

export type PolygonCommand =
  /** A hole where it has a point inside a polygon, else a polygon. */
  | { readonly type: 'add-ring'; readonly points: Ring }
  | { readonly type: 'move-vertex'; readonly at: VertexPlace; readonly to: Point2 }
  /** Deletes a vertex, or a ring; with its outer ring a polygon goes. */
  | { readonly type: 'delete'; readonly at: RingPlace }
  | { readonly type: 'clear' }
  | { readonly type: 'open'; readonly name: string; readonly polygons: readonly Polygon[] }
  | { readonly type: 'set'; readonly settings: Partial<PolygonSettings> };

const kEmpty: PolygonDocument = {
  name: 'Untitled',
  polygons: [],
  settings: { method: 'flooding', output: 'triangles', quality: 'fast', repair: 'none' },
};

/** The document after a command; the same object where nothing changes. */
export function applyToPolygons(document: PolygonDocument, command: PolygonCommand): PolygonDocument {
  const { polygons, settings } = document;
  switch (command.type) {
    case 'add-ring': {
      const host = polygons.findIndex(([outer]) => command.points.some((p) => isInside(p, outer)));
      if (host < 0) return { ...document, polygons: [...polygons, [command.points]] };
      return withPolygon(document, host, [...polygons[host], command.points]);
    }
    case 'move-vertex': {
      const { polygon, ring, vertex } = command.at;
      const moved = polygons[polygon][ring].map((p, v) => (v === vertex ? command.to : p));
      return withRing(document, polygon, ring, moved);
    }
    case 'delete': {
      const { polygon, ring, vertex } = command.at;
      const points = polygons[polygon][ring];
      if (vertex !== null && points.length > 3) {
        return withRing(document, polygon, ring, points.filter((_, v) => v !== vertex));
      }
      if (ring === 0) return { ...document, polygons: polygons.filter((_, p) => p !== polygon) };
      return withPolygon(document, polygon, polygons[polygon].filter((_, r) => r !== ring));
    }
    case 'clear':
      return polygons.length === 0 ? document : { ...document, name: kEmpty.name, polygons: [] };
    case 'open':
      return { ...document, name: command.name, polygons: command.polygons };
    case 'set': {
      const next = { ...settings, ...command.settings };
      const isSame = (Object.keys(next) as (keyof PolygonSettings)[]).every((key) => next[key] === settings[key]);
      return isSame ? document : { ...document, settings: next };
    }
  }
}

function withPolygon(document: PolygonDocument, index: number, polygon: Polygon): PolygonDocument {
  return { ...document, polygons: document.polygons.map((old, p) => (p === index ? polygon : old)) };
}

function withRing(document: PolygonDocument, polygon: number, index: number, ring: Ring): PolygonDocument {
  const rings = document.polygons[polygon].map((old, r) => (r === index ? ring : old));
  return withPolygon(document, polygon, rings);
}

function isInside([x, y]: Point2, ring: Ring): boolean {
  let inside = false;
  ring.forEach(([ax, ay], i) => {
    const [bx, by] = ring[(i + 1) % ring.length];
    if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) inside = !inside;
  });
  return inside;
}

export const selectedRing = signal<RingPlace | null>(null);
export const polygonTool = signal<Tool>('select');
/** Vertices of a drawn ring, and how much the hand is smoothed. */
export const ringPen = signal({ count: 24, smoothing: 0.3 });

export const history = createHistory(kEmpty, applyToPolygons, ({ polygons }) => {
  const at = selectedRing.peek();
  if (at === null) return;
  const ring = polygons.at(at.polygon)?.at(at.ring);
  if (ring === undefined || (at.vertex ?? 0) >= ring.length) selectedRing.value = null;
});
export const polygonDoc = history.doc;

/** Triangles of all polygons, and what is wrong with those that have none. */
export interface Triangulated {
  /** `[2n]` the rings' vertices one after the other, then those that repair added. */
  readonly positions: Float64Array;
  readonly added: number;
  readonly triangles: Uint32Array;
  readonly strips: Uint32Array;
  readonly stripStarts: Uint32Array;
  readonly errors: readonly SoapfilmError[];
  readonly seconds: number;
}

const isReady = signal(false);
export const loadError = signal<string | null>(null);

/** Loads the core for this thread: polygons take a moment that is shorter than the way to a worker. */
export async function startPolygons(): Promise<void> {
  try {
    await load({ parts: ['polygons'] });
    isReady.value = true;
  } catch (error) {
    loadError.value = error instanceof Error ? error.message : String(error);
  }
}

export const triangulated = computed<Triangulated | null>(() => {
  if (!isReady.value) return null;
  const { polygons, settings } = polygonDoc.value;
  const since = performance.now();
  const found = triangulatePolygons(polygons, { ...settings, skipInvalid: true });
  const seconds = (performance.now() - since) / 1000;
  const { triangles, strips, stripStarts, errors } = found;
  const positions = Float64Array.from([...polygons.flat(2).flat(), ...found.added]);
  return { positions, added: found.added.length / 2, triangles, strips, stripStarts, errors, seconds };
});

/** Flooding on its way: the steps of all polygons, and how many of them have been taken. */
export interface Flooding {
  readonly triangles: Uint32Array;
  readonly steps: readonly FloodStep[];
  readonly taken: number;
}
export const flooding = signal<Flooding | null>(null);
// What is flooded has changed.
polygonDoc.subscribe(() => {
  flooding.value = null;
});

/** Floods all polygons that are valid, step by step from now on. */
export function beginFlooding(): void {
  const triangles: number[] = [];
  const steps: FloodStep[] = [];
  let first = 0;
  for (const polygon of polygonDoc.peek().polygons) {
    const before = triangles.length / 3;
    try {
      const found = triangulatePolygon(polygon, { trace: true });
      for (const step of found.trace) {
        const { action, left, right } = step;
        steps.push({ action, left: first + left, right: first + right, triangles: before + step.triangles });
      }
      for (const v of found.triangles) triangles.push(first + v);
    } catch (error) {
      if (!(error instanceof SoapfilmError)) throw error;
    }
    first += polygon.flat().length;
  }
  if (steps.length === 0) say('There is nothing to flood: only polygons that need no repair are.');
  else flooding.value = { triangles: Uint32Array.from(triangles), steps, taken: 0 };
}

/** The next steps; the end shows everything for good. */
export function floodOn(count: number): void {
  const now = flooding.peek();
  if (now === null) return;
  const taken = now.taken + count;
  flooding.value = taken >= now.steps.length ? null : { ...now, taken };
}
