// Files of closed lines, which several modes read.
import type { FileKind } from './mode.ts';

export const kLoopFiles: readonly FileKind[] = [
  {
    id: 'curve',
    what: 'a .curve file',
    label: '.curve',
    extensions: ['.curve', '.txt'],
    // The numbers of loops and of vertices, and then numbers only.
    isIt: ({ isText, start }) => isText && /^\d+\s+\d+(\s|$)/.test(start),
  },
  {
    id: 'loops-json',
    what: 'a JSON file of loops',
    label: 'JSON',
    extensions: ['.json'],
    // A list, or an object with loops. If it is broken JSON, who reads it says what is wrong with it.
    isIt: (content) => content.isJson && (content.json === undefined || Array.isArray(content.json) || content.hasKey('loops')),
  },
  {
    id: 'obj-lines',
    what: 'an OBJ file of lines',
    label: 'OBJ',
    extensions: ['.obj'],
    isIt: (content) => content.hasStatement('v') && content.hasStatement('l'),
  },
];
