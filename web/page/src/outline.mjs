// The outline of what is chosen: its triangles moved by some pixels each way, where they are not themselves (stencil).
import { DoubleSide, Group, Mesh, MeshBasicMaterial, NotEqualStencilFunc, ReplaceStencilOp, ShaderMaterial, Vector2 } from 'three';

const PIXELS = 2.5, MOST_TRIANGLES = 60000;
const WAYS = Array.from({ length: 8 }, (_, i) => [Math.cos((i * Math.PI) / 4), Math.sin((i * Math.PI) / 4)]);

const mask = new MeshBasicMaterial({
  colorWrite: false, depthTest: false, depthWrite: false, transparent: true, side: DoubleSide,
  stencilWrite: true, stencilRef: 1, stencilZPass: ReplaceStencilOp,
});

const makeEdge = (color) => new ShaderMaterial({
  uniforms: { offset: { value: new Vector2() }, color: { value: color } }, side: DoubleSide, transparent: true, depthTest: false, depthWrite: false,
  stencilWrite: true, stencilRef: 1, stencilFunc: NotEqualStencilFunc,
  vertexShader: 'uniform vec2 offset; void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); gl_Position.xy += offset * gl_Position.w; }',
  fragmentShader: 'uniform vec3 color; void main() {\n gl_FragColor = vec4(color, 1.0);\n #include <colorspace_fragment>\n }',
});

export class Outline {
  constructor(color) {
    this.group = new Group();
    this.edges = WAYS.map(() => makeEdge(color));
  }

  /** The parts that are outlined: { body, levels, world }. */
  set(items) {
    this.group.clear();
    for (const item of items) {
      const { geometry } = item.levels.find(({ triangles }) => triangles <= MOST_TRIANGLES) ?? item.levels[item.levels.length - 1];
      [mask, ...this.edges].forEach((material, i) => {
        const mesh = new Mesh(geometry, material);
        Object.assign(mesh, { renderOrder: i ? 7 : 6, frustumCulled: false, matrixAutoUpdate: false, matrixWorldAutoUpdate: false, matrixWorld: item.world });
        this.group.add(mesh);
      });
    }
  }

  resize(width, height) {
    this.edges.forEach(({ uniforms: { offset } }, i) => offset.value.set((WAYS[i][0] * 2 * PIXELS) / width, (WAYS[i][1] * 2 * PIXELS) / height));
  }
}
