// The dialogs: the gallery, and what keys and gestures do in either mode.
import type { ComponentChildren } from 'preact';
import { useLayoutEffect, useRef, useState } from 'preact/hooks';
import { boundsOf, cross, dot, normalize, subtract, type Point } from '../shapes/vec.ts';
import { openExample } from '../state/files.ts';
import { kGallery, type Example } from '../state/gallery.ts';
import { mode, type Mode } from '../state/store.ts';
import { openDialog, type DialogId } from './dialogs.tsx';
import { Icon } from './icons.tsx';
import '../styles/dialogs.css';

export function Sheets() {
  return (
    <>
      <Dialog id="gallery" title="Gallery">
        <Gallery />
      </Dialog>
      <Dialog id="help" title="Keys and gestures">
        <Help />
      </Dialog>
    </>
  );
}

interface DialogProps {
  readonly id: DialogId;
  readonly title: string;
  readonly children: ComponentChildren;
}

function Dialog({ id, title, children }: DialogProps) {
  const ref = useRef<HTMLDialogElement>(null);
  const isOpen = openDialog.value === id;
  useLayoutEffect(() => {
    if (isOpen) ref.current?.showModal();
    else ref.current?.close();
  }, [isOpen]);
  const close = () => {
    if (openDialog.peek() === id) openDialog.value = null;
  };
  return (
    <dialog
      ref={ref}
      class={`dialog ${id}`}
      aria-labelledby={`${id}-title`}
      onClose={() => {
        // The event comes late: by then the dialog may have been opened again.
        if (ref.current?.open === false) close();
      }}
      onClick={(event) => {
        // On the backdrop, which counts as the dialog itself.
        if (event.target === event.currentTarget) close();
      }}
    >
      <div class="dialog-body">
        <header>
          <h2 id={`${id}-title`}>{title}</h2>
          <button type="button" class="icon-button" aria-label="Close" onClick={close}>
            <Icon name="close" />
          </button>
        </header>
        {isOpen && children}
      </div>
    </dialog>
  );
}

function Gallery() {
  return (
    <ul class="cards">
      {kGallery.map((example) => (
        <Card key={example.id} example={example} />
      ))}
    </ul>
  );
}

function Card({ example }: { example: Example }) {
  const [variant, setVariant] = useState(example.variants?.values[0]);
  const open = (value: number | undefined) => {
    openExample(example, value);
    openDialog.value = null;
  };
  return (
    <li class="card">
      <button
        type="button"
        class="card-open"
        onClick={() => {
          open(variant);
        }}
      >
        <Sketch example={example} variant={variant} />
        <span class="card-title">{example.title}</span>
        <span class="muted">{example.note}</span>
      </button>
      {example.variants && (
        <div class="card-variants" role="group" aria-label={`${example.variants.label}: ${example.title}`}>
          {[...example.variants.values].sort((a, b) => a - b).map((value) => (
            <button
              key={value}
              type="button"
              class={value === variant ? 'chosen' : ''}
              aria-label={`${value} ${example.variants?.label.toLowerCase() ?? ''}`}
              onFocus={() => {
                setVariant(value);
              }}
              onPointerEnter={() => {
                setVariant(value);
              }}
              onClick={() => {
                open(value);
              }}
            >
              {value}
            </button>
          ))}
        </div>
      )}
    </li>
  );
}

/** The curves of an example in outline, seen from its own direction. */
function Sketch({ example, variant }: { example: Example; variant: number | undefined }) {
  const toViewer = normalize(example.view);
  const right = normalize(cross([0, 0, 1], toViewer));
  const up = cross(toViewer, right);
  const curves = example.curves(variant).map((curve) => curve.map((p): Point => [dot(p, right), -dot(p, up), 0]));
  const { center, diagonal } = boundsOf(curves);
  const at = (p: Point) => subtract(p, center).slice(0, 2).map((x) => ((100 * x) / diagonal).toFixed(1)).join(',');
  return (
    <svg class="sketch" viewBox="-62 -46 124 92" aria-hidden="true">
      {curves.map((curve, i) => (
        <polygon key={i} points={curve.map(at).join(' ')} />
      ))}
    </svg>
  );
}

