// The entry for Node.js: as ovoid.mjs, and reads the module from a file.
import { readFile } from 'node:fs/promises';
import { load as loadSource } from './ovoid.mjs';

export { OvoidError, Status } from './ovoid.mjs';

const isFile = (source) => (source instanceof URL ? source.protocol === 'file:' : typeof source === 'string' && source.startsWith('file:'));

/** Loads the module, from beside this file where no source is given. */
export async function load(source = new URL('./ovoid.wasm', import.meta.url)) {
  return loadSource(isFile(source) ? await readFile(new URL(source)) : source);
}
