// The README's tables of surfaces, from the results of surfaces.bench.mjs.

const sum = (list) => list.reduce((total, x) => total + x, 0);
const median = (list) => [...list].sort((a, b) => a - b)[Math.floor((list.length - 1) / 2)];

/** The paper's table 1, as printed: patches, time first and of updates in ms, smallest angle, of its own program. */
const kPaper = [
  ['the paper: Brakehub', 560, 33, 14, 33.5],
  ['the paper: Torpedo', 1201, 62, 28, 34.2],
  ['the paper: Pivot', 4101, 68, 38, 31.1],
  ['the paper: TorpRoom', 17032, 143, 81, 25.3],
];

/** @param found the results, of all models */
export function surfaceTable({ models, eight, paths, three }) {
  const total = (1000 * sum(models.map(({ ms }) => ms))) / sum(models.map(({ count }) => count));
  const hull = models.find(({ name }) => name === 'hull');
  const row = (cells) => `| ${cells.join(' | ')} |`;
  const first = (name) => models.find((model) => name.endsWith(model.name));
  return [
    row(['model', 'faces', 'triangles', 'µs a triangle', 'largest distance / tolerance', 'mean smallest angle', 'one line or sample more: from scratch / update']),
    row(Array(7).fill('---')),
    ...models.map((m) =>
      row([
        m.name.replaceAll('_', ' '),
        m.faces,
        m.count.toLocaleString('en'),
        ((1000 * m.ms) / m.count).toFixed(2),
        m.deviation.toFixed(2),
        `${m.angle.toFixed(1)}°`,
        m.steps === null ? '' : `${m.steps.toFixed(1)} ×`,
      ]),
    ),
    '',
    `All of these take ${total.toFixed(2)} µs a triangle, a patch of the hull ${((1000 * hull.ms) / hull.faces).toFixed(1)} µs; three's own surface, without trims, ` +
      `${three.three.toFixed(2)} µs a triangle, the same surface here ${three.soapfilm.toFixed(2)} µs. One line or sample more is ` +
      `${median(models.flatMap(({ steps }) => steps ?? [])).toFixed(1)} times as fast as all anew, in the median of models.`,
    '',
    row(['eight of these models', 'triangles', 'to OCCT', 'mean smallest angle', 'below 5°', 'triangles a strip', 'indices a triangle']),
    row(Array(7).fill('---')),
    ...eight.map((e) =>
      row([`aspect ${e.aspect}`, e.count.toLocaleString('en'), `${e.toOcct.toFixed(2)} ×`, `${e.angle.toFixed(1)}°`, `${(100 * e.thin).toFixed(1)} %`, e.perStrip.toFixed(1), e.indices.toFixed(2)]),
    ),
    row(['OCCT, as recorded', '40,950', '1 ×', '25.7°', '12 %', '', '']),
    '',
    'A camera on its path, one pixel, 1920 × 1080; and the columns of the paper’s table 1, on a processor of its time.',
    '',
    row(['model', 'patches or faces', 'first', 'later frames, mean', 'worst', 'smallest angle', 'faces that change']),
    row(Array(7).fill('---')),
    ...paths.map((p) => {
      const own = first(p.name);
      return row([p.name.replaceAll('_', ' '), p.faces, own ? `${(own.ms * (p.faces / own.faces)).toFixed(1)} ms` : '', `${p.mean.toFixed(1)} ms`, `${p.worst.toFixed(0)} ms`, own ? `${own.angle.toFixed(1)}°` : '', `${(100 * p.changed).toFixed(0)} %`]);
    }),
    ...kPaper.map(([name, patches, time, later, angle]) => row([name, patches, `${time} ms`, `${later} ms`, '', `${angle}°`, ''])),
  ].join('\n');
}
