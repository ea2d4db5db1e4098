// A mode is a room of the page: `Mode` is what the page knows of it at once, `Room` what is fetched when it is first
// wanted. A folder of web/src/modes holds each, and a line in modes/index.ts makes it known.
import type { ComponentType } from 'preact';
import type { ReadonlySignal } from '@preact/signals';
import type { ModeScene } from '../scene/mode_scene.ts';
import type { Stage } from '../scene/stage.ts';
import type { PenTool } from '../scene/tools.ts';
import type { DrawnKind } from '../scene/kind.ts';
import type { Item } from '../state/document.ts';
import type { Failure } from '../state/work.ts';
import type { Action } from './actions.ts';
import type { Content } from './content.ts';

/** A format of files, told by what is in them. */
export interface FileKind {
  /** The name by which a room reads it. */
  readonly id: string;
  /** In words, for a sentence: "a GeoJSON file". */
  readonly what: string;
  /** For a list: "GeoJSON". */
  readonly label: string;
  /** With dots. */
  readonly extensions: readonly string[];
  /** Whether the content is of this format; files that are broken further on count. */
  readonly isIt: (content: Content) => boolean;
}

export interface Mode {
  /** Stands in the address, after `#`; the first mode of the registry has none there. */
  readonly id: string;
  readonly label: string;
  readonly title: string;
  /** The formats that its room reads, in the order of its words about them. */
  readonly files: readonly FileKind[];
  /** Fetches the room. */
  readonly fetch: () => Promise<{ readonly openRoom: (stage: Stage) => Room }>;
}

/** What a file holds for a room. */
export interface ReadFile {
  readonly items: readonly Item[];
  /** What the file calls itself. */
  readonly name?: string;
  /** What was left out of it, a sentence each. */
  readonly warnings?: readonly string[];
}

/** A row of the help sheet that no action stands for, such as a gesture. */
export interface HelpRow {
  readonly section: string;
  readonly keys: string;
  readonly what: string;
}

export interface Room {
  /** 2: the plane seen from above. */
  readonly dimension: 2 | 3;
  // eslint-disable-next-line @typescript-eslint/no-explicit-any -- each kind reads only shapes of its own
  readonly kinds: readonly DrawnKind<any>[];
  /** What the objects are called: `curve`, `curves`. */
  readonly nouns: readonly [one: string, many: string];
  /** What parts of objects are called, which `[` and `]` go through; by default as objects are. */
  readonly partNoun?: string;
  /** What files hold for it, such as "loops"; by default its objects. */
  readonly fileNoun?: string;
  /** The settings of a new group. */
  readonly settings: object;
  /** Whether settings from a draft, which have the right types, are such that the mode can work with them. */
  readonly areSettings?: (settings: object) => boolean;
  /** Puts something into an empty document to begin with, without a step of the history. */
  readonly begin: () => void;
  /** Called once, when the scene of the mode is there: adds to it what the mode draws besides objects. */
  readonly draw?: (scene: ModeScene) => void;
  /** The objects in the content of a file of one of the mode's kinds. @throws SoapfilmError `bad-file` */
  readonly read: (kind: string, content: Content) => ReadFile | Promise<ReadFile>;
  readonly pen?: PenTool;
  /** What is wrong with objects, marked at them and in words. */
  readonly failures: ReadonlySignal<readonly Failure[]>;
  readonly actions: readonly Action[];
  /** Called when the scene is pressed, before a tool takes it. */
  readonly pressed?: () => void;
  /** Ends what Escape ends in this mode alone; says whether there was anything. */
  readonly escape?: () => boolean;
  readonly help: { readonly about: string; readonly rows: readonly HelpRow[] };
  /** One line on how things stand. */
  readonly summary: ReadonlySignal<string>;
  /** The panel's name. */
  readonly panelLabel: string;
  readonly sceneLabel: string;
  readonly Panel: ComponentType;
  /** What floats over the scene besides what all modes have. */
  readonly Overlay?: ComponentType;
  /** Dialogs of its own, opened by `openDialog`. */
  readonly dialogs?: readonly { readonly id: string; readonly title: string; readonly Body: ComponentType }[];
  /** How to begin, over a scene with nothing in it: with the pen in hand, and on the button that puts it there. */
  readonly hint?: { readonly drawing: string; readonly draw: string };
}
