// The page: the bar at the top, the modes below it, dialogs.
import { useEffect, useState } from 'preact/hooks';
import type { Stage } from '../scene/stage.ts';
import { openFile } from '../state/files.ts';
import { doc, mode } from '../state/store.ts';
import { IconButton } from './bars.tsx';
import { Dialogs, openDialog } from './dialogs.tsx';
import { FilmMode, FilmNav } from './film.tsx';
import { Logo } from './icons.tsx';
import { ModeSwitch, polygonModule } from './modes.tsx';

export function App({ stage, scene }: { stage: Stage; scene: HTMLElement }) {
  const polygons = polygonModule.value;
  const isFilm = mode.value === 'film';
  return (
    <>
      <header class="top-bar">
        <h1>
          <Logo />
          <span>soapfilm</span>
        </h1>
        <ModeSwitch />
        {isFilm ? <FilmNav stage={stage} /> : polygons && <polygons.PolygonNav />}
        <span class="document-name">{(isFilm ? doc : polygons?.polygonDoc)?.value.name}</span>
        <IconButton icon="help" label="Keys and gestures" keys="?" onClick={() => (openDialog.value = 'help')} />
      </header>
      <FilmMode stage={stage} scene={scene} />
      {polygons && <polygons.PolygonMode />}
      <DropZone />
      <Dialogs />
    </>
  );
}

/** Takes a file dropped anywhere on the page. */
function DropZone() {
  const [over, setOver] = useState(false);
  useEffect(() => {
    let depth = 0;
    const hasFile = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
    const onEnter = (event: DragEvent) => {
      if (!hasFile(event)) return;
      depth++;
      setOver(true);
    };
    const onLeave = (event: DragEvent) => {
      if (hasFile(event) && --depth <= 0) setOver(false);
    };
    const onOver = (event: DragEvent) => {
      if (hasFile(event)) event.preventDefault();
    };
    const onDrop = (event: DragEvent) => {
      if (!hasFile(event)) return;
      event.preventDefault();
      depth = 0;
      setOver(false);
      const file = event.dataTransfer?.files[0];
      const open = mode.peek() === 'film' ? openFile : polygonModule.peek()?.openPolygonFile;
      if (file) void open?.(file);
    };
    window.addEventListener('dragenter', onEnter);
    window.addEventListener('dragleave', onLeave);
    window.addEventListener('dragover', onOver);
    window.addEventListener('drop', onDrop);
    return () => {
      window.removeEventListener('dragenter', onEnter);
      window.removeEventListener('dragleave', onLeave);
      window.removeEventListener('dragover', onOver);
      window.removeEventListener('drop', onDrop);
    };
  }, []);
  const kinds = mode.value === 'film' ? '.curve, JSON or OBJ' : 'GeoJSON, .curve, JSON or OBJ';
  return over ? <div class="drop-zone">Drop a {kinds} file</div> : null;
}
