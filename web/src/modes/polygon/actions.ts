// What can be done with polygons besides what all modes have.
import type { Action } from '../../app/actions.ts';
import { fileStem, save } from '../../app/files.ts';
import type { Lines } from '../../shapes/lines.ts';
import { complain } from '../../state/notice.ts';
import { beginWith, openItems, type Opening } from '../../state/store.ts';
import { newItem } from '../../state/document.ts';
import { kExamples, type Example } from './examples.ts';
import { beginFlooding, endFlooding, isFlooding } from './flooding.ts';
import { polygonGroup, polygonKind } from './polygons.ts';
import { triangulated } from './triangulating.ts';

const hasPolygons = (): boolean => polygonGroup.value.items.length > 0;

export const kActions: readonly Action[] = [
  {
    id: 'flood',
    label: () => (isFlooding.value ? 'Stop flooding' : 'Flood step by step'),
    help: 'Flood step by step, or stop',
    section: 'View',
    keys: [' '],
    bar: 'view',
    icon: () => (isFlooding.value ? 'skip' : 'play'),
    applies: hasPolygons,
    run: () => {
      if (!endFlooding()) beginFlooding();
    },
  },
  {
    id: 'save triangles',
    label: 'Export the triangles',
    help: 'Export the triangles as OBJ',
    section: 'File',
    keys: ['ctrl+s'],
    bar: 'export',
    text: 'Triangles',
    note: 'OBJ',
    applies: hasPolygons,
    run: saveTriangles,
  },
  {
    id: 'save polygons',
    label: 'Export the polygons',
    bar: 'export',
    text: 'Polygons',
    note: 'GeoJSON',
    applies: hasPolygons,
    run: savePolygons,
  },
];

function saveTriangles(): void {
  const found = triangulated.peek();
  if (found === null || found.of !== polygonGroup.peek() || found.triangles.length === 0) {
    complain('There are no triangles of these polygons to export yet.', 'export');
    return;
  }
  const { name } = found.of;
  save(`${fileStem(name)}.obj`, 'model/obj', async () => (await import('./write.ts')).writeObj(found, name));
}

function savePolygons(): void {
  const { name, items } = polygonGroup.peek();
  const polygons = items.map(({ shape }) => shape as Lines);
  save(`${fileStem(name)}.geojson`, 'application/geo+json', async () => (await import('./write.ts')).writeGeoJSON(polygons, name));
}

const openingOf = ({ title, shape }: Example): Opening => ({ name: title, items: [newItem(polygonKind, shape())] });

export function openExample(example: Example): void {
  openItems(polygonGroup.peek(), openingOf(example));
}

/** The first example, as what was there from the beginning. */
export function beginWithExample(): void {
  beginWith(polygonGroup.peek(), openingOf(kExamples[0]));
}
