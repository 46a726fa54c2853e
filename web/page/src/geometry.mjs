// Shapes as geometry of three.js.
import { BufferAttribute, BufferGeometry, IcosahedronGeometry, Matrix4, Quaternion, Vector3 } from 'three';

/** Faces whose normals differ by less look round; in radians. */
const CREASE = 0.7;

// Unit normals of triangles; zero of those without area.
function findNormals(points, triangles) {
  const normals = new Float32Array(triangles.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const ux = points[b] - points[a], uy = points[b + 1] - points[a + 1], uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a], vy = points[c + 1] - points[a + 1], vz = points[c + 2] - points[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx, length = Math.sqrt(x * x + y * y + z * z) || 1;
    normals[t] = x / length;
    normals[t + 1] = y / length;
    normals[t + 2] = z / length;
  }
  return normals;
}

// The corners (places among the triangles) at each point: those of point i from starts[i] to starts[i + 1].
function listCorners(count, triangles) {
  const starts = new Uint32Array(count + 1), corners = new Uint32Array(triangles.length);
  for (const i of triangles) starts[i + 1]++;
  for (let i = 0; i < count; i++) starts[i + 1] += starts[i];
  const next = starts.slice(0, count);
  triangles.forEach((i, corner) => (corners[next[i]++] = corner));
  return { starts, corners };
}

/** Triangles with normals: at each corner the mean of those around its point that are within the crease. */
export function makeGeometry(points, triangles, crease = CREASE) {
  const count = points.length / 3, faces = findNormals(points, triangles), { starts, corners } = listCorners(count, triangles);
  const least = Math.cos(crease), size = triangles.length, index = new Uint32Array(size), position = new Float32Array(3 * size), normal = new Float32Array(3 * size);
  let made = 0;
  for (let i = 0; i < count; i++) {
    const first = made;
    for (let k = starts[i]; k < starts[i + 1]; k++) {
      const corner = corners[k], f = corner - (corner % 3), fx = faces[f], fy = faces[f + 1], fz = faces[f + 2];
      let x = 0, y = 0, z = 0;
      for (let m = starts[i]; m < starts[i + 1]; m++) {
        const g = corners[m] - (corners[m] % 3);
        if (m !== k && fx * faces[g] + fy * faces[g + 1] + fz * faces[g + 2] <= least) continue;
        x += faces[g];
        y += faces[g + 1];
        z += faces[g + 2];
      }
      const length = Math.sqrt(x * x + y * y + z * z) || 1;
      let found = first;
      while (found < made && (normal[3 * found] * x + normal[3 * found + 1] * y + normal[3 * found + 2] * z) / length < 0.9999) found++;
      if (found === made) {
        for (let j = 0; j < 3; j++) position[3 * made + j] = points[3 * i + j];
        normal[3 * made] = x / length;
        normal[3 * made + 1] = y / length;
        normal[3 * made + 2] = z / length;
        made++;
      }
      index[corner] = found;
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(position.slice(0, 3 * made), 3));
  geometry.setAttribute('normal', new BufferAttribute(normal.slice(0, 3 * made), 3));
  geometry.setIndex(new BufferAttribute(index, 1));
  return geometry;
}

// Triangles that may be seen from both sides.
function makeOpen(points, triangles) {
  const geometry = makeGeometry(points, triangles);
  geometry.userData.isOpen = true;
  return geometry;
}

/**
 * A coarser geometry: the points in each cube of a grid become their mean (J. Rossignac, P. Borrel, Multi-resolution 3D
 * approximations for rendering complex scenes, 1993).
 */
export function simplify(geometry, cells) {
  const points = geometry.getAttribute('position').array, from = geometry.getIndex().array, low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i++) {
    low[i % 3] = Math.min(low[i % 3], points[i]);
    high[i % 3] = Math.max(high[i % 3], points[i]);
  }
  const size = (Math.max(...low.map((x, k) => high[k] - x)) * 1.0001) / cells || 1, numbers = new Map(), sums = [], of = new Uint32Array(points.length / 3);
  for (let i = 0; i < of.length; i++) {
    const [x, y, z] = [0, 1, 2].map((k) => Math.floor((points[3 * i + k] - low[k]) / size)), key = x + cells * (y + cells * z);
    if (!numbers.has(key)) numbers.set(key, sums.push([0, 0, 0, 0]) - 1);
    const sum = sums[(of[i] = numbers.get(key))];
    for (let k = 0; k < 3; k++) sum[k] += points[3 * i + k];
    sum[3]++;
  }
  const triangles = [], seen = new Set(), count = sums.length;
  for (let t = 0; t < from.length; t += 3) {
    const [a, b, c] = [of[from[t]], of[from[t + 1]], of[from[t + 2]]], key = Math.min(a, b, c) + count * (Math.max(a, b, c) + count * (a + b + c));
    if (a === b || b === c || c === a || seen.has(key)) continue;
    seen.add(key);
    triangles.push(a, b, c);
  }
  return makeOpen(Float32Array.from(sums.flatMap(([x, y, z, n]) => [x / n, y / n, z / n])), Uint32Array.from(triangles));
}

// The hull of balls around the vertices, by the library itself.
function makeRoundedHull(ovoid, { vertices, radius }, instances) {
  const count = vertices.length / 3, detail = Math.min(instances > 300 ? 1 : 5, count <= 16 ? 5 : count <= 100 ? 2 : 1);
  const ball = new IcosahedronGeometry(1, detail).getAttribute('position');
  const points = new Float64Array(count * ball.count * 3);
  for (let i = 0, at = 0; i < count; i++)
    for (let k = 0; k < ball.count; k++)
      for (const x of [vertices[3 * i] + radius * ball.getX(k), vertices[3 * i + 1] + radius * ball.getY(k), vertices[3 * i + 2] + radius * ball.getZ(k)]) points[at++] = x;
  const hull = ovoid.Shape.fromPoints(points, { gap: 0.5 }), { origin } = hull.description, xyz = hull.vertices, { triangles } = hull;
  for (let i = 0; i < xyz.length; i++) xyz[i] += origin[i % 3];
  hull.free();
  return makeGeometry(xyz, triangles);
}

/** The polyhedron with its rounding radius, coarser where there are many of it; of flat ones both sides. */
export function makeHull(ovoid, shape, instances = 1) {
  if (shape.radius > 0) return makeRoundedHull(ovoid, shape, instances);
  if (shape.rank === 3) return makeGeometry(shape.vertices, shape.triangles, 0.02);
  if (shape.triangles.length) return makeOpen(shape.vertices, shape.triangles);
  return makeOpen(new Float32Array([0, 0, 0, 1e-3, 0, 0, 0, 1e-3, 0]), Uint32Array.of(0, 1, 2));
}

export const makeMesh = ({ points, triangles }) => makeOpen(points, triangles);

/** The eight facial areas of a hull as colours of its triangles. */
export function makeAreas(shape, colors) {
  const count = shape.triangles.length, geometry = new BufferGeometry(), points = new Float32Array(3 * count), values = new Float32Array(3 * count);
  for (let corner = 0; corner < count; corner++) {
    for (let k = 0; k < 3; k++) points[3 * corner + k] = shape.vertices[3 * shape.triangles[corner] + k];
    values.set(colors[shape.areas[Math.floor(corner / 3)] % colors.length], 3 * corner);
  }
  geometry.setAttribute('position', new BufferAttribute(points, 3));
  geometry.setAttribute('color', new BufferAttribute(values, 3));
  geometry.setIndex(new BufferAttribute(Uint32Array.from({ length: count }, (_, i) => i), 1));
  geometry.computeVertexNormals();
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
