// Values: poses, vectors and answers, as the tool's JSON has them, to numbers and back.

import { checkFields, checkName } from './words.mjs';

/** Three finite or infinite numbers. */
export function toVector(v, what) {
  if (v === undefined || v === null || v.length !== 3) throw new TypeError(`${what}: three numbers are needed`);
  for (const x of v) if (typeof x !== 'number') throw new TypeError(`${what}: three numbers are needed`);
  return v;
}

function toQuaternion(pose, what) {
  const { quat_wxyz: wxyz, quat_xyzw: xyzw, rpy } = pose;
  if ((wxyz !== undefined) + (xyzw !== undefined) + (rpy !== undefined) > 1)
    throw new TypeError(`${what}: give one of quat_wxyz, quat_xyzw and rpy`);
  const q = wxyz ?? xyzw;
  if (q !== undefined && (q.length !== 4 || ![...q].every((x) => typeof x === 'number')))
    throw new TypeError(`${what}: a quaternion has four numbers`);
  if (wxyz) return wxyz;
  if (xyzw) return [xyzw[3], xyzw[0], xyzw[1], xyzw[2]];
  if (!rpy) return [1, 0, 0, 0];
  const [r, p, y] = toVector(rpy, `${what}.rpy`).map((x) => x / 2);
  const [cr, sr, cp, sp, cy, sy] = [Math.cos(r), Math.sin(r), Math.cos(p), Math.sin(p), Math.cos(y), Math.sin(y)];
  return [cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy];
}

const POSE = new Set(['xyz', 'quat_wxyz', 'quat_xyzw', 'rpy']);

/** Seven numbers of a pose { xyz, quat_wxyz | quat_xyzw | rpy }; undefined: at the origin, not turned. */
export function toPose(pose, what = 'pose') {
  if (pose === undefined || pose === null) return [0, 0, 0, 1, 0, 0, 0];
  checkFields(pose, POSE, what);
  return [...(pose.xyz ? toVector(pose.xyz, `${what}.xyz`) : [0, 0, 0]), ...toQuaternion(pose, what)];
}

/** Names of numbers, by the module's own words. */
export class Names {
  constructor(memory) {
    // Up to the first that the library has no name for.
    const list = (read, all = []) => {
      for (let name = memory.text(read(0)); name !== 'unknown'; name = memory.text(read(all.length))) all.push(name);
      return all;
    };
    const { get_status_name, get_stage_name, get_limit_name, get_proof_kind_name, get_axis_name, get_manifold_proof_name } = memory.exports;
    this.status = list(get_status_name);
    this.stage = list(get_stage_name);
    this.limit = list(get_limit_name);
    this.kind = list(get_proof_kind_name);
    this.axis = list(get_axis_name);
    this.contactProof = list(get_manifold_proof_name);
  }

  /** The number of a name, or what is none: 255. */
  number(list, name) {
    const i = this[list].indexOf(name);
    return i < 0 ? 255 : i;
  }
}

/** Writes a pose to an array, from `at` on. */
export function putPose(numbers, at, pose, what) {
  const wxyz = pose?.quat_wxyz, xyz = pose?.xyz;
  if (xyz?.length === 3 && wxyz?.length === 4 && Object.keys(pose).length === 2) {
    for (let i = 0; i < 3; i++) numbers[at + i] = xyz[i];
    for (let i = 0; i < 4; i++) numbers[at + 3 + i] = wxyz[i];
  } else {
    const n = toPose(pose, what);
    for (let i = 0; i < 7; i++) numbers[at + i] = n[i];
  }
}

const PAIRS = 6;
export const ANSWER = 15;
export const PROOF = 8 + 4 * PAIRS + 6;

const vector = (n, at) => [n[at], n[at + 1], n[at + 2]];

