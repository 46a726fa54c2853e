// What all queries of two swept spheres have in common: the pair, its size, the verdict, and the way from a core to a
// point.
#ifndef OVOID_QUERY_SWEPT_PAIR_H
#define OVOID_QUERY_SWEPT_PAIR_H

#include "base/compiler.h"
#include "linear/nearest.h"
#include "ovoid/swept.h"
#include "pair/reject.h"

// Lengths whose squares of squares are in the range of doubles.
#define LEAST 1e-50
#define MOST 1e50
// The width of a bracket that answers, as a part of the size.
#define TOLERANCE 1e-12
#define TOLERANCE_OF_SEARCH 1e-9

typedef ovoid_swept_sphere swept;

// What is asked for beside the sign: as bits, the distance of bodies that are apart, and the depth of those that
// overlap.
typedef enum swept_question { OF_SIGN, OF_DISTANCE, OF_CONTACT, OF_BOTH } swept_question;

// Two bodies: centres d apart, A's to B's.
typedef struct swept_placed {
    const swept *a, *b;
    vec3 d;
    double distance, reach, radii; ///< of the centres; sums of both bodies
    double far;                    ///< two points of the cores are no farther apart
    double size, claim;
} swept_placed;

static const ovoid_verdict swept_undecided = {OVOID_UNDECIDED, OVOID_STAGE_SUPPORT, OVOID_LIMIT_PRECISION, 0, -INFINITY,
                                              INFINITY};

// Zero, or NaN if a number is not finite.
static inline double swept_show_finite(vec3 v) { return ((v.x - v.x) + (v.y - v.y)) + (v.z - v.z); }

static inline double find_reach_of_points(const swept *s) {
    double most = 0, zero = swept_show_finite((vec3){s->half[0], s->half[1], s->half[2]});
    for (size_t i = 0; i < s->count; i++) {
        const vec3 at = vec3_at(s->points, i);
        most = max2(vec3_norm_squared(at), most);
        zero += swept_show_finite(at);
    }
    return sqrt(most) + zero;
}

// How far a core reaches from its centre; NaN if a number is not finite or a length is below 0.
static inline double swept_find_reach(const swept *s) {
    const double *h = s->half;
    if (s->core == OVOID_SWEPT_POINTS) return find_reach_of_points(s);
    if (s->core == OVOID_SWEPT_POINT) return 0;
    if (s->core == OVOID_SWEPT_SEGMENT) return h[0] < 0 ? NAN : h[0];
    double least = min2(h[0], h[1]);
    if (s->core == OVOID_SWEPT_ELLIPSOID)
        return min2(least, h[2]) < 0 ? NAN : max2(h[0], max2(h[1], h[2])) + swept_show_finite((vec3){h[0], h[1], h[2]});
    double square = h[0] * h[0] + h[1] * h[1];
    if (s->core == OVOID_SWEPT_BOX) {
        square += h[2] * h[2];
        least = min2(least, h[2]);
    }
    return least < 0 ? NAN : sqrt(square);
}

static inline swept_placed swept_place(const swept *a, const swept *b) {
    swept_placed p = {.a = a, .b = b, .d = vec3_sub(b->center, a->center)};
    p.distance = vec3_norm(p.d);
    double reach_a = swept_find_reach(a), reach_b = swept_find_reach(b);
    p.reach = reach_a + reach_b;
    // The centre of a hull may be beside it.
    p.far = p.distance + (a->core == OVOID_SWEPT_POINTS ? reach_a : 0) + (b->core == OVOID_SWEPT_POINTS ? reach_b : 0);
    p.radii = a->radius + b->radius;
    p.size = p.distance + p.reach + p.radii;
    p.claim = FRAME_REJECT * p.size;
    return p;
}

// Not so of NaN.
static inline int swept_is_moderate(const swept_placed *p) {
    return (p->size > LEAST) & (p->size < MOST) & (p->a->radius >= 0) & (p->b->radius >= 0);
}

