// A robot: a slider for each joint; links follow, what is near is asked live, and so is whether the state is free.
import { sideKey } from './data.mjs';
import { compose } from './model.mjs';
import { element } from './panel.mjs';
import { stepByKeys } from './keys.mjs';
import { describeAnswer, describeBracket, formatLength, shorten } from './text.mjs';

const COUNTS = { revolute: 1, continuous: 1, prismatic: 1, planar: 3, floating: 7 };
const format = (x) => String(Number(x.toPrecision(6)));
/** The same in a narrow field. */
const formatShort = (x) => String(Number(Math.abs(x) < 0.01 ? x.toPrecision(2) : x.toFixed(4)));
/** By how much an arrow key moves a joint: radians, metres. */
const STEP = 0.01;
/** Of more joints each has one row. */
const FEW = 4;

export class Joints {
  constructor(root, model, onMove) {
    const { robot: given } = model.data;
    this.model = model;
    this.given = given;
    this.onMove = onMove;
    this.#make();
    this.byKey = new Map(model.bodies.map((body) => [body.key, body]));
    this.q = [...(given.states?.[0] ?? new Array(this.robot.variableCount).fill(0))];
    this.margin = model.data.margin ?? 0;
    this.shown = Math.max(this.margin, Number((model.ball.radius / 5).toPrecision(1)));
    // What is farther apart than is listed.
    model.farther = `farther apart than ${formatLength(this.shown, model.unit, 15)}`;
    this.verdict = element('p', { id: 'verdict', role: 'status' });
    const states = given.states ?? [];
    model.keepRoom(states.length, (i) => this.#follow(states[i]));
    root.hidden = false;
    root.replaceChildren(this.verdict, ...this.#sliders(given));
    root.classList.toggle('narrow', this.inputs.length > FEW);
    this.move();
  }

  // Puts the bodies of links where a state has them.
  #follow(q) {
    const poses = this.robot.poses(q);
    for (const body of this.model.bodies) if (body.link !== undefined) body.pose = compose(poses[this.links.get(body.link)], body.at);
  }

  // The robot as the tool asked about it.
  #make() {
    const { elements, held = [], obstacles = [], paddings = [] } = this.given;
    const shape = (e) => this.model.shapes[e.shape].shape, solid = (e) => (e.solid ? this.model.shapes[e.shape].solid : null);
    this.robot = new this.model.ovoid.Robot({ links: this.given.links, joints: this.given.joints, disabled: this.given.disabled, elements: elements.map((e) => ({ link: e.link, pose: e.pose, shape: shape(e), solid: solid(e) })) });
    this.links = new Map(this.given.links.map((name, i) => [name, i]));
    this.ids = new Map();
    for (const h of held) this.ids.set(this.robot.attach(h.link, solid(h) ?? shape(h), h.pose, h.touching), h.key);
    for (const o of obstacles) {
      const id = this.robot.add(solid(o) ?? shape(o), o.pose);
      this.ids.set(id, o.key);
      for (const link of o.touching) this.robot.allowBody(id, link);
    }
    for (const [link, padding] of paddings) this.robot.setPadding(link, padding);
    this.hulls = [...elements, ...held, ...obstacles].filter((e) => e.solid && !solid(e)).length;
  }

  /** The body of a side that the package names. */
  find({ element, obstacle }) {
    return this.byKey.get(obstacle === null ? this.given.elements[element].key : this.ids.get(obstacle));
  }
  /** The body of a side that the tool named. */
  findTold(side) {
    return this.byKey.get(sideKey(side));
  }

  #sliders({ joints }) {
    this.inputs = [];
    let at = 0;
    const rows = [];
    for (const joint of joints) {
      if (joint.mimic) continue;
      const count = COUNTS[joint.type] ?? 0;
      if (count === 1) rows.push(this.#slider(joint, at));
      at += count;
    }
    return rows;
  }