interface Group {
  readonly title: string;
  readonly rows: readonly (readonly [keys: string, what: string])[];
}

const kUndo: Group['rows'] = [
  ['Ctrl Z', 'Undo'],
  ['Ctrl Shift Z, Ctrl Y', 'Redo'],
];

const kHelp: Record<Mode, { readonly about: string; readonly groups: readonly Group[] }> = {
  film: {
    about:
      'Closed curves in, the best surface out: of all manifold triangulations made of the candidate triangles, the one of least cost.',
    groups: [
      {
        title: 'Tools',
        rows: [
          ['V', 'Select: drag a vertex; drag elsewhere to turn the view'],
          ['D', 'Draw: one stroke all the way round is one closed curve'],
          ['A', 'Add a circle in the drawing plane'],
          ['1 2 3 4', 'Drawing plane XY, YZ, ZX, facing you'],
          ['P', 'Face the drawing plane'],
        ],
      },
      {
        title: 'View',
        rows: [
          ['F', 'All curves in view'],
          ['Wheel, pinch', 'Zoom'],
          ['Right drag, two fingers', 'Move; while drawing, turn'],
          ['Alt drag', 'Turn, with either tool'],
          ['Arrows, + −', 'Turn and zoom, with the scene in focus'],
          ['Space', 'Let the surface appear again'],
        ],
      },
      {
        title: 'Edit',
        rows: [
          ...kUndo,
          ['[ ]', 'Previous and next curve'],
          [', .', 'Previous and next vertex'],
          ['Arrows', 'Move the chosen vertex in the screen; Shift: further'],
          ['Delete', 'Delete the chosen curve'],
          ['Esc', 'Cancel the stroke, the drag or the span; choose nothing'],
        ],
      },
      {
        title: 'File',
        rows: [
          ['Ctrl O', 'Open .curve, JSON or OBJ; or drop a file on the page'],
          ['Ctrl S', 'Export the surface as OBJ'],
          ['G', 'Gallery'],
        ],
      },
    ],
  },
  polygon: {
    about: 'Polygons with holes in, triangles out: they lie inside and cover everything.',
    groups: [
      {
        title: 'Tools',
        rows: [
          ['V', 'Select: drag a vertex; drag elsewhere to move the view'],
          ['D', 'Draw: one stroke all the way round is one ring; inside another it is a hole'],
        ],
      },
      {
        title: 'View',
        rows: [
          ['F', 'All polygons in view'],
          ['Wheel, pinch', 'Zoom'],
          ['Right drag, two fingers', 'Move, with either tool'],
          ['Arrows, + −', 'Move and zoom, with the drawing in focus'],
          ['Space', 'Flood step by step, or stop'],
        ],
      },
      {
        title: 'Edit',
        rows: [
          ...kUndo,
          ['[ ]', 'Previous and next ring'],
          [', .', 'Previous and next vertex'],
          ['Arrows', 'Move the chosen vertex; Shift: further'],
          ['Delete', 'Delete the chosen vertex or ring'],
          ['Esc', 'Cancel the stroke, the drag or the flooding; choose nothing'],
        ],
      },
      {
        title: 'File',
        rows: [['Ctrl O', 'Open GeoJSON, .curve, JSON or OBJ; or drop a file on the page']],
      },
    ],
  },
};

function Help() {
  const { about, groups } = kHelp[mode.value];
  return (
    <>
      <p class="muted">{about} On a Mac, Ctrl is ⌘.</p>
      <div class="help-columns">
        {groups.map(({ title, rows }) => (
          <section key={title}>
            <h3>{title}</h3>
            <dl>
              {rows.map(([keys, what]) => (
                <div key={keys}>
                  <dt>
                    <kbd>{keys}</kbd>
                  </dt>
                  <dd>{what}</dd>
                </div>
              ))}
            </dl>
          </section>
        ))}
      </div>
    </>
  );
}
