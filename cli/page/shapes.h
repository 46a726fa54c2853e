// The shapes of a page, each once, with the meshes whose hulls they are.
#ifndef OVOID_CLI_PAGE_SHAPES_H
#define OVOID_CLI_PAGE_SHAPES_H

#include "base/inputs.h"
#include "page/page.h"

#include <ovoid/ovoid.h>

/// A part of a mesh, read for the page.
typedef struct page_mesh {
    float *points;       ///< xyz, in the frame of the shape's user
    uint32_t *triangles; ///< three points each
    size_t point_count, triangle_count;
    const ovoid_solid
        *solid; ///< the body that its triangles are; NULL: the hull is the body, or there is no room for the solid
} page_mesh;

enum { PAGE_SEEN_MESH = 1, PAGE_SEEN_SOLID = 2 };

/// Shapes by their address, numbered in the order of their first use.
typedef struct page_shapes {
    const ovoid_shape **items;
    page_mesh *meshes;   ///< for each shape; empty if it has none
    unsigned char *seen; ///< for each shape: PAGE_SEEN_MESH once its mesh was considered, PAGE_SEEN_SOLID its solid
    size_t count, capacity;
    size_t *slots; ///< numbers + 1, by address; 0: free
    size_t slot_count;
    size_t mesh_bytes; ///< of all meshes and solids
} page_shapes;

/// The number of a shape, which is added if it is new. 0 if memory runs out.
int page_shapes_add(page_shapes *shapes, const ovoid_shape *shape, size_t *number);

/// Adds the meshes of a body that was read from a file: those of its parts that are not known to be
/// their hulls. Above 30 MB of meshes they are left out and counted. 0, or EXIT_INPUT after a message.
int page_shapes_add_mesh(page_shapes *shapes, cli_page *page, const ovoid_body *body, const mesh_source *source);

/// Adds the triangles of a solid, with its hull. Above 30 MB together they are left out and counted as meshes. 0, or
/// EXIT_INPUT after a message.
int page_shapes_add_solid(page_shapes *shapes, cli_page *page, const ovoid_shape *hull, const ovoid_solid *solid);

/// Writes "shapes":[...], after a comma. 0, or EXIT_INPUT after a message.
int page_shapes_write(const page_shapes *shapes, FILE *file);

void page_shapes_clear(page_shapes *shapes);

#endif
