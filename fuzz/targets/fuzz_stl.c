// Meshes: STL.
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) { return fuzz_mesh("mesh.stl", data, size); }
