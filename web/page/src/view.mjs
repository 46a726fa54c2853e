// The picture: bodies in layers, each a set of instances of one geometry; the chosen pair; the camera.
import {
  AmbientLight, BufferGeometry, Color, DirectionalLight, DoubleSide, Group, HemisphereLight, IcosahedronGeometry, InstancedMesh, Line, LineBasicMaterial,
  Matrix4, Mesh, MeshBasicMaterial, MeshStandardMaterial, PerspectiveCamera, Quaternion, Raycaster, Scene, SphereGeometry, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { TransformControls } from 'three/examples/jsm/controls/TransformControls.js';
import { makeAreas, makeEllipsoidMatrix, makeHull, makeMesh, makePoseMatrix } from './geometry.mjs';

const COLORS = ['#4e79a7', '#f28e2b', '#59a14f', '#b07aa1', '#76b7b2', '#edc948', '#9c755f', '#86bcb6', '#d4a6c8', '#8cd17d'];
const AREAS = ['#1f77b4', '#ff7f0e', '#2ca02c', '#d62728', '#9467bd', '#8c564b', '#e377c2', '#bcbd22'].map((c) => new Color(c).toArray());
const CHOSEN = new Color('#ffb000');
const HIDDEN = new Matrix4().makeScale(0, 0, 0);

const solidMaterial = () => new MeshStandardMaterial({ roughness: 0.75, metalness: 0.05, side: DoubleSide });
const glass = (color, opacity) => new MeshStandardMaterial({ color, transparent: true, opacity, depthWrite: false, roughness: 0.4, side: DoubleSide });

/** What can be drawn: for each body's part a geometry and a matrix in the body's frame. */
function makeLayers(model) {
  const { ovoid, bodies } = model, ball = bodies.length > 1000 ? new SphereGeometry(1, 14, 8) : new SphereGeometry(1, 40, 24);
  const uses = new Map();
  for (const { parts } of bodies) for (const { index } of parts) uses.set(index, (uses.get(index) ?? 0) + 1);
  const layers = { hulls: new Map(), meshes: new Map(), areas: new Map(), outer: new Map(), inner: new Map() };
  const geometries = new Map(), cached = (key, make) => geometries.get(key) ?? geometries.set(key, make()).get(key);
  const add = (layer, key, make, body, matrix) => {
    const list = layers[layer].get(key) ?? layers[layer].set(key, { geometry: cached(`${layer} ${key}`, make), items: [] }).get(key);
    list.items.push({ body, matrix });
  };
  for (const body of bodies) {
    for (const part of body.parts) {
      const at = makePoseMatrix(part.pose), { shape, index } = part;
      add('hulls', index, () => makeHull(ovoid, shape, uses.get(index)), body, at);
      add('meshes', shape.mesh ? index : `hull ${index}`, () => (shape.mesh ? makeMesh(shape.mesh) : cached(`hulls ${index}`)), body, at);
      if (shape.areas) add('areas', index, () => makeAreas(shape, AREAS), body, at);
      add('outer', 'ball', () => ball, body, at.clone().multiply(makeEllipsoidMatrix(shape.outer, shape.radius)));
      add('inner', 'ball', () => ball, body, at.clone().multiply(makeEllipsoidMatrix(shape.inner, shape.radius)));
    }
  }
  return layers;
}

export class View {
  constructor(model, canvas, onPick, onDrag) {
    this.model = model;
    this.canvas = canvas;
    this.shown = { meshes: true, hulls: false, areas: false, outer: false, inner: false, witness: true };
    this.opacity = 1;
    this.only = null;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(40, 1, 0.01, 1000);
    this.camera.up.set(0, 0, 1);
    this.#light();
    this.#build();
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    this.#addHandles(onDrag);
    this.pairGroup = new Group();
    this.scene.add(this.pairGroup);
    this.#listen(onPick);
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
    this.fit();
  }

  #light() {
    this.scene.add(new AmbientLight('#ffffff', 0.5), new HemisphereLight('#ffffff', '#9a9aa5', 1.4));
    this.sun = new DirectionalLight('#ffffff', 1.6);
    this.scene.add(this.sun);
  }

  #build() {
    this.layers = {};
    this.instances = new Map(this.model.bodies.map((body) => [body, []]));
    for (const [name, sets] of Object.entries(makeLayers(this.model))) {
      const group = (this.layers[name] = new Group());
      for (const { geometry, items } of sets.values()) {
        const material = name === 'outer' ? glass('#4e79a7', 0.16) : name === 'inner' ? glass('#e15759', 0.55) : solidMaterial();
        if (name === 'areas') material.vertexColors = true;
        const mesh = new InstancedMesh(geometry, material, items.length);
        mesh.frustumCulled = false;
        mesh.userData.bodies = items.map((item) => item.body);
        items.forEach(({ body, matrix }, i) => {
          this.instances.get(body).push({ mesh, i, matrix });
          if (name === 'meshes' || name === 'hulls') mesh.setColorAt(i, new Color(this.colorOf(body)));
        });
        group.add(mesh);
      }
      this.scene.add(group);
    }
    for (const body of this.model.bodies) this.place(body);
    this.show({});
  }

  colorOf(body) {
    return body.isObstacle ? '#9aa0a6' : COLORS[body.index % COLORS.length];
  }

  /** Puts a body's instances where it is. */
  place(body) {
    const at = makePoseMatrix(body.pose), isHidden = this.only && !this.only.has(body);
    for (const { mesh, i, matrix } of this.instances.get(body)) {
      mesh.setMatrixAt(i, isHidden ? HIDDEN : at.clone().multiply(matrix));
      mesh.instanceMatrix.needsUpdate = true;
      mesh.boundingSphere = null;
    }
  }
  placeAll() {
    for (const body of this.model.bodies) this.place(body);
    this.draw();
  }

  /** Which layers are shown; hulls are glass where meshes are shown too. */
  show(changes) {
    Object.assign(this.shown, changes);
    const { shown } = this;
    for (const [name, group] of Object.entries(this.layers)) group.visible = shown[name];
    const paint = (name, opacity) => {
      for (const { material } of this.layers[name].children) {
        material.opacity = opacity;
        material.transparent = opacity < 1;
        material.depthWrite = opacity === 1;
        material.needsUpdate = true;
      }
    };
    const isVeiled = shown.inner || shown.outer ? Math.min(this.opacity, shown.inner ? 0.45 : 1) : this.opacity;
    paint('meshes', isVeiled);
    paint('hulls', shown.meshes ? Math.min(0.3, isVeiled) : isVeiled);
    paint('areas', isVeiled);
    if (this.pairGroup) this.pairGroup.visible = shown.witness;
    this.draw();
  }

  /** Colours what is chosen, and leaves out the rest where it is isolated. */
  choose(bodies, only) {
    const chosen = new Set(bodies), changed = this.only;
    this.only = only && chosen.size ? chosen : null;
    for (const body of this.model.bodies) {
      const color = chosen.has(body) && !this.only ? new Color(this.colorOf(body)).lerp(CHOSEN, 0.65) : new Color(this.colorOf(body));
      for (const { mesh, i } of this.instances.get(body))
        if (mesh.instanceColor) {
          mesh.setColorAt(i, color);
          mesh.instanceColor.needsUpdate = true;
        }
      if (this.only || changed) this.place(body);
    }
    this.draw();
  }

  /** Draws the witness points of an answer: two balls, the way between them. */
  showAnswer(answer) {
    this.pairGroup.clear();
    if (!answer || !answer.point_a) return this.draw();
    const [a, b] = [answer.point_a, answer.point_b].map((p) => new Vector3(...p)), size = this.model.ball.radius * 0.008;
    const color = answer.status === 'separated' ? '#2e9e4f' : '#d62728', paint = new MeshBasicMaterial({ color, depthTest: false, transparent: true });
    for (const at of [a, b]) {
      const dot = new Mesh(new IcosahedronGeometry(size, 3), paint);
      dot.position.copy(at);
      this.pairGroup.add(dot);
    }
    this.pairGroup.add(new Line(new BufferGeometry().setFromPoints([a, b]), new LineBasicMaterial({ color, depthTest: false, transparent: true, linewidth: 2 })));
    this.pairGroup.traverse((object) => (object.renderOrder = 10));
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
    const names = ['meshes', 'hulls', 'areas'].filter((name) => this.shown[name]);
    const [hit] = ray.intersectObjects(names.flatMap((name) => this.layers[name].children), false);
    return hit ? hit.object.userData.bodies[hit.instanceId] : null;
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
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** The camera on a ball, from where it looks now. */
  fit({ center, radius } = this.model.ball, direction) {
    const from = direction ?? (this.isFit ? this.camera.position.clone().sub(this.controls.target) : new Vector3(1, -1.6, 0.9));
    const distance = (radius * 1.15) / Math.sin((Math.min(this.camera.fov, this.camera.fov * this.camera.aspect) * Math.PI) / 360);
    const target = new Vector3(...center);
    this.flyTo(target.clone().addScaledVector(from.normalize(), distance), target, !this.isFit);
    this.isFit = true;
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

  draw() {
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      this.sun.position.copy(this.camera.position);
      this.renderer.render(this.scene, this.camera);
    });
  }

  /** What is seen, without handles. */
  drawNow() {
    this.renderer.render(this.scene, this.camera);
  }
}
