// The depth of two cores that overlap: the least overlap over all directions, which a local search finds
// (query/swept/descend.c) and one of three proofs shows to be the least of all, the cheapest first:
// - a point of one core, or a ball in it that touches its surface there, is no nearer to leaving the other core, in
//   closed form. That it has to leave is all that the overlap needs;
// - two such balls are larger together than the overlap;
// - a polytope in the difference body holds a ball of that radius (query/swept/enclose.c); where its faces become
//   slivers, directions are divided until none is open (query/swept/divide.c).
// A box and a triangle have a closed form (linear/box_triangle.h).
// A cylinder or a cone with a box (query/swept/circles.c), a hull with faces (query/swept/hull_arcs.c) or another one
// (query/swept/revolved.c) has a proof of its own, which comes before these. Beside an ellipsoid the first two are
// tried, and then the directions are shown cell by cell, of a hull with faces (query/swept/hull_cells.c) or of another
// body (query/swept/ellipsoid_cells.c).
#include "query/swept/overlap.h"

#include "linear/box_triangle.h"
#include "query/swept/edged.h"
#include "query/swept/ellipsoid_cells.h"
#include "query/swept/enclose.h"
#include "query/swept/hull_cells.h"
#include "query/swept/profile.h"

enum { EXCHANGES = 1, DESCENTS = 3 };

// The radius of a ball in the core that touches its surface from within at its farthest point along n, where that is
// `reach` along n from the centre. Of an ellipsoid: with E its form, q another point of it and p that one,
// |q - p|^2 / (2 n.(p - q)) is |q - p|^2 / reach over (q - p).E (q - p), and so no less than the least half axis
// squared over the reach.
static double find_ball(const swept *s, double reach) {
    const double *h = s->half;
    if (s->core != OVOID_SWEPT_ELLIPSOID) return 0;
    double least = min2(h[0], min2(h[1], h[2]));
    return least * least / reach;
}

typedef struct overlap_search {
    cores of;
    double tolerance;
    double value; ///< the least overlap so far
    vec3 n;       ///< along this
    vec3 on_a, on_b;
    int is_proven; ///< no overlap is less than the value by more than the tolerance
} overlap_search;

// The overlap along a unit direction, and how the other core's ball there leaves the core X. *next: the direction of
// that, if it has one.
static void exchange(overlap_search *s, int is_x_b, vec3 n, vec3 *next) {
    const swept *x = is_x_b ? s->of.b : s->of.a, *y = is_x_b ? s->of.a : s->of.b;
    const overlap_ends ends = cores_find_ends(&s->of, n);
    double value = vec3_dot(n, ends.v);
    vec3 outward = is_x_b ? vec3_neg(n) : n, on_y = is_x_b ? ends.on_a : ends.on_b;
    double radius = find_ball(y, -vec3_dot(outward, on_y));
    vec3 at = vec3_add_scaled(is_x_b ? vec3_sub(on_y, s->of.d) : vec3_add(on_y, s->of.d), outward, radius);
    swept_way_out out = swept_leave_core(x, at);
    double length = out.is_inside ? 1 : vec3_norm(out.off), left = radius + (out.is_inside ? out.depth : -length);
    if (value < s->value) s->value = value, s->n = n;
    const int is_vague = !out.is_inside && out.depth > 0;
    if (!is_vague && left >= value - s->tolerance) {
        // From within there may be another way as short, so the point goes along n.
        vec3 on_x = out.is_inside ? vec3_add_scaled(at, outward, out.depth) : vec3_sub(at, out.off);
        s->is_proven = 1;
        s->value = value, s->n = n;
        s->on_a = is_x_b ? on_y : on_x;
        s->on_b = is_x_b ? on_x : on_y;
    }
    *next = length > 0x1p-20 * s->of.size ? vec3_scale(out.off, (is_x_b ? -1 : 1) / length) : n;
}

// From the way on which the other core's middle leaves X, to and fro.
static void exchange_from_middle(overlap_search *s, int is_x_b) {
    const swept *x = is_x_b ? s->of.b : s->of.a, *y = is_x_b ? s->of.a : s->of.b;
    vec3 middle = swept_find_middle(y);
    swept_way_out out = swept_leave_core(x, is_x_b ? vec3_sub(middle, s->of.d) : vec3_add(middle, s->of.d));
    double length = vec3_norm(out.off);
    if (!(length > 0x1p-20 * s->of.size)) return;
    vec3 n = vec3_scale(out.off, (is_x_b ? -1 : 1) / length);
    for (int k = 0; k < EXCHANGES && !s->is_proven; k++) {
        double before = s->value;
        exchange(s, is_x_b, n, &n);
        if (k > 0 && !(s->value < before)) return;
    }
}

