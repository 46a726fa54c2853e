// Pairs of hulls at a known gap, for bench.mjs and native.c: points on the unit sphere, poses that are tried until the
// distance is the one wanted.
import { writeFileSync } from 'node:fs';

const HULLS = 50;

// xorshift32: the same numbers everywhere.
let state = 2463534242;
function random() {
  state ^= state << 13;
  state ^= state >>> 17;
  state ^= state << 5;
  return (state >>> 0) / 4294967296;
}
function normal() {
  return Math.sqrt(-2 * Math.log(random() + 1e-12)) * Math.cos(2 * Math.PI * random());
}
function unit(count) {
  const v = Array.from({ length: count }, normal), length = Math.hypot(...v);
  return v.map((x) => x / length);
}

/** Hulls of `vertices` points, and `count` pairs { a, b, pose }, a at the origin, whose signed distance is near the gap. */
export function makePairs(ovoid, vertices, gap, count) {
  const points = Array.from({ length: HULLS }, () => Array.from({ length: vertices }, () => unit(3))), shapes = points.map((p) => ovoid.Shape.fromPoints(p));
  const pairs = Array.from({ length: count }, (_, i) => {
    const a = i % HULLS, b = Math.floor(random() * HULLS), u = unit(3), quat_wxyz = unit(4);
    let far = 2 + gap;
    for (let k = 0; k < 30; k++) {
      const d = ovoid.depth(shapes[a], shapes[b], null, { xyz: u.map((x) => x * far), quat_wxyz });
      far = Math.max(0.05, far - (d.lower - gap));
    }
    return { a, b, pose: { xyz: u.map((x) => x * far), quat_wxyz } };
  });
  return { points, shapes, pairs };
}

/** The same for native.c: vertices, hulls, pairs, then points, then of each pair a, b and the pose; doubles. */
export function writePairs(path, { points, pairs }) {
  const numbers = [points[0].length, points.length, pairs.length, ...points.flat(2), ...pairs.flatMap(({ a, b, pose }) => [a, b, ...pose.xyz, ...pose.quat_wxyz])];
  writeFileSync(path, Float64Array.from(numbers));
}
