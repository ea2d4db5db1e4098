// Files of closed lines, which several modes read.
import type { Content } from './content.ts';
import type { FileKind } from './mode.ts';

export const kLoopFiles: readonly FileKind[] = [
  {
    id: 'curve',
    what: 'a .curve file',
    label: '.curve',
    extensions: ['.curve', '.txt'],
    // The numbers of loops and of vertices, and then numbers only.
    isIt: ({ head }) => /^\d+\s+\d+\s/.test(head),
  },
  {
    id: 'loops-json',
    what: 'a JSON file of loops',
    label: 'JSON',
    extensions: ['.json'],
    // Whatever is not JSON of something else: who reads it says what is wrong with it.
    isIt: ({ isJson, jsonType }) => isJson && jsonType === undefined,
  },
  {
    id: 'obj-lines',
    what: 'an OBJ file of lines',
    label: 'OBJ',
    extensions: ['.obj'],
    isIt: (content: Content) => content.hasStatement('v') && content.hasStatement('l'),
  },
];
