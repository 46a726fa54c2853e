// The states of a robot, or a path through them: a slider with a mark for each state, what the tool has proven of them,
// the distance of the nearest pair over a path, and which steps prove which stretch of it.
import { element, svg } from './panel.mjs';
import { stepByKeys } from './keys.mjs';
import { describeBracket, formatLength, formatMiddle } from './text.mjs';
import { Player } from './player.mjs';

const WIDTH = 600, BAND = 10, CURVE = [16, 68], ROWS = 74, LOW = 14;
const KINDS = { outer: 'spheres or boxes in the middle', middle: 'gap along a normal in the middle', ends: 'gaps along a normal at both ends', solid: 'distance of the triangles in the middle' };
const MOST_LISTED = 40;
const sum = (answers) => ['free', 'hit', 'undecided', 'refused'].map((status) => [status, answers.filter((a) => a.status === status).length]).filter(([, n]) => n);
const format = (x) => String(Number(x.toPrecision(9)));

export class Track {
  constructor(roots, model, joints) {
    const { states = [], answers, path, times } = model.data.robot;
    Object.assign(this, { model, joints, states, answers, path, times, root: roots.track, at: 0 });
    // Between which states it goes: of edges each two are a path by themselves.
    this.isEdges = path !== undefined && path.steps === undefined && path.edges[0]?.path !== undefined;
    this.last = path ? (this.isEdges ? path.edges.length : states.length - 1) : states.length - 1;
    roots.whole.replaceChildren(...this.#describeAll());
    roots.whole.hidden = false;
    joints.onChange = () => this.#show(null);
    if (states.length < 2) return this.#show(states.length ? 0 : null);
    this.#make(roots.track);
    this.set(0);
  }

  // ---- what the tool has proven of all of it

  #describeAll() {
    const { path, answers, model } = this;
    if (!path || this.isEdges) {
      const all = path ? path.edges : answers, counts = sum(all).map(([status, n]) => element('span', { className: status, textContent: `${n} ${status}` }));
      model.summary = `${model.bodies.length} bodies`;
      return [`${all.length} ${path ? 'edge' : 'state'}${all.length === 1 ? '' : 's'}: `, ...counts.flatMap((c, i) => (i ? [', ', c] : [c]))];
    }
    model.summary = `${model.bodies.length} bodies, a path through ${this.states.length} states`;
    const [answer] = path.edges, said = element('strong', { className: answer.status, textContent: `The path: ${this.#describe(answer)}` });
    const jump = element('button', { id: 'jump', textContent: 'Go there', onclick: () => this.set(answer.hit_at ?? answer.free_until) });
    return answer.status === 'hit' ? [said, ' ', jump] : [said];
  }

