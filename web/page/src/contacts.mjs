// The contacts of pairs in the picture: polygons, points, normals, over the bodies that would hide them.
import {
  BufferGeometry, ConeGeometry, CylinderGeometry, DoubleSide, Float32BufferAttribute, Group, InstancedMesh, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshBasicMaterial,
  Points, PointsMaterial, Quaternion, Vector3,
} from 'three';

const COLOR = '#d6007a', NORMAL = '#12305f';
/** How wide a point is, in pixels; how long a normal is, in radii of the smaller body, its tip and half of its width of that. */
const DOT = 7, LENGTH = 0.45, TIP = 0.25, WIDTH = 0.025, UP = new Vector3(0, 1, 0);

const over = { depthTest: false, transparent: true };
const makeGeometry = (numbers) => new BufferGeometry().setAttribute('position', new Float32BufferAttribute(numbers, 3));
const middle = (points) => [0, 1, 2].map((k) => points.reduce((sum, p) => sum + p[k], 0) / points.length);

/** Both ends of the lines of a polygon, of its last corner with its first too where it has an area. */
const listSides = (corners) => (corners.length < 2 ? [] : corners.slice(0, corners.length === 2 ? 1 : undefined).flatMap((p, i) => [p, corners[(i + 1) % corners.length]]));

/** Shafts and tips of normals from the middles of contacts. */
function makeArrows(list) {
  const shaft = new CylinderGeometry(WIDTH, WIDTH, 1 - TIP, 10).translate(0, (1 - TIP) / 2, 0), tip = new ConeGeometry(3 * WIDTH, TIP, 14).translate(0, 1 - TIP / 2, 0);
  const material = () => new MeshBasicMaterial({ ...over, color: NORMAL }), at = new Matrix4();
  return [shaft, tip].map((geometry) => {
    const mesh = new InstancedMesh(geometry, material(), list.length);
    list.forEach(({ points, normal, radius }, i) => {
      const turn = new Quaternion().setFromUnitVectors(UP, new Vector3(...normal).normalize()), size = LENGTH * radius;
      mesh.setMatrixAt(i, at.compose(new Vector3(...middle(points)), turn, new Vector3(size, size, size)));
    });
    return mesh;
  });
}

export class Contacts {
  constructor() {
    this.group = new Group();
    this.lines = [];
  }

  /** Draws these contacts: { corners, points, normal, radius }, corners and points in the world. */
  set(list) {
    for (const { geometry, material } of this.group.children) {
      geometry.dispose();
      material.dispose();
    }
    this.group.clear();
    const fans = list.flatMap(({ corners }) => corners.slice(2).flatMap((p, i) => [corners[0], corners[i + 1], p]));
    const sides = list.flatMap(({ corners }) => listSides(corners)), ends = list.flatMap(({ points, normal, radius }) => [middle(points), middle(points).map((x, k) => x + LENGTH * radius * normal[k])]);
    // Many polygons lie over one another: each is fainter then, and its points are smaller.
    const few = Math.min(1, Math.sqrt(8 / Math.max(1, list.length)));
    const dots = list.flatMap(({ points }) => points), add = (Kind, points, material) => points.length && this.group.add(new Kind(makeGeometry(points.flat()), material));
    add(Mesh, fans, new MeshBasicMaterial({ ...over, color: COLOR, opacity: 0.32 * few, side: DoubleSide }));
    add(LineSegments, sides, new LineBasicMaterial({ ...over, color: COLOR, opacity: 0.4 + 0.6 * few }));
    if (list.length) this.group.add(...makeArrows(list));
    add(Points, dots, new PointsMaterial({ ...over, color: COLOR, size: Math.max(3, DOT * few), sizeAttenuation: false }));
    this.group.children.forEach((child, i) => Object.assign(child, { renderOrder: 5 + i, frustumCulled: false }));
    // For a picture that is painted.
    const pairs = (all, color) => Array.from({ length: all.length / 2 }, (_, i) => ({ color, isBare: true, points: [all[2 * i], all[2 * i + 1]].map((p) => new Vector3(...p)) }));
    this.lines = [...pairs(sides, COLOR), ...pairs(ends, NORMAL)];
  }
}
