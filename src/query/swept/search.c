// GJK (E. G. Gilbert, D. W. Johnson, S. S. Keerthi, A fast procedure for computing the distance between complex objects
// in three-dimensional space, 1988) over supports of the true cores, in the world's axes: no polyhedron stands for a
// round body, and no corner has a number. Each step is the kernel of simd/corner.h; where that is in doubt, the robust
// one of pair/simplex.h.
//
// Errors, as in swept.c: a support point is one of its core to 60 u s, and no point of the core is farther along the
// unit direction by more than that; the weights of a nearest point are off by a few u.
#include "query/swept/search.h"

#include "base/compiler.h"
#include "pair/simplex.h"
#include "query/swept/patch.h"
#include "simd/corner.h"
#include "simd/support.h"

enum { SEARCH_STEPS = 60, IDLE_STEPS = 3 };

// Differences of points of the cores, and A's points of these. Those whose bit in `valid` is set count.
typedef struct corners {
    corner_lanes at;
    vec3 on_a[4];
    unsigned valid;
} corners;

// A direction of any length, the square of that and one over it, and how far along it the simplex's nearest point lies.
typedef struct heading {
    vec3 n;
    double square, scale, distance;
} heading;

// ---- supports

// The most points of a hull that a search turns before it begins; of more it turns the direction in each step.
enum { MOST_TURNED = 32 };

// The points of a hull turned into the world's axes, from its centre, or none.
typedef struct turned_points {
    double x[MOST_TURNED], y[MOST_TURNED], z[MOST_TURNED];
    uint32_t padded_count; ///< as of simd_points
} turned_points;

static void turn_points(const ovoid_swept_sphere *s, turned_points *to) {
    to->padded_count = 0;
    if (s->core != OVOID_SWEPT_POINTS || s->count > MOST_TURNED) return;
    to->padded_count = (s->count + 7) & ~7u;
    for (uint32_t i = 0; i < to->padded_count; i++) {
        vec3 v = patch_turn_back(s, vec3_at(s->points, i < s->count ? i : 0));
        to->x[i] = v.x, to->y[i] = v.y, to->z[i] = v.z;
    }
}

// patch_find_end; of a hull whose points are turned by these.
COMPILER_INLINED vec3 find_end(const ovoid_swept_sphere *s, const turned_points *turned, vec3 n, double square) {
    if (turned->padded_count == 0) return patch_find_end(s, n, square);
    const simd_points points = {turned->x, turned->y, turned->z, turned->padded_count};
    uint32_t i = simd_find_support(&points, &n).index;
    return (vec3){turned->x[i], turned->y[i], turned->z[i]};
}

// ---- the simplex

static void set_corner(corners *c, vec3 w, vec3 on_a) {
    int i = __builtin_ctz(~c->valid);
    c->at.x[i] = w.x, c->at.y[i] = w.y, c->at.z[i] = w.z;
    c->on_a[i] = on_a;
    c->valid |= 1u << i;
}

static void get_simplex(const corners *c, simplex *points) {
    points->count = 0;
    for (uint32_t i = 0; i < 4; i++)
        if (c->valid >> i & 1) points->p[points->count++] = (difference){{c->at.x[i], c->at.y[i], c->at.z[i]}, i, i};
}

// The nearest point and A's point of it, by the weights.
static void set_points(const corners *c, const simplex *points, nearest_pair *found) {
    found->difference = simplex_compute_point(points);
    found->point_a = (vec3){0, 0, 0};
    for (int i = 0; i < points->count; i++)
        found->point_a = vec3_add_scaled(found->point_a, c->on_a[points->p[i].a], points->weight[i]);
}

// The kernel reads three lanes: the corner of the fourth goes to a free one.
static void leave_last_lane(corners *c) {
    if (!(c->valid & 8)) return;
    vec3 w = {c->at.x[3], c->at.y[3], c->at.z[3]}, on_a = c->on_a[3];
    c->valid &= 7;
    set_corner(c, w, on_a);
}

// The robust step: 0 if the simplex holds the origin, to rounding.
static int reduce(corners *c, heading *to) {
    simplex points;
    get_simplex(c, &points);
    to->n = simplex_reduce(&points);
    to->square = vec3_norm_squared(to->n);
    to->scale = 1 / sqrt(to->square);
    c->valid = 0;
    for (int i = 0; i < points.count; i++) c->valid |= 1u << points.p[i].a;
    leave_last_lane(c);
    to->distance = vec3_norm(simplex_compute_point(&points));
    return to->square > 0.5;
}

