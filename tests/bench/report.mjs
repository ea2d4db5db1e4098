// The benchmark's measurements as text: a row a case, fitted exponents, goals, and the README's table.

/** Series are fitted over cases that take at least this long: below, calls and not work are measured. */
const kLeastFitted = 0.5e-3;

export const quantile = (values, share) => {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
};

/** By then the engine has compiled what matters. */
const kWarmUp = 0.3;

/** The runs that begin after the time of warming up; but the first, as many as three are kept anyway. */
function warmRuns(seconds) {
  let spent = 0;
  const isWarm = seconds.map((s) => {
    spent += s;
    return spent - s >= kWarmUp;
  });
  const kept = seconds.filter((_, i) => i > 0 && (isWarm[i] || i >= seconds.length - 3));
  return kept.length > 0 ? kept : seconds;
}

/** Median and relative interquartile range of the warm runs, and the first run apart. */
export function summary({ seconds, ...found }) {
  if (found.problem) return found;
  const runs = warmRuns(seconds);
  const median = quantile(runs, 0.5);
  const spread = runs.length < 3 ? null : (quantile(runs, 0.75) - quantile(runs, 0.25)) / median;
  return { first: seconds[0], ...found, median, spread, runs: seconds.length };
}

/** Least squares for y = factor · n^exponent on logarithms; null for fewer than three points. */
export function fitPower(points) {
  if (points.length < 3) return null;
  const logs = points.map(([n, y]) => [Math.log(n), Math.log(y)]);
  const mean = (i) => logs.reduce((sum, p) => sum + p[i], 0) / logs.length;
  const [x, y] = [mean(0), mean(1)];
  const across = logs.reduce((sum, p) => sum + (p[0] - x) * (p[1] - y), 0);
  const along = logs.reduce((sum, p) => sum + (p[0] - x) ** 2, 0);
  if (along === 0) return null;
  const exponent = across / along;
  return { exponent, factor: Math.exp(y - exponent * x) };
}

/** Exponents of time and memory over the number of vertices, for every series of three sizes or more. */
export function fitSeries(cases) {
  const done = cases.filter((c) => c.series !== null && c.wasm?.median >= kLeastFitted);
  return [...new Set(done.map((c) => c.series))].flatMap((series) => {
    const rows = done.filter((c) => c.series === series);
    const fit = (value) => fitPower(rows.map((c) => [c.n, value(c)]));
    const time = fit((c) => c.wasm.median);
    if (!time || new Set(rows.map((c) => c.n)).size < 3) return [];
    const sizes = rows.map((c) => c.n);
    return {
      series,
      from: Math.min(...sizes),
      to: Math.max(...sizes),
      time: time.exponent,
      memory: fit((c) => c.wasm.peakBytes)?.exponent ?? null,
    };
  });
}

export function time(seconds) {
  if (seconds < 0.01) return `${(1000 * seconds).toFixed(2)} ms`;
  if (seconds < 0.1) return `${(1000 * seconds).toFixed(1)} ms`;
  if (seconds < 1) return `${(1000 * seconds).toFixed(0)} ms`;
  return `${seconds.toPrecision(3)} s`;
}

export function memory(bytes) {
  const megabytes = bytes / 1e6;
  return `${megabytes < 100 ? megabytes.toFixed(1) : megabytes.toFixed(0)} MB`;
}

const percent = (share) => (share === null ? '' : `±${(100 * share).toFixed(0)}%`);
const left = (text, width) => String(text).padEnd(width);
const right = (text, width) => String(text ?? '').padStart(width);

const kCaseWidth = 42;

export const kHeading = [
  left('case', kCaseWidth),
  right('native', 9),
  right('±', 5),
  right('wasm', 9),
  right('±', 5),
  right('ratio', 6),
  right('first', 9),
  right('peak', 9),
  right('heap', 9),
  right('domains', 10),
  '  cost',
].join(' ');

