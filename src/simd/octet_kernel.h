// The kernels of octet.h, written once over lanes; octet.c, octet_avx2.c and octet_avx512.c include this. Every step
// has the operations of the single query in their order: a change there is a change here, and tests/test_query_batch.c
// sees the difference.
#include "simd/lanes.h"
#include "simd/octet.h"

// ---- columns

LANES_INLINE lane get(const octet_column *c, int at) { return lane_load(c->lane + at); }
LANES_INLINE void put(octet_column *c, int at, lane v) { lane_store(c->lane + at, v); }
LANES_INLINE lane3 get3(const octet_column *c, int at) { return (lane3){get(c, at), get(c + 1, at), get(c + 2, at)}; }
LANES_INLINE void put3(octet_column *c, int at, lane3 v) {
    put(c, at, v.x);
    put(c + 1, at, v.y);
    put(c + 2, at, v.z);
}
LANES_INLINE lane6 get6(const octet_column *c, int at) {
    return (lane6){get(c, at), get(c + 1, at), get(c + 2, at), get(c + 3, at), get(c + 4, at), get(c + 5, at)};
}
LANES_INLINE lane9 get9(const octet_column *c, int at) {
    return (lane9){get3(c, at), get3(c + 3, at), get3(c + 6, at)};
}
LANES_INLINE void put9(octet_column *c, int at, lane9 m) {
    put3(c, at, m.r0);
    put3(c + 3, at, m.r1);
    put3(c + 6, at, m.r2);
}

// The rows' numbers from `from` on, `count` (even) of them, as columns.
#if LANES == 8
// Two numbers of the even rows beside each other, and of the odd ones: a shuffle each makes columns of them.
LANES_INLINE __m512d read_two(const double *const rows[OCTET], int first, int from) {
    __m512 v = _mm512_castpd_ps(_mm512_castpd128_pd512(_mm_loadu_pd(rows[first] + from)));
    v = _mm512_mask_broadcast_f32x4(v, 0x00f0, _mm_castpd_ps(_mm_loadu_pd(rows[first + 2] + from)));
    v = _mm512_mask_broadcast_f32x4(v, 0x0f00, _mm_castpd_ps(_mm_loadu_pd(rows[first + 4] + from)));
    v = _mm512_mask_broadcast_f32x4(v, 0xf000, _mm_castpd_ps(_mm_loadu_pd(rows[first + 6] + from)));
    return _mm512_castps_pd(v);
}
LANES_INLINE void read_columns(const double *const rows[OCTET], int from, int count, octet_column *out) {
    for (int k = 0; k < count; k += 2) {
        __m512d even = read_two(rows, 0, from + k), odd = read_two(rows, 1, from + k);
        _mm512_store_pd(out[k].lane, _mm512_unpacklo_pd(even, odd));
        _mm512_store_pd(out[k + 1].lane, _mm512_unpackhi_pd(even, odd));
    }
}
#else
LANES_INLINE void read_columns(const double *const rows[OCTET], int from, int count, octet_column *out) {
    for (int i = 0; i < OCTET; i++)
        for (int k = 0; k < count; k++) out[k].lane[i] = rows[i][from + k];
}
#endif

// ---- poses and spheres

// quat_to_mat3. *good loses the lanes whose quaternion would be scaled first.
LANES_INLINE lane9 make_rotation(const octet_column *q, int at, lane_mask *good) {
    lane w = get(q, at), x = get(q + 1, at), y = get(q + 2, at), z = get(q + 3, at);
    lane ww = w * w, xx = x * x, yy = y * y, zz = z * z, norm = (ww + xx) + (yy + zz);
    *good = lane_and(*good, lane_and(lane_greater(norm, lane_set(0x1p-60)), lane_less(norm, lane_set(0x1p60))));
    lane s = lane_set(2) / norm, one = lane_set(1);
    lane xy = x * y, xz = x * z, yz = y * z, wx = w * x, wy = w * y, wz = w * z;
    return (lane9){{one - s * (yy + zz), s * (xy - wz), s * (xz + wy)},
                   {s * (xy + wz), one - s * (xx + zz), s * (yz - wx)},
                   {s * (xz - wy), s * (yz + wx), one - s * (xx + yy)}};
}

LANES_INLINE lane_mask is_in_reach(lane3 p, double most) {
    lane m = lane_set(most);
    lane_mask x = lane_at_most(lane_abs(p.x), m), y = lane_at_most(lane_abs(p.y), m);
    return lane_and(lane_and(x, y), lane_at_most(lane_abs(p.z), m));
}

