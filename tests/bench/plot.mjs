// Charts as SVG text: log-log charts, histograms, and triangulated surfaces seen from a direction.
// Colours are classes, so that one file reads well on light and on dark ground.

const kInks = {
  // series: light ground, dark ground
  k1: ['#5b6472', '#a9b4c2'],
  k2: ['#1f6fb4', '#6db3f2'],
  k3: ['#c8452f', '#ff8f7a'],
  k4: ['#23854f', '#67cf95'],
  k5: ['#b8720a', '#f2b44c'],
  k6: ['#7d4fa8', '#c39df0'],
};

const declare = (shade) =>
  Object.entries(kInks)
    .map(([key, inks]) => `.${key}{stroke:${inks[shade]}}.${key}f{fill:${inks[shade]}}`)
    .join('');

const kStyle = `text{font:11px system-ui,-apple-system,"Segoe UI",sans-serif;fill:#3d4654}
.t{font-size:15px;font-weight:600;fill:#161b22}
.h{font-size:12px;font-weight:600;fill:#161b22}
.n{font-weight:600;stroke:#fff;stroke-width:3;paint-order:stroke}
.e{text-anchor:end}.m{text-anchor:middle}.s{font-size:8px}
.bg{fill:#fff}.g{stroke:#e4e8ee;fill:none}.a{stroke:#aab3c0;fill:none}
.l{fill:none;stroke-width:1.8}.d{fill:none;stroke-width:1.2;stroke-dasharray:2 3}
.o{fill:none;stroke-width:1.3}.f{stroke:#2b4a6b;stroke-width:.5;stroke-linejoin:round}
.r{stroke:#e2662c;stroke-width:1.8;stroke-linecap:round}${declare(0)}
@media(prefers-color-scheme:dark){
text{fill:#b3bcc8}.t,.h{fill:#eef2f7}.bg{fill:#12161c}.n{stroke:#12161c}
.g{stroke:#272e38}.a{stroke:#5a6572}${declare(1)}}`;

const one = (value) => String(Math.round(10 * value) / 10);
const escaped = (text) => String(text).replace(/&/g, '&amp;').replace(/</g, '&lt;');

export const text = (x, y, content, css = '') =>
  `<text x="${one(x)}" y="${one(y)}"${css && ` class="${css}"`}>${escaped(content)}</text>`;

const path = (points, css) =>
  `<path class="${css}" d="M${points.map(([x, y]) => `${one(x)},${one(y)}`).join('L')}"/>`;

const bar = (ink, x, y, width, height) =>
  `<rect class="b ${ink}f" x="${one(x)}" y="${one(y)}" width="${one(width)}" height="${one(height)}"/>`;

/** The whole drawing. `parts` are SVG text; the title is drawn, and told to screen readers. */
export function drawing(width, height, title, parts) {
  const size = `width="${width}" height="${height}" viewBox="0 0 ${width} ${height}"`;
  const label = escaped(title).replace(/"/g, '&quot;');
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" ${size} role="img" aria-label="${label}">`,
    `<style>${kStyle}</style>`,
    `<rect class="bg" width="${width}" height="${height}" rx="8"/>`,
    text(20, 28, title, 't'),
    ...parts,
    '</svg>\n',
  ].join('\n');
}

/** 1, 2 and 5 times powers of ten inside a range; powers alone where that is enough. */
function logTicks(low, high) {
  const ticks = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); e++) {
    for (const m of [1, 2, 5]) ticks.push({ value: m * 10 ** e, isPower: m === 1 });
  }
  const inside = ticks.filter(({ value }) => value >= low * 0.999 && value <= high * 1.001);
  const powers = inside.filter(({ isPower }) => isPower);
  return (powers.length >= 3 ? powers : inside).map(({ value }) => value);
}

function logScale(values, from, to) {
  const [low, high] = [Math.min(...values), Math.max(...values)].map(Math.log);
  const room = 0.05 * Math.max(high - low, 0.5);
  const [a, b] = [low - room, high + room];
  const at = (value) => from + ((Math.log(value) - a) / (b - a)) * (to - from);
  return { at, ticks: logTicks(Math.exp(a), Math.exp(b)) };
}

/** Pushes labels apart until none is nearer than `gap` to the next. */
function spread(labels, gap) {
  labels.sort((p, q) => p.y - q.y);
  for (let round = 0; round < 50; round++) {
    for (let i = 1; i < labels.length; i++) {
      const lack = gap - (labels[i].y - labels[i - 1].y);
      if (lack <= 0) continue;
      labels[i - 1].y -= lack / 2;
      labels[i].y += lack / 2;
    }
  }
  return labels;
}

