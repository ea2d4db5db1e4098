// Which loops bound one hole: as they were found, or as the user has said.
import type { HoleReport } from 'soapfilm';

export interface Hole {
  /** Numbers of loops, the outer rim first. */
  readonly loops: readonly number[];
  readonly why: HoleReport['groups'][number]['why'];
  readonly isOpenRim: boolean;
  /** How many vertices its rims have together. */
  readonly vertices: number;
  readonly length: number;
}

/** The holes by the report, but for the loops of which `given` says what they bound. In the order of their first loops. */
export function holesOf({ loops, groups }: HoleReport, given: readonly (readonly number[])[]): Hole[] {
  const isTaken = new Set<number>();
  const said: number[][] = [];
  for (const group of given) {
    const valid = group.filter((loop) => loop < loops.length && !isTaken.has(loop));
    for (const loop of valid) isTaken.add(loop);
    if (valid.length > 0) said.push(valid);
  }
  const open = new Set(groups.flatMap((group) => (group.isOpenRim ? group.loops : [])));
  const sums = (of: readonly number[]) => ({
    vertices: of.reduce((sum, loop) => sum + loops[loop].vertices.length, 0),
    length: of.reduce((sum, loop) => sum + loops[loop].length, 0),
  });
  const found = groups.flatMap(({ loops: of, why, isOpenRim }): Hole[] => {
    const rest = of.filter((loop) => !isTaken.has(loop));
    if (rest.length === 0) return [];
    return [{ loops: rest, why: rest.length === of.length ? why : 'given', isOpenRim, ...sums(rest) }];
  });
  const others = said.map((of): Hole => ({ loops: of, why: 'given', isOpenRim: of.every((loop) => open.has(loop)), ...sums(of) }));
  // Where nothing was said, the report's own order.
  const rank = new Map(groups.flatMap((group) => group.loops).map((loop, i) => [loop, i]));
  const rankOf = ({ loops: of }: Hole): number => Math.min(...of.map((loop) => rank.get(loop) ?? 0));
  return [...found, ...others].sort((a, b) => rankOf(a) - rankOf(b));
}

/** The groups that are said after a hole has been split into its loops. */
export function split(given: readonly (readonly number[])[], hole: Hole): number[][] {
  return [...without(given, hole.loops), ...hole.loops.map((loop) => [loop])];
}

/** The groups that are said after holes have been joined: the longest rim goes first. */
export function join(given: readonly (readonly number[])[], holes: readonly Hole[], { loops }: HoleReport): number[][] {
  const all = holes.flatMap((hole) => hole.loops).sort((a, b) => loops[b].length - loops[a].length);
  return [...without(given, all), all];
}

function without(given: readonly (readonly number[])[], gone: readonly number[]): number[][] {
  return given.map((group) => group.filter((loop) => !gone.includes(loop))).filter((group) => group.length > 0);
}
