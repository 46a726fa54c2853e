// The kernels of pair8.h, written once over lanes; scalar.c, avx2.c and avx512.c include this. The error bounds of the
// single query (pair/frame.h, reject.h) hold for the lanes, since the steps have its operations in their order.
#include "simd/kernels/lane_columns.h"

// ---- columns

LANES_INLINE lane6 get6(const lane_column *c, int at) {
    return (lane6){get(c, at), get(c + 1, at), get(c + 2, at), get(c + 3, at), get(c + 4, at), get(c + 5, at)};
}
LANES_INLINE void put6(lane_column *c, int at, lane6 v) {
    put(c, at, v.xx);
    put(c + 1, at, v.xy);
    put(c + 2, at, v.xz);
    put(c + 3, at, v.yy);
    put(c + 4, at, v.yz);
    put(c + 5, at, v.zz);
}
LANES_INLINE lane9 get9(const lane_column *c, int at) { return (lane9){get3(c, at), get3(c + 3, at), get3(c + 6, at)}; }
LANES_INLINE void put9(lane_column *c, int at, lane9 m) {
    put3(c, at, m.r0);
    put3(c + 3, at, m.r1);
    put3(c + 6, at, m.r2);
}

// The lanes that are computed: one vector of them where these are all that are in use. Kernels are compiled for either
// number, as loops of a known length take a seventh fewer instructions.
LANES_INLINE int get_end(const pair8 *o) { return o->count > LANES ? PAIR8 : LANES; }

// Rows of lanes in use, the numbers `from` on of each.
typedef struct lane_rows {
    const double *const *at;
    int from, end;
} lane_rows;

// `count` (even) numbers of the rows as columns.
#if LANES == 8
// Two numbers of the even rows beside each other, and of the odd ones: a shuffle each makes columns of them.
LANES_INLINE __m512d read_two(const double *const rows[PAIR8], int first, int from) {
    __m512 v = _mm512_castpd_ps(_mm512_castpd128_pd512(_mm_loadu_pd(rows[first] + from)));
    v = _mm512_mask_broadcast_f32x4(v, 0x00f0, _mm_castpd_ps(_mm_loadu_pd(rows[first + 2] + from)));
    v = _mm512_mask_broadcast_f32x4(v, 0x0f00, _mm_castpd_ps(_mm_loadu_pd(rows[first + 4] + from)));
    v = _mm512_mask_broadcast_f32x4(v, 0xf000, _mm_castpd_ps(_mm_loadu_pd(rows[first + 6] + from)));
    return _mm512_castps_pd(v);
}
LANES_INLINE void read_columns(lane_rows rows, int count, lane_column *out) {
    for (int k = 0; k < count; k += 2) {
        __m512d even = read_two(rows.at, 0, rows.from + k), odd = read_two(rows.at, 1, rows.from + k);
        _mm512_store_pd(out[k].lane, _mm512_unpacklo_pd(even, odd));
        _mm512_store_pd(out[k + 1].lane, _mm512_unpackhi_pd(even, odd));
    }
}
#elif LANES == 4
LANES_INLINE __m256d read_two(const double *const rows[PAIR8], int first, int from) {
    __m256d v = _mm256_castpd128_pd256(_mm_loadu_pd(rows[first] + from));
    return _mm256_insertf128_pd(v, _mm_loadu_pd(rows[first + 2] + from), 1);
}
LANES_INLINE void read_columns(lane_rows rows, int count, lane_column *out) {
    for (int k = 0; k < count; k += 2)
        for (int at = 0; at < rows.end; at += LANES) {
            __m256d even = read_two(rows.at, at, rows.from + k), odd = read_two(rows.at, at + 1, rows.from + k);
            _mm256_store_pd(out[k].lane + at, _mm256_unpacklo_pd(even, odd));
            _mm256_store_pd(out[k + 1].lane + at, _mm256_unpackhi_pd(even, odd));
        }
}
#else
LANES_INLINE void read_columns(lane_rows rows, int count, lane_column *out) {
    for (int i = 0; i < rows.end; i++)
        for (int k = 0; k < count; k++) out[k].lane[i] = rows.at[i][rows.from + k];
}
#endif

