// The points where a body with edges and a round one overlap least. Along the direction one of them has more than one
// farthest point, or both: of the body with one the point is known, and the other one's is opposite to it. Of an edge
// along a face, or of two faces, the farthest points are many, and another one of them may be in both.
#include "query/swept/edged.h"

#include "query/swept/points.h"
#include "shape/gauss_map.h"

// The most times that arcs are halved.
enum { MOST_CELLS = 600 };

edged_search edged_make(const cores *p, int is_edged_b, vec3 axis, vec3 center, double tolerance) {
    const ovoid_swept_sphere *round = is_edged_b ? p->a : p->b;
    edged_search q = {.axis = {axis.x, axis.y, axis.z},
                      .center = {center.x, center.y, center.z},
                      .height = round->half[0],
                      .radius = round->half[1],
                      .is_cone = round->core == OVOID_SWEPT_CONE,
                      .size = p->size,
                      .tolerance = tolerance,
                      .value = INFINITY,
                      .left = MOST_CELLS};
    const double height = 2 * q.height, scale = 1 / sqrt(height * height + q.radius * q.radius);
    q.sine = q.is_cone ? q.radius * scale : 0;
    q.cosine = q.is_cone ? height * scale : 1;
    q.inside = q.is_cone ? q.height * q.sine : q.radius;
    q.ball = min2(q.height, q.inside);
    return q;
}

// ---- a hull

// A hull, its facets and its vertices, and a direction from it to the round body, in the axes of its shape.
typedef struct hull_face {
    const ovoid_swept_sphere *of;
    const gauss_map *map;
    vec3 n;
    double doubt; ///< what is nearer to a plane is in it
} hull_face;

static double measure_facet(const gauss_map *map, uint32_t f, vec3 y) {
    return vec3_dot(gauss_map_get_normal(map, f), y) - (gauss_map_get_low(map, f) + map->bulge);
}

// Is a point, from the centre of the hull's core, beyond a facet?
static int is_beside_hull(const hull_face *h, vec3 y) {
    const vec3 at = vec3_sub(patch_turn(h->of, y), h->of->shape->origin);
    for (uint32_t f = 0; f < h->map->facets; f++)
        if (!(measure_facet(h->map, f, at) <= h->doubt)) return 1;
    return 0;
}

// The middle of the part of a segment that is in the hull, or the middle of the segment.
static vec3 cut_off(const hull_face *h, vec3 from, vec3 to) {
    double first = 0, last = 1;
    for (uint32_t f = 0; f < h->map->facets; f++) {
        const double a = measure_facet(h->map, f, from) - h->doubt, b = measure_facet(h->map, f, to) - h->doubt;
        if (a > 0 && b < 0) first = max2(first, a / (a - b));
        if (a < 0 && b > 0) last = min2(last, a / (a - b));
    }
    return vec3_add_scaled(from, vec3_sub(to, from), first < last ? 0.5 * (first + last) : 0.5);
}

// The nearest point of the face, which has some of the vertices as corners, to a point in its plane beside it: on a
// segment between two of these.
static vec3 find_nearest(const hull_face *h, vec3 y) {
    const ovoid_shape *s = h->of->shape;
    const double *v = shape_vertices(s);
    const double top = shape_find_extreme(s, h->n).value - h->doubt;
    double least = INFINITY;
    vec3 nearest = y;
    for (uint32_t i = 0; i < s->vertex_count; i++) {
        const vec3 a = vec3_at(v, i);
        for (uint32_t k = 0; k <= i && vec3_dot(h->n, a) >= top; k++) {
            const vec3 along = vec3_sub(vec3_at(v, k), a);
            if (vec3_dot(h->n, vec3_at(v, k)) < top) continue;
            const double square = vec3_norm_squared(along),
                         part = square > 0 ? vec3_dot(vec3_sub(y, a), along) / square : 0;
            const vec3 at = vec3_add_scaled(a, along, max2(0, min2(1, part)));
            const double off = vec3_norm_squared(vec3_sub(y, at));
            if (off < least) least = off, nearest = at;
        }
    }
    return nearest;
}

