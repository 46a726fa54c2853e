// The list of pairs, what is known of the chosen one, and the bodies.

import { countPairs, describeScene } from './headline.mjs';
import { describeAnswer, describeContact, describeId, formatBracket, formatLength, formatMiddle } from './text.mjs';

const MOST_ROWS = 400;
/** Of fewer pairs nothing needs to be sought by name. */
const FEW = 4;

export function element(tag, properties = {}, ...children) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (key.startsWith('on')) node.addEventListener(key.slice(2), value);
    else if (key in node) node[key] = value;
    else node.setAttribute(key, value);
  }
  node.append(...children);
  return node;
}

/** The same of a picture. */
export function svg(tag, attributes, ...children) {
  const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  node.append(...children);
  return node;
}

export class Panel {
  constructor(root, model, actions) {
    this.model = model;
    this.actions = actions;
    this.filter = '';
    this.margin = Infinity;
    this.rows = new Map();
    this.summary = root.querySelector('#summary');
    this.headline = root.querySelector('#headline');
    this.filterRow = root.querySelector('#filters');
    this.list = root.querySelector('#pairs');
    this.more = root.querySelector('#more');
    this.details = root.querySelector('#details');
    const unit = model.unit ? `, ${model.unit}` : '';
    if (model.data.motion) this.list.before(element('thead', {}, element('tr', {}, ...['pair', `now${unit}`, `least${unit}`, 'at t'].map((textContent) => element('th', { textContent, scope: 'col' })))));
    this.isSingle = model.pairs.length === 1 && !model.data.motion && !model.data.robot;
    root.querySelector('#filter').addEventListener('input', (event) => {
      this.filter = event.target.value.toLowerCase();
      this.fill();
    });
    root.querySelector('#margin').addEventListener('input', (event) => {
      const value = parseFloat(event.target.value);
      this.margin = Number.isNaN(value) ? Infinity : value;
      this.fill();
    });
    this.fill();
  }

  matching() {
    const { filter, margin } = this;
    return this.model.pairs
      .filter(({ a, b, ...pair }) => this.#rank(pair) <= margin && (!filter || `${a.name} ${b.name}`.toLowerCase().includes(filter)))
      .sort((x, y) => this.#rank(x) - this.#rank(y));
  }

  // By what pairs are listed: of a motion by the least distance.
  #rank({ answer, given }) {
    return (this.model.data.motion ? given : answer).lower;
  }

  fill() {
    const pairs = this.matching();
    this.rows.clear();
    this.list.replaceChildren(
      ...pairs.slice(0, MOST_ROWS).map((pair) => {
        const row = element('tr', { tabIndex: 0, onclick: () => this.actions.choosePair(pair), onkeydown: (event) => event.key === 'Enter' && this.actions.choosePair(pair) });
        this.rows.set(pair, row);
        this.#write(pair, row);
        return row;
      }),
    );
    const all = this.model.pairs.length, { summary, bodies } = this.model, count = (n, one, many) => `${n} ${n === 1 ? one : many}`;
    this.summary.textContent = summary ?? `${count(bodies.length, 'body', 'bodies')}${all ? `, ${count(all, 'pair', 'pairs')}: ${countPairs(this.model.pairs)}` : ''}`;
    this.list.parentNode.parentNode.hidden = this.isSingle || (all === 0 && !this.model.data.robot);
    this.filterRow.hidden = this.model.data.robot ? bodies.length <= FEW + 1 : all < FEW;
    this.headline.textContent = describeScene(this.model) ?? '';
    this.headline.hidden = !this.headline.textContent;
    const rest = pairs.length > MOST_ROWS ? `${pairs.length - MOST_ROWS} more: narrow the filter` : pairs.length < all ? `${pairs.length} of ${all}` : '';
    this.more.textContent = all === 0 && this.model.farther ? `All are ${this.model.farther}.` : rest;
  }

  #write(pair, row) {
    const { a, b, answer } = pair, { motion } = this.model.data, number = (said) => element('td', {
      className: `number ${said?.status ?? ''}`, textContent: said ? formatBracket(said, motion ? '' : this.model.unit) : '', title: said ? `${said.lower} to ${said.upper}` : '',
    });
    row.className = `${pair === this.chosen ? 'chosen' : ''}${pair.isLive ? ' live' : ''}${pair.isBroken ? ' broken' : ''}${pair === this.marked ? ` marked ${(pair.isLive ? answer : pair.now ?? answer).status}` : ''}`;
    const numbers = motion ? [number(pair.isLive ? answer : pair.now), number(pair.given), element('td', { className: 'time', textContent: formatLength(motion.times[pair.frame], '', 4) })] : [number(answer)];
    row.replaceChildren(element('td', { textContent: `${a.name} – ${b.name}` }), ...numbers);
  }