static inline ovoid_verdict swept_make_verdict(double lower, double upper, double tolerance) {
    ovoid_status status = lower > 0                    ? OVOID_SEPARATED
                          : upper < 0                  ? OVOID_OVERLAPPING
                          : upper - lower <= tolerance ? OVOID_TOUCHING
                                                       : OVOID_UNDECIDED;
    return (ovoid_verdict){status, OVOID_STAGE_SUPPORT, OVOID_LIMIT_NONE, 0, lower, upper};
}

// No zero is negative, as in all witnesses.
static inline void swept_write_witness(const swept_placed *p, const nearest_pair *found, vec3 along,
                                       ovoid_witness *to) {
    vec3 a = vec3_add(p->a->center, found->point_a), b = vec3_add(a, found->difference);
    to->point_a = vec3_clear_signs(vec3_add_scaled(a, along, p->a->radius));
    to->point_b = vec3_clear_signs(vec3_add_scaled(b, along, -p->b->radius));
    to->normal = vec3_clear_signs(found->normal);
}

// The verdict by the gap and the distance of two points of the cores.
static inline ovoid_verdict swept_conclude(const swept_placed *p, swept_question asked, const nearest_pair *found,
                                           double distance, double tolerance) {
    ovoid_verdict v = swept_make_verdict(found->gap - p->radii - p->claim, distance - p->radii + p->claim, tolerance);
    unsigned wanted = v.status == OVOID_SEPARATED ? OF_DISTANCE : v.status == OVOID_OVERLAPPING ? OF_CONTACT : OF_BOTH;
    return asked & wanted && !(v.upper - v.lower <= tolerance) ? swept_undecided : v;
}

// The verdict with its witness.
static inline ovoid_verdict swept_answer(const swept_placed *p, swept_question asked, const nearest_pair *found,
                                         double tolerance, ovoid_witness *witness) {
    double distance = vec3_norm(found->difference);
    ovoid_verdict v = swept_conclude(p, asked, found, distance, tolerance);
    if (witness && v.status != OVOID_UNDECIDED)
        swept_write_witness(p, found, nearest_find_direction(found, distance, p->radii), witness);
    return v;
}

// A point of the core, from its centre: that itself, but of a hull.
static inline vec3 swept_find_middle(const swept *s) {
    const double *h = s->half;
    if (s->core != OVOID_SWEPT_POINTS) return (vec3){0, 0, 0};
    return vec3_add_scaled(vec3_add_scaled(vec3_scale(s->axis[0], h[0]), s->axis[1], h[1]), s->axis[2], h[2]);
}

// ---- the way from a core to a point

// A point y from the centre of a core: the vector to it from the nearest point of the core; or of a point in the core a
// unit normal of its surface where that is nearest, and how far it is.
typedef struct swept_way_out {
    int is_inside;
    vec3 off;
    double depth;    ///< 0 of a point that is not in the core
    double distance; ///< the length of the vector; 0 inside
} swept_way_out;

static inline swept_way_out make_way(vec3 off) { return (swept_way_out){0, off, 0, vec3_norm(off)}; }

static inline swept_way_out leave_segment(const swept *core, vec3 y) {
    double along = vec3_dot(core->axis[0], y), h = core->half[0];
    return make_way(vec3_add_scaled(y, core->axis[0], -max2(-h, min2(h, along))));
}

