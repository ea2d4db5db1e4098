// Files in and out: opening loops, saving loops, surfaces and pictures.
import { SoapfilmError } from 'soapfilm';
import { fromLoopSet, toLoopSet } from './document.ts';
import type { Example } from './gallery.ts';
import { isStale, surface } from './solving.ts';
import { dispatch, doc, requestFrame, say, selection } from './store.ts';

/** Files beyond this are not drawn by anyone. */
const kMaxMegabytes = 64;

type Formats = typeof import('./formats.ts');
const fetchFormats = (): Promise<Formats> => import('./formats.ts');

/** Reads a file for `open`, which tells what it has opened; says so, or what is wrong. */
export async function readFile(
  file: File,
  open: (bytes: Uint8Array, stem: string) => string | Promise<string>,
): Promise<void> {
  const megabytes = file.size / 2 ** 20;
  if (megabytes > kMaxMegabytes) {
    say(`“${file.name}” has ${Math.round(megabytes)} MB; no more than ${kMaxMegabytes} are opened.`, 'error');
    return;
  }
  try {
    const opened = await open(new Uint8Array(await file.arrayBuffer()), file.name.replace(/\.[^.]*$/, ''));
    say(`Opened “${file.name}”: ${opened}.`);
  } catch (error) {
    const reason = error instanceof SoapfilmError ? error.message : 'the browser could not read it';
    say(`Could not open “${file.name}”: ${reason}`, 'error');
  }
}

/** Opens a `.curve`, JSON or OBJ file in place of the document; says what is wrong if it cannot. */
export const openFile = (file: File): Promise<void> =>
  readFile(file, async (bytes, stem) => {
    const { parseLoops } = await fetchFormats();
    const loops = parseLoops(bytes);
    const curves = fromLoopSet(loops);
    selection.value = null;
    dispatch({ type: 'open', name: loops.name ?? stem, curves });
    requestFrame();
    return countOf(curves.length, 'curve');
  });

export function openExample(example: Example, variant: number | undefined, atOnce = false): void {
  selection.value = null;
  dispatch({
    type: 'open',
    name: variant === undefined ? example.title : `${example.title} (${variant})`,
    curves: example.curves(variant),
    settings: example.settings,
  });
  requestFrame(example.view, atOnce);
}

/** Downloads the surface as OBJ; returns whether there was one to be had. */
export function saveSurface(): boolean {
  const shown = surface.peek();
  if (shown === null || isStale.peek()) {
    say('There is no surface of these curves to export yet.', 'error');
    return false;
  }
  const { name } = doc.peek();
  save(`${fileStem()}.obj`, 'model/obj', ({ formatObj }) => formatObj(shown.span, { name }));
  return true;
}

export function saveLoops(format: 'curve' | 'json'): boolean {
  const { curves, name } = doc.peek();
  if (curves.length === 0) {
    say('There are no curves to export yet.', 'error');
    return false;
  }
  const type = format === 'json' ? 'application/json' : 'text/plain';
  save(`${fileStem()}.${format}`, type, ({ formatLoops }) => formatLoops({ ...toLoopSet(curves), name }, format));
  return true;
}

export function savePicture(picture: Blob): void {
  download(`${fileStem()}.png`, picture, 'image/png');
}

function fileStem(): string {
  const stem = doc.peek().name.toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '');
  return stem === '' ? 'soapfilm' : stem;
}

/** Downloads what `write` makes, once it can. */
function save(fileName: string, type: string, write: (formats: Formats) => string): void {
  fetchFormats().then(
    (formats) => {
      download(fileName, write(formats), type);
    },
    () => {
      say(`Could not save “${fileName}”: what writes files could not be loaded.`, 'error');
    },
  );
}

function download(fileName: string, data: string | Blob, type: string): void {
  const url = URL.createObjectURL(typeof data === 'string' ? new Blob([data], { type }) : data);
  const link = document.createElement('a');
  link.href = url;
  link.download = fileName;
  link.click();
  // Safari reads the address only after the click has been handled.
  setTimeout(() => {
    URL.revokeObjectURL(url);
  }, 10_000);
}

/** "1 curve", "3 curves". */
export function countOf(count: number, noun: string, plural = `${noun}s`): string {
  return `${count.toLocaleString('en')} ${count === 1 ? noun : plural}`;
}
