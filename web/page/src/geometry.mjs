// Shapes as geometry of three.js.
import { BufferAttribute, BufferGeometry, IcosahedronGeometry, Matrix4, Quaternion, Vector3 } from 'three';
import { toCreasedNormals } from 'three/examples/jsm/utils/BufferGeometryUtils.js';

/** Above this many triangles a mesh is drawn with the normals of its triangles. */
const SMOOTH_TRIANGLES = 60000;

function flat(points, triangles) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(points instanceof Float32Array ? points : Float32Array.from(points), 3));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  const split = geometry.toNonIndexed();
  split.computeVertexNormals();
  return split;
}

// The hull of balls around the vertices, by the library itself.
function roundedHull(ovoid, { vertices, radius }, instances) {
  const count = vertices.length / 3, detail = Math.min(instances > 300 ? 1 : 5, count <= 16 ? 5 : count <= 100 ? 2 : 1);
  const ball = new IcosahedronGeometry(1, detail).getAttribute('position');
  const points = new Float64Array(count * ball.count * 3);
  for (let i = 0, at = 0; i < count; i++)
    for (let k = 0; k < ball.count; k++)
      for (const x of [vertices[3 * i] + radius * ball.getX(k), vertices[3 * i + 1] + radius * ball.getY(k), vertices[3 * i + 2] + radius * ball.getZ(k)]) points[at++] = x;
  const hull = ovoid.Shape.fromPoints(points, { gap: 0.5 }), { origin } = hull.description, xyz = hull.vertices, { triangles } = hull;
  for (let i = 0; i < xyz.length; i++) xyz[i] += origin[i % 3];
  hull.free();
  return toCreasedNormals(flat(xyz, triangles), 0.6);
}

/** The polyhedron with its rounding radius, coarser where there are many of it; of flat ones both sides. */
export function makeHull(ovoid, shape, instances = 1) {
  if (shape.radius > 0) return roundedHull(ovoid, shape, instances);
  if (shape.rank === 3) return flat(shape.vertices, shape.triangles);
  return shape.triangles.length ? flat(shape.vertices, shape.triangles) : new IcosahedronGeometry(1e-3, 0);
}

export function makeMesh({ points, triangles }) {
  const geometry = flat(points, triangles);
  return triangles.length <= 3 * SMOOTH_TRIANGLES ? toCreasedNormals(geometry, 0.7) : geometry;
}

/** The eight facial areas of a hull as colours of its triangles. */
export function makeAreas(shape, colors) {
  const geometry = flat(shape.vertices, shape.triangles), values = new Float32Array(shape.triangles.length * 3);
  for (let t = 0; t < shape.triangles.length / 3; t++) for (let k = 0; k < 3; k++) values.set(colors[shape.areas[t] % colors.length], 9 * t + 3 * k);
  geometry.setAttribute('color', new BufferAttribute(values, 3));
  return geometry;
}

// Eigenvectors of a symmetric matrix by Jacobi's rotations: columns of v.
function findAxes([xx, xy, xz, yy, yz, zz]) {
  const m = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], v = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  for (let sweep = 0; sweep < 30; sweep++)
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
      if (Math.abs(m[p][q]) < 1e-300) continue;
      const angle = Math.atan2(2 * m[p][q], m[q][q] - m[p][p]) / 2, c = Math.cos(angle), s = Math.sin(angle);
      for (let k = 0; k < 3; k++) [m[k][p], m[k][q]] = [c * m[k][p] - s * m[k][q], s * m[k][p] + c * m[k][q]];
      for (let k = 0; k < 3; k++) [m[p][k], m[q][k]] = [c * m[p][k] - s * m[q][k], s * m[p][k] + c * m[q][k]];
      for (let k = 0; k < 3; k++) [v[k][p], v[k][q]] = [c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q]];
    }
  return { lengths: [0, 1, 2].map((k) => Math.sqrt(Math.max(0, m[k][k]))), v };
}

/** The matrix that makes the unit ball the ellipsoid, enlarged by a radius. */
export function makeEllipsoidMatrix({ center, q }, radius = 0) {
  const { lengths, v } = findAxes(q), axes = [0, 1, 2].map((k) => new Vector3(v[0][k], v[1][k], v[2][k]));
  if (new Vector3().crossVectors(axes[0], axes[1]).dot(axes[2]) < 0) axes[2].negate();
  const least = Math.max(...lengths) * 1e-6;
  axes.forEach((axis, k) => axis.multiplyScalar(Math.max(lengths[k], least) + radius));
  return new Matrix4().makeBasis(...axes).setPosition(...center);
}

export function makePoseMatrix({ xyz, quat_wxyz: [w, x, y, z] }) {
  return new Matrix4().compose(new Vector3(...xyz), new Quaternion(x, y, z, w).normalize(), new Vector3(1, 1, 1));
}
