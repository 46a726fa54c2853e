// Bodies where they are now, and the answers about them: the library, asked live.

const complete = (pose) => ({ xyz: [...(pose?.xyz ?? [0, 0, 0])], quat_wxyz: [...(pose?.quat_wxyz ?? [1, 0, 0, 0])] });

/** A body: a shape, several as a compound, or a solid; a ball around it. */
class Body {
  constructor(model, given, index) {
    this.index = index;
    this.name = given.name;
    this.wholeName = given.wholeName;
    this.link = given.link;
    // Of a robot: what it is in answers, and where it is in its link's frame.
    this.key = given.key;
    this.at = given.at && complete(given.at);
    this.isObstacle = given.obstacle === true;
    this.home = complete(given.pose);
    this.pose = complete(given.pose);
    this.parts = given.parts.map(({ shape, pose }) => ({ index: shape, shape: model.shapes[shape], pose: complete(pose) }));
    // The triangles of its one shape are the body, not their hull.
    this.isSolid = given.solid === true;
    this.isShape = given.parts.length === 1 && !given.parts[0].pose;
    const { middle, radius } = makeBall(this.parts.map(({ pose, shape }) => ({ middle: move(pose, shape.ball.middle), radius: shape.ball.radius })));
    Object.assign(this, { middle, radius });
    this.#model = model;
  }

  #model;
  #asked;

  /** The middle of the ball around it, where it is now. */
  get center() {
    return move(this.pose, this.middle);
  }

  /** What the library is asked about, made when it first is; null: the page has not got it. */
  get asked() {
    this.#asked ??= this.#make();
    return this.#asked;
  }

  #make() {
    if (this.isSolid) return this.parts[0].shape.solid;
    if (this.isShape) return this.parts[0].shape.shape;
    return new this.#model.ovoid.Compound(this.parts.map(({ shape, pose }) => ({ shape: shape.shape, pose })));
  }
}

// The ball around a box of balls { middle, radius }, about the box's middle.
function makeBall(balls) {
  const [low, high] = [-1, 1].map((sign) => [0, 1, 2].map((k) => sign * balls.reduce((most, b) => Math.max(most, sign * b.middle[k] + b.radius), -Infinity)));
  const middle = low.map((x, k) => (x + high[k]) / 2);
  return { middle, radius: balls.reduce((most, b) => Math.max(most, Math.hypot(...b.middle.map((x, k) => x - middle[k])) + b.radius), 0) };
}

// The ball around points, about the middle of their box.
function makeBallOfPoints(points) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i++) {
    low[i % 3] = Math.min(low[i % 3], points[i]);
    high[i % 3] = Math.max(high[i % 3], points[i]);
  }
  const middle = low.map((x, k) => (x + high[k]) / 2);
  let most = 0;
  for (let i = 0; i < points.length; i += 3) most = Math.max(most, (points[i] - middle[0]) ** 2 + (points[i + 1] - middle[1]) ** 2 + (points[i + 2] - middle[2]) ** 2);
  return { middle, radius: Math.sqrt(most) };
}

// Where a pose moves a point.
function move({ xyz, quat_wxyz: [w, x, y, z] }, [a, b, c]) {
  const s = 2 / (w * w + x * x + y * y + z * z), u = y * c - z * b, v = z * a - x * c, t = x * b - y * a;
  return [xyz[0] + a + s * (w * u + y * t - z * v), xyz[1] + b + s * (w * v + z * u - x * t), xyz[2] + c + s * (w * t + x * v - y * u)];
}

/** A pose in the frame of another one, in the frame of that. */
export function compose(outer, inner) {
  const [w, x, y, z] = outer.quat_wxyz, [a, b, c, d] = inner.quat_wxyz;
  const quat_wxyz = [w * a - x * b - y * c - z * d, w * b + x * a + y * d - z * c, w * c - x * d + y * a + z * b, w * d + x * c - y * b + z * a];
  return { xyz: move(outer, inner.xyz), quat_wxyz };
}

/** A shape of the page, with what is drawn of it; a mesh that counts with its dents is a solid of the library. */
class PageShape {
  #ovoid;
  #solid;

  constructor(ovoid, { bytes, mesh, solid, areas }) {
    this.#ovoid = ovoid;
    this.shape = ovoid.Shape.fromBytes(bytes);
    const { radius, origin, outer, inner, rank } = this.shape.description, shift = (e) => ({ ...e, center: e.center.map((x, i) => x + origin[i]) });
    this.vertices = this.shape.vertices;
    for (let i = 0; i < this.vertices.length; i++) this.vertices[i] += origin[i % 3];
    Object.assign(this, { rank, radius, triangles: this.shape.triangles, outer: shift(outer), inner: shift(inner), mesh: mesh ?? solid, triangulation: solid, areas });
    const ball = makeBallOfPoints(this.vertices);
    this.ball = { middle: ball.middle, radius: ball.radius + radius };
  }

  /** Made when it is first asked about; null: the page has not got its triangles. */
  get solid() {
    if (this.triangulation) this.#solid ??= this.#ovoid.Solid.fromTriangles(this.triangulation.points, this.triangulation.triangles);
    return this.#solid ?? null;
  }
}

/** Of more points a picture of all goes by the balls of bodies. */
const MOST_POINTS = 50000;
/** Of how many times or states a picture of all has room for the bodies. */
const PLACES = 16;

/** In the place of an answer, of bodies that moved and are not on the page. */
const UNKNOWN = { status: 'undecided', lower: -Infinity, upper: Infinity, stage: 'none' };

