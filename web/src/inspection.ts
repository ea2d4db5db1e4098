// `window.__soapfilm`: the page's state, read-only, for its own tests and for a look from the console.
import type { Stage } from './scene/stage.ts';
import type { Point2 } from './shapes/plane.ts';
import type { Document } from './state/document.ts';
import type { Flooding, PolygonDocument, RingPlace, Triangulated } from './state/polygon.ts';
import { isStale, solve, surface, type Solve, type Surface } from './state/solving.ts';
import { canRedo, canUndo, doc, isGrowing, notice, selection, tool, type Notice, type Selection, type Tool } from './state/store.ts';

export interface Inspection {
  readonly document: Document;
  readonly solve: Solve;
  readonly surface: Surface | null;
  readonly isStale: boolean;
  readonly isGrowing: boolean;
  readonly selection: Selection | null;
  readonly tool: Tool;
  readonly notice: Notice | null;
  readonly canUndo: boolean;
  readonly canRedo: boolean;
  /** Where a vertex appears, in CSS pixels of the window. */
  whereIs(curve: number, vertex: number): { x: number; y: number };
}

/** `window.__polygons`: the same for the mode of polygons, once it has been opened. */
export interface PolygonInspection {
  readonly document: PolygonDocument;
  readonly triangulated: Triangulated | null;
  readonly flooding: Flooding | null;
  readonly selection: RingPlace | null;
  /** Where a point of the plane appears, in CSS pixels of the window. */
  whereIs(point: Point2): { x: number; y: number };
}

declare global {
  interface Window {
    __soapfilm?: Inspection;
    __polygons?: PolygonInspection;
  }
}

export function exposeForInspection(stage: Stage): void {
  window.__soapfilm = {
    get document() {
      return doc.peek();
    },
    get solve() {
      return solve.peek();
    },
    get surface() {
      return surface.peek();
    },
    get isStale() {
      return isStale.peek();
    },
    get isGrowing() {
      return isGrowing.peek();
    },
    get selection() {
      return selection.peek();
    },
    get tool() {
      return tool.peek();
    },
    get notice() {
      return notice.peek();
    },
    get canUndo() {
      return canUndo.peek();
    },
    get canRedo() {
      return canRedo.peek();
    },
    whereIs(curve, vertex) {
      const { x, y } = stage.view.project(doc.peek().curves[curve][vertex]);
      const box = stage.view.canvas.getBoundingClientRect();
      return { x: box.left + x, y: box.top + y };
    },
  };
}
