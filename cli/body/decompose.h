// Parts of a solid and their proof, for output.
#ifndef OVOID_CLI_BODY_DECOMPOSE_H
#define OVOID_CLI_BODY_DECOMPOSE_H

#include "base/inputs.h"

#include <ovoid/io.h>
#include <ovoid/ovoid.h>

#include <stdio.h>

typedef struct decomposed {
    const char *path, *unit;
    ovoid_decomposition view;
    ovoid_parts *parts;                     ///< computed here; NULL: they are `given`
    ovoid_shapes *given;                    ///< of a file, or NULL
    const ovoid_shape **list;               ///< those of the file
    ovoid_decomposition_proof proof, found; ///< found: of the parts before they were grown
    double *excess;                         ///< of each part
    int is_grown;                           ///< 1: the parts were grown by `grown`, so that they cover
    double grown;
} decomposed;

void decomposed_write_text(FILE *file, const decomposed *d);
void decomposed_write_json(FILE *file, const decomposed *d);
void decomposed_write_csv(FILE *file, const decomposed *d);
/// The parts as an OBJ file, one object each. 0, or an exit code after a message.
int decomposed_write_parts(const char *path, const decomposed *d);

/// The largest number of cells for the check of a proof, each length.
#define DECOMPOSED_CHECK_WORK ((size_t)1 << 24)

/// Writes the proof as a file that `ovoid verify` reads. The proof is checked first, and an upper end is raised a
/// little until the check holds. 0, or an exit code after a message.
int decomposed_write_proof(const char *path, const decomposed *d);
/// The parts of a file. 0, or EXIT_INPUT after a message.
int decomposed_read_parts(decomposed *d, const char *path, const read_settings *how);
/// Verifies a proof, paths[0], against a mesh and parts. An exit code.
int decomposed_verify(const char *const *paths, const read_settings *settings);

#endif
