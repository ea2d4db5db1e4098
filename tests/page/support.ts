// What the page's tests share: opening the page, drawing strokes, reading its state.
import { expect, test as base, type Page } from '@playwright/test';
import type { Inspection } from '../../web/src/modes/film/inspection.ts';

/** A page whose console must stay free of errors. */
export const test = base.extend<{ quietPage: Page }>({
  quietPage: async ({ page }, use) => {
    const problems: string[] = [];
    page.on('pageerror', (error) => problems.push(error.stack ?? error.message));
    page.on('console', (message) => {
      if (message.type() === 'error') problems.push(message.text());
    });
    await use(page);
    expect(problems, 'errors on the console').toEqual([]);
  },
});
export { expect };

/** Opens the page and waits for its first surface. Software rendering: no antialiasing, ratio 1. */
export async function openPage(page: Page): Promise<void> {
  await page.goto('?aa=0&dpr=1');
  await spanned(page);
}

/** Opens the page with no curves, the camera over the XY plane. */
export async function openEmpty(page: Page): Promise<void> {
  await openPage(page);
  await page.getByRole('button', { name: 'Clear all curves' }).click();
  await lookFrom(page, 'plus z');
}

/** Looks along an axis, from now on without flights, and waits for the picture. */
export async function lookFrom(page: Page, axis: string): Promise<void> {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.getByRole('button', { name: `Look from ${axis}` }).click();
  await page.evaluate(
    () =>
      new Promise((resolve) => {
        requestAnimationFrame(() => requestAnimationFrame(resolve));
      }),
  );
}

/** The part of the state that survives the way out of the browser. */
export interface State {
  readonly phase: string;
  readonly message: string;
  readonly faults: number;
  readonly curves: number[][][];
  readonly weights: Inspection['document']['settings']['weights'];
  readonly candidates: string;
  readonly tool: string;
  readonly notice: string;
  readonly isStale: boolean;
  readonly isGrowing: boolean;
  readonly canUndo: boolean;
  readonly canRedo: boolean;
  readonly selection: Inspection['selection'];
  /** How many parts and vertices are chosen. */
  readonly places: number;
  readonly mode: string;
  readonly span: {
    readonly positions: number[];
    readonly triangles: number[];
    readonly loopVertices: number[];
    readonly starts: number[];
    readonly cost: number;
    readonly terms: { area: number; dihedral: number };
    readonly candidates: string;
  } | null;
}

export async function stateOf(page: Page): Promise<State> {
  return page.evaluate((): State => {
    const now = window.__soapfilm;
    if (!now) throw new Error('The page has no window.__soapfilm.');
    const span = now.surface?.span;
    const { solve, document } = now;
    return {
      phase: solve.phase,
      message: 'message' in solve ? solve.message : '',
      faults: 'faults' in solve ? solve.faults.length : 0,
      curves: document.curves.map((curve) => curve.map((point) => [...point])),
      weights: document.settings.weights,
      candidates: String(document.settings.candidates),
      tool: now.tool,
      notice: now.notice?.text ?? '',
      isStale: now.isStale,
      isGrowing: now.isGrowing,
      canUndo: now.canUndo,
      canRedo: now.canRedo,
      selection: now.selection,
      places: now.places.length,
      mode: now.mode,
      span: span
        ? {
            positions: [...span.positions],
            triangles: [...span.triangles],
            loopVertices: [...span.loopVertices],
            starts: [...span.starts],
            cost: span.cost,
            terms: { area: span.terms.area, dihedral: span.terms.dihedral },
            candidates: span.candidates,
          }
        : null,
    };
  });
}

/** Waits until the document as it is has been spanned, and returns the state. */
export async function spanned(page: Page): Promise<State & { span: NonNullable<State['span']> }> {
  await expect(async () => {
    const { phase, isStale, span } = await stateOf(page);
    expect({ phase, isStale, hasSpan: span !== null }).toEqual({ phase: 'done', isStale: false, hasSpan: true });
  }).toPass({ intervals: [50, 100, 200] });
  const state = await stateOf(page);
  if (state.span === null) throw new Error('The surface has gone.');
  return { ...state, span: state.span };
}

