// The package against known answers, against the tool's bits, and against what it must refuse.
// OVOID names the tool. Run by scripts/wasm.sh.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { load } from '../../build/wasm/package/node.mjs';

const ovoid = await load();
const { Shape, Compound, Solid, Robot } = ovoid;

// xorshift32: the same numbers everywhere.
let state = 2463534242;
function random() {
  state ^= state << 13;
  state ^= state >>> 17;
  state ^= state << 5;
  return (state >>> 0) / 4294967296;
}
const between = (a, b) => a + (b - a) * random();

function makeScene(count) {
  return Array.from({ length: count }, (_, i) => ({
    name: `body ${i}`,
    points: Array.from({ length: 4 + Math.floor(40 * random()) }, () => [between(-1, 1), between(-1, 1), between(-1, 1)]),
    pose: { xyz: [between(-3, 3), between(-3, 3), between(-3, 3)], quat_wxyz: [between(0.1, 1), between(-1, 1), between(-1, 1), between(-1, 1)] },
  }));
}

/** The lines of ovoid check of a scene and files beside it; some bodies overlap, whose exit status is 1. */
function checkByTool(scene, files = {}, options = []) {
  const folder = mkdtempSync(join(tmpdir(), 'ovoid-'));
  try {
    for (const [name, text] of Object.entries({ 'scene.json': JSON.stringify(scene), ...files })) writeFileSync(join(folder, name), text);
    const { status, stdout, stderr } = spawnSync(process.env.OVOID, ['check', join(folder, 'scene.json'), '--json', ...options], { encoding: 'utf8', maxBuffer: 1 << 28 });
    assert.equal(status, 1, stderr);
    return stdout.trim().split('\n').map((line) => JSON.parse(line));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** An answer with its bracket moved. */
const moved = (line, by) => ({ ...line, lower: line.lower + by, upper: line.upper + by });

test("a scene's pairs have the bits of the tool, proofs included, and every proof holds", () => {
  const objects = makeScene(40), lines = checkByTool({ objects }), seen = { separated: 0, overlapping: 0 };
  const shapes = new Map(objects.map((o) => [o.name, Shape.fromPoints(o.points)])), poses = new Map(objects.map((o) => [o.name, o.pose]));
  assert.equal(lines.length, (40 * 39) / 2);
  for (const { a, b, kind_a, kind_b, ...line } of lines) {
    assert.deepEqual([kind_a, kind_b], ['hull', 'hull']);
    const pair = [shapes.get(a), shapes.get(b), poses.get(a), poses.get(b)];
    const answer = ovoid.depth(...pair);
    assert.deepEqual(answer.toJSON(), line);
    assert.equal(ovoid.verify(...pair, line), null);
    if (line.proof.cover) assert.ok(ovoid.verify(...pair, { ...line, proof: { ...line.proof, cover: undefined } }), 'the cover of the last check is gone');
    assert.match(ovoid.verify(...pair, moved(line, 1e-6)).message, /lower bound/);
    assert.match(ovoid.verify(...pair, moved(line, -1e-6)).message, /upper bound/);
    seen[answer.status]++;
  }
  assert.ok(seen.separated > 100 && seen.overlapping > 20, JSON.stringify(seen));
});

// An L of three cubes: its corner's distance is not its hull's.
const outline = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]], corners = [0, 1].flatMap((z) => outline.map(([x, y]) => [x, y, z]));
const caps = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];
const sides = outline.flatMap((_, i) => [[i, (i + 1) % 6, 6 + ((i + 1) % 6)], [i, 6 + ((i + 1) % 6), 6 + i]]);
const faces = [...caps.map(([a, b, c]) => [a, c, b]), ...caps.map((t) => t.map((x) => x + 6)), ...sides];

