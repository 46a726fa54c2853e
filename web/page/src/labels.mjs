// Names of bodies over the picture, where they fit: first those of the marked pair, then the largest.
import { Vector3 } from 'three';
import { element } from './panel.mjs';
import { labelAnswer, shorten } from './text.mjs';

const MOST = 40, HEIGHT = 19, LONGEST = 26;
/** Of smaller bodies, in pixels, the name would hide them. */
const SMALLEST = 7;
/** Of more bodies, the names of those that are narrower than so much of their names are left out: they would hide the picture. */
const FEW = 12, NARROWEST = 0.5;
/** Half of what a witness point takes of the picture, in pixels. */
const DOT = 6;

export class Labels {
  constructor(root, model) {
    this.root = root;
    this.model = model;
    this.nodes = new Map();
    this.distance = element('div', { className: 'label distance' });
    this.isOn = true;
  }

  // Where a label may stand: at one of the places [x, y]. null: none of them is free.
  #findPlace(places, width, taken, frame) {
    for (const [x, y] of places) {
      const box = { left: x - width / 2, top: y - HEIGHT / 2, right: x + width / 2, bottom: y + HEIGHT / 2 };
      const isInside = box.left >= 2 && box.top >= 2 && box.right <= frame.width - 2 && box.bottom <= frame.height - 2;
      if (isInside && taken.every((t) => box.right < t.left || box.left > t.right || box.bottom < t.top || box.top > t.bottom)) return box;
    }
    return null;
  }

  // Over a body's middle, or above or below it; a body that is smaller than its name is not covered by it.
  #placesAt([x, y], size) {
    const out = size / 2 + HEIGHT / 2, isSmall = size < 2 * HEIGHT, ways = isSmall ? [-out, out, -out - HEIGHT, out + HEIGHT] : [0, -HEIGHT, HEIGHT, -2 * HEIGHT, 2 * HEIGHT];
    return ways.map((dy) => [x, y + dy]);
  }

  // Beside the line between two points, on either side of it; or beyond one of its ends.
  #placesBeside([[x1, y1], [x2, y2]], width) {
    const [x, y] = [(x1 + x2) / 2, (y1 + y2) / 2], length = Math.hypot(x2 - x1, y2 - y1), [nx, ny] = length > 1 ? [(y1 - y2) / length, (x2 - x1) / length] : [1, 0];
    const off = (Math.abs(nx) * width + Math.abs(ny) * HEIGHT) / 2 + DOT + 2, out = width / 2 + DOT + 4, side = nx < 0 ? -off : off;
    return [[x + nx * side, y + ny * side], [x - nx * side, y - ny * side], [Math.max(x1, x2) + out, y], [Math.min(x1, x2) - out, y]];
  }

  #width(text, weight = 400) {
    this.context ??= document.createElement('canvas').getContext('2d');
    this.context.font = `${weight} 12px system-ui, sans-serif`;
    return Math.ceil(this.context.measureText(text).width) + 18;
  }

  #node(body) {
    if (!this.nodes.has(body)) {
      const text = shorten(body.name, LONGEST), node = element('div', { className: 'label', textContent: text });
      this.nodes.set(body, { node, width: this.#width(text) });
    }
    return this.nodes.get(body);
  }

  #put(node, box, shown) {
    node.style.width = `${box.right - box.left}px`;
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
      const text = labelAnswer(answer, this.model.unit), width = this.#width(text, 600), ends = line.points.map(project).filter(Boolean);
      // Beside the line, so that this is seen.
      const box = ends.length === 2 && this.#findPlace(this.#placesBeside(ends, width), width, taken, frame);
      taken.push(...ends.map(([x, y]) => ({ left: x - DOT, right: x + DOT, top: y - DOT, bottom: y + DOT })));
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
      const { node, width } = this.#node(body), size = sizes[body.index], middle = project(at.set(...body.center));
      if (bodies.length > FEW && !isFirst(body) && size < NARROWEST * width) continue;
      const box = middle && this.#findPlace(this.#placesAt(middle, size), width, taken, frame);
      if (!box) continue;
      taken.push(box);
      node.style.borderColor = `#${colors.get(body).getHexString()}`;
      this.#put(node, box, shown);
    }
    for (const node of [...this.root.children]) if (!shown.includes(node)) node.remove();
    for (const node of shown) if (node.parentNode !== this.root) this.root.append(node);
  }
}