// Points, three numbers each, as lanes: registers are filled from memory, as numbers that were just stored one by one
// would be waited for.
LANES_INLINE lane3 read_points(const double *const points[PAIR8], int at) {
#if LANES == 8
    (void)at;
    __m512d even = read_two(points, 0, 0), odd = read_two(points, 1, 0);
    __m512d even_z = read_two(points, 0, 1), odd_z = read_two(points, 1, 1);
    return (lane3){_mm512_unpacklo_pd(even, odd), _mm512_unpackhi_pd(even, odd), _mm512_unpackhi_pd(even_z, odd_z)};
#elif LANES == 4
    __m256d even = read_two(points, at, 0), odd = read_two(points, at + 1, 0);
    __m256d even_z = read_two(points, at, 1), odd_z = read_two(points, at + 1, 1);
    return (lane3){_mm256_unpacklo_pd(even, odd), _mm256_unpackhi_pd(even, odd), _mm256_unpackhi_pd(even_z, odd_z)};
#else
    double x[LANES], y[LANES], z[LANES];
    for (int i = 0; i < LANES; i++) {
        x[i] = points[at + i][0];
        y[i] = points[at + i][1];
        z[i] = points[at + i][2];
    }
    return (lane3){lane_load(x), lane_load(y), lane_load(z)};
#endif
}

// ---- poses and spheres

// The lanes whose quaternion need not be scaled.
LANES_INLINE lane_mask is_plain(const lane_column *q, int at) {
    lane w = get(q, at), x = get(q + 1, at), y = get(q + 2, at), z = get(q + 3, at);
    lane norm = (w * w + x * x) + (y * y + z * z);
    return lane_and(lane_greater(norm, lane_set(0x1p-60)), lane_less(norm, lane_set(0x1p60)));
}

// quat_to_mat3, of plain quaternions.
LANES_INLINE lane9 make_rotation(const lane_column *q, int at) {
    lane w = get(q, at), x = get(q + 1, at), y = get(q + 2, at), z = get(q + 3, at);
    lane ww = w * w, xx = x * x, yy = y * y, zz = z * z, norm = (ww + xx) + (yy + zz);
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
    lane_column position[4]; ///< and the rotation's first number
    lane_column rotation[4];
    lane_column head[6];
    lane_column first[4]; ///< vertex 0, what is behind it
} body_columns;

typedef struct pair_columns {
    body_columns a, b;
} pair_columns;

// The claim of reject_by_spheres.
LANES_INLINE lane compute_claim(const pair8_query *query, lane size) {
    return lane_set(query->reject) * size + lane_set(3 * query->hidden);
}

// The numbers of frame_place that need no rotation, and the bounds of the spheres around the origins of the body
// frames. No two vertices are farther apart than the far sides of these spheres.
LANES_INLINE pair8_found compute_origins(const pair_columns *from, const pair8_query *query, pair8 *o, int at) {
    const body_columns *a = &from->a, *b = &from->b;
    lane3 origin = get3(a->position, at), origin_b = get3(b->position, at);
    lane_mask good = lane_and(is_in_reach(origin, query->length_most), is_in_reach(origin_b, query->length_most));
    good = lane_and(good, lane_and(is_plain(a->rotation, at), is_plain(b->rotation, at)));
    lane3 offset = lane3_sub(origin_b, origin);
    lane radii = get(a->head, at) + get(b->head, at), extents = get(a->head + 1, at) + get(b->head + 1, at);
    lane distance = lane3_norm(offset), size = extents + distance + radii, claim = compute_claim(query, size);
    lane lower = distance - extents - radii - claim, upper = distance + extents - radii + claim;
    lane tolerance =
        lane_max(lane_set(query->absolute), lane_set(query->relative) * size) + lane_set(8 * query->hidden);
    unsigned apart = lane_bits(lane_and(good, lane_greater(lower, lane_set(query->far))));
    put3(o->offset, at, offset);
    put(&o->radii, at, radii);
    put(&o->size, at, size);
    put(&o->tolerance, at, tolerance);
    put(&o->lower, at, lower);
    put(&o->upper, at, upper);
    return (pair8_found){lane_bits(lane_not(good)), 0, apart, apart, lane_bits(lane_at_most(upper - lower, tolerance))};
}

