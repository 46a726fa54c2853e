// Reading a proof without trusting it.
#include "pair/proof.h"

#include "linear/nearest.h"
#include "pair/balls.h"

int proof_is_sound(const pair_frame *f, const ovoid_proof *p) {
    if (!vec3_is_finite(p->normal) || !vec3_is_finite(p->normal_low) || p->count > OVOID_PROOF_PAIRS) return 0;
    double sum_a = 0, sum_b = 0;
    for (uint32_t i = 0; i < p->count; i++) {
        if (!shape_has_vertex(f->a, p->a[i]) || !shape_has_vertex(f->b, p->b[i])) return 0;
        if (!(p->weight_a[i] >= 0) || !(p->weight_b[i] >= 0)) return 0;
        sum_a += p->weight_a[i];
        sum_b += p->weight_b[i];
    }
    return p->count == 0 || (sum_a > 0 && sum_b > 0 && isfinite(sum_a) && isfinite(sum_b));
}

witness_points proof_compute_points(const pair_frame *f, const ovoid_proof *p) {
    witness_points w = {{0, 0, 0}, {0, 0, 0}};
    double sum_a = 0, sum_b = 0;
    for (uint32_t i = 0; i < p->count; i++) {
        w.a = vec3_add_scaled(w.a, shape_get_vertex(f->a, p->a[i]), p->weight_a[i]);
        w.b = vec3_add_scaled(w.b, frame_b(f, shape_get_vertex(f->b, p->b[i])), p->weight_b[i]);
        sum_a += p->weight_a[i];
        sum_b += p->weight_b[i];
    }
    return (witness_points){vec3_scale(w.a, 1 / sum_a), vec3_scale(w.b, 1 / sum_b)};
}

witness_points witness_compute_points(const pair_frame *f, const ovoid_proof *p) {
    vec3 n = vec3_unit(frame_direction_from_world(f, p->normal));
    witness_points w;
    switch (p->kind) {
    case OVOID_PROOF_POINTS: {
        w = proof_compute_points(f, p);
        vec3 d = vec3_sub(w.b, w.a);
        if (nearest_takes_difference(vec3_norm(d), f->a->radius + f->b->radius)) n = vec3_unit(d);
        break;
    }
    case OVOID_PROOF_INNER_POINTS:
        w = (witness_points){p->inner_a, frame_b(f, p->inner_b)};
        n = vec3_unit(vec3_sub(w.b, w.a));
        break;
    case OVOID_PROOF_COVER: w = proof_compute_points(f, p); break;
    case OVOID_PROOF_HULL: return proof_compute_points(f, p);
    case OVOID_PROOF_BALLS: return balls_compute_points(f, p);
    default: return (witness_points){p->inner_a, p->inner_a};
    }
    w.a = vec3_add_scaled(w.a, n, f->a->radius);
    w.b = vec3_add_scaled(w.b, n, -f->b->radius);
    return w;
}