/** One case: medians, their ratio, the first run in WebAssembly, the solver's peak and the whole heap. */
export function row(c) {
  const { native, wasm } = c;
  const side = (s) =>
    s?.median === undefined
      ? [right(s?.problem ?? '–', 9), right('', 5)]
      : [right(time(s.median), 9), right(percent(s.spread), 5)];
  const ratio = native?.median && wasm?.median ? (wasm.median / native.median).toFixed(2) : '';
  const cells = [left(c.id, kCaseWidth), ...side(native), ...side(wasm), right(ratio, 6)];
  const found = wasm?.median ? wasm : native?.median ? native : undefined;
  if (!found) return cells.join(' ');
  cells.push(
    right(wasm?.median ? time(wasm.first) : '', 9),
    right(memory(found.peakBytes), 9),
    right(wasm?.median ? memory(wasm.processBytes) : '', 9),
    right(found.domains, 10),
    `  ${answer(found)}`,
  );
  if (disagreement(c)) cells.push(`  NATIVE AND WASM DIFFER: ${native.cost}`);
  return cells.join(' ').trimEnd();
}

function answer(found) {
  if (!found.found) return `none in ${found.space}`;
  const cost = Number(found.cost.toPrecision(9));
  if (found.optimal) return String(cost);
  const gap = (100 * (found.cost - found.lowerBound)) / found.cost;
  return `${cost}, gap ${gap.toFixed(2)} %`;
}

/** Whether the two sides found different costs, where both were to find the optimum. Rounding differs. */
export function disagreement({ native, wasm, bestSoFar }) {
  if (bestSoFar || !native?.median || !wasm?.median) return false;
  if (native.found !== wasm.found) return true;
  return Math.abs(native.cost - wasm.cost) > 1e-10 * Math.abs(native.cost);
}

export function fitLines(fits) {
  const lines = fits.map(({ series, from, to, time: t, memory: m }) => {
    const cells = [left(series, kCaseWidth), right(t.toFixed(2), 6), right(m?.toFixed(2), 8)];
    return `${cells.join(' ')}   n = ${from} to ${to}`;
  });
  const heading = [left('growth with n, WebAssembly', kCaseWidth), right('time', 6), right('memory', 8)];
  return [heading.join(' '), ...lines];
}

const verdict = (isMet) => (isMet ? 'met' : 'NOT MET');

/** What was to be reached, the measured WebAssembly figure beside it. */
export function goalLines(cases) {
  const lines = cases
    .filter((c) => c.goal && c.wasm)
    .map(({ id, goal, wasm }) => {
      const isMet = wasm.median <= goal.seconds;
      const fits = wasm.peakBytes <= 1e6 * goal.megabytes;
      return [
        left(id, kCaseWidth),
        right(wasm.median === undefined ? wasm.problem : time(wasm.median), 9),
        right(`≤ ${time(goal.seconds)}`, 11),
        left(verdict(isMet), 8),
        right(wasm.median === undefined ? '' : memory(wasm.peakBytes), 9),
        right(`≤ ${goal.megabytes} MB`, 9),
        wasm.median === undefined ? '' : verdict(fits),
      ]
        .join(' ')
        .trimEnd();
    });
  return lines.length === 0 ? [] : ['To reach', ...lines];
}

const kDragGoal = 0.03;

/** The interactive case: most round trips have to be short, not half of them. */
export function dragLines({ vertices, candidates, seconds }) {
  const [median, most, worst] = [0.5, 0.95, 1].map((share) => quantile(seconds, share));
  const goal = `≤ ${time(kDragGoal)}: ${verdict(most <= kDragGoal)}`;
  return [
    `Dragging a vertex of ${vertices}, ${candidates} Delaunay candidates: round trips through the worker,`,
    `${seconds.length} of them: median ${time(median)}, 95 % within ${time(most)} (${goal}),`,
    `longest ${time(worst)}, first ${time(seconds[0])}`,
  ];
}

