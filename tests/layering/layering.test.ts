import path from 'node:path';
import { describe, expect, test } from 'vitest';
import { breaches, readSources } from './arrows.ts';

const root = path.resolve(import.meta.dirname, '../..');
const folders = ['wasm/src', 'wasm/include', 'wasm/ts', 'web', 'tests', 'examples'];

describe('layers', () => {
  test('the repository: every include and import follows the arrows', () => {
    const files = readSources(root, folders).filter((file) => !file.path.startsWith('tests/layering/'));
    expect(files.length).toBeGreaterThan(10);
    expect(breaches(files)).toEqual([]);
  });

  const bad: [string, string, string][] = [
    ['base that includes loops', 'wasm/src/base/vec.h', '#include "loops/span.h"'],
    ['delaunay that includes abi', 'wasm/src/delaunay/a.cpp', '#include "abi/span.h"'],
    ['polygon that includes loops', 'wasm/src/polygon/a.h', '#include "loops/span.h"'],
    ['an include without its folder', 'wasm/src/loops/a.cpp', '#include "span.h"'],
    ['an include by a path', 'wasm/src/loops/a.cpp', '#include "../base/vec.h"'],
    ['the C ABI seen by a feature', 'wasm/src/loops/a.cpp', '#include "soapfilm.h"'],
    ['tables of the C ABI in a feature', 'wasm/src/polygon/batch.h', '#include "soapfilm_tables.h"'],
    ['a problem that knows its solver', 'wasm/src/loops/problem/a.h', '#include "loops/solver.h"'],
    ['domains that know their bounds', 'wasm/src/loops/domains/a.cpp', '#include "loops/bounds/fan_bound.h"'],
    ['spaces that solve', 'wasm/src/loops/spaces/a.cpp', '#include "loops/domains/pass.h"'],
    ['a sweep that fills', 'wasm/src/polygon/sweep/a.cpp', '#include "polygon/fill/flood.h"'],
    ['triangles that know polygons', 'wasm/src/triangles/a.h', '#include "polygon/input/polygon.h"'],
    ['the C ABI inside a feature', 'wasm/src/abi/a.cpp', '#include "loops/bounds/fan_bound.h"'],
    ['a folder without a layer', 'wasm/src/util/a.h', '#include "base/vec.h"'],
    ['pointers outside runtime.ts', 'wasm/ts/loops.ts', 'new Uint8Array(memory.buffer, 8, 4);'],
    ['an allocation outside runtime.ts', 'wasm/ts/loops.ts', "call('sf_alloc', 8);"],
    ['node: in a module for browsers', 'wasm/ts/load.ts', "import { readFile } from 'node:fs';"],
    ['a package in the library', 'wasm/ts/load.ts', "import { zip } from 'fflate';"],
    ['a feature that imports the index', 'wasm/ts/loops.ts', "import { load } from './index.js';"],
    ['a page that reaches into wasm', 'web/src/a.ts', "import { load } from '../../wasm/ts/load.js';"],
    ['a test that reaches into dist', 'tests/unit/a.test.ts', "await import('../../wasm/dist/index.js')"],
    ['an example with a private name', 'examples/01.mjs', "import 'soapfilm/wasm/dist/load.js';"],
    ['a mode that imports another', 'web/src/modes/film/a.ts', "import { kPolygon } from '../polygon/kind.ts';"],
    ['a mode fetched by a core that knows it', 'web/src/app/a.ts', "await import('../modes/film/room.tsx');"],
    ['a registry seen by the core', 'web/src/app/a.ts', "import { kModes } from '../modes/index.ts';"],
    ['a mode that imports the registry', 'web/src/modes/film/a.ts', "import { kModes } from '../index.ts';"],
    ['state that draws', 'web/src/state/a.ts', "import { View } from '../scene/view.ts';"],
    ['a scene with panels', 'web/src/scene/a.ts', "import { Section } from '../app/controls.tsx';"],
    ['shapes that know the state', 'web/src/shapes/a.ts', "import { doc } from '../state/store.ts';"],
    ['a mode that puts the page together', 'web/src/modes/film/a.ts', "import '../../main.tsx';"],
    ['a folder of the page without a layer', 'web/src/util/a.ts', "import { add } from '../shapes/vec.ts';"],
    ['a page that imports tests', 'web/src/a.ts', "import { circle } from '../../tests/support/a.ts';"],
  ];
  test.each(bad)('%s: is found', (_, file, text) => {
    expect(breaches([{ path: file, text }])).toHaveLength(1);
  });

  const good: [string, string, string][] = [
    ['a search by bounds', 'wasm/src/loops/search/a.h', '#include "loops/bounds/direct_solver.h"'],
    ['repair by the sweep', 'wasm/src/polygon/repair/a.cpp', '#include "polygon/sweep/segment_order.h"'],
    ['loops on delaunay', 'wasm/src/loops/a.cpp', '#include "delaunay/delaunay.h"\n#include <vector>'],
    ['abi on all', 'wasm/src/abi/a.cpp', '#include "soapfilm.h"\n#include "loops/span.h"'],
    ['statuses by their table', 'wasm/src/base/status.h', '#include "soapfilm_tables.h"'],
    ['a test of the core', 'tests/cpp/a.cpp', '#include "loops/span.h"'],
    ['Node in a Node file', 'wasm/ts/node_host.ts', "import { Worker } from 'node:worker_threads';"],
    ['a package where it is bundled', 'wasm/ts/glb.ts', "import { Document } from '@gltf-transform/core';"],
    ['the library by name', 'web/src/a.ts', "import { load } from 'soapfilm';\nimport * as t from 'three';"],
    ['a test of the page', 'tests/page/a.test.ts', "import { join } from '../../web/src/a.ts';"],
    ['a mode on the core', 'web/src/modes/film/a.tsx', "import { Section } from '../../app/controls.tsx';\nimport { b } from './b.ts';"],
    ['a registry of modes', 'web/src/modes/index.ts', "import { film } from './film/mode.ts';"],
    ['the page on its registry', 'web/src/main.tsx', "import { kModes } from './modes/index.ts';"],
    ['an import in a comment', 'wasm/ts/load.ts', "// import { load } from 'soapfilm'"],
  ];
  test.each(good)('%s: is allowed', (_, file, text) => {
    expect(breaches([{ path: file, text }])).toEqual([]);
  });
});