function toProofObject(n, names) {
  const at = ANSWER, count = n[at + 7], a = [], b = [], weight_a = [], weight_b = [];
  for (let i = 0; i < count; i++) {
    const pair = at + 8 + 4 * i;
    a.push(n[pair]);
    b.push(n[pair + 1]);
    weight_a.push(n[pair + 2]);
    weight_b.push(n[pair + 3]);
  }
  const proof = { normal: vector(n, at), kind: names.kind[n[at + 6]], a, b, weight_a, weight_b };
  if (n[at + 3] !== 0 || n[at + 4] !== 0 || n[at + 5] !== 0) proof.normal_low = vector(n, at + 3);
  const hasBoth = proof.kind === 'inner_points' || proof.kind === 'balls';
  if (proof.kind === 'inner' || hasBoth) proof.inner_a = vector(n, at + PROOF - 6);
  if (hasBoth) proof.inner_b = vector(n, at + PROOF - 3);
  return proof;
}

/** An answer: its fields are those of a line of the tool's JSON. The proof is made when it is asked for, and completed. */
export class Answer {
  #numbers;
  #names;
  #proof;
  #complete;

  constructor(n, names, complete) {
    this.status = names.status[n[0]];
    this.limit = names.limit[n[2]];
    this.lower = n[4];
    this.upper = n[5];
    this.point_a = vector(n, 6);
    this.point_b = vector(n, 9);
    this.normal = vector(n, 12);
    this.stage = names.stage[n[1]];
    this.iterations = n[3];
    this.#numbers = n;
    this.#names = names;
    this.#complete = complete;
  }

  get proof() {
    if (!this.#proof) {
      this.#proof = toProofObject(this.#numbers, this.#names);
      this.#complete?.(this.#proof);
    }
    return this.#proof;
  }

  /** Whether the status is this one; a name that is none throws. */
  is(status) {
    checkName(status, this.#names.status, 'status');
    return this.status === status;
  }

  /** Whether the bodies are within the margin: true, false, or null where the bracket does not say. */
  isWithin(margin) {
    if (typeof margin !== 'number') throw new TypeError('isWithin: a number is needed');
    return this.upper <= margin ? true : this.lower > margin ? false : null;
  }

  toJSON() {
    return { ...this, proof: this.proof };
  }

  // Of an object `answer < 0.1` and `answer == 'separated'` would be false without a word.
  [Symbol.toPrimitive](hint) {
    if (hint !== 'string') throw new TypeError("an answer is neither a number nor a name: ask for answer.lower, answer.upper or answer.is('separated')");
    return `${this.status}, ${this.lower} to ${this.upper}`;
  }
}

/** What JSON writes of numbers that it has none for: null, "inf", "-inf". */
export const toNumber = (x, fallback) => (typeof x === 'number' ? x : x === 'inf' ? Infinity : x === '-inf' ? -Infinity : fallback);

/** The numbers of a proof. */
export function fromProof(proof, names) {
  const n = new Array(PROOF).fill(0), zero = [0, 0, 0];
  const put = (at, v) => v.forEach((x, i) => (n[at + i] = toNumber(x, NaN)));
  put(0, proof.normal ?? zero);
  put(3, proof.normal_low ?? zero);
  n[6] = names.number('kind', proof.kind);
  n[7] = proof.a?.length ?? 0;
  for (let i = 0; i < Math.min(n[7], PAIRS); i++) put(8 + 4 * i, [proof.a[i], proof.b[i], proof.weight_a[i], proof.weight_b[i]]);
  put(PROOF - 6, proof.inner_a ?? zero);
  put(PROOF - 3, proof.inner_b ?? zero);
  return n;
}

/** The numbers of an answer, proof included. */
export function fromAnswer(answer, names) {
  return [
    names.number('status', answer.status), names.number('stage', answer.stage), names.number('limit', answer.limit),
    answer.iterations ?? 0, toNumber(answer.lower, -Infinity), toNumber(answer.upper, Infinity),
    ...toVector(answer.point_a, 'point_a'), ...toVector(answer.point_b, 'point_b'), ...toVector(answer.normal, 'normal'),
    ...fromProof(answer.proof, names),
  ];
}