const kMarks = {
  /** Measured: line and dots. */
  line: (points, ink) =>
    path(points, `l ${ink}`) +
    points.map(([x, y]) => `<circle class="${ink}f" cx="${one(x)}" cy="${one(y)}" r="2.6"/>`).join(''),
  /** Beside it: a dotted line. */
  dotted: (points, ink) => path(points, `d ${ink}`),
  /** Somebody else's: diamonds. */
  diamond: (points, ink) =>
    points
      .map(([x, y]) => `<path class="o ${ink}" d="M${one(x)},${one(y - 4)}l4,4l-4,4l-4,-4z"/>`)
      .join(''),
};

/**
 * A log-log chart in the rectangle [x, x + width] × [y, y + height], its axes' labels inside.
 *   series  { points: [[n, value]…], ink: 'k1'…'k6', mark: 'line' | 'dotted' | 'diamond', label? }
 *   label   stands right of the chart, at the height of the last point; { text, exponent } writes
 *           text n^exponent
 */
export function logLog({ x, y, width, height, title, xLabel, format, series }) {
  const drawn = series.filter(({ points }) => points.length > 0);
  if (drawn.length === 0) return text(x, y + 20, `${title}: nothing measured`, 'h');
  const [left, right, top, bottom] = [x + 52, x + width - 58, y + 22, y + height - 34];
  const across = logScale(drawn.flatMap(({ points }) => points.map((p) => p[0])), left, right);
  const up = logScale(drawn.flatMap(({ points }) => points.map((p) => p[1])), bottom, top);
  const parts = [text(left, y + 10, title, 'h')];
  for (const tick of up.ticks) {
    const at = up.at(tick);
    parts.push(path([[left, at], [right, at]], 'g'), text(left - 6, at + 4, format(tick), 'e'));
  }
  for (const tick of across.ticks) {
    const at = across.at(tick);
    parts.push(path([[at, bottom], [at, top]], 'g'), text(at, bottom + 15, count(tick), 'm'));
  }
  parts.push(path([[left, top], [left, bottom], [right, bottom]], 'a'));
  parts.push(text((left + right) / 2, bottom + 30, xLabel, 'm'));
  const curves = drawn.map(({ points, ...curve }) => ({
    ...curve,
    placed: [...points]
      .sort((p, q) => p[0] - q[0])
      .map(([n, value]) => [across.at(n), up.at(value)]),
  }));
  const labels = curves
    .filter(({ label }) => label)
    .map(({ placed, ink, label }) => ({ end: placed.at(-1), y: placed.at(-1)[1] + 4, ink, ...label }));
  for (const { end, y: at } of spread(labels, 13)) {
    if (end[0] < right - 16) parts.push(path([[end[0] + 5, end[1]], [right + 2, at - 4]], 'a'));
  }
  for (const { placed, ink, mark } of curves) parts.push(kMarks[mark](placed, ink));
  for (const label of labels) parts.push(endLabel({ ...label, x: right + 7 }));
  return parts.join('\n');
}

function endLabel({ x, y, ink, text: words, exponent }) {
  const raised = exponent === undefined ? '' : `<tspan class="s" dy="-4">${exponent.toFixed(1)}</tspan>`;
  const content = `${escaped(words)}${raised && `n${raised}`}`;
  return `<text x="${one(x)}" y="${one(y)}" class="n ${ink}f">${content}</text>`;
}

/** A number of things: 2 000, 10k, 1M. */
export function count(value) {
  if (value >= 1e6) return `${value / 1e6}M`;
  if (value >= 10_000) return `${value / 1000}k`;
  return String(value);
}

/**
 * Histograms of several sets of values side by side, over the same bins.
 *   sets  { values, ink }; edges: bin limits; what lies outside counts in the first or last bin
 */