static int has_way_out(const swept *s) { return s->core >= OVOID_SWEPT_SEGMENT && s->core <= OVOID_SWEPT_CONE; }

// The ways on which the middle of each core leaves the other one, or from one to the other.
static void try_middles(overlap_search *s) {
    const swept *a = s->of.a, *b = s->of.b;
    for (int is_x_b = 0; is_x_b < 2 && !s->is_proven; is_x_b++)
        if (has_way_out(is_x_b ? b : a)) exchange_from_middle(s, is_x_b);
    if (s->is_proven) return;
    const vec3 n = vec3_unit(vec3_sub(vec3_add(s->of.d, swept_find_middle(b)), swept_find_middle(a)));
    if (!(vec3_norm_squared(n) > 0.5)) return;
    const double value = vec3_dot(n, cores_find_ends(&s->of, n).v);
    if (value < s->value) s->value = value, s->n = n;
}

// Is the minimum shown to be the least one without a polytope?
static int is_least(overlap_search *s, const least_overlap *at) {
    vec3 next;
    for (int is_x_b = 0; is_x_b < 2 && !s->is_proven; is_x_b++)
        if (has_way_out(is_x_b ? s->of.b : s->of.a)) exchange(s, is_x_b, at->of.n, &next);
    if (s->is_proven) return 1;
    double radius =
        find_ball(s->of.a, vec3_dot(at->of.n, at->on_a)) + find_ball(s->of.b, -vec3_dot(at->of.n, at->on_b));
    vec3 v = vec3_sub(vec3_sub(at->on_a, at->on_b), s->of.d), center = vec3_add_scaled(v, at->of.n, -radius);
    return radius - vec3_norm(center) >= at->value - s->tolerance;
}

// An ellipsoid beside a hull with faces, or beside another body.
typedef struct least_cells {
    int is_hull;
    double doubt;
    union {
        hull_cells hull;
        ellipsoid_cells bodies;
    } of;
} least_cells;

static int have_cells(const cores *p) { return cores_have_hull_cells(p) || cores_have_ellipsoid_cells(p); }

// The overlap along the direction in which the search begins, which is set.
static double make_cells(const cores *p, least_cells *to, vec3 *n) {
    to->is_hull = cores_have_hull_cells(p);
    const double value = to->is_hull ? hull_cells_make(p, &to->of.hull, n) : ellipsoid_cells_make(p, &to->of.bodies, n);
    to->doubt = to->is_hull ? to->of.hull.doubt : to->of.bodies.doubt;
    return value;
}

static int hold_cells(least_cells *c, const cores *p, const least_overlap *at, double wanted, vec3 *less) {
    return c->is_hull ? hull_cells_hold(&c->of.hull, p, at, wanted, less)
                      : ellipsoid_cells_hold(&c->of.bodies, at, wanted, less);
}

// From the direction of the cells, and from what is less or about as low. 0 if no minimum is shown to be the least:
// then *s has the last direction.
static int search_cells(overlap_search *s, double claim, least_overlap *to, double *doubt) {
    least_cells cells;
    least_overlap next, *now = to;
    s->value = make_cells(&s->of, &cells, &s->n);
    *doubt = cells.doubt;
    for (int i = 0; i < DESCENTS && s->value > 4 * claim && s->value < INFINITY; i++, now = &next) {
        now->count = 0;
        if (!(i == 0 && cells.is_hull && hull_cells_find_facet(&cells.of.hull, &s->of, now)) &&
            !cores_descend(&s->of, s->n, s->value, now))
            return 0;
        s->value = now->value, s->n = now->of.n;
        if (!(s->value > 4 * claim)) return 0;
        if (now->value < to->value) *to = *now;
        vec3 less;
        if (is_least(s, to) || hold_cells(&cells, &s->of, now, to->value - 0.5 * s->tolerance, &less)) return 1;
        if (!(vec3_norm_squared(less) > 0)) return 0;
        s->n = less, s->value = vec3_dot(less, cores_find_ends(&s->of, less).v);
    }
    return 0;
}

static ovoid_verdict answer(const swept_placed *p, const least_overlap *at, double lower, ovoid_witness *witness) {
    ovoid_verdict v = swept_make_verdict(-at->value - p->radii - p->claim, -lower - p->radii, TOLERANCE * p->size);
    if (v.status != OVOID_OVERLAPPING || v.upper - v.lower > TOLERANCE * p->size) return swept_undecided;
    nearest_pair found = {.point_a = at->on_a, .normal = at->of.n};
    found.difference = vec3_sub(vec3_add(p->d, at->on_b), at->on_a);
    if (witness) swept_write_witness(p, &found, at->of.n, witness);
    return v;
}

