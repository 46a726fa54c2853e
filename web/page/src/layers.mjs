// What can be drawn, in layers: each a batch of instances of geometries, made when it is first shown. A layer of many
// triangles has its geometries in levels, coarser ones for what is small in the picture, and what is smallest is drawn as
// balls, all by one call: it is the calls that take the time then.
import { BatchedMesh, Color, DoubleSide, IcosahedronGeometry, InstancedMesh, Matrix4, MeshLambertMaterial, MeshStandardMaterial, OctahedronGeometry, SphereGeometry } from 'three';
import { makeAreas, makeEllipsoidMatrix, makeHull, makeMesh, makePoseMatrix, simplify } from './geometry.mjs';

const AREAS = ['#1f77b4', '#ff7f0e', '#2ca02c', '#d62728', '#9467bd', '#8c564b', '#e377c2', '#bcbd22'].map((c) => new Color(c).toArray());

/** The pixels below which a level is taken, and the cells of its grid. */
const LEVELS = [{ pixels: 90, cells: 10 }, { pixels: 30, cells: 4 }, { pixels: 12 }];
const FAR = LEVELS.length;
/** What a call costs, in triangles. */
const CALL = 20;

// Lambert's material takes half of the time of the standard one where there is no graphics card.
const solid = () => new MeshLambertMaterial({ side: DoubleSide });
const glass = (color, opacity) => new MeshStandardMaterial({ color, transparent: true, opacity, depthWrite: false, roughness: 0.4, side: DoubleSide });

const makeOwn = (model, part, uses) => (part.shape.mesh ? makeMesh(part.shape.mesh) : makeHull(model.ovoid, part.shape, uses));

/** Of each layer: its material, what it has of a part of a body, and which geometry that is. */
const KINDS = {
  meshes: { material: solid, key: ({ index }) => index, make: makeOwn },
  // Bodies beside a chosen pair, which may stand before it.
  ghosts: { material: () => Object.assign(solid(), { transparent: true, opacity: 0.16, depthWrite: false }), key: ({ index }) => index, make: makeOwn },
  hulls: { material: solid, key: ({ index }) => index, make: (model, part, uses) => makeHull(model.ovoid, part.shape, uses) },
  areas: { material: () => Object.assign(solid(), { vertexColors: true }), key: ({ index, shape }) => (shape.areas ? index : null), make: (model, part) => makeAreas(part.shape, AREAS) },
  outer: { material: () => glass('#4e79a7', 0.16), ellipsoid: 'outer' },
  inner: { material: () => glass('#e15759', 0.55), ellipsoid: 'inner' },
};
export const NAMES = Object.keys(KINDS);

const countTriangles = (geometry) => geometry.getIndex().count / 3;

function makeBalls(count) {
  const balls = [new SphereGeometry(1, 40, 24), new SphereGeometry(1, 14, 8), new IcosahedronGeometry(1, 1)];
  for (const ball of balls) if (!ball.getIndex()) ball.setIndex(Array.from({ length: ball.getAttribute('position').count }, (_, i) => i));
  return count > 50 ? balls : balls.slice(0, 1);
}

function makeFar() {
  const ball = new OctahedronGeometry(1, 0);
  ball.setAttribute('normal', ball.getAttribute('position').clone());
  ball.setIndex(Array.from({ length: 24 }, (_, i) => i));
  return ball;
}

export class Layer {
  /** from: as many triangles or items as a layer with levels has. */
  constructor(model, name, from) {
    this.name = name;
    this.items = [];
    this.byBody = new Map(model.bodies.map((body) => [body, []]));
    this.material = KINDS[name].material();
    const { key, make, ellipsoid } = KINDS[name], uses = new Map(), firsts = new Map();
    for (const body of model.bodies)
      for (const part of body.parts) {
        const number = ellipsoid ? 0 : key(part);
        if (number === null) continue;
        const at = makePoseMatrix(part.pose), ball = makeEllipsoidMatrix(part.shape[ellipsoid ?? 'outer'], part.shape.radius);
        const item = { body, number, matrix: ellipsoid ? at.multiply(ball) : at, ball: ellipsoid ? null : ball, world: new Matrix4(), level: 0 };
        this.items.push(item);
        this.byBody.get(body).push(item);
        uses.set(number, (uses.get(number) ?? 0) + 1);
        firsts.set(number, part);
      }
    const levels = new Map([...firsts].map(([number, part]) => [number, ellipsoid ? makeBalls(this.items.length) : [make(model, part, uses.get(number))]]));
    const triangles = [...uses].reduce((sum, [number, n]) => sum + n * countTriangles(levels.get(number)[0]), 0);
    this.hasLevels = triangles > from.triangles || this.items.length > from.items;
    if (this.hasLevels && !ellipsoid && name !== 'areas') for (const list of levels.values()) addLevels(list);
    this.#batch(levels);
  }

