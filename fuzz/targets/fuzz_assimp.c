// Meshes that go to Assimp: the first byte says which format, the others are the file. Whatever its importers do in
// their child process, the caller gets a mesh that keeps its promises, or an error. (Assimp itself is not instrumented:
// what is found here is what seeds and chance lead to.)
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char *const names[] = {"mesh.dae", "mesh.gltf", "mesh.glb", "mesh.3ds",
                                        "mesh.x3d", "mesh.fbx",  "mesh.3mf"};
    if (size < 2) return 0;
    return fuzz_mesh(names[(unsigned)(data[0] - '0') % 7], data + 1, size - 1);
}
