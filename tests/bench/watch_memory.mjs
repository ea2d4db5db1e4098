/**
 * Watches the memory of the core's instances from now on, which the package does not show. Returns a function
 * that tells the peak so far, in bytes.
 */
export function watchMemory() {
  const { Instance, instantiate } = WebAssembly;
  let memory;
  let peak = 0;
  const look = () => (peak = Math.max(peak, memory?.buffer.byteLength ?? 0));
  const keep = (instance) => {
    look();
    memory = instance.exports.memory;
    return instance;
  };
  WebAssembly.Instance = function (...given) {
    return keep(new Instance(...given));
  };
  WebAssembly.instantiate = async (...given) => keep(await instantiate(...given));
  return look;
}