test('compounds and solids have the bits of the tool; their proofs hold, altered ones do not', () => {
  const off = `OFF\n12 20 0\n${corners.map((p) => p.join(' ')).join('\n')}\n${faces.map((t) => `3 ${t.join(' ')}`).join('\n')}\n`;
  const shapes = makeScene(6).map(({ points }) => ({ points, shape: Shape.fromPoints(points) })), solid = Solid.fromTriangles(corners, faces);
  // Three of each kind, wherever they are; a small box in a large L, which is inside.
  const bodies = [], objects = makeScene(9).map(({ name, pose: { xyz, quat_wxyz } }, i) => {
    const pose = { xyz: xyz.map((x) => x / 2), quat_wxyz };
    const parts = [0, 1, 2, 3].map((k) => ({ ...shapes[(i + k) % 6], pose: { xyz: [between(-1, 1), between(-1, 1), k], quat_wxyz: [1, between(-1, 1), between(-1, 1), 0] } }));
    bodies.push({ body: [parts[0].shape, new Compound(parts.map(({ shape, pose }) => ({ shape, pose }))), solid][i % 3], pose });
    return { name, pose, ...[{ points: parts[0].points }, { compound: parts.map(({ points, pose }) => ({ points, pose })) }, { mesh: 'l.off' }][i % 3] };
  });
  bodies.push({ body: Solid.fromTriangles(corners.map((p) => p.map((x) => 16 * x)), faces), pose: { xyz: [9, 9, 9] } });
  objects.push({ name: 'large', mesh: 'l.off', scale: 16, pose: { xyz: [9, 9, 9] } });
  bodies.push({ body: Shape.box([0.5, 0.5, 0.5]), pose: { xyz: [12, 12, 20] } });
  objects.push({ name: 'within', box: [1, 1, 1], pose: { xyz: [12, 12, 20] } });
  const byName = new Map(objects.map(({ name }, i) => [name, bodies[i]])), seen = { separated: 0, overlapping: 0 };
  for (const { a, b, kind_a, kind_b, mesh_volume_a, mesh_volume_b, hull_volume_a, hull_volume_b, ...line } of checkByTool({ objects }, { 'l.off': off })) {
    const [p, q] = [byName.get(a), byName.get(b)], pair = [p.body, q.body, p.pose, q.pose];
    const answer = ovoid[line.proof.surfaces ? 'distance' : 'depth'](...pair);
    assert.deepEqual(answer.toJSON(), line, `${a} ${b}`);
    assert.equal(ovoid.verify(...pair, line), null);
    for (const by of [0.01, -0.01]) assert.ok(ovoid.verify(...pair, moved(line, by)), `${a} ${b} ${by}`);
    const { exclusions = [] } = line.proof;
    // Of compounds: turned round by what rounding left of its normal, none shows that parts are apart.
    const turned = exclusions.map((x) => ({ ...x, normal_low: x.normal.map((v) => -2 * v) }));
    if (turned.length && line.status === 'separated' && !line.proof.surfaces) assert.ok(ovoid.verify(...pair, { ...line, proof: { ...line.proof, exclusions: turned } }), `${a} ${b}`);
    if (line.proof.cover) assert.ok(ovoid.verify(...pair, { ...line, proof: { ...line.proof, cover: undefined } }), 'the cover of the last check is gone');
    if (exclusions.length > 1) assert.match(ovoid.verify(...pair, { ...line, proof: { ...line.proof, exclusions: exclusions.slice(1) } }).message, /nothing excludes/);
    if (line.inside) {
      assert.deepEqual([a, b, line.inside], ['large', 'within', 'b in a']);
      assert.ok(ovoid.verify(...pair, { ...line, inside: 'a in b' }));
      seen.inside = true;
    }
    assert.equal(ovoid.distance(...pair, { earlier: line }).status, line.status);
    seen[line.status]++;
  }
  assert.ok(seen.separated > 10 && seen.overlapping > 3 && seen.inside, JSON.stringify(seen));
  assert.ok(ovoid.distance(bodies[1].body, bodies[4].body, null, { xyz: [9, 0, 0] }).proof.exclusions.length > 0);
  // The same body twice: all faces are flush, and a point of both proves the overlap.
  const flush = ovoid.distance(solid, solid, null, null).toJSON();
  assert.deepEqual([flush.status, flush.inside, flush.common.length, flush.component], ['overlapping', 'common point', 3, undefined]);
  assert.equal(ovoid.verify(solid, solid, null, null, flush), null);
  assert.ok(ovoid.verify(solid, solid, null, null, { ...flush, common: [1.5, 1.5, 0.5] }));
});

test('the depth of balls with one centre, whose cover is larger than a search holds by itself', () => {
  const points = Array.from({ length: 800 }, (_, i) => {
    const z = (2 * (i + 0.5)) / 800 - 1, r = Math.sqrt(1 - z * z), turn = 2.399963229728653 * i;
    return [r * Math.cos(turn), r * Math.sin(turn), z];
  });
  const ball = Shape.fromPoints(points), pair = [ball, ball, null, { xyz: [0, 0, 0], quat_wxyz: [0.3, 0.4, 0.5, 0.7] }];
  const answer = ovoid.depth(...pair), { cover } = answer.proof;
  assert.equal(answer.limit, 'none');
  assert.ok(answer.upper - answer.lower < 1e-8 && cover.pairs.length > 512);
  assert.equal(ovoid.verify(...pair, answer), null);
  const cut = { ...answer.toJSON(), proof: { ...answer.toJSON().proof, cover: { ...cover, triangles: cover.triangles.slice(1) } } };
  assert.match(ovoid.verify(...pair, cut).message, /upper bound/);
  ball.free();
});

test('batches agree with single queries, and with themselves in another order', () => {
  const bodies = makeScene(24).map((o) => ({ shape: Shape.fromPoints(o.points), pose: o.pose })), couples = [];
  for (let i = 0; i < 24; i++) for (let k = 0; k < i; k++) couples.push([k, i]);
  for (const kind of ['collide', 'distance', 'depth']) {
    const all = ovoid.batch(kind, bodies, couples), back = ovoid.batch(kind, bodies, [...couples].reverse());
    for (const name of ['status', 'stage', 'lower', 'upper']) assert.deepEqual([...back[name]].reverse(), [...all[name]]);
    couples.forEach(([a, b], i) => {
      const one = ovoid[kind](bodies[a].shape, bodies[b].shape, bodies[a].pose, bodies[b].pose);
      assert.equal(ovoid.names.status[all.status[i]], one.status);
      assert.ok(one.lower <= all.upper[i] && all.lower[i] <= one.upper);
      if (kind !== 'collide' && one.status === 'separated') assert.ok(all.upper[i] - all.lower[i] <= 1e-7);
    });
  }
  assert.throws(() => ovoid.batch('distance', bodies, [[0, 24]]), { name: 'OvoidError', place: 0 });
  assert.throws(() => ovoid.batch('near', bodies, [[0, 1]]), /no such query/);
});

