// The overlap h(n) of two cores is nowhere less than r, by branch and bound over the directions that are open: a cap of
// them is covered by two spherical triangles, and each triangle that is open is halved along its longest side. A point
// of the difference body that is r along all three corners is r along all directions between them, since such a unit
// direction is a sum of the corners whose weights are together 1 at least. Tried are the support point in the middle of
// the triangle, and those of the triangles that it is a part of. Around the minimum, where no point does, the second
// derivatives do up to an angle (query/swept/descend.c).
//
// Errors, in parts u s as in swept.c: a corner is of unit length, a middle off the great circle of its side, and a
// product off, by less than 10 u s together, along which h changes by as much; the point is one of the body to 120 u s.
#include "query/swept/divide.h"

// The most supports that are asked, and the most times that a triangle is halved.
enum { MOST_CELLS = 600, MOST_HALVES = 32 };

// A spherical triangle.
typedef struct cell {
    const vec3 *corner[3];
} cell;

static double find_least(const cell *c, vec3 v) {
    return min2(vec3_dot(v, *c->corner[0]), min2(vec3_dot(v, *c->corner[1]), vec3_dot(v, *c->corner[2])));
}

// The corner at which the longest side begins: the one whose ends have the least cosine.
static int find_longest(const cell *c) {
    const double side0 = vec3_dot(*c->corner[0], *c->corner[1]), side1 = vec3_dot(*c->corner[1], *c->corner[2]),
                 side2 = vec3_dot(*c->corner[2], *c->corner[0]);
    return side1 < side0 && side1 <= side2 ? 1 : side2 < side0 ? 2 : 0;
}

// known: a point of the difference body; left: how many times the cell may be halved.
// NOLINTNEXTLINE(misc-no-recursion): no cell is halved more than MOST_HALVES times
static int divide(division *d, const cell *c, const vec3 *known, int left) {
    if (find_least(c, *known) >= d->wanted || find_least(c, d->n) >= d->cosine) return 1;
    if (d->left-- <= 0 || left == 0) return 0;
    const vec3 middle = vec3_unit(vec3_add(vec3_add(*c->corner[0], *c->corner[1]), *c->corner[2])),
               point = d->find(d->of, middle);
    if (vec3_dot(point, middle) < d->wanted) {
        d->less = middle;
        return 0;
    }
    if (find_least(c, point) >= d->wanted) return 1;
    const int i = find_longest(c), k = (i + 1) % 3;
    const vec3 half = vec3_unit(vec3_add(*c->corner[i], *c->corner[k]));
    cell part = *c;
    part.corner[k] = &half;
    if (!divide(d, &part, &point, left - 1)) return 0;
    part = *c;
    part.corner[i] = &half;
    return divide(d, &part, &point, left - 1);
}

static vec3 find_end(const void *of, vec3 n) { return cores_find_ends(of, n).v; }

division division_make(const cores *p, const least_overlap *at, double wanted) {
    const double tangent = least_overlap_find_angle(at, wanted);
    return (division){p,      find_end,   at->of.n, tangent > 0 ? 1 / sqrt(1 + tangent * tangent) + 0x1p-50 : 2,
                      wanted, MOST_CELLS, {0, 0, 0}};
}

int division_hold(division *d, const vec3 corner[3], const vec3 *known) {
    const cell whole = {{&corner[0], &corner[1], &corner[2]}};
    return divide(d, &whole, known, MOST_HALVES);
}

// Seen from the middle of a cap great circles are lines: a square covers it.
static int divide_cap(division *d, const direction_cap *cap) {
    const patch_plane of = patch_make_plane(cap->n);
    const double reach = sqrt(2 * (1 - cap->cosine * cap->cosine)) / cap->cosine;
    vec3 corner[4];
    for (int i = 0; i < 4; i++) corner[i] = vec3_unit(vec3_add_scaled(of.n, of.e[i & 1], i & 2 ? -reach : reach));
    const vec3 none = {0, 0, 0};
    return division_hold(d, corner, &none) && division_hold(d, (vec3[]){corner[2], corner[3], corner[0]}, &none);
}

int cores_divide(const cores *p, const least_overlap *at, double wanted, const direction_caps *open) {
    division d = division_make(p, at, wanted);
    int is_proven = 1;
    for (uint32_t i = 0; i < open->count && is_proven; i++)
        is_proven = open->cap[i].cosine > 0 && divide_cap(&d, &open->cap[i]);
    return is_proven;
}
