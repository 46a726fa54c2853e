// Bodies that are not convex: compounds of shapes, solids of triangles; and what is asked of pairs with one of them.
import { OvoidError } from './memory.mjs';
import { Answer, ANSWER, fromAnswer, PROOF, toNumber, toPose } from './values.mjs';
import { checkFields, toIndices } from './words.mjs';

/** Numbers of an answer before those that every answer has; of an exclusion: four indices, seven numbers. */
const HEAD = 15;
const EXCLUSION = 72;
const PART = new Set(['shape', 'pose']);

function bindCompound({ memory, calls, hold, drop, Shape }) {
  return class Compound {
    #address;

    constructor(parts) {
      this.parts = Object.freeze(Array.from(parts, (part) => {
        checkFields(part, PART, 'a part of a compound');
        return Object.freeze({ shape: part.shape, pose: part.pose });
      }));
      for (const { shape } of this.parts) if (!(shape instanceof Shape)) throw new TypeError('the parts of a compound are { shape, pose }');
      const shapes = Uint32Array.from(this.parts, ({ shape }) => shape.address), poses = Float64Array.from(this.parts.flatMap(({ pose }) => toPose(pose)));
      this.#address = memory.with([shapes, poses], (s, p) => calls.compound_create(s, p, shapes.length));
      if (!this.#address) throw memory.error();
      hold(this, calls.compound_destroy, this.#address);
    }

    get address() {
      if (!this.#address) throw new TypeError('the compound was freed');
      // Its shapes are in use: one that was freed says so.
      for (const { shape } of this.parts) void shape.address;
      return this.#address;
    }
    free() {
      if (!this.#address) return;
      drop(this);
      calls.compound_destroy(this.#address);
      this.#address = 0;
    }
  };
}

function bindSolid({ memory, calls, hold, drop }) {
  const secret = Symbol('solid');

  return class Solid {
    #address;

    constructor(given, address) {
      if (given !== secret) throw new TypeError('a solid is made by Solid.fromTriangles');
      this.#address = address;
      hold(this, calls.solid_destroy, address);
    }

    static fromTriangles(points, triangles) {
      const xyz = Float64Array.from(points.flat ? points.flat() : points), corners = toIndices(triangles, 'triangles');
      if (xyz.length % 3 || corners.length % 3) throw new TypeError('points take three numbers each, triangles three indices each');
      const address = memory.with([xyz, corners], (p, t) => calls.solid_create(p, xyz.length / 3, t, corners.length / 3));
      if (!address) throw memory.error();
      return new Solid(secret, address);
    }

    get address() {
      if (!this.#address) throw new TypeError('the solid was freed');
      return this.#address;
    }
    free() {
      if (!this.#address) return;
      drop(this);
      calls.solid_destroy(this.#address);
      this.#address = 0;
    }

    get report() {
      calls.solid_describe(this.address);
      const n = memory.get(16);
      return {
        points: n[0], triangles: n[1], components: n[2], edgesUnmatched: n[3], edgesCrowded: n[4], degenerate: n[5], duplicates: n[6],
        isClosed: n[7] === 1, volume: n[8], area: n[9], box: { min: n.slice(10, 13), max: n.slice(13, 16) },
      };
    }
  };
}

// ---- exclusions, as the tool's JSON has them

function readExclusions(bytes) {
  const indices = new Uint32Array(bytes.buffer), numbers = new Float64Array(bytes.buffer), out = [];
  for (let i = 0; i < bytes.length / EXCLUSION; i++) {
    const [n, x] = [indices.subarray(18 * i), numbers.subarray(9 * i + 2)], low = [x[3], x[4], x[5]];
    out.push({ a: [n[0], n[1]], b: [n[2], n[3]], normal: [x[0], x[1], x[2]], ...(low.some((v) => v !== 0) ? { normal_low: low } : {}), lower: x[6] });
  }
  return out;
}

function toExclusionBytes(list) {
  const bytes = new Uint8Array(EXCLUSION * list.length), indices = new Uint32Array(bytes.buffer), numbers = new Float64Array(bytes.buffer);
  list.forEach(({ a, b, normal, normal_low = [0, 0, 0], lower }, i) => {
    indices.set([a[0], a[1], b[0], b[1]], 18 * i);
    numbers.set([...normal, ...normal_low, toNumber(lower, -Infinity)], 9 * i + 2);
  });
  return bytes;
}

const INSIDE = [undefined, 'a in b', 'b in a', 'common point'];

export function bindBodies(core) {
  const { memory, calls, names, Shape } = core, Compound = bindCompound(core), Solid = bindSolid(core);
  const classes = [Shape, Compound, Solid];

  const kindOf = (body) => {
    const kind = classes.findIndex((type) => body instanceof type);
    if (kind < 0) throw new TypeError('a Shape, a Compound or a Solid is needed; the arguments are a, b, poseA, poseB');
    return kind;
  };

  // What a line of the tool's JSON has beside an answer about two shapes: n, the numbers before that one's.
  function describe(answer, kinds, n) {
    kinds.forEach((kind, side) => kind && (answer[`${kind === 1 ? 'part' : 'triangle'}_${'ab'[side]}`] = n[1 + side]));
    if (kinds.includes(2) && INSIDE[n[6]])
      Object.assign(answer, { inside: INSIDE[n[6]], ...(n[6] === 3 ? { common: n.slice(8, 11) } : { component: n[7] }) });
  }

  // And beside its proof.
  function completeProof(proof, { kinds, n, bytes, cover, lower }) {
    if (cover) proof.cover = cover();
    if (bytes.length) proof.exclusions = readExclusions(bytes);
    if (!kinds.includes(2)) return;
    proof.surfaces = { status: names.status[n[11]], limit: names.limit[n[12]], lower: n[13], upper: n[14] };
    if (lower <= 0 && lower !== -Infinity) proof.parting = n.slice(3, 6);
  }

  /** Asks about a pair: of its numbers all but an earlier answer stand in the memory. kind: of collide, within, distance, depth. */
  function query(kind, a, b, earlier, readCover) {
    const kinds = [kindOf(a), kindOf(b)];
    if (kind === 3 && kinds.includes(2)) throw new TypeError('depth: of a Solid ask for the distance, which brackets the depth too');
    calls.body_query(kind, kinds[0] | (kinds[1] << 2), a.address, b.address, earlier ? 1 : 0);
    const n = memory.get(HEAD + ANSWER + PROOF);
    if (n[0] < 0) throw new OvoidError(1, -1, 'out of memory');
    const bytes = memory.take(Uint8Array, calls.get_exclusions(), EXCLUSION * n[0]);
    const extra = { kinds, n: n.slice(0, HEAD), bytes, cover: kind === 3 ? readCover() : undefined, lower: n[HEAD + 4] };
    const answer = new Answer(n.slice(HEAD), names, (proof) => completeProof(proof, extra));
    describe(answer, kinds, n);
    return answer;
  }

  /** Checks an answer: both poses and the query's options stand in the memory. */
  function verify(a, b, answer) {
    const kinds = [kindOf(a), kindOf(b)], { exclusions = [], surfaces, parting } = answer.proof;
    const at = calls.set_exclusions(exclusions.length);
    if (!at && exclusions.length) throw new OvoidError(1, -1, 'out of memory');
    memory.put(at, toExclusionBytes(exclusions));
    const side = (name) => answer[`triangle_${name}`] ?? answer[`part_${name}`] ?? 0;
    memory.set([
      0, side('a'), side('b'), ...(parting ?? [0, 0, 0]), Math.max(0, INSIDE.indexOf(answer.inside)), answer.component ?? 0,
      ...(answer.common ?? [0, 0, 0]),
      names.number('status', surfaces?.status), names.number('limit', surfaces?.limit), toNumber(surfaces?.lower, -Infinity), toNumber(surfaces?.upper, Infinity),
      ...fromAnswer(answer, names),
    ], 18);
    return calls.body_verify(kinds[0] | (kinds[1] << 2), a.address, b.address) ? memory.error() : null;
  }

  return { Compound, Solid, kindOf, query, verify };
}
