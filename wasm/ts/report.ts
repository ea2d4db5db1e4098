/** Has the surroundings tell of an error that no caller is left to catch, as they do of their own. */
export function report(error: unknown): void {
  const { reportError } = globalThis as { reportError?: (error: unknown) => void };
  if (reportError) reportError(error);
  else console.error(error);
}
