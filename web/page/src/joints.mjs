// A robot: a slider for each joint; links follow, and the near pairs are asked live.
import { element, formatLength } from './panel.mjs';

export class Joints {
  constructor(root, model, onMove) {
    const { robot: given, shapes } = model.data;
    this.model = model;
    this.onMove = onMove;
    this.robot = new model.ovoid.Robot({ ...given, elements: given.elements.map((e) => ({ ...e, shape: model.shapes[e.shape].shape })) });
    this.links = new Map(given.links.map((name, i) => [name, i]));
    this.obstacles = new Map((given.obstacles ?? []).map(({ name, shape, pose }) => [this.robot.add(model.shapes[shape].shape, pose), name]));
    this.states = given.states ?? [];
    this.q = [...(this.states[0] ?? new Array(this.robot.variableCount).fill(0))];
    this.margin = model.data.margin ?? model.ball.radius / 5;
    root.hidden = false;
    root.replaceChildren(...this.#states(), ...this.#sliders(given), (this.verdict = element('p', { id: 'verdict', role: 'status' })));
    this.move();
  }

  #states() {
    if (this.states.length < 2) return [];
    const slider = element('input', {
      type: 'range', id: 'state', min: 0, max: this.states.length - 1, step: 1, value: 0, 'aria-label': 'state',
      oninput: () => {
        this.q = [...this.states[slider.value]];
        this.inputs.forEach(({ input, at }) => (input.value = this.q[at]));
        this.move();
      },
    });
    return [element('label', { className: 'row' }, element('span', { textContent: `state of ${this.states.length}` }), slider)];
  }

  #sliders({ joints }) {
    this.inputs = [];
    let at = 0;
    const rows = [];
    for (const joint of joints) {
      if (joint.mimic) continue;
      const count = { revolute: 1, continuous: 1, prismatic: 1, planar: 3, floating: 7 }[joint.type] ?? 0;
      if (count === 1) {
        const isFree = joint.type === 'continuous', place = at;
        const input = element('input', {
          type: 'range', min: isFree ? -Math.PI : joint.lower, max: isFree ? Math.PI : joint.upper, step: 'any', value: this.q[place], 'aria-label': joint.name,
          oninput: () => {
            this.q[place] = Number(input.value);
            this.move();
          },
        });
        input.value = this.q[place];
        this.inputs.push({ input, at: place });
        rows.push(element('label', { className: 'row' }, element('span', { textContent: joint.name }), input));
      }
      at += count;
    }
    return rows;
  }

  move() {
    const poses = this.robot.poses(this.q);
    for (const body of this.model.bodies) if (body.link !== undefined) body.pose = poses[this.links.get(body.link)];
    const near = this.robot.near(this.q, this.margin), byName = new Map(this.model.bodies.map((body) => [body.name, body]));
    const find = (side) => byName.get(side.link ?? this.obstacles.get(side.obstacle));
    const best = new Map();
    for (const { a, b, ...answer } of near) {
      const pair = { a: find(a), b: find(b), answer: { ...answer, stage: 'robot' }, isLive: true };
      const key = `${pair.a.index} ${pair.b.index}`;
      if (!best.has(key)) best.set(key, pair);
    }
    this.model.pairs = [...best.values()];
    this.model.byBody = new Map(this.model.bodies.map((body) => [body, this.model.pairs.filter((p) => p.a === body || p.b === body)]));
    const { status } = this.robot.collide(this.q);
    this.verdict.textContent = status === 'free' ? `free; nearest ${near.length ? formatLength(near[0].lower, this.model.unit) : `beyond ${formatLength(this.margin, this.model.unit)}`}` : status;
    this.verdict.className = status;
    this.onMove();
  }
}
