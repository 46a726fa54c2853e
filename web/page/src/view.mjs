// The picture: bodies in layers, the chosen pair, the camera; as many triangles as the machine draws in time.
import {
  AmbientLight, Color, CylinderGeometry, DirectionalLight, Group, HemisphereLight, IcosahedronGeometry, Mesh, MeshBasicMaterial,
  PerspectiveCamera, Quaternion, Raycaster, Scene, Spherical, Vector2, Vector3,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { TransformControls } from 'three/examples/jsm/controls/TransformControls.js';
import { Contacts } from './contacts.mjs';
import { makePoseMatrix } from './geometry.mjs';
import { Layer, NAMES } from './layers.mjs';
import { Outline } from './outline.mjs';

const COLORS = ['#4e79a7', '#f28e2b', '#59a14f', '#b07aa1', '#76b7b2', '#edc948', '#9c755f', '#86bcb6', '#d4a6c8', '#8cd17d'];
const CHOSEN = '#e0007a';
const ANSWERS = { separated: '#1b8a3f', undecided: '#b07a00' }, UP = new Vector3(0, 1, 0);

/** Milliseconds that a picture may take while it moves, and when it rests. */
const MOVING = 60, RESTING = 700;
/** How much wider than the bodies a picture of all is. */
const ROOM = 1.12;
/** Half of how wide a witness point is, in pixels. */
const DOT = 4.5;
/** Of more triangles, bodies beside a chosen pair stay as they are. */
const MOST_GHOSTS = 400000;
/** How far an arrow key turns the view. */
const TURN = Math.PI / 36;

export class View {
  constructor(model, renderer, onPick, onDrag) {
    this.model = model;
    this.renderer = renderer;
    this.canvas = renderer.domElement;
    this.shown = { meshes: true, ghosts: false, hulls: false, areas: false, outer: false, inner: false, witness: true, contacts: true };
    this.opacity = 1;
    this.only = null;
    this.layers = {};
    this.colors = new Map(model.bodies.map((body) => [body, new Color(body.isObstacle ? '#9aa0a6' : COLORS[body.index % COLORS.length])]));
    this.chosen = new Set();
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(40, 1, 0.01, 1000);
    this.camera.up.set(0, 0, 1);
    this.pairGroup = new Group();
    this.outline = new Outline(new Color(CHOSEN));
    this.contacts = new Contacts();
    this.scene.add(this.pairGroup, this.outline.group, this.contacts.group);
    this.#light();
    this.show({});
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener('change', () => this.draw());
    this.#addHandles(onDrag);
    this.#listen(onPick);
    new ResizeObserver(() => this.resize()).observe(this.canvas.parentElement);
    this.resize();
    this.fit();
  }

  #light() {
    this.scene.add(new AmbientLight('#ffffff', 0.5), new HemisphereLight('#ffffff', '#9a9aa5', 1.4));
    this.sun = new DirectionalLight('#ffffff', 1.6);
    this.scene.add(this.sun);
  }

  /** A layer, made when it is first needed. */
  #need(name) {
    if (this.layers[name]) return;
    const layer = (this.layers[name] = new Layer(this.model, name, this.renderer.limits.levels));
    this.scene.add(...layer.meshes);
    for (const body of this.model.bodies) {
      this.#placeIn(layer, body);
      this.#paintIn(layer, body);
    }
  }

  get shownLayers() {
    return Object.values(this.layers).filter(({ name }) => this.shown[name]);
  }

  #placeIn(layer, body) {
    const isGhost = this.shown.ghosts && !this.chosen.has(body), isHere = layer.name === 'meshes' ? !isGhost : layer.name !== 'ghosts' || isGhost;
    layer.place(body, makePoseMatrix(body.pose), isHere && (!this.only || this.only.has(body)));
  }
  #placeAgain() {
    for (const layer of Object.values(this.layers)) for (const body of this.model.bodies) this.#placeIn(layer, body);
  }
  #paintIn(layer, body) {
    if (!['meshes', 'ghosts', 'hulls'].includes(layer.name)) return;
    layer.paint(body, this.colors.get(body));
  }

  /** Puts a body's instances where it is. */
  place(body) {
    for (const layer of Object.values(this.layers)) this.#placeIn(layer, body);
  }
  placeAll() {
    for (const body of this.model.bodies) this.place(body);
    this.draw();
  }

  /** Which layers are shown; hulls are glass where meshes are shown too. */
  show(changes) {
    Object.assign(this.shown, changes);
    const { shown } = this, wasGhosts = shown.ghosts;
    // Others than a chosen pair are seen through, where that costs little.
    shown.ghosts = shown.meshes && this.isPair === true && this.layers.meshes.all <= MOST_GHOSTS;
    for (const name of NAMES) {
      if (shown[name]) this.#need(name);
      for (const mesh of this.layers[name]?.meshes ?? []) mesh.visible = shown[name];
    }
    const paint = (name, opacity) => {
      const material = this.layers[name]?.material;
      if (material) Object.assign(material, { opacity, transparent: opacity < 1, depthWrite: opacity === 1, needsUpdate: true });
    };
    const isVeiled = shown.inner || shown.outer ? Math.min(this.opacity, shown.inner ? 0.45 : 1) : this.opacity;
    paint('meshes', isVeiled);
    paint('hulls', shown.meshes ? Math.min(0.3, isVeiled) : isVeiled);
    paint('areas', isVeiled);
    this.pairGroup.visible = shown.witness;
    this.contacts.group.visible = shown.contacts;
    if (shown.ghosts !== wasGhosts) this.#placeAgain();
    this.#outlineChosen();
    this.draw();
  }

  /** Outlines what is chosen, and leaves out the rest where it is isolated. */
  choose(bodies, only) {
    const had = this.shown.ghosts || this.only !== null;
    this.chosen = new Set(bodies);
    this.only = only && this.chosen.size ? this.chosen : null;
    this.isPair = this.chosen.size === 2 && !this.only && this.model.bodies.length > 2;
    this.show({});
    if (had || this.shown.ghosts || this.only) this.#placeAgain();
    this.draw();
  }

  /** The parts of what is chosen, as the first layer that is shown has them; none where nothing else is shown. */
  get outlined() {
    const layer = this.shownLayers.find(({ name }) => name !== 'areas') ?? this.shownLayers[0];
    return layer && !this.only ? [...this.chosen].flatMap((body) => layer.byBody.get(body)) : [];
  }
  #outlineChosen() {
    this.outline.set(this.outlined);
  }

  /** Draws the witness points of an answer: two balls, the way between them. */
  showAnswer(answer) {
    this.pairGroup.clear();
    this.line = null;
    if (!answer || !answer.point_a) return this.draw();
    const [a, b] = [answer.point_a, answer.point_b].map((p) => new Vector3(...p));
    const color = ANSWERS[answer.status] ?? '#d62728', paint = new MeshBasicMaterial({ color, depthTest: false, transparent: true });
    this.line = { points: [a, b], color };
    for (const at of [a, b]) {
      const dot = new Mesh(new IcosahedronGeometry(DOT, 3), paint);
      dot.position.copy(at);
      this.pairGroup.add(dot);
    }
    const way = b.clone().sub(a), tube = new Mesh(new CylinderGeometry(DOT * 0.35, DOT * 0.35, Math.max(way.length(), 1e-12), 12), paint);
    tube.position.copy(a).addScaledVector(way, 0.5);
    tube.quaternion.setFromUnitVectors(UP, way.normalize());
    this.pairGroup.add(tube);
    this.pairGroup.traverse((object) => (object.renderOrder = 10));
    this.draw();
  }

  /** Draws contacts. */
  showContacts(list) {
    this.contacts.set(list);
    this.draw();
  }

  #addHandles(onDrag) {
    this.handle = new Group();
    this.handles = new TransformControls(this.camera, this.canvas);
    this.handles.addEventListener('dragging-changed', ({ value }) => (this.controls.enabled = !value));
    this.handles.addEventListener('change', () => this.draw());
    this.handles.addEventListener('objectChange', () => {
      const { position: p, quaternion: q } = this.handle;
      this.held.pose = { xyz: [p.x, p.y, p.z], quat_wxyz: [q.w, q.x, q.y, q.z] };
      this.place(this.held);
      onDrag(this.held);
    });
    this.scene.add(this.handle, this.handles.getHelper());
  }

  /** Puts handles on a body, to move or turn it; null: takes them away. */
  hold(body, mode = 'translate') {
    this.held = body;
    this.handles.detach();
    if (body) {
      const { xyz, quat_wxyz: [w, x, y, z] } = body.pose;
      this.handle.position.set(...xyz);
      this.handle.quaternion.copy(new Quaternion(x, y, z, w).normalize());
      this.handles.setMode(mode);
      this.handles.attach(this.handle);
    }
    this.draw();
  }

  bodyAt(x, y) {
    const box = this.canvas.getBoundingClientRect(), ray = new Raycaster();
    ray.setFromCamera(new Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2), this.camera);
    // What is seen through is found where nothing else is.
    for (const names of [['meshes', 'hulls', 'areas'], ['ghosts']]) {
      const layers = this.shownLayers.filter(({ name }) => names.includes(name)), [hit] = ray.intersectObjects(layers.flatMap(({ meshes }) => meshes), false);
      if (hit) return layers.find(({ meshes }) => meshes.includes(hit.object)).bodyOf(hit);
    }
    return null;
  }

  #listen(onPick) {
    let down = null;
    this.canvas.addEventListener('pointerdown', (event) => (down = [event.clientX, event.clientY]));
    this.canvas.addEventListener('pointerup', (event) => {
      if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4 && !this.handles.dragging) onPick(this.bodyAt(event.clientX, event.clientY));
    });
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    this.renderer.setPixelRatio(this.#pixelRatio);
    this.renderer.setSize(width, height, false);
    this.outline.resize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** The camera on a ball, from where it looks now. */
  fit(ball, direction) {
    const isAll = !ball, { center, radius } = ball ?? this.model.roomBall;
    const from = direction ?? (this.isFit ? this.camera.position.clone().sub(this.controls.target) : this.#findDirection());
    const target = new Vector3(...center), distance = isAll ? this.#measureDistance(target, from.normalize()) : this.#halfAngles.reduce((most, half) => Math.max(most, (radius * 1.15) / Math.sin(half)), 0);
    this.flyTo(target.clone().addScaledVector(from.normalize(), distance), target, !this.isFit);
    this.isFit = true;
  }

  /** All of it in the picture at once, as at the beginning. */
  fitAnew() {
    this.isFit = false;
    this.fit();
  }

  // From where the picture is first seen: from the front right, or where obstacles would hide a robot, from its side of them.
  #findDirection() {
    const { bodies } = this.model, middle = new Vector3(), first = new Vector3(1, -1.6, 0.9), links = bodies.filter((b) => b.link !== undefined);
    if (!links.length || links.length === bodies.length) return first;
    for (const body of bodies) middle.addScaledVector(new Vector3(...body.center), body.link === undefined ? -1 / (bodies.length - links.length) : 1 / links.length);
    middle.z = 0;
    if (middle.length() < 0.2 * this.model.roomBall.radius) return first;
    const rate = (d) => d.dot(middle) / (d.length() * middle.length());
    const others = [[-1, -1.6], [1, 1.6], [-1, 1.6]].map(([x, y]) => new Vector3(x, y, 0.9));
    return others.reduce((best, d) => (rate(d) > rate(best) + 0.1 ? d : best), first);
  }

  // Half of the angles that the picture is wide and high.
  get #halfAngles() {
    const up = (this.camera.fov * Math.PI) / 360;
    return [Math.atan(Math.tan(up) * this.camera.aspect), up];
  }

  // How far from a target the camera has all bodies in the picture, with some room around them.
  #measureDistance(target, from) {
    const right = new Vector3().crossVectors(this.camera.up, from).normalize(), up = new Vector3().crossVectors(from, right), at = new Vector3();
    const angles = this.#halfAngles, axes = [right, up];
    return [...this.model.listBalls(), ...this.model.room].reduce((most, { center, radius }) => {
      at.set(...center).sub(target);
      return axes.reduce((far, axis, k) => Math.max(far, at.dot(from) + (Math.abs(at.dot(axis)) * ROOM + radius / Math.cos(angles[k])) / Math.tan(angles[k])), most);
    }, 1.1 * this.model.roomBall.radius);
  }

  /** Arrow keys turn the view, + and - go nearer and farther. Returns whether the key is one of these. */
  takeKey(key) {
    const turns = { arrowleft: [-1, 0], arrowright: [1, 0], arrowup: [0, -1], arrowdown: [0, 1] }, nearer = { '+': 1 / 1.15, '=': 1 / 1.15, '-': 1.15 };
    if (!turns[key] && !nearer[key]) return false;
    const { target } = this.controls, from = new Spherical().setFromVector3(this.#upright(this.camera.position.clone().sub(target), 1)), [across, up] = turns[key] ?? [0, 0];
    from.theta += across * TURN;
    from.phi += up * TURN;
    from.radius *= nearer[key] ?? 1;
    this.flyTo(target.clone().add(this.#upright(new Vector3().setFromSpherical(from.makeSafe()), -1)), target.clone(), true);
    return true;
  }

  // The axis that is up as y (way 1), or back (way -1).
  #upright(v, way) {
    return v.applyAxisAngle(new Vector3(1, 0, 0), (-way * Math.PI) / 2);
  }

  flyTo(position, target, atOnce) {
    const from = this.camera.position.clone(), looked = this.controls.target.clone(), start = performance.now();
    cancelAnimationFrame(this.flight);
    const step = (now) => {
      const t = atOnce ? 1 : Math.min(1, (now - start) / 450), s = t * t * (3 - 2 * t);
      this.camera.position.lerpVectors(from, position, s);
      this.controls.target.lerpVectors(looked, target, s);
      const far = this.camera.position.distanceTo(this.controls.target);
      this.camera.near = far / 500;
      this.camera.far = far + 20 * this.model.ball.radius;
      this.camera.updateProjectionMatrix();
      this.controls.update();
      this.draw();
      this.flight = t < 1 ? requestAnimationFrame(step) : null;
    };
    step(start);
  }

  // Half as many each way while a picture that takes long moves.
  get #pixelRatio() {
    return Math.min(2, window.devicePixelRatio) * (this.isMoving && this.isSlow ? 0.5 : 1);
  }

  draw() {
    this.isMoving = true;
    clearTimeout(this.rest);
    this.rest = setTimeout(() => {
      this.isMoving = false;
      if (this.isSlow || this.isCoarse) this.#drawSoon();
    }, 300);
    this.#drawSoon();
  }

  #drawSoon() {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      const start = performance.now();
      this.drawNow();
      this.#measure(start);
    });
  }

  // Witness points are as large in the picture from near and from far.
  #sizeWitness() {
    const { camera, pairGroup } = this, pixel = (2 * Math.tan((camera.fov * Math.PI) / 360)) / (this.canvas.clientHeight || 1);
    for (const { geometry, position, scale } of pairGroup.children) {
      const size = pixel * position.distanceTo(camera.position);
      scale.set(size, geometry.type === 'CylinderGeometry' ? 1 : size, size);
    }
  }

  /** Draws at once. */
  drawNow() {
    this.#sizeWitness();
    this.sun.position.copy(this.camera.position);
    if (this.renderer.getPixelRatio() !== this.#pixelRatio) this.renderer.setPixelRatio(this.#pixelRatio);
    const sizes = this.#measureSizes();
    this.#refine(sizes);
    this.renderer.render(this.scene, this.camera, this.shownLayers, { lines: this.#listLines(), outlined: this.outlined, color: CHOSEN });
    this.onPicture?.(sizes);
  }

  // The lines of a picture that is painted: those of contacts, the witness points', and of what is held the handles.
  #listLines() {
    return [...(this.shown.contacts ? this.contacts.lines : []), ...(this.line && this.shown.witness ? [this.line] : []), ...this.handleLines];
  }

  /** The handles of what is held as lines: arrows or rings, as long as those of three.js. */
  get handleLines() {
    if (!this.held) return [];
    const { position: from } = this.handle, size = 0.0864 * from.distanceTo(this.camera.position), isRing = this.handles.mode === 'rotate';
    const move = (steps) => steps.reduce((at, [k, step]) => at.setComponent(k, at.getComponent(k) + size * step), from.clone());
    const ring = (k) => Array.from({ length: 48 }, (_, i) => move([[(k + 1) % 3, Math.cos((i * Math.PI) / 24)], [(k + 2) % 3, Math.sin((i * Math.PI) / 24)]]));
    return ['#e33', '#3a3', '#33e'].map((color, k) => ({ color, isRing, points: isRing ? ring(k) : [from, move([[k, 1]])] }));
  }

  /** Takes coarser levels of what is small, until the triangles are as many as can be drawn in time. */
  #refine(sizes) {
    const layers = this.shownLayers, { fewest, most: highest, rate } = this.renderer.limits;
    const most = Math.min(highest, Math.max(fewest, (this.rate ?? rate) * (this.isMoving || !this.rate ? MOVING : RESTING)));
    const measure = (factor) => layers.reduce((sum, layer) => sum + layer.measure(sizes, factor), 0);
    let factor = 0, cost = measure(0);
    while (cost > most && factor < 1e6) cost = measure((factor = factor ? factor * 1.6 : 0.1));
    for (const layer of layers) layer.setLevels(sizes, factor);
    this.cost = cost;
    this.isCoarse = factor > 0;
    const sum = (name) => layers.reduce((n, layer) => n + layer[name], 0);
    if (this.isCoarse || this.wasCoarse) this.onDrawn?.(sum('drawn'), sum('all'));
    this.wasCoarse = this.isCoarse;
  }

  // Of each body how many pixels its ball is wide.
  #measureSizes() {
    const { camera } = this, scale = (this.canvas.clientHeight || 1) / Math.tan((camera.fov * Math.PI) / 360), at = new Vector3();
    return Float64Array.from(this.model.bodies, ({ center, radius }) => (scale * radius) / Math.max(at.set(...center).distanceTo(camera.position), 1e-9));
  }

  // How many triangles a millisecond are drawn, known when the picture is there.
  #measure(start) {
    if (this.isMeasured) return;
    this.isMeasured = true;
    const { cost } = this, wasMoving = this.isMoving;
    this.renderer.wait(() => {
      this.isMeasured = false;
      const time = Math.max(1, performance.now() - start), rate = Math.max(cost, 1000) / time;
      if (wasMoving && this.rate) this.isSlow = this.isSlow ? time > MOVING / 3 : time > 2 * MOVING;
      // The first picture has shaders compiled.
      const isFirst = this.rate === undefined;
      this.rate = isFirst ? Math.max(rate, 300) : 0.6 * this.rate + 0.4 * rate;
      if (isFirst && !this.isMoving && this.isCoarse) this.#drawSoon();
      performance.mark('picture');
    });
  }
}
