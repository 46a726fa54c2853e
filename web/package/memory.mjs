// The module's memory: numbers and arrays in and out of it.
// Views are made anew whenever the memory has grown, since that detaches the old ones.

/** What went wrong, with the library's sentence: what, where, what to do. */
export class OvoidError extends Error {
  /** @param {number} code as ovoid_code @param {number} place item, vertex or byte; -1: none @param {string} message */
  constructor(code, place, message) {
    super(message);
    this.name = 'OvoidError';
    this.code = code;
    this.place = place;
  }
}

// wasi-libc asks for these to print; nothing of the library prints.
const NOT_SUPPORTED = 58;
const imports = {
  wasi_snapshot_preview1: {
    fd_close: () => NOT_SUPPORTED,
    fd_seek: () => NOT_SUPPORTED,
    fd_write: () => NOT_SUPPORTED,
    proc_exit: (code) => {
      throw new Error(`ovoid: ended with ${code}`);
    },
  },
};

/** The instance of a module, from its bytes, a compiled module, a response, an address, or what stands beside this file. */
export async function instantiate(source) {
  if (source === undefined) source = new URL('./ovoid.wasm', import.meta.url);
  if (source instanceof URL || typeof source === 'string') source = await fetch(source);
  if (typeof Response !== 'undefined' && source instanceof Response) {
    if (!source.ok) throw new Error(`ovoid: ${source.url}: ${source.status} ${source.statusText}`);
    source = await source.arrayBuffer();
  }
  const module = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(source);
  const { exports } = await WebAssembly.instantiate(module, imports);
  exports._initialize();
  return exports;
}

/** The numbers that calls exchange, and memory for arrays. */
export class Memory {
  constructor(exports) {
    this.exports = exports;
    this.place = exports.get_exchange() / 8;
    this.cached = new Float64Array(exports.memory.buffer);
  }

  get doubles() {
    // A detached view has no length.
    if (this.cached.length === 0) this.cached = new Float64Array(this.exports.memory.buffer);
    return this.cached;
  }

  /** Numbers for the next call. */
  set(numbers, from = 0) {
    const { doubles } = this, at = this.place + from;
    for (let i = 0; i < numbers.length; i++) doubles[at + i] = numbers[i];
  }

  /** Numbers of the last call, copied. */
  get(count) {
    const { doubles, place } = this, out = [];
    for (let i = 0; i < count; i++) out.push(doubles[place + i]);
    return out;
  }

  /** A copy of a typed array in the module's memory; give it back by release. */
  copy(array) {
    const address = this.exports.allocate(array.byteLength);
    if (!address) throw new OvoidError(1, -1, 'out of memory');
    this.put(address, new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
    return address;
  }

  /** Writes bytes at an address. */
  put(address, bytes) {
    new Uint8Array(this.exports.memory.buffer).set(bytes, address);
  }

  /** Runs a function with copies of arrays, and gives their memory back. */
  with(arrays, run) {
    const addresses = [];
    try {
      for (const array of arrays) addresses.push(this.copy(array));
      return run(...addresses);
    } finally {
      for (const address of addresses) this.exports.release(address);
    }
  }

  /** A copy of numbers at an address. */
  take(Type, address, count) {
    return new Type(this.exports.memory.buffer, address, count).slice();
  }

  text(address) {
    const bytes = new Uint8Array(this.exports.memory.buffer);
    return new TextDecoder().decode(bytes.subarray(address, bytes.indexOf(0, address)));
  }

  /** The error of the call that failed. */
  error() {
    const { get_error_code, get_error_place, get_error_message } = this.exports;
    return new OvoidError(get_error_code(), get_error_place(), this.text(get_error_message()));
  }
}
