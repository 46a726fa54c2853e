// ovoid: proximity of bodies, with proofs. See ovoid.d.ts for what each function takes and gives.
import { instantiate, Memory, OvoidError } from './memory.mjs';
import { Answer, ANSWER, fromAnswer, fromProof, Names, PROOF, putPose, toPose, toVector } from './values.mjs';
import { bindRobots } from './robots.mjs';
import { bindBodies } from './bodies.mjs';
import { bindManifolds } from './manifolds.mjs';
import { checkFields, checkName, checkNumbers, Status, toIndices } from './words.mjs';

export { OvoidError, Status };

const QUERIES = ['collide', 'within', 'distance', 'depth'];
const COVER_POINTS = 32767;

/** Loads the module: everything else is a field of what this gives. */
export async function load(source) {
  const memory = new Memory(await instantiate(source));
  const core = { memory, calls: memory.exports, names: new Names(memory) };
  // What nobody holds any more is given back; free() does it at once.
  const collected = new FinalizationRegistry(({ destroy, address }) => destroy(address));
  core.hold = (object, destroy, address) => collected.register(object, { destroy, address }, object);
  core.drop = (object) => collected.unregister(object);
  const Shape = bindShapes(core);
  core.Shape = Shape;
  core.addressOf = (shape, what) => {
    if (!(shape instanceof Shape)) throw new TypeError(`${what}: a Shape is needed`);
    return shape.address;
  };
  const { Compound, Solid, kindOf, ...bodies } = bindBodies(core);
  Object.assign(core, { Solid, kindOf });
  return {
    get memoryBytes() {
      return core.calls.memory.buffer.byteLength;
    },
    Shape, Compound, Solid, OvoidError, Status, version: memory.text(core.calls.get_version()), names: core.names,
    ...bindQueries(core, bodies), ...bindManifolds(core, kindOf, readCover, writeCover), ...bindMotions(core), ...bindRobots(core),
  };
}

// ---- shapes

function toNumbers(points) {
  if (ArrayBuffer.isView(points)) return points instanceof Float64Array ? points : Float64Array.from(points);
  return Float64Array.from(Array.isArray(points[0]) || ArrayBuffer.isView(points[0]) ? points.flatMap((p) => [...p]) : points);
}

const SHAPE = new Set(['radius', 'gap', 'inner', 'allowance']), ROUND = new Set([...SHAPE, 'tolerance']), ALLOWANCE = new Set(['outside', 'inside', 'axis']);
const BOX = new Set(['half', 'size']);
const KINDS = ['box', 'sphere', 'capsule', 'cylinder', 'cone', 'prism', 'pyramid', 'ellipsoid'], TRUE = new Set(['cylinder', 'cone', 'ellipsoid']);