/** Waits until the document has as many curves. */
export async function hasCurves(page: Page, count: number): Promise<void> {
  await expect.poll(async () => (await stateOf(page)).curves.length).toBe(count);
}

/** Draws a circle on the canvas, around a point given in shares of its size. */
export async function drawCircle(page: Page, at: { x: number; y: number; radius: number }): Promise<void> {
  const box = await canvasBox(page);
  const [x, y] = [box.x + at.x * box.width, box.y + at.y * box.height];
  const kMoves = 18;
  const point = (i: number): [number, number] => {
    const t = (2 * Math.PI * i) / kMoves;
    return [x + at.radius * Math.cos(t), y + at.radius * Math.sin(t)];
  };
  await page.mouse.move(...point(0));
  await page.mouse.down();
  for (let i = 1; i < kMoves; i++) await page.mouse.move(...point(i));
  await page.mouse.up();
}

export async function canvasBox(page: Page): Promise<{ x: number; y: number; width: number; height: number }> {
  const box = await page.locator('canvas').boundingBox();
  if (box === null) throw new Error('The canvas is not in the page.');
  return box;
}

/** Where a vertex appears in the window. */
export async function whereIs(page: Page, curve: number, vertex: number): Promise<{ x: number; y: number }> {
  return page.evaluate(([c, v]) => {
    const now = window.__soapfilm;
    if (!now) throw new Error('The page has no window.__soapfilm.');
    return now.whereIs(c, v);
  }, [curve, vertex] as const);
}

/** Share of the canvas's pixels whose colour a change turned into another. */
export async function changedShare(page: Page, change: () => Promise<void>): Promise<number> {
  const take = async () => (await page.locator('canvas').screenshot()).toString('base64');
  const before = await take();
  await change();
  const after = await take();
  return page.evaluate(async ([a, b]) => {
    const pixels = async (png: string) => {
      const image = new Image();
      image.src = `data:image/png;base64,${png}`;
      await image.decode();
      const { width, height } = image;
      const context = new OffscreenCanvas(width, height).getContext('2d');
      if (!context) throw new Error('No 2D canvas.');
      context.drawImage(image, 0, 0);
      return context.getImageData(0, 0, width, height).data;
    };
    const [p, q] = [await pixels(a), await pixels(b)];
    let changed = 0;
    for (let i = 0; i < p.length; i += 4) {
      const difference = Math.abs(p[i] - q[i]) + Math.abs(p[i + 1] - q[i + 1]) + Math.abs(p[i + 2] - q[i + 2]);
      if (difference > 40) changed++;
    }
    return (4 * changed) / p.length;
  }, [before, after] as const);
}

/**
 * Checks that triangles form a consistently wound surface bounded by exactly the loops, with
 * n + 2k - 4 triangles: each inner edge once in either direction, each loop edge once.
 */
export function expectSpans(span: NonNullable<State['span']>, k: number): void {
  const n = span.positions.length / 3;
  expect(span.triangles.length / 3).toBe(n + 2 * k - 4);
  const directed = new Set<string>();
  for (let t = 0; t < span.triangles.length; t += 3) {
    for (let i = 0; i < 3; i++) {
      const edge = `${span.triangles[t + i]} ${span.triangles[t + ((i + 1) % 3)]}`;
      expect(directed.has(edge), `edge ${edge} runs twice the same way`).toBe(false);
      directed.add(edge);
    }
  }
  const open = [...directed].filter((edge) => !directed.has(edge.split(' ').reverse().join(' ')));
  const undirected = (edge: string) => edge.split(' ').map(Number).sort((a, b) => a - b).join(' ');
  const loopEdges: string[] = [];
  for (let c = 0; c < k; c++) {
    const loop = span.loopVertices.slice(span.starts[c], span.starts[c + 1]);
    loop.forEach((vertex, i) => loopEdges.push(undirected(`${vertex} ${loop[(i + 1) % loop.length]}`)));
  }
  expect(open.map(undirected).sort()).toEqual(loopEdges.sort());
}
