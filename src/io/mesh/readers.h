// The readers of mesh formats; mesh.c chooses one for a file.
#ifndef OVOID_IO_MESH_READERS_H
#define OVOID_IO_MESH_READERS_H

#include "io/mesh/mesh_build.h"

/// The readers. Each fills reader->mesh or the error.
ovoid_code mesh_read_stl(mesh_reader *reader);
ovoid_code mesh_read_obj(mesh_reader *reader);
ovoid_code mesh_read_off(mesh_reader *reader);
ovoid_code mesh_read_ply(mesh_reader *reader);
ovoid_code mesh_read_assimp(mesh_reader *reader);

/// 1 if the bytes are those of an STL file, text or binary.
int mesh_is_stl(bytes file);

#endif