// What is read of a body.
typedef struct body_columns {
    octet_column pose[8]; ///< what is before it, position, rotation
    octet_column head[6];
    octet_column first[4]; ///< vertex 0, what is behind it
} body_columns;

// frame_place, glance_at_spheres and the bounds of glance_write.
LANES_INLINE octet_found place_lanes(const body_columns *a, const body_columns *b, const octet_ask *ask, octet *o,
                                     int at) {
    lane3 origin = get3(a->pose + 1, at), origin_b = get3(b->pose + 1, at);
    lane_mask good = lane_and(is_in_reach(origin, ask->length_most), is_in_reach(origin_b, ask->length_most));
    lane9 world = make_rotation(a->pose + 4, at, &good), world_b = make_rotation(b->pose + 4, at, &good);
    lane3 offset = lane3_sub(origin_b, origin);
    lane radii = get(a->head + 1, at) + get(b->head + 1, at), reach = get(a->head, at) + get(b->head, at);
    lane size = get(a->head + 5, at) + get(b->head + 5, at) + lane3_norm(offset) + radii;

    // The enclosing spheres.
    lane3 center_a = get3(a->head + 2, at), center_b = get3(b->head + 2, at);
    lane3 d = lane3_add(offset, lane3_sub(lane9_mul3(world_b, center_b), lane9_mul3(world, center_a)));
    lane claim = lane_set(ask->glance) * size + lane_set(3 * ask->hidden);
    lane lower = lane3_norm(d) - reach - radii - claim;
    lane_mask apart = lane_and(good, lane_greater(lower, lane_set(ask->far)));

    // Any two vertices, for the upper bound.
    lane3 first_a = get3(a->first, at), first_b = get3(b->first, at);
    lane3 any = lane3_add(offset, lane3_sub(lane9_mul3(world_b, first_b), lane9_mul3(world, first_a)));
    lane upper = lane3_norm(any) - radii + claim;
    lane tolerance = lane_max(lane_set(ask->absolute), lane_set(ask->relative) * size) + lane_set(8 * ask->hidden);
    put(&o->lower, at, lower);
    put(&o->upper, at, upper);
    octet_found found = {lane_bits(lane_not(good)), 0, lane_bits(apart),
                         lane_bits(lane_at_most(upper - lower, tolerance))};
    if (!ask->keeps_all && found.apart == (1u << LANES) - 1) return found;

    // For those who go on.
    put3(o->center_a, at, center_a);
    put3(o->center_b, at, center_b);
    put3(o->first_a, at, first_a);
    put3(o->first_b, at, first_b);
    put(&o->reach, at, reach);
    put(&o->radii, at, radii);
    put(&o->size, at, size);
    put9(o->world_a, at, world);
    put9(o->world_b, at, world_b);
    put3(o->offset, at, offset);
    put(&o->tolerance, at, tolerance);
    return found;
}

static void add_found(octet_found *all, octet_found some, int at) {
    all->odd |= some.odd << at;
    all->inner |= some.inner << at;
    all->apart |= some.apart << at;
    all->narrow |= some.narrow << at;
}

LANES_TARGET static octet_found place(const octet_places *from, const octet_ask *ask, octet *o) {
    body_columns a, b;
    read_columns(from->body_a, 0, 8, a.pose);
    read_columns(from->body_b, 0, 8, b.pose);
    read_columns(from->shape_a, 0, 6, a.head);
    read_columns(from->shape_b, 0, 6, b.head);
    read_columns(from->shape_a, 8, 4, a.first);
    read_columns(from->shape_b, 8, 4, b.first);
    octet_found all = {0, 0, 0, 0};
    for (int at = 0; at < OCTET; at += LANES) add_found(&all, place_lanes(&a, &b, ask, o, at), at);
    return all;
}

// ---- ellipsoids

// What is read of a shape: outer centre and Q, inner centre, W and the least and largest radius.
typedef struct ellipsoid_columns {
    octet_column outer[12], inner[8];
} ellipsoid_columns;

// B in the frame of A.
typedef struct related {
    lane9 rotation;
    lane3 translation;
    lane radii, claim;
} related;

LANES_INLINE lane3 get_b(const related *f, lane3 x) { return lane3_add(lane9_mul3(f->rotation, x), f->translation); }

// norm_of in inner.c.
LANES_INLINE lane norm_of(const octet_column *w, lane3 y, int at) {
    lane3 v = {get(w, at) * y.x, get(w + 1, at) * y.x + get(w + 2, at) * y.y,
               (get(w + 3, at) * y.x + get(w + 4, at) * y.y) + get(w + 5, at) * y.z};
    return lane3_norm(v);
}