// The rest of frame_place, reject_by_spheres and the bounds of rejection_make_answer. Lanes that the origins' spheres
// part keep the bounds of these.
LANES_INLINE pair8_found compute_spheres(const pair_columns *from, const pair8_query *query, pair8 *o, int at) {
    const body_columns *a = &from->a, *b = &from->b;
    lane far = lane_set(query->far), size = get(&o->size, at), radii = get(&o->radii, at);
    lane3 offset = get3(o->offset, at);
    lane9 world = make_rotation(a->rotation, at), world_b = make_rotation(b->rotation, at);
    lane reach = get(a->head + 5, at) + get(b->head + 5, at), claim = compute_claim(query, size);

    // The enclosing spheres.
    lane3 center_a = get3(a->head + 2, at), center_b = get3(b->head + 2, at);
    lane3 d = lane3_add(offset, lane3_sub(lane9_mul3(world_b, center_b), lane9_mul3(world, center_a)));
    lane_mask origin = lane_greater(get(&o->lower, at), far);
    lane lower = lane_select(origin, get(&o->lower, at), lane3_norm(d) - reach - radii - claim);

    // Any two vertices, for the upper bound.
    lane3 first_a = get3(a->first, at), first_b = get3(b->first, at);
    lane3 any = lane3_add(offset, lane3_sub(lane9_mul3(world_b, first_b), lane9_mul3(world, first_a)));
    lane upper = lane_select(origin, get(&o->upper, at), lane3_norm(any) - radii + claim);
    put(&o->lower, at, lower);
    put(&o->upper, at, upper);
    put3(o->center_a, at, center_a);
    put3(o->center_b, at, center_b);
    put3(o->first_a, at, first_a);
    put3(o->first_b, at, first_b);
    put(&o->reach, at, reach);
    put9(o->world_a, at, world);
    put9(o->world_b, at, world_b);
    put3(o->between, at, d);
    return (pair8_found){0, 0, lane_bits(lane_greater(lower, far)), 0,
                         lane_bits(lane_at_most(upper - lower, get(&o->tolerance, at)))};
}

static void add_found(pair8_found *all, pair8_found some, int at) {
    all->odd |= some.odd << at;
    all->inner |= some.inner << at;
    all->apart |= some.apart << at;
    all->origin |= some.origin << at;
    all->narrow |= some.narrow << at;
}

LANES_INLINE pair8_found find_spheres(const pair8_places *from, const pair8_query *query, pair8 *o, int end) {
    pair_columns c;
    read_columns((lane_rows){from->pose_a, 0, end}, 4, c.a.position);
    read_columns((lane_rows){from->pose_b, 0, end}, 4, c.b.position);
    read_columns((lane_rows){from->pose_a, 3, end}, 4, c.a.rotation);
    read_columns((lane_rows){from->pose_b, 3, end}, 4, c.b.rotation);
    read_columns((lane_rows){from->shape_a, 0, end}, 2, c.a.head);
    read_columns((lane_rows){from->shape_b, 0, end}, 2, c.b.head);
    pair8_found origins = {0, 0, 0, 0, 0}, all = {0, 0, 0, 0, 0};
    for (int at = 0; at < end; at += LANES) add_found(&origins, compute_origins(&c, query, o, at), at);
    if (!query->keeps_all && origins.apart == (1u << end) - 1) return origins;
    read_columns((lane_rows){from->shape_a, 2, end}, 4, c.a.head + 2);
    read_columns((lane_rows){from->shape_b, 2, end}, 4, c.b.head + 2);
    read_columns((lane_rows){from->shape_a, 8, end}, 4, c.a.first);
    read_columns((lane_rows){from->shape_b, 8, end}, 4, c.b.first);
    for (int at = 0; at < end; at += LANES) add_found(&all, compute_spheres(&c, query, o, at), at);
    return (pair8_found){origins.odd, 0, all.apart & ~origins.odd, origins.apart, all.narrow};
}

