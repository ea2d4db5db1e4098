/** `Symbol.dispose`, the key that `using` looks for; a stand-in if the engine does not have it yet. */
export const kDispose: typeof Symbol.dispose = ((Symbol as { readonly dispose?: symbol }).dispose ??
  Symbol.for('Symbol.dispose')) as typeof Symbol.dispose;
