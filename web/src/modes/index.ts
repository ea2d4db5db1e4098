// The modes of the page, in the order of their buttons. A mode is a folder beside this file and a line in it.
import type { Mode } from '../app/mode.ts';
import { film } from './film/mode.ts';
import { mesh } from './mesh/mode.ts';
import { polygon } from './polygon/mode.ts';
import { surface } from './surface/mode.ts';

export const kModes: readonly Mode[] = [film, polygon, mesh, surface];
