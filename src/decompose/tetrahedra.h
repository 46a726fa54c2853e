// Branch and bound over tetrahedra: the greatest value of a function over a body, from below by points and from above
// by cells. The problem decides how a cell is bounded and by which plane it is cut (uncovered.c, excess.c).
#ifndef OVOID_DECOMPOSE_TETRAHEDRA_H
#define OVOID_DECOMPOSE_TETRAHEDRA_H

#include "linear/box.h"
#include "ovoid/decompose.h"

/// A tetrahedron, perhaps flat.
typedef struct cell {
    vec3 corner[4];
    double bound;   ///< no point of the body in the cell has a greater value
    uint32_t owner; ///< of the problem
    uint32_t hint;  ///< of the problem
    uint32_t depth; ///< the number of cuts that led to it
} cell;

/// The largest number of cuts that lead to a cell: a corner moves by at most 4 u at each cut, in units of the body.
enum { CELL_DEPTH = 200, CELL_PIECES = 6 };

/// Corners nearer to a plane than this are not cut off by it.
#define CELL_TOUCH 0x1p-40

vec3 cell_compute_middle(const cell *c);
/// The radius of the cell about x: none of its points is farther from x.
double cell_compute_radius(const cell *c, vec3 x);
box cell_compute_box(const cell *c);
/// Cuts along the plane. Returns the number of pieces, which take over owner, hint and bound, those below the plane
/// first; 0 if the plane does not cut the cell.
uint32_t cell_cut(const cell *c, const ovoid_plane *plane, cell pieces[CELL_PIECES], uint32_t *first_above);
/// Cuts at the middle of the longest edge: two pieces.
uint32_t cell_halve(const cell *c, cell pieces[CELL_PIECES]);

typedef struct cell_search cell_search;

/// How a cell is cut.
typedef enum cell_plane {
    CELL_HALVES, ///< at the middle of its longest edge
    CELL_BOTH,   ///< by the plane
    CELL_BELOW   ///< by the plane; the body has no point above it
} cell_plane;

/// A search. bound: lowers cell->bound as far as it can, and may raise `lower` (cell_search_raise). plane: where to cut
/// the cell.
struct cell_search {
    void (*find_bound)(cell_search *s, cell *c);
    cell_plane (*find_plane)(cell_search *s, const cell *c, ovoid_plane *plane);
    void *problem;
    double tolerance;
    double ceiling; ///< the upper bound to prove; INFINITY: find the least one
    double lower;   ///< proven by `point`
    vec3 point;
    uint32_t point_owner;
    double dropped; ///< the greatest bound of cells that need not be examined further
    double *owners; ///< the same for each owner, or NULL
    cell *heap;     ///< the greatest bound first
    size_t count, room, looked, work;
    const ovoid_decomposition_options *options;
};

static inline double cell_search_get_goal(const cell_search *s) { return min2(s->lower + s->tolerance, s->ceiling); }
void cell_search_raise(cell_search *s, double lower, vec3 point, uint32_t owner);
/// Adds a cell with a bound that may be infinite.
void cell_search_add(cell_search *s, cell *c);
/// Adds six cells that fill the box.
void cell_search_add_box(cell_search *s, const box *around, uint32_t owner);
/// Searches until the bracket is as narrow as the tolerance, or room or work is used up. Returns the upper end.
double cell_search_run(cell_search *s);

#endif
