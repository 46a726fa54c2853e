// Swept spheres without a closed form. The centre of one body has a nearest point of the other one's core, and that a
// nearest point of the first core: these show most overlaps, and most other pairs' search (query/swept/search.h) starts
// near its end.
#include "query/swept/approach.h"

#include "query/swept/overlap.h"
#include "query/swept/search.h"

// A length that is within the core from its centre in all directions.
static inline double find_inner_reach(const swept *s) {
    const double *h = s->half;
    switch (s->core) {
    case OVOID_SWEPT_CYLINDER: return min2(h[0], h[1]);
    case OVOID_SWEPT_CONE: return h[0] * h[1] / (2 * h[0] + h[1]);
    case OVOID_SWEPT_BOX:
    case OVOID_SWEPT_ELLIPSOID: return min2(h[0], min2(h[1], h[2]));
    default: return 0;
    }
}

// The way from the ellipsoid's point on the line from its centre to y; of a point inside a depth that is less than its
// own. A point whose square is less than (1 - e)^2 is inside by e times the least half axis; what the square is off by
// is a sixth of a claim over that.
static inline swept_way_out leave_ellipsoid(const swept *core, vec3 y, double claim) {
    const double *h = core->half;
    vec3 t = {vec3_dot(core->axis[0], y) / h[0], vec3_dot(core->axis[1], y) / h[1], vec3_dot(core->axis[2], y) / h[2]};
    double square = vec3_norm_squared(t);
    if (square < 1 - 8 * (claim / min2(h[0], min2(h[1], h[2])))) return (swept_way_out){1, {0, 0, 0}, 3 * claim, 0};
    return make_way(vec3_scale(y, 1 - 1 / sqrt(square)));
}

static ovoid_verdict answer_overlap(const swept_placed *p, vec3 common, vec3 normal, ovoid_witness *witness) {
    if (witness) {
        witness->point_a = witness->point_b = vec3_clear_signs(common);
        witness->normal = vec3_clear_signs(normal);
    }
    return swept_make_verdict(-p->size, -p->claim, 0);
}

// What is known of two cores X and Y: the nearest point of X to Y's centre, and the nearest point of Y to that.
typedef struct approach {
    const swept *x, *y;
    int is_x_b;
    double gap;   ///< of Y's centre from X, below zero inside
    double after; ///< of X's point from Y, below zero inside
    vec3 on_x;    ///< from X's centre
    vec3 back;    ///< from there to Y's point
} approach;

// Is the way to a core its distance? That to an ellipsoid and a hull is longer.
static inline int is_measured(const swept *s) { return s->core < OVOID_SWEPT_ELLIPSOID; }

// How far a point is from a core, or more, and below zero inside. *off: the way to it, zero inside.
static inline double measure_way(const swept *core, const vec3 *point, double claim, vec3 *off) {
    vec3 y = *point;
    swept_way_out out = core->core == OVOID_SWEPT_POINTS      ? make_way(vec3_sub(y, swept_find_middle(core)))
                        : core->core == OVOID_SWEPT_ELLIPSOID ? leave_ellipsoid(core, y, claim)
                                                              : swept_leave_core(core, y);
    if (!(out.is_inside || out.depth > 0)) {
        *off = out.off;
        return out.distance;
    }
    *off = (vec3){0, 0, 0};
    return -out.depth;
}

static inline approach find_approach(const swept_placed *p, int is_x_b) {
    approach to = {.x = is_x_b ? p->b : p->a, .y = is_x_b ? p->a : p->b, .is_x_b = is_x_b};
    vec3 middle = swept_find_middle(to.y), way = vec3_add(is_x_b ? vec3_neg(p->d) : p->d, middle), off, next, from_y;
    to.gap = measure_way(to.x, &way, p->claim, &off);
    to.on_x = vec3_sub(way, off);
    from_y = vec3_sub(middle, off);
    to.after = measure_way(to.y, &from_y, p->claim, &next);
    to.back = vec3_neg(next);
    return to;
}

// 1 if the bodies are seen to overlap: then *common is a point of both.
static inline int is_overlap(const swept_placed *p, const approach *at, vec3 *common) {
    double radius = at->x->radius, doubt = 2 * p->claim;
    *common = vec3_add(at->x->center, at->on_x);
    if (at->gap - find_inner_reach(at->y) < -doubt) return 1;
    if (!(at->after - p->radii < -doubt)) return 0;
    *common = vec3_add_scaled(*common, at->back, at->after > radius ? radius / at->after : at->after > 0);
    return 1;
}

// The search that goes on from there.
static inline swept_search make_search(const swept_placed *p, const approach *at, swept_question asked,
                                       double tolerance) {
    swept_search query = {.a = p->a,
                          .b = p->b,
                          .d = p->d,
                          .on_a = at->is_x_b ? vec3_add(vec3_add(p->d, at->on_x), at->back) : at->on_x,
                          .start = at->is_x_b ? vec3_neg(at->back) : at->back,
                          .beyond = asked & OF_DISTANCE ? INFINITY : p->radii + p->claim,
                          .within = asked & OF_CONTACT ? -INFINITY : p->radii - p->claim,
                          .tolerance = tolerance - 2 * p->claim,
                          .radii = p->radii,
                          .fine = TOLERANCE * p->size - 2 * p->claim,
                          .claim = 2 * p->claim};
    // Points that are one to rounding have no direction: those at the centres have.
    if (!(at->after > 0x1p-40 * p->size)) {
        query.on_a = swept_find_middle(p->a);
        query.start = vec3_sub(vec3_add(p->d, swept_find_middle(p->b)), query.on_a);
    }
    query.first = query.start;
    return query;
}

ovoid_verdict swept_approach(const swept_placed *p, swept_question asked, ovoid_witness *witness) {
    double tolerance = TOLERANCE_OF_SEARCH * p->size;
    approach at = find_approach(p, !is_measured(p->a));
    if (!(asked & OF_DISTANCE) && is_measured(at.x) && at.y->core != OVOID_SWEPT_POINTS) {
        double gap = at.gap - swept_find_reach(at.y) - p->radii;
        if (gap > p->claim) return swept_make_verdict(gap - p->claim, p->far - p->radii + p->claim, 0);
    }
    vec3 common;
    if (!(asked & OF_CONTACT) && is_overlap(p, &at, &common)) {
        vec3 n = vec3_unit(p->d);
        return answer_overlap(p, common, vec3_norm_squared(n) > 0.5 ? n : (vec3){1, 0, 0}, witness);
    }
    if (asked & OF_CONTACT && min2(at.gap, at.after) < -p->claim) return swept_measure_overlap(p, witness);
    const swept_search query = make_search(p, &at, asked, tolerance);
    nearest_pair found;
    if (!(vec3_norm_squared(query.start) > LEAST * LEAST)) return swept_undecided;
    switch (swept_find_nearest(&query, &found)) {
    case SWEPT_BEYOND:
        return swept_make_verdict(found.gap - p->radii - p->claim, p->far - p->radii + p->claim, tolerance);
    case SWEPT_INSIDE:
        if (asked & OF_CONTACT) return swept_measure_overlap(p, witness);
        return answer_overlap(p, vec3_add(p->a->center, found.point_a), found.normal, witness);
    case SWEPT_NEAREST: return swept_answer(p, asked, &found, tolerance, witness);
    // Of bodies that lie in a plane with their centres no simplex is around the origin, though they may overlap. That
    // has no common point, which a distance wants, and a depth has an answer only where a distance has one.
    default: return asked == OF_CONTACT ? swept_measure_overlap(p, witness) : swept_undecided;
    }
}
