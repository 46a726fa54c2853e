// The kernel of areas.h, written once over lanes; scalar.c and avx2.c include this. Sums and products are those of
// linear/exact.h lane by lane, so all widths give the same bits.
#include "simd/areas.h"
#include "simd/kernels/lanes.h"

/// Double-double numbers in lanes.
typedef struct lane_dd {
    lane high, low;
} lane_dd;

LANES_INLINE lane_dd lane_two_sum(lane a, lane b) {
    lane s = a + b, v = s - a;
    return (lane_dd){s, (a - (s - v)) + (b - v)};
}
LANES_INLINE lane_dd lane_quick_two_sum(lane a, lane b) {
    lane s = a + b;
    return (lane_dd){s, b - (s - a)};
}
LANES_INLINE lane_dd lane_two_product(lane a, lane b) {
    lane p = a * b, split = lane_set(134217729.0), ta = split * a, tb = split * b;
    lane ah = ta - (ta - a), al = a - ah, bh = tb - (tb - b), bl = b - bh;
    return (lane_dd){p, al * bl - (((p - ah * bh) - al * bh) - ah * bl)};
}
LANES_INLINE lane_dd lane_dd_sub(lane_dd a, lane_dd b) {
    lane_dd s = lane_two_sum(a.high, -b.high), t = lane_two_sum(a.low, -b.low);
    s = lane_quick_two_sum(s.high, s.low + t.high);
    return lane_quick_two_sum(s.high, s.low + t.low);
}
LANES_INLINE lane_dd lane_dd_mul(lane_dd a, lane_dd b) {
    lane_dd p = lane_two_product(a.high, b.high);
    return lane_quick_two_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

/// a b - c d, rounded.
LANES_INLINE lane compute_minor(lane_dd a, lane_dd b, lane_dd c, lane_dd d) {
    return lane_dd_sub(lane_dd_mul(a, b), lane_dd_mul(c, d)).high;
}

/// The differences of two corners along one axis.
LANES_INLINE lane_dd get_side(const double *xyz, const uint32_t *from, const uint32_t *to) {
    return lane_two_sum(lane_gather(xyz, to), -lane_gather(xyz, from));
}

LANES_TARGET static void run_areas(const simd_triangles *t, vec3 *areas) {
    for (uint32_t i = 0; i < t->count; i += LANES) {
        // The first coordinate of each corner; the last triangle fills what is left of the lanes.
        uint32_t at[3][LANES];
        for (uint32_t k = 0; k < LANES; k++) {
            const uint32_t *corner = t->corners + 3 * (size_t)(i + k < t->count ? i + k : t->count - 1);
            for (int c = 0; c < 3; c++) at[c][k] = 3 * corner[c];
        }
        lane_dd p[3], q[3];
        for (int axis = 0; axis < 3; axis++) {
            p[axis] = get_side(t->xyz + axis, at[0], at[1]);
            q[axis] = get_side(t->xyz + axis, at[0], at[2]);
        }
        double x[LANES], y[LANES], z[LANES];
        lane_store(x, compute_minor(p[1], q[2], p[2], q[1]));
        lane_store(y, compute_minor(p[2], q[0], p[0], q[2]));
        lane_store(z, compute_minor(p[0], q[1], p[1], q[0]));
        for (uint32_t k = 0; k < LANES && i + k < t->count; k++) areas[i + k] = (vec3){x[k], y[k], z[k]};
    }
}

// ---- heights ----

// Which planes are listed follows no pattern: 64 comparisons are kept as bits, and the list is made of these, not plane
// by plane.
LANES_TARGET static uint32_t run_heights(const simd_planes *p, const heights_query *q, const heights_result *out) {
    const lane3 point = {lane_set(q->point.x), lane_set(q->point.y), lane_set(q->point.z)};
    const lane least = lane_set(q->least);
    uint32_t found = 0;
    for (uint32_t start = 0; start < p->count; start += 64) {
        uint32_t count = p->count - start < 64 ? p->count - start : 64;
        uint64_t bits = 0;
        for (uint32_t k = 0, i = start; k < count; k += LANES, i += LANES) {
            lane3 n = {lane_load(p->x + i), lane_load(p->y + i), lane_load(p->z + i)};
            lane height = lane3_dot(n, point) - lane_load(p->offset + i);
            lane_store(out->height + i, height);
            bits |= (uint64_t)lane_bits(lane_at_least(height, least)) << k;
        }
        if (count < 64) bits &= ((uint64_t)1 << count) - 1;
        for (; bits; bits &= bits - 1) out->near[found++] = (uint16_t)(start + (uint32_t)__builtin_ctzll(bits));
    }
    return found;
}
