// Tetrahedra as branch and bound cuts them: halved at the middle of the longest edge (M. C. Rivara, Algorithms for
// refining triangular grids suitable for adaptive and multigrid techniques, 1984), and six that fill a box.
#ifndef OVOID_LINEAR_TETRAHEDRON_H
#define OVOID_LINEAR_TETRAHEDRON_H

#include "linear/box.h"

static const int tetrahedron_edges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

/// The longest edge, the first of equal ones, and its square.
static inline const int *tetrahedron_find_longest_edge(const vec3 corner[4], double *squared) {
    const int *edge = tetrahedron_edges[0];
    *squared = -1;
    for (int i = 0; i < 6; i++) {
        const int *other = tetrahedron_edges[i];
        double d = vec3_norm_squared(vec3_sub(corner[other[1]], corner[other[0]]));
        if (d > *squared) *squared = d, edge = other;
    }
    return edge;
}

/// The corners of both halves; the square of the edge that is cut.
static inline double tetrahedron_halve(const vec3 corner[4], vec3 halves[2][4]) {
    double squared;
    const int *edge = tetrahedron_find_longest_edge(corner, &squared);
    vec3 middle = vec3_scale(vec3_add(corner[edge[0]], corner[edge[1]]), 0.5);
    for (int i = 0; i < 4; i++) {
        halves[0][i] = i == edge[1] ? middle : corner[i];
        halves[1][i] = i == edge[0] ? middle : corner[i];
    }
    return squared;
}

/// The six paths from one corner of a box to the opposite one along its edges (H. W. Kuhn, Some combinatorial lemmas in
/// topology, 1960).
static inline void tetrahedra_fill_box(const box *b, vec3 corners[6][4]) {
    static const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (int i = 0; i < 6; i++) {
        double at[3] = {b->min.x, b->min.y, b->min.z};
        const double end[3] = {b->max.x, b->max.y, b->max.z};
        for (int k = 0; k < 4; k++) {
            corners[i][k] = (vec3){at[0], at[1], at[2]};
            if (k < 3) at[orders[i][k]] = end[orders[i][k]];
        }
    }
}

#endif
