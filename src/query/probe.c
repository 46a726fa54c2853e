// A vertex of B that is brought into the frame is off by 91 u s, as in a difference; a gap from such vertices is off by
// 91 u s and 3 u s for each dot product: within the 100 u s of frame.h.
#include "query/probe.h"

void prober_make(prober *p, search *s) {
    const pair_frame *f = s->frame;
    const ovoid_shape *a = f->a, *b = f->b;
    uint32_t count = b->padded_count;
    p->s = s;
    p->is_posed = count <= PROBE_POSED;
    p->is_small = a->padded_count <= PROBE_ALL && count <= PROBE_ALL;
    p->a = (simd_points){shape_x(a), shape_y(a), shape_z(a), a->padded_count};
    p->b = (simd_points){shape_x(b), shape_y(b), shape_z(b), count};
    if (!p->is_posed) return;
    const double *x = shape_x(b), *y = shape_y(b), *z = shape_z(b);
    double *px = p->posed, *py = px + count, *pz = py + count;
    for (uint32_t i = 0; i < count; i++) {
        vec3 v = frame_b(f, (vec3){x[i], y[i], z[i]});
        px[i] = v.x, py[i] = v.y, pz[i] = v.z;
    }
    p->b = (simd_points){px, py, pz, count};
}

static frame_support find_posed(const prober *p, vec3 n) {
    const simd_points *a = &p->a, *b = &p->b;
    double up[3] = {n.x, n.y, n.z}, down[3] = {-n.x, -n.y, -n.z};
    simd_pair x = simd_find_pair(b, up, a, down);
    uint32_t i = x.low.index, k = x.high.index;
    vec3 w = {b->x[k] - a->x[i], b->y[k] - a->y[i], b->z[k] - a->z[i]};
    return (frame_support){i, k, -x.high.value - x.low.value, w};
}

// So many supports that reading all vertices once, in order, is less than the cells of a table that they would touch.
static frame_support find_small(const prober *p, vec3 n) {
    const pair_frame *f = p->s->frame;
    vec3 in_b = mat3_mul_transposed_vec3(f->rotation, n);
    double up[3] = {-n.x, -n.y, -n.z}, down[3] = {in_b.x, in_b.y, in_b.z};
    simd_pair x = simd_find_pair(&p->a, up, &p->b, down);
    double gap = (-vec3_dot(n, f->translation) - x.low.value) - x.high.value;
    return (frame_support){x.high.index, x.low.index, gap, frame_difference(f, x.high.index, x.low.index)};
}

frame_support probe_find(const prober *p, vec3 n) {
    frame_support x = p->is_posed   ? find_posed(p, n)
                      : p->is_small ? find_small(p, n)
                                    : frame_find_support(p->s->frame, vec3_neg(n));
    search_take_gap(p->s, vec3_neg(n), x.gap);
    return x;
}
