// From a pair in the world to the kernel of small bodies, and from its corners to bounds.
#include "exact/small.h"

#include "exact/boxes.h"
#include "exact/kept.h"
#include "linear/both.h"
#include "pair/hull.h"
#include "pair/inner.h"
#include "pair/proof.h"
#include "pair/reject.h"

static vec3 get_lane(const small_gjk_result *r, int i) { return (vec3){r->at.x[i], r->at.y[i], r->at.z[i]}; }

static void get_tetrahedron(const small_gjk_result *r, simplex *points) {
    for (int i = 0; i < 4; i++) {
        points->p[i].a = r->a[i];
        points->p[i].b = r->b[i];
    }
    points->count = 4;
}

// The corners of lanes 0 to 2 that are valid, in their order, without a branch on which they are. Those that do not
// count repeat one of them, with indices of zero.
static void get_corners(const small_gjk_result *r, simplex *points) {
    static const uint8_t lanes[8][4] = {{0, 0, 0, 0}, {0, 0, 0, 1}, {1, 1, 1, 1}, {0, 1, 0, 2},
                                        {2, 2, 2, 1}, {0, 2, 0, 2}, {1, 2, 1, 2}, {0, 1, 2, 3}};
    const uint8_t *lane = lanes[r->valid & 7];
    points->count = lane[3];
    for (int i = 0; i < 3; i++) {
        uint32_t counts = -(uint32_t)(i < points->count);
        points->p[i] = (difference){get_lane(r, lane[i]), r->a[lane[i]] & counts, r->b[lane[i]] & counts};
    }
    points->p[3].a = points->p[3].b = 0;
}

// One to three corners that were kept, with their weights: all but the differences, which no one asks for.
static void get_kept_corners(const small_gjk_result *r, simplex *points) {
    points->count = r->valid == 1 ? 1 : r->valid == 3 ? 2 : 3;
    for (int i = 0; i < 3; i++) {
        points->p[i].a = r->a[i];
        points->p[i].b = r->b[i];
    }
    points->p[3].a = points->p[3].b = 0;
    both_store(points->weight, both_make(r->weight[0], r->weight[1]));
    both_store(points->weight + 2, both_make(r->weight[2], 0));
}

// The distance of the nearest point of corners that get_corners gave; those that do not count have no weight.
static double find_distance(simplex *points) {
    simplex_compute_weights(points);
    const double *w = points->weight;
    vec3 p = vec3_add_scaled(vec3_scale(points->p[0].w, w[0]), points->p[1].w, w[1]);
    return vec3_norm(vec3_add_scaled(p, points->p[2].w, w[2]));
}

// The upper bound: of the nearest point, or of the hull around the origin; infinity where the origin is not proven
// inside.
static double find_upper(const pair_frame *f, const small_gjk_result *r, double claim, small_end *end) {
    simplex *points = &end->points;
    if (r->end != SMALL_GJK_INSIDE) {
        end->kind = OVOID_PROOF_POINTS;
        get_corners(r, points);
        return find_distance(points) - f->upper_radii + claim;
    }
    get_tetrahedron(r, points);
    vec3 w[4] = {get_lane(r, 0), get_lane(r, 1), get_lane(r, 2), get_lane(r, 3)};
    double depth = hull_find_weights(w, 4, claim, points->weight);
    if (!(depth > 0)) return INFINITY;
    end->kind = OVOID_PROOF_HULL;
    return -depth - f->upper_radii;
}

// An overlap that is proven without a search. The lower bound is that of the spheres, along the line of centres.
static void end_at_overlap(const placed_query *q, double upper, ovoid_stage stage, small_end *end) {
    end->lower = q->sphere_gap;
    end->upper = upper;
    end->normal = vec3_unit(q->frame->between);
    end->has_witness = 0;
    end->stage = stage;
    end->iterations = 0;
}

// The line of centres has a direction.
static int has_line(const pair_frame *f) { return vec3_norm_squared(f->between) > 1e-150; }

