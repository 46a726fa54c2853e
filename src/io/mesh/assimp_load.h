// Assimp's functions. The library is loaded where a file first needs it: its symbols and those of the libraries below
// it take 2.6 ms to be found, three quarters of the time in which `ovoid` starts.
#ifndef OVOID_IO_MESH_ASSIMP_LOAD_H
#define OVOID_IO_MESH_ASSIMP_LOAD_H

#include <assimp/cimport.h>

typedef struct assimp_functions {
    struct aiPropertyStore *(*create_store)(void);
    void (*set_integer)(struct aiPropertyStore *store, const char *name, int value);
    void (*release_store)(struct aiPropertyStore *store);
    const struct aiScene *(*import)(const char *path, unsigned flags, struct aiFileIO *io,
                                    const struct aiPropertyStore *store);
    void (*release_import)(const struct aiScene *scene);
    const char *(*get_error)(void);
    void (*set_identity)(struct aiMatrix4x4 *matrix);
    void (*multiply)(struct aiMatrix4x4 *matrix, const struct aiMatrix4x4 *by);
} assimp_functions;

/// Loads Assimp once, in any thread, for the rest of the process. NULL: it cannot be loaded, *why says why.
const assimp_functions *assimp_load(const char **why);

#endif