const kTransferGoal = 0.008;
/** Calls until the engine has compiled what matters: too short a work for `kWarmUp`. */
const kTransferWarmUp = 10;

/** How long a caller is held up while loops go to a worker, form by form. */
export function transferLines({ vertices, seconds }) {
  const warm = (form) => seconds[form].slice(kTransferWarmUp);
  const rows = Object.keys(seconds).map((form) => {
    const [least, median, most] = [0.05, 0.5, 0.95].map((share) => time(quantile(warm(form), share)));
    return `  ${left(form, 24)} median ${median}, 5 % to 95 % ${least} to ${most}, first ${time(seconds[form][0])}`;
  });
  const isMet = quantile(warm('arrays of numbers'), 0.5) <= kTransferGoal;
  return [
    `The caller's time until ${vertices} vertices are on their way to a worker:`,
    ...rows,
    `  goal for arrays of numbers: ≤ ${time(kTransferGoal)}: ${verdict(isMet)}`,
  ];
}

/** Optimality of a row of the suite of figure 9 in a smaller space; null where it holds no surface. */
export function optimality({ weight, interiorEdges, all, ...spaces }, space) {
  const { cost } = spaces[space];
  if (cost === null) return null;
  if (weight === 'area') return all.cost / cost;
  return ((cost - all.cost) * 180) / Math.PI / interiorEdges;
}

export function optimalityLines(suites) {
  const words = ['least', '5 %', 'median', '95 %', 'most', 'none'].map((word) => right(word, 8));
  const lines = [`${left('optimality against all triples', kCaseWidth)} ${words.join('')}`];
  for (const [kind, rows] of Object.entries(suites)) {
    for (const weight of ['area', 'dihedral']) {
      const chosen = rows.filter((r) => r.weight === weight);
      for (const space of ['delaunay', 'near']) {
        const values = chosen.map((r) => optimality(r, space)).filter((v) => v !== null);
        const shares = values.length > 0 ? [0, 0.05, 0.5, 0.95, 1] : [];
        const shown = shares.map((share) => quantile(values, share).toFixed(3));
        const cells = [...shown, chosen.length - values.length].map((cell) => right(cell, 8));
        const unit = weight === 'area' ? 'ratio' : '° an edge';
        lines.push(`${left(`${kind} ${weight} (${unit}) ${space}`, kCaseWidth)} ${cells.join('')}`);
      }
    }
  }
  return lines;
}

const kNearGoal = { ratio: 1.02, share: 0.95, time: 0.05 };

/** The `near` space against all triples on noisy loops: costs, and the time of all of them together. */
export function nearLines(suites) {
  const words = ['loops', '≤ 1.02', '95 %', 'most', 'time'].map((word) => right(word, 8));
  const lines = [`${left('near against all triples', kCaseWidth)} ${words.join('')}`];
  const sum = (rows, space) => rows.reduce((total, r) => total + r[space].seconds, 0);
  const { single, pairs, 'larger pairs': larger } = suites;
  const shown = { single, 'all pairs': [...pairs, ...larger], pairs, 'larger pairs': larger };
  for (const [kind, rows] of Object.entries(shown)) {
    for (const weight of [...new Set(rows.map((r) => r.weight))]) {
      const chosen = rows.filter((r) => r.weight === weight);
      const ratios = chosen.map(({ near, all }) => (near.cost ?? Infinity) / all.cost);
      const good = ratios.filter((ratio) => ratio <= kNearGoal.ratio).length / ratios.length;
      const spent = sum(chosen, 'near') / sum(chosen, 'all');
      const percent = (value) => `${(100 * value).toFixed(1)} %`;
      const [most, all] = [0.95, 1].map((share) => quantile(ratios, share).toFixed(4));
      const cells = [chosen.length, percent(good), most, all, percent(spent)];
      const isMet = good >= kNearGoal.share && spent <= kNearGoal.time;
      const line = cells.map((cell) => right(cell, 8)).join('');
      // The goal is for pairs of all sizes: small ones take little time either way.
      const isPart = rows === pairs || rows === larger;
      lines.push(`${left(`${kind} ${weight}`, kCaseWidth)} ${line}${isPart ? '' : `  ${verdict(isMet)}`}`);
    }
  }
  return lines;
}

