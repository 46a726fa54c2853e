// Convex polygons in the plane, in exact arithmetic. The cut is that of I. E. Sutherland and G. W. Hodgman, Reentrant
// polygon clipping, 1974; the hull that of A. M. Andrew, Another efficient algorithm for convex hulls in two
// dimensions, 1979.
#include "flat.h"

#include <math.h>
#include <stdlib.h>

/// A sum of products in doubles has the sign of the exact one if it is above this part of the sum of their absolute
/// values; rounding is less than a thousandth of it.
#define SURE 1e-12

twin twin_make(num n) { return (twin){n, num_to_double(n)}; }

flat_point flat_point_make(pool *p, num x, num y) {
    return (flat_point){twin_make(x), twin_make(y), {number_from_integer(p, 1), 1}};
}

int flat_find_side(pool *p, const flat_line *l, const flat_point *at) {
    double x = l->a.d * at->x.d, y = l->b.d * at->y.d, w = l->c.d * at->w.d, sum = x + y + w;
    if (fabs(sum) > SURE * (fabs(x) + fabs(y) + fabs(w))) return sum > 0 ? 1 : -1;
    size_t mark = pool_get_mark(p);
    num exact =
        num_add(p, num_add(p, num_mul(p, l->a.n, at->x.n), num_mul(p, l->b.n, at->y.n)), num_mul(p, l->c.n, at->w.n));
    int sign = num_sign(exact);
    pool_release(p, mark);
    return sign;
}

/// The line through two points with w = 1; its inner side is to the left.
static flat_line line_through(pool *p, const flat_point *from, const flat_point *to) {
    num a = num_sub(p, from->y.n, to->y.n), b = num_sub(p, to->x.n, from->x.n);
    num c = num_neg(p, num_add(p, num_mul(p, a, from->x.n), num_mul(p, b, from->y.n)));
    return (flat_line){twin_make(a), twin_make(b), twin_make(c)};
}

static num cross(pool *p, num a, num b, num c, num d) { return num_sub(p, num_mul(p, a, d), num_mul(p, b, c)); }

/// Where a line meets the next one of a polygon.
static flat_point line_meet(pool *p, const flat_line *l, const flat_line *next) {
    return (flat_point){twin_make(cross(p, l->b.n, l->c.n, next->b.n, next->c.n)),
                        twin_make(cross(p, l->c.n, l->a.n, next->c.n, next->a.n)),
                        twin_make(cross(p, l->a.n, l->b.n, next->a.n, next->b.n))};
}

// ---- the hull ----

static pool *sorting; ///< the pool of the points that are sorted

static int compare_numbers(twin a, twin b) {
    if (fabs(a.d - b.d) > SURE * (fabs(a.d) + fabs(b.d))) return a.d < b.d ? -1 : 1;
    return num_compare(sorting, a.n, b.n);
}

static int compare_points(const void *a, const void *b) {
    const flat_point *x = a, *y = b;
    int by_x = compare_numbers(x->x, y->x);
    return by_x ? by_x : compare_numbers(x->y, y->y);
}

/// 1 if c is to the left of the way from a to b.
static int is_left(pool *p, const flat_point *a, const flat_point *b, const flat_point *c) {
    size_t mark = pool_get_mark(p);
    flat_line l = line_through(p, a, b);
    int side = flat_find_side(p, &l, c);
    pool_release(p, mark);
    return side > 0;
}

/// Adds points to a chain that began at corner `first`, without its right turns.
static void extend(pool *p, flat_polygon *out, uint32_t first, const flat_point *point) {
    const flat_point *c = out->corners;
    while (out->count >= first + 2 && !is_left(p, &c[out->count - 2], &c[out->count - 1], point)) out->count--;
    out->corners[out->count++] = *point;
}

void flat_make_hull(pool *p, flat_point *points, uint32_t count, flat_polygon *out) {
    sorting = p;
    qsort(points, count, sizeof *points, compare_points);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++)
        if (!kept || compare_points(&points[kept - 1], &points[i])) points[kept++] = points[i];
    out->count = 0;
    if (kept > FLAT_CORNERS - 2) kept = FLAT_CORNERS - 2;
    for (uint32_t i = 0; i < kept; i++) extend(p, out, 0, &points[i]);
    uint32_t back = out->count - 1;
    for (uint32_t i = kept; kept > 2 && i-- > 1;) extend(p, out, back, &points[i - 1]);
    if (kept > 2) out->count--;
    for (uint32_t i = 0; out->count > 1 && i < out->count; i++)
        out->lines[i] = line_through(p, &out->corners[i], &out->corners[(i + 1) % out->count]);
}

