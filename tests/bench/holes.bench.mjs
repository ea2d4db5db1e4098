// npm run bench -- holes [words…]: holes are filled in meshes from which faces were cut away, and compared with these.
// Reads ../shared/data/holes, where that is there; peers are figures recorded in its peers.json. Only meshes whose
// name holds all the words; without words also times of large meshes.
//   node holes.bench.mjs <folder or -> <results.json> [words…]
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { fillHoles, findHoles, load, smoothSurface, spanLoops } from 'soapfilm';
import { createWorker } from 'soapfilm/worker';
import { farthest, minimalSurfaces } from './minimal_surfaces.mjs';
import { countCrossings, rimAngle, rmsBetween, topology } from './hole_measures.mjs';

const [folder, results, ...words] = process.argv.slice(2);
const kRuns = 5;

const quantile = (list, share) => [...list].sort((a, b) => a - b)[Math.min(list.length - 1, Math.floor(share * list.length))];
const median = (list) => quantile(list, 0.5);
const mean = (list) => list.reduce((sum, x) => sum + x, 0) / list.length;
const left = (text, width) => String(text).padEnd(width);
const right = (text, width) => String(text).padStart(width);
const seconds = (s) => (s < 1 ? `${(1000 * s).toFixed(0)} ms` : `${s.toFixed(2)} s`);

/** Median processor time of warm runs, and the last result. */
function timed(run, runs = kRuns) {
  const times = [];
  let result;
  for (let i = 0; i <= runs; i++) {
    const start = process.cpuUsage();
    result = run();
    const { user, system } = process.cpuUsage(start);
    if (i > 0 || runs === 0) times.push((user + system) / 1e6);
  }
  return { seconds: median(times), result };
}

function readMesh(name) {
  const bytes = readFileSync(path.join(folder, `${name}.bin`));
  const copy = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
  const [v, f] = new Uint32Array(copy, 0, 2);
  return { positions: new Float32Array(copy, 8, 3 * v), faces: new Uint32Array(copy, 8 + 12 * v, 3 * f) };
}

const keyOf = (loops) => loops.map((loop) => [...loop].sort((a, b) => a - b).join()).sort().join(';');

/** Groups that are right, loops that are attached to theirs, and groups that hold loops of several. */
function grouped({ loops, groups }, { groups: truth, openRims }) {
  const found = groups.map((group) => ({ ...group, key: keyOf(group.loops.map((loop) => loops[loop].vertices)) }));
  const isThere = (wanted, isOpen) => found.some(({ key, isOpenRim }) => key === keyOf(wanted) && isOpenRim === isOpen);
  const right = truth.filter((group) => isThere(group.loops, false));
  const groupOf = new Map();
  truth.forEach((group, g) => group.loops.forEach((loop) => groupOf.set(keyOf([loop]), g)));
  const wrong = groups.filter((group) => {
    const members = group.loops.map((loop) => groupOf.get(keyOf([loops[loop].vertices])) ?? -1);
    return members.some((member) => member !== members[0]);
  });
  const extra = (list) => list.reduce((sum, group) => sum + group.loops.length - 1, 0);
  return {
    groups: truth.length,
    groupsRight: right.length,
    extraLoops: extra(truth),
    attached: extra(right),
    wrongJoins: wrong.length,
    openRims: openRims.length,
    openRight: openRims.filter((loop) => isThere([loop], true)).length,
  };
}

/** Distance to the surface by its formula, of new vertices, per radius; null if there is none. */
function offExact({ mesh, oldVertices }, exact) {
  const distance = {
    sphere: (x, y, z) => Math.hypot(x, y, z) - 1,
    torus: (x, y, z) => Math.hypot(Math.hypot(x, y) - exact?.R, z) - exact?.r,
  }[exact?.kind];
  if (!distance || mesh.positions.length === 3 * oldVertices) return null;
  const squares = [];
  for (let i = 3 * oldVertices; i < mesh.positions.length; i += 3) squares.push(distance(...mesh.positions.subarray(i, i + 3)) ** 2);
  return Math.sqrt(mean(squares)) / exact.R;
}

