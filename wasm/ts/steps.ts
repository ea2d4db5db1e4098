// Work in steps that is the same whether each step is done at once or by another thread.

/** Work that waits for answers. */
export type Steps<T> = Generator<unknown, T, never>;

/** An answer that is there already, or will be. */
export type Answer<T> = T | Promise<T>;

/** Waits for an answer, within steps: `yield* wait(…)`. */
export function* wait<T>(answer: Answer<T>): Generator<Answer<T>, T, T> {
  return yield answer;
}

/** Does all steps of work whose answers are there already. */
export function doAtOnce<T>(steps: Steps<T>): T {
  let step = steps.next();
  while (!step.done) step = steps.next(step.value as never);
  return step.value;
}

/** Does the steps as their answers come. An answer that fails throws where the work waits for it. */
export async function doInTime<T>(steps: Steps<T>): Promise<T> {
  let step = steps.next();
  while (!step.done) {
    let answer: unknown;
    try {
      answer = await step.value;
    } catch (error) {
      step = steps.throw(error);
      continue;
    }
    step = steps.next(answer as never);
  }
  return step.value;
}
