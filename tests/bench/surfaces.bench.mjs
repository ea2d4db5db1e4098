// npm run bench -- surfaces [words…]: models of trimmed surfaces are meshed, updated, and followed by a camera. Reads
// ../shared/data/nurbs, where that is there, else only three's own surfaces are compared. Only models whose name holds all the
// words. Figures of other programs are recorded ones of the same models.
//   node surfaces.bench.mjs <folder or -> <results.json> [words…]
import { existsSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { gunzipSync } from 'node:zlib';
import { load } from 'soapfilm';
import { TrimmedModel } from 'soapfilm/surfaces';
import { Matrix4, PerspectiveCamera, Vector3, Vector4 } from 'three';
import { NURBSSurface } from 'three/addons/curves/NURBSSurface.js';
import { ParametricGeometry } from 'three/addons/geometries/ParametricGeometry.js';

const [folder, results, ...words] = process.argv.slice(2);
const kSampling = { relative: 1e-3, angle: 0.5 };
const kRuns = 9;
/** Those of which triangle counts of OCCT at that sampling are recorded, together. */
const kEight = ['brakehub', 'drilled_cylinder', 'filleted_block', 'lofted_shell', 'sphere_cut', 'teapot_trimmed', 'wavy_25_holes', 'wavy_star'];
const kTrianglesOfOcct = 40950;

const quantile = (list, share) => [...list].sort((a, b) => a - b)[Math.min(list.length - 1, Math.floor(share * list.length))];
const median = (list) => quantile(list, 0.5);
const sum = (list) => list.reduce((total, x) => total + x, 0);
const left = (text, width) => String(text).padEnd(width);
const right = (text, width) => String(text).padStart(width);

/** Median and spread of warm runs, in milliseconds of processor time, and the last result. */
function timed(run, runs = kRuns) {
  const times = [];
  let result;
  for (let i = 0; i <= runs; i++) {
    const start = process.cpuUsage();
    const since = performance.now();
    result = run();
    const { user } = process.cpuUsage(start);
    // Ticks of the processor's clock are coarse; short runs are measured by the wall's.
    if (i > 0) times.push(user < 20000 ? performance.now() - since : user / 1000);
  }
  return { ms: median(times), low: quantile(times, 0.1), high: quantile(times, 0.9), result };
}

function readModel(file) {
  const bytes = readFileSync(path.join(folder, file));
  return JSON.parse(file.endsWith('.gz') ? gunzipSync(bytes) : bytes);
}

/** Angles, areas and open edges of a mesh; what is left of faces' room does not count. */
function looked({ positions, triangles, faceStarts, same, strips, stripStarts }) {
  const edges = new Map();
  const areas = new Float64Array(faceStarts.length - 1);
  let [count, angles, thin, flat, face] = [0, 0, 0, 0, 0];
  const at = (v) => [positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]];
  const minus = (a, b) => a.map((x, k) => x - b[k]);
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  for (let i = 0; i < triangles.length; i += 3) {
    while (i / 3 >= faceStarts[face + 1]) face++;
    const corners = [triangles[i], triangles[i + 1], triangles[i + 2]];
    if (corners[0] === corners[1]) continue;
    count++;
    const [a, b, c] = corners.map(at);
    const area = Math.hypot(...cross(minus(b, a), minus(c, a))) / 2;
    areas[face] += area;
    if (!(area > 0)) flat++;
    const angle = ([p, q, r]) => Math.atan2(Math.hypot(...cross(minus(q, p), minus(r, p))), dot(minus(q, p), minus(r, p)));
    const least = (Math.min(angle([a, b, c]), angle([b, c, a]), angle([c, a, b])) * 180) / Math.PI;
    angles += least;
    if (least < 5) thin++;
    corners.forEach((corner, k) => {
      const [p, q] = [same[corner], same[corners[(k + 1) % 3]]];
      const key = p < q ? p * 2 ** 26 + q : q * 2 ** 26 + p;
      edges.set(key, (edges.get(key) ?? 0) + (p < q ? 1 : -1));
    });
  }
  return { count, angle: angles / count, thin: thin / count, flat, areas, open: [...edges.values()].filter((n) => n !== 0).length, indices: strips.length + stripStarts.length - 1, strips: stripStarts.length - 1 };
}

