/** The key of `using`, also where the engine does not know it yet. */
export const kDispose: typeof Symbol.dispose = ((Symbol as { readonly dispose?: symbol }).dispose ??
  Symbol.for('Symbol.dispose')) as typeof Symbol.dispose;
