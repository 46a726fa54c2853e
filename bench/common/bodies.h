// Sets of bodies: random hulls, boxes, the paper's models, real hulls.
#ifndef OVOID_BENCH_COMMON_BODIES_H
#define OVOID_BENCH_COMMON_BODIES_H

#include "peers/peer.h"

#include <ovoid/ovoid.h>

typedef struct bodies {
    body *items;
    uint32_t count;
} bodies;

/// Points on a sphere, stretched by 1 to 4 along two axes. count 0 if memory runs out.
bodies bodies_create_hulls(uint32_t vertices, uint32_t count);
/// Half sizes 1 to 4.
bodies bodies_create_boxes(uint32_t count);
/// W.-K. Su, J.-S. Liu, I-F. Chen, Enhancing Collision Detection Method Based on Enclosed Ellipsoid by Facial Areas
/// Splitting: body 0 is the box, 1 to 10 are cylinders, 11 to 20 complex cylinders, 21 to 30 spheres.
bodies bodies_create_paper(void);
/// The first `count` solids of a file of point clouds (a 32-bit count n, then n times three 32-bit floats, repeated).
/// count 0: the file does not exist.
bodies bodies_create_from_clouds(const char *path, uint32_t count);
/// Adds the shape to a list that has room for it, and takes it over; 0 if it is NULL or memory runs out.
int bodies_add_shape(bodies *all, ovoid_shape *shape);
void bodies_destroy(bodies *all);

/// size: the sum of the radii of the enclosing spheres.
double body_get_reach(const body *b);

#endif