static inline swept_way_out leave_box(const swept *core, vec3 y) {
    swept_way_out out = {1, {0, 0, 0}, INFINITY, 0};
    double along[3], excess[3];
    for (int i = 0; i < 3; i++) {
        double h = core->half[i];
        along[i] = vec3_dot(core->axis[i], y);
        excess[i] = along[i] - max2(-h, min2(h, along[i]));
    }
    if ((fabs(excess[0]) > 0) | (fabs(excess[1]) > 0) | (fabs(excess[2]) > 0)) {
        vec3 off = vec3_add_scaled(vec3_scale(core->axis[0], excess[0]), core->axis[1], excess[1]);
        double square = (excess[0] * excess[0] + excess[1] * excess[1]) + excess[2] * excess[2];
        return (swept_way_out){0, vec3_add_scaled(off, core->axis[2], excess[2]), 0, sqrt(square)};
    }
    for (int i = 0; i < 3; i++) {
        double left = core->half[i] - fabs(along[i]);
        if (!(left < out.depth)) continue;
        out.depth = left;
        out.off = along[i] < 0 ? vec3_neg(core->axis[i]) : core->axis[i];
    }
    return out;
}

// A point beside an axis: its coordinate along the axis, its distance from it, and the unit vector that it is off.
typedef struct beside_axis {
    double z, r;
    vec3 away;
} beside_axis;

static inline beside_axis find_beside_axis(vec3 axis, vec3 y) {
    double z = vec3_dot(axis, y);
    vec3 off = vec3_add_scaled(y, axis, -z);
    double r = vec3_norm(off);
    return (beside_axis){z, r, vec3_scale(off, r > 0 ? 1 / r : 0)};
}

// By r and z outward. Inside, a direction from the axis that has no digits is not taken: the depth is none.
static inline swept_way_out make_way_out(const swept *core, const beside_axis *at, int is_inside, double r, double z,
                                         double depth) {
    vec3 off = vec3_add_scaled(vec3_scale(at->away, r), core->axis[0], z);
    int is_vague = is_inside && fabs(r) > 0 && !(at->r > 0x1p-20 * core->half[1]);
    return (swept_way_out){is_inside && !is_vague, is_vague ? (vec3){0, 0, 0} : off, depth,
                           is_inside ? 0 : sqrt(r * r + z * z)};
}

static inline swept_way_out leave_cylinder(const swept *core, vec3 y) {
    beside_axis at = find_beside_axis(core->axis[0], y);
    double r = at.r - core->half[1], z = fabs(at.z) - core->half[0], side = at.z < 0 ? -1 : 1;
    if (r <= 0 && z <= 0) return make_way_out(core, &at, 1, z > r ? 0 : 1, z > r ? side : 0, -max2(r, z));
    return make_way_out(core, &at, 0, max2(0, r), side * max2(0, z), 0);
}

// In the plane of the axis and the point: the slant goes from the rim (R, -h) to the apex (0, h), the base to the rim.
static inline swept_way_out leave_cone(const swept *core, vec3 y) {
    beside_axis at = find_beside_axis(core->axis[0], y);
    double h = core->half[0], R = core->half[1], squared = R * R + 4 * h * h, scale = 1 / sqrt(squared);
    double slant = (2 * h * at.r + R * (at.z - h)) * scale, base = -h - at.z;
    if (slant <= 0 && base <= 0) {
        int is_slant = slant > base;
        return make_way_out(core, &at, 1, is_slant ? 2 * h * scale : 0, is_slant ? R * scale : -1, -max2(slant, base));
    }
    double t = max2(0, min2(1, (R * (R - at.r) + 2 * h * (at.z + h)) / squared));
    double r = at.r - R * (1 - t), z = at.z + h - 2 * h * t, r_base = at.r - min2(at.r, R), z_base = at.z + h;
    int is_slant = r * r + z * z < r_base * r_base + z_base * z_base;
    return make_way_out(core, &at, 0, is_slant ? r : r_base, is_slant ? z : z_base, 0);
}

COMPILER_INLINED swept_way_out swept_leave_core(const swept *core, vec3 y) {
    switch (core->core) {
    case OVOID_SWEPT_POINT: return make_way(y);
    case OVOID_SWEPT_SEGMENT: return leave_segment(core, y);
    case OVOID_SWEPT_BOX: return leave_box(core, y);
    case OVOID_SWEPT_CYLINDER: return leave_cylinder(core, y);
    default: return leave_cone(core, y);
    }
}

#endif