test('known shapes', () => {
  const box = Shape.box([1, 2, 3]), d = box.description;
  assert.equal(d.volume, 48);
  assert.equal(d.vertexCount, 8);
  assert.deepEqual(d.box, { min: [-1, -2, -3], max: [1, 2, 3] });
  assert.ok(Math.abs(d.outer.volume / (4 * Math.PI * Math.sqrt(3) * 6) - 1) < 1e-5);
  assert.ok(Math.abs(d.inner.volume / (8 * Math.PI) - 1) < 1e-5);
  assert.equal(box.triangles.length, 36);
  assert.equal(box.vertices.length, 24);
  assert.deepEqual(Shape.fromBytes(box.toBytes()).toBytes(), box.toBytes());
  for (const [shape, rank] of [[Shape.sphere(1), 0], [Shape.capsule(1, 2), 1], [Shape.cylinder(1, 2), 3], [Shape.cone(1, 2), 3], [Shape.prism(1, 2, 5), 3], [Shape.pyramid(1, 2, 5), 3], [Shape.ellipsoid([1, 2, 3]), 3]])
    assert.equal(shape.description.rank, rank);
  assert.equal(Shape.fromPoints(new Float64Array([0, 0, 0, 1, 0, 0, 0, 1, 0])).description.rank, 2);
});

test('a lean shape says so, in its bytes too, and has true answers', () => {
  const points = Float64Array.from({ length: 300 }, (_, i) => Math.sin(i * i)), ball = Shape.sphere(0.5), pose = { xyz: [0, 4, 0] };
  const lean = Shape.fromPoints(points, { inner: 'lean' }), full = Shape.fromPoints(points);
  assert.ok(lean.description.isLean && !full.description.isLean && Shape.fromBytes(lean.toBytes()).description.isLean);
  assert.ok(lean.inner.volume < full.inner.volume && lean.inner.volume > 0.5 * full.inner.volume);
  const [a, b] = [lean, full].map((shape) => ovoid.distance(shape, ball, null, pose));
  assert.ok(a.lower <= b.upper && b.lower <= a.upper && a.upper - a.lower < 1e-8);
  assert.throws(() => Shape.sphere(1, { inner: 'lane' }), /maximum, phases or lean/);
});

test('round bodies are the true ones', () => {
  const ball = Shape.sphere(0.5), at = { xyz: [0, 4, 0] };
  for (const [shape, gap] of [[Shape.cylinder(2, 1), 1.5], [Shape.ellipsoid([1, 2, 3]), 1.5], [Shape.ellipsoid([1, 2, 3], { tolerance: 0.01 }), 1.5]]) {
    const { lower, upper } = ovoid.distance(shape, ball, null, at);
    assert.ok(lower <= gap && gap <= upper && upper - lower < 1e-8, `${lower} ${upper}`);
  }
  const { lower, upper } = ovoid.depth(Shape.ellipsoid([1, 2, 3]), Shape.ellipsoid([1, 2, 3]), null, { xyz: [1.9, 0, 0] });
  assert.ok(lower <= -0.1 && -0.1 <= upper && upper - lower < 1e-7, `${lower} ${upper}`);
  assert.throws(() => Shape.ellipsoid([1, -2, 3]), /ovoid|half axis|range/i);
  assert.throws(() => Shape.ellipsoid([1, 2]), TypeError);
});

test('known distances; a warm start', () => {
  const box = Shape.box([1, 1, 1]), ball = Shape.sphere(0.5), at = { xyz: [3, 0.2, 0.1] };
  const far = ovoid.distance(box, ball, null, at);
  assert.equal(far.status, 'separated');
  assert.ok(far.lower <= 1.5 && far.upper >= 1.5 && far.upper - far.lower < 1e-8);
  assert.equal(ovoid.distance(box, ball, null, { xyz: [3.001, 0.2, 0.1] }, { earlier: far }).status, 'separated');
  assert.equal(ovoid.within(box, ball, null, at, 1.6).upper <= 1.6, true);
  assert.equal(ovoid.within(box, ball, null, at, 1.4).lower > 1.4, true);
  assert.equal(ovoid.collide(box, ball, null, { xyz: [1.2, 0, 0] }).status, 'overlapping');
  const turned = [{ rpy: [0, 0, Math.PI / 4] }, { quat_wxyz: [Math.cos(Math.PI / 8), 0, 0, Math.sin(Math.PI / 8)] }, { quat_xyzw: [0, 0, Math.sin(Math.PI / 8), Math.cos(Math.PI / 8)] }];
  for (const turn of turned) {
    const d = ovoid.distance(box, ball, { xyz: [0, 0, 0], ...turn }, { xyz: [3, 0, 0] });
    assert.ok(Math.abs(d.lower - (2.5 - Math.SQRT2)) < 1e-9);
  }
  const s = ovoid.smooth(box, ball, null, at, 2);
  assert.ok(s.outer.value <= 1.5 && s.inner.value >= 1.5 && s.outer.hessian.length === 12);
  assert.ok(Math.abs(s.outer.gradient[6] + s.outer.gradient[0]) < 1e-12);
});

