// The picture as PNG, the bodies as GLB.
import { Mesh, MeshStandardMaterial, Scene } from 'three';
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
  const scene = new Scene();
  for (const { items, material } of view.shownLayers)
    for (const { body, levels, world, color, isShown } of items) {
      if (!isShown) continue;
      const { opacity, transparent, vertexColors } = material;
      const mesh = new Mesh(levels[0].geometry, new MeshStandardMaterial({ color: (color ?? material.color).clone(), opacity, transparent, vertexColors }));
      mesh.name = body.name;
      mesh.applyMatrix4(world);
      scene.add(mesh);
    }
  return scene;
}

export async function saveModel(view, name) {
  const bytes = await new GLTFExporter().parseAsync(makeExport(view), { binary: true });
  save(new Blob([bytes], { type: 'model/gltf-binary' }), `${name}.glb`);
}