void small_end_at_inner(const placed_query *q, vec3 common, double upper, small_end *end) {
    end->inner = common;
    simplex_clear(&end->points, 0);
    end->kind = OVOID_PROOF_INNER;
    end_at_overlap(q, upper, OVOID_STAGE_INNER, end);
}

int small_end_at_hull(const placed_query *q, const uint32_t a[4], const uint32_t b[4], small_end *end) {
    const pair_frame *f = q->frame;
    const double *of_a = shape_vertices(f->a), *of_b = shape_vertices(f->b);
    vec3 w[4];
    if (!has_line(f)) return 0;
    for (int i = 0; i < 4; i++) {
        w[i] = frame_world_difference(f, vec3_at(of_a, a[i]), vec3_at(of_b, b[i]));
        end->points.p[i] = (difference){w[i], a[i], b[i]};
    }
    double depth = hull_find_weights(w, 4, reject_get_claim(f), end->points.weight);
    if (!(depth > 0)) return 0;
    end->points.count = 4;
    end->inner = (vec3){0, 0, 0};
    end->kind = OVOID_PROOF_HULL;
    end_at_overlap(q, -depth - f->upper_radii, OVOID_STAGE_PROOF, end);
    return 1;
}

int small_run_inner(const placed_query *q, small_end *end) {
    vec3 common;
    if (!has_line(q->frame)) return 0;
    double upper = inner_compute_upper_in_world(q->frame, &common);
    if (!(upper < 0)) return 0;
    small_end_at_inner(q, common, upper, end);
    return 1;
}

small_gjk_query small_make_query(const pair_frame *f, const query_goal *goal) {
    vec3 n = f->between;
    return (small_gjk_query){shape_get_points(f->a),
                             shape_get_points(f->b),
                             &f->world.r0.x,
                             &f->world_b.r0.x,
                             f->turned_a,
                             f->turned_b,
                             {f->offset.x, f->offset.y, f->offset.z},
                             {n.x, n.y, n.z},
                             f->lower_radii,
                             f->upper_radii,
                             reject_get_claim(f),
                             goal->far,
                             goal->near,
                             goal->tolerance,
                             goal->wants_bracket,
                             goal->iterations};
}

int small_finish(const pair_frame *f, const query_goal *goal, const small_gjk_result *r, small_end *end) {
    if (r->end == SMALL_GJK_OPEN) return 0;
    double claim = reject_get_claim(f), scale = r->scale;
    // No zero of a direction is negative.
    end->normal = (vec3){r->n[0] * scale + 0.0, r->n[1] * scale + 0.0, r->n[2] * scale + 0.0};
    end->lower = r->gap * scale - f->lower_radii - claim;
    end->iterations = r->iterations;
    end->stage = r->iterations > 0 ? OVOID_STAGE_GJK : OVOID_STAGE_SUPPORT;
    // Of bodies far apart mostly one corner.
    if (r->end == SMALL_GJK_APART || (r->end == SMALL_GJK_NEAR && r->valid == 1)) {
        vec3 w = get_lane(r, 0);
        small_end_set_corner(end, w, r->a[0], r->b[0]);
        end->upper = vec3_norm(w) - f->upper_radii + claim;
        return query_goal_is_met(goal, end->lower, end->upper);
    }
    end->inner = (vec3){0, 0, 0};
    end->has_witness = 0;
    if (r->end == SMALL_GJK_KEPT) {
        get_kept_corners(r, &end->points);
        end->kind = OVOID_PROOF_POINTS;
        end->upper = r->distance - f->upper_radii + claim;
    } else {
        end->upper = find_upper(f, r, claim, end);
    }
    return query_goal_is_met(goal, end->lower, end->upper);
}

// 1 for a yes or no of boxes whose spheres do not overlap so far that an axis is unlikely to separate them.
static int tries_axes(const placed_query *q) {
    const pair_frame *f = q->frame;
    return q->goal->far < INFINITY && boxes_are_right(f->a, f->b) &&
           !small_tries_inner(q->sphere_gap, f->a->reach + f->b->reach);
}