  #slider(joint, at) {
    const isFree = joint.type === 'continuous', given = (this.given.states ?? []).map((q) => q[at]);
    const limits = isFree ? [-Math.PI, Math.PI] : [joint.lower, joint.upper], unit = joint.type === 'prismatic' ? this.model.unit : 'rad';
    // A state outside the limits is shown where it is.
    const min = given.reduce((x, y) => Math.min(x, y), limits[0]), max = given.reduce((x, y) => Math.max(x, y), limits[1]);
    const name = shorten(joint.name, 60), row = element('div', { className: 'joint' }), angle = element('span', { className: 'soft' });
    const take = (value) => {
      this.q[at] = value;
      this.onChange?.();
      this.move();
    };
    const range = `${Number(limits[0].toFixed(4))} to ${Number(limits[1].toFixed(4))} ${unit}${isFree ? ', without limits' : ''}`;
    let isTyping = false;
    const input = element('input', { type: 'range', min, max, step: 'any', 'aria-label': joint.name.length > 60 ? name : joint.name, title: range, oninput: () => take(Number(input.value)) });
    const number = element('input', { type: 'text', inputMode: 'decimal', className: 'value', 'aria-label': `${name}, ${unit || 'length'}`, title: range, oninput: () => (isTyping = true), onblur: () => (isTyping = false), onchange: () => {
      isTyping = false;
      const value = Number(number.value.replace(',', '.'));
      if (number.value.trim() && Number.isFinite(value)) take(value);
      else this.inputs.forEach((show) => show());
    } });
    for (const node of [input, number]) stepByKeys(node, (steps) => take(Math.max(min, Math.min(max, this.q[at] + steps * STEP))));
    const end = (x) => element('span', { className: 'soft', textContent: Number(x.toFixed(2)) });
    row.append(
      element('span', { className: 'name', textContent: shorten(name, 15), title: `${name}: ${range}` }), number, element('span', { textContent: unit }), angle,
      element('div', { className: 'row' }, end(min), input, end(max)),
    );
    const show = () => {
      input.value = this.q[at];
      if (!isTyping) number.value = formatShort(this.q[at]);
      angle.textContent = unit === 'rad' ? `${((180 * this.q[at]) / Math.PI).toFixed(1)}°` : '';
      row.classList.toggle('outside', !isFree && (this.q[at] < joint.lower || this.q[at] > joint.upper));
    };
    this.inputs.push(show);
    return row;
  }

  /** Goes to a state. */
  set(q) {
    this.q = [...q];
    this.move();
  }

  /** Obstacles go where the data have them. */
  reset() {
    const { held = [], obstacles = [] } = this.given, homes = new Map([...held, ...obstacles].map((o) => [o.key, o.pose]));
    for (const [id, key] of this.ids) this.robot.move(id, homes.get(key));
    this.move();
  }

  /** An obstacle was moved by hand. */
  place(body) {
    for (const [id, key] of this.ids) if (key === body.key) this.robot.move(id, body.pose);
    this.onChange?.();
    this.move();
  }

  move() {
    this.#follow(this.q);
    this.inputs.forEach((show) => show());
    const near = this.robot.near(this.q, this.shown, 1000, Infinity);
    this.model.pairs = near.map(({ a, b, ...answer }) => ({ a: this.find(a), b: this.find(b), answer: { ...answer, stage: 'robot' }, isLive: true }));
    this.model.byBody = new Map(this.model.bodies.map((body) => [body, this.model.pairs.filter((p) => p.a === body || p.b === body)]));
    this.answer = this.robot.collide(this.q, this.margin, this.given.limit_slack ?? 0);
    this.verdict.textContent = `This state: ${this.describe(this.answer)}`;
    this.verdict.className = this.answer.status;
    this.onMove();
  }

  /** The answer to the state that is shown, in words; of the pair that it names the listed bracket, which is narrower. */
  describe({ status, a, b, code, variable, ...bracket }) {
    const { unit, pairs } = this.model, hulls = this.hulls ? ` (${this.hulls} bodies count as their hulls here: their triangles are too many for the page)` : '';
    const nearest = pairs.reduce((best, pair) => (best && best.answer.lower <= pair.answer.lower ? best : pair), null), say = (p, q, found) => `${p.name} and ${q.name} ${found.stage ? describeAnswer(found, unit) : describeBracket(found, unit)}`;
    if (status === 'free') return `free; ${nearest ? `nearest: ${say(nearest.a, nearest.b, nearest.answer)}` : `all are ${this.model.farther}`}${hulls}`;
    if (status === 'refused') return `refused: ${this.describeVariable(variable)}${code === 'out of range' ? '' : `: ${code}`}`;
    if (!a) return `${status}: nothing is compared`;
    const [p, q] = [this.find(a), this.find(b)], listed = pairs.find((pair) => (pair.a === p && pair.b === q) || (pair.a === q && pair.b === p));
    return `${status}: ${say(p, q, listed?.answer ?? bracket)}${hulls}`;
  }

  /** A variable with its value and its limits. */
  describeVariable(variable, q = this.q) {
    let at = 0;
    for (const joint of this.given.joints) {
      const count = joint.mimic ? 0 : COUNTS[joint.type] ?? 0;
      if (variable < at + count) {
        const isLimited = joint.type === 'revolute' || joint.type === 'prismatic', isOutside = isLimited && (q[at] < joint.lower || q[at] > joint.upper);
        return `${shorten(this.given.variables[variable])} ${format(q[variable])}${isOutside ? ` is outside its limits, ${format(joint.lower)} to ${format(joint.upper)}` : ''}`;
      }
      at += count;
    }
    return String(variable);
  }
}