test('motions', () => {
  const box = Shape.box([1, 1, 1]), ball = Shape.sphere(0.5), flight = { shape: ball, start: { xyz: [5, 0, 0] }, end: { xyz: [-5, 0, 0] } };
  const hit = ovoid.impact({ shape: box, start: {} }, flight, { duration: 2 });
  assert.equal(hit.status, 'hit');
  assert.ok(hit.free_until <= 0.7 && hit.hit_at >= 0.7 && hit.hit_at - hit.free_until < 1e-8);
  const past = { shape: ball, start: { xyz: [5, 2, 0] }, end: { xyz: [-5, 2, 0] } };
  assert.equal(ovoid.impact({ shape: box, start: {} }, past).status, 'free');
  const near = ovoid.approach({ shape: box, start: {} }, past);
  assert.ok(near.lower <= 0.5 && near.upper >= 0.5 && near.upper - near.lower < 1e-4);
});

test('compounds and solids: known answers, and what is refused', () => {
  const solid = Solid.fromTriangles(corners, faces), ball = Shape.sphere(0.1), pose = { xyz: [1.5, 1.5, 0.5] };
  assert.equal(solid.report.isClosed, true);
  assert.ok(Math.abs(solid.report.volume - 3) < 1e-12);
  const d = ovoid.distance(solid, ball, null, pose);
  assert.ok(d.lower <= 0.4 && d.upper >= 0.4 && d.upper - d.lower < 1e-8);
  assert.equal(ovoid.collide(solid, Shape.fromPoints([[0.5, 0.5, 0.5]]), null, {}).status, 'overlapping');
  assert.equal(ovoid.within(ball, solid, pose, null, 0.3).lower > 0.3, true);
  assert.throws(() => Solid.fromTriangles([[0, 0, 0]], [[0, 0, 9]]), { name: 'OvoidError' });
  assert.throws(() => ovoid.depth(solid, ball, null, pose), /ask for the distance/);
  assert.throws(() => ovoid.distance(solid, {}, null, pose), /a Shape, a Compound or a Solid/);

  const box = Shape.box([0.5, 0.5, 0.5]), rack = new Compound([{ shape: box }, { shape: box, pose: { xyz: [0, 0, 3] } }]);
  const far = ovoid.depth(rack, ball, { xyz: [1, 0, 0] }, { xyz: [1, 0, 2] });
  assert.deepEqual([far.status, far.part_a, far.part_b], ['separated', 1, undefined]);
  assert.ok(far.lower <= 0.4 && far.upper >= 0.4);
  assert.equal(ovoid.collide(solid, rack, null, { xyz: [0.5, 0.5, -2.5] }).part_b, 1);
  assert.throws(() => new Compound([]), { name: 'OvoidError', message: /part/ });
  assert.throws(() => new Compound([{ shape: solid }]), /the parts of a compound/);
  assert.throws(() => new Compound([{ shape: box, pose: { quat_wxyz: [0, 0, 0, 0] } }]), { name: 'OvoidError', place: 0 });
  box.free();
  assert.throws(() => ovoid.distance(rack, ball, null, pose), /the shape was freed/);
  rack.free();
  rack.free();
  assert.throws(() => ovoid.distance(rack, ball, null, pose), /the compound was freed/);
});