/** What is spanned and how, as the first cells of a row in Markdown. */
function described({ k, n, space, objective, weights }) {
  const size = Number.isInteger(n / k) ? `${k} × ${grouped(n / k)}` : `${k}, ${n} in all`;
  const kinds = ['area', 'perimeter', 'dihedral'].filter((_, i) => weights?.[i] > 0);
  const weight = weights === null ? 'default' : objective === 'sum' ? kinds.join(', ') : 'worst dihedral';
  return [size, { all: 'all triples', delaunay: 'Delaunay' }[space] ?? space, weight];
}

const grouped = (n) => String(n).replace(/\B(?=(\d{3})+$)/g, ' ');

function reached({ median, peakBytes, found, optimal, cost, lowerBound, problem }) {
  if (problem) return problem;
  if (!found) return `none, ${time(median)}`;
  const gap = `${((100 * (cost - lowerBound)) / cost).toFixed(1)} %`;
  return `${time(median)}, ${memory(peakBytes)}${optimal ? '' : `, proven to within ${gap}`}`;
}

/** Below this the authors' program shows how long it takes to start, and not more. */
const kLeastOfAuthors = 0.15;

/** The README's table: inputs on which the authors' program was measured, then others of other sizes. */
export function readmeTable({ cases, drag }) {
  const against = cases.filter((c) => c.authors?.seconds >= kLeastOfAuthors);
  const isOther = (c) => c.bestSoFar || (c.goal && !c.authors);
  const rows = new Map();
  for (const c of [...against, ...cases.filter(isOther)]) {
    const what = described(c).join(' | ');
    const theirs = c.authors ? `${time(c.authors.seconds)}, ${c.authors.megabytes.toFixed(0)} MB` : '';
    // Of one kind the committed input, or the first.
    if (rows.has(what) && (c.series !== null || rows.get(what).theirs)) continue;
    rows.set(what, { ours: reached(c.wasm), theirs });
  }
  const lines = [
    "| curves × vertices | candidates | least | soapfilm, WebAssembly | the paper authors' program, native |",
    '|---|---|---|---|---|',
    ...[...rows].map(([what, { ours, theirs }]) => `| ${what} | ${ours} | ${theirs} |`),
  ];
  const poses = poseTimes(cases);
  if (poses.length > 0) lines.push('', `Poses matter: at random ones ${poses.join(', ')}.`);
  if (drag) {
    const [median, most] = [0.5, 0.95].map((share) => time(quantile(drag.seconds, share)));
    lines.push(
      '',
      `Dragging one vertex of two curves of 40, Delaunay candidates: a round trip through the worker takes`,
      `${median}, 95 % of them at most ${most}.`,
    );
  }
  return lines.join('\n');
}

/** Times of generated saddles of the sizes of committed ones in Delaunay space, which are others. */
function poseTimes(cases) {
  return ['2x100', '2x250', '3x60', '6x10'].flatMap((size) => {
    const chosen = cases.filter((c) => c.id.startsWith('saddles') && c.id.includes(` ${size} delaunay`));
    const told = chosen
      .map(({ wasm }) => wasm)
      .sort((a, b) => (a.median ?? Infinity) - (b.median ?? Infinity))
      .map(({ median, problem }) => problem ?? time(median));
    if (told.length === 0) return [];
    const range = told.length > 1 ? `${told[0]} to ${told.at(-1)}` : told[0];
    return [`${size.replace('x', ' × ')} take ${range}`];
  });
}
