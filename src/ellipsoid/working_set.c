// Constraint generation, as cutting-plane methods do it (J. E. Kelley, The cutting-plane method for solving convex
// programs, 1960): the ellipsoid has nine unknowns and touches a few dozen walls, whatever their number. Walls of the
// working set stand in front in the array. Each round solves for them alone, then looks at all others and takes in, of
// each cell of directions, the one that the ellipsoid sticks out of farthest; the end is when it sticks out of none.
// Where a round goes wrong (the walls at hand may not even bound a body), all walls are taken. The result is a proposal
// like that of inscribe.c: the caller proves it.
#include "ellipsoid/working_set.h"

// Cells of directions: 4 x 4 on each side of a cube. Below FEW walls a working set does not pay.
enum { CELLS = 96, FEW = 256, ROUNDS = 40 };

static int find_cell(vec3 n) {
    const double x[3] = {n.x, n.y, n.z};
    int axis = fabs(x[0]) >= fabs(x[1]) && fabs(x[0]) >= fabs(x[2]) ? 0 : fabs(x[1]) >= fabs(x[2]) ? 1 : 2;
    double size = fabs(x[axis]), u = x[(axis + 1) % 3] / size, v = x[(axis + 2) % 3] / size;
    int column = u < 0 ? u < -0.5 ? 0 : 1 : u < 0.5 ? 2 : 3, row = v < 0 ? v < -0.5 ? 0 : 1 : v < 0.5 ? 2 : 3;
    return ((x[axis] < 0 ? 3 : 0) + axis) * 16 + row * 4 + column;
}

// By insertion: there are few.
static void sort(uint32_t *list, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) {
        uint32_t x = list[i], k = i;
        for (; k > 0 && list[k - 1] > x; k--) list[k] = list[k - 1];
        list[k] = x;
    }
}

// Brings the chosen walls to the end of the working set; returns its new size.
static uint32_t bring_forward(constraint *constraints, uint32_t set, uint32_t *chosen, uint32_t count) {
    // In ascending order a wall is never moved away before its turn.
    sort(chosen, count);
    for (uint32_t i = 0; i < count; i++, set++) {
        constraint c = constraints[set];
        constraints[set] = constraints[chosen[i]];
        constraints[chosen[i]] = c;
    }
    return set;
}

// Takes in the wall of each cell that the ellipsoid sticks out of farthest, in units of its own reach, if that is above
// `least`. Returns the new size; *most: how far it sticks out.
static uint32_t take_worst(constraint *constraints, uint32_t set, uint32_t count, const inscribed *s, double least,
                           double *most) {
    double worst[CELLS];
    uint32_t which[CELLS], chosen[CELLS], taken = 0;
    for (int i = 0; i < CELLS; i++) worst[i] = least;
    *most = least;
    for (uint32_t i = set; i < count; i++) {
        constraint *c = &constraints[i];
        double h = vec3_norm(sym3_mul_vec3(s->e, c->n)), out = 1 + (vec3_dot(c->n, s->x) - c->b) / h;
        *most = fmax(*most, out);
        if (!(out > least)) continue;
        int cell = find_cell(c->n);
        if (out > worst[cell]) worst[cell] = out, which[cell] = i;
    }
    for (int i = 0; i < CELLS; i++)
        if (worst[i] > least) chosen[taken++] = which[i];
    return bring_forward(constraints, set, chosen, taken);
}

// Of the walls outside of the working set, what the caller reads.
static void finish(constraint *constraints, uint32_t set, uint32_t count, const inscribed *s) {
    for (uint32_t i = set; i < count; i++) {
        constraint *c = &constraints[i];
        vec3 p = sym3_mul_vec3(s->e, c->n);
        c->y = 0;
        c->h = vec3_norm(p);
        c->w = vec3_scale(p, 1 / c->h);
    }
}

inscribed working_set_solve(constraint *constraints, uint32_t count, const inscribed *guess, double gap) {
    if (count <= FEW) return inscribe_solve(constraints, count, gap);
    double out;
    inscribed s = *guess;
    uint32_t set = take_worst(constraints, 0, count, &s, -INFINITY, &out), iterations = 0;
    double goal = 1e-2;
    for (int round = 0; round < ROUNDS; round++) {
        s = inscribe_solve(constraints, set, goal);
        iterations += s.iterations;
        s.iterations = iterations;
        vec3 x;
        if (!vec3_is_finite(s.x) || !isfinite(s.gap) || !sym3_solve(s.e, (vec3){0, 0, 0}, &x)) break;
        uint32_t before = set;
        set = take_worst(constraints, set, count, &s, gap, &out);
        if (set == before && goal <= gap) {
            finish(constraints, set, count, &s);
            return s;
        }
        goal = set == before ? gap : fmax(gap, fmin(goal, 0.1 * out));
    }
    s = inscribe_solve(constraints, count, gap);
    s.iterations += iterations;
    return s;
}
