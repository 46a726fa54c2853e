// The excess of a hull, estimated by samples: points of its faces in proportion to their area, and points inside it;
// the farthest are then moved to where they are farther. The estimate is a lower bound, and only guides the cuts.
#include "base/allocator.h"
#include "base/error.h"
#include "decompose/piece.h"

#include <string.h>

enum { ON_FACES = 384, WITHIN = 128, CLIMB = 24, CLIMBS = 4 };

// Points of the unit square and cube, evenly spread, by the additive recurrence of M. Roberts, 2018: the powers of the
// root of x^4 = x + 1.
static double spread(uint32_t i, int k) {
    static const double steps[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    double x = 0.5 + steps[k] * i;
    return x - floor(x);
}

typedef struct sampling {
    const body *b;
    const hull *polytope;
    outlier *outliers; ///< room for OUTLIERS
    uint32_t count, hint;
    double excess, enough;
} sampling;

// Stores a point among the outliers, the farthest first.
static void keep(sampling *s, vec3 x, double distance) {
    s->excess = max2(s->excess, distance);
    if (!s->outliers || (s->count == OUTLIERS && distance <= s->outliers[OUTLIERS - 1].distance)) return;
    uint32_t at = s->count < OUTLIERS ? s->count++ : OUTLIERS - 1;
    for (; at > 0 && s->outliers[at - 1].distance < distance; at--) s->outliers[at] = s->outliers[at - 1];
    s->outliers[at] = (outlier){x, distance, s->hint};
}

// The distance of x from the solid; 0 inside, or if it is less than `least`.
static double measure(sampling *s, vec3 x, double least) {
    double distance;
    s->hint = body_find_triangle(s->b, x, s->hint, &distance);
    return distance > least && body_find_inside(s->b, x) == 0 ? distance : 0;
}

static vec3 get_corner(const hull *polytope, uint32_t triangle, int k) {
    return vec3_add(polytope->origin,
                    vec3_at(polytope->vertices, polytope->triangles[3 * (size_t)triangle + (size_t)k]));
}

static double compute_area_of(const hull *polytope, uint32_t t) {
    vec3 a = get_corner(polytope, t, 0), u = vec3_sub(get_corner(polytope, t, 1), a),
         v = vec3_sub(get_corner(polytope, t, 2), a);
    return vec3_norm(vec3_cross(u, v));
}

static vec3 get_on_face(const hull *polytope, uint32_t t, double u, double v) {
    if (u + v > 1) u = 1 - u, v = 1 - v;
    vec3 a = get_corner(polytope, t, 0);
    return vec3_add_scaled(vec3_add_scaled(a, vec3_sub(get_corner(polytope, t, 1), a), u),
                           vec3_sub(get_corner(polytope, t, 2), a), v);
}

// Samples faces at even steps of area; each point is also moved toward the middle to sample the inside.
static void sample_faces(sampling *s, vec3 middle) {
    double total = 0, sum = 0;
    for (uint32_t t = 0; t < s->polytope->triangle_count; t++) total += compute_area_of(s->polytope, t);
    uint32_t drawn = 0;
    for (uint32_t t = 0; t < s->polytope->triangle_count && s->excess <= s->enough; t++) {
        sum += compute_area_of(s->polytope, t);
        for (; drawn < ON_FACES && (drawn + 0.5) * total <= sum * ON_FACES; drawn++) {
            vec3 x = get_on_face(s->polytope, t, spread(drawn, 0), spread(drawn, 1));
            double d = measure(s, x, 0);
            if (d > 0) keep(s, x, d);
            if (drawn % (ON_FACES / WITHIN) != 0) continue;
            vec3 y = vec3_add_scaled(middle, vec3_sub(x, middle), cbrt(spread(drawn, 2)));
            d = measure(s, y, 0);
            if (d > 0) keep(s, y, d);
        }
    }
}

// 1 if the point is in the hull, to rounding.
static int is_in_hull(const hull *polytope, vec3 x) {
    vec3 y = vec3_sub(x, polytope->origin);
    for (uint32_t f = 0; f < polytope->facet_count; f++)
        if (vec3_dot(polytope->planes[f].normal, y) > polytope->planes[f].offset + 1e-12) return 0;
    return 1;
}

// Improves a point by shorter and shorter steps along the axes.
static void climb(sampling *s, vec3 at, double best, double step) {
    for (int round = 0; round < CLIMB; round++) {
        int is_better = 0;
        for (int k = 0; k < 6; k++) {
            double d[3] = {0, 0, 0};
            d[k / 2] = k % 2 ? step : -step;
            vec3 x = vec3_add(at, (vec3){d[0], d[1], d[2]});
            if (!is_in_hull(s->polytope, x)) continue;
            double distance = measure(s, x, best);
            if (distance > best) best = distance, at = x, is_better = 1;
        }
        if (!is_better) step *= 0.5;
    }
    keep(s, at, best);
}

// Improves the farthest points that are not near each other.
static void climb_all(sampling *s, double step) {
    outlier starts[CLIMBS];
    uint32_t count = 0;
    for (uint32_t i = 0; i < s->count && count < CLIMBS; i++) {
        double least = INFINITY;
        for (uint32_t k = 0; k < count; k++)
            least = min2(least, vec3_norm_squared(vec3_sub(s->outliers[i].point, starts[k].point)));
        if (least > 4 * step * step) starts[count++] = s->outliers[i];
    }
    for (uint32_t i = 0; i < count; i++) climb(s, starts[i].point, starts[i].distance, step);
}

static ovoid_code estimate(sampling *s, const vec3 *points, uint32_t count, ovoid_error *error) {
    hull polytope;
    ovoid_code code = hull_create((xyz_points){&points[0].x, count}, &s->b->memory, &polytope, error);
    if (code != OVOID_OK) return code;
    s->polytope = &polytope;
    box around = box_make_around(&points[0].x, count);
    vec3 sum = {0, 0, 0};
    for (uint32_t i = 0; i < count; i++) sum = vec3_add(sum, points[i]);
    sample_faces(s, vec3_scale(sum, 1.0 / count));
    // The planes of a flat hull do not bound it, so only its faces are sampled.
    if (s->excess <= s->enough && polytope.rank == 3) climb_all(s, 0.1 * vec3_norm(vec3_sub(around.max, around.min)));
    hull_destroy(&polytope, &s->b->memory);
    s->polytope = NULL;
    return OVOID_OK;
}

ovoid_code piece_estimate(const body *b, piece *p, ovoid_error *error) {
    sampling s = {.b = b, .outliers = p->outliers, .enough = INFINITY};
    ovoid_code code = estimate(&s, p->points, p->point_count, error);
    p->outlier_count = s.count;
    p->excess = s.excess;
    return code;
}

ovoid_code points_estimate(const body *b, const estimated_points *of, double *excess, ovoid_error *error) {
    outlier kept[OUTLIERS];
    sampling s = {.b = b, .outliers = kept, .enough = of->enough};
    ovoid_code code = estimate(&s, of->points, of->count, error);
    *excess = s.excess;
    return code;
}
