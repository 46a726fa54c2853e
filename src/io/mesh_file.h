// Which file a mesh, or the shapes of one, were read from. Defined by io/mesh.
#ifndef OVOID_IO_MESH_FILE_H
#define OVOID_IO_MESH_FILE_H

#include <ovoid/io.h>

/// checksum_bytes of the file.
uint64_t mesh_get_checksum(const ovoid_mesh *mesh);
/// Of the file that ovoid_shapes_read_file made them from; 0 where that was no mesh.
uint64_t shapes_get_checksum(const ovoid_shapes *shapes);

#endif
