// Constraint generation, as cutting-plane methods do it (J. E. Kelley, The cutting-plane method for solving convex
// programs, 1960): the ellipsoid has nine unknowns and touches a few dozen halfspaces, whatever their number. The
// halfspaces of the working set are the first in the array. Each round solves for them alone, then tests all others and
// adds, from each cell of directions, the one that the ellipsoid violates most; it ends when none is violated. If a
// round fails (the working set may not even bound a body), all halfspaces are taken. The result is only a proposal, as
// in inscribe.c: the caller proves it.
#include "ellipsoid/working_set.h"

// Cells of directions: 4 x 4 on each side of a cube. Below FEW halfspaces a working set does not pay.
enum { CELLS = 96, FEW = 256, ROUNDS = 40 };

static int find_cell(vec3 n) {
    const double x[3] = {n.x, n.y, n.z};
    int axis = fabs(x[0]) >= fabs(x[1]) && fabs(x[0]) >= fabs(x[2]) ? 0 : fabs(x[1]) >= fabs(x[2]) ? 1 : 2;
    double size = fabs(x[axis]), u = x[(axis + 1) % 3] / size, v = x[(axis + 2) % 3] / size;
    int column = u < 0 ? u < -0.5 ? 0 : 1 : u < 0.5 ? 2 : 3, row = v < 0 ? v < -0.5 ? 0 : 1 : v < 0.5 ? 2 : 3;
    return ((x[axis] < 0 ? 3 : 0) + axis) * 16 + row * 4 + column;
}

// Insertion sort, since the lists are short.
static void sort(uint32_t *list, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) {
        uint32_t x = list[i], k = i;
        for (; k > 0 && list[k - 1] > x; k--) list[k] = list[k - 1];
        list[k] = x;
    }
}

typedef struct working_set {
    constraint_set all; // those of the working set first
    uint32_t count;     // the number of them in the working set
    double violation;   // the largest violation outside of the working set before the last choice, as take_worst
                        // measures it
} working_set;

// Moves the chosen halfspaces to the end of the working set.
static void bring_forward(working_set *w, uint32_t *chosen, uint32_t count) {
    constraint *items = w->all.items;
    // In ascending order, since then no chosen halfspace is moved before its turn.
    sort(chosen, count);
    for (uint32_t i = 0; i < count; i++, w->count++) {
        constraint c = items[w->count];
        items[w->count] = items[chosen[i]];
        items[chosen[i]] = c;
    }
}

// Adds from each cell the halfspace that the ellipsoid violates most, if by more than `least`; in units of the
// ellipsoid's own reach. Returns their number.
static uint32_t take_worst(working_set *w, const inscribed *s, double least) {
    double worst[CELLS];
    uint32_t which[CELLS], chosen[CELLS], taken = 0;
    for (int i = 0; i < CELLS; i++) worst[i] = least;
    w->violation = least;
    for (uint32_t i = w->count; i < w->all.count; i++) {
        const constraint *c = &w->all.items[i];
        double h = vec3_norm(sym3_mul_vec3(s->e, c->n)), out = 1 + (vec3_dot(c->n, s->x) - c->b) / h;
        w->violation = fmax(w->violation, out);
        if (!(out > least)) continue;
        int cell = find_cell(c->n);
        if (out > worst[cell]) worst[cell] = out, which[cell] = i;
    }
    for (int i = 0; i < CELLS; i++)
        if (worst[i] > least) chosen[taken++] = which[i];
    bring_forward(w, chosen, taken);
    return taken;
}

// Sets what the caller reads for halfspaces outside of the working set.
static void finish(working_set *w, const inscribed *s) {
    for (uint32_t i = w->count; i < w->all.count; i++) {
        constraint *c = &w->all.items[i];
        vec3 p = sym3_mul_vec3(s->e, c->n);
        c->y = 0;
        c->h = vec3_norm(p);
        c->w = vec3_scale(p, 1 / c->h);
    }
}

inscribed working_set_solve(constraint_set all, const inscribed *guess, double gap) {
    if (all.count <= FEW) return inscribe_solve(all, gap);
    working_set w = {.all = all};
    inscribed s = *guess;
    uint32_t iterations = 0;
    double goal = 1e-2;
    (void)take_worst(&w, &s, -INFINITY);
    for (int round = 0; round < ROUNDS; round++) {
        s = inscribe_solve((constraint_set){all.items, w.count}, goal);
        iterations += s.iterations;
        s.iterations = iterations;
        vec3 x;
        if (!vec3_is_finite(s.x) || !isfinite(s.gap) || !sym3_solve(s.e, (vec3){0, 0, 0}, &x)) break;
        uint32_t taken = take_worst(&w, &s, gap);
        if (taken == 0 && goal <= gap) {
            finish(&w, &s);
            return s;
        }
        goal = taken == 0 ? gap : fmax(gap, fmin(goal, 0.1 * w.violation));
    }
    s = inscribe_solve(all, gap);
    s.iterations += iterations;
    return s;
}