// ---- the cut ----

/// A polygon that is made, corner by corner.
static int append(flat_polygon *out, const flat_point *corner, const flat_line *line) {
    if (out->count == FLAT_CORNERS) return 0;
    out->corners[out->count] = *corner;
    out->lines[out->count++] = *line;
    return 1;
}

int flat_cut(pool *p, const flat_line *line, flat_polygon *polygon) {
    static flat_polygon in;
    int side[FLAT_CORNERS] = {0}, most = -1, least = 1, is_kept = 1;
    for (uint32_t i = 0; i < polygon->count; i++) {
        side[i] = flat_find_side(p, line, &polygon->corners[i]);
        if (side[i] > most) most = side[i];
        if (side[i] < least) least = side[i];
    }
    if (least >= 0 || polygon->count < 3) return 1;
    in = *polygon;
    polygon->count = 0;
    if (most <= 0) return 1;
    for (uint32_t i = 0; i < in.count; i++) {
        int here = side[i], next = side[(i + 1) % in.count];
        if (here >= 0) is_kept &= append(polygon, &in.corners[i], here == 0 && next < 0 ? line : &in.lines[i]);
        if (here * next >= 0) continue;
        flat_point at = here > 0 ? line_meet(p, &in.lines[i], line) : line_meet(p, line, &in.lines[i]);
        is_kept &= append(polygon, &at, here > 0 ? line : &in.lines[i]);
    }
    return is_kept;
}

// ---- measures ----

num_bracket flat_find_area(pool *p, const flat_polygon *g) {
    enum { BITS = 240 };
    num below = number_from_integer(p, 0), above = below, unit = number_from_integer(p, 1);
    for (uint32_t i = 0; g->count > 2 && i < g->count; i++) {
        const flat_point *a = &g->corners[i], *b = &g->corners[(i + 1) % g->count];
        num term = num_quotient_below(p, cross(p, a->x.n, a->y.n, b->x.n, b->y.n), num_mul(p, a->w.n, b->w.n), BITS);
        below = num_add(p, below, term);
        above = num_add(p, above, num_add(p, term, num_scaled(p, unit, term->e)));
    }
    return (num_bracket){below, above};
}

/// 1 if a point, w times from the start of an edge along d, is farther from the edge e than sqrt(square).
typedef struct edge_way {
    num dx, dy, ex, ey, w;
} edge_way;
static int is_edge_farther(pool *p, const edge_way *k, num metric, num square) {
    num ex = num_mul(p, metric, k->ex), limit = num_mul(p, square, num_mul(p, k->w, k->w));
    num along = num_add(p, num_mul(p, ex, k->dx), num_mul(p, k->ey, k->dy));
    num length = num_add(p, num_mul(p, ex, k->ex), num_mul(p, k->ey, k->ey));
    num beyond = num_sub(p, along, num_mul(p, length, k->w));
    if (num_sign(along) > 0 && num_sign(beyond) < 0) {
        num area = cross(p, k->ex, k->ey, k->dx, k->dy);
        return num_compare(p, num_mul(p, metric, num_mul(p, area, area)), num_mul(p, limit, length)) > 0;
    }
    num x = k->dx, y = k->dy;
    if (num_sign(along) > 0) x = num_sub(p, x, num_mul(p, k->w, k->ex)), y = num_sub(p, y, num_mul(p, k->w, k->ey));
    num far = num_add(p, num_mul(p, metric, num_mul(p, x, x)), num_mul(p, y, y));
    return num_compare(p, far, limit) > 0;
}

// Outside of a polygon the nearest edge is one that the point is on the outer side of.
int flat_is_farther(pool *p, const flat_polygon *g, const flat_point *at, const num metric_and_square[2]) {
    int is_outside = g->count < 3;
    for (uint32_t i = 0; i < g->count; i++) {
        if (g->count > 2 && flat_find_side(p, &g->lines[i], at) >= 0) continue;
        is_outside = 1;
        size_t mark = pool_get_mark(p);
        const flat_point *from = &g->corners[i], *to = &g->corners[(i + 1) % g->count];
        edge_way k = {num_sub(p, at->x.n, num_mul(p, at->w.n, from->x.n)),
                      num_sub(p, at->y.n, num_mul(p, at->w.n, from->y.n)), num_sub(p, to->x.n, from->x.n),
                      num_sub(p, to->y.n, from->y.n), at->w.n};
        int is_farther = is_edge_farther(p, &k, metric_and_square[0], metric_and_square[1]);
        pool_release(p, mark);
        if (!is_farther) return 0;
    }
    return is_outside;
}