export class Model {
  constructor(ovoid, data) {
    this.ovoid = ovoid;
    this.data = data;
    this.unit = data.unit ?? '';
    this.shapes = data.shapes.map((shape) => new PageShape(ovoid, shape));
    this.bodies = data.bodies.map((body, i) => new Body(this, body, i));
    this.pairs = data.pairs.map(({ a, b, answer, frame }) => ({ a: this.bodies[a], b: this.bodies[b], answer, given: answer, frame, isLive: false }));
    // The options of contacts, where the command was asked for them.
    const asked = data.pairs.find(({ answer }) => answer.contact_margin !== undefined)?.answer;
    this.contactOptions = asked && { margin: asked.contact_margin, angle: asked.contact_angle };
    this.byBody = new Map(this.bodies.map((body) => [body, []]));
    for (const pair of this.pairs) for (const body of [pair.a, pair.b]) this.byBody.get(body).push(pair);
    // Balls where bodies are at other times or in other states: a picture of all has room for them.
    this.room = [];
  }

  /** Adds to the room where bodies are at some of `count` times or states; go(i) puts them where they are at the i-th. */
  keepRoom(count, go) {
    const most = Math.min(count, PLACES);
    for (let i = 0; i < most; i++) {
      go(most > 1 ? Math.round((i * (count - 1)) / (most - 1)) : 0);
      const balls = this.listBalls();
      this.room.push(...(PLACES * balls.length > MOST_POINTS ? this.bodies : balls).map(({ center, radius }) => ({ center, radius })));
    }
  }

  /** The ball around all bodies. */
  get ball() {
    return this.#ballAround(this.bodies);
  }
  /** The same with the room for other times and states. */
  get roomBall() {
    return this.#ballAround([...this.bodies, ...this.room]);
  }

  #ballAround(balls) {
    if (!balls.length) return { center: [0, 0, 0], radius: 1 };
    const { middle, radius } = makeBall(balls.map((ball) => ({ middle: ball.center, radius: ball.radius })));
    return { center: middle, radius: Math.max(1e-12, radius) };
  }

  /** Small balls around all that is drawn: points of hulls, or where these are many the bodies' balls. */
  listBalls() {
    const count = this.bodies.reduce((n, { parts }) => n + parts.reduce((m, { shape }) => m + shape.vertices.length / 3, 0), 0);
    if (count > MOST_POINTS) return this.bodies;
    return this.bodies.flatMap(({ pose, parts }) => parts.flatMap(({ pose: own, shape: { vertices, radius } }) => {
      const at = compose(pose, own);
      return Array.from({ length: vertices.length / 3 }, (_, i) => ({ center: move(at, vertices.subarray(3 * i, 3 * i + 3)), radius }));
    }));
  }

  /** The answer for where both bodies are now; null: the page has not got them. */
  ask(a, b) {
    if (!a.asked || !b.asked) return null;
    const hasSolid = a.isSolid || b.isSolid, answer = this.ovoid[hasSolid ? 'distance' : 'depth'](a.asked, b.asked, a.pose, b.pose);
    if (this.contactOptions && !hasSolid) answer.contacts = this.ovoid.findManifolds(a.asked, b.asked, a.pose, b.pose, this.contactOptions);
    return answer;
  }

  /** What is drawn of an answer's contacts: all corners of each polygon, and its points, between both bodies. */
  listContacts({ a, b }, answer) {
    if (!answer?.contacts || !a.asked || !b.asked) return [];
    const between = ({ point_a: p, point_b: q }) => p.map((x, k) => (x + q[k]) / 2), radius = Math.min(a.radius, b.radius);
    return answer.contacts.map((contact) => {
      const { points } = this.ovoid.computePolygon(a.asked, b.asked, a.pose, b.pose, contact, this.contactOptions);
      return { corners: points.map(between), points: contact.points.map(between), normal: contact.normal, radius };
    });
  }

  askAgain(pair) {
    pair.answer = this.ask(pair.a, pair.b) ?? UNKNOWN;
    pair.isLive = true;
  }

  /** Asks anew about all listed pairs of a body that was moved. */
  refresh(body) {
    for (const pair of this.byBody.get(body)) this.askAgain(pair);
  }

  /** Puts all bodies back where the data have them. */
  reset() {
    for (const body of this.bodies) body.pose = complete(body.home);
    for (const pair of this.pairs) {
      pair.answer = pair.given;
      pair.isLive = false;
    }
  }

  /** Whether the proof of a pair's answer holds, in words; isVerified false: that cannot be checked here. */
  verify(pair) {
    const { a, b } = pair;
    if (!a.asked || !b.asked) return { isVerified: false, text: 'The triangles are too many for the page: ovoid verify checks this proof.' };
    // What is near a robot comes without proofs, and those that were too many for the page.
    if (!pair.answer.proof) this.askAgain(pair);
    const error = this.ovoid.verify(a.asked, b.asked, a.pose, b.pose, pair.answer);
    if (error) return { isVerified: true, holds: false, text: error.message };
    const contacts = pair.answer.contacts ?? [], wrong = contacts.map((m) => this.ovoid.verifyManifold(a.asked, b.asked, a.pose, b.pose, m, this.contactOptions)).find(Boolean);
    const text = contacts.length ? `The proof holds, and that of ${contacts.length === 1 ? 'the contact' : `${contacts.length} contacts`}.` : 'The proof holds.';
    return { isVerified: true, holds: !wrong, text: wrong ? `A contact: ${wrong.message}` : text };
  }
}