LANES_TARGET static pair8_found run_spheres(const pair8_places *from, const pair8_query *query, pair8 *o) {
    return get_end(o) == PAIR8 ? find_spheres(from, query, o, PAIR8) : find_spheres(from, query, o, LANES);
}

// ---- ellipsoids
//
// The steps are long chains of divisions and roots, each waiting for the one before. So each step is done for all
// groups before the next one begins: while one waits, others go on.

// B in the frame of A.
typedef struct related {
    lane9 rotation;
    lane3 translation;
    lane radii, claim;
} related;

// A lane group, and what its steps hand on.
typedef struct ellipsoid_work {
    lane_column qa[6], qb[6], d[3], gap; ///< the outer ellipsoids, B's turned into the frame; between their centres
    lane_column inner_upper;
    lane_column good;     ///< 1 in lanes that stayed in the common case so far, else 0
    lane_column is_inner; ///< 1 in lanes decided by the inner ellipsoids, else 0
    pair8 *o;
    const pair8_query *query;
    int is_searching; ///< 1 if any lane searches for the ellipsoids' direction
} ellipsoid_work;

LANES_INLINE related get_related(const pair8 *o, int at) {
    return (related){get9(o->rotation, at), get3(o->translation, at), get(&o->radii, at), get(&o->claim, at)};
}
LANES_INLINE lane3 get_b(const related *f, lane3 x) { return lane3_add(lane9_mul3(f->rotation, x), f->translation); }

LANES_INLINE lane_mask get_mask(const lane_column *c, int at) { return lane_greater(get(c, at), lane_set(0)); }
LANES_INLINE void put_mask(lane_column *c, int at, lane_mask m) {
    put(c, at, lane_select(m, lane_set(1), lane_set(0)));
}

// frame_relate.
LANES_INLINE related make_related(const pair8_query *query, pair8 *o, int at) {
    lane9 world = get9(o->world_a, at);
    related f = {lane9_mul_transposed(world, get9(o->world_b, at)), lane9_mul3_transposed(world, get3(o->offset, at)),
                 get(&o->radii, at), lane_set(query->claim) * get(&o->size, at) + lane_set(2 * query->hidden)};
    put9(o->rotation, at, f.rotation);
    put3(o->translation, at, f.translation);
    put(&o->claim, at, f.claim);
    return f;
}

// frame_relate, and the outer ellipsoids in the frame. a, b: outer centre and Q of A, of B.
LANES_INLINE void relate(ellipsoid_work *w, const lane_column *a, const lane_column *b, int at) {
    related f = make_related(w->query, w->o, at);
    put3(w->d, at, lane3_sub(get_b(&f, get3(b, at)), get3(a, at)));
    put6(w->qa, at, get6(a + 3, at));
    put6(w->qb, at, lane6_rotate(get6(b + 3, at), f.rotation));
}

// norm_of in inner.c.
LANES_INLINE lane norm_of(const lane_column *w, lane3 y, int at) {
    lane3 v = {get(w, at) * y.x, get(w + 1, at) * y.x + get(w + 2, at) * y.y,
               (get(w + 3, at) * y.x + get(w + 4, at) * y.y) + get(w + 5, at) * y.z};
    return lane3_norm(v);
}

// norm_in in inner.c, of a point without an error.
LANES_INLINE lane norm_in(const lane_column *w, lane3 center, lane3 x, int at) {
    return norm_of(w, lane3_sub(x, center), at) * lane_set(1 + 1e-6);
}

// What is read of an inner ellipsoid: its centre; W, the least radius, the largest.
typedef struct inner_columns {
    lane_column center[4], w[8];
} inner_columns;

// A common point of the inner ellipsoids, its upper bound, and the lanes in which it is proven.
typedef struct common_point {
    lane_mask is_proven;
    lane3 x;
    lane upper;
} common_point;

