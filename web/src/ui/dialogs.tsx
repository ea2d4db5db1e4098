// The gallery and the help sheet, as dialogs.
import type { ComponentChildren } from 'preact';
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import { signal } from '@preact/signals';
import { boundsOf, cross, dot, normalize, subtract, type Point } from '../shapes/vec.ts';
import { openExample } from '../state/files.ts';
import { kGallery, type Example } from '../state/gallery.ts';
import { Icon } from './icons.tsx';

export const openDialog = signal<'gallery' | 'help' | null>(null);

interface DialogProps {
  readonly id: 'gallery' | 'help';
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

export function Gallery() {
  return (
    <Dialog id="gallery" title="Gallery">
      <ul class="cards">
        {kGallery.map((example) => (
          <Card key={example.id} example={example} />
        ))}
      </ul>
    </Dialog>
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

type HelpModule = typeof import('./help.tsx');

/** The sheet is fetched when it is first wanted. */
export function Help() {
  const [found, setFound] = useState<HelpModule | 'none' | null>(null);
  const isWanted = openDialog.value === 'help';
  useEffect(() => {
    if (!isWanted || (found && found !== 'none')) return;
    import('./help.tsx').then(setFound, () => { setFound('none'); });
  }, [isWanted]);
  return (
    <Dialog id="help" title="Keys and gestures">
      {found === 'none' ? <p>The sheet could not be loaded.</p> : found && <found.HelpSheet />}
    </Dialog>
  );
}
