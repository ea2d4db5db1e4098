// What a mode shows in the scene: its objects by kind, where the world lies, and a viewpoint of its own.
import { computed, effect, type ReadonlySignal } from '@preact/signals';
import { Group as SceneGroup } from 'three';
import { boundsOf, type Point } from '../shapes/vec.ts';
import { boxOfGroup, boxOfItem, type Group, type Place } from '../state/document.ts';
import { hover, mode, selection, shown } from '../state/store.ts';
import type { Failure } from '../state/work.ts';
import { isBoxNear, type Spot } from './eye.ts';
import type { DrawnKind, Layer } from './kind.ts';
import { OrbitViewpoint } from './orbit_viewpoint.ts';
import { kIdentity, placementFor, type Placement } from './placement.ts';
import { PlaneViewpoint } from './plane_viewpoint.ts';
import type { Theme } from './theme.ts';
import type { View } from './view.ts';
import type { Viewpoint } from './viewpoint.ts';

export interface ModeSceneOptions {
  readonly mode: string;
  /** 2: the plane seen from above. */
  readonly dimension: 2 | 3;
  readonly group: ReadonlySignal<Group>;
  // eslint-disable-next-line @typescript-eslint/no-explicit-any -- each kind reads only shapes of its own
  readonly kinds: readonly DrawnKind<any>[];
  /** Whether anything can be drawn in it. */
  readonly hasPen: boolean;
  /** What is marked as faulty. */
  readonly failures: ReadonlySignal<readonly Failure[]>;
}

/** What lies under the pointer. */
export interface Picked {
  readonly place: Place;
  readonly point: Point;
}

export class ModeScene {
  /** Everything that the mode draws is in here. */
  readonly root = new SceneGroup();
  readonly viewpoint: Viewpoint;
  /** Computed, so that whatever draws the document finds the placement that goes with it. */
  readonly placement: ReadonlySignal<Placement>;
  private placed = kIdentity;
  private viewPlaced = kIdentity;
  private readonly layers: ReadonlyMap<string, Layer>;

  constructor(
    private readonly view: View,
    private readonly theme: ReadonlySignal<Theme>,
    readonly options: ModeSceneOptions,
  ) {
    const { dimension, group, kinds } = options;
    this.viewpoint = dimension === 3 ? new OrbitViewpoint(view) : new PlaneViewpoint(view);
    this.root.visible = false;
    this.placement = computed(() => {
      this.placed = placementFor(boundsOf(boxOfGroup(group.value)), this.placed);
      return this.placed;
    });
    this.layers = new Map(kinds.map((kind) => [kind.name, kind.makeLayer()]));
    for (const { object } of this.layers.values()) this.root.add(object);
    effect(() => {
      this.followSize(group.value);
    });
    effect(() => {
      this.draw();
    });
  }

  /** What lies within reach of a place: a handle, else a part, with the point of it that is nearest. */
  pick(at: Spot, reach: number): Picked | null {
    let best: Picked | null = null;
    let least = Infinity;
    for (const item of this.options.group.peek().items) {
      // A look at its box first, since there may be thousands.
      if (!isBoxNear(boxOfItem(item), this.viewpoint, at, reach)) continue;
      const kind = this.options.kinds.find(({ name }) => name === item.kind);
      const hit = kind?.pick(item.shape, this.viewpoint, at, reach);
      if (!hit) continue;
      const { part, handle, point } = hit;
      // A handle anywhere goes before a line.
      const distance = handle === null ? hit.distance + reach : hit.distance;
      if (distance < least) [best, least] = [{ place: { item: item.id, part, handle }, point }, distance];
    }
    return best;
  }

  private draw(): void {
    const { mode: of, group, failures } = this.options;
    const isCurrent = mode.value === of;
    const marks = {
      selection: isCurrent ? selection.value : [],
      hover: isCurrent ? hover.value : null,
      faults: failures.value.flatMap(({ faults }) => faults),
      vertices: shown.value.vertices,
    };
    const drawn = {
      placement: this.placement.value,
      pixelRatio: this.view.pixelRatio.value,
      theme: this.theme.value,
    };
    for (const [kind, layer] of this.layers) {
      layer.update(group.value.items.filter((item) => item.kind === kind), marks, drawn);
    }
    this.view.invalidate();
  }

  private followSize(group: Group): void {
    const { diagonal } = boundsOf(boxOfGroup(group));
    const placement = this.placement.value;
    const isPlacedAnew = placement !== this.viewPlaced;
    this.viewPlaced = placement;
    if (isPlacedAnew) this.viewpoint.place(placement);
    this.viewpoint.follow(diagonal / 2, isPlacedAnew);
  }
}