// inner_find_common and inner_compute_upper.
LANES_INLINE common_point find_common(const inner_columns *a, const inner_columns *b, const related *f, int at) {
    lane zero = lane_set(0), least_a = get(a->w + 6, at), least_b = get(b->w + 6, at);
    lane reach = get(a->w + 7, at) + get(b->w + 7, at);
    lane3 center = get3(a->center, at), center_b = get3(b->center, at), d = lane3_sub(get_b(f, center_b), center);
    lane_mask near = lane_and(lane_greater(least_a, zero), lane_greater(least_b, zero));
    near = lane_and(near, lane_less(lane3_dot(d, d), reach * reach));
    if (!lane_bits(near)) return (common_point){near, {zero, zero, zero}, zero};

    // The point on the line of centres, or the centre itself.
    lane ka = norm_of(a->w, d, at), kb = norm_of(b->w, lane9_mul3_transposed(f->rotation, d), at);
    lane_mask between = lane_less(ka * kb, lane_set(0.999) * (ka + kb));
    lane_mask same = lane_not(lane_greater(ka, zero));
    lane3 x = lane3_select(between, lane3_add_scaled(center, d, kb / (ka + kb)), center);

    // How far inside both?
    lane3 in_b = lane9_mul3_transposed(f->rotation, lane3_sub(x, f->translation));
    lane one = lane_set(1), most = lane_set(1 - 1e-5);
    lane na = norm_in(a->w, center, x, at), nb = norm_in(b->w, center_b, in_b, at) + f->claim / least_b;
    lane upper = lane_set(-0.999) * ((one - na) * least_a + (one - nb) * least_b) - f->radii;
    lane_mask inside = lane_and(lane_less(na, most), lane_less(nb, most));
    lane_mask is_proven = lane_and(lane_and(near, lane_or(between, same)), lane_and(inside, lane_less(upper, zero)));
    return (common_point){is_proven, x, upper};
}

// inner_compute_upper_in_world, and small_run_inner's test of the line of centres.
LANES_INLINE unsigned find_common_in_world(const inner_columns *a, const inner_columns *b, const pair8_query *query,
                                           const pair8 *o, pair8_common *out, int at) {
    lane zero = lane_set(0), one = lane_set(1), most = lane_set(1 - 1e-5), radii = get(&o->radii, at);
    lane claim = lane_set(query->claim) * get(&o->size, at) + lane_set(2 * query->hidden);
    lane least_a = get(a->w + 6, at), least_b = get(b->w + 6, at), reach = get(a->w + 7, at) + get(b->w + 7, at);
    lane3 center = get3(a->center, at), center_b = get3(b->center, at), offset = get3(o->offset, at);
    lane3 line = get3(o->between, at);
    lane9 world = get9(o->world_a, at), world_b = get9(o->world_b, at);
    lane3 d = lane3_add(offset, lane3_sub(lane9_mul3(world_b, center_b), lane9_mul3(world, center)));
    lane_mask near = lane_and(lane_greater(least_a, zero), lane_greater(least_b, zero));
    near = lane_and(near, lane_less(lane3_dot(d, d), reach * reach));
    near = lane_and(near, lane_greater(lane3_dot(line, line), lane_set(1e-150)));
    if (!lane_bits(near)) return 0;
    lane3 segment = lane9_mul3_transposed(world, d);
    lane ka = norm_of(a->w, segment, at), kb = norm_of(b->w, lane9_mul3_transposed(world_b, d), at);
    near = lane_and(near, lane_less(ka * kb, lane_set(0.999) * (ka + kb)));
    lane3 x = lane3_add_scaled(center, segment, kb / (ka + kb));
    lane3 in_b = lane9_mul3_transposed(world_b, lane3_sub(lane9_mul3(world, x), offset));
    lane na = norm_in(a->w, center, x, at), nb = norm_in(b->w, center_b, in_b, at) + lane_set(2) * claim / least_b;
    lane upper = lane_set(-0.999) * ((one - na) * least_a + (one - nb) * least_b) - radii;
    lane_mask inside = lane_and(lane_less(na, most), lane_less(nb, most));
    put3(out->x, at, x);
    put(&out->upper, at, upper);
    return lane_bits(lane_and(lane_and(near, inside), lane_less(upper, zero)));
}