// ---- a box and a triangle

static int is_triangle(const swept *s) { return s->core == OVOID_SWEPT_POINTS && s->count == 3; }

static int are_box_and_triangle(const cores *of) {
    return of->a->core == OVOID_SWEPT_BOX ? is_triangle(of->b) : of->b->core == OVOID_SWEPT_BOX && is_triangle(of->a);
}

// 0 if the closed form leaves it open.
static int search_box_and_triangle(const overlap_search *s, least_overlap *to) {
    const int is_box_b = s->of.b->core == OVOID_SWEPT_BOX;
    const swept *box = is_box_b ? s->of.b : s->of.a, *triangle = is_box_b ? s->of.a : s->of.b;
    const vec3 way = is_box_b ? vec3_neg(s->of.d) : s->of.d;
    vec3 corner[3];
    box_triangle found;
    for (size_t i = 0; i < 3; i++)
        corner[i] = patch_turn(box, vec3_add(way, patch_turn_back(triangle, vec3_at(triangle->points, i))));
    if (!(min2(box->half[0], min2(box->half[1], box->half[2])) >= 0)) return 0;
    if (!box_triangle_find_overlap(box->half, corner, 16 * 0x1p-53 * s->of.size, &found)) return 0;
    if (!(found.value - found.lower <= s->tolerance)) return 0;
    const vec3 n = patch_turn_back(box, found.n), on_box = patch_turn_back(box, found.on_box),
               on_triangle = vec3_sub(patch_turn_back(box, found.on_triangle), way);
    to->of = patch_make_plane(is_box_b ? vec3_neg(n) : n);
    to->value = found.value;
    to->on_a = is_box_b ? on_triangle : on_box;
    to->on_b = is_box_b ? on_box : on_triangle;
    return 1;
}

ovoid_verdict swept_measure_overlap(const swept_placed *p, ovoid_witness *witness) {
    overlap_search s = {.of = {p->a, p->b, p->d, p->size}, .tolerance = 0.4 * TOLERANCE * p->size};
    least_overlap least;
    if (are_box_and_triangle(&s.of) && search_box_and_triangle(&s, &least))
        return answer(p, &least, least.value - s.tolerance - 4 * p->claim, witness);
    if (cores_have_circles(&s.of) && cores_search_circles(&s.of, s.tolerance, &least))
        return answer(p, &least, least.value - s.tolerance - 4 * p->claim, witness);
    double doubt;
    if (cores_have_hull_arcs(&s.of) && cores_search_hull_arcs(&s.of, s.tolerance, &least, &doubt))
        return answer(p, &least, least.value - s.tolerance - doubt - 4 * p->claim, witness);
    s.value = INFINITY;
    if (have_cells(&s.of) && search_cells(&s, p->claim, &least, &doubt))
        return answer(p, &least, least.value - s.tolerance - doubt - 4 * p->claim, witness);
    // What cells left open begins anew from the middles.
    if (cores_have_ellipsoid_cells(&s.of)) s.value = INFINITY;
    if (cores_are_revolved(&s.of)) {
        if (cores_search_revolved(&s.of, s.tolerance, &least))
            return answer(p, &least, least.value - s.tolerance - 4 * p->claim, witness);
        s.value = least.value, s.n = least.of.n;
    }
    if (!(s.value < INFINITY)) try_middles(&s);
    if (!(s.value > 4 * p->claim && s.value < INFINITY)) return swept_undecided;
    double lower;
    if (s.is_proven) {
        least.value = s.value, least.of.n = s.n, least.on_a = s.on_a, least.on_b = s.on_b;
        lower = s.value - s.tolerance - 2 * p->claim;
        return answer(p, &least, lower, witness);
    }
    least.count = 0;
    if (!cores_descend(&s.of, s.n, s.value, &least)) {
        least.value = INFINITY;
        least.of = patch_make_plane(s.n);
    } else if (!(least.value > 4 * p->claim)) {
        return swept_undecided;
    } else if (is_least(&s, &least)) {
        return answer(p, &least, least.value - s.tolerance - 2 * p->claim, witness);
    }
    if (!cores_enclose(&s.of, p->claim, s.tolerance, &least, &lower)) return swept_undecided;
    return answer(p, &least, lower, witness);
}
