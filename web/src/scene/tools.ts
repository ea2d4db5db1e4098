// The tools, as one machine of states. What no state takes is left to the viewpoint's controls, which turn, move and
// zoom.
//
//   idle ──press on a handle, or on what is chosen──▶ pointing ──moved──▶ dragging
//     │──press with Shift on nothing──▶ boxing
//     │──press with the pen──▶ drawing
//     └──any other press──▶ leaving: a click chooses, anything more is the controls'
//
// A second finger takes back what the first began: both are for the view.
import { fromPlane, meetPlane, toPlane, type Frame, type Point2 } from '../shapes/plane.ts';
import { closeStroke, type ClosedStroke } from '../shapes/stroke.ts';
import { subtract, type Point } from '../shapes/vec.ts';
import { handlesAt, kindOf, type Place } from '../state/document.ts';
import { complain, settle } from '../state/notice.ts';
import {
  cancelGesture,
  choose,
  dispatch,
  drawingPlane,
  endGesture,
  group,
  hover,
  isChosen,
  isMovable,
  isSamePlace,
  keyOf,
  selection,
  tool,
  type Pen,
} from '../state/store.ts';
import { distanceOf, type Spot } from './eye.ts';
import type { Picked } from './mode_scene.ts';
import type { Stage } from './stage.ts';

/** What a mode does with the pen. */
export interface PenTool {
  /** What a stroke becomes: "curve". */
  readonly noun: string;
  /** In the help sheet: "one stroke all the way round is one closed curve". */
  readonly help: string;
  readonly pen: () => Pen;
  /** Takes the closed line. */
  readonly add: (points: readonly Point[]) => void;
}

type State =
  | { readonly name: 'idle' }
  /** Left to the controls; a click still chooses. */
  | { readonly name: 'leaving'; readonly press: PointerEvent }
  | { readonly name: 'pointing'; readonly press: PointerEvent; readonly hit: Place; readonly frame: Frame; readonly grip: Point }
  | { readonly name: 'dragging'; readonly press: PointerEvent; readonly frame: Frame; readonly grip: Point }
  | { readonly name: 'boxing'; readonly press: PointerEvent; readonly from: Spot }
  | {
      readonly name: 'drawing';
      readonly press: PointerEvent;
      readonly frame: Frame;
      readonly stroke: Point2[];
      /** World units a CSS pixel, where the stroke began. */
      readonly pixel: number;
    };

const kIdle: State = { name: 'idle' };

const kReach: Partial<Record<string, number>> = { pen: 14, touch: 24 };
/** How far from what it means the pointer may be, in CSS pixels. */
const reachOf = ({ pointerType }: PointerEvent): number => kReach[pointerType] ?? 11;
/** A press that moves less is a click, in CSS pixels. */
const kClickSlop = 5;
/** Least extent of a stroke that becomes a line, in CSS pixels. */
const kLeastExtent = 16;

export class Tools {
  private state: State = kIdle;
  private readonly touches = new Set<number>();
  private readonly box = document.createElement('div');
  private gestures = 0;

  /** @param pen what the mode that is shown does with the pen; null: it has none */
  constructor(
    private readonly stage: Stage,
    private readonly pen: () => PenTool | null,
    private readonly onPress: () => void,
  ) {
    const { container } = stage.view;
    this.box.className = 'selection-box';
    this.box.hidden = true;
    container.append(this.box);
    // In the capture phase on the canvas's parent: before the controls, which listen on the canvas.
    const listen = (type: 'pointerdown' | 'pointermove' | 'pointerup' | 'pointercancel', listener: (event: PointerEvent) => void) => {
      container.addEventListener(type, listener, { capture: true });
    };
    listen('pointerdown', (event) => { this.down(event); });
    listen('pointermove', (event) => { this.move(event); });
    listen('pointerup', (event) => { this.up(event); });
    listen('pointercancel', (event) => {
      this.touches.delete(event.pointerId);
      if (this.isMine(event)) this.cancel();
    });
    // The end of a press that no `pointerup` told of.
    container.addEventListener('lostpointercapture', (event) => {
      if (this.isMine(event)) this.up(event);
    });
    container.addEventListener('pointerleave', () => (hover.value = null));
    // Seen from elsewhere, or another: the plane may be drawn in again.
    stage.view.onCamera(() => {
      settle('plane');
    });
    drawingPlane.subscribe(() => {
      settle('plane');
    });
  }

  /** Whether the pointer has begun something. */
  get isBusy(): boolean {
    return this.state.name !== 'idle' && this.state.name !== 'leaving';
  }

  /** Ends what the pointer has begun, without effect; says whether there was anything. */
  cancel(): boolean {
    const { name } = this.state;
    if (!this.isBusy) return false;
    this.enter(kIdle);
    if (name === 'dragging') cancelGesture();
    return true;
  }