LANES_INLINE void read_inner(const pair8_ellipsoids *from, int end, inner_columns *a, inner_columns *b) {
    // The tenth number is the first one of the inner centre, which follows.
    read_columns((lane_rows){from->outer_a, 9, end}, 4, a->center);
    read_columns((lane_rows){from->outer_b, 9, end}, 4, b->center);
    read_columns((lane_rows){from->inner_a, 0, end}, 8, a->w);
    read_columns((lane_rows){from->inner_b, 0, end}, 8, b->w);
}

LANES_TARGET static unsigned run_inner(const pair8_ellipsoids *from, const pair8_query *query, const pair8 *o,
                                       pair8_common *out) {
    inner_columns a, b;
    int end = get_end(o);
    unsigned all = 0;
    read_inner(from, end, &a, &b);
    for (int at = 0; at < end; at += LANES) all |= find_common_in_world(&a, &b, query, o, out, at) << at;
    return all;
}

// The gap of the enclosing spheres along the line of centres (take_spheres in answer.c).
LANES_INLINE lane compute_sphere_gap(const pair8 *o, const related *f, int at, lane_mask *good) {
    lane3 d = lane3_sub(get_b(f, get3(o->center_b, at)), get3(o->center_a, at));
    return lane3_dot(lane3_unit(d, good), d) - get(&o->reach, at) - f->radii - f->claim;
}

// Inner ellipsoids: a common point; the lower bound is that of the spheres.
LANES_INLINE unsigned compute_inner(ellipsoid_work *w, const inner_columns *a, const inner_columns *b, int at) {
    pair8 *o = w->o;
    related f = get_related(o, at);
    common_point common = find_common(a, b, &f, at);
    lane_mask good = lane_at_least(lane_set(0), lane_set(0)), inner = common.is_proven;
    put(&w->inner_upper, at, common.upper);
    if (lane_bits(inner)) {
        put(&o->lower, at, compute_sphere_gap(o, &f, at, &good));
        put3(o->inner, at, common.x);
    }
    put_mask(&w->good, at, lane_or(good, lane_not(inner)));
    put_mask(&w->is_inner, at, inner);
    return lane_bits(inner);
}

// ellipsoid_compute_spread in stages.c.
LANES_INLINE lane compute_spread(lane6 q, lane3 n) {
    return lane_max(lane3_dot(n, lane6_mul3(q, n)), lane_set(0)) + lane_set(256 * 0x1p-53) * lane6_trace(q);
}

// ellipsoids_find_direction in steps: first the line of centres (or find_line in answer.c), then one or two rounds of
// it (improve_direction). The mask loses the lanes that are scaled there, or leave its loop early.
LANES_INLINE void start_direction(ellipsoid_work *w, int at) {
    pair8 *o = w->o;
    related f = get_related(o, at);
    lane_mask line = get_mask(&o->line, at);
    lane3 d = get3(w->d, at), centers = lane3_sub(get_b(&f, get3(o->center_b, at)), get3(o->center_a, at));
    lane square = lane3_dot(d, d), most = lane_max(lane6_trace(get6(w->qa, at)), lane6_trace(get6(w->qb, at)));
    most = lane_max(most, square);
    lane_mask good = lane_and(lane_greater(most, lane_set(1e-30)), lane_less(most, lane_set(1e30)));
    good = lane_or(good, line);
    put3(o->n, at, lane3_unit(lane3_select(line, centers, d), &good));
    put(&w->gap, at, lane_set(0)); // not read of a group that takes no round
    put_mask(&w->good, at, lane_and(get_mask(&w->good, at), lane_or(good, get_mask(&w->is_inner, at))));
}

