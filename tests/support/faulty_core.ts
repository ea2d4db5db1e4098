// A stand-in for loops.wasm, and for the sessions of polygons.wasm, that misbehaves on request, to see how
// the library takes it.
import wabt from 'wabt';

/** What a call does; passed as the area weight, or to a session as the x of a vertex. */
export const Fault = {
  none: 1,
  trap: 2,
  recurseForever: 3,
  /** Reports falling progress until told to stop, then says that it was stopped. */
  runUntilStopped: 4,
  /** Runs for ever without asking. */
  hang: 5,
  unknownStatus: 6,
  /** Status 6 for loop 1, vertex 2 and loop 3, vertex 4. */
  repeatedVertex: 7,
  exit: 8,
  exhaustMemory: 9,
  /** Hands back a result although it was told to stop. */
  ignoreStop: 10,
  /** Succeeds, but leaves 512 MiB of memory behind. */
  growMemory: 11,
  stopUnasked: 12,
  /** Status 5 for loop 1, without a vertex. */
  tooFewVertices: 13,
  /** Succeeds, but traps when its result is to be freed. */
  trapWhenFreed: 14,
  /** Hands over a result on the way, and succeeds without asking whether to go on. */
  resultThenDone: 15,
  /** The same, but traps when that result is read. */
  trapWhenRead: 16,
} as const;

const when = (fault: number, body: string): string =>
  `(if (i32.eq (local.get $fault) (i32.const ${fault})) (then ${body}))`;
/** The faults that a session can be asked for by a number. */
const misbehave = (x: string): string => `
    (if (f64.eq ${x} (f64.const ${Fault.trap})) (then (unreachable)))
    (if (f64.eq ${x} (f64.const ${Fault.hang})) (then (loop $forever (br $forever))))`;
const where = (...values: number[]): string =>
  values
    .map((v, i) => `(i32.store offset=${4 * i} (local.get $where) (i32.const ${v}))`)
    .join(' ');
const callProgressUntilStopped = `
  (local.set $fraction (f64.const 0.9))
  (loop $again
    (local.set $fraction (f64.mul (local.get $fraction) (f64.const 0.999)))
    (br_if $again (call $progress (local.get $fraction) (f64.const inf) (f64.const 0.5))))`;

/** Where results are, each array 256 bytes after the one before. */
const kSpan = 208896;
const kOpened = 212992;
const kEdit = 217088;
const kState = 221184;
const kNumbers = kSpan + 5 * 256;

const lengths = (...known: readonly [result: number, array: number, length: number][]): string =>
  known
    .map(
      ([result, array, length]) => `
    (if (i32.and (i32.eq (local.get 0) (i32.const ${result})) (i32.eq (local.get 1) (i32.const ${array})))
      (then (return (i32.const ${length}))))`,
    )
    .join('');
const handBack = (result: number): string => `(call $hold (i32.const 1))
    (i32.store (local.get $result) (i32.const ${result}))
    (i32.const 0)`;

