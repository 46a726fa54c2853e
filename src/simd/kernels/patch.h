// The kernels of patch.h, written once over lanes; scalar.c and avx2.c include this. Every number is computed lane by
// lane in one order, so all widths give the same bits.
#include "simd/kernels/lanes.h"
#include "simd/patch.h"

LANES_INLINE lane place_along(const simd_placing *f, int row, lane3 at) {
    const double *r = f->rows + 3 * row;
    lane sum = (lane_set(r[0]) * at.x + lane_set(r[1]) * at.y) + lane_set(r[2]) * at.z;
    return sum + lane_set(f->shift[row]);
}

LANES_TARGET static void run_place(const simd_placing *f, simd_patch *p) {
    uint32_t end = simd_patch_pad(p->count);
    for (uint32_t i = 0; i < end; i += LANES) {
        const uint32_t *at = p->vertices + i;
        lane3 v = {lane_gather(f->points.x, at), lane_gather(f->points.y, at), lane_gather(f->points.z, at)};
        lane_store(p->x + i, place_along(f, 0, v));
        lane_store(p->y + i, place_along(f, 1, v));
        lane_store(p->z + i, place_along(f, 2, v));
    }
    p->x[end] = p->x[0];
    p->y[end] = p->y[0];
    lane zero = lane_set(0);
    for (uint32_t i = 0; i < p->count && p->count > 1; i += LANES) {
        lane x = lane_load(p->x + i), y = lane_load(p->y + i);
        lane dx = lane_load(p->x + i + 1) - x, dy = lane_load(p->y + i + 1) - y, square = dx * dx + dy * dy;
        lane_mask has_length = lane_greater(square, zero);
        lane scale = lane_select(has_length, lane_set(1) / lane_sqrt(square), zero);
        lane side_x = -dy * scale, side_y = dx * scale;
        lane_store(p->side_x + i, side_x);
        lane_store(p->side_y + i, side_y);
        lane_store(p->side_at + i, lane_select(has_length, side_x * x + side_y * y, lane_set(-INFINITY)));
    }
}

// The distances of LANES corners to a side.
LANES_INLINE lane measure_side(const simd_patch *p, uint32_t i, lane x, lane y) {
    return (lane_set(p->side_x[i]) * x + lane_set(p->side_y[i]) * y) - lane_set(p->side_at[i]);
}

// A corner that is there again, behind the last one, changes no largest and no least distance.
LANES_INLINE void measure_few(const simd_patch *p, const simd_patch *other, simd_patch_table *t) {
    lane x = lane_load(other->x), y = lane_load(other->y), least = lane_set(INFINITY);
    uint64_t all = ~UINT64_C(0) >> (64 - other->count);
    for (uint32_t i = 0; i < p->side_count; i++) {
        lane d = measure_side(p, i, x, y);
        least = lane_min(least, d);
        t->most[i] = lane_first(lane_find_max(d));
        t->outside[i] = lane_bits(lane_less(d, lane_set(0))) & all;
    }
    lane_store(t->least, least);
}

LANES_INLINE void measure_many(const simd_patch *p, const simd_patch *other, simd_patch_table *t) {
    uint64_t all = ~UINT64_C(0) >> (64 - other->count);
    for (uint32_t k = 0; k < other->count; k += LANES) lane_store(t->least + k, lane_set(INFINITY));
    for (uint32_t i = 0; i < p->side_count; i++) {
        lane most = lane_set(-INFINITY);
        uint64_t outside = 0;
        for (uint32_t k = 0; k < other->count; k += LANES) {
            lane d = measure_side(p, i, lane_load(other->x + k), lane_load(other->y + k));
            most = lane_top(most, d);
            lane_store(t->least + k, lane_min(lane_load(t->least + k), d));
            outside |= (uint64_t)lane_bits(lane_less(d, lane_set(0))) << k;
        }
        t->most[i] = lane_first(lane_find_max(most));
        t->outside[i] = outside & all;
    }
}

LANES_TARGET static void run_measure(const simd_patch *p, const simd_patch *other, simd_patch_table *t) {
    if (other->count <= LANES)
        measure_few(p, other, t);
    else
        measure_many(p, other, t);
}
