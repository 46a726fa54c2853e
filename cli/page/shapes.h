// The shapes of a page, each once, with the meshes that they are the hulls of.
#ifndef OVOID_CLI_PAGE_SHAPES_H
#define OVOID_CLI_PAGE_SHAPES_H

#include "page/page.h"

#include <ovoid/ovoid.h>

/// A part of a mesh, read for the page.
typedef struct page_mesh {
    float *points;       ///< xyz, in the frame of the shape's user
    uint32_t *triangles; ///< three points each
    size_t point_count, triangle_count;
} page_mesh;

/// Shapes by their address, numbered as they come.
typedef struct page_shapes {
    const ovoid_shape **items;
    page_mesh *meshes;      ///< of each shape; empty where there is none
    unsigned char *is_seen; ///< of each shape: whether it has a mesh that differs from it was asked
    size_t count, capacity;
    size_t *slots; ///< numbers + 1, by address; 0: free
    size_t slot_count;
    size_t mesh_bytes; ///< of all meshes
} page_shapes;

/// The number of a shape, which is added where it is new. 0 where memory is out.
int page_shapes_add(page_shapes *shapes, const ovoid_shape *shape, size_t *number);

/// Adds the meshes of a body that was read from a file, NULL for none: of each of its parts that is not known to fill
/// its hull. Above 30 MB of meshes they are left out and counted. 0, or EXIT_INPUT after a message.
int page_shapes_add_mesh(page_shapes *shapes, cli_page *page, const ovoid_body *body, const char *path,
                         const ovoid_read_options *read);

/// Writes "shapes":[...], after a comma. 0, or EXIT_INPUT after a message.
int page_shapes_write(const page_shapes *shapes, FILE *file);

void page_shapes_clear(page_shapes *shapes);

#endif