test('robots', () => {
  const rod = Shape.capsule(0.1, 0.5), along = { xyz: [0.5, 0, 0], rpy: [0, Math.PI / 2, 0] };
  const robot = new Robot({
    links: ['base', 'upper', 'lower'],
    joints: [
      { name: 'shoulder', type: 'revolute', parent: 'base', child: 'upper', axis: [0, 0, 1], lower: -3, upper: 3 },
      { name: 'elbow', type: 'continuous', parent: 'upper', child: 'lower', origin: { xyz: [1, 0, 0] }, axis: [0, 0, 1] },
    ],
    elements: [{ link: 'upper', shape: rod, pose: along }, { link: 'lower', shape: rod, pose: along }],
    disabled: [['upper', 'lower']],
  });
  assert.equal(robot.variableCount, 2);
  const [, , lower] = robot.poses([Math.PI / 2, 0]);
  assert.ok(Math.abs(lower.xyz[1] - 1) < 1e-12);
  const id = robot.add(Shape.box([0.5, 0.5, 0.5]), { xyz: [0, 2.2, 0] });
  assert.equal(robot.collide([0, 0]).status, 'free');
  const hit = robot.collide([Math.PI / 2, 0]);
  assert.deepEqual([hit.status, hit.a.link, hit.b.obstacle], ['hit', 'lower', id]);
  const near = robot.near([Math.PI / 2, Math.PI], 5);
  assert.equal(near.length, 2);
  assert.ok(near[0].lower <= near[1].lower && near[0].upper >= 0.6 && near[0].lower <= 0.6);
  assert.deepEqual([near[0].a.part, near[0].b.part], [0, 0]);
  assert.equal(robot.collide([4, 0], 0, 0.5).status, 'refused');
  assert.deepEqual(robot.collide([4, 0], 0, 0), { status: 'refused', code: 'out of range', variable: 0 });
  assert.deepEqual(robot.collide([4, 0]), robot.collide([4, 0], 0, 0));
  assert.equal(robot.collide([4, 0], 0, Infinity).status, 'free');
  assert.throws(() => robot.near([4, 0], 5), { name: 'OvoidError', code: 5, message: /variable/ });
  assert.equal(robot.near([4, 0], 5, 1000, Infinity).length, 2);
  // What is held is asked about, what may be touched is not, and what is padded is larger.
  const aside = [Math.PI / 2, 1.5], held = robot.attach('lower', Shape.sphere(0.2), { xyz: [1.4, 0, 0] });
  assert.equal(robot.collide([Math.PI / 2, 0]).status, 'hit');
  robot.move(id, { xyz: [0, 3.05, 0] });
  assert.deepEqual([robot.collide([Math.PI / 2, 0]).a.obstacle, robot.collide(aside).status], [held, 'free']);
  robot.remove(held);
  assert.equal(robot.collide([Math.PI / 2, 0]).status, 'free');
  robot.setPadding('lower', 0.8);
  assert.equal(robot.collide([Math.PI / 2, 0]).status, 'hit');
  robot.allowBody(id, 'lower');
  assert.equal(robot.collide([Math.PI / 2, 0]).status, 'free');
  robot.setPadding('lower', 0);
  robot.allow('base', 'lower');
  robot.allow('base', 'lower', false);
  assert.throws(() => robot.allow('base', 'nowhere'), /no such link/);
  // A wall with a corner cut out, as an obstacle and as a link: nothing touches in the dent.
  const wall = Solid.fromTriangles(corners, faces), corner = robot.add(wall, { xyz: [0.9, -2.2, -0.5] });
  assert.deepEqual([robot.collide([0, -1.5707]).status, robot.collide([0, 0]).status], ['hit', 'free']);
  robot.remove(corner);
  const dented = new Robot({
    links: ['base', 'slide'], joints: [{ name: 'x', type: 'prismatic', parent: 'base', child: 'slide', axis: [1, 0, 0], lower: -9, upper: 9 }],
    elements: [{ link: 'slide', shape: wall }],
  });
  const ball = Shape.sphere(0.3);
  dented.add(ball, { xyz: [1.5, 1.5, 0.5] });
  assert.deepEqual([0, 1, -1].map((x) => dented.collide([x]).status), ['free', 'hit', 'free']);
  assert.equal(ovoid.collide(Shape.hullOf(wall), ball, null, { xyz: [1.5, 1.2, 0.5] }).status, 'overlapping');
  dented.free();
  robot.move(id, { xyz: [0, 9, 0] });
  assert.equal(robot.collide([Math.PI / 2, 0]).status, 'free');
  robot.remove(id);
  assert.throws(() => robot.remove(id), { name: 'OvoidError' });
  assert.throws(() => robot.poses([1]), /2 numbers/);
  assert.throws(() => new Robot({ links: ['a', 'a'], joints: [] }), { name: 'OvoidError' });
  robot.free();
  assert.throws(() => robot.collide([0, 0]), /freed/);
});

test('what is wrong is refused, and nothing is lost', () => {
  assert.throws(() => Shape.fromPoints([[0, 0, 0], [1, NaN, 0]]), { name: 'OvoidError', place: 1, message: /not a number/ });
  assert.throws(() => Shape.fromPoints([]), { name: 'OvoidError' });
  assert.throws(() => Shape.fromPoints([1, 2]), /three each/);
  assert.throws(() => Shape.sphere(-1), { name: 'OvoidError' });
  assert.throws(() => Shape.sphere('1'), TypeError);
  assert.throws(() => Shape.box([1, 1]), TypeError);
  assert.throws(() => new Shape(), TypeError);
  assert.throws(() => Shape.fromBytes(new Uint8Array(100)), { name: 'OvoidError' });
  const box = Shape.box([1, 1, 1]);
  assert.throws(() => ovoid.distance(box, box, { position: [0, 0, 0] }), /no such field: position/);
  assert.throws(() => ovoid.distance(box, box, { rpy: [0, 0, 0], quat_wxyz: [1, 0, 0, 0] }), /one of/);
  assert.equal(ovoid.distance(box, box, { xyz: [NaN, 0, 0] }).limit, 'pose_a');
  assert.equal(ovoid.distance(box, box, {}, { quat_wxyz: [0, 0, 0, 0] }).limit, 'pose_b');
  const good = ovoid.distance(box, box, {}, { xyz: [3, 0, 0] });
  for (const bad of [{ kind: 'cover' }, { kind: 'nonsense' }, { a: [99, 99, 99] }, { normal: [NaN, 0, 0] }, { weight_a: [-1, -1, -1] }, { a: new Array(9).fill(0) }])
    assert.ok(ovoid.verify(box, box, {}, { xyz: [3, 0, 0] }, { ...good.toJSON(), proof: { ...good.proof, ...bad } }), JSON.stringify(bad));
  box.free();
  box.free();
  assert.throws(() => box.vertices, /freed/);
});