/** Changes one after the other of one line or one sample more, as a tolerance falls slowly: update against from scratch. */
function measureSteps(model) {
  const [kept, fresh] = [new TrimmedModel(model), new TrimmedModel(model)];
  const ratios = [];
  kept.update(kSampling);
  for (let relative = 1e-3; relative > 6e-4; relative *= 0.995) {
    const sampling = { ...kSampling, relative };
    const began = performance.now();
    const { faces } = kept.update(sampling);
    const updated = performance.now() - began;
    if (faces.length === 0) continue;
    const { ms } = timed(() => fresh.tessellate(sampling), 3);
    ratios.push(ms / updated);
  }
  kept.dispose();
  fresh.dispose();
  return ratios.length > 0 ? median(ratios) : null;
}

function measureModel(file, reference) {
  const name = file.replace(/\.json(\.gz)?$/, '');
  const json = readModel(file);
  const opening = performance.now();
  const model = new TrimmedModel(json);
  const opened = performance.now() - opening;
  const { ms, low, high, result: mesh } = timed(() => model.tessellate(kSampling), name === 'hull' ? 5 : kRuns);
  const facts = looked(mesh);
  const fine = looked(model.tessellate({ relative: 1e-4, angle: 0.2 }));
  const off = reference?.area ? Math.max(...reference.area.map((area, face) => Math.abs(fine.areas[face] / area - 1))) : null;
  model.dispose();
  return { name, faces: json.faces.length, opened, ms, low, high, ...facts, areas: undefined, off, cracks: reference?.closed ? facts.open : 0, deviation: mesh.deviation / mesh.tolerance, steps: words.length > 0 || json.faces.length < 100 ? measureSteps(json) : null };
}

/** The eight models at an aspect: triangles, angles, strips. */
function measureEight(aspect) {
  const all = kEight.map((name) => {
    const model = new TrimmedModel(readModel(`${name}.json`));
    const mesh = model.tessellate({ ...kSampling, aspect });
    model.dispose();
    return { ...looked(mesh), deviation: mesh.deviation / mesh.tolerance };
  });
  const count = sum(all.map((each) => each.count));
  const mean = (key) => sum(all.map((each) => each[key] * each.count)) / count;
  return {
    aspect: String(aspect),
    count,
    toOcct: count / kTrianglesOfOcct,
    angle: mean('angle'),
    thin: mean('thin'),
    perStrip: count / sum(all.map(({ strips }) => strips)),
    indices: sum(all.map(({ indices }) => indices)) / count,
    deviation: Math.max(...all.map(({ deviation }) => deviation)),
  };
}

/** A model on its camera's path: eight of them where `copies` says so, side by side. */
function measurePath(name, { fovY, width, height, up, frames }, copies) {
  const part = readModel(`${name}.json`);
  const spots = Array.from({ length: copies }, (_, i) => [(i % 4) - 1.5, Math.floor(i / 4) - 0.5]);
  const at = ([x, y]) => ({ part, matrix: [1, 0, 0, 40 * x, 0, 1, 0, 40 * y, 0, 0, 1, 0] });
  const model = new TrimmedModel(copies > 1 ? { instances: spots.map(at) } : part);
  const camera = new PerspectiveCamera(fovY, width / height, 0.05, 1000);
  camera.up.set(...up);
  const times = [];
  let [changed, bytes, most, cracks] = [0, 0, 0, 0];
  frames.forEach((frame, i) => {
    camera.position.set(...frame.slice(0, 3));
    camera.lookAt(new Vector3(...frame.slice(3)));
    camera.updateMatrixWorld();
    camera.updateProjectionMatrix();
    const viewProjection = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
    const began = performance.now();
    const { mesh, faces, vertexRanges, indexRanges } = model.update({ camera: { eye: frame.slice(0, 3), viewProjection, width, height, pixels: 1 } });
    const took = performance.now() - began;
    const within = (ranges) => ranges.reduce((total, end, k) => total + (k % 2 ? end : -end), 0);
    if (i > 0) {
      times.push(took);
      changed += faces.length / (mesh.faceStarts.length - 1);
      bytes += 32 * within(vertexRanges) + 4 * within(indexRanges);
    }
    if (i % 8 === 0) {
      const facts = looked(mesh);
      most = Math.max(most, facts.count);
      cracks = Math.max(cracks, facts.open);
    }
  });
  const faces = model.update({}).mesh.faceStarts.length - 1;
  model.dispose();
  const views = times.length;
  return { name: copies > 1 ? `${copies} × ${name}` : name, faces, mean: sum(times) / views, worst: Math.max(...times), changed: changed / views, bytes: bytes / views, most, cracks };
}