function bindShapes(core) {
  const { memory, calls } = core;
  const secret = Symbol('shape');

  class Shape {
    #address;

    constructor(given, address) {
      if (given !== secret) throw new TypeError('a shape is made by Shape.fromPoints, Shape.box and their like');
      this.#address = address;
      core.hold(this, calls.shape_destroy, address);
    }

    static #make(options, numbers, call, known = SHAPE) {
      checkFields(options, known, 'options');
      checkFields(options?.allowance, ALLOWANCE, 'allowance');
      checkNumbers(options, ['radius', 'gap', 'tolerance'], 'options');
      const { radius = 0, gap = 0, inner = 'maximum', allowance = {} } = options ?? {};
      const method = ['maximum', 'phases', 'lean'].indexOf(inner);
      if (method < 0) throw new TypeError(`inner: maximum, phases or lean, not ${inner}`);
      memory.set([radius, gap, method, allowance.outside ?? 0, allowance.inside ?? 0, ...(allowance.axis ?? [0, 0, 0]), ...numbers]);
      const address = call();
      if (!address) throw memory.error();
      return new Shape(secret, address);
    }

    static fromPoints(points, options) {
      const xyz = toNumbers(points);
      if (xyz.length % 3) throw new TypeError(`points: ${xyz.length} numbers are no number of points, which take three each`);
      return Shape.#make(options, [], () => memory.with([xyz], (address) => calls.shape_from_points(address, xyz.length / 3)));
    }

    static hullOf(solid) {
      return Shape.#make({}, [], () => calls.solid_create_hull(solid.address));
    }

    static #create(kind, options, ...numbers) {
      for (const x of numbers) if (typeof x !== 'number') throw new TypeError(`${kind}: numbers are needed`);
      if ((kind === 'prism' || kind === 'pyramid') && !Number.isInteger(numbers[2])) throw new TypeError(`${kind}: sides: a whole number is needed`);
      return Shape.#make(options, [...numbers, 0, 0, 0].slice(0, 4), () => calls.shape_create(KINDS.indexOf(kind)), TRUE.has(kind) ? ROUND : SHAPE);
    }

    // Half sizes, or { half }, or { size }.
    static box(sizes, options) {
      if (sizes?.length !== undefined) return Shape.#create('box', options, ...toVector(sizes, 'half sizes'));
      if (typeof sizes === 'object') checkFields(sizes, BOX, 'a box');
      if (!sizes?.half === !sizes?.size) throw new TypeError('a box: half sizes [x, y, z], or one of { half } and { size } are needed');
      return Shape.#create('box', options, ...(sizes.half ? toVector(sizes.half, 'half') : Array.from(toVector(sizes.size, 'size'), (x) => x / 2)));
    }
    static sphere(radius, options) {
      return Shape.#create('sphere', options, radius);
    }
    static capsule(radius, halfLength, options) {
      return Shape.#create('capsule', options, radius, halfLength);
    }
    static cylinder(radius, halfLength, options) {
      return Shape.#create('cylinder', options, radius, halfLength, options?.tolerance ?? 0);
    }
    static cone(radius, halfLength, options) {
      return Shape.#create('cone', options, radius, halfLength, options?.tolerance ?? 0);
    }
    static ellipsoid(halfAxes, options) {
      return Shape.#create('ellipsoid', options, ...toVector(halfAxes, 'half axes'), options?.tolerance ?? 0);
    }
    static prism(radius, halfLength, sides, options) {
      return Shape.#create('prism', options, radius, halfLength, sides);
    }
    static pyramid(radius, halfLength, sides, options) {
      return Shape.#create('pyramid', options, radius, halfLength, sides);
    }

    static fromBytes(bytes) {
      const address = memory.with([bytes], (at) => calls.shape_read(at, bytes.byteLength));
      if (!address) throw memory.error();
      return new Shape(secret, address);
    }

    toBytes() {
      const size = calls.shape_write(this.address, 0, 0), at = calls.allocate(size);
      if (!at) throw new OvoidError(1, -1, 'out of memory');
      calls.shape_write(this.address, at, size);
      const bytes = memory.take(Uint8Array, at, size);
      calls.release(at);
      return bytes;
    }

    get address() {
      if (!this.#address) throw new TypeError('the shape was freed');
      return this.#address;
    }

    free() {
      if (!this.#address) return;
      core.drop(this);
      calls.shape_destroy(this.#address);
      this.#address = 0;
    }

    get description() {
      calls.shape_describe(this.address);
      const n = memory.get(52), fit = (at) => ({ center: n.slice(at, at + 3), q: n.slice(at + 3, at + 9), volume: n[at + 9], gap: n[at + 10] });
      return {
        vertexCount: n[0], triangleCount: n[1], rank: n[2], radius: n[3], allowance: { outside: n[4], inside: n[5], axis: n.slice(48, 51).some((x) => x !== 0) ? n.slice(48, 51) : null },
        volume: n[6], area: n[7], centroid: n.slice(8, 11), inertia: n.slice(11, 17),
        box: { min: n.slice(17, 20), max: n.slice(20, 23) }, origin: n.slice(23, 26), outer: fit(26), inner: fit(37), isLean: n[51] !== 0,
      };
    }
    get vertices() {
      const { vertexCount } = this.description;
      return memory.take(Float64Array, calls.shape_get_vertices(this.address), 3 * vertexCount);
    }
    get triangles() {
      const { triangleCount } = this.description;
      return triangleCount ? memory.take(Uint32Array, calls.shape_get_triangles(this.address), 3 * triangleCount) : new Uint32Array(0);
    }
    get volume() {
      return this.description.volume;
    }
    get outer() {
      return this.description.outer;
    }
    get inner() {
      return this.description.inner;
    }
  }
  return Shape;
}

// ---- queries

// The cover of the last depth, copied; as an object when that is asked for. undefined: there is none.
function readCover({ memory, calls }) {
  const [points, triangles, ...at] = new Uint32Array(memory.exports.memory.buffer, calls.get_cover(), 5);
  if (!points) return undefined;
  const a = memory.take(Uint32Array, at[0], points), b = memory.take(Uint32Array, at[1], points);
  const corners = memory.take(Uint16Array, at[2], 3 * triangles);
  return () => ({
    pairs: Array.from(a, (end, i) => [end, b[i]]),
    triangles: Array.from({ length: triangles }, (_, i) => [...corners.subarray(3 * i, 3 * i + 3)]),
  });
}

function writeCover({ memory, calls }, cover) {
  const { buffer } = memory.exports.memory, words = new Uint32Array(buffer, calls.get_cover(), 6), at = words[5];
  words.fill(0, 0, 2);
  if (!cover) return;
  const { pairs, triangles } = cover, points = pairs.length, count = triangles.length;
  if (points > COVER_POINTS || count > 2 * COVER_POINTS)
    throw new OvoidError(14, -1, `the cover has ${points} points and ${count} triangles; there are at most ${COVER_POINTS} and ${2 * COVER_POINTS}`);
  const ends = new Uint32Array(buffer, at, 2 * points);
  pairs.forEach(([a, b], i) => ((ends[i] = a), (ends[points + i] = b)));
  new Uint16Array(buffer, at + 8 * points, 3 * count).set(triangles.flat());
  words.set([points, count, at, at + 4 * points, at + 8 * points]);
}

const settings = (o) => [o?.absoluteTolerance ?? 0, o?.relativeTolerance ?? 0, o?.cap ?? 0, o?.iterations ?? 0];

const NUMBERS = ['absoluteTolerance', 'relativeTolerance', 'cap', 'iterations', 'margin'], POSED = new Set(['shape', 'pose']);
const QUERY = new Set(['absoluteTolerance', 'relativeTolerance', 'cap', 'iterations', 'earlier']), BATCH = new Set([...QUERY, 'margin']);
BATCH.delete('earlier');

function bindQueries(core, bodies) {
  const { memory, calls, names, Shape } = core;
  const areShapes = (a, b) => a instanceof Shape && b instanceof Shape;

  // An earlier answer's proof, where the search begins; before it, of other bodies than shapes, the parts that decided.
  function putEarlier(earlier, arePlain) {
    const side = (name) => earlier[`triangle_${name}`] ?? earlier[`part_${name}`] ?? 0;
    memory.set([...(arePlain ? [] : [side('a'), side('b')]), ...fromProof(earlier.proof, names)], 19);
  }

  function query(kind, a, b, poseA, poseB, margin, options) {
    checkFields(options, QUERY, 'options');
    checkNumbers(options, NUMBERS, 'options');
    if (typeof margin !== 'number') throw new TypeError('within: a margin is needed; the arguments are a, b, poseA, poseB, margin');
    const earlier = options?.earlier, arePlain = areShapes(a, b);
    const { doubles, place } = memory;
    putPose(doubles, place, poseA, 'poseA');
    putPose(doubles, place + 7, poseB, 'poseB');
    doubles[place + 14] = margin;
    doubles[place + 15] = options?.absoluteTolerance ?? 0;
    doubles[place + 16] = options?.relativeTolerance ?? 0;
    doubles[place + 17] = options?.cap ?? 0;
    doubles[place + 18] = options?.iterations ?? 0;
    if (earlier) putEarlier(earlier, arePlain);
    if (!arePlain) return bodies.query(kind, a, b, earlier, () => readCover(core));
    calls.query(kind, a.address, b.address, earlier ? 1 : 0);
    const n = memory.get(ANSWER + PROOF), cover = kind === 3 ? readCover(core) : undefined;
    return new Answer(n, names, cover && ((proof) => (proof.cover = cover())));
  }

  function verify(a, b, poseA, poseB, answer, options) {
    checkFields(options, QUERY, 'options');
    if (!answer?.proof) throw new TypeError('verify: an answer with its proof is needed');
    memory.set([...toPose(poseA, 'poseA'), ...toPose(poseB, 'poseB'), ...settings(options)]);
    writeCover(core, answer.proof.cover);
    if (!areShapes(a, b)) return bodies.verify(a, b, answer);
    memory.set(fromAnswer(answer, names), 18);
    return calls.verify(a.address, b.address) ? memory.error() : null;
  }

  function batch(kind, bodies, couples, options) {
    checkName(kind, QUERIES, 'query');
    checkFields(options, BATCH, 'options');
    checkNumbers(options, NUMBERS, 'options');
    for (const body of bodies) checkFields(body, POSED, 'a body');
    const index = QUERIES.indexOf(kind);
    const shapes = Uint32Array.from(bodies, (b) => core.addressOf(b.shape, 'a body')), poses = Float64Array.from(bodies.flatMap((b) => toPose(b.pose)));
    const pairs = toIndices(couples, 'couples');
    if (pairs.length % 2) throw new TypeError('couples: two indices each are needed');
    const count = pairs.length / 2, room = [new Float64Array(2 * count), new Uint8Array(3 * count)];
    return memory.with([shapes, poses, pairs, ...room], (s, p, c, bounds, codes) => {
      memory.set([options?.margin ?? 0, ...settings(options)]);
      if (calls.batch(index, s, p, bodies.length, c, count, bounds, codes)) throw memory.error();
      const column = (i) => memory.take(Uint8Array, codes + i * count, count);
      return {
        lower: memory.take(Float64Array, bounds, count), upper: memory.take(Float64Array, bounds + 8 * count, count),
        status: column(0), stage: column(1), limit: column(2),
      };
    });
  }

  function smooth(a, b, poseA, poseB, order = 0) {
    if (![0, 1, 2].includes(order)) throw new TypeError('smooth: order: 0, 1 or 2 is needed');
    const at = [a, b].map((shape) => core.addressOf(shape, 'smooth'));
    memory.set([...toPose(poseA, 'poseA'), ...toPose(poseB, 'poseB')]);
    calls.smooth(...at, order);
    const size = 4 + 9 + 12 + (order === 2 ? 144 : 0), n = memory.get(1 + 2 * size);
    const side = (m) => ({
      value: m[0], error: m[1], condition: m[2], isSmooth: m[3] === 1, point_a: m.slice(4, 7), point_b: m.slice(7, 10), normal: m.slice(10, 13),
      gradient: m.slice(13, 25), hessian: order === 2 ? Array.from({ length: 12 }, (_, i) => m.slice(25 + 12 * i, 37 + 12 * i)) : undefined,
    });
    return { limit: names.limit[n[0]], outer: side(n.slice(1, 1 + size)), inner: side(n.slice(1 + size)) };
  }

  return {
    collide: (a, b, poseA, poseB, options) => query(0, a, b, poseA, poseB, 0, options),
    within: (a, b, poseA, poseB, margin, options) => query(1, a, b, poseA, poseB, margin, options),
    distance: (a, b, poseA, poseB, options) => query(2, a, b, poseA, poseB, 0, options),
    depth: (a, b, poseA, poseB, options) => query(3, a, b, poseA, poseB, 0, options),
    verify, batch, smooth,
  };
}

// ---- motions

const MOTION = new Set(['duration', 'margin', 'tolerance']), MOVING = new Set(['shape', 'start', 'end']);

function bindMotions(core) {
  const { memory, calls, names } = core, statuses = ['undecided', 'free', 'hit'];

  function ask(call, a, b, options) {
    checkFields(options, MOTION, 'options');
    checkNumbers(options, MOTION, 'options');
    const at = [a, b].map((moving) => (checkFields(moving, MOVING, 'a moving body'), core.addressOf(moving?.shape, 'a moving body')));
    const { duration = 1, margin = 0, tolerance = 0 } = options ?? {};
    memory.set([duration, margin, tolerance, ...[a, b].flatMap((m) => [...toPose(m.start, 'start'), ...toPose(m.end ?? m.start, 'end')])]);
    call(...at);
    return memory.get(8 + 2 * ANSWER);
  }

  // An answer without its proof, which lies in the steps.
  const answerAt = (n, at) => ({ ...new Answer(n.slice(at, at + ANSWER), names) });

  return {
    impact(a, b, options) {
      const n = ask(calls.impact, a, b, options);
      return {
        status: statuses[n[0]], limit: names.limit[n[1]], iterations: n[2], begin: n[3], end: n[4], free_until: n[5], hit_at: n[6],
        steps: n[7], free: answerAt(n, 8), hit: answerAt(n, 8 + ANSWER),
      };
    },
    approach(a, b, options) {
      const n = ask(calls.approach, a, b, options);
      return {
        status: names.status[n[0]], limit: names.limit[n[1]], iterations: n[2], begin: n[3], end: n[4], lower: n[5], upper: n[6],
        time: n[7], answer: answerAt(n, 8),
      };
    },
  };
}