test('names that are none are refused with the nearest one', () => {
  const box = Shape.box([1, 1, 1]), refused = (call, message) => assert.throws(call, { name: 'TypeError', message });
  refused(() => ovoid.distance(box, box, null, null, { absolute_tolerence: 1 }), 'options: no such field: absolute_tolerence; did you mean absoluteTolerance?');
  refused(() => ovoid.verify(box, box, null, null, ovoid.distance(box, box), { Cap: 1 }), 'options: no such field: Cap; did you mean cap?');
  refused(() => ovoid.collide(box, box, { position: [0, 0, 0] }), 'poseA: no such field: position; there are xyz, quat_wxyz, quat_xyzw, rpy');
  refused(() => ovoid.collide(box, box, null, { quat_wxzy: [1, 0, 0, 0] }), /did you mean quat_wxyz/);
  refused(() => ovoid.batch('distanse', [{ shape: box }], [[0, 0]]), 'no such query: distanse; did you mean distance?');
  refused(() => ovoid.batch('distance', [{ shape: box }], [[0, 0]], { earlier: {} }), /no such field: earlier/);
  refused(() => ovoid.impact({ shape: box, start: {} }, { shape: box, begin: {} }), /a moving body: no such field: begin/);
  refused(() => ovoid.approach({ shape: box }, { shape: box }, { tolerence: 1 }), /did you mean tolerance/);
  refused(() => Shape.sphere(1, { tolerance: 1 }), /no such field: tolerance/);
  refused(() => Shape.sphere(1, { allowance: { outsid: 1 } }), /did you mean outside/);
  refused(() => Shape.sphere(1, 0.1), /an object is needed/);
  refused(() => Shape.box({ sizes: [1, 1, 1] }), /did you mean size/);
  refused(() => Shape.box(1, 1, 1), 'a box: half sizes [x, y, z], or one of { half } and { size } are needed');
  refused(() => ovoid.distance(box, box, null, null, { tolerance: 1 }), 'options: no such field: tolerance; did you mean absoluteTolerance or relativeTolerance?');
  refused(() => Shape.box({ half: [1, 1, 1], size: [2, 2, 2] }), /one of/);
  refused(() => Shape.box({}), /one of/);
  refused(() => new Robot({ links: ['a'], joint: [] }), /did you mean joints/);
  refused(() => new Robot({ links: ['arm', 'leg'], joints: [{ name: 'j', type: 'revolut', parent: 'arm', child: 'leg' }] }), /did you mean revolute/);
  refused(() => new Robot({ links: ['arm', 'leg'], joints: [{ name: 'j', type: 'fixed', parent: 'arn', child: 'leg' }] }), /did you mean arm/);
  refused(() => ovoid.distance(box, null, box, null), /the arguments are a, b, poseA, poseB/);
  assert.equal(Shape.box({ size: [2, 4, 6] }).volume, Shape.box({ half: [1, 2, 3] }).volume);
  assert.equal(Shape.box({ half: [1, 2, 3] }).volume, Shape.box([1, 2, 3]).volume);
});

