// A motion: a slider over its times, and the distance of the chosen pair over them, asked live. Between two frames bodies go as
// the tool's --continuous takes them, where it looked there; else the slider goes from frame to frame.
import { findNearest } from './headline.mjs';
import { stepByKeys } from './keys.mjs';
import { element, svg } from './panel.mjs';
import { Player } from './player.mjs';
import { formatLength } from './text.mjs';

const SAMPLES = 240, WIDTH = 600, HEIGHT = 90;

export class Timeline {
  /** A place in the motion is a number: of a frame, or between two. */
  constructor(root, model, onTime) {
    Object.assign(this, { model, motion: model.data.motion, onTime, last: model.data.motion.times.length - 1 });
    const { times, between } = this.motion;
    this.isSmooth = between === true;
    // Where all frames have one time they stand side by side.
    this.axis = times[this.last] > times[0] ? times : times.map((_, i) => i);
    const [begin, end] = [this.axis[0], this.axis[this.last]];
    root.hidden = false;
    this.slider = element('input', { type: 'range', id: 'time', min: begin, max: end, step: 'any', value: begin, 'aria-label': 'time', oninput: () => this.set(this.#findPlace(Number(this.slider.value))) });
    stepByKeys(this.slider, (steps) => this.set(this.isSmooth ? this.#findPlace(this.#timeAt(this.frame) + (steps * (end - begin)) / 100) : this.frame + steps));
    this.label = element('output', { id: 'now' });
    this.player = new Player(end - begin, Math.min(12, Math.max(this.isSmooth ? 4 : 2, this.last / 30)), () => this.#timeAt(this.frame) - begin, (at) => this.#goTo(begin + at));
    this.plot = svg('svg', { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, preserveAspectRatio: 'none', class: 'plot', role: 'img', 'aria-label': 'the distance over time' });
    this.scale = element('div', { className: 'scale' });
    this.caption = element('p', { id: 'legend' });
    root.replaceChildren(element('div', { className: 'row' }, this.player.button, this.slider, this.label), element('div', { className: 'graph' }, this.plot, this.scale), this.caption);
    model.keepRoom(times.length, (i) => this.#follow(i));
    this.set(0);
    this.show(null);
  }

  #timeAt(place) {
    const from = Math.min(Math.floor(place), this.last), { axis } = this, part = place - from;
    return part ? axis[from] + part * (axis[from + 1] - axis[from]) : axis[from];
  }

  // The place of a time; the nearest frame where nothing is known between them.
  #findPlace(time) {
    const { axis, last } = this;
    let low = 0, high = last;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (axis[middle] <= time) low = middle;
      else high = middle;
    }
    const span = axis[high] - axis[low], part = span > 0 ? Math.max(0, Math.min(1, (time - axis[low]) / span)) : 0;
    return this.isSmooth ? low + part : Math.round(low + part * (high - low));
  }

  #goTo(time) {
    const place = this.#findPlace(time);
    if (place !== this.frame) this.set(place);
  }

  #x(time) {
    const { axis, last } = this, span = axis[last] - axis[0];
    return span > 0 ? (WIDTH * (time - axis[0])) / span : 0;
  }

  /** The pose of a body at a place: linear between two frames, turned about one axis, the shorter way round. */
  poseAt(body, place) {
    const from = Math.min(Math.floor(place), this.last), part = place - from, pose = this.#poseIn(body, from);
    return part ? interpolate(pose, this.#poseIn(body, from + 1), part) : pose;
  }

  #poseIn(body, frame) {
    const at = 7 * (frame * this.model.bodies.length + body.index), p = this.motion.poses;
    return { xyz: [p[at], p[at + 1], p[at + 2]], quat_wxyz: [p[at + 3], p[at + 4], p[at + 5], p[at + 6]] };
  }

  #follow(place) {
    for (const body of this.model.bodies) body.pose = this.poseAt(body, place);
  }

  /** Goes to a place. */
  set(place) {
    this.frame = Math.max(0, Math.min(this.last, place));
    this.#follow(this.frame);
    const time = this.#timeAt(this.frame);
    this.slider.value = time;
    this.label.textContent = `t = ${formatLength(this.axis === this.motion.times ? time : this.motion.times[Math.round(this.frame)], '')}`;
    this.cursor?.setAttribute('transform', `translate(${this.#x(time)} 0)`);
    this.onTime();
  }

  toggle() {
    this.player.toggle();
  }

  // The distance of a pair at places over the motion: [time, middle of the bracket].
  #sample({ a, b }) {
    const { last, isSmooth } = this, count = isSmooth ? SAMPLES : Math.min(SAMPLES, last), kept = [a.pose, b.pose];
    const values = Array.from({ length: count + 1 }, (_, i) => {
      const place = isSmooth ? this.#findPlace(this.axis[0] + (i / count) * (this.axis[last] - this.axis[0])) : Math.round((i / count) * last);
      a.pose = this.poseAt(a, place);
      b.pose = this.poseAt(b, place);
      const { lower, upper } = this.model.ask(a, b);
      return [this.#timeAt(place), (lower + upper) / 2];
    });
    [a.pose, b.pose] = kept;
    return values;
  }

  /** The distance of a pair over time, or of the one that comes nearest; margin and events marked. */
  show(chosen) {
    const pair = chosen ?? findNearest(this.model.pairs, ({ given }) => given), { last } = this;
    if (!pair?.a.asked || !pair.b.asked || last < 1) {
      this.cursor = null;
      this.caption.textContent = '';
      this.plot.parentNode.hidden = true;
      return;
    }
    const { a, b } = pair, { margin, events = [] } = this.motion, values = this.#sample(pair), own = chooseEvents(events.filter((e) => [e.a, e.b].includes(a.index) && [e.a, e.b].includes(b.index)));
    const low = Math.min(0, ...values.map((v) => v[1])), high = Math.max(margin ?? 0, 1e-12, ...values.map((v) => v[1]));
    const y = (value) => HEIGHT - 6 - ((HEIGHT - 12) * (value - low)) / (high - low);
    const level = (value, kind) => svg('line', { x1: 0, x2: WIDTH, y1: y(value), y2: y(value), class: kind }), upright = (x, kind) => svg('line', { x1: x, x2: x, y1: 0, y2: HEIGHT, class: kind });
    this.cursor = upright(0, 'cursor');
    this.cursor.setAttribute('transform', `translate(${this.#x(this.#timeAt(this.frame))} 0)`);
    this.plot.parentNode.hidden = false;
    this.plot.replaceChildren(
      level(0, 'zero'), ...(margin ? [level(margin, 'margin')] : []),
      svg('polyline', { points: values.map(([time, value]) => `${this.#x(time)},${y(value)}`).join(' '), class: 'curve' }),
      ...(this.axis === this.motion.times ? own.map((e) => upright(this.#x(e.time), 'event')) : []), this.cursor,
    );
    this.scale.replaceChildren(...[high, low].map((x) => element('span', { textContent: formatLength(x, this.model.unit, 3) })));
    const where = this.isSmooth ? 'over time' : `at ${values.length} of the frames`, marks = [...(margin ? ['dashed: the margin'] : []), ...(own.length ? [`red: ${describeEvents(own, margin)}`] : [])];
    this.caption.textContent = `The distance of ${a.name} and ${b.name} ${where}${marks.length ? `; ${marks.join('; ')}` : ''}.`;
  }
}

// Impacts, which are between frames; where these were not asked about, what was first in a frame.
function chooseEvents(events) {
  const impacts = events.filter(({ kind }) => kind === 'impact' || kind === 'unproven');
  return impacts.length ? impacts : events;
}

// What the red lines of a plot are.
function describeEvents(events, margin) {
  const words = { impact: margin > 0 ? 'they come within the margin' : 'impact', unproven: 'an impact may be here', contact: 'the first contact in a frame', within: 'first within the margin in a frame' };
  return [...new Set(events.map(({ kind }) => words[kind]))].join(', ');
}

/** A pose on the way from one to another. */
function interpolate(from, to, part) {
  const [p, q] = [from, to].map(({ quat_wxyz: r }) => r.map((x) => x / Math.hypot(...r))), dot = p.reduce((sum, x, i) => sum + x * q[i], 0);
  const angle = Math.acos(Math.min(1, Math.abs(dot))), isNear = angle < 1e-9, way = dot < 0 ? -1 : 1;
  const [u, v] = isNear ? [1 - part, part] : [Math.sin((1 - part) * angle) / Math.sin(angle), Math.sin(part * angle) / Math.sin(angle)];
  return { xyz: from.xyz.map((x, i) => x + part * (to.xyz[i] - x)), quat_wxyz: p.map((x, i) => u * x + way * v * q[i]) };
}
