// Balls and regions inside bodies, which prove most overlaps before anything exact is asked.
//
// Where a ball that lies in one body meets a region that lies in the other, a box or an ellipsoid, or one of its balls,
// the bodies overlap, and as deep as the ball can be made smaller and still meet it. Balls are drawn along a lattice in
// the body, each as large as its planes let it be, the one that covers most of the lattice first; that a ball is inside
// is proven by the depth of its centre. Regions are the box that a body is, or the ellipsoid that it is known to hold.
#ifndef OVOID_ROBOT_MODEL_INNER_BALLS_H
#define OVOID_ROBOT_MODEL_INNER_BALLS_H

#include "ovoid/body.h"
#include "robot/model/outer_balls.h"
#include "shape/block.h"
#include "simd/robot/robot8.h"

/// A point at its frame's origin; NULL: no memory.
static inline ovoid_shape *shape_create_point(const ovoid_allocator *memory) {
    const double origin[3] = {0, 0, 0};
    return ovoid_shape_create_from_points(origin, 1, &(ovoid_shape_options){.allocator = memory}, NULL);
}

/// What is known to lie inside a shape, or inside the solid that it is the hull of, and what holds it, in its user's
/// frame.
typedef struct shape_inside {
    inner_balls balls; ///< radius and allowance counted; none: radii that nothing meets
    inner_region region;
    double most, least; ///< radii of the balls
    double size;        ///< the lengths that centres are made of, summed
    double gap;         ///< ovoid_solid_compute_hull_gap of a solid; 0: the shape is the body
    outer_balls outer;  ///< of an element or an attached body; an obstacle has none
} shape_inside;
/// solid: NULL, or the body; nothing is inside a surface. point: a shape that is a point at its frame's origin. Cost:
/// some hundred passes over the facets, and some tens of distances from the solid's surface. All but `outer` is set.
/// MEMORY, or OK.
ovoid_code shape_inside_find(const ovoid_shape *shape, const ovoid_solid *solid, const ovoid_shape *point,
                             shape_inside *inside);

/// The region inside a shape in its user's frame, without its radius. Cost: none.
inner_region inner_region_find(const ovoid_shape *shape);

/// The region of a body at a frame.
static inline inner_region inner_region_place(const inner_region *own, const mat3 *rotation, vec3 position) {
    inner_region g = *own;
    g.center = vec3_add(position, mat3_mul_vec3(*rotation, own->center));
    g.map = mat3_mul(own->map, mat3_transpose(*rotation));
    return g;
}

/// A body, and its balls in the world.
typedef struct placed_balls {
    const shape_inside *of;
    const inner_balls *world;
} placed_balls;

/// How deep a body's balls, each enlarged by `more`, come into a region; at most zero: none is shown to.
static inline double placed_balls_find_region_depth(const robot8_kernels *kernels, placed_balls a,
                                                    const inner_region *g, double more) {
    double deep = kernels->balls_in_region(a.world, g, more);
    if (!(deep > 0)) return 0;
    double limit = (a.of->most + more) * g->scale + g->offset;
    return 0.499 * min2(deep / (limit * g->scale), a.of->least + more);
}

/// How deep the balls of two bodies come into one another. around: a region that holds those of b; balls that do not
/// come into it meet none of them.
static inline double placed_balls_find_depth(const robot8_kernels *kernels, placed_balls a, const inner_region *around,
                                             placed_balls b) {
    double deep = kernels->balls_in_balls(a.world, around, b.world);
    return deep > 0 ? 0.499 * deep / (a.of->most + b.of->most) : 0;
}

#endif
