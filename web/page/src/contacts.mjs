// The contacts of pairs in the picture: polygons, points, normals, over the bodies that would hide them.
import { BufferGeometry, DoubleSide, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, Points, PointsMaterial, Vector3 } from 'three';

const COLOR = '#d6007a', NORMAL = '#1f5fd0';
/** Half of how wide a point is, in pixels; how long a normal is, in radii of the smaller body. */
const DOT = 7, LENGTH = 0.45;

const over = { depthTest: false, transparent: true };
const makeGeometry = (numbers) => new BufferGeometry().setAttribute('position', new Float32BufferAttribute(numbers, 3));
const middle = (points) => [0, 1, 2].map((k) => points.reduce((sum, p) => sum + p[k], 0) / points.length);

/** Both ends of the lines of a polygon, of its last corner with its first too where it has an area. */
const listSides = (corners) => (corners.length < 2 ? [] : corners.slice(0, corners.length === 2 ? 1 : undefined).flatMap((p, i) => [p, corners[(i + 1) % corners.length]]));

/** A normal: its shaft, and two strokes at its tip. */
function makeArrow(from, n, length) {
  const at = new Vector3(...from), along = new Vector3(...n), across = new Vector3(Math.abs(n[0]) < 0.6 ? 1 : 0, Math.abs(n[0]) < 0.6 ? 0 : 1, 0).cross(along).normalize();
  const tip = at.clone().addScaledVector(along, length), stroke = (side) => tip.clone().addScaledVector(along, -0.22 * length).addScaledVector(across, 0.1 * side * length);
  return [at, tip, tip, stroke(1), tip, stroke(-1)].map((v) => v.toArray());
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
    const sides = list.flatMap(({ corners }) => listSides(corners)), arrows = list.flatMap(({ points, normal, radius }) => makeArrow(middle(points), normal, LENGTH * radius));
    const dots = list.flatMap(({ points }) => points), add = (Kind, points, material) => points.length && this.group.add(new Kind(makeGeometry(points.flat()), material));
    add(Mesh, fans, new MeshBasicMaterial({ ...over, color: COLOR, opacity: 0.3, side: DoubleSide }));
    add(LineSegments, sides, new LineBasicMaterial({ ...over, color: COLOR }));
    add(LineSegments, arrows, new LineBasicMaterial({ ...over, color: NORMAL }));
    add(Points, dots, new PointsMaterial({ ...over, color: COLOR, size: DOT, sizeAttenuation: false }));
    this.group.children.forEach((child, i) => Object.assign(child, { renderOrder: 5 + i, frustumCulled: false }));
    // For a picture that is painted.
    const pairs = (ends, color) => Array.from({ length: ends.length / 2 }, (_, i) => ({ color, points: [ends[2 * i], ends[2 * i + 1]].map((p) => new Vector3(...p)) }));
    this.lines = [...pairs(sides, COLOR), ...pairs(arrows, NORMAL)];
  }
}
