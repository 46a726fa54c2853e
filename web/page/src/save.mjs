// The picture as PNG, the bodies as GLB.
import { Color, InstancedMesh, Matrix4, Mesh, MeshStandardMaterial, Scene } from 'three';
import { GLTFExporter } from 'three/examples/jsm/exporters/GLTFExporter.js';

function save(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

export function savePicture(view, name) {
  view.drawNow();
  view.canvas.toBlob((blob) => save(blob, `${name}.png`), 'image/png');
}

/** Bodies as they are shown, instances made single. */
export function makeExport(view) {
  const scene = new Scene(), at = new Matrix4(), color = new Color();
  for (const name of ['meshes', 'hulls', 'areas', 'outer', 'inner'])
    if (view.shown[name])
      for (const set of view.layers[name].children)
        if (set instanceof InstancedMesh)
          set.userData.bodies.forEach((body, i) => {
            set.getMatrixAt(i, at);
            if (at.determinant() === 0) return;
            if (set.instanceColor) set.getColorAt(i, color);
            else color.copy(set.material.color);
            const { opacity, transparent, vertexColors } = set.material;
            const mesh = new Mesh(set.geometry, new MeshStandardMaterial({ color: color.clone(), opacity, transparent, vertexColors }));
            mesh.name = body.name;
            mesh.applyMatrix4(at);
            scene.add(mesh);
          });
  return scene;
}

export async function saveModel(view, name) {
  const bytes = await new GLTFExporter().parseAsync(makeExport(view), { binary: true });
  save(new Blob([bytes], { type: 'model/gltf-binary' }), `${name}.glb`);
}