LANES_INLINE void improve_direction(ellipsoid_work *w, int is_last, int at) {
    pair8 *o = w->o;
    lane3 n = get3(o->n, at), d = get3(w->d, at);
    lane6 qa = get6(w->qa, at), qb = get6(w->qb, at);
    lane zero = lane_set(0), sa = lane_sqrt(compute_spread(qa, n)), sb = lane_sqrt(compute_spread(qb, n));
    lane apart = lane3_dot(n, d) - sa - sb;
    put(&w->gap, at, apart);
    if (is_last) return;
    lane_mask good = lane_greater(sa + sb, zero);
    lane ta = lane_select(lane_greater(sa, zero), sa, sb), tb = lane_select(lane_greater(sb, zero), sb, sa);
    lane6 m = lane6_add(lane6_scale(qa, tb), lane6_scale(qb, ta));
    lane thickness = lane_max(apart * (ta * tb), lane_set(1e-9) * lane6_trace(m));
    m.xx = m.xx + thickness;
    m.yy = m.yy + thickness;
    m.zz = m.zz + thickness;
    n = lane3_unit(lane6_mul3(lane6_adjugate(m), d), &good);
    good = lane_and(good, lane_greater(lane3_dot(n, d), zero));
    lane_mask line = get_mask(&o->line, at), ready = lane_or(line, get_mask(&w->is_inner, at));
    put3(o->n, at, lane3_select(line, get3(o->n, at), n));
    put_mask(&w->good, at, lane_and(get_mask(&w->good, at), lane_or(good, ready)));
}

// Outer ellipsoids; the upper bound is that of any two vertices.
LANES_INLINE pair8_found compute_outer(const ellipsoid_work *w, int at) {
    pair8 *o = w->o;
    related f = get_related(o, at);
    put3(o->low, at, lane3_neg(lane9_mul3_transposed(f.rotation, get3(o->n, at))));
    lane3 any = lane3_sub(get_b(&f, get3(o->first_b, at)), get3(o->first_a, at));
    lane_mask good = get_mask(&w->good, at), inner = lane_and(get_mask(&w->is_inner, at), good);
    lane lower = lane_select(inner, get(&o->lower, at), get(&w->gap, at) - f.radii - f.claim);
    lane upper = lane_select(inner, get(&w->inner_upper, at), lane3_norm(any) - f.radii + f.claim);
    put(&o->lower, at, lower);
    put(&o->upper, at, upper);
    // Lanes that took the line of centres have not measured the outer ellipsoids.
    lane_mask passed = lane_or(inner, get_mask(&o->line, at));
    lane_mask apart = lane_and(lane_and(good, lane_not(passed)), lane_greater(lower, lane_set(w->query->far)));
    return (pair8_found){lane_bits(lane_not(good)), lane_bits(inner), lane_bits(apart), 0,
                         lane_bits(lane_at_most(upper - lower, get(&o->tolerance, at)))};
}

LANES_INLINE void start_ellipsoids(const pair8_ellipsoids *from, ellipsoid_work *w, int end) {
    lane_column outer_a[10], outer_b[10];
    inner_columns a, b;
    read_columns((lane_rows){from->outer_a, 0, end}, 10, outer_a);
    read_columns((lane_rows){from->outer_b, 0, end}, 10, outer_b);
    for (int at = 0; at < end; at += LANES) relate(w, outer_a, outer_b, at);
    read_inner(from, end, &a, &b);
    unsigned inner = 0, line = 0, all = (1u << end) - 1;
    for (int at = 0; at < end; at += LANES) {
        inner |= compute_inner(w, &a, &b, at) << at;
        line |= lane_bits(get_mask(&w->o->line, at)) << at;
    }
    for (int at = 0; at < end && (all & ~inner); at += LANES) start_direction(w, at);
    w->is_searching = (all & ~(inner | line)) != 0;
}