function measure(truth) {
  const mesh = readMesh(truth.name);
  const reference = readMesh(`${truth.name}.ref`);
  const report = findHoles(mesh);
  const { seconds: all, result } = timed(() => fillHoles(mesh), 1);
  const told = result.holes.reduce((sum, { intersections }) => sum + intersections.length / 2, 0);
  const { open, repeated, euler } = topology(result.mesh);
  const rims = truth.openRims.reduce((sum, rim) => sum + rim.length, 0);
  const added = result.mesh.faces.length / 3 - result.oldFaces;
  return {
    name: truth.name,
    ...grouped(report, truth),
    isClosed: open === rims && repeated === 0 && euler === truth.filled.chi,
    filled: result.holes.filter(({ status }) => status === 'filled').length,
    holes: result.holes.length,
    told,
    crossings: countCrossings(result.mesh, result.oldFaces),
    rms: (100 * rmsBetween(result.mesh, result.oldFaces, reference)) / truth.diagonal,
    rimAngle: rimAngle(result.mesh, result.oldFaces),
    rimAngleOfOriginal: truth.rimAngleOfOriginal.mean,
    triangles: added / (reference.faces.length / 3),
    movedLess: Math.max(0, ...result.holes.map(({ movedLess }) => movedLess)),
    offExact: offExact(result, truth.exact),
    seconds: all,
  };
}

const kHeading = `${left('mesh', 15)}${right('groups', 9)}${right('attached', 9)}${right('wrong', 6)}  ${left('closed', 7)}${right('pairs', 6)}${right('RMS %', 9)}${right('best peer', 10)}${right('rim °', 7)}${right('own °', 7)}${right('× tri', 7)}${right('off / R', 9)}${right('time', 9)}`;

function row(m, peer) {
  const closed = m.isClosed ? 'yes' : `NO ${m.filled}/${m.holes}`;
  return (
    left(m.name, 15) +
    right(`${m.groupsRight}/${m.groups}`, 9) +
    right(`${m.attached}/${m.extraLoops}`, 9) +
    right(m.wrongJoins, 6) +
    `  ${left(closed, 7)}` +
    right(m.crossings === m.told ? m.told : `${m.told}(${m.crossings})`, 6) +
    right(m.rms.toFixed(4), 9) +
    right(peer === null ? '' : peer.toFixed(4), 10) +
    right(m.rimAngle.toFixed(2), 7) +
    right(m.rimAngleOfOriginal.toFixed(2), 7) +
    right(m.triangles.toFixed(2), 7) +
    right(m.offExact === null ? '' : m.offExact.toExponential(1), 9) +
    right(seconds(m.seconds), 9)
  );
}

/** The least RMS of any peer on a mesh. */
function bestPeer(peers, name) {
  const all = Object.values(peers[name] ?? {}).flatMap(({ rms_pct: rms }) => (rms > 0 ? [rms] : []));
  return all.length > 0 ? Math.min(...all) : null;
}

function summaryLines(measured, peers) {
  const sum = (key) => measured.reduce((total, m) => total + Number(m[key]), 0);
  const rms = measured.map((m) => m.rms);
  const curved = measured.filter((m) => m.rimAngleOfOriginal >= 0.5);
  const least = measured.filter((m) => m.rms <= (bestPeer(peers, m.name) ?? Infinity));
  const cutAway = measured.reduce((total, m) => total + m.triangles, 0) / measured.length;
  return [
    `groups right ${sum('groupsRight')} of ${sum('groups')}, loops attached ${sum('attached')} of ${sum('extraLoops')}, wrong joins ${sum('wrongJoins')}, open rims ${sum('openRight')} of ${sum('openRims')}`,
    `closed as the original: ${sum('isClosed')} of ${measured.length}; pairs that intersect, as told ${sum('told')}, as counted here ${sum('crossings')}`,
    `RMS, % of the diagonal: median ${median(rms).toFixed(4)}, mean ${mean(rms).toFixed(4)}; least of all on ${least.length} of ${measured.length}`,
    `rim angle over the original's own: mean ${mean(curved.map((m) => m.rimAngle / m.rimAngleOfOriginal)).toFixed(3)}; triangles ${cutAway.toFixed(2)} × those cut away, at most ${Math.max(...measured.map((m) => m.triangles)).toFixed(2)}`,
  ];
}

/** The same of what was recorded of the peers. */
function peerLines(peers, names) {
  const programs = [...new Set(names.flatMap((name) => Object.keys(peers[name] ?? {})))];
  return programs.map((program) => {
    const of = names.flatMap((name) => peers[name]?.[program] ?? []);
    const sum = (key) => of.reduce((total, m) => total + Number(m[key] ?? 0), 0);
    const rms = of.flatMap(({ rms_pct: each }) => (each === undefined || each === null ? [] : [each]));
    const time = peers['bunny2-455']?.[program]?.cpu_s;
    return (
      left(program, 32) +
      right(`${sum('groups_right')}/${sum('groups')}`, 9) +
      right(`${sum('attached')}/${sum('extra_loops')}`, 9) +
      right(sum('wrong_joins'), 6) +
      right(`${sum('topology_right')}/${of.length}`, 8) +
      right(sum('si_pairs'), 8) +
      right(rms.length > 0 ? median(rms).toFixed(3) : '', 9) +
      right(rms.length > 0 ? mean(rms).toFixed(3) : '', 9) +
      right(time > 0 ? seconds(time) : '', 10)
    );
  });
}

