// Ellipsoids of boxes, regular prisms, regular pyramids and the polyhedra of ellipsoids. Stretching keeps the order of
// volumes, and the extremal ellipsoids are unique, so they have the symmetries of the body (F. John, Extremum problems
// with inequalities as subsidiary conditions, 1948; O. Gueler, F. Guertuna, Symmetry of convex sets and its
// applications to the extremal ellipsoids of convex bodies, 2012): those of a regular polygon's prism are around its
// axis, as of a cylinder, and stretched balls. Diagonals of Q, and the centre if it is not the origin:
//
//     body                        outer                               inner
//     box of half sizes h         3 h_x^2, 3 h_y^2, 3 h_z^2           h_x^2, h_y^2, h_z^2
//     prism, radius R, apothem r  3/2 R^2, 3/2 R^2, 3 h^2             r^2, r^2, h^2
//     pyramid, z = -h/2           9/8 R^2, 9/8 R^2, 9/4 h^2           1/2 r^2, 1/2 r^2, 1/4 h^2
//     ellipsoid's polyhedron      a_x^2, a_y^2, a_z^2                 those times the square of its ball's radius
//
// At a prism's corner the terms of the outer one are 2/3 and 1/3; at a pyramid's ring they are 8/9 and 1/9, at its apex
// 0 and 1. A pyramid's inner one with the half axis b along z touches the base if its centre is b above it, and the
// sides if its half axis across is r sqrt(1 - b / h); its volume is greatest for b = h / 2.
//
// With u = 2^-53, entries are moved by a slack, and rounding moves them by at most 4 u more. For a box it is 128 u. The
// sum of h_i^2 / Q_ii is then below 1 for the outer one, and Q_ii < h_i^2 for the inner one, so that it lies between
// the facets. For the others it is 8 e and 128 u more, where e is the error of the ring (regular_solid.h), at least
// 1500 u: corners are within R (1 + e), and each polygon lies in the other one enlarged by 1 + 2.1 e. r is off by 150
// u; so an inner ellipsoid lies inside if its entries across are at most 1 - 6 e times the table's, and those along z
// are not above the table's. The slack has room for the rounding of the proofs of contain.c, which every file has to
// pass.
//
// Gaps: the volumes are within (1 + slack + 4 u)^(3/2) of the table's, which are within (1 + 2.1 e)^4 and 300 u of the
// optimum: 32 e and 256 u cover both.
#include "ellipsoid/closed_fit.h"

#include "ellipsoid/factor.h"
#include "linear/exact.h"

#define SLACK (128 * 0x1p-53)
#define GAP 0x1p-45

// An upright ellipsoid: the diagonal of Q and the centre's height.
typedef struct upright {
    vec3 square;
    double z, error; // of the ring, 0 for a box
} upright;

static upright make_box(vec3 half, double part) {
    return (upright){{half.x * half.x * part, half.y * half.y * part, half.z * half.z * part}, 0, 0};
}

static upright make_turned(const regular_solid *s, double across, double along) {
    double h = s->half_length, error = regular_solid_get_error(s);
    return (upright){{across, across, h * h * along}, s->is_prism ? 0 : -h / 2, error};
}

// The ball of n steps is off by 16 n u, its square by twice that (polytope/ellipsoid_grid.h).
static upright make_scaled(const ellipsoid_grid *g, double ball) {
    upright e = make_box(g->half, ball * ball);
    e.error = g->steps * (16 * 0x1p-53);
    return e;
}

static upright make_outer(const closed_form *form) {
    const regular_solid *s = &form->solid;
    if (form->kind == FORM_ELLIPSOID) return make_scaled(&form->grid, 1);
    if (form->kind == FORM_BOX) return make_box(form->half, 3);
    return make_turned(s, s->radius_squared * (s->is_prism ? 1.5 : 1.125), s->is_prism ? 3 : 2.25);
}

static upright make_inner(const closed_form *form) {
    const regular_solid *s = &form->solid;
    if (form->kind == FORM_ELLIPSOID) return make_scaled(&form->grid, form->grid.ball);
    if (form->kind == FORM_BOX) return make_box(form->half, 1);
    return make_turned(s, s->apothem_squared * (s->is_prism ? 1 : 0.5), s->is_prism ? 1 : 0.25);
}

// The ellipsoid, its matrix moved by the slack to that side.
static int fit_moved(const upright *e, int side, double gap, ovoid_fit *fit) {
    double by = 1 + side * (SLACK + 8 * e->error), most = GAP + 32 * e->error;
    const sym3 q = sym3_diagonal(e->square.x * by, e->square.y * by, e->square.z * by);
    double volume = ball_get_measure(3) * sqrt(q.xx) * sqrt(q.yy) * sqrt(q.zz);
    *fit = (ovoid_fit){.ellipsoid = {{0, 0, e->z}, q}, .volume = volume, .gap = most, .converged = gap >= most};
    return gap >= most;
}

int closed_fit_outer(const closed_form *form, double gap, ovoid_fit *fit) {
    if (form->kind == FORM_NONE) return 0;
    upright e = make_outer(form);
    return fit_moved(&e, 1, gap, fit);
}

int closed_fit_inner(const closed_form *form, double gap, ovoid_fit *fit) {
    if (form->kind == FORM_NONE) return 0;
    upright e = make_inner(form);
    return fit_moved(&e, -1, gap, fit);
}

// 0 < square <= length^2, exactly.
static int is_square_within(double square, double length) {
    dd most = two_product(length, length);
    return square > 0 && (square < most.high || (square == most.high && most.low >= 0));
}

int closed_fit_is_enclosed(const closed_form *form, const ovoid_ellipsoid *ellipsoid) {
    const sym3 *q = &ellipsoid->q;
    vec3 c = ellipsoid->center;
    if (form->kind == FORM_NONE || q->xy != 0 || q->xz != 0 || q->yz != 0 || c.x != 0 || c.y != 0) return 0;
    if (form->kind == FORM_BOX)
        return c.z == 0 && is_square_within(q->xx, form->half.x) && is_square_within(q->yy, form->half.y) &&
               is_square_within(q->zz, form->half.z);
    upright e = make_inner(form);
    double part = 1 - 6 * e.error;
    if (form->kind == FORM_ELLIPSOID)
        return c.z == 0 && q->xx > 0 && q->xx <= e.square.x * part && q->yy > 0 && q->yy <= e.square.y * part &&
               q->zz > 0 && q->zz <= e.square.z * part;
    double across = e.square.x * part, length = form->solid.half_length * (form->solid.is_prism ? 1 : 0.5);
    return c.z == e.z && q->xx > 0 && q->xx <= across && q->yy > 0 && q->yy <= across &&
           is_square_within(q->zz, length);
}