  /** Marks a pair in the list as the nearest. */
  mark(pair) {
    const before = this.marked;
    this.marked = pair;
    for (const p of [before, pair]) if (p && this.rows.has(p)) this.#write(p, this.rows.get(p));
  }

  /** Writes the rows of pairs anew whose answers changed. */
  update(pairs) {
    for (const pair of pairs) if (this.rows.has(pair)) this.#write(pair, this.rows.get(pair));
    if (this.chosen && pairs.includes(this.chosen)) this.show(this.chosen);
  }

  /** What is known of a pair; null: nothing is chosen, or of one pair alone that pair. */
  show(chosen) {
    const pair = chosen ?? (this.isSingle ? this.model.pairs[0] : null);
    const before = this.chosen;
    this.chosen = pair;
    for (const p of [before, pair]) if (p && this.rows.has(p)) this.#write(p, this.rows.get(p));
    if (!pair) return this.details.replaceChildren();
    const { a, b, answer } = pair, unit = this.model.unit, vector = (v) => v?.map((x) => Number(x.toPrecision(9))).join(', ') ?? '';
    const fact = (name, value, id) => [element('dt', { textContent: name }), element('dd', { textContent: value, ...(id ? { id } : {}) })];
    const said = element('p', { id: 'proof', className: 'proof', role: 'status' });
    const check = element('button', {
      id: 'check', textContent: 'Check the proof here', title: 'by the library in this page, without any search (P)',
      onclick: () => {
        const { isVerified, holds, text } = this.model.verify(pair);
        said.textContent = text;
        said.className = `proof ${isVerified ? (holds ? 'holds' : 'fails') : ''}`;
      },
    });
    const isOpen = this.details.querySelector('#numbers')?.open ?? false;
    this.details.replaceChildren(
      element('h2', { textContent: `${a.name} – ${b.name}` }),
      element('p', { id: 'status', className: `answer ${answer.status}`, textContent: `They ${describeAnswer(answer, unit)}${pair.isLive ? ', asked just now' : ''}.` }),
      element('p', { className: 'buttons' }, check, element('button', { id: 'isolate', textContent: 'Only these two', title: 'show nothing else (X)', onclick: () => this.actions.isolate() }),
        element('button', { textContent: 'Fly there', title: 'Enter', onclick: () => this.actions.fly() })),
      said,
      element('dl', {}, ...fact('signed distance', formatMiddle(answer.lower, answer.upper, unit), 'middle')),
      element('details', { id: 'numbers', open: isOpen }, element('summary', { textContent: 'All numbers of the answer' }), element('dl', {},
        ...fact('lower bound', formatLength(answer.lower, unit, 17), 'lower'),
        ...fact('upper bound', formatLength(answer.upper, unit, 17), 'upper'),
        ...fact(`point on ${a.name}`, vector(answer.point_a)),
        ...fact(`point on ${b.name}`, vector(answer.point_b)),
        ...fact('normal', vector(answer.normal)),
        ...fact('decided by', answer.stage ?? ''),
      )),
      ...this.#listContacts(answer),
    );
  }

