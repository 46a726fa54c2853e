// Bodies where they are now, and the answers about them: the library, asked live.

// Products and inverses of poses { xyz, quat_wxyz }.
function multiply(p, q) {
  const [a, b, c, d] = p, [w, x, y, z] = q;
  return [a * w - b * x - c * y - d * z, a * x + b * w + c * z - d * y, a * y - b * z + c * w + d * x, a * z + b * y - c * x + d * w];
}
export function turn(q, v) {
  const n = q[0] ** 2 + q[1] ** 2 + q[2] ** 2 + q[3] ** 2, [, x, y, z] = multiply(multiply(q, [0, ...v]), [q[0], -q[1], -q[2], -q[3]]);
  return [x / n, y / n, z / n];
}
export const complete = (pose) => ({ xyz: [...(pose?.xyz ?? [0, 0, 0])], quat_wxyz: [...(pose?.quat_wxyz ?? [1, 0, 0, 0])] });
export function compose(outer, inner) {
  const moved = turn(outer.quat_wxyz, inner.xyz);
  return { xyz: outer.xyz.map((x, i) => x + moved[i]), quat_wxyz: multiply(outer.quat_wxyz, inner.quat_wxyz) };
}

/** A body: parts of shapes, or a solid; a ball around it. */
class Body {
  constructor(model, given, index) {
    this.index = index;
    this.name = given.name;
    this.link = given.link;
    this.isObstacle = given.obstacle === true;
    this.home = complete(given.pose);
    this.pose = complete(given.pose);
    this.parts = given.parts.map(({ shape, pose }) => ({ index: shape, shape: model.shapes[shape], pose: complete(pose) }));
    this.solid = given.solid ? model.ovoid.Solid.fromTriangles(given.solid.points, given.solid.triangles) : null;
    this.mesh = given.solid ?? null;
    this.radius = Math.max(0, ...this.parts.map((p) => Math.hypot(...p.pose.xyz) + p.shape.reach), this.solid ? reachOf(given.solid.points) : 0);
  }

  posesOfParts() {
    return this.parts.map((part) => compose(this.pose, part.pose));
  }
}

function reachOf(points) {
  let most = 0;
  for (let i = 0; i < points.length; i += 3) most = Math.max(most, Math.hypot(points[i], points[i + 1], points[i + 2]));
  return most;
}

function makeShapes(ovoid, list) {
  return list.map(({ bytes, mesh, areas }) => {
    const shape = ovoid.Shape.fromBytes(bytes), { radius, origin, outer, inner, rank } = shape.description;
    const vertices = shape.vertices;
    for (let i = 0; i < vertices.length; i++) vertices[i] += origin[i % 3];
    const move = (e) => ({ ...e, center: e.center.map((x, i) => x + origin[i]) });
    return {
      shape, rank, radius, vertices, triangles: shape.triangles, outer: move(outer), inner: move(inner), mesh, areas,
      reach: reachOf(vertices) + radius,
    };
  });
}

export class Model {
  constructor(ovoid, data) {
    this.ovoid = ovoid;
    this.data = data;
    this.unit = data.unit ?? '';
    this.shapes = makeShapes(ovoid, data.shapes);
    this.bodies = data.bodies.map((body, i) => new Body(this, body, i));
    this.pairs = data.pairs.map(({ a, b, answer }) => ({ a: this.bodies[a], b: this.bodies[b], answer, given: answer, isLive: false }));
    this.byBody = new Map(this.bodies.map((body) => [body, []]));
    for (const pair of this.pairs) for (const body of [pair.a, pair.b]) this.byBody.get(body).push(pair);
  }

  /** The ball around all bodies. */
  get ball() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const { pose, radius } of this.bodies)
      for (let k = 0; k < 3; k++) {
        low[k] = Math.min(low[k], pose.xyz[k] - radius);
        high[k] = Math.max(high[k], pose.xyz[k] + radius);
      }
    if (!this.bodies.length) return { center: [0, 0, 0], radius: 1 };
    return { center: low.map((x, k) => (x + high[k]) / 2), radius: Math.max(1e-12, Math.hypot(...low.map((x, k) => high[k] - x)) / 2) };
  }

  /** The answer for where both bodies are now: of parts the nearest two, with a bracket of all. */
  ask(a, b) {
    if (a.solid || b.solid) return this.#askSolid(a, b);
    const posesA = a.posesOfParts(), posesB = b.posesOfParts();
    let best = null, lower = Infinity;
    const couples = [];
    a.parts.forEach((p, i) =>
      b.parts.forEach((q, k) => {
        const gap = Math.hypot(...posesA[i].xyz.map((x, j) => x - posesB[k].xyz[j])) - p.shape.reach - q.shape.reach;
        couples.push({ i, k, gap });
      }),
    );
    couples.sort((x, y) => x.gap - y.gap);
    for (const { i, k, gap } of couples) {
      if (best && gap > best.upper) {
        lower = Math.min(lower, gap);
        break;
      }
      const answer = this.ovoid.depth(a.parts[i].shape.shape, posesA[i], b.parts[k].shape.shape, posesB[k]);
      lower = Math.min(lower, answer.lower);
      if (!best || answer.upper < best.upper) best = Object.assign(answer, { part_a: i, part_b: k });
    }
    best.lower = Math.min(lower, best.lower);
    return best;
  }

  #askSolid(a, b) {
    const side = (body) => body.solid ?? body.parts[0].shape.shape;
    const pose = (body) => (body.solid ? body.pose : compose(body.pose, body.parts[0].pose));
    const { surfaces, ...answer } = this.ovoid.solids.distance(side(a), pose(a), side(b), pose(b));
    return { ...answer, point_a: surfaces.point_a, point_b: surfaces.point_b, normal: surfaces.normal, stage: 'solid', iterations: surfaces.iterations };
  }

  /** Asks anew about all listed pairs of a body that was moved. */
  refresh(body) {
    for (const pair of this.byBody.get(body)) {
      pair.answer = this.ask(pair.a, pair.b);
      pair.isLive = true;
    }
  }

  /** Puts all bodies back where the data have them. */
  reset() {
    for (const body of this.bodies) body.pose = complete(body.home);
    for (const pair of this.pairs) {
      pair.answer = pair.given;
      pair.isLive = false;
    }
  }

  /** null: the proof holds; a sentence: it does not; undefined with a reason: it cannot be checked here. */
  check(pair) {
    const { a, b, answer } = pair;
    if (a.solid || b.solid || !answer.proof) return { isChecked: false, text: 'Proofs of solids are checked by ovoid verify.' };
    if (a.parts.length > 1 || b.parts.length > 1)
      if (answer.exclusions) return { isChecked: false, text: 'Proofs of compounds are checked by ovoid verify.' };
    const [p, q] = [a.parts[answer.part_a ?? 0], b.parts[answer.part_b ?? 0]];
    const error = this.ovoid.check(p.shape.shape, compose(a.pose, p.pose), q.shape.shape, compose(b.pose, q.pose), answer);
    return { isChecked: true, holds: error === null, text: error ? error.message : 'The proof holds.' };
  }
}
