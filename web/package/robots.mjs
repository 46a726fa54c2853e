// Robots: a model from links, joints and shapes, where its links are, what is near.
import { toPose, toVector } from './values.mjs';
import { checkFields, suggest } from './words.mjs';

const TYPES = ['fixed', 'revolute', 'continuous', 'prismatic', 'planar', 'floating'];
const STATES = ['undecided', 'free', 'hit', 'refused'];
const NEAR = 20;
const ROBOT = new Set(['links', 'joints', 'elements', 'disabled']), ELEMENT = new Set(['link', 'shape', 'solid', 'pose']);
const JOINT = new Set(['name', 'type', 'parent', 'child', 'origin', 'axis', 'lower', 'upper', 'velocity', 'mimic']), MIMIC = new Set(['joint', 'multiplier', 'offset']);

function toModel(description) {
  checkFields(description, ROBOT, 'a robot');
  const { links, joints, elements = [], disabled = [] } = description;
  const index = new Map(links.map((name, i) => [name, i])), places = new Map(joints.map((j, i) => [j.name, i]));
  const link = (name) => {
    if (!index.has(name)) throw new TypeError(`no such link: ${name}${suggest(String(name), links)}`);
    return index.get(name);
  };
  for (const e of elements) checkFields(e, ELEMENT, `an element of ${e.link}`);
  const rows = joints.flatMap((j) => {
    checkFields(j, JOINT, `joint ${j.name}`);
    checkFields(j.mimic, MIMIC, `joint ${j.name}: mimic`);
    const type = TYPES.indexOf(j.type);
    if (type < 0) throw new TypeError(`joint ${j.name}: no such type: ${j.type}${suggest(String(j.type), TYPES)}`);
    if (j.mimic && !places.has(j.mimic.joint)) throw new TypeError(`joint ${j.name}: no such joint to mimic: ${j.mimic.joint}`);
    return [
      type, link(j.parent), link(j.child), ...toPose(j.origin, `joint ${j.name}`), ...toVector(j.axis ?? [1, 0, 0], `joint ${j.name}: axis`),
      j.lower ?? 0, j.upper ?? 0, j.velocity ?? 0, j.mimic ? places.get(j.mimic.joint) : -1, j.mimic?.multiplier ?? 1, j.mimic?.offset ?? 0,
    ];
  });
  return {
    counts: Uint32Array.of(links.length, joints.length, elements.length, disabled.length),
    names: new TextEncoder().encode([...links, ...joints.map((j) => j.name)].map((name) => `${name}\0`).join('')),
    joints: Float64Array.from(rows),
    elements: Float64Array.from(elements.flatMap((e) => [link(e.link), ...toPose(e.pose, `an element of ${e.link}`)])),
    shapes: Uint32Array.from(elements.flatMap((e) => [e.shape.address, e.solid?.address ?? 0])),
    disabled: Uint32Array.from(disabled.flatMap(([a, b]) => [link(a), link(b)])),
  };
}