// 1 if the origin is behind all faces of the tetrahedron, by more than `claim`: each face's height is the volume over
// the area, of which the product of two edges is more.
static int is_inside(const corners *c, double claim) {
    static const int faces[4][4] = {{1, 2, 3, 0}, {0, 2, 3, 1}, {0, 1, 3, 2}, {0, 1, 2, 3}};
    simplex all;
    get_simplex(c, &all);
    if (all.count < 4) return 0;
    for (int f = 0; f < 4; f++) {
        vec3 a = all.p[faces[f][0]].w, e1 = vec3_sub(all.p[faces[f][1]].w, a), e2 = vec3_sub(all.p[faces[f][2]].w, a);
        vec3 n = vec3_cross(e1, e2);
        double origin = -vec3_dot(n, a), corner = vec3_dot(n, vec3_sub(all.p[faces[f][3]].w, a));
        double least = 2 * claim * claim * (vec3_norm_squared(e1) * vec3_norm_squared(e2));
        if (!(origin * corner > 0 && origin * origin > least)) return 0;
    }
    return 1;
}

static swept_end end_inside(const corners *c, double claim, nearest_pair *found) {
    simplex points;
    if (!is_inside(c, claim)) return SWEPT_OPEN;
    get_simplex(c, &points);
    simplex_compute_inside_weights(&points);
    set_points(c, &points, found);
    found->difference = (vec3){0, 0, 0};
    return SWEPT_INSIDE;
}

typedef enum step_result { STEP_ON, STEP_INSIDE, STEP_FLAT } step_result;

// The step to the new corner.
static inline step_result step(corners *c, vec3 w, vec3 on_a, heading *to) {
    corner_step next = simd_step_from_corner(&c->at, c->valid, &w);
    if (next.is_inside | next.is_sliver | !(next.square > 1e-200 && next.square < 1e200)) {
        set_corner(c, w, on_a);
        if (next.is_inside) return STEP_INSIDE;
        return reduce(c, to) ? STEP_ON : STEP_FLAT;
    }
    c->valid = next.kept;
    set_corner(c, w, on_a);
    to->n = (vec3){next.x, next.y, next.z};
    to->square = next.square;
    to->scale = 1 / sqrt(next.square);
    to->distance = vec3_dot(to->n, w) * to->scale;
    return STEP_ON;
}

// Sets the points and returns their distance.
static double finish(const corners *c, nearest_pair *found) {
    simplex points;
    get_simplex(c, &points);
    simplex_compute_weights(&points);
    set_points(c, &points, found);
    return vec3_norm(found->difference);
}

static inline int is_answered(const swept_search *query, double distance, double gap) {
    return distance - gap <= (distance > query->radii ? query->tolerance : query->fine) || distance < query->within;
}

swept_end swept_find_nearest(const swept_search *query, nearest_pair *found) {
    // The lanes that are not valid have to be finite.
    corners c = {.valid = 0};
    turned_points of_a, of_b;
    turn_points(query->a, &of_a);
    turn_points(query->b, &of_b);
    double square = vec3_norm_squared(query->first);
    heading to = {query->first, square, 1 / sqrt(square), vec3_norm(query->start)};
    double least = INFINITY, best = -INFINITY;
    int idle = 0;
    set_corner(&c, query->start, query->on_a);
    for (int k = 0; k < SEARCH_STEPS; k++) {
        vec3 on_a = find_end(query->a, &of_a, to.n, to.square),
             on_b = find_end(query->b, &of_b, vec3_neg(to.n), to.square);
        vec3 w = vec3_sub(vec3_add(query->d, on_b), on_a);
        double gap = vec3_dot(to.n, w) * to.scale;
        found->gap = gap;
        found->normal = vec3_scale(to.n, to.scale);
        if (gap > query->beyond) return SWEPT_BEYOND;
        if (is_answered(query, to.distance, gap) && is_answered(query, finish(&c, found), gap)) return SWEPT_NEAREST;
        idle = to.distance < least || gap > best ? 0 : idle + 1;
        if (idle > IDLE_STEPS) return SWEPT_OPEN;
        least = min2(least, to.distance);
        best = max2(best, gap);
        step_result result = step(&c, w, on_a, &to);
        if (result == STEP_INSIDE) return end_inside(&c, query->claim, found);
        if (result == STEP_FLAT) return SWEPT_OPEN;
    }
    return SWEPT_OPEN;
}