  // The contacts of an answer, where the command was asked for them: of each what meets, its area and its points.
  #listContacts({ contacts, contact_limit: limit }) {
    const { contactOptions, unit } = this.model;
    if (!contactOptions) return [];
    if (!contacts?.length) return [element('p', { id: 'contacts', textContent: limit ? 'Solids and surfaces have no contacts.' : `No contact within ${formatLength(contactOptions.margin, unit)}.` })];
    const rows = contacts.flatMap((m) => [
      element('tr', {}, element('th', { colSpan: 3, textContent: describeContact(m, unit) })),
      ...m.points.map((p) => element('tr', {}, ...[describeId(p.id), p.point_a.map((x) => Number(x.toPrecision(6))).join(', '), formatLength(p.separation, unit, 6)].map((textContent) => element('td', { textContent })))),
    ]);
    return [element('h3', { textContent: contacts.length === 1 ? 'The contact' : `${contacts.length} contacts` }), element('table', { id: 'contacts' }, element('tbody', {}, ...rows))];
  }

  /** What is known of a body. */
  showBody(body) {
    const text = (p) => `${p.xyz.map((x) => Number(x.toPrecision(12))).join(' ')} ${p.quat_wxyz.map((x) => Number(x.toPrecision(12))).join(' ')}`;
    const pose = element('output', { id: 'pose', textContent: text(body.pose) });
    this.poseText = { body, node: pose, text };
    this.details.replaceChildren(
      element('h2', { textContent: body.name }), ...this.#wholeName(body),
      element('p', {},
        element('button', { id: 'move', textContent: 'Move', title: 'drag its arrows (G)', onclick: () => this.actions.hold('translate') }), ' ',
        element('button', { id: 'turn', textContent: 'Turn', title: 'drag its rings (R)', onclick: () => this.actions.hold('rotate') }), ' ',
        element('button', { textContent: 'Only this', title: 'show nothing else (X)', onclick: () => this.actions.isolate() })),
      element('dl', {},
        element('dt', { textContent: 'pose (x y z, w x y z)' }), element('dd', {}, pose),
        element('dt', { textContent: 'made of' }), element('dd', { textContent: body.isSolid ? this.#describeSolid(body) : `${body.parts.length} convex ${body.parts.length === 1 ? 'part' : 'parts'}` }),
      ),
      element('h3', { textContent: 'Its pairs' }),
      element('ul', { id: 'own' }, ...this.#ownPairs(body)),
    );
  }

  // A name that is cut is whole in a field of its own, made when it is opened.
  #wholeName({ name, wholeName }) {
    if (name === wholeName) return [];
    const details = element('details', { id: 'whole-name' }, element('summary', { textContent: `The whole name, ${wholeName.length} characters` }));
    details.addEventListener('toggle', () => details.querySelector('textarea') ?? details.append(element('textarea', { value: wholeName, readOnly: true, 'aria-label': 'the whole name' })));
    return [details];
  }

  #describeSolid({ parts: [{ shape }] }) {
    return shape.triangulation ? `a solid of ${shape.triangulation.triangles.length / 3} triangles` : 'a solid, whose triangles are too many for the page';
  }

  #ownPairs(body) {
    const own = [...this.model.byBody.get(body)].sort((x, y) => x.answer.lower - y.answer.lower).slice(0, 12);
    return own.map((pair) => {
      const other = pair.a === body ? pair.b : pair.a;
      return element('li', { className: pair.answer.status }, element('button', { className: 'plain', onclick: () => this.actions.choosePair(pair), textContent: `${other.name}: ${formatBracket(pair.answer, this.model.unit)}` }));
    });
  }

  /** The body's pose and pairs while it is dragged. */
  updateBody(body) {
    if (this.poseText?.body !== body || !this.poseText.node.isConnected) return;
    this.poseText.node.textContent = this.poseText.text(body.pose);
    this.details.querySelector('#own').replaceChildren(...this.#ownPairs(body));
  }
}
