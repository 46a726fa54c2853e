// The page of one scene: everything it needs is in it.
import { load } from '../../package/ovoid.mjs';
import { readData, unpack } from './data.mjs';
import { Joints } from './joints.mjs';
import { Model } from './model.mjs';
import { element, Panel } from './panel.mjs';
import { saveModel, savePicture } from './save.mjs';
import { findNearest } from './headline.mjs';
import { Labels } from './labels.mjs';
import { Timeline } from './timeline.mjs';
import { Track } from './track.mjs';
import { Painter } from './painter.mjs';
import { makeRenderer } from './renderer.mjs';
import { Layer } from './layers.mjs';
import { View } from './view.mjs';

const $ = (id) => document.getElementById(id);

function say(text) {
  $('said').textContent = text;
  $('said').hidden = !text;
}

/** Most pairs of a motion that are asked about in each frame. */
const LIVE_PAIRS = 50;

/** Most pairs whose contacts are drawn at once. */
const MOST_CONTACTS = 2000;

class Page {
  constructor(model, renderer) {
    this.model = model;
    this.chosenBody = null;
    this.view = new View(model, renderer, (body) => this.chooseBody(body), (body) => this.moved(body));
    this.panel = new Panel(document, model, {
      choosePair: (pair) => this.choosePair(pair),
      isolate: () => this.isolate(),
      fly: () => this.fly(),
      hold: (mode) => this.hold(mode),
    });
    if (model.data.motion) this.timeline = new Timeline($('timeline'), model, () => this.atTime());
    if (model.data.robot) {
      this.joints = new Joints($('joints'), model, () => this.atJoints());
      this.track = new Track({ whole: $('whole'), track: $('timeline') }, model, this.joints);
    }
    for (const pair of model.pairs) pair.begin = pair.now;
    if (this.timeline || this.joints) this.panel.fill();
    this.panel.show(null);
    this.labels = new Labels($('labels'), model);
    this.view.onPicture = (sizes) => this.labels.update(this.view, this.#shownAnswer(), sizes);
    this.view.onDrawn = (drawn, all) => this.#sayDrawn(drawn, all);
    this.view.fitAnew();
    this.#layers();
    this.#buttons();
    document.addEventListener('keydown', (event) => this.#key(event));
    for (const [event, isPaper] of [['beforeprint', true], ['afterprint', false]]) window.addEventListener(event, () => this.#fitPaper(isPaper));
    this.#hover();
    this.#showAnswer();
  }

  /** The nearest pair where the bodies are now; of those that are asked about. */
  get nearest() {
    const isAsked = !this.timeline || this.model.pairs.length <= LIVE_PAIRS;
    return isAsked ? findNearest(this.model.pairs, this.#answerNow) : null;
  }
  #answerNow = (pair) => (this.timeline && !pair.isLive ? pair.now : pair.answer);

  // The chosen pair's answer, else the nearest pair's, where no body is chosen.
  #shownAnswer() {
    const pair = this.panel?.chosen ?? (this.chosenBody ? null : this.nearest);
    return pair ? { pair, answer: pair === this.panel.chosen ? pair.answer : this.#answerNow(pair) } : {};
  }
  #showAnswer() {
    this.view.showAnswer(this.#shownAnswer().answer);
    if (this.model.contactOptions) this.view.showContacts(this.#listContacts());
    this.panel.mark(this.model.pairs.length > 1 ? this.nearest : null);
  }

  // The contacts of the chosen pair, of the chosen body's pairs, or of all.
  #listContacts() {
    const { chosen } = this.panel ?? {}, { pairs, byBody } = this.model, shown = chosen ? [chosen] : this.chosenBody ? byBody.get(this.chosenBody) : pairs;
    const answerOf = (pair) => (pair === chosen ? pair.answer : this.#answerNow(pair));
    return shown.slice(0, MOST_CONTACTS).flatMap((pair) => this.model.listContacts(pair, answerOf(pair)));
  }

  get isIsolated() {
    return this.view.only !== null;
  }

  #chosen() {
    const { chosen } = this.panel;
    return chosen ? [chosen.a, chosen.b] : this.chosenBody ? [this.chosenBody] : [];
  }

  choosePair(pair) {
    this.view.hold(null);
    this.chosenBody = null;
    this.panel.show(null);
    // Of a motion the answer is that of the frame where the two are nearest.
    if (this.timeline && pair?.frame !== undefined) {
      pair.answer = pair.given;
      pair.isLive = false;
      this.timeline.set(pair.frame);
    }
    this.panel.show(pair);
    this.view.choose(pair ? this.#chosen() : [], this.isIsolated);
    this.#showAnswer();
    (this.timeline ?? this.track)?.show(pair);
    if (!pair) return;
    this.fly();
    // On a phone what is known of the pair is below the list.
    if (matchMedia('(max-width: 45rem)').matches) $('details').scrollIntoView({ behavior: 'smooth', block: 'nearest' });
  }

  chooseBody(body) {
    if (body === this.view.held && body) return;
    this.view.hold(null);
    this.panel.show(null);
    this.chosenBody = body;
    this.view.choose(body ? [body] : [], this.isIsolated && body !== null);
    this.#showAnswer();
    if (body) this.panel.showBody(body);
  }

  /** The camera to the witness points, across the normal. */
  fly() {
    const { chosen } = this.panel;
    if (!chosen?.answer.point_a) return this.chosenBody && this.view.fit({ center: this.chosenBody.center, radius: this.chosenBody.radius });
    const { point_a: p, point_b: q, upper } = chosen.answer, least = Math.min(chosen.a.radius, chosen.b.radius);
    this.view.fit({ center: p.map((x, k) => (x + q[k]) / 2), radius: Math.max(0.9 * least, 1.4 * Math.abs(upper)) });
  }

  isolate() {
    this.view.choose(this.#chosen(), !this.isIsolated);
  }

  hold(mode) {
    const body = this.chosenBody;
    if (!body || this.timeline || body.link !== undefined) return say(body ? 'This body is moved by its motion or its joints.' : 'Choose a body first.');
    this.view.hold(body, mode);
  }

  moved(body) {
    if (this.joints) this.joints.place(body);
    else this.model.refresh(body);
    this.panel.update(this.model.byBody.get(body));
    this.panel.updateBody(body);
  }

  #again() {
    const { pairs } = this.model;
    this.view.placeAll();
    // Of many pairs the one that is chosen is asked about alone.
    if (pairs.length <= LIVE_PAIRS) {
      for (const pair of pairs) pair.now = this.model.ask(pair.a, pair.b) ?? undefined;
      this.panel.update(pairs.filter((pair) => pair !== this.panel.chosen));
    }
    if (this.panel.chosen) {
      const { chosen } = this.panel;
      this.model.askAgain(chosen);
      this.panel.update([chosen]);
    }
    this.#showAnswer();
  }
  atTime() {
    if (this.panel) this.#again();
  }
  atJoints() {
    const { chosen } = this.panel, same = chosen && this.model.pairs.find((p) => p.a === chosen.a && p.b === chosen.b);
    this.view.placeAll();
    this.panel.fill();
    if (chosen) this.panel.show(same ?? null);
    this.#showAnswer();
  }

  reset() {
    this.view.hold(null);
    this.model.reset();
    this.joints?.reset();
    this.panel.fill();
    this.choosePair(null);
    this.view.placeAll();
  }

  #layers() {
    const labels = { meshes: 'Meshes', hulls: 'Hulls', outer: 'Outer ellipsoids', inner: 'Inner ellipsoids', areas: 'Areas', witness: 'Witness points', contacts: 'Contacts' };
    const keys = { meshes: 'm', hulls: 'h', outer: 'o', inner: 'i', areas: 'a', witness: 'w', contacts: 'c' };
    const { data, pairs } = this.model, has = (name) => {
      if (name === 'contacts') return this.model.contactOptions !== undefined;
      return name === 'witness' ? pairs.length > 0 || data.robot !== undefined : Layer.has(this.model, name);
    };
    this.boxes = {};
    for (const [name, text] of Object.entries(labels)) {
      if (!has(name)) continue;
      const box = element('input', { type: 'checkbox', checked: this.view.shown[name], id: `layer-${name}`, onchange: () => this.view.show({ [name]: box.checked }) });
      this.boxes[keys[name]] = box;
      $('layers').append(element('label', { title: `key ${keys[name].toUpperCase()}` }, box, ` ${text}`));
    }
    const glass = element('input', { type: 'range', min: 0.1, max: 1, step: 0.05, value: 1, 'aria-label': 'opacity', oninput: () => {
      this.view.opacity = Number(glass.value);
      this.view.show({});
    } });
    const names = element('input', { type: 'checkbox', checked: true, id: 'layer-labels', onchange: () => {
      this.labels.isOn = names.checked;
      this.view.draw();
    } });
    this.boxes.l = names;
    $('layers').append(element('label', { title: 'key L' }, names, ' Labels'), element('label', {}, 'Opacity ', glass));
  }

  /** Checks the answer that the data have of each pair, some at a time; counts those that hold. */
  async verifyAll() {
    const { pairs } = this.model, said = $('checked'), count = { holds: 0, fails: 0, open: 0 };
    for (let i = 0; i < pairs.length; i++) {
      const { isVerified, holds } = this.#verifyGiven(pairs[i]);
      count[isVerified ? (holds ? 'holds' : 'fails') : 'open']++;
      pairs[i].isBroken = isVerified && !holds;
      if (i % 50 === 49) {
        said.textContent = `${i + 1} of ${pairs.length}`;
        await new Promise((resolve) => setTimeout(resolve));
      }
    }
    const rest = count.open ? `; ${count.open} cannot be checked here (ovoid verify does)` : '';
    said.textContent = count.fails ? `${count.fails} of ${pairs.length} proofs do not hold${rest}` : `${count.holds} of ${pairs.length} proofs hold${rest}`;
    said.className = count.fails ? 'fails' : count.holds ? 'holds' : '';
    this.panel.fill();
  }

  // Of bodies where the data have them; of a motion in the frame that the answer is of.
  #verifyGiven({ a, b, given, frame }) {
    const kept = [a.pose, b.pose], at = (body) => (this.timeline && frame !== undefined ? this.timeline.poseAt(body, frame) : body.home);
    [a.pose, b.pose] = [at(a), at(b)];
    const verdict = this.model.verify({ a, b, answer: given });
    [a.pose, b.pose] = kept;
    return verdict;
  }

  #buttons() {
    $('proofs').hidden = this.model.data.robot !== undefined || !this.model.pairs.length || this.panel.isSingle;
    $('check-all').onclick = () => this.verifyAll();
    const name = this.model.data.title.replace(/\.[^.]*$/, '').replace(/[^\w.-]+/g, '_');
    $('fit').onclick = () => this.view.fit();
    $('reset').onclick = () => this.reset();
    $('png').onclick = () => savePicture(this.view, name);
    $('glb').onclick = () => saveModel(this.view, name).catch((error) => say(error.message));
    $('theme').onclick = () => this.#theme();
    $('help').onclick = () => $('keys').showModal();
  }

  /** A line that says where less is drawn than there is. */
  #sayDrawn(drawn, all) {
    const count = (n) => n.toLocaleString('en').replaceAll(',', ' ');
    $('drawn').textContent = drawn < all ? `${count(drawn)} of ${count(all)} triangles: what is small is drawn coarser` : '';
  }

  #theme() {
    const isDark = document.documentElement.dataset.theme ? document.documentElement.dataset.theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
    document.documentElement.dataset.theme = isDark ? 'light' : 'dark';
    this.view.draw();
  }