export function bindRobots(core) {
  const { memory, calls, names, kindOf, Shape, Solid } = core, codes = (i) => memory.text(calls.get_code_name(i));

  /** A robot among obstacles. */
  class Robot {
    #robot;
    #cell;
    #checker;

    constructor(given) {
      const elements = (given.elements ?? []).map((e) => (e.shape instanceof Solid ? { ...e, shape: Shape.hullOf(e.shape), solid: e.shape } : e));
      for (const { link, shape, solid } of elements) {
        core.addressOf(shape, `an element of ${link}`);
        if (solid && !(solid instanceof Solid)) throw new TypeError(`an element of ${link}: solid: a Solid is needed`);
      }
      const description = { ...given, elements }, m = toModel(description);
      this.description = description;
      this.#robot = memory.with([m.counts, m.names, m.joints, m.elements, m.shapes, m.disabled], calls.robot_create);
      if (!this.#robot) throw memory.error();
      this.#cell = calls.cell_create(this.#robot);
      this.#checker = this.#cell && calls.checker_create(this.#cell);
      this.variableCount = calls.robot_get_variable_count(this.#robot);
      this.obstacles = new Map();
      if (!this.#checker) {
        const error = memory.error();
        this.free();
        throw error;
      }
    }

    free() {
      if (this.#checker) calls.checker_destroy(this.#checker);
      if (this.#cell) calls.cell_destroy(this.#cell);
      if (this.#robot) calls.robot_destroy(this.#robot);
      this.#checker = this.#cell = this.#robot = 0;
    }

    /** The cell, where the robot was not freed. */
    get #open() {
      if (!this.#robot) throw new TypeError('the robot was freed');
      return this.#cell;
    }

    #state(q) {
      if (this.#open && q.length !== this.variableCount) throw new TypeError(`q: ${this.variableCount} numbers are needed, not ${q.length}`);
      return Float64Array.from(q);
    }

    /** A pose { xyz, quat_wxyz } of each link, in the root link's frame. */
    poses(q) {
      const state = this.#state(q), out = new Float64Array(7 * this.description.links.length);
      return memory.with([state, out], (s, o) => {
        if (calls.robot_compute_poses(this.#robot, s, o)) throw memory.error();
        const n = memory.take(Float64Array, o, out.length);
        return this.description.links.map((_, i) => ({ xyz: [...n.slice(7 * i, 7 * i + 3)], quat_wxyz: [...n.slice(7 * i + 3, 7 * i + 7)] }));
      });
    }

    #link(name) {
      const i = this.description.links.indexOf(name);
      if (i < 0) throw new TypeError(`no such link: ${name}`);
      return i;
    }

    #keep(id, body) {
      if (!id) throw memory.error();
      this.obstacles.set(id, body);
      return id;
    }

    /** Adds an obstacle; its number. */
    add(body, pose) {
      memory.set(toPose(pose));
      return this.#keep(calls.cell_add(this.#open, kindOf(body), body.address), body);
    }

    /** Attaches a body to a link, in whose frame its pose is; its number. It may touch this link and those of touching. */
    attach(link, body, pose, touching = []) {
      const at = this.#link(link), list = Uint32Array.from(touching, (name) => this.#link(name));
      memory.set(toPose(pose));
      return this.#keep(memory.with([list], (t) => calls.cell_attach(this.#open, at, kindOf(body), body.address, t, list.length)), body);
    }

    /** Lets two links touch, or takes that back. */
    allow(a, b, allowed = true) {
      if (calls.cell_set_allowed(this.#open, this.#link(a), this.#link(b), allowed ? 1 : 0)) throw memory.error();
    }
    /** Lets an obstacle or an attached body touch a link, or takes that back. */
    allowBody(id, link, allowed = true) {
      if (calls.cell_set_body_allowed(this.#open, id, this.#link(link), allowed ? 1 : 0)) throw memory.error();
    }
    /** Enlarges a link, with what is attached to it, against obstacles. */
    setPadding(link, padding) {
      if (calls.cell_set_padding(this.#open, this.#link(link), padding)) throw memory.error();
    }

    move(id, pose) {
      memory.set(toPose(pose));
      if (calls.cell_move(this.#open, id)) throw memory.error();
    }
    remove(id) {
      if (calls.cell_remove(this.#open, id)) throw memory.error();
      this.obstacles.delete(id);
    }

    #side(n) {
      return { link: n[0] < 0 ? null : this.description.links[n[0]], element: n[1] < 0 ? null : n[1], obstacle: n[2] || null, part: n[3] };
    }

    /** Is the state free by a margin? One with variables outside their limits by more than limitSlack is refused. */
    collide(q, margin = 0, limitSlack = Infinity) {
      return memory.with([this.#state(q)], (s) => {
        memory.set([margin, limitSlack]);
        if (calls.checker_collide(this.#checker, s)) throw memory.error();
        const n = memory.get(14), status = STATES[n[0]];
        if (status === 'refused') return { status, code: codes(n[1]), variable: n[2] };
        if (!n[3]) return status === 'free' ? { status } : { status, code: codes(n[1]) };
        return { status, a: this.#side(n.slice(4, 8)), b: this.#side(n.slice(8, 12)), lower: n[12], upper: n[13] };
      });
    }

    /** The pairs that are not proven farther apart than the margin, nearest first. */
    near(q, margin, most = 1000) {
      return memory.with([this.#state(q), new Float64Array(NEAR * most)], (s, o) => {
        memory.set([margin]);
        if (calls.checker_find_near(this.#checker, s, o, most)) throw memory.error();
        const count = memory.get(1)[0], n = memory.take(Float64Array, o, NEAR * Math.min(count, most));
        return Array.from({ length: Math.min(count, most) }, (_, i) => {
          const x = [...n.slice(NEAR * i, NEAR * (i + 1))];
          return {
            a: this.#side(x.slice(0, 4)), b: this.#side(x.slice(4, 8)), status: names.status[x[8]], lower: x[9], upper: x[10],
            point_a: x.slice(11, 14), point_b: x.slice(14, 17), normal: x.slice(17, 20),
          };
        });
      });
    }
  }
  return { Robot };
}
