// The README's table of holes, from the results of holes.bench.mjs.

const sum = (list, key) => list.reduce((total, each) => total + Number(each[key] ?? 0), 0);
const mean = (list) => list.reduce((total, x) => total + x, 0) / list.length;
const median = (list) => [...list].sort((a, b) => a - b)[Math.floor((list.length - 1) / 2)];
const time = (seconds) => (seconds < 1 ? `${(1000 * seconds).toFixed(0)} ms` : `${seconds.toFixed(2)} s`);

/** How the programs are called whose recorded figures are in the table. */
const kPeers = [
  ['meshlib_triangulateHoles_smooth', 'MeshLib 3.1, native'],
  ['cgal_fair', 'CGAL, native'],
  ['pymeshfix_repair', 'pymeshfix, native'],
];

/** @param found the results, with all meshes and times, and the recorded figures of `peers` by mesh and program */
export function holeTable({ meshes, times, films, peers }) {
  const names = meshes.map(({ name }) => name);
  const bunny = times.find(({ title }) => title === 'bunny2-455: filled, refined and faired');
  const programs = [
    {
      name: '**soapfilm**, WebAssembly',
      right: sum(meshes, 'groupsRight'),
      attached: sum(meshes, 'attached'),
      wrong: sum(meshes, 'wrongJoins'),
      closed: sum(meshes, 'isClosed'),
      of: meshes.length,
      pairs: sum(meshes, 'crossings'),
      rms: meshes.map(({ rms }) => rms),
      seconds: bunny.seconds,
    },
    ...kPeers.map(([key, name]) => {
      const own = names.flatMap((mesh) => peers[mesh]?.[key] ?? []);
      return {
        name,
        right: sum(own, 'groups_right'),
        attached: sum(own, 'attached'),
        wrong: sum(own, 'wrong_joins'),
        closed: sum(own, 'topology_right'),
        of: own.length,
        pairs: sum(own, 'si_pairs'),
        rms: own.flatMap(({ rms_pct: rms }) => rms ?? []),
        seconds: peers['bunny2-455']?.[key]?.cpu_s,
      };
    }),
  ];
  const [groups, loops] = [sum(meshes, 'groups'), sum(meshes, 'extraLoops')];
  const cells = programs.map((p) =>
    [
      p.name,
      `${p.right} of ${groups}`,
      `${p.attached} of ${loops}`,
      p.wrong,
      `${p.closed} of ${p.of}`,
      p.pairs,
      `${median(p.rms).toFixed(3)} / ${mean(p.rms).toFixed(3)} %`,
      p.seconds === undefined ? '' : time(p.seconds),
    ].join(' | '),
  );
  const curved = meshes.filter(({ rimAngleOfOriginal }) => rimAngleOfOriginal >= 0.5);
  const workers = times.find(({ title }) => title === 'bunny2-455: two workers');
  const plain = (title) => title.trim().replace('bunny2-455', 'a mesh with 446 holes').replace(/^to 20/, 'the same, to 20');
  const rows = times.filter(({ holes }) => holes !== undefined).map(({ title, seconds }) => `| ${plain(title)} | ${time(seconds)} |`);
  return [
    '| program | groups right | islands attached | wrong joins | closed as the original | pairs that intersect | RMS, median / mean | 446 holes |',
    '|---|---|---|---|---|---|---|---|',
    ...cells.map((row) => `| ${row} |`),
    '',
    `Angles along the rims are ${mean(curved.map((m) => m.rimAngle / m.rimAngleOfOriginal)).toFixed(2)} times those of the original surface, with ` +
      `${mean(meshes.map(({ triangles }) => triangles)).toFixed(2)} times the triangles that were cut away.`,
    `Two workers take ${time(workers.two)} for the 446 holes, one ${time(workers.one)}.`,
    '',
    '| | time |',
    '|---|---|',
    ...rows,
    ...films.map(({ name, triangles, off, seconds }) => `| ${name}, ${triangles} triangles: ${off.toExponential(1)} radii from the exact film | ${time(seconds)} |`),
  ].join('\n');
}
