// What EPA (epa.c) does first for a depth: the surface grows in lanes (simd/epa8.h), and in the common case the depth
// is taken from it as it is. The numbers are those that epa.c finds for the same surface; where this ends early, epa.c
// goes on from the points and faces that there are.
#include "exact/epa_lanes.h"

#include "base/compiler.h"

// The surfaces of curved bodies have slivers, at which growth in lanes ends.
int epa_lanes_serve(const search *s) {
    double size = s->frame->size;
    return size > 0x1p-100 && size < 0x1p100 && !s->frame->is_true;
}

static simd_difference find(const void *bodies, vec3 n) {
    frame_support w = probe_measure(bodies, vec3_neg(n));
    return (simd_difference){w.gap, w.w.x, w.w.y, w.w.z, w.a, w.b};
}

epa8_end epa_lanes_grow(epa8 *lanes, const prober *p, const simplex *points, double slack, double doubt) {
    search *s = p->s;
    double claim = s->frame->claim, narrow = s->goal.tolerance - s->goal.allowance - 2 * claim;
    epa8_query query = {p->a,  p->b,  p->is_posed ? NULL : find, p, claim, narrow, 2 * epa_get_face_doubt(s),
                        slack, doubt, s->goal.iterations};
    lanes->points = (uint32_t)points->count;
    for (int i = 0; i < points->count; i++) {
        lanes->w[0][i] = points->p[i].w.x, lanes->w[1][i] = points->p[i].w.y, lanes->w[2][i] = points->p[i].w.z;
        lanes->a[i] = points->p[i].a, lanes->b[i] = points->p[i].b;
    }
    epa8_end end = epa8_grow(lanes, &query);
    if (end == EPA8_FLAT) return end;
    double lower = s->lower;
    search_take_gap(s, vec3_neg(lanes->best_n), lanes->best_gap);
    if (s->lower > lower) s->stage = OVOID_STAGE_EPA;
    // The support that ends the growth is not counted; epa.c does not count it either.
    s->iterations += lanes->points - EPA8_START;
    return end;
}

static difference get_corner(const epa8 *lanes, uint32_t face, int k) {
    uint32_t i = lanes->v[face][k];
    return (difference){{lanes->w[0][i], lanes->w[1][i], lanes->w[2][i]}, lanes->a[i], lanes->b[i]};
}

static vec3 get_normal(const epa8 *lanes, uint32_t face) {
    return (vec3){lanes->n[0][face], lanes->n[1][face], lanes->n[2][face]};
}

// The radius that the surface keeps from the origin, as measure_faces of epa.c finds it.
static double measure(const search *s, const epa8 *lanes) {
    double depth = lanes->low[lanes->nearest] + epa_get_face_doubt(s);
    for (uint32_t half = 0; half < 2; half++)
        for (uint64_t rest = lanes->near[half]; rest; rest &= rest - 1) {
            uint32_t face = 64 * half + compiler_count_low_zeros_64(rest);
            vec3 n = get_normal(lanes, face);
            for (int k = 0; k < 3; k++) depth = min2(depth, vec3_dot(n, get_corner(lanes, face, k).w));
        }
    return depth - s->frame->claim;
}

// The foot on the nearest face's plane, if it lies in that face.
static int find_foot(const search *s, const epa8 *lanes, uint32_t face, evidence *foot) {
    difference corner[3];
    for (int k = 0; k < 3; k++) corner[k] = get_corner(lanes, face, k);
    return epa_find_foot(s, corner, get_normal(lanes, lanes->nearest), lanes->low[lanes->nearest], foot);
}

// The foot in the nearest face, or in another triangle of its facet.
static int find_witness(const search *s, const epa8 *lanes, evidence *foot) {
    if (find_foot(s, lanes, lanes->nearest, foot)) return 1;
    for (uint32_t half = 0; half < 2; half++)
        for (uint64_t rest = lanes->near[half]; rest; rest &= rest - 1)
            if (find_foot(s, lanes, 64 * half + compiler_count_low_zeros_64(rest), foot)) return 1;
    return 0;
}

int epa_lanes_take_depth(search *s, const epa8 *lanes) {
    if (lanes->inward[0] | lanes->inward[1]) return 0;
    double depth = measure(s, lanes);
    double upper = -depth - s->frame->upper_radii, lower = lanes->gap - s->frame->lower_radii - s->frame->claim;
    evidence foot;
    if (!(depth > 0 && upper < s->upper && upper - lower <= s->goal.tolerance)) return 0;
    if (!find_witness(s, lanes, &foot)) return 0;
    s->upper = upper;
    s->lower = lower;
    s->normal = vec3_neg(get_normal(lanes, lanes->nearest));
    s->stage = OVOID_STAGE_EPA;
    s->kind = OVOID_PROOF_COVER;
    s->witness = foot;
    return 1;
}

int epa_find_foot(const search *s, const difference corner[3], vec3 n, double low, evidence *found) {
    vec3 p[3];
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        found->p[i] = corner[i];
        p[i] = vec3_add_scaled(corner[i].w, n, -low);
    }
    for (int i = 0; i < 3; i++) {
        found->weight[i] = vec3_dot(n, vec3_cross(p[(i + 1) % 3], p[(i + 2) % 3]));
        if (!(found->weight[i] > 0)) return 0;
        sum += found->weight[i];
    }
    vec3 off = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        found->weight[i] /= sum;
        off = vec3_add_scaled(off, p[i], found->weight[i]);
    }
    found->count = 3;
    return vec3_norm(off) <= s->frame->claim;
}
