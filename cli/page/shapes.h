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
    const ovoid_solid *solid; ///< the body that its triangles are; NULL: its hull is, or it has no room
} page_mesh;

enum { PAGE_SEEN_MESH = 1, PAGE_SEEN_SOLID = 2 };

/// Shapes by their address, numbered as they come.
typedef struct page_shapes {
    const ovoid_shape **items;
    page_mesh *meshes;   ///< of each shape; empty where there is none
    unsigned char *seen; ///< of each shape: PAGE_SEEN_MESH where its mesh was asked for, PAGE_SEEN_SOLID its solid
    size_t count, capacity;
    size_t *slots; ///< numbers + 1, by address; 0: free
    size_t slot_count;
    size_t mesh_bytes; ///< of all meshes and solids
} page_shapes;

/// The number of a shape, which is added where it is new. 0 if memory runs out.
int page_shapes_add(page_shapes *shapes, const ovoid_shape *shape, size_t *number);

/// Adds the meshes of a body that was read from a file, NULL for none: of each of its parts that is not known to fill
/// its hull. Above 30 MB of meshes they are left out and counted. 0, or EXIT_INPUT after a message.
int page_shapes_add_mesh(page_shapes *shapes, cli_page *page, const ovoid_body *body, const char *path,
                         const ovoid_read_options *read);

/// Adds the triangles that a body is, with its hull. Above 30 MB together they are left out and counted as meshes. 0,
/// or EXIT_INPUT after a message.
int page_shapes_add_solid(page_shapes *shapes, cli_page *page, const ovoid_shape *hull, const ovoid_solid *solid);

/// Writes "shapes":[...], after a comma. 0, or EXIT_INPUT after a message.
int page_shapes_write(const page_shapes *shapes, FILE *file);

void page_shapes_clear(page_shapes *shapes);

#endif