  static has(model, name) {
    return model.bodies.some(({ parts }) => parts.some((part) => KINDS[name].ellipsoid || KINDS[name].key(part) !== null));
  }

  #batch(levels) {
    const all = [...new Set([...levels.values()].flat())], sum = (get) => all.reduce((n, geometry) => n + get(geometry), 0);
    this.batch = new BatchedMesh(this.items.length, sum((g) => g.getAttribute('position').count), sum((g) => g.getIndex().count), this.material);
    this.batch.sortObjects = false;
    this.far = new InstancedMesh(makeFar(), this.material, this.hasLevels ? this.items.length : 0);
    this.far.count = 0;
    for (const mesh of (this.meshes = [this.batch, this.far])) mesh.frustumCulled = false;
    const ids = new Map(all.map((geometry) => [geometry, this.batch.addGeometry(geometry)]));
    for (const item of this.items) {
      item.levels = levels.get(item.number).map((geometry) => ({ geometry, id: ids.get(geometry), triangles: countTriangles(geometry) }));
      item.i = this.batch.addInstance(item.levels[0].id);
    }
    this.farItems = [];
  }

  /** The body of what a ray met. */
  bodyOf({ object, batchId, instanceId }) {
    return (object === this.far ? this.farItems[instanceId] : this.items[batchId]).body;
  }

  place(body, at, isShown) {
    for (const item of this.byBody.get(body)) {
      item.isShown = isShown;
      this.batch.setMatrixAt(item.i, item.world.multiplyMatrices(at, item.matrix));
      this.batch.setVisibleAt(item.i, isShown && item.level < FAR);
    }
    this.isFarOld = true;
  }

  paint(body, color) {
    for (const item of this.byBody.get(body)) this.batch.setColorAt(item.i, (item.color = color));
    this.isFarOld = true;
  }

  /** What it costs to draw bodies of these sizes in pixels, where levels begin at so many times their pixels. */
  measure(sizes, factor) {
    let sum = 0;
    for (const item of this.items) if (item.isShown) sum += this.hasLevels ? costOf(item, findLevel(item, sizes[item.body.index], factor)) : costOf(item, 0);
    return sum;
  }

  setLevels(sizes, factor) {
    if (!this.hasLevels) return;
    for (const item of this.items) {
      const level = findLevel(item, sizes[item.body.index], factor);
      if (level === item.level) continue;
      if (level === FAR || item.level === FAR) {
        this.batch.setVisibleAt(item.i, item.isShown && level !== FAR);
        this.isFarOld = true;
      }
      item.level = level;
      if (level !== FAR) this.batch.setGeometryIdAt(item.i, item.levels[level].id);
    }
    if (this.isFarOld) this.#fillFar();
  }

  /** What is drawn: geometries, where they are, their colours. */
  listDrawn() {
    return this.items.filter(({ isShown }) => isShown).map(({ level, levels, world, ball, color }) => ({
      geometry: level === FAR ? this.far.geometry : levels[level].geometry,
      world: level === FAR && ball ? new Matrix4().multiplyMatrices(world, ball) : world,
      color: color ?? this.material.color,
    }));
  }

  /** How many triangles are drawn. */
  get drawn() {
    return this.items.reduce((sum, item) => sum + (item.isShown ? countOf(item, item.level) : 0), 0);
  }
  get all() {
    return this.items.reduce((sum, item) => sum + (item.isShown ? item.levels[0].triangles : 0), 0);
  }

  #fillFar() {
    const at = new Matrix4(), { far } = this;
    this.farItems = this.items.filter((item) => item.isShown && item.level === FAR);
    this.farItems.forEach(({ world, ball, color }, i) => {
      far.setMatrixAt(i, ball ? at.multiplyMatrices(world, ball) : world);
      if (color) far.setColorAt(i, color);
    });
    far.count = this.farItems.length;
    far.boundingSphere = null;
    far.instanceMatrix.needsUpdate = true;
    if (far.instanceColor) far.instanceColor.needsUpdate = true;
    this.isFarOld = false;
  }
}

// Coarser geometries of one, as long as each has much less.
function addLevels(list) {
  for (const { cells } of LEVELS) {
    if (!cells) continue;
    const last = list[list.length - 1], next = countTriangles(last) > 20 ? simplify(last, cells) : last;
    list.push(countTriangles(next) < 0.7 * countTriangles(last) && countTriangles(next) >= 4 ? next : last);
  }
}

const countOf = (item, level) => (level === FAR ? 8 : item.levels[level].triangles);
const costOf = (item, level) => countOf(item, level) + (level === FAR ? 0 : CALL);

function findLevel(item, pixels, factor) {
  let level = 0;
  while (level < FAR && pixels < LEVELS[level].pixels * factor) level++;
  return level === FAR || level < item.levels.length ? level : item.levels.length - 1;
}
