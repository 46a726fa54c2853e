// A motion: a slider over its times, and the distance of the chosen pair over them, asked live.
import { element, svg } from './panel.mjs';
import { formatLength } from './text.mjs';
import { findNearest } from './headline.mjs';
import { Player } from './player.mjs';

const SAMPLES = 240;

export class Timeline {
  constructor(root, model, onTime) {
    this.model = model;
    this.motion = model.data.motion;
    this.onTime = onTime;
    root.hidden = false;
    this.slider = element('input', { type: 'range', id: 'time', min: 0, max: this.motion.times.length - 1, step: 1, value: 0, 'aria-label': 'time', oninput: () => this.set(Number(this.slider.value)) });
    this.label = element('output', { id: 'now' });
    const last = this.motion.times.length - 1;
    this.player = new Player(last, Math.min(12, Math.max(2, last / 30)), () => this.frame, (at) => Math.round(at) !== this.frame && this.set(Math.min(last, Math.round(at))));
    this.plot = svg('svg', { viewBox: '0 0 600 90', preserveAspectRatio: 'none', class: 'plot', role: 'img', 'aria-label': 'the distance over time' });
    this.caption = element('p', { id: 'legend' });
    root.replaceChildren(element('div', { className: 'row' }, this.player.button, this.slider, this.label), this.plot, this.caption);
    this.set(0);
    this.show(null);
  }

  poseAt(body, frame) {
    const at = 7 * (frame * this.model.bodies.length + body.index), p = this.motion.poses;
    return { xyz: [p[at], p[at + 1], p[at + 2]], quat_wxyz: [p[at + 3], p[at + 4], p[at + 5], p[at + 6]] };
  }

  set(frame) {
    this.frame = frame;
    this.slider.value = frame;
    this.label.textContent = `t = ${formatLength(this.motion.times[frame], '')}`;
    for (const body of this.model.bodies) body.pose = this.poseAt(body, frame);
    this.cursor?.setAttribute('transform', `translate(${(600 * frame) / Math.max(1, this.motion.times.length - 1)} 0)`);
    this.onTime();
  }

  toggle() {
    this.player.toggle();
  }

  /** The distance of a pair over time, or of the one that comes nearest; margin and events marked. */
  show(chosen) {
    const pair = chosen ?? findNearest(this.model.pairs, ({ given }) => given);
    const { times, margin, events = [] } = this.motion, last = times.length - 1;
    if (!pair?.a.asked || !pair.b.asked || last < 1) {
      this.cursor = null;
      this.caption.textContent = '';
      return this.plot.replaceChildren();
    }
    const { a, b } = pair, kept = [a.pose, b.pose], values = [];
    for (let i = 0; i <= Math.min(SAMPLES, last); i++) {
      const frame = Math.round((i / Math.min(SAMPLES, last)) * last);
      a.pose = this.poseAt(a, frame);
      b.pose = this.poseAt(b, frame);
      const { lower, upper } = this.model.ask(a, b);
      values.push([frame, (lower + upper) / 2]);
    }
    [a.pose, b.pose] = kept;
    const low = Math.min(0, ...values.map((v) => v[1])), high = Math.max(margin ?? 0, 1e-12, ...values.map((v) => v[1]));
    const x = (frame) => (600 * frame) / last, y = (value) => 84 - (78 * (value - low)) / (high - low);
    const line = (value, kind) => svg('line', { x1: 0, x2: 600, y1: y(value), y2: y(value), class: kind });
    this.cursor = svg('line', { x1: 0, x2: 0, y1: 0, y2: 90, class: 'cursor', transform: `translate(${x(this.frame)} 0)` });
    this.caption.textContent = `The distance of ${a.name} and ${b.name}, at ${values.length} of the frames${margin ? '; dashed: the margin' : ''}.`;
    this.plot.replaceChildren(
      line(0, 'zero'), ...(margin ? [line(margin, 'margin')] : []),
      svg('polyline', { points: values.map(([frame, value]) => `${x(frame)},${y(value)}`).join(' '), class: 'curve' }),
      ...events.filter((e) => [e.a, e.b].includes(a.index) && [e.a, e.b].includes(b.index))
        .map((e) => svg('line', { x1: (600 * (e.time - times[0])) / (times[last] - times[0]), x2: (600 * (e.time - times[0])) / (times[last] - times[0]), y1: 0, y2: 90, class: 'event' })),
      this.cursor,
    );
  }
}
