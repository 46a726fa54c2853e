// A link beside spheres: what audits and covers share. All is computed in the link's frame in units of a power of two
// near the link's size, so that no square, cube or product leaves the doubles; only results are in the caller's unit.
#ifndef OVOID_ROBOT_SPHERES_SPHERES_H
#define OVOID_ROBOT_SPHERES_SPHERES_H

#include "base/allocator.h"
#include "base/watch.h"
#include "linear/box.h"
#include "ovoid/robot_spheres.h"

/// A convex part of the link: an element of the description.
typedef struct spheres_part {
    uint32_t element;
    ovoid_pair probe;   ///< its shape and a point, in the caller's unit: the point's pose is set for each query
    const vec3 *points; ///< its vertices
    uint32_t point_count;
    const uint32_t *triangles; ///< of a solid without rounding, else NULL: the fan over them from `middle` is the part
    uint32_t triangle_count;
    vec3 middle;   ///< of the part: a mean of vertices
    double beyond; ///< the true body is within this of the hull of the vertices: radius and outside
    double inside; ///< the shape is within this of the true body
    box box;       ///< around the true body
} spheres_part;

/// The link.
typedef struct spheres_link {
    spheres_part *parts;
    uint32_t part_count;
    vec3 *points;       ///< of all parts
    ovoid_shape *point; ///< at its frame's origin
    box box;            ///< around all parts
    double unit;        ///< caller's lengths = ours times this
    double pad;         ///< bounds how far rounding moves a vertex, and a corner of a cell
    ovoid_allocator memory;
} spheres_link;

/// The tree of spheres: node i has the children 2 i + 1 and 2 i + 2; a leaf holds those of its range.
typedef struct spheres_node {
    box centers;
    double most; ///< radius
    uint32_t first, count;
} spheres_node;

/// Spheres, sorted so that every node's are one range.
typedef struct spheres_tree {
    ovoid_robot_sphere *items;
    uint32_t *given; ///< the place of each in the caller's list
    spheres_node *nodes;
    uint32_t count, leaves; ///< leaves: a power of two
    ovoid_allocator memory;
} spheres_tree;

/// Fills *link from the elements of a link; it is empty, and needs no release, where a code says what is wrong.
ovoid_code spheres_link_open(spheres_link *link, const ovoid_robot *robot, uint32_t index,
                             const ovoid_allocator *memory, ovoid_error *error);
void spheres_link_close(spheres_link *link);

/// How far a point (our unit) is from the true body of a part: the core's answer about the caller's lengths.
ovoid_answer spheres_part_probe(const spheres_link *link, const spheres_part *part, vec3 x);

/// Refuses spheres that are none: EMPTY, LIMIT, NOT_FINITE, RADIUS, RANGE.
ovoid_code spheres_validate(const ovoid_robot_sphere *spheres, size_t count, ovoid_error *error);
/// Builds the tree of spheres given in the caller's unit; MEMORY.
ovoid_code spheres_tree_open(spheres_tree *tree, const ovoid_robot_sphere *spheres, size_t count,
                             const spheres_link *link, ovoid_error *error);
void spheres_tree_close(spheres_tree *tree);

/// Rounding of |x - c| - r: differences, norm and the last difference are within 6 u of the sizes; doubled.
static inline double spheres_round(double distance, double radius) { return 12 * ROUNDING * (distance + radius); }

/// The least over the spheres of the greatest over the corners (1 or 4) of |corner - c| - r, rounded up; *nearest is
/// a sphere in the tree to begin with, and the one that was found.
double spheres_tree_find_least(const spheres_tree *tree, const vec3 *corners, int count, uint32_t *nearest);
/// The least over the spheres of |x - c| - r, rounded down.
double spheres_tree_find_value(const spheres_tree *tree, vec3 x, uint32_t *nearest);
/// What one sphere of the tree adds to these: of a cell's four corners, and of a point.
double spheres_tree_measure_greatest(const spheres_tree *tree, uint32_t sphere, const vec3 corners[4]);
double spheres_tree_measure_value(const spheres_tree *tree, uint32_t sphere, vec3 x);

/// The share of a cell of four corners where a function that is linear in it, and has these values there, is <= 0.
double spheres_compute_share(const double value[4]);

/// What lies in a cell, in shares of its volume or as sums of volumes: each a lower and an upper bound.
typedef struct spheres_volumes {
    ovoid_robot_bracket uncovered, excess, link, spheres;
} spheres_volumes;

/// A tetrahedron, of the search for the deepest point or of the volumes.
typedef struct spheres_cell {
    vec3 corner[4];
    double key; ///< the depth's upper bound, or the width of the volumes' brackets: the greatest is halved next
    double volume;
    spheres_volumes holds;
    uint32_t part, level;
    uint32_t sphere; ///< of the tree: the one that held the cell best, or the cell around it
} spheres_cell;

/// A ball around a cell.
typedef struct sphere_of_cell {
    vec3 middle;
    double radius, edge_squared; ///< the longest edge's square
} sphere_of_cell;

sphere_of_cell spheres_cell_find_around(const spheres_cell *cell);
/// Bounds of the share of a cell that the spheres' union holds.
ovoid_robot_bracket spheres_tree_find_share(const spheres_tree *tree, const spheres_cell *cell,
                                            const sphere_of_cell *around);

/// Cells, the greatest key first.
typedef struct spheres_heap {
    spheres_cell *cells;
    size_t count, capacity;
    const ovoid_watch *watch; ///< asked before each cell; NULL: nobody
} spheres_heap;

/// Room for that many cells and the first ones of the search for the deepest point; MEMORY. The caller releases cells.
ovoid_code spheres_heap_open(spheres_heap *heap, const spheres_link *link, size_t cells, ovoid_error *error);
/// The diagonal of the link's box, our unit.
double spheres_link_get_size(const spheres_link *link);
void spheres_heap_push(spheres_heap *all, const spheres_cell *cell);
spheres_cell spheres_heap_pop(spheres_heap *all);
/// Halves a cell at the middle of its longest edge; returns the square of that edge.
double spheres_cell_halve(const spheres_cell *cell, spheres_cell half[2]);
/// The six tetrahedra of a box that is enlarged so that their corners, and those of their halves, are not rounded.
void spheres_cell_make_box(box b, spheres_cell cells[6]);

/// The bracket of the depth in our unit, with its point.
typedef struct spheres_depth {
    double lower, upper;
    vec3 point;
    uint32_t part, sphere;
    size_t cells;
} spheres_depth;

/// Searches until the bracket is narrower than the tolerance (our unit), or the capacity is used up.
spheres_depth spheres_find_depth(const spheres_link *link, const spheres_tree *tree, double tolerance,
                                 spheres_heap *heap);
/// The volumes in our unit, with as many cells as the heap has room for; *cells is increased by those looked at.
spheres_volumes spheres_find_volumes(const spheres_link *link, const spheres_tree *tree, spheres_heap *heap,
                                     size_t *cells);

#endif
