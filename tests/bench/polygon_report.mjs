// The measurements of polygons as text: a row a case, exponents, and what was to be reached.

const kShown = ['flooding', 'trapezoids', 'delaunay', 'verify', 'one by one', 'earcut', 'earcut, refined', 'libtess', 'tess2', 'poly2tri', 'cdt2d', 'delaunator, constrained'];
const kShort = { 'one by one': '1 by 1', 'earcut, refined': 'refined', 'delaunator, constrained': 'constr.' };

const ms = (seconds) => {
  if (seconds === undefined) return '';
  if (typeof seconds === 'string') return 'fails';
  const value = 1000 * seconds;
  return value < 100 ? value.toPrecision(3) : value.toFixed(0);
};

const line = (first, cells) => first.padEnd(24) + cells.map((cell) => cell.padStart(11)).join('');

export const kColumns = line('milliseconds', ['vertices', ...kShown.map((name) => kShort[name] ?? name)]);

export function row({ id, n, seconds, problem }) {
  if (problem) return `${id.padEnd(24)} ${problem}`;
  return line(id, [String(n), ...kShown.map((name) => ms(seconds[name]))]);
}

const kInTable = { flooding: 'soapfilm', delaunay: 'soapfilm, Delaunay', earcut: 'earcut', 'earcut, refined': 'earcut, refined', libtess: 'libtess' };

/** The README's table. */
export function polygonTable({ results }) {
  const told = (seconds) => (seconds < 1 ? `${ms(seconds)} ms` : `${seconds.toPrecision(3)} s`);
  const time = (seconds) => (typeof seconds === 'number' ? told(seconds) : '');
  const cells = ({ title, n, seconds }) => [
    title,
    String(n).replace(/\B(?=(\d{3})+$)/g, ' '),
    ...Object.keys(kInTable).map((name) => time(seconds[name])),
  ];
  const head = ['polygons', 'vertices', ...Object.values(kInTable)];
  const tableRow = (row) => `| ${row.join(' | ')} |`;
  const rows = results.filter((c) => c.title && c.seconds).map(cells);
  return [tableRow(head), `${'|---'.repeat(head.length)}|`, ...rows.map(tableRow)].join('\n');
}

/** Least squares for time = factor · n^exponent over a family's cases of 1000 vertices and more. */
function exponent(cases, name) {
  const points = cases
    .filter(({ n, seconds }) => n >= 1000 && typeof seconds?.[name] === 'number')
    .map(({ n, seconds }) => [Math.log(n), Math.log(seconds[name])]);
  if (points.length < 3) return undefined;
  const mean = (i) => points.reduce((sum, p) => sum + p[i], 0) / points.length;
  const [x, y] = [mean(0), mean(1)];
  const across = points.reduce((sum, p) => sum + (p[0] - x) * (p[1] - y), 0);
  return across / points.reduce((sum, p) => sum + (p[0] - x) ** 2, 0);
}

const families = (results) => [...new Set(results.map(({ family }) => family))];

export function exponents(results) {
  const names = ['flooding', 'trapezoids', 'delaunay', 'earcut'];
  const rows = families(results).flatMap((family) => {
    const cases = results.filter((c) => c.family === family);
    const found = names.map((name) => exponent(cases, name));
    if (found[0] === undefined) return [];
    return [line(family, found.map((value) => value?.toFixed(2) ?? ''))];
  });
  return [line('exponent from 10³ on', names), ...rows];
}

/** A goal: what, the value, the limit, and whether the value may exceed it. */
function verdict(what, value, limit, digits = 3, atLeast = false) {
  const met = atLeast ? value >= limit : value <= limit;
  const sign = atLeast ? '≥' : '≤';
  return `${what.padEnd(58)}${value.toPrecision(digits).padStart(9)}  ${sign} ${limit}  ${met ? 'met' : 'NOT MET'}`;
}

export function goals(results, sessions) {
  const lines = [];
  for (const c of results) {
    const { id, seconds, ratio, peakBytes, quality } = c;
    if (!seconds) {
      lines.push(`${id}: ${c.problem}`);
      continue;
    }
    if (ratio && typeof seconds.earcut === 'number') {
      lines.push(verdict(`${id}: time by earcut's`, seconds.flooding / seconds.earcut, ratio));
    }
    if (c.limit) lines.push(verdict(`${id}: seconds`, seconds.flooding, c.limit.seconds));
    if (c.limit?.megabytes) lines.push(verdict(`${id}: megabytes`, peakBytes / 1e6, c.limit.megabytes));
    if (typeof seconds.verify === 'number' && c.n >= 1000) {
      const more = seconds.verify / seconds.flooding - 1;
      lines.push(verdict(`${id}: certificate, by one more triangulation`, more, 1.2));
    }
    // Not where the others take what is invalid as it comes.
    if (typeof seconds['earcut, refined'] === 'number' && c.n >= 1000 && !c.repairs) {
      const share = seconds.delaunay / seconds['earcut, refined'];
      lines.push(verdict(`${id}: Delaunay, by earcut and refine`, share, 0.5));
    }
    if (quality) lines.push(...qualityGoals(id, quality));
  }
  for (const family of families(results)) {
    const value = exponent(results.filter((c) => c.family === family), 'flooding');
    if (value !== undefined) lines.push(verdict(`${family}: exponent from 10³ on`, value, 1.15));
  }
  for (const { id, share, goal } of sessions) lines.push(verdict(`${id}: times faster than anew`, share, goal, 3, true));
  return lines;
}

function qualityGoals(id, { flooding, trapezoids, delaunay, strips, earcut }) {
  const others = earcut ? `; flooding ${flooding.angle.toFixed(1)}°, earcut ${earcut.angle.toFixed(1)}°` : '';
  const hasGrid = earcut === undefined;
  return [
    verdict(`${id}: trapezoids' mean smallest angle`, trapezoids.angle, hasGrid ? 33.7 : 14.4, 3, true) +
      ` (Delaunay ${delaunay.angle.toFixed(1)}°${others})`,
    verdict(`${id}: trapezoids' largest degree, less Delaunay's`, trapezoids.degree - delaunay.degree, 2),
    verdict(`${id}: indices a triangle in strips`, strips.indices, 1.5),
    verdict(`${id}: length of strips by that of greedy ones`, strips.length / strips.greedyLength, 1.3, 3, true),
  ];
}
