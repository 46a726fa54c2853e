// What draws where there is no WebGL 2: triangles from the farthest to the nearest, as polygons of a canvas (M. Newell,
// R. Newell, T. Sancha, A solution to the hidden surface problem, 1972, without its cuts). As a renderer of three.js has it.
import { Color, Matrix4, Vector3 } from 'three';

export class Painter {
  constructor(canvas) {
    this.domElement = canvas;
    this.context = canvas.getContext('2d');
    this.limits = { fewest: 5000, most: 60000, rate: 100, levels: { triangles: 4000, items: 200 } };
    this.ratio = 1;
  }

  getPixelRatio() {
    return this.ratio;
  }
  setPixelRatio(ratio) {
    this.ratio = ratio;
    if (this.width) this.setSize(this.width, this.height);
  }
  setSize(width, height) {
    Object.assign(this, { width, height });
    this.domElement.width = Math.round(width * this.ratio);
    this.domElement.height = Math.round(height * this.ratio);
  }

  /** What is drawn is there at once. */
  wait(done) {
    done();
  }

  render(scene, camera, layers, { lines, outlined, color: outlineColor }) {
    // The handles, which are not painted, are found by where they are in the scene.
    scene.updateMatrixWorld();
    camera.updateMatrixWorld();
    const { context, domElement: { width, height } } = this, faces = [];
    for (const layer of layers) {
      const { opacity } = layer.material;
      for (const item of layer.listDrawn()) this.#collect(faces, camera, { ...item, opacity });
    }
    faces.sort((a, b) => b.far - a.far);
    context.clearRect(0, 0, width, height);
    context.lineJoin = 'round';
    for (const { xy, style, opacity } of faces) {
      context.globalAlpha = opacity;
      context.fillStyle = context.strokeStyle = style;
      context.beginPath();
      context.moveTo(xy[0], xy[1]);
      context.lineTo(xy[2], xy[3]);
      context.lineTo(xy[4], xy[5]);
      context.closePath();
      context.fill();
      // Without it the background shows between neighbours.
      if (opacity === 1) context.stroke();
    }
    context.globalAlpha = 1;
    if (outlined.length) this.#drawOutline(outlined, camera, outlineColor);
    for (const { points, ...how } of lines) this.#drawLine(points.map((p) => this.#project(p.clone().applyMatrix4(camera.matrixWorldInverse), camera)), how);
  }

  // Around triangles a line, where they are not themselves: they are drawn wider on a canvas of its own, and taken out of it.
  #drawOutline(items, camera, color) {
    const { ratio, domElement: { width, height } } = this, layer = (this.layer ??= document.createElement('canvas')), faces = [];
    Object.assign(layer, { width, height });
    const context = layer.getContext('2d'), path = new Path2D();
    for (const { levels, world } of items) this.#collect(faces, camera, { world, geometry: levels[0].geometry, color: new Color(), opacity: 1 });
    for (const { xy: [a, b, c, d, e, f] } of faces) {
      path.moveTo(a, b);
      path.lineTo(c, d);
      path.lineTo(e, f);
      path.closePath();
    }
    Object.assign(context, { strokeStyle: color, fillStyle: color, lineJoin: 'round', lineWidth: 5 * ratio });
    context.stroke(path);
    context.globalCompositeOperation = 'destination-out';
    context.fill(path);
    this.context.drawImage(layer, 0, 0);
  }

  // To pixels, and the depth; null behind the camera.
  #project(point, camera) {
    const { width, height } = this.domElement, far = -point.z;
    if (far < camera.near) return null;
    point.applyMatrix4(camera.projectionMatrix);
    return [((point.x + 1) / 2) * width, ((1 - point.y) / 2) * height, far];
  }

  // Triangles that face the camera, or are of a body that is seen through, with their light.
  #collect(faces, camera, { world, geometry, color, opacity }) {
    const points = geometry.getAttribute('position').array, index = geometry.getIndex().array, colors = geometry.getAttribute('color')?.array;
    const at = new Matrix4().multiplyMatrices(camera.matrixWorldInverse, world), seen = [], v = new Vector3();
    for (let i = 0; i < points.length; i += 3) {
      v.set(points[i], points[i + 1], points[i + 2]).applyMatrix4(at);
      const [x, y, z] = [v.x, v.y, v.z], p = this.#project(v, camera);
      seen.push(p && [x, y, z, p[0], p[1]]);
    }
    for (let t = 0; t < index.length; t += 3) {
      const [a, b, c] = [seen[index[t]], seen[index[t + 1]], seen[index[t + 2]]];
      if (!a || !b || !c) continue;
      const turn = (b[3] - a[3]) * (c[4] - a[4]) - (b[4] - a[4]) * (c[3] - a[3]);
      if (turn >= 0 && opacity === 1 && !geometry.userData.isOpen) continue;
      const ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2], vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
      const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx, light = 0.45 + (0.6 * Math.abs(nz)) / (Math.sqrt(nx * nx + ny * ny + nz * nz) || 1);
      const [r, g, blue] = colors ? [0, 1, 2].map((k) => colors[3 * index[t] + k]) : [color.r, color.g, color.b], tone = (x) => Math.round(255 * Math.min(1, light * x) ** (1 / 2.2));
      faces.push({ far: -(a[2] + b[2] + c[2]), xy: [a[3], a[4], b[3], b[4], c[3], c[4]], style: `rgb(${tone(r)},${tone(g)},${tone(blue)})`, opacity });
    }
  }

  // A line with dots at its ends, or a ring without.
  #drawLine(points, { color, isRing, isBare }) {
    if (!points.every(Boolean)) return;
    const { context, ratio } = this;
    context.strokeStyle = context.fillStyle = color;
    context.lineWidth = 2 * ratio;
    context.beginPath();
    for (const [x, y] of points) context.lineTo(x, y);
    if (isRing) context.closePath();
    context.stroke();
    for (const [x, y] of isRing || isBare ? [] : points) {
      context.beginPath();
      context.arc(x, y, 4 * ratio, 0, 2 * Math.PI);
      context.fill();
    }
    context.lineWidth = ratio;
  }
}