test('what is no shape is not read as one, and what is no number not as another', () => {
  const box = Shape.box([1, 1, 1]), refused = (call, message) => assert.throws(call, { name: 'TypeError', message });
  const tetrahedron = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
  const joint = { name: 'j', type: 'fixed', parent: 'arm', child: 'leg' }, links = ['arm', 'leg'];
  for (const other of [Solid.fromTriangles(tetrahedron, faces), new Compound([{ shape: box }]), { address: 64 }, null]) {
    refused(() => ovoid.smooth(box, other), 'smooth: a Shape is needed');
    refused(() => ovoid.smooth(other, box), 'smooth: a Shape is needed');
    refused(() => ovoid.impact({ shape: box }, { shape: other }), 'a moving body: a Shape is needed');
    refused(() => ovoid.approach({ shape: other }, { shape: box }), 'a moving body: a Shape is needed');
    refused(() => ovoid.batch('collide', [{ shape: box }, { shape: other }], [[0, 1]]), 'a body: a Shape is needed');
    if (!(other instanceof Solid)) refused(() => new Robot({ links, joints: [joint], elements: [{ link: 'arm', shape: other }] }), /an element of arm: a Shape is needed/);
    if (other && !(other instanceof Solid)) refused(() => new Robot({ links, joints: [joint], elements: [{ link: 'arm', shape: box, solid: other }] }), /a Solid is needed/);
  }
  refused(() => ovoid.batch('collide', [{ shape: box, pos: {} }], [[0, 0]]), /a body: no such field: pos; did you mean pose/);
  refused(() => new Compound([{ shape: box, pos: { xyz: [1, 0, 0] } }]), /a part of a compound: no such field: pos; did you mean pose/);
  refused(() => ovoid.smooth(box, box, null, null, { order: 1 }), 'smooth: order: 0, 1 or 2 is needed');
  refused(() => ovoid.within(box, box, null, null, { margin: 1 }), /within: a margin is needed/);
  refused(() => ovoid.distance(box, box, null, null, { cap: '1' }), 'options: cap: a number is needed');
  for (const iterations of [-1, 1.5, 2 ** 32]) refused(() => ovoid.distance(box, box, null, null, { iterations }), /iterations: 0 to 2\^32 - 1/);
  refused(() => ovoid.batch('within', [{ shape: box }], [[0, 0]], { margin: '1' }), 'options: margin: a number is needed');
  refused(() => ovoid.batch('within', [{ shape: box }], [[0, 0.5]]), 'couples: indices are whole numbers');
  refused(() => ovoid.impact({ shape: box }, { shape: box }, { duration: '2' }), 'options: duration: a number is needed');
  refused(() => Solid.fromTriangles(tetrahedron, [[0, 1, 2.5]]), 'triangles: indices are whole numbers');
  refused(() => Shape.prism(1, 1, 3.5), 'prism: sides: a whole number is needed');
  refused(() => Shape.sphere(1, { radius: '1' }), 'options: radius: a number is needed');
  refused(() => ovoid.distance(box, box).isWithin('1'), 'isWithin: a number is needed');
  refused(() => ovoid.verify(box, box, null, null, {}), 'verify: an answer with its proof is needed');
});

test('an answer is asked by name, and is no number', () => {
  const box = Shape.box([1, 1, 1]), answer = ovoid.distance(box, box, null, { xyz: [3, 0, 0] }), { Status } = ovoid;
  assert.deepEqual(Object.values(Status), ovoid.names.status);
  assert.ok(Object.isFrozen(Status) && answer.status === Status.separated && answer.is('separated') && !answer.is('overlapping'));
  assert.throws(() => answer.is('seperated'), { name: 'TypeError', message: 'no such status: seperated; did you mean separated?' });
  assert.throws(() => answer < 0.1, /answer.lower/);
  assert.throws(() => answer == 'separated', /answer.is/);
  assert.match(String(answer), /^separated, 0?\.?[\d.]+ to [\d.]+$/);
  assert.deepEqual([0.5, 1.5].map((margin) => answer.isWithin(margin)), [false, true]);
  assert.equal(answer.isWithin((answer.lower + answer.upper) / 2), null);
});

test('memory goes back', () => {
  const points = Array.from({ length: 300 }, () => [random(), random(), random()]);
  for (let i = 0; i < 20; i++) Shape.fromPoints(points).free();
  const before = ovoid.memoryBytes;
  for (let i = 0; i < 2000; i++) Shape.fromPoints(points).free();
  assert.equal(ovoid.memoryBytes, before);
});

test('contacts have the numbers of the tool, points, ids and areas included; they hold, altered ones do not', () => {
  const objects = makeScene(16).map((o, i) => (i % 4 ? o : { name: o.name, pose: o.pose, compound: [{ points: o.points }, { box: [1, 1, 1], pose: { xyz: [0.5, 0, 0] } }] }));
  const bodies = new Map(objects.map(({ name, points, compound, pose }) => [name, {
    body: points ? Shape.fromPoints(points) : new Compound([{ shape: Shape.fromPoints(compound[0].points) }, { shape: Shape.box([0.5, 0.5, 0.5]), pose: { xyz: [0.5, 0, 0] } }]), pose,
  }]));
  const options = { margin: 0.25, angle: 1.45 };
  let count = 0, searched = 0;
  for (const { a, b, contacts = [] } of checkByTool({ objects }, {}, ['--contacts', '--margin', '0.25'])) {
    const [p, q] = [bodies.get(a), bodies.get(b)], pair = [p.body, q.body, p.pose, q.pose], found = ovoid.findManifolds(...pair, options);
    assert.deepEqual(found.map((m) => m.toJSON()), contacts, `${a} ${b}`);
    for (const m of contacts) {
      count++;
      searched += m.proof === 'search';
      assert.equal(ovoid.verifyManifold(...pair, m, options), null);
      const polygon = ovoid.computePolygon(...pair, m, options);
      assert.deepEqual([polygon.points.length, polygon.inner, polygon.outer], [m.corners, m.inner, m.outer]);
      assert.ok(polygon.grown >= m.grown);
      for (const by of [1e-6, -1e-6]) assert.ok(ovoid.verifyManifold(...pair, moved(m, by), options), `moved by ${by}`);
      assert.match(ovoid.verifyManifold(...pair, { ...m, points: [m.points[0], m.points[0]] }, options).message, /point/);
      assert.ok(ovoid.verifyManifold(...pair, { ...m, part_a: 9 }, options));
      if (m.cover) assert.match(ovoid.verifyManifold(...pair, { ...m, cover: undefined }, options).message, /cover/);
    }
    if (p.body instanceof Shape && q.body instanceof Shape && found.length) assert.deepEqual(ovoid.findManifold(...pair, options).toJSON(), contacts[0]);
  }
  assert.ok(count > 20 && searched > 0, `${count} contacts, ${searched} by search`);
});