  #describe(answer) {
    const { joints, model } = this, pair = answer.a ? `${joints.findTold(answer.a).name} and ${joints.findTold(answer.b).name} ${describeBracket(answer, model.unit)}` : '';
    switch (answer.status) {
      case 'free': return `free at all times${model.data.margin > 0 ? `, by more than ${formatLength(model.data.margin, model.unit)}` : ''}, proven by ${answer.steps} steps`;
      case 'hit': return `hit first at s = ${formatMiddle(answer.free_until, answer.hit_at, '')}: ${pair}`;
      case 'refused': return `refused: state ${answer.refused}: ${this.#describeRefused(answer)}`;
      default: return pair ? `undecided from s ${format(answer.free_until)} on: ${pair}` : 'undecided: nothing is compared';
    }
  }

  #describeRefused({ refused, variable, code }) {
    const number = this.model.data.robot.variables.indexOf(variable);
    const said = number < 0 || refused === undefined ? variable : this.joints.describeVariable(number, this.states[refused]);
    return code === 'out of range' ? said : `${said}: ${code}`;
  }

  // ---- where it is

  get #step() {
    return this.path ? 'any' : 1;
  }

  #make(root) {
    this.slider = element('input', {
      type: 'range', id: 'state', className: 'wide', min: 0, max: this.last, step: this.#step, value: 0, 'aria-label': this.path ? 's, the place on the path' : 'state',
      oninput: () => this.set(Number(this.slider.value)),
    });
    stepByKeys(this.slider, (steps) => this.set(Math.max(0, Math.min(this.last, this.path ? this.at + (steps * this.last) / 100 : this.at + steps))));
    this.label = element('output', { id: 'now' });
    // Without distances there is the band alone.
    const isHigh = this.path?.clearance?.length > 0, height = isHigh ? ROWS + 22 : LOW;
    this.plot = svg('svg', { viewBox: `0 0 ${WIDTH} ${height}`, preserveAspectRatio: 'none', class: isHigh ? 'plot' : 'plot low', role: 'img', 'aria-label': this.path ? 'what is proven over the path' : 'what each state is' });
    this.plot.addEventListener('pointerdown', (event) => {
      const box = this.plot.getBoundingClientRect(), at = ((event.clientX - box.left) / box.width) * this.last;
      this.set(this.path ? Math.max(0, Math.min(this.last, at)) : Math.round(at));
    });
    this.scale = element('div', { className: 'scale high' });
    this.legend = element('p', { id: 'legend' });
    this.steps = this.path?.steps && element('details', { id: 'steps', ontoggle: () => this.#listSteps() });
    const player = (this.player = new Player(this.last, Math.min(20, Math.max(4, this.last * (this.path ? 2 : 0.4))), () => this.at, (at) => this.set(this.path ? at : Math.round(at))));
    root.hidden = false;
    root.replaceChildren(element('div', { className: 'row' }, player.button, this.label), this.slider, element('div', { className: 'graph' }, this.plot, this.scale), this.legend, ...(this.steps ? [this.steps] : []));
    this.cursor = svg('line', { x1: 0, x2: 0, y1: 0, y2: height, class: 'cursor' });
    this.draw();
  }

  toggle() {
    this.player?.toggle();
  }

  /** Goes to a place: a state, or s of the path; of edges the edge and s in it. */
  set(at) {
    const { states } = this, from = Math.min(Math.floor(at), this.isEdges ? this.last - 1 : states.length - 1), part = at - from;
    const [p, q] = this.isEdges ? [states[2 * from], states[2 * from + 1]] : [states[from], states[Math.min(from + 1, states.length - 1)]];
    this.at = at;
    this.joints.set(part === 0 ? p : p.map((x, i) => x + part * (q[i] - x)));
    this.#show(at);
  }

  // What is said of the place; null: the joints were moved by hand.
  #show(at) {
    this.isLeft = at === null;
    if (!this.slider) return;
    this.slider.classList.toggle('left', this.isLeft);
    if (this.isLeft) return (this.label.textContent = 'moved by hand');
    this.slider.value = at;
    this.cursor.setAttribute('transform', `translate(${this.#x(at)} 0)`);
    const { path, answers, times } = this, edge = Math.min(Math.floor(at), this.last - 1), whole = Math.floor(at), part = at - whole;
    const time = times && !this.isEdges ? `, ${formatLength(times[whole] + (part ? part * (times[whole + 1] - times[whole]) : 0), 's')}` : '';
    const status = this.isEdges ? path.edges[edge].status : path ? this.#statusAt(at) : answers[at]?.status;
    this.label.textContent = `${this.isEdges ? `edge ${edge}, s ${format(at - edge)}` : path ? `s ${format(at)}` : `state ${at} (of 0 to ${this.states.length - 1})`}${time}: ${status}`;
    this.label.className = { 'proven free': 'free', 'not looked at': '' }[status] ?? status;
    this.#listSteps();
  }

  // Of a path what is proven at s.
  #statusAt(s) {
    const [{ status, free_until: free, hit_at: hit }] = this.path.edges;
    if (status === 'refused') return 'refused';
    if (status === 'free' || s < free) return 'proven free';
    if (status === 'hit' && s <= hit) return 'hit';
    return status === 'hit' ? 'not looked at' : 'undecided';
  }

  // ---- the picture

  #x(at) {
    return this.last ? (WIDTH * at) / this.last : 0;
  }

  #bar(from, to, y, height, kind, title) {
    const x = this.#x(from), bar = svg('rect', { x, width: Math.max(1.5, this.#x(to) - x), y, height, class: `bar ${kind}` });
    if (title) bar.append(svg('title', {}, title));
    return bar;
  }

  // A band of what is proven: of each state, or of the stretches of a path.
  #band() {
    const { path, answers } = this;
    if (!path) return answers.map((a, i) => this.#bar(i - 0.5, i + 0.5, 0, BAND, a.status, `state ${i}: ${a.status}`));
    return path.edges.flatMap((a, i) => {
      const from = this.isEdges ? i : 0, to = this.isEdges ? i + 1 : this.last, free = from + (a.status === 'free' ? to - from : a.free_until ?? 0);
      const rest = a.status === 'hit' ? [this.#bar(free, from + a.hit_at, 0, BAND + 2, 'hit', this.#describe(a))] : a.status === 'free' ? [] : [this.#bar(free, to, 0, BAND, a.status, this.#describe(a))];
      return [...(free > from ? [this.#bar(from, free, 0, BAND, 'free', `proven free from s ${format(from)} to ${format(free)}`)] : []), ...rest];
    });
  }

  // What the colours of the band mean.
  #listVerdicts() {
    const { path, answers } = this, seen = new Set((path ? path.edges : answers).map(({ status }) => status)), words = { free: path ? 'proven free' : 'free', hit: 'hit', undecided: 'undecided', refused: 'refused' };
    if (path?.edges.some(({ status, free_until: free }) => status === 'hit' && free > 0)) seen.add('free');
    return Object.entries(words).filter(([status]) => seen.has(status));
  }

  // The ends of the curve, as text beside it.
  #showScale(low, high) {
    this.scale.replaceChildren(...[high, low].map((x) => element('span', { textContent: formatLength(x, this.model.unit, 3) })));
  }

  // The distance of the nearest pair at samples.
  #curve() {
    const { clearance = [] } = this.path ?? {}, { margin } = this.model.data, values = clearance.filter(([, low, high]) => low !== null && high !== null).map(([s, low, high]) => [s, (low + high) / 2]);
    if (!values.length) return [];
    const low = Math.min(0, ...values.map((v) => v[1])), high = Math.max(margin ?? 0, 1e-12, ...values.map((v) => v[1]));
    this.#showScale(low, high);
    const y = (value) => CURVE[1] - ((CURVE[1] - CURVE[0]) * (value - low)) / (high - low), line = (value, kind) => svg('line', { x1: 0, x2: WIDTH, y1: y(value), y2: y(value), class: kind });
    return [line(0, 'zero'), ...(margin ? [line(margin, 'margin')] : []), svg('polyline', { points: values.map(([s, value]) => `${this.#x(s)},${y(value)}`).join(' '), class: 'curve' })];
  }

  // The steps as rows by their kind; of a pair each one, else where there is any.
  #rows() {
    const { steps = [] } = this.path ?? {}, kinds = Object.keys(KINDS).filter((kind) => steps.some((s) => s[2] === kind)), out = [];
    kinds.forEach((kind, row) => {
      const own = steps.filter((s) => s[2] === kind && (this.pairNumber === undefined || s[3].includes(this.pairNumber))).sort((a, b) => a[0] - b[0]);
      const stretches = this.pairNumber === undefined ? unite(own) : own;
      out.push(...stretches.map(([from, to], i) => this.#bar(from, to, ROWS + 5 * row, 4, `step ${kind}${i % 2 ? ' odd' : ''}`, `${KINDS[kind]}: s ${format(from)} to ${format(to)}`)));
    });
    return out;
  }

  draw() {
    const count = this.isEdges ? this.last + 1 : this.states.length, marks = count <= 400 ? Array.from({ length: count }, (_, i) => svg('line', { x1: this.#x(i), x2: this.#x(i), y1: 0, y2: 13, class: 'mark' })) : [];
    this.plot.replaceChildren(...this.#band(), ...marks, ...this.#curve(), ...this.#rows(), this.cursor);
    const { pair } = this, kinds = new Set((this.path?.steps ?? []).map((s) => s[2]));
    this.legend.replaceChildren(
      ...this.#listVerdicts().flatMap(([kind, text]) => [element('span', { className: `key ${kind}`, textContent: text }), ' ']),
      ...(this.path ? [this.isEdges ? '– the edges stand one after another. ' : '– s = 0.5 is halfway from state 0 to state 1. '] : []),
      ...(this.path?.clearance ? [`Curve: the distance of the nearest pair, at samples${this.model.data.margin > 0 ? '; dashed: the margin' : ''}. Rows: the steps of the proof`, pair ? ` for ${pair.a.name} – ${pair.b.name}` : '', ': '] : []),
      ...[...kinds].flatMap((kind) => [element('span', { className: `key ${kind}`, textContent: KINDS[kind] }), ' ']),
    );
    this.#listSteps();
  }

  /** The rows become those of a pair; null: of all. */
  show(pair) {
    const same = (a, b) => pair && this.joints.findTold(a) === pair.a && this.joints.findTold(b) === pair.b;
    const number = this.path?.pairs?.findIndex(([a, b]) => same(a, b) || same(b, a)) ?? -1;
    this.pair = number < 0 ? undefined : pair;
    this.pairNumber = number < 0 ? undefined : number;
    if (this.plot) this.draw();
  }

  // The steps that prove the place where it is.
  #listSteps() {
    const { steps, pairs } = this.path ?? {};
    if (!steps || this.steps === undefined) return;
    const here = this.isLeft ? [] : steps.filter(([from, to, , numbers]) => from <= this.at && this.at <= to && (this.pairNumber === undefined || numbers.includes(this.pairNumber)));
    const name = (i) => (pairs[i] ? pairs[i].map((side) => this.joints.findTold(side)?.name).join(' – ') : `pair ${i}`);
    const title = element('summary', { textContent: `${here.length} of ${steps.length} steps prove this place` });
    const list = this.steps.open ? here.slice(0, MOST_LISTED).map(([from, to, kind, numbers]) => element('li', { textContent: `s ${format(from)} to ${format(to)}: ${KINDS[kind]}: ${numbers.map(name).join('; ')}` })) : [];
    this.steps.replaceChildren(title, element('ul', {}, ...list, ...(this.steps.open && here.length > MOST_LISTED ? [element('li', { textContent: `and ${here.length - MOST_LISTED} more` })] : [])));
  }
}

// The stretches that steps, sorted by their beginnings, cover together.
function unite(steps) {
  const out = [];
  for (const [from, to] of steps) {
    const before = out[out.length - 1];
    if (before && from <= before[1]) before[1] = Math.max(before[1], to);
    else out.push([from, to]);
  }
  return out;
}