  private enter(next: State): void {
    if (this.state.name === 'drawing') this.stage.showStroke(null, null);
    this.box.hidden = next.name !== 'boxing';
    this.state = next;
  }

  private isMine({ pointerId }: PointerEvent): boolean {
    return this.state.name !== 'idle' && this.state.press.pointerId === pointerId;
  }

  private at(event: PointerEvent): Spot {
    const box = this.stage.view.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private meet(frame: Frame, event: PointerEvent): Point | null {
    const { x, y } = this.at(event);
    const ray = this.stage.current.peek()?.viewpoint.ray(x, y);
    return ray ? meetPlane(frame, ray.from, ray.direction) : null;
  }

  private pick(event: PointerEvent): Picked | null {
    return this.stage.current.peek()?.pick(this.at(event), reachOf(event)) ?? null;
  }

  private down(event: PointerEvent): void {
    if (event.target !== this.stage.view.canvas || this.stage.current.peek() === null) return;
    this.onPress();
    const { state } = this;
    const isBusy = state.name !== 'idle' && state.name !== 'leaving' && state.press.pointerId !== event.pointerId;
    // A palm beside the pen, a touch during a drag by the mouse.
    if (isBusy && state.press.pointerType !== 'touch') {
      event.stopPropagation();
      return;
    }
    if (event.pointerType === 'touch') this.touches.add(event.pointerId);
    if (this.touches.size > 1) {
      this.handOver();
      return;
    }
    const isMain = event.button === 0 && !event.altKey;
    const next = !isMain ? null : this.isDrawing() ? this.beginStroke(event) : this.point(event);
    this.enter(next ?? { name: 'leaving', press: event });
    if (next === null) return;
    event.stopPropagation();
    // Idle: the press was refused, in words.
    if (next.name !== 'idle') this.stage.view.container.setPointerCapture(event.pointerId);
  }

  private isDrawing(): boolean {
    return this.stage.isDrawing(tool.peek());
  }

  private point(event: PointerEvent): State | null {
    const picked = this.pick(event);
    if (picked === null) return event.shiftKey ? { name: 'boxing', press: event, from: this.at(event) } : null;
    const { place: hit, point } = picked;
    // A part that is chosen as a whole is dragged wherever it is taken, handles included.
    const whole: Place = { ...hit, handle: null };
    const taken = isChosen(whole) ? whole : hit;
    if (!event.shiftKey && (!isMovable(taken) || (taken.handle === null && !isChosen(taken)))) return null;
    const frame = this.stage.dragPlane(point);
    const grip = this.meet(frame, event);
    if (grip === null) {
      complain('The drawing plane is seen edge-on here, or lies behind you. Turn the view, or drag in the view plane.', 'plane');
      return null;
    }
    // Chosen at once, so that its settings are at hand; with Shift once the press has ended.
    if (!event.shiftKey && !isChosen(taken)) choose(taken);
    return { name: 'pointing', press: event, hit, frame, grip };
  }

  private beginStroke(event: PointerEvent): State {
    settle('stroke', 'plane');
    const frame = this.stage.drawingPlane();
    const start = this.meet(frame, event);
    if (start === null) {
      complain('The drawing plane is seen edge-on here, or lies behind you. Turn the view, or face the plane (P).', 'plane');
      return kIdle;
    }
    choose();
    const pixel = this.stage.current.peek()?.viewpoint.pixelSize(start) ?? 1;
    return { name: 'drawing', press: event, frame, stroke: [toPlane(frame, start)], pixel };
  }

  /** A second finger: what the first began was meant for the view. */
  private handOver(): void {
    const { state } = this;
    this.cancel();
    this.enter(kIdle);
    if (state.name === 'idle' || state.name === 'leaving') return;
    this.stage.view.container.releasePointerCapture(state.press.pointerId);
    this.stage.view.canvas.dispatchEvent(new PointerEvent('pointerdown', state.press));
  }

  private move(event: PointerEvent): void {
    const { state } = this;
    if (state.name === 'idle' || state.name === 'leaving') {
      this.hover(event);
      return;
    }
    if (!this.isMine(event)) return;
    event.stopPropagation();
    // The button was let go where the page did not hear of it.
    if (event.pointerType === 'mouse' && event.buttons === 0) {
      this.up(event);
      return;
    }
    switch (state.name) {
      case 'drawing': {
        const parts = event.getCoalescedEvents();
        for (const part of parts.length > 0 ? parts : [event]) {
          const point = this.meet(state.frame, part);
          if (point) state.stroke.push(toPlane(state.frame, point));
        }
        this.preview(state);
        break;
      }
      case 'pointing':
        if (distanceOf(this.at(event), this.at(state.press)) < kClickSlop || !isMovable(state.hit)) break;
        this.gestures++;
        if (state.press.shiftKey && !isChosen(state.hit)) choose(...selection.peek(), state.hit);
        this.enter({ name: 'dragging', press: state.press, frame: state.frame, grip: state.grip });
        this.drag(event);
        break;
      case 'dragging':
        this.drag(event);
        break;
      case 'boxing':
        this.showBox(state.from, this.at(event));
        break;
    }
  }

  private hover(event: PointerEvent): void {
    const isFree = event.buttons === 0 && event.pointerType !== 'touch' && !this.isDrawing();
    const under = (isFree && this.pick(event)?.place) || null;
    if (!isSamePlace(under, hover.peek())) hover.value = under;
    const { dataset } = this.stage.view.canvas;
    const isHeld = under !== null && (under.handle !== null || isChosen(under)) && isMovable(under);
    dataset.over = under === null ? '' : isHeld ? 'vertex' : 'curve';
  }

  private drag(event: PointerEvent): void {
    const { state } = this;
    const id = group.peek()?.id;
    if (state.name !== 'dragging' || id === undefined) return;
    const point = this.meet(state.frame, event);
    if (point === null) return;
    const command = { type: 'move', group: id, places: selection.peek(), by: subtract(point, state.grip) } as const;
    dispatch(command, `drag ${this.gestures}`);
  }

  private up(event: PointerEvent): void {
    this.touches.delete(event.pointerId);
    if (!this.isMine(event)) return;
    const { state } = this;
    this.enter(kIdle);
    switch (state.name) {
      case 'idle':
        return;
      case 'leaving':
        // A click on nothing, or on a line that was not chosen.
        if (distanceOf(this.at(event), this.at(state.press)) < kClickSlop && event.button === 0 && !this.isDrawing()) choose(this.pick(event)?.place ?? null);
        return;
      case 'pointing':
        this.click(state.hit, state.press.shiftKey);
        break;
      case 'dragging':
        endGesture();
        break;
      case 'boxing':
        this.chooseWithin(state.from, this.at(event));
        break;
      case 'drawing':
        this.finishStroke(state);
        break;
    }
    event.stopPropagation();
  }

  /** A click on what is there: chooses it alone, or with Shift adds it or takes it out. */
  private click(hit: Place, isShift: boolean): void {
    if (!isShift) choose(hit);
    else if (isChosen(hit)) choose(...selection.peek().filter((place) => !isSamePlace(place, hit)));
    else choose(...selection.peek(), hit);
  }

  private showBox(a: Spot, b: Spot): void {
    this.box.hidden = false;
    Object.assign(this.box.style, {
      left: `${Math.min(a.x, b.x)}px`,
      top: `${Math.min(a.y, b.y)}px`,
      width: `${Math.abs(a.x - b.x)}px`,
      height: `${Math.abs(a.y - b.y)}px`,
    });
  }

  /** Chooses, besides what is chosen, all handles in a box of the screen. */
  private chooseWithin(a: Spot, b: Spot): void {
    const viewpoint = this.stage.current.peek()?.viewpoint;
    if (!viewpoint) return;
    const isWithin = (from: number, to: number, x: number) => x >= Math.min(from, to) && x <= Math.max(from, to);
    const found = (group.peek()?.items ?? []).flatMap((item) => {
      const kind = kindOf(item);
      const starts = kind.partStarts(item.shape);
      return Array.from({ length: starts.length - 1 }, (_, part) =>
        handlesAt(kind, item.shape, { item: item.id, part, handle: null })
          .filter((handle) => {
            const p = viewpoint.project(kind.handleAt(item.shape, handle));
            return p.visible && isWithin(a.x, b.x, p.x) && isWithin(a.y, b.y, p.y);
          })
          .map((handle): Place => ({ item: item.id, part, handle })),
      ).flat();
    });
    choose(...new Map([...selection.peek(), ...found].map((place) => [keyOf(place), place])).values());
  }

  private closed({ stroke, pixel }: Extract<State, { name: 'drawing' }>): ClosedStroke {
    const { count, smoothing } = this.pen()?.pen() ?? { count: 3, smoothing: 0 };
    return closeStroke(stroke, { count, smoothing, leastExtent: kLeastExtent * pixel });
  }

  private preview(state: Extract<State, { name: 'drawing' }>): void {
    const outcome = this.closed(state);
    const { frame, stroke } = state;
    const closed = 'points' in outcome ? outcome.points.map((p) => fromPlane(frame, p)) : null;
    this.stage.showStroke(stroke.map((p) => fromPlane(frame, p)), closed);
  }

  private finishStroke(state: Extract<State, { name: 'drawing' }>): void {
    const outcome = this.closed(state);
    const pen = this.pen();
    if (pen === null) return;
    if ('problem' in outcome) {
      const fault = outcome.problem === 'short' ? `too short for a ${pen.noun}` : 'nearly straight';
      complain(`That stroke was ${fault}. Draw all the way round.`, 'stroke');
      return;
    }
    pen.add(outcome.points.map((p) => fromPlane(state.frame, p)));
  }
}