/** three's own NURBS, without trims, beside the same surface here: microseconds a triangle. */
function measureThree() {
  const n = 12;
  const knots = [0, 0, 0, ...Array.from({ length: n - 2 }, (_, k) => k / (n - 3)), 1, 1, 1];
  const pole = (i, j) => [i, j, Math.sin(1.3 * i) * Math.cos(0.9 * j)];
  const rows = Array.from({ length: n }, (_, i) => Array.from({ length: n }, (__, j) => new Vector4(...pole(i, j), 1)));
  const surface = new NURBSSurface(3, 3, knots, knots, rows);
  const cells = 60;
  const theirs = timed(() => new ParametricGeometry((u, v, to) => surface.getPoint(u, v, to), cells, cells));
  const poles = rows.flat().map(({ x, y, z }) => [x, y, z]);
  const model = new TrimmedModel({ faces: [{ surface: { degreeU: 3, degreeV: 3, knotsU: knots, knotsV: knots, countU: n, countV: n, poles } }], edges: [] });
  const ours = timed(() => model.tessellate({ relative: 1e-4, angle: 0.1 }));
  model.dispose();
  return { three: (1000 * theirs.ms) / (2 * cells * cells), soapfilm: (1000 * ours.ms) / (ours.result.triangles.length / 3) };
}

await load({ parts: ['surfaces'] });
const isThere = folder !== '-' && existsSync(folder);
const found = { models: [], eight: [], paths: [], three: null };
const kNoModels = ['assembly', 'cameras', 'faults', 'reference'];
if (isThere) {
  const references = JSON.parse(readFileSync(path.join(folder, 'reference.json')));
  const files = readdirSync(folder).filter((file) => /\.json(\.gz)?$/.test(file) && !kNoModels.some((no) => file.startsWith(no)) && words.every((word) => file.includes(word)));
  console.log(`${left('model', 22)}${right('faces', 6)}${right('triangles', 10)}${right('µs each', 9)}${right('10–90 %', 13)}${right('off/tol', 8)}${right('angle', 7)}${right('< 5°', 7)}${right('area', 8)}${right('cracks', 7)}${right('step', 7)}`);
  for (const file of files) {
    const m = measureModel(file, references[file.replace(/\.json(\.gz)?$/, '')]);
    found.models.push(m);
    const each = (ms) => ((1000 * ms) / m.count).toFixed(2);
    console.log(`${left(m.name, 22)}${right(m.faces, 6)}${right(m.count, 10)}${right(each(m.ms), 9)}${right(`${each(m.low)}–${each(m.high)}`, 13)}${right(m.deviation.toFixed(2), 8)}${right(m.angle.toFixed(1), 7)}${right(`${(100 * m.thin).toFixed(1)} %`, 7)}${right(m.off === null ? '' : `${(100 * m.off).toFixed(2)} %`, 8)}${right(m.cracks, 7)}${right(m.steps === null ? '' : `${m.steps.toFixed(1)} ×`, 7)}`);
  }
  const all = sum(found.models.map(({ ms }) => ms)) * 1000 / sum(found.models.map(({ count }) => count));
  console.log(`all: ${all.toFixed(2)} µs a triangle`);
  if (words.length === 0) {
    console.log('\nThe eight models against OCCT, which has 40 950 triangles, 25.7 degrees and 12 % below 5');
    for (const aspect of [3, Infinity, 2, 1.5]) {
      const e = measureEight(aspect);
      found.eight.push(e);
      console.log(`  aspect ${left(e.aspect, 9)}${right(e.count, 7)} (${e.toOcct.toFixed(2)} ×)  ${e.angle.toFixed(1)}°, ${(100 * e.thin).toFixed(1)} % below 5°, off by ${e.deviation.toFixed(2)}; ${e.perStrip.toFixed(1)} a strip, ${e.indices.toFixed(2)} indices each`);
    }
    const { paths } = JSON.parse(readFileSync(path.join(folder, 'cameras.json')));
    console.log('\nCameras, one pixel');
    for (const [name, copies] of [['brakehub', 8], ...Object.keys(paths).map((each) => [each, 1])]) {
      const p = measurePath(name, paths[name], copies);
      found.paths.push(p);
      console.log(`  ${left(p.name, 18)}${right(p.faces, 4)} faces: ${p.mean.toFixed(2)} ms, worst ${p.worst.toFixed(1)}; ${(100 * p.changed).toFixed(1)} % of faces change, ${(p.bytes / 1024).toFixed(0)} KB; at most ${p.most} triangles`);
    }
  }
} else {
  console.log(`There are no models in ${folder}.`);
}
found.three = measureThree();
console.log(`\nthree's surface without trims: ${found.three.three.toFixed(2)} µs a triangle; the same here: ${found.three.soapfilm.toFixed(2)}`);
writeFileSync(results, `${JSON.stringify(found, null, 1)}\n`);
