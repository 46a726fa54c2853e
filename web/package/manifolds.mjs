// Contacts: of two shapes, and part by part of compounds and of one solid.
import { toNumber, toPose, toVector } from './values.mjs';
import { checkFields } from './words.mjs';

/** Numbers of a manifold; those before its points; where the parts stand; numbers of a point. */
const MANIFOLD = 29, HEAD = 32, PARTS = 64, POINT = 8;
const OPTIONS = new Set(['margin', 'tolerance', 'keep', 'angle']), EARLIER = new Set([...OPTIONS, 'earlier']);

const vector = (n, at) => [n[at], n[at + 1], n[at + 2]];
const settings = (o) => [o?.margin ?? 0, o?.tolerance ?? 0, o?.keep ?? 0, o?.angle ?? 0];
const toPoint = (n, at) => ({ id: n[at + 7], point_a: vector(n, at), point_b: vector(n, at + 3), separation: n[at + 6] });

/** A contact: its fields are those of the tool's JSON. What the next query uses of it is kept beside them. */
export class Manifold {
  #memory;
  #cover;

  constructor(n, names, parts, cover) {
    this.part_a = parts[0];
    this.part_b = parts[1];
    this.status = names.status[n[0]];
    this.limit = names.limit[n[1]];
    this.lower = n[2];
    this.upper = n[3];
    this.normal = vector(n, 4);
    this.axis = names.axis[n[15]];
    this.feature_a = n[11];
    this.feature_b = n[12];
    this.facet_a = n[13];
    this.facet_b = n[14];
    this.flags = n[28];
    this.corners = n[18];
    this.share = n[19];
    this.inner = n[30];
    this.outer = n[31];
    this.grown = n[29];
    this.points = Array.from({ length: n[16] }, (_, i) => toPoint(n, HEAD + POINT * i));
    this.proof = names.contactProof[n[17]];
    if (cover && this.proof === 'search') this.cover = cover;
    this.#cover = cover;
    this.#memory = n.slice(20, 28);
  }

  /** The numbers of a manifold, of this class or of JSON. */
  static toNumbers(m, names) {
    const points = m.points ?? [], ids = points.slice(0, 4).map((p) => p.id), memory = #memory in m ? m.#memory : new Array(8).fill(0);
    return [
      names.number('status', m.status), names.number('limit', m.limit), toNumber(m.lower, -Infinity), toNumber(m.upper, Infinity),
      ...toVector(m.normal, 'normal'), ...ids, ...new Array(4 - ids.length).fill(0), m.feature_a, m.feature_b, m.facet_a, m.facet_b,
      names.number('axis', m.axis), points.length, names.number('contactProof', m.proof), m.corners, m.share, ...memory, m.flags,
    ];
  }

  /** The cover of the last search, which may be older than the proof. */
  static coverOf(m) {
    return m && #cover in m ? m.#cover : m?.cover;
  }

  toJSON() {
    return { ...this };
  }
}

export function bindManifolds(core, kindOf, readCover, writeCover) {
  const { memory, calls, names, Shape } = core;

  function begin(a, b, poseA, poseB, options, known) {
    checkFields(options, known, 'options');
    const numbers = [...toPose(poseA, 'poseA'), ...toPose(poseB, 'poseB'), ...settings(options)];
    const kinds = kindOf(a) + 4 * kindOf(b);
    return { numbers, kinds };
  }

  function refuse({ limit }) {
    if (limit === 'options') throw new RangeError('margin, tolerance and keep are lengths >= 0, angle is at most 1.45 radians');
    if (limit === 'pose_a' || limit === 'pose_b') throw new RangeError(`${limit}: the body would lie beyond the range of lengths, 1e50`);
  }

  function findManifold(a, b, poseA, poseB, options) {
    if (!(a instanceof Shape && b instanceof Shape)) throw new TypeError('findManifold takes two shapes; findManifolds has the contacts of compounds and solids, part by part');
    const { numbers } = begin(a, b, poseA, poseB, options, EARLIER), earlier = options?.earlier;
    writeCover(core, Manifold.coverOf(earlier));
    memory.set(earlier ? [...numbers, ...Manifold.toNumbers(earlier, names)] : numbers);
    calls.manifold_find(a.address, b.address, earlier ? 1 : 0);
    const made = new Manifold(memory.get(PARTS), names, [0, 0], readCover(core)?.());
    refuse(made);
    return made;
  }

  function findManifolds(a, b, poseA, poseB, options) {
    const { numbers, kinds } = begin(a, b, poseA, poseB, options, OPTIONS);
    memory.set(numbers);
    const count = calls.manifolds_find(kinds, a.address, b.address), limit = names.limit[memory.get(1)[0]];
    if (count < 0) throw new RangeError('out of memory');
    refuse({ limit });
    if (limit === 'shape_a' || limit === 'shape_b') throw new TypeError(`${limit}: two solids have no contacts`);
    return Array.from({ length: count }, (_, i) => {
      memory.set(numbers);
      calls.manifold_get(kinds, a.address, b.address, i);
      const n = memory.get(PARTS + 2);
      return new Manifold(n, names, n.slice(PARTS), readCover(core)?.());
    });
  }

  function put(a, b, poseA, poseB, manifold, options) {
    const { numbers, kinds } = begin(a, b, poseA, poseB, options, OPTIONS);
    memory.set([...numbers, manifold.part_a ?? 0, manifold.part_b ?? 0, ...Manifold.toNumbers(manifold, names)]);
    return kinds;
  }

  function verifyManifold(a, b, poseA, poseB, manifold, options) {
    writeCover(core, manifold.cover);
    const kinds = put(a, b, poseA, poseB, manifold, options);
    return calls.manifold_verify(kinds, a.address, b.address) ? memory.error() : null;
  }

  function computePolygon(a, b, poseA, poseB, manifold, options) {
    const kinds = put(a, b, poseA, poseB, manifold, options);
    if (calls.manifold_polygon(kinds, a.address, b.address)) throw memory.error();
    const [count, grown, inner, outer] = memory.get(4), n = memory.get(4 + POINT * count);
    return { points: Array.from({ length: count }, (_, i) => toPoint(n, 4 + POINT * i)), grown, inner, outer };
  }

  return { findManifold, findManifolds, verifyManifold, computePolygon };
}