// A common point of the hull's face and the round body's face opposite, which is `value` away, if they have one; from
// the centre of the hull's core. A disc has it nearest to its centre.
static vec3 find_common(const hull_face *h, const edged_search *q, double value) {
    const vec3 w = {q->axis[0], q->axis[1], q->axis[2]}, center = {q->center[0], q->center[1], q->center[2]},
               opposite = vec3_add_scaled(center, h->n, value);
    const double t = vec3_dot(h->n, w);
    const vec3 off = patch_find_across(w, h->n, t, 1);
    const double across = vec3_norm(off);
    vec3 at = opposite;
    if (q->radius * across <= h->doubt && !(q->is_cone && t < 0)) {
        at = find_nearest(h, vec3_add_scaled(opposite, w, -copysign(q->height, t)));
    } else if (across > 0) {
        const vec3 rim = vec3_add_scaled(opposite, off, -q->radius / across);
        at =
            cut_off(h, vec3_add_scaled(rim, w, -q->height), vec3_add_scaled(q->is_cone ? opposite : rim, w, q->height));
    }
    return patch_turn_back(h->of, vec3_add(at, h->of->shape->origin));
}

// ---- both

// Both points from their centres; that of the body with edges is `between` more than the other one.
typedef struct edged_points {
    vec3 between, on_edged, on_round;
    double doubt;
} edged_points;

static void set_on_edged(edged_points *to, vec3 y) {
    to->on_edged = y;
    to->on_round = vec3_sub(y, to->between);
}

// Moves the points into the round body. The point of the body with edges may be beside it then.
static void move_into_round(const ovoid_swept_sphere *round, edged_points *to) {
    if (points_move_in(round, &to->on_round, to->doubt)) to->on_edged = vec3_add(to->between, to->on_round);
}

static int put_into_box(const ovoid_swept_sphere *box, const ovoid_swept_sphere *round, edged_points *to) {
    vec3 at = to->on_edged;
    if (points_move_in(box, &at, to->doubt)) set_on_edged(to, at);
    move_into_round(round, to);
    at = to->on_edged;
    return !points_move_in(box, &at, to->doubt);
}

static int put_into_hull(const hull_face *h, const edged_search *q, const ovoid_swept_sphere *round, edged_points *to) {
    move_into_round(round, to);
    if (!is_beside_hull(h, to->on_edged)) return 1;
    set_on_edged(to, find_common(h, q, q->value));
    move_into_round(round, to);
    return !is_beside_hull(h, to->on_edged);
}

int edged_set_points(const cores *p, const edged_search *q, const edged_direction *of, least_overlap *at) {
    const int is_edged_b = of->is_edged_b;
    const ovoid_swept_sphere *edged = is_edged_b ? p->b : p->a, *round = is_edged_b ? p->a : p->b;
    const vec3 n = of->n, center = is_edged_b ? vec3_neg(p->d) : p->d;
    at->of.n = is_edged_b ? vec3_neg(n) : n;
    const overlap_ends ends = cores_find_ends(p, at->of.n);
    const vec3 corner = is_edged_b ? ends.on_b : ends.on_a;
    at->value = vec3_dot(at->of.n, ends.v);
    const vec3 opposite = vec3_sub(vec3_add_scaled(corner, n, -at->value), center);
    edged_points to = {.between = vec3_add_scaled(center, n, at->value), .doubt = FRAME_REJECT * p->size};
    to.on_round = is_edged_b ? ends.on_a : ends.on_b;
    if (q->free == FREE_ROUND) to.on_round = opposite;
    if (q->free == FREE_BOTH)
        to.on_round = points_find_crossing(to.on_round, points_find_line(round, vec3_neg(n)), opposite, of->edge, n);
    to.on_edged = q->free == FREE_ROUND ? corner : vec3_add(to.between, to.on_round);
    const gauss_map *map = edged->core == OVOID_SWEPT_POINTS ? shape_get_gauss_map(edged->shape) : NULL;
    const hull_face h = {edged, map, patch_turn(edged, n), to.doubt};
    const int is_put = map ? put_into_hull(&h, q, round, &to) : put_into_box(edged, round, &to);
    at->on_a = is_edged_b ? to.on_round : to.on_edged;
    at->on_b = is_edged_b ? to.on_edged : to.on_round;
    return fabs(at->value - q->value) <= to.doubt && is_put;
}