// In a span the cost is the number of calls of this instance, and the lower bound the number of blocks and
// results that were not freed before this call. What a session reads as positions is how many sessions its
// instance holds, and again what was not freed.
const kText = `(module
  (import "env" "sf_host_progress" (func $progress (param f64 f64 f64) (result i32)))
  (import "env" "sf_host_result" (func $hear (param i32)))
  (import "env" "emscripten_notify_memory_growth" (func $grown (param i32)))
  (import "wasi_snapshot_preview1" "proc_exit" (func $exit (param i32)))
  (memory (export "memory") 4 16384)
  (global $calls (mut i32) (i32.const 0))
  (global $held (mut i32) (i32.const 0))
  (global $sessions (mut i32) (i32.const 0))
  (global $trapWhenFreed (mut i32) (i32.const 0))
  (global $trapWhenRead (mut i32) (i32.const 0))
  (func $hold (param i32) (global.set $held (i32.add (global.get $held) (local.get 0))))
  (func (export "_initialize"))
  (func (export "sf_alloc") (param i32) (result i32)
    (if (i32.gt_u (local.get 0) (i32.const 200000)) (then (return (i32.const 0))))
    (call $hold (i32.const 1))
    (i32.const 2048))
  (func (export "sf_free") (param i32) (call $hold (i32.const -1)))
  (func (export "sf_result_data") (param i32 i32) (result i32)
    (i32.add (local.get 0) (i32.mul (local.get 1) (i32.const 256))))
  (func (export "sf_result_length") (param i32 i32) (result i32)
    (if (global.get $trapWhenRead) (then (unreachable)))
    ${lengths([kSpan, 5, 14], [kOpened, 0, 1], [kOpened, 1, 3], [kEdit, 0, 7], [kState, 0, 2], [kState, 4, 1])}
    (i32.const 0))
  (func (export "sf_result_free") (param i32)
    (if (global.get $trapWhenFreed) (then (unreachable)))
    (call $hold (i32.const -1)))
  (func $recurse (param i32) (result i32)
    (i32.add (i32.const 1) (call $recurse (i32.add (local.get 0) (i32.const 1)))))
  (func (export "sf_span_loops")
    (param i32 i32 i32 i32 i32 i32 i32 i32 i32) (param $settings i32)
    (param $where i32) (param $result i32) (result i32)
    (local $fault i32) (local $fraction f64)
    (local.set $fault (i32.trunc_f64_s (f64.load (local.get $settings))))
    (global.set $calls (i32.add (global.get $calls) (i32.const 1)))
    ${when(Fault.trap, '(unreachable)')}
    ${when(Fault.recurseForever, '(return (call $recurse (i32.const 0)))')}
    ${when(Fault.runUntilStopped, `${callProgressUntilStopped} (return (i32.const 13))`)}
    ${when(Fault.hang, '(loop $forever (br $forever))')}
    ${when(Fault.unknownStatus, '(return (i32.const 99))')}
    ${when(Fault.repeatedVertex, `${where(1, 2, 3, 4)} (return (i32.const 6))`)}
    ${when(Fault.exit, '(call $exit (i32.const 7))')}
    ${when(
      Fault.exhaustMemory,
      `(loop $more (br_if $more (i32.ge_s (memory.grow (i32.const 1024)) (i32.const 0))))
       (unreachable)`,
    )}
    ${when(Fault.ignoreStop, callProgressUntilStopped)}
    ${when(
      Fault.growMemory,
      '(drop (memory.grow (i32.const 8192))) (call $grown (i32.const 0))',
    )}
    ${when(Fault.stopUnasked, '(return (i32.const 13))')}
    ${when(Fault.tooFewVertices, `${where(1)} (return (i32.const 5))`)}
    ${when(Fault.trapWhenFreed, '(global.set $trapWhenFreed (i32.const 1))')}
    ${when(Fault.resultThenDone, `(call $hear (i32.const ${kSpan}))`)}
    ${when(
      Fault.trapWhenRead,
      `(global.set $trapWhenRead (i32.const 1))
       (call $hear (i32.const ${kSpan}))
       (global.set $trapWhenRead (i32.const 0))`,
    )}
    (f64.store offset=${kNumbers} (i32.const 0) (f64.const 1))
    (f64.store offset=${kNumbers + 8} (i32.const 0) (f64.const 1))
    (f64.store offset=${kNumbers + 16} (i32.const 0) (f64.convert_i32_s (global.get $calls)))
    (f64.store offset=${kNumbers + 24} (i32.const 0)
      (f64.convert_i32_s (i32.sub (global.get $held) (i32.const 1))))
    ${handBack(kSpan)})
  (func (export "sf_session_open")
    (param $positions i32) (param i32 i32 i32 i32 f64) (param $where i32) (param $result i32) (result i32)
    ${misbehave('(f64.load (local.get $positions))')}
    (global.set $sessions (i32.add (global.get $sessions) (i32.const 1)))
    ${handBack(kOpened)})
  (func (export "sf_session_edit")
    (param i32 i32 i32) (param $x f64) (param f64) (param $where i32) (param $result i32) (result i32)
    ${misbehave('(local.get $x)')}
    (i32.store (i32.const ${kEdit + 4}) (i32.const 1))
    ${handBack(kEdit)})
  (func (export "sf_session_read")
    (param i32) (param $where i32) (param $result i32) (result i32)
    (f64.store (i32.const ${kState}) (f64.convert_i32_s (global.get $sessions)))
    (f64.store (i32.const ${kState + 8})
      (f64.convert_i32_s (i32.sub (global.get $held) (i32.const 1))))
    ${handBack(kState)})
  (func (export "sf_session_close") (param i32) (result i32)
    (global.set $sessions (i32.sub (global.get $sessions) (i32.const 1)))
    (i32.const 0)))`;

/** The bytes of the stand-in. */
export async function faultyCore(): Promise<Uint8Array<ArrayBuffer>> {
  const toolkit = await wabt();
  const parsed = toolkit.parseWat('faulty_core.wat', kText);
  try {
    return new Uint8Array(parsed.toBinary({}).buffer);
  } finally {
    parsed.destroy();
  }
}