test('a contact goes on from the earlier one, also from that of a file', () => {
  const box = Shape.box([1, 1, 1]), at = (z) => ({ xyz: [0.5, 0.25, z] }), first = ovoid.findManifold(box, box, null, at(1.9));
  assert.deepEqual([first.axis, first.proof, first.points.length, first.corners], ['face a', 'facets', 4, 4]);
  assert.ok(Math.abs(first.outer - 1.5 * 1.75) < 1e-10 && first.inner <= 1.5 * 1.75);
  for (const { separation, point_a, point_b } of first.points) assert.ok(Math.abs(separation + 0.1) < 1e-13 && Math.abs(point_a[2] - 1) < 1e-13 && Math.abs(point_b[2] - 0.9) < 1e-13);
  for (const earlier of [first, JSON.parse(JSON.stringify(first))]) {
    const next = ovoid.findManifold(box, box, null, at(1.9 + 1e-12), { earlier });
    assert.deepEqual(next.points.map((p) => p.id), first.points.map((p) => p.id));
    assert.equal(ovoid.verifyManifold(box, box, null, at(1.9 + 1e-12), next), null);
  }
  const apart = ovoid.findManifold(box, box, null, at(3));
  assert.deepEqual([apart.axis, apart.points, apart.limit, apart.upper], ['none', [], 'cap', Infinity]);
  assert.equal(ovoid.verifyManifold(box, box, null, at(3), apart), null);
});

test('a box on a square of two triangles has one contact of four points', () => {
  const sheet = Solid.fromTriangles([[-3, -3, 0], [3, -3, 0], [3, 3, 0], [-3, 3, 0]], [[0, 1, 2], [0, 2, 3]]);
  const box = Shape.box([0.5, 0.6, 0.3]), pair = [box, sheet, { xyz: [0.1, 0.2, 0.299] }, null], found = ovoid.findManifolds(...pair), [m] = found;
  assert.deepEqual([found.length, m.axis, m.proof, m.points.length, m.normal[2]], [1, 'face b', 'normal', 4, -1]);
  assert.equal(ovoid.verifyManifold(...pair, m), null);
  assert.ok(ovoid.verifyManifold(...pair, { ...m, lower: m.lower + 1e-6 }));
  assert.throws(() => ovoid.computePolygon(...pair, m), /no polygon/);
});

test('what a contact cannot be asked of is refused', () => {
  const box = Shape.box([1, 1, 1]), solid = Solid.fromTriangles([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]);
  assert.throws(() => ovoid.findManifold(box, new Compound([{ shape: box }])), /findManifolds/);
  assert.throws(() => ovoid.findManifolds(solid, solid), /shape_b: two solids have no contacts/);
  assert.throws(() => ovoid.findManifold(box, box, null, null, { margins: 1 }), /did you mean margin/);
  assert.throws(() => ovoid.findManifold(box, box, null, null, { margin: -1 }), /margin, tolerance and keep/);
  assert.throws(() => ovoid.findManifold(box, box, null, null, { angle: 2 }), /1.45/);
  assert.throws(() => ovoid.computePolygon(box, box, null, null, { ...ovoid.findManifold(box, box), part_a: 3 }), /no such parts/);
});

// Every kind of proof has its name: that of a cylinder and a ball is the last. Beside a wedge its points are of the rim,
// whose numbers have their highest bit set.
test('the proof of a true cylinder holds, read back from JSON too', () => {
  const can = Shape.cylinder(5, 20), wedge = Shape.fromPoints([[0, 0, 0], [40, 0, 0], [0, 20, 0], [40, 20, 0], [0, 0, 30], [0, 20, 30]].flat());
  const { distance, verify } = ovoid;
  for (const [other, kind] of [[wedge, 'points'], [Shape.sphere(3), 'balls']]) {
    const pose = { xyz: [35, 10, 90] }, answer = distance(other, can, null, pose), { status, stage, limit, iterations, lower, upper, point_a, point_b, normal, proof } = answer;
    assert.equal(proof.kind, kind);
    if (kind === 'points') assert.ok(Math.max(...proof.b) >= 2 ** 31);
    assert.ok(upper - lower < 1e-6);
    const read = JSON.parse(JSON.stringify({ status, stage, limit, iterations, lower, upper, point_a, point_b, normal, proof }));
    for (const claim of [answer, read]) assert.equal(verify(other, can, null, pose, claim), null);
    if (kind === 'balls') read.proof.inner_b[0] += 1;
    else read.proof.b[0] = 2 ** 31;
    assert.notEqual(verify(other, can, null, pose, { ...read, upper: read.upper - 0.5 }), null);
  }
});
