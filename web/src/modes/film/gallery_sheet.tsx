// The gallery: examples to begin with, each in outline.
import { useState } from 'preact/hooks';
import { openDialog } from '../../app/dialogs.tsx';
import { boundsOf, cross, dot, normalize, subtract, unionOf, type Point } from '../../shapes/vec.ts';
import { openExample } from './film.ts';
import { kGallery, type Example } from './gallery.ts';

export function Gallery() {
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
  const { center, diagonal } = boundsOf(unionOf(curves.flat().map((p) => ({ low: p, high: p }))));
  const at = (p: Point) => subtract(p, center).slice(0, 2).map((x) => ((100 * x) / diagonal).toFixed(1)).join(',');
  return (
    <svg class="sketch" viewBox="-62 -46 124 92" aria-hidden="true">
      {curves.map((curve, i) => (
        <polygon key={i} points={curve.map(at).join(' ')} />
      ))}
    </svg>
  );
}
