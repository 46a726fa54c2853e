// Names of bodies over the picture, where they fit: first those of the marked pair, then the largest.
import { Vector3 } from 'three';
import { element } from './panel.mjs';
import { labelAnswer, shorten } from './text.mjs';

const MOST = 40, HEIGHT = 19, LONGEST = 26;
/** Of smaller bodies, in pixels, the name would hide them. */
const SMALLEST = 7;

export class Labels {
  constructor(root, model) {
    this.root = root;
    this.model = model;
    this.nodes = new Map();
    this.distance = element('div', { className: 'label distance' });
    this.isOn = true;
  }

  // Where a body's name may stand: over it, or above or below its middle. null: no place is free.
  #findPlace(x, y, width, taken, frame) {
    for (const dy of [0, -HEIGHT, HEIGHT, -2 * HEIGHT, 2 * HEIGHT]) {
      const box = { left: x - width / 2, top: y + dy - HEIGHT / 2, right: x + width / 2, bottom: y + dy + HEIGHT / 2 };
      const isInside = box.left >= 2 && box.top >= 2 && box.right <= frame.width - 2 && box.bottom <= frame.height - 2;
      if (isInside && taken.every((t) => box.right < t.left || box.left > t.right || box.bottom < t.top || box.top > t.bottom)) return box;
    }
    return null;
  }

  #width(text) {
    this.context ??= document.createElement('canvas').getContext('2d');
    this.context.font = '12px system-ui, sans-serif';
    return this.context.measureText(text).width + 16;
  }

  #node(body) {
    if (!this.nodes.has(body)) {
      const text = shorten(body.name, LONGEST), node = element('div', { className: 'label', textContent: text });
      this.nodes.set(body, { node, width: this.#width(text) });
    }
    return this.nodes.get(body);
  }

  #put(node, box, shown) {
    node.style.translate = `${box.left.toFixed(1)}px ${box.top.toFixed(1)}px`;
    shown.push(node);
  }

  /** Puts the labels where the picture has the bodies. answer: of the marked pair; sizes: of each body its pixels. */
  update({ camera, canvas, only, colors, shown: layers, line }, { answer, pair }, sizes) {
    const frame = { width: canvas.clientWidth, height: canvas.clientHeight }, taken = [], shown = [], at = new Vector3();
    const project = (point) => {
      at.copy(point).project(camera);
      return at.z < 1 && Math.abs(at.x) < 1 && Math.abs(at.y) < 1 ? [((at.x + 1) / 2) * frame.width, ((1 - at.y) / 2) * frame.height] : null;
    };
    if (this.isOn && layers.witness && line && answer) {
      const text = labelAnswer(answer, this.model.unit), width = this.#width(text), middle = project(line.points[0].clone().add(line.points[1]).multiplyScalar(0.5));
      // Beside the line, so that this is seen.
      const box = middle && this.#findPlace(middle[0] + width / 2 + 14, middle[1], width, taken, frame);
      if (box) {
        Object.assign(this.distance, { textContent: text, className: `label distance ${answer.status}` });
        taken.push(box);
        this.#put(this.distance, box, shown);
      }
    }
    const isFirst = (body) => pair && (body === pair.a || body === pair.b);
    const bodies = this.isOn ? this.model.bodies.filter((body) => (!only || only.has(body)) && (isFirst(body) || sizes[body.index] > SMALLEST)) : [];
    bodies.sort((x, y) => isFirst(y) - isFirst(x) || sizes[y.index] - sizes[x.index]);
    for (const body of bodies.slice(0, MOST)) {
      const { node, width } = this.#node(body), middle = project(at.set(...body.center)), box = middle && this.#findPlace(...middle, width, taken, frame);
      if (!box) continue;
      taken.push(box);
      node.style.borderColor = `#${colors.get(body).getHexString()}`;
      this.#put(node, box, shown);
    }
    for (const node of [...this.root.children]) if (!shown.includes(node)) node.remove();
    for (const node of shown) if (node.parentNode !== this.root) this.root.append(node);
  }
}
