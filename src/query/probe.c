// A vertex of B that is brought into the frame is off by 91 u s, as in a difference; a gap from such vertices is off by
// 91 u s and 3 u s for each dot product: within the 100 u s of frame.h.
#include "query/probe.h"

#include "simd/support.h"

void prober_make(prober *p, search *s) {
    const pair_frame *f = s->frame;
    const ovoid_shape *b = f->b;
    p->s = s;
    p->is_posed = b->padded_count <= PROBE_POSED;
    if (!p->is_posed) return;
    const double *x = shape_x(b), *y = shape_y(b), *z = shape_z(b);
    double *px = p->posed, *py = px + b->padded_count, *pz = py + b->padded_count;
    for (uint32_t i = 0; i < b->padded_count; i++) {
        vec3 v = frame_b(f, (vec3){x[i], y[i], z[i]});
        px[i] = v.x, py[i] = v.y, pz[i] = v.z;
    }
}

static frame_support find_posed(const prober *p, vec3 n) {
    const ovoid_shape *a = p->s->frame->a;
    uint32_t count = p->s->frame->b->padded_count;
    const double *px = p->posed, *py = px + count, *pz = py + count;
    support_result high = simd_find_support(px, py, pz, count, n.x, n.y, n.z);
    support_result low = simd_find_support(shape_x(a), shape_y(a), shape_z(a), a->padded_count, -n.x, -n.y, -n.z);
    vec3 xb = {px[high.index], py[high.index], pz[high.index]};
    vec3 xa = {shape_x(a)[low.index], shape_y(a)[low.index], shape_z(a)[low.index]};
    return (frame_support){low.index, high.index, -high.value - low.value, vec3_sub(xb, xa)};
}

frame_support probe_find(const prober *p, vec3 n) {
    frame_support x = p->is_posed ? find_posed(p, n) : frame_find_support(p->s->frame, vec3_neg(n));
    search_take_gap(p->s, vec3_neg(n), x.gap);
    return x;
}