/** Each face parted into four. */
function subdivided({ positions, faces }) {
  const points = Array.from(positions);
  const middles = new Map();
  const n = positions.length / 3;
  const middle = (a, b) => {
    const key = a < b ? a * n + b : b * n + a;
    let found = middles.get(key);
    if (found === undefined) {
      found = points.length / 3;
      for (let k = 0; k < 3; k++) points.push((points[3 * a + k] + points[3 * b + k]) / 2);
      middles.set(key, found);
    }
    return found;
  };
  const parts = new Uint32Array(4 * faces.length);
  for (let f = 0; f < faces.length; f += 3) {
    const [a, b, c] = faces.subarray(f, f + 3);
    const [p, q, r] = [middle(a, b), middle(b, c), middle(c, a)];
    parts.set([a, p, r, b, q, p, c, r, q, p, q, r], 4 * f);
  }
  return { positions: Float64Array.from(points), faces: parts };
}

/** The closed mesh with many faces, and small holes of three rings of faces, as far apart as may be. */
function manyFaces(closed, leastFaces, count) {
  let mesh = closed;
  while (mesh.faces.length / 3 < leastFaces) mesh = subdivided(mesh);
  const { positions, faces } = mesh;
  let marked = new Set();
  for (let i = 0; i < count; i++) marked.add(Math.floor(((i + 0.5) * closed.positions.length) / 3 / count));
  const gone = new Uint8Array(faces.length / 3);
  for (let ring = 0; ring < 2; ring++) {
    const next = new Set(marked);
    for (let f = 0; f < faces.length; f += 3) {
      if (!marked.has(faces[f]) && !marked.has(faces[f + 1]) && !marked.has(faces[f + 2])) continue;
      gone[f / 3] = 1;
      for (let k = 0; k < 3; k++) next.add(faces[f + k]);
    }
    marked = next;
  }
  return { positions, faces: faces.filter((_, i) => gone[Math.floor(i / 3)] === 0) };
}

/**
 * A sphere without a third: its rim has `count` vertices. Rows of squares as wide as the rim's edges, and then of
 * half as many, again and again, so that it has few faces.
 */
function openSphere(count) {
  const [positions, faces] = [[], []];
  const ring = (angle, columns) => {
    const first = positions.length / 3;
    for (let i = 0; i < columns; i++) {
      const turn = (2 * Math.PI * i) / columns;
      positions.push(Math.sin(angle) * Math.cos(turn), Math.sin(angle) * Math.sin(turn), Math.cos(angle));
    }
    return first;
  };
  let angle = Math.acos(1 / 3);
  let [columns, before, row] = [count, ring(angle, count), 0];
  for (;;) {
    angle += (2 * Math.PI * Math.sin(angle)) / columns;
    if (angle > Math.PI - 0.02 || columns < 8) break;
    const half = ++row % 8 === 0 && columns % 2 === 0 && columns > 30;
    const next = ring(angle, half ? columns / 2 : columns);
    for (let i = 0; i < columns; i += half ? 2 : 1) {
      const [a, b, c] = [i, (i + 1) % columns, (i + 2) % columns].map((k) => before + k);
      if (half) {
        const [p, q] = [next + i / 2, next + ((i / 2 + 1) % (columns / 2))];
        faces.push(a, p, b, b, p, q, b, q, c);
      } else {
        const [p, q] = [next + i, next + ((i + 1) % columns)];
        faces.push(a, p, q, a, q, b);
      }
    }
    if (half) columns /= 2;
    before = next;
  }
  const pole = positions.push(0, 0, -1) / 3 - 1;
  for (let i = 0; i < columns; i++) faces.push(before + i, pole, before + ((i + 1) % columns));
  return { positions: Float64Array.from(positions), faces: Uint32Array.from(faces) };
}

function told(title, mesh, { seconds: took, result }) {
  const holes = result.holes.filter(({ status }) => status === 'filled').length;
  const added = result.mesh.faces.length / 3 - (result.mesh.faces.length > mesh.faces.length ? result.oldFaces : 0);
  console.log(`${left(title, 62)}${right(seconds(took), 9)}   ${holes} of ${result.holes.length} filled, ${added} new faces`);
  return { title, seconds: took, holes, added };
}

