// What the fuzz targets share: the entry that libFuzzer and replay.c call, and a file for readers that want a path.
// Truth: a reader refuses or accepts, never crashes; what it accepts keeps its promises, else the target aborts.
#ifndef OVOID_FUZZ_H
#define OVOID_FUZZ_H

#include <ovoid/io.h>
#include <ovoid/ovoid.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/// A promise; the place is in the abort's stack.
static inline void fuzz_require(int condition) {
    if (!condition) abort();
}

/// An error that was promised: a code that is not OK and a sentence that ends.
static inline void fuzz_require_error(const ovoid_error *error) {
    fuzz_require(error->code != OVOID_OK);
    fuzz_require(error->message[0] != 0 && memchr(error->message, 0, sizeof error->message) != NULL);
}

/// The bytes as a file of this name in a folder of this process, which is made once. The path is valid until the next
/// call.
const char *fuzz_write_file(const char *name, const uint8_t *data, size_t size);

/// Reads the bytes as a mesh file of this name and walks over all that was read.
int fuzz_mesh(const char *name, const uint8_t *data, size_t size);

/// Looks at all of a part: finite points, indices in range.
void fuzz_walk_part(ovoid_mesh_part part);

#endif