LANES_INLINE void find_ellipsoids(pair8_group *groups, unsigned count, const pair8_query *query, int end) {
    ellipsoid_work w[PAIR8_GROUPS];
    for (unsigned i = 0; i < count; i++) {
        w[i].o = groups[i].lanes;
        w[i].query = query;
        start_ellipsoids(&groups[i].from, &w[i], end);
    }
    for (int round = 0; round <= query->rounds; round++)
        for (unsigned i = 0; i < count; i++)
            for (int at = 0; at < end && w[i].is_searching; at += LANES)
                improve_direction(&w[i], round == query->rounds, at);
    for (unsigned i = 0; i < count; i++) {
        groups[i].found = (pair8_found){0, 0, 0, 0, 0};
        for (int at = 0; at < end; at += LANES) add_found(&groups[i].found, compute_outer(&w[i], at), at);
    }
}

LANES_TARGET static void run_ellipsoids(pair8_group *groups, unsigned count, const pair8_query *query) {
    if (count > 1 || get_end(groups->lanes) == PAIR8)
        find_ellipsoids(groups, count, query, PAIR8);
    else
        find_ellipsoids(groups, 1, query, LANES);
}

// ---- supports

// stage_support: the gap along n, and the length of the difference.
LANES_INLINE void compute_supports(pair8 *o, int at) {
    related f = get_related(o, at);
    lane gap = lane3_dot(get3(o->n, at), f.translation) - get(&o->low_value, at) - get(&o->high_value, at);
    lane3 w = lane3_sub(get_b(&f, get3(o->vertex_b, at)), get3(o->vertex_a, at));
    put(&o->lower, at, gap - f.radii - f.claim);
    put(&o->upper, at, lane3_norm(w) - f.radii + f.claim);
}

LANES_TARGET static void run_supports(pair8 *o) {
    for (int at = 0; at < get_end(o); at += LANES) compute_supports(o, at);
}

// ---- single precision

LANES_INLINE void put_floats(float *to, lane v) {
#if LANES == 8
    _mm256_store_ps(to, _mm512_cvtpd_ps(v));
#elif LANES == 4
    _mm_store_ps(to, _mm256_cvtpd_ps(v));
#else
    double x[LANES];
    lane_store(x, v);
    for (int i = 0; i < LANES; i++) to[i] = (float)x[i];
#endif
}

LANES_INLINE void put_floats3(float (*to)[PAIR8], int at, lane3 v) {
    put_floats(to[0] + at, v.x);
    put_floats(to[1] + at, v.y);
    put_floats(to[2] + at, v.z);
}

// B in the axes of A, about the spheres' centres, and the claim, in a unit of the pair's own. Of sizes
// far above the bodies' doubles' own errors are above those of floats.
LANES_INLINE unsigned compute_floats(const pair8 *o, const pair8_query *query, pair8_floats *out, int at) {
    lane9 a = get9(o->world_a, at), m = lane9_mul_transposed(a, get9(o->world_b, at));
    lane3 between = get3(o->between, at);
    lane size = get(&o->size, at), length = get(&o->reach, at) + lane3_norm(between);
    lane_mask good = lane_and(lane_greater(length, lane_set(0x1p-150)), lane_less(length, lane_set(0x1p150)));
    good = lane_and(good, lane_less(size, lane_set(0x1p20) * length));
    length = lane_select(good, length, lane_set(1));
    lane unit = lane_get_power(length), scale = lane_set(1) / unit;
    lane claim = lane_set(FLOAT_CLAIM) * length + (lane_set(query->reject) * size + lane_set(2 * query->hidden));
    float(*numbers)[PAIR8] = out->numbers;
    put_floats3(numbers, at, m.r0);
    put_floats3(numbers + 3, at, m.r1);
    put_floats3(numbers + 6, at, m.r2);
    put_floats3(numbers + 9, at, lane3_scale(lane9_mul3_transposed(a, between), scale));
    put_floats(numbers[12] + at, lane_select(good, claim * scale * lane_set(1 + 0x1p-22), lane_set(1)));
    put(&out->unit, at, unit);
    put(&out->scale, at, scale);
    return lane_bits(good);
}

LANES_TARGET static unsigned run_floats(const pair8 *o, const pair8_query *query, pair8_floats *out) {
    unsigned good = 0;
    for (int at = 0; at < get_end(o); at += LANES) good |= compute_floats(o, query, out, at) << at;
    return good;
}
