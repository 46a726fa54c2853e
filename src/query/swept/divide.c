// The overlap h(n) of two cores is nowhere less than r, by branch and bound over the directions: these are divided into
// spherical triangles, at first eight around the minimum, then each that is open in half along its longest side. A
// point of the difference body that is r along all three corners is r along all directions between them, since such a
// unit direction is a sum of the corners whose weights are together 1 at least. Tried are the support point in the
// middle of the triangle, and those of the triangles that it is a part of. Around the minimum, where no point does, the
// second derivatives do up to an angle (query/swept/descend.c).
//
// Errors, in parts u s as in swept.c: a corner is of unit length, a middle off the great circle of its side, and a
// product off, by less than 10 u s together, along which h changes by as much; the point is one of the body to 120 u s.
#include "query/swept/divide.h"

// The most supports that are asked.
enum { MOST_CELLS = 300 };

typedef struct division {
    const cores *of;
    vec3 n;        ///< of the minimum,
    double cosine; ///< and the least one of the angle to it that is proven; 2: none
    double wanted;
    int left; ///< supports that may be asked
} division;

static int is_far(const vec3 *point, const vec3 corner[3], double wanted) {
    return min2(vec3_dot(*point, corner[0]), min2(vec3_dot(*point, corner[1]), vec3_dot(*point, corner[2]))) >= wanted;
}

// Puts the longest side, whose corners have the least cosine, first.
static void turn_corners(vec3 corner[3]) {
    const double last = vec3_dot(corner[0], corner[1]), first = vec3_dot(corner[1], corner[2]),
                 next = vec3_dot(corner[2], corner[0]);
    const vec3 kept = corner[0];
    if (first < last && first <= next)
        corner[0] = corner[1], corner[1] = corner[2], corner[2] = kept;
    else if (next < last)
        corner[0] = corner[2], corner[2] = corner[1], corner[1] = kept;
}

// NOLINTNEXTLINE(misc-no-recursion): each call asks a support, of which there are at most MOST_CELLS
static int divide(division *d, vec3 a, vec3 b, vec3 c, const vec3 *known) {
    vec3 corner[3] = {a, b, c};
    const vec3 n = d->n;
    if (min2(vec3_dot(n, a), min2(vec3_dot(n, b), vec3_dot(n, c))) >= d->cosine) return 1;
    if (is_far(known, corner, d->wanted)) return 1;
    if (d->left-- == 0) return 0;
    const vec3 middle = vec3_unit(vec3_add(vec3_add(a, b), c)), point = cores_find_ends(d->of, middle).v;
    if (vec3_dot(point, middle) < d->wanted) return 0;
    if (is_far(&point, corner, d->wanted)) return 1;
    turn_corners(corner);
    const vec3 half = vec3_unit(vec3_add(corner[0], corner[1]));
    return divide(d, corner[0], half, corner[2], &point) && divide(d, half, corner[1], corner[2], &point);
}

int cores_divide(const cores *p, const least_overlap *at, double wanted) {
    const patch_plane *of = &at->of;
    const double tangent = least_overlap_find_angle(at, wanted);
    division d = {p, of->n, tangent > 0 ? 1 / sqrt(1 + tangent * tangent) + 0x1p-50 : 2, wanted, MOST_CELLS};
    const vec3 none = {0, 0, 0};
    int is_proven = 1;
    for (int i = 0; i < 8 && is_proven; i++) {
        const vec3 pole = i & 1 ? vec3_neg(of->n) : of->n, e = i & 2 ? vec3_neg(of->e[0]) : of->e[0],
                   f = i & 4 ? vec3_neg(of->e[1]) : of->e[1];
        is_proven = divide(&d, pole, e, f, &none);
    }
    return is_proven;
}
