// A box of half sizes h is a stretched cube, and stretching keeps the order of volumes, so the smallest ellipsoid
// around the box has Q = 3 diag h^2, and the largest inside has Q = diag h^2.
//
// With u = 2^-53, entries are moved by a slack of 128 u, and rounding moves them by at most 3 u more. Hence the sum of
// h_i^2 / Q_ii over the axes is below 1 for the outer one, so that every corner is inside; and Q_ii < h_i^2 for the
// inner one, so that it lies between the facets. The slack has room for the rounding of the proofs of contain.c, which
// every file has to pass. The volume is within (1 + 131 u)^(3/2) of the optimum, which 2^-45 = 256 u covers.
#include "ellipsoid/box_fit.h"

#include "ellipsoid/factor.h"
#include "linear/exact.h"
#include "polytope/centered_box.h"

#define SLACK (128 * 0x1p-53)
#define GAP 0x1p-45

// The ellipsoid of radii sqrt(square) h.
static int fit_scaled(const ovoid_polytope *p, double square, double gap, ovoid_fit *fit) {
    vec3 half;
    if (p->rank != 3 || !centered_box_find(p->vertices, p->vertex_count, &half)) return 0;
    const sym3 q = sym3_diagonal(half.x * half.x * square, half.y * half.y * square, half.z * half.z * square);
    double volume = ball_get_measure(3) * sqrt(q.xx) * sqrt(q.yy) * sqrt(q.zz);
    *fit = (ovoid_fit){.ellipsoid.q = q, .volume = volume, .gap = GAP, .converged = gap >= GAP};
    return 1;
}

int box_fit_outer(const ovoid_polytope *polytope, double gap, ovoid_fit *fit) {
    return fit_scaled(polytope, 3 * (1 + SLACK), gap, fit);
}

int box_fit_inner(const ovoid_polytope *polytope, double gap, ovoid_fit *fit) {
    return fit_scaled(polytope, 1 - SLACK, gap, fit);
}

// 0 < square <= length^2, exactly.
static int is_square_within(double square, double length) {
    dd most = two_product(length, length);
    return square > 0 && (square < most.high || (square == most.high && most.low >= 0));
}

int box_fit_is_enclosed(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid) {
    vec3 half;
    const sym3 *q = &ellipsoid->q;
    return polytope->rank == 3 && centered_box_find(polytope->vertices, polytope->vertex_count, &half) &&
           vec3_max_abs(ellipsoid->center) == 0 && q->xy == 0 && q->xz == 0 && q->yz == 0 &&
           is_square_within(q->xx, half.x) && is_square_within(q->yy, half.y) && is_square_within(q->zz, half.z);
}
