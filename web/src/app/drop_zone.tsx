// Files dropped anywhere on the page, or pasted into it.
import { useEffect, useRef, useState } from 'preact/hooks';
import { listed } from './files.ts';
import type { Mode } from './mode.ts';

interface DropZoneProps {
  /** Null: none is there yet, and files are let go. */
  readonly mode: Mode | null;
  readonly open: (files: readonly File[]) => void;
}

export function DropZone({ mode, open }: DropZoneProps) {
  const [isOver, setOver] = useState(false);
  const latestOpen = useRef(open);
  latestOpen.current = open;
  useEffect(() => {
    let depth = 0;
    const hasFile = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
    const take = (data: DataTransfer | null) => {
      const files = [...(data?.files ?? [])];
      if (files.length > 0) latestOpen.current(files);
    };
    const listeners = new AbortController();
    const listen = <T extends 'dragenter' | 'dragleave' | 'dragover' | 'drop' | 'paste'>(
      type: T,
      on: (event: WindowEventMap[T]) => void,
    ) => {
      window.addEventListener(type, on, { signal: listeners.signal });
    };
    listen('dragenter', (event) => {
      if (!hasFile(event)) return;
      depth++;
      setOver(true);
    });
    listen('dragleave', (event) => {
      if (hasFile(event) && --depth <= 0) setOver(false);
    });
    // Without this the browser would leave the page and show the file.
    listen('dragover', (event) => {
      if (hasFile(event)) event.preventDefault();
    });
    listen('drop', (event) => {
      if (!hasFile(event)) return;
      event.preventDefault();
      depth = 0;
      setOver(false);
      take(event.dataTransfer);
    });
    listen('paste', (event) => {
      // What is pasted into a field is text, of which a program may offer a picture as well.
      const isField = event.target instanceof Element && event.target.closest('input, textarea') !== null;
      if (!isField) take(event.clipboardData);
    });
    return () => {
      listeners.abort();
    };
  }, []);
  if (!isOver || mode === null) return null;
  // Several formats may have one label.
  const labels = [...new Set(mode.files.map(({ label }) => label))];
  return <div class="drop-zone">Drop {listed(labels, undefined, 'or')} files</div>;
}
