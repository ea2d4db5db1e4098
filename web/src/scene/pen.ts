// The line under the pen: what the hand has drawn, and the line that it will become.
import type { Point } from '../shapes/vec.ts';
import { FatLines, pathOf } from './fat_line.ts';
import type { Placement } from './placement.ts';
import type { Theme } from './theme.ts';

export class PenLayer {
  private readonly lines = new FatLines();
  readonly object = this.lines.object;

  show(raw: readonly Point[], closed: readonly Point[] | null, placement: Placement, { pen }: Theme): void {
    this.lines.clear();
    if (raw.length > 1) this.lines.put(pathOf(raw, false, placement), { color: pen.faint, width: 1.5, isOnTop: true, order: 3 });
    if (closed) this.lines.put(pathOf(closed, true, placement), { color: pen.line, width: 3, isOnTop: true, order: 3 });
  }

  clear(): void {
    this.lines.clear();
  }
}