// norm_in there.
LANES_INLINE lane norm_in(const ellipsoid_columns *s, lane3 x, lane error, int at) {
    return norm_of(s->inner, lane3_sub(x, get3(s->outer + 9, at)), at) * lane_set(1 + 1e-6) +
           error / get(s->inner + 6, at);
}

// inner_find_common and inner_compute_upper: the lanes with a proven common point x; its upper bound.
LANES_INLINE lane_mask find_common(const ellipsoid_columns *a, const ellipsoid_columns *b, const related *f, int at,
                                   lane3 *x, lane *upper) {
    lane zero = lane_set(0);
    lane least_a = get(a->inner + 6, at), least_b = get(b->inner + 6, at);
    lane reach = get(a->inner + 7, at) + get(b->inner + 7, at);
    lane3 center = get3(a->outer + 9, at), d = lane3_sub(get_b(f, get3(b->outer + 9, at)), center);
    lane_mask near = lane_and(lane_greater(least_a, zero), lane_greater(least_b, zero));
    near = lane_and(near, lane_less(lane3_dot(d, d), reach * reach));
    if (!lane_bits(near)) return near;

    // The point on the line of centres, or the centre itself.
    lane ka = norm_of(a->inner, d, at), kb = norm_of(b->inner, lane9_mul3_transposed(f->rotation, d), at);
    lane_mask between = lane_less(ka * kb, lane_set(0.999) * (ka + kb));
    lane_mask same = lane_not(lane_greater(ka, zero));
    *x = lane3_select(between, lane3_add_scaled(center, d, kb / (ka + kb)), center);

    // How far inside both?
    lane3 in_b = lane9_mul3_transposed(f->rotation, lane3_sub(*x, f->translation));
    lane one = lane_set(1), most = lane_set(1 - 1e-5);
    lane na = norm_in(a, *x, zero, at), nb = norm_in(b, in_b, f->claim, at);
    *upper = lane_set(-0.999) * ((one - na) * least_a + (one - nb) * least_b) - f->radii;
    lane_mask inside = lane_and(lane_less(na, most), lane_less(nb, most));
    return lane_and(lane_and(near, lane_or(between, same)), lane_and(inside, lane_less(*upper, zero)));
}

// ellipsoid_compute_spread in stages.c.
LANES_INLINE lane compute_spread(lane6 q, lane3 n) {
    return lane_max(lane3_dot(n, lane6_mul3(q, n)), lane_set(0)) + lane_set(256 * 0x1p-53) * lane6_trace(q);
}

// sym3_solve. *good loses the lanes where a pivot is not positive.
LANES_INLINE lane3 solve(lane6 s, lane3 b, lane_mask *good) {
    lane zero = lane_set(0), l10 = s.xy / s.xx, l20 = s.xz / s.xx;
    lane d1 = s.yy - l10 * s.xy, e = s.yz - l10 * s.xz, l21 = e / d1;
    lane d2 = s.zz - l20 * s.xz - l21 * e;
    lane_mask positive = lane_and(lane_greater(s.xx, zero), lane_greater(d1, zero));
    *good = lane_and(*good, lane_and(positive, lane_greater(d2, zero)));
    lane y1 = b.y - l10 * b.x, y2 = b.z - l20 * b.x - l21 * y1;
    lane z = y2 / d2, y = y1 / d1 - l21 * z;
    return (lane3){b.x / s.xx - l10 * y - l20 * z, y, z};
}

// ellipsoids_find_direction. *good loses the lanes that leave its loop early.
LANES_INLINE lane3 find_direction(lane6 qa, lane6 qb, lane3 d, lane *gap, lane_mask *good) {
    lane zero = lane_set(0), one = lane_set(1);
    const lane6 nothing = {zero, zero, zero, zero, zero, zero};
    lane3 n = lane3_unit(d, good);
    for (int round = 0;; round++) {
        lane sa = lane_sqrt(compute_spread(qa, n)), sb = lane_sqrt(compute_spread(qb, n));
        *gap = lane3_dot(n, d) - sa - sb;
        if (round == 2) return n;
        // A sum that starts from +0 is never -0, so what the single query leaves out may be added as +0.
        lane6 m = lane6_select(lane_greater(sa, zero), lane6_scale(qa, one / sa), nothing);
        m = lane6_add(lane6_add(nothing, m), lane6_select(lane_greater(sb, zero), lane6_scale(qb, one / sb), nothing));
        *good = lane_and(*good, lane_greater(sa + sb, zero));
        lane thickness = lane_max(*gap, lane_set(1e-9) * lane6_trace(m));
        m.xx = m.xx + thickness;
        m.yy = m.yy + thickness;
        m.zz = m.zz + thickness;
        n = lane3_unit(solve(m, d, good), good);
    }
}

