// Names that callers write: of statuses, and of the fields of options. An unknown one is refused with the nearest that there is.

/** The statuses of an answer, to compare with: `answer.status === Status.separated`. */
export const Status = Object.freeze({ undecided: 'undecided', separated: 'separated', touching: 'touching', overlapping: 'overlapping' });

// How many letters differ (V. Levenshtein, 1966), upper case as lower case.
function countEdits(a, b) {
  let row = Array.from({ length: b.length + 1 }, (_, j) => j);
  for (let i = 1; i <= a.length; i++) {
    const next = [i];
    for (let j = 1; j <= b.length; j++) next.push(Math.min(row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] === b[j - 1] ? 0 : 1)));
    row = next;
  }
  return row[b.length];
}

// Without case and underscores; a long name cannot be meant and is cut.
const plain = (name) => name.slice(0, 40).toLowerCase().replaceAll('_', '');

/** "; did you mean NAME?", where a name is near or has it within, else the list of all. */
export function suggest(name, known) {
  const within = [...known].filter((other) => plain(name).length > 3 && plain(other).includes(plain(name)));
  if (within.length) return `; did you mean ${within.join(' or ')}?`;
  const [best] = [...known].map((other) => [other, countEdits(plain(name), plain(other))]).sort((x, y) => x[1] - y[1]);
  return best && best[1] <= Math.max(1, Math.floor(best[0].length / 3)) ? `; did you mean ${best[0]}?` : `; there are ${[...known].join(', ')}`;
}

/** Throws where an object has a field that is not known; undefined and null have none. */
export function checkFields(object, known, what) {
  if (object === undefined || object === null) return;
  if (typeof object !== 'object') throw new TypeError(`${what}: an object is needed, not ${typeof object}`);
  for (const key of Object.keys(object)) if (!known.has(key)) throw new TypeError(`${what}: no such field: ${key.slice(0, 40)}${suggest(key, known)}`);
}

/** Throws where one of these fields is there and no number. */
export function checkNumbers(object, fields, what) {
  for (const field of fields) {
    const x = object?.[field];
    if (x !== undefined && typeof x !== 'number') throw new TypeError(`${what}: ${field}: a number is needed`);
    if (field === 'iterations' && x !== undefined && !(Number.isInteger(x) && x >= 0 && x < 2 ** 32)) throw new TypeError(`${what}: iterations: 0 to 2^32 - 1 are needed`);
  }
}

/** Indices as they are, or from numbers, which are whole. */
export function toIndices(list, what) {
  if (list instanceof Uint32Array) return list;
  const flat = list.flat ? list.flat() : Array.from(list);
  if (!flat.every(Number.isInteger)) throw new TypeError(`${what}: indices are whole numbers`);
  return Uint32Array.from(flat);
}

/** Throws where a name is none of the list. */
export function checkName(name, known, what) {
  if (!known.includes(name)) throw new TypeError(`no such ${what}: ${String(name).slice(0, 40)}${suggest(String(name), known)}`);
}
