// From a pair in the world to the kernel of small bodies, and from its corners to bounds.
#include "exact/small.h"

#include "pair/hull.h"
#include "pair/inner.h"
#include "pair/reject.h"

static simd_points get_points(const ovoid_shape *s) {
    return (simd_points){shape_x(s), shape_y(s), shape_z(s), s->padded_count};
}

static difference get_corner(const small_gjk_result *r, int i) {
    return (difference){{r->at.x[i], r->at.y[i], r->at.z[i]}, r->a[i], r->b[i]};
}

static void get_corners(const small_gjk_result *r, simplex *x) {
    x->count = 0;
    for (int i = 0; i < 4; i++)
        if (r->valid >> i & 1) x->p[x->count++] = get_corner(r, i);
}

// The upper bound: of the nearest point, or of the hull around the origin; infinity where the origin is not proven
// inside.
static double find_upper(const pair_frame *f, small_gjk_end kind, double claim, small_end *end) {
    simplex *x = &end->points;
    if (kind != SMALL_GJK_INSIDE) {
        end->kind = OVOID_PROOF_POINTS;
        simplex_compute_weights(x);
        return vec3_norm(simplex_compute_point(x)) - f->upper_radii + claim;
    }
    vec3 w[4] = {x->p[0].w, x->p[1].w, x->p[2].w, x->p[3].w};
    double depth = hull_compute_depth(w, 4, claim);
    if (!(depth > 0)) return INFINITY;
    end->kind = OVOID_PROOF_HULL;
    simplex_compute_inside_weights(x);
    return -depth - f->upper_radii;
}

// How deep the spheres overlap, of the sum of their radii, where the inner ellipsoids are likely to overlap too.
#define INNER_DEPTH 0.4

// A common point of the inner ellipsoids: 1 if it proves an overlap. The lower bound is that of the spheres.
static int run_inner(const pair_frame *f, double spheres, vec3 d, small_end *end) {
    double upper = inner_compute_upper_in_world(f, &end->inner);
    if (!(upper < 0)) return 0;
    end->lower = spheres;
    end->upper = upper;
    end->normal = vec3_unit(d);
    end->points.count = 0;
    end->kind = OVOID_PROOF_INNER;
    end->stage = OVOID_STAGE_INNER;
    end->iterations = 0;
    return 1;
}

int small_begin(const pair_frame *f, const query_goal *goal, double spheres, small_gjk_query *q, small_end *end) {
    vec3 d = f->between;
    if (!(vec3_norm_squared(d) > 1e-150)) return 0;
    if (spheres < -INNER_DEPTH * (f->a->reach + f->b->reach) && run_inner(f, spheres, d, end)) return 1;
    *q = (small_gjk_query){get_points(f->a),
                           get_points(f->b),
                           &f->world.r0.x,
                           &f->world_b.r0.x,
                           {f->offset.x, f->offset.y, f->offset.z},
                           {d.x, d.y, d.z},
                           f->lower_radii,
                           f->upper_radii,
                           reject_get_claim(f),
                           goal->far,
                           goal->near,
                           goal->tolerance,
                           goal->wants_bracket,
                           goal->iterations};
    return -1;
}

int small_finish(const pair_frame *f, const query_goal *goal, const small_gjk_result *r, small_end *end) {
    if (r->end == SMALL_GJK_OPEN) return 0;
    double claim = reject_get_claim(f), scale = 1 / sqrt(r->square);
    // No zero of a direction is negative.
    end->normal = (vec3){r->n[0] * scale + 0.0, r->n[1] * scale + 0.0, r->n[2] * scale + 0.0};
    end->lower = r->gap * scale - f->lower_radii - claim;
    end->iterations = r->iterations;
    end->stage = r->iterations > 0 ? OVOID_STAGE_GJK : OVOID_STAGE_SUPPORT;
    if (r->end == SMALL_GJK_APART) {
        end->points.p[0] = get_corner(r, 0);
        end->points.weight[0] = 1;
        end->points.count = 1;
        end->kind = OVOID_PROOF_POINTS;
        end->upper = vec3_norm(end->points.p[0].w) - f->upper_radii + claim;
    } else {
        get_corners(r, &end->points);
        end->upper = find_upper(f, r->end, claim, end);
    }
    return query_goal_is_met(goal, end->lower, end->upper);
}

int small_run(const pair_frame *f, const query_goal *goal, double spheres, small_end *end) {
    small_gjk_query q;
    small_gjk_result r;
    int is_over = small_begin(f, goal, spheres, &q, end);
    if (is_over >= 0) return is_over;
    simd_run_small_gjk(&q, &r);
    return small_finish(f, goal, &r, end);
}