  #key(event) {
    if (event.target.matches('input:not([type=range],[type=checkbox])') || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === ' ' && event.target.matches('button, summary, input, a')) return;
    const key = event.key.toLowerCase(), box = this.boxes[key];
    const actions = {
      f: () => this.view.fit(), g: () => this.hold('translate'), r: () => this.hold('rotate'), x: () => this.isolate(), t: () => this.#theme(),
      p: () => document.getElementById('check')?.click(), escape: () => this.choosePair(null), '?': () => $('keys').showModal(),
      arrowdown: () => this.#next(1), arrowup: () => this.#next(-1), ' ': () => (this.timeline ?? this.track)?.toggle(),
    };
    if (event.target.id === 'canvas' && this.view.takeKey(key)) event.preventDefault();
    else if (box) box.click();
    else if (actions[key] && !(key.startsWith('arrow') && event.target.matches('input'))) {
      actions[key]();
      event.preventDefault();
    }
  }

  // The picture as large as on paper, its names in their places, on a canvas of its own, as browsers print an older picture of WebGL; and back.
  #fitPaper(isPaper) {
    document.body.classList.toggle('paper', isPaper);
    this.view.resize();
    this.view.drawNow();
    const { canvas } = this.view, { width, height } = isPaper ? canvas : { width: 1, height: 1 };
    Object.assign($('paper'), { width, height });
    $('paper').getContext('2d').drawImage(canvas, 0, 0);
  }

  #next(step) {
    const pairs = [...this.panel.rows.keys()], at = pairs.indexOf(this.panel.chosen);
    const next = pairs[Math.max(0, Math.min(pairs.length - 1, at < 0 ? 0 : at + step))];
    if (next) this.choosePair(next);
    this.panel.rows.get(next)?.scrollIntoView({ block: 'nearest' });
  }

  #hover() {
    let due = false;
    $('canvas').addEventListener('pointermove', (event) => {
      if (due || event.buttons) return;
      due = true;
      setTimeout(() => {
        due = false;
        const body = this.view.bodyAt(event.clientX, event.clientY);
        $('name').hidden = !body;
        $('name').textContent = body?.name ?? '';
        $('name').style.translate = `${event.clientX + 12}px ${event.clientY + 8}px`;
      }, 40);
    });
  }
}

async function start() {
  performance.mark('begin');
  const data = readData($('ovoid-data')?.textContent ?? 'null');
  document.title = `${data.title} – ovoid`;
  $('title').textContent = data.title;
  $('command').textContent = data.command;
  if (data.left_out) say(`Left out, as there are so many: ${Object.entries(data.left_out).filter(([, n]) => n).map(([what, n]) => `${n} ${what}${what === 'proofs' ? ' (found anew where they are checked)' : ''}`).join(', ')}.`);
  performance.mark('data');
  // The module is compiled while the picture is prepared.
  const module = unpack($('ovoid-module').textContent).then((bytes) => load(bytes)), renderer = makeRenderer($('canvas'));
  performance.mark('renderer');
  const model = new Model(await module, data);
  performance.mark('model');
  window.ovoidPage = new Page(model, renderer);
  if (renderer instanceof Painter) $('drawn').before(element('p', { id: 'painted', textContent: 'Painted, as this browser has no WebGL 2: coarser, and slower.' }));
  performance.mark('page');
  document.body.dataset.ready = 'yes';
}

start().catch((error) => {
  say(error.message);
  document.body.dataset.ready = 'failed';
  throw error;
});