// The witness points of one corner, which the kernel has posed: the bits of posing them again. Of rounded bodies they
// are moved first.
static void take_points(const pair_frame *f, const small_gjk_result *r, small_end *end) {
    if (f->a->radius + f->b->radius > 0) return;
    end->has_witness = 1;
    end->point_a = vec3_add(f->world_origin, vec3_at(r->point_a, 0));
    end->point_b = vec3_add(f->world_origin, vec3_at(r->point_b, 0));
}

int small_run(const placed_query *q, small_end *end) {
    const pair_frame *f = q->frame;
    small_gjk_result r;
    if (!has_line(f)) return 0;
    if (small_tries_inner(q->sphere_gap, f->a->reach + f->b->reach) && small_run_inner(q, end)) return 1;
    if (tries_axes(q) && boxes_separate(q, end)) return 1;
    small_gjk_query gjk = small_make_query(f, q->goal);
    simd_run_small_gjk(&gjk, &r);
    if (!small_finish(f, q->goal, &r, end)) return 0;
    if (r.valid == 1) take_points(f, &r, end);
    return 1;
}

// ---- from an earlier proof

// The common point of the inner ellipsoids as it was, fixed in A, or another one.
static int run_kept_inner(const placed_query *q, small_end *end) {
    vec3 inner = q->earlier->inner_a;
    double upper = inner_compute_upper_at(q->frame, inner);
    if (!(upper < 0)) return small_run_inner(q, end);
    end->inner = inner;
    simplex_clear(&end->points, 0);
    end->kind = OVOID_PROOF_INNER;
    end_at_overlap(q, upper, OVOID_STAGE_PROOF, end);
    return 1;
}

static small_outcome run_kept_overlap(const placed_query *q, small_end *end) {
    const ovoid_proof *p = q->earlier;
    int is_proven = 0;
    if (!has_line(q->frame) || !proof_is_sound(q->frame, p)) return SMALL_UNKNOWN;
    if (p->kind == OVOID_PROOF_INNER) is_proven = run_kept_inner(q, end);
    if (p->kind == OVOID_PROOF_HULL && p->count == 4) is_proven = small_end_at_hull(q, p->a, p->b, end);
    return is_proven ? SMALL_ANSWERED : SMALL_UNKNOWN;
}

static small_outcome run_kept(const placed_query *q, const small_gjk_kept *kept, small_end *end) {
    small_gjk_query gjk = small_make_query(q->frame, q->goal);
    small_gjk_result r;
    simd_run_small_gjk_kept(&gjk, kept, &r);
    if (!small_finish(q->frame, q->goal, &r, end)) return SMALL_OPEN;
    if (r.iterations == 0) end->stage = OVOID_STAGE_PROOF;
    return SMALL_ANSWERED;
}

small_outcome small_run_earlier(const placed_query *q, rejection *found, small_end *end) {
    const ovoid_proof *earlier = q->earlier;
    int was_apart = earlier->kind == OVOID_PROOF_POINTS || earlier->kind == OVOID_PROOF_INNER_POINTS;
    if (!was_apart) return run_kept_overlap(q, end);
    small_gjk_kept kept = kept_get_simplex(q->frame, q->goal, earlier);
    if (kept.count) return run_kept(q, &kept, end);
    if (q->goal->far == INFINITY) return SMALL_UNKNOWN;
    if (reject_by_normal(q->frame, q->goal->far, earlier, found)) return SMALL_REJECTED;
    // More differences: it touched, and the stages of all pairs say more of that.
    if (earlier->count > 3) return SMALL_OPEN;
    uint32_t a = found->a, b = found->b;
    small_gjk_kept met = {{a, a, a, a}, {b, b, b, b}, 1};
    return run_kept(q, &met, end);
}
