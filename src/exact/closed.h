// Points, segments and boxes among one another, in closed form: with their radii, spheres, capsules and rounded boxes.
// No search, no support, and no earlier proof: the same pair has the same answer whatever was asked before.
//
// Errors (docs/error-analysis.md): as in reject.h, FRAME_REJECT.
#ifndef OVOID_EXACT_CLOSED_H
#define OVOID_EXACT_CLOSED_H

#include "exact/small.h"
#include "linear/nearest.h"

/// 1 for a point, a segment, or a body of eight vertices, which may be a box.
static inline int closed_may_take(const ovoid_shape *s) {
    return (s->vertex_count <= 2) | (s->vertex_count == 8 && s->box.is_right);
}

/// 1 if the pair is one for closed_run: no allowance, and at most one box.
static inline int closed_fits(const ovoid_shape *a, const ovoid_shape *b) {
    int is_thin = (a->vertex_count <= 2) | (b->vertex_count <= 2);
    return is_thin && !(a->has_allowance | b->has_allowance) && closed_may_take(a) && closed_may_take(b);
}

/// Of a point or a segment: its middle, and half of it, from there to vertex 1; of a point zero.
static inline vec3 closed_get_middle(const ovoid_shape *s) {
    return s->vertex_count == 1 ? s->first : vec3_scale(vec3_add(s->first, vec3_at(shape_vertices(s), 1)), 0.5);
}
static inline vec3 closed_get_half(const ovoid_shape *s) {
    if (s->vertex_count == 1) return (vec3){0, 0, 0};
    return vec3_scale(vec3_sub(vec3_at(shape_vertices(s), 1), s->first), 0.5);
}

/// 1 for the origin of the body frame, with a radius: no rotation changes it.
static inline int closed_is_origin(const ovoid_shape *s) { return (s->vertex_count == 1) & !(s->extent > 0); }

/// The squares of squares of lengths are in the range of doubles.
static inline int closed_is_moderate(const pair_frame *f) { return f->size > 0x1p-200 && f->size < 0x1p200; }

/// 1 if the bounds answer the query; a depth whose sign is known is as good as a distance.
static inline int closed_is_answered(const query_goal *goal, double lower, double upper) {
    if (!goal->wants_depth) return query_goal_is_met(goal, lower, upper);
    if (lower > goal->far) return 1;
    return (lower > 0 || upper < 0) && upper - lower <= goal->tolerance;
}

/// Sets the bounds, from the gap and the distance of the cores, and what all closed forms have in common. 1 if the
/// bounds answer the query.
static inline int closed_set_bounds(const placed_query *query, double gap, double distance, small_end *end) {
    const pair_frame *f = query->frame;
    double claim = reject_get_claim(f);
    end->lower = gap - f->lower_radii - claim;
    end->upper = distance - f->upper_radii + claim;
    end->kind = OVOID_PROOF_POINTS;
    end->stage = OVOID_STAGE_SUPPORT;
    end->iterations = 0;
    return closed_is_answered(query->goal, end->lower, end->upper);
}

/// The points of the cores, in the world, and the unit vector along which the radii go.
typedef struct closed_cores {
    vec3 a, b, n;
} closed_cores;

/// Sets the witness. No zero is negative: its sign would depend on the rotations.
static inline void closed_set_witness(const pair_frame *f, const closed_cores *cores, small_end *end) {
    end->has_witness = 1;
    end->point_a = vec3_clear_signs(vec3_add_scaled(cores->a, cores->n, f->a->radius));
    end->point_b = vec3_clear_signs(vec3_add_scaled(cores->b, cores->n, -f->b->radius));
}

/// 1 for two bodies that no rotation changes.
static inline int closed_are_origins(const ovoid_shape *a, const ovoid_shape *b) {
    return closed_is_origin(a) && closed_is_origin(b) && !(a->has_allowance | b->has_allowance);
}

/// closed_run of two such bodies, bare; of the frame the rotations are not read.
static inline int closed_run_origins(const placed_query *query, small_end *end) {
    const pair_frame *f = query->frame;
    if (!closed_is_moderate(f)) return 0;
    nearest_points points = nearest_find_points(f->offset);
    if (!closed_set_bounds(query, points.gap, points.distance, end)) return 0;
    end->normal = vec3_clear_signs(points.normal);
    // The difference's direction is the normal.
    closed_set_witness(f, &(closed_cores){f->world_origin, vec3_add(f->world_origin, f->offset), points.normal}, end);
    return 1;
}

/// The answer to the query, of a pair that fits: 1. 0: the sign is within rounding, or the depth of a box that a point
/// or a segment enters is asked for, and nothing is known. The frame needs only frame_place.
int closed_run(const placed_query *query, small_end *end);

#endif