export function histogram({ x, y, width, height, title, xLabel, edges, format, sets }) {
  const [left, right, top, bottom] = [x + 40, x + width - 12, y + 22, y + height - 34];
  const bins = edges.length - 1;
  const counts = sets.map(({ values }) => {
    const found = new Array(bins).fill(0);
    for (const value of values) {
      const bin = edges.findIndex((edge) => value < edge) - 1;
      found[value >= edges[bins] ? bins - 1 : Math.max(0, bin)] += 1;
    }
    return found;
  });
  const step = Math.max(...counts.flat()) > 50 ? 20 : 10;
  const most = step * Math.ceil((Math.max(...counts.flat()) + 1) / step);
  const up = (value) => bottom - (value / most) * (bottom - top);
  const bin = (right - left) / bins;
  const parts = [text(left, y + 10, title, 'h')];
  for (let tick = 0; tick <= most; tick += step) {
    parts.push(path([[left, up(tick)], [right, up(tick)]], 'g'), text(left - 6, up(tick) + 4, tick, 'e'));
  }
  counts.forEach((found, s) => {
    const wide = (0.84 * bin) / sets.length;
    found.forEach((value, i) => {
      if (value === 0) return;
      const at = left + i * bin + 0.08 * bin + s * wide;
      parts.push(bar(sets[s].ink, at, up(value), wide - 1, bottom - up(value)));
    });
  });
  edges.forEach((edge, i) => {
    if (bins <= 8 || i % 2 === 0) parts.push(text(left + i * bin, bottom + 15, format(edge), 'm'));
  });
  parts.push(path([[left, bottom], [right, bottom]], 'a'), text((left + right) / 2, bottom + 30, xLabel, 'm'));
  return parts.join('\n');
}

/** A row of what the marks mean: { ink, mark or 'bar', text }. */
export function legend(x, y, entries) {
  const parts = [];
  for (const { ink, mark, text: words } of entries) {
    if (mark === 'bar') parts.push(bar(ink, x, y - 9, 12, 10));
    else if (mark === 'diamond') parts.push(kMarks.diamond([[x + 8, y - 4]], ink));
    else parts.push(path([[x, y - 4], [x + 18, y - 4]], `${mark === 'dotted' ? 'd' : 'l'} ${ink}`));
    parts.push(text(x + 24, y, words));
    x += 24 + 6.2 * words.length + 18;
  }
  return parts.join('\n');
}

const subtract = (a, b) => a.map((value, i) => value - b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = ([a, b, c], [p, q, r]) => [b * r - c * q, c * p - a * r, a * q - b * p];
const unit = (a) => a.map((value) => value / Math.hypot(...a));

const kShadow = [48, 92, 140];
const kLight = [173, 214, 246];
const hex = (value) => Math.round(value).toString(16).padStart(2, '0');
const shaded = (share) =>
  `#${kShadow.map((dark, i) => hex(dark + share * (kLight[i] - dark))).join('')}`;

const edgesOf = ([a, b, c]) => [[a, b], [b, c], [c, a]];
const edgeKey = ([a, b]) => `${Math.min(a, b)},${Math.max(a, b)}`;
const triples = (array) =>
  Array.from({ length: array.length / 3 }, (_, i) => [...array.subarray(3 * i, 3 * i + 3)]);

/** A surface in a square of side `size`, seen from direction `from`, far triangles first. */
export function surface({ positions, triangles }, { x, y, size, from }) {
  const eye = unit(from);
  const side = unit(cross([0, 0, 1], eye));
  const upward = cross(eye, side);
  const points = triples(positions);
  const corners = triples(triangles);
  const flat = points.map((p) => [dot(p, side), -dot(p, upward), dot(p, eye)]);
  const range = (values) => [Math.min(...values), Math.max(...values)];
  const ranges = [0, 1].map((d) => range(flat.map((p) => p[d])));
  const factor = size / Math.max(...ranges.map(([low, high]) => high - low));
  const middle = ranges.map(([low, high]) => (low + high) / 2);
  const place = (p) => [x, y].map((at, d) => one(at + size / 2 + factor * (p[d] - middle[d])));
  const placed = flat.map((p) => place(p).join(','));
  const uses = new Map();
  for (const key of corners.flatMap(edgesOf).map(edgeKey)) uses.set(key, (uses.get(key) ?? 0) + 1);
  const depth = (triangle) => triangle.reduce((sum, v) => sum + flat[v][2], 0);
  const light = unit(side.map((value, i) => 0.35 * value + 0.55 * upward[i] + 0.75 * eye[i]));
  const faces = corners.sort((s, t) => depth(s) - depth(t)).map((triangle) => {
    const [a, b, c] = triangle.map((v) => points[v]);
    const share = Math.abs(dot(unit(cross(subtract(b, a), subtract(c, a))), light));
    const face = `<path d="M${triangle.map((v) => placed[v]).join('L')}z" fill="${shaded(share)}"/>`;
    const rim = edgesOf(triangle).filter((edge) => uses.get(edgeKey(edge)) === 1);
    if (rim.length === 0) return face;
    const lines = rim.map(([p, q]) => `M${placed[p]}L${placed[q]}`);
    return `${face}<path class="r" d="${lines.join('')}"/>`;
  });
  return `<g class="f">${faces.join('')}</g>`;
}
