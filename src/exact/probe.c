// A vertex of B that is brought into the frame is off by 91 u s, as in a difference; a gap from such vertices is off by
// 91 u s and 3 u s for each dot product: within the 100 u s of frame.h.
#include "exact/probe.h"

void prober_make(prober *p, search *s, int is_steady) {
    const pair_frame *f = s->frame;
    const ovoid_shape *a = f->a, *b = f->b;
    uint32_t count = b->padded_count, most = is_steady ? PROBE_POSED : PROBE_POSED_FEW;
    p->s = s;
    p->is_posed = !f->is_true && count <= most && a->padded_count <= PROBE_POSED;
    p->is_small = !f->is_true && is_steady && a->padded_count <= PROBE_ALL && count <= PROBE_ALL;
    p->a = shape_get_points(a);
    p->b = shape_get_points(b);
    if (!p->is_posed) return;
    mat3 r = f->rotation;
    vec3 t = f->translation;
    double *to[3] = {p->posed, p->posed + count, p->posed + 2 * (size_t)count};
    simd_pose_points(&p->b, (const double[]){r.r0.x, r.r0.y, r.r0.z, r.r1.x, r.r1.y, r.r1.z, r.r2.x, r.r2.y, r.r2.z},
                     (const double[]){t.x, t.y, t.z}, to);
    p->b = (simd_points){to[0], to[1], to[2], count};
}

// For many supports of small bodies: reading all vertices in order touches less memory than the cells of a table.
static frame_support find_small(const prober *p, vec3 n) {
    const pair_frame *f = p->s->frame;
    vec3 in_b = vec3_neg(mat3_mul_transposed_vec3(f->rotation, n));
    simd_pair ends = simd_find_pair(&p->a, n, &p->b, in_b);
    double gap = (vec3_dot(n, f->translation) - ends.low.value) - ends.high.value;
    return (frame_support){ends.high.index, ends.low.index, gap, frame_difference(f, ends.high.index, ends.low.index)};
}

frame_support probe_measure(const prober *p, vec3 n) {
    if (p->is_posed) {
        simd_difference d = simd_find_difference(&p->a, &p->b, n);
        return (frame_support){d.a, d.b, d.gap, {d.x, d.y, d.z}};
    }
    return p->is_small ? find_small(p, n) : frame_find_support(p->s->frame, n);
}

frame_support probe_find(const prober *p, vec3 n) {
    frame_support support = probe_measure(p, vec3_neg(n));
    search_take_gap(p->s, vec3_neg(n), support.gap);
    return support;
}
