// bench.mjs PACKAGES: nanoseconds a query of this package under Node.js, beside the native library and beside the packages
// of Rapier and Jolt where they answer the same question about two convex hulls; and how far their answers are off the
// proven bracket. PACKAGES: the folder where npm installed them. BENCH_WEB names the native program. See bench.sh.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { load } from '../../build/wasm/package/node.mjs';
import { makePairs, writePairs } from './pairs.mjs';

const COUNT = 1000, ROUNDS = 15, FAR = 10;
const require = createRequire(join(resolve(process.argv[2]), 'package.json'));
const ovoid = await load();

/** Nanoseconds a pair, the least of several rounds. */
function time(pairs, ask) {
  let best = Infinity;
  for (let round = 0; round < ROUNDS; round++) {
    const start = process.hrtime.bigint();
    for (const pair of pairs) ask(pair);
    best = Math.min(best, Number(process.hrtime.bigint() - start));
  }
  return best / pairs.length;
}

/** Rapier: single precision, one contact within a prediction, a negative distance where the hulls overlap. */
async function openRapier() {
  const { default: rapier } = await import(pathToFileURL(require.resolve('@dimforge/rapier3d-compat')));
  await rapier.init();
  return ({ points }) => {
    const world = new rapier.World({ x: 0, y: 0, z: 0 });
    // Twice, as a hull may be asked about itself.
    const [first, second] = [0, 1].map(() => points.map((p) => world.createCollider(rapier.ColliderDesc.convexHull(Float32Array.from(p.flat())))));
    const place = ({ b, pose: { xyz: [x, y, z], quat_wxyz: [w, i, j, k] } }) => {
      second[b].setTranslation({ x, y, z });
      second[b].setRotation({ x: i, y: j, z: k, w });
    };
    const distance = (pair) => (place(pair), first[pair.a].contactCollider(second[pair.b], FAR)?.distance);
    const collide = (pair) => (place(pair), first[pair.a].contactCollider(second[pair.b], 0) !== null);
    return { collide, distance, depth: distance };
  };
}

// What registers Jolt's kinds of shapes: a world, which is not used.
function startJolt(jolt) {
  const settings = new jolt.JoltSettings(), pairs = new jolt.ObjectLayerPairFilterTable(1), layers = new jolt.BroadPhaseLayerInterfaceTable(1, 1);
  layers.MapObjectToBroadPhaseLayer(0, new jolt.BroadPhaseLayer(0));
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter = new jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1);
  return new jolt.JoltInterface(settings);
}

/** Jolt: single precision, the deepest hit of two shapes within a separation, its depth negative where they are apart. */
async function openJolt() {
  const { default: init } = await import(pathToFileURL(require.resolve('jolt-physics')));
  const jolt = await init();
  startJolt(jolt);
  const zero = new jolt.RVec3(0, 0, 0), one = new jolt.Vec3(1, 1, 1), filter = new jolt.ShapeFilter();
  return ({ points }) => {
    const shapes = points.map((list) => {
      const settings = new jolt.ConvexHullShapeSettings();
      settings.mMaxConvexRadius = 0;
      for (const [x, y, z] of list) settings.mPoints.push_back(new jolt.Vec3(x, y, z));
      return settings.Create().Get();
    });
    const centers = shapes.map((shape) => ['GetX', 'GetY', 'GetZ'].map((name) => shape.GetCenterOfMass()[name]()));
    const still = shapes.map((shape, i) => {
      const body = new jolt.TransformedShape();
      Object.assign(body, { mShape: shape, mShapePositionCOM: new jolt.RVec3(...centers[i]), mShapeRotation: new jolt.Quat(0, 0, 0, 1) });
      body.SetShapeScale(one);
      return body;
    });
    const settings = new jolt.CollideShapeSettings(), collector = new jolt.CollideShapeClosestHitCollisionCollector();
    const position = new jolt.RVec3(0, 0, 0), rotation = new jolt.Quat(0, 0, 0, 1);
    const ask = ({ a, b, pose: { xyz: [x, y, z], quat_wxyz: [w, i, j, k] } }, separation) => {
      position.Set(x, y, z);
      rotation.Set(i, j, k, w);
      settings.mMaxSeparationDistance = separation;
      collector.Reset();
      const center = shapes[b].GetCenterOfMass(), at = jolt.RMat44.prototype.sRotationTranslation(rotation, position).PreTranslated(center);
      still[a].CollideShape(shapes[b], one, at, settings, zero, collector, filter);
      return collector.HadHit() ? -collector.mHit.mPenetrationDepth : undefined;
    };
    const distance = (pair) => ask(pair, FAR);
    return { collide: (pair) => ask(pair, 0) !== undefined, distance, depth: distance };
  };
}

const QUERIES = ['collide', 'distance', 'depth'], others = { Rapier: await openRapier(), Jolt: await openJolt() };
const folder = mkdtempSync(join(tmpdir(), 'ovoid-bench-'));
console.log('| vertices | gap | query | native | this package | in a batch | Rapier | off by | Jolt | off by |\n|---:|---:|---|---:|---:|---:|---:|---:|---:|---:|');
for (const vertices of [8, 32, 128])
  for (const gap of [0.2, -0.2]) {
    const given = makePairs(ovoid, vertices, gap, COUNT), { shapes, pairs } = given, file = join(folder, 'pairs.bin');
    writePairs(file, given);
    const native = execFileSync(process.env.BENCH_WEB, [file], { encoding: 'utf8' }).trim().split('\n').map(Number);
    const peers = Object.values(others).map((open) => open(given));
    const bodies = pairs.flatMap(({ a, b, pose }) => [{ shape: shapes[a] }, { shape: shapes[b], pose }]), couples = Uint32Array.from(bodies, (_, i) => i);
    for (const query of gap > 0 ? ['collide', 'distance'] : ['collide', 'depth']) {
      const own = time(pairs, ({ a, b, pose }) => ovoid[query](shapes[a], null, shapes[b], pose));
      const batch = time([0], () => ovoid.batch(query, bodies, couples)) / COUNT;
      const columns = peers.flatMap((peer) => {
        const ns = time(pairs, peer[query]);
        let worst = 0;
        for (const pair of pairs) {
          const { lower, upper, status } = ovoid.depth(shapes[pair.a], shapes[pair.b], null, pair.pose), said = peer[query](pair);
          worst = Math.max(worst, query === 'collide' ? Number(said !== (status === 'overlapping')) : Math.max(lower - said, said - upper, 0));
        }
        return [ns.toFixed(0), query === 'collide' ? (worst ? 'wrong' : 'right') : Number.isNaN(worst) ? 'no answer' : worst.toExponential(0)];
      });
      console.log(`| ${[vertices, gap > 0 ? '10 %' : '-10 %', query, native[QUERIES.indexOf(query)].toFixed(0), own.toFixed(0), batch.toFixed(0), ...columns].join(' | ')} |`);
    }
  }
rmSync(folder, { recursive: true });
