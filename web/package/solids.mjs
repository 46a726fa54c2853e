// Solids of triangles, convex or not.
import { OvoidError } from './memory.mjs';
import { Answer, ANSWER, fromAnswer, PROOF, toPose } from './values.mjs';

const HEAD = 12;

export function bindSolids(core) {
  const { memory, calls, names, Shape } = core;
  const secret = Symbol('solid');

  class Solid {
    #address;

    constructor(given, address) {
      if (given !== secret) throw new TypeError('a solid is made by Solid.fromTriangles');
      this.#address = address;
      core.hold(this, calls.solid_destroy, address);
    }

    static fromTriangles(points, triangles) {
      const xyz = Float64Array.from(points.flat ? points.flat() : points), corners = Uint32Array.from(triangles.flat ? triangles.flat() : triangles);
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
      core.drop(this);
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
  }

  const kinds = (a, b) => {
    for (const body of [a, b]) if (!(body instanceof Solid) && !(body instanceof Shape)) throw new TypeError('a Solid or a Shape is needed');
    return (a instanceof Solid ? 1 : 0) | (b instanceof Solid ? 2 : 0);
  };

  function query(kind, a, poseA, b, poseB, margin, options) {
    const solids = kinds(a, b), { absoluteTolerance = 0, relativeTolerance = 0, cap = 0, proof = false } = options ?? {};
    memory.set([...toPose(poseA, 'poseA'), ...toPose(poseB, 'poseB'), margin, absoluteTolerance, relativeTolerance, cap]);
    calls.solid_query(kind, solids | (proof ? 4 : 0), a.address, b.address);
    const n = memory.get(HEAD + ANSWER + PROOF);
    const answer = {
      status: names.status[n[0]], limit: names.limit[n[1]], lower: n[2], upper: n[3], parting: n.slice(4, 7), inside: [null, 'a', 'b'][n[7]],
      component: n[8], triangle_a: n[9], triangle_b: n[10], surfaces: new Answer(n.slice(HEAD), names),
    };
    if (proof) answer.exclusions = memory.take(Uint8Array, calls.get_exclusions(), n[11] * calls.get_exclusion_size());
    return answer;
  }

  function checkSolids(a, poseA, b, poseB, answer) {
    if (!answer.exclusions) throw new TypeError('the answer has no exclusions: ask with { proof: true }');
    const size = calls.get_exclusion_size(), at = calls.set_exclusions(answer.exclusions.length / size);
    if (!at && answer.exclusions.length) throw new OvoidError(1, -1, 'out of memory');
    new Uint8Array(memory.exports.memory.buffer).set(answer.exclusions, at);
    memory.set([
      ...toPose(poseA, 'poseA'), ...toPose(poseB, 'poseB'), names.number('status', answer.status), names.number('limit', answer.limit),
      answer.lower, answer.upper, ...answer.parting, [null, 'a', 'b'].indexOf(answer.inside), answer.component, answer.triangle_a,
      answer.triangle_b, 0, ...fromAnswer(answer.surfaces, names),
    ]);
    return calls.solid_check(kinds(a, b), a.address, b.address) ? memory.error() : null;
  }

  return {
    Solid,
    solids: {
      collide: (a, poseA, b, poseB, options) => query(0, a, poseA, b, poseB, 0, options),
      within: (a, poseA, b, poseB, margin, options) => query(1, a, poseA, b, poseB, margin, options),
      distance: (a, poseA, b, poseB, options) => query(2, a, poseA, b, poseB, 0, options),
      check: checkSolids,
    },
  };
}