/** Median seconds on the clock of warm runs with one worker and with two, in turns; and whether they give the same. */
async function measureWorkers(mesh) {
  const films = await Promise.all([1, 2].map((size) => createWorker({ parts: ['meshes'], size })));
  const times = films.map(() => []);
  const results = [];
  for (let i = 0; i <= kRuns; i++) {
    for (const [k, film] of films.entries()) {
      const start = performance.now();
      results[k] = await film.fillHoles(mesh);
      if (i > 0) times[k].push((performance.now() - start) / 1000);
    }
  }
  for (const film of films) film.dispose();
  const [one, two] = times.map(median);
  const isSame = results[0].mesh.positions.every((x, i) => x === results[1].mesh.positions[i]);
  return { one, two, isSame };
}

function measureFilm(surface) {
  const span = spanLoops(surface.loops, { candidates: 'delaunay' });
  const { seconds: took, result } = timed(() => smoothSurface(span, { kind: 'soap-film', ...surface.options }));
  return { name: surface.name, triangles: result.triangles.length / 3, off: farthest(result, surface), seconds: took };
}

await load({ parts: ['loops', 'meshes'] });
const found = { meshes: [], times: [], films: [] };
const isThere = existsSync(path.join(folder, 'truth.json'));
if (isThere) {
  const truth = JSON.parse(readFileSync(path.join(folder, 'truth.json'), 'utf8')).meshes;
  const peers = JSON.parse(readFileSync(path.join(folder, 'peers.json'), 'utf8')).meshes;
  const chosen = truth.filter(({ name, groups }) => groups.length > 0 && words.every((word) => name.includes(word)));
  console.log(kHeading);
  for (const each of chosen) {
    found.meshes.push(measure(each));
    console.log(row(found.meshes.at(-1), bestPeer(peers, each.name)));
  }
  found.peers = peers;
  if (chosen.length > 1) {
    console.log(`\n${summaryLines(found.meshes, peers).join('\n')}`);
    console.log(`\n${left('peers, as recorded', 32)}${right('groups', 9)}${right('attached', 9)}${right('wrong', 6)}${right('closed', 8)}${right('pairs', 8)}${right('median', 9)}${right('mean', 9)}${right('bunny2', 10)}`);
    console.log(peerLines(peers, chosen.map(({ name }) => name)).join('\n'));
  }
} else {
  console.log(`There are no meshes in ${folder}: only times of what is made here.`);
}
if (words.length === 0) {
  console.log(`\nProcessor time, median of ${kRuns} warm runs`);
  const time = (title, mesh, options, runs) => {
    found.times.push(told(title, mesh, timed(() => fillHoles(mesh, options), runs)));
  };
  if (isThere) {
    const bunny = readMesh('bunny2-455');
    const { seconds: finding } = timed(() => findHoles(bunny));
    console.log(`${left('bunny2-455: found and grouped', 62)}${right(seconds(finding), 9)}`);
    found.times.push({ title: 'bunny2-455: found', seconds: finding });
    time('bunny2-455: filled alone', bunny, { density: 0, fairness: 0 });
    time('bunny2-455: filled, refined and faired', bunny, {});
    const workers = await measureWorkers(bunny);
    const ratio = `${(workers.one / workers.two).toFixed(2)} ×${workers.isSame ? '' : ', NOT THE SAME'}`;
    console.log(`${left('  by one worker, by two, on the clock; ratio', 62)}${right(seconds(workers.one), 9)}${right(seconds(workers.two), 9)}   ${ratio}`);
    found.times.push({ title: 'bunny2-455: two workers', ...workers });
    const many = manyFaces(fillHoles(readMesh('bunny')).mesh, 0.9e6, 81);
    time(`${(many.faces.length / 3e6).toFixed(2)} M faces, 81 small holes: patches`, many, { output: 'patches' }, 2);
  }
  const sphere = openSphere(1000);
  const rim = findHoles(sphere).loops[0].vertices.length;
  time(`a hole of ${rim} vertices, a third of a sphere: filled alone`, sphere, { density: 0, fairness: 0 }, 2);
  time('  to 20 000 triangles, refined and faired', sphere, { maxNewVertices: 11700, density: 2 }, 2);
  console.log('\nSoap films: largest distance of free vertices from the exact surface, in radii');
  for (const surface of minimalSurfaces) {
    const film = measureFilm(surface);
    found.films.push(film);
    console.log(`${left(`${film.name}, ${film.triangles} triangles`, 53)}${right(film.off.toExponential(1), 9)}${right(seconds(film.seconds), 9)}`);
  }
}
writeFileSync(results, `${JSON.stringify(found, null, 1)}\n`);