// The gap of the enclosing spheres along the line of centres (take_spheres in answer.c).
LANES_INLINE lane compute_spheres(const octet *o, const related *f, int at, lane_mask *good) {
    lane3 d = lane3_sub(get_b(f, get3(o->center_b, at)), get3(o->center_a, at));
    return lane3_dot(lane3_unit(d, good), d) - get(&o->reach, at) - f->radii - f->claim;
}

LANES_INLINE octet_found part_lanes(const ellipsoid_columns *a, const ellipsoid_columns *b, const octet_ask *ask,
                                    octet *o, int at) {
    // frame_relate.
    lane9 world = get9(o->world_a, at);
    related f = {lane9_mul_transposed(world, get9(o->world_b, at)), lane9_mul3_transposed(world, get3(o->offset, at)),
                 get(&o->radii, at), lane_set(ask->claim) * get(&o->size, at) + lane_set(2 * ask->hidden)};
    put9(o->rotation, at, f.rotation);
    put3(o->translation, at, f.translation);
    put(&o->claim, at, f.claim);

    // Inner ellipsoids: a common point; the lower bound is that of the spheres.
    lane zero = lane_set(0), lower = zero, upper = zero;
    lane3 x = {zero, zero, zero};
    lane_mask good = lane_at_least(zero, zero), inner = find_common(a, b, &f, at, &x, &upper);
    if (lane_bits(inner)) {
        lane_mask known = good;
        lower = compute_spheres(o, &f, at, &known);
        good = lane_or(known, lane_not(inner));
        put3(o->inner, at, x);
    }

    // Outer ellipsoids; the upper bound is that of any two vertices.
    if (lane_bits(lane_not(inner))) {
        lane gap;
        lane_mask solved = good;
        lane3 d = lane3_sub(get_b(&f, get3(b->outer, at)), get3(a->outer, at));
        lane3 n =
            find_direction(get6(a->outer + 3, at), lane6_rotate(get6(b->outer + 3, at), f.rotation), d, &gap, &solved);
        put3(o->n, at, n);
        put3(o->low, at, lane3_neg(lane9_mul3_transposed(f.rotation, n)));
        lane3 any = lane3_sub(get_b(&f, get3(o->first_b, at)), get3(o->first_a, at));
        lower = lane_select(inner, lower, gap - f.radii - f.claim);
        upper = lane_select(inner, upper, lane3_norm(any) - f.radii + f.claim);
        good = lane_and(good, lane_or(inner, solved));
    }
    put(&o->lower, at, lower);
    put(&o->upper, at, upper);
    inner = lane_and(inner, good);
    lane_mask apart = lane_and(lane_and(good, lane_not(inner)), lane_greater(lower, lane_set(ask->far)));
    return (octet_found){lane_bits(lane_not(good)), lane_bits(inner), lane_bits(apart),
                         lane_bits(lane_at_most(upper - lower, get(&o->tolerance, at)))};
}

LANES_TARGET static octet_found part(const octet_ellipsoids *from, const octet_ask *ask, octet *o) {
    ellipsoid_columns a, b;
    read_columns(from->outer_a, 0, 12, a.outer);
    read_columns(from->outer_b, 0, 12, b.outer);
    read_columns(from->inner_a, 0, 8, a.inner);
    read_columns(from->inner_b, 0, 8, b.inner);
    octet_found all = {0, 0, 0, 0};
    for (int at = 0; at < OCTET; at += LANES) add_found(&all, part_lanes(&a, &b, ask, o, at), at);
    return all;
}

// ---- supports

// stage_support: the gap along n, and the length of the difference.
LANES_INLINE void meet_lanes(octet *o, int at) {
    related f = {get9(o->rotation, at), get3(o->translation, at), get(&o->radii, at), get(&o->claim, at)};
    lane gap = lane3_dot(get3(o->n, at), f.translation) - get(&o->low_value, at) - get(&o->high_value, at);
    lane3 w = lane3_sub(get_b(&f, get3(o->vertex_b, at)), get3(o->vertex_a, at));
    put3(o->w, at, w);
    put(&o->lower, at, gap - f.radii - f.claim);
    put(&o->upper, at, lane3_norm(w) - f.radii + f.claim);
}

LANES_TARGET static void meet(octet *o) {
    for (int at = 0; at < OCTET; at += LANES) meet_lanes(o, at);
}
