// The first stage of float_gjk.h, written once over lanes of floats: poses and spheres are read in doubles, of which
// only the differences of positions are computed with; all else is rounded to floats at once. The steps are those of
// kernels/pair8.h. Errors: docs/error-analysis.md.
#include "simd/kernels/float_columns.h"

// ---- rows

// Four doubles of each row, from number `from` on, rounded to floats, as columns; those of `less`, unless it is NULL,
// are subtracted before.
typedef struct float_read {
    const double *const *rows, *const *less;
    int from;
} float_read;

#if LANES == 16
// Rows k and k + 4.
LANES_INLINE __m256d read_two(const double *const *rows, int k, int from) {
    __m512d row = _mm512_castpd256_pd512(_mm256_loadu_pd(rows[k] + from));
    row = _mm512_insertf64x4(row, _mm256_loadu_pd(rows[k + 4] + from), 1);
    return _mm256_castps_pd(_mm512_cvtpd_ps(row));
}
LANES_INLINE __m256d read_two_differences(const float_read *r, int k) {
    __m512d row = _mm512_castpd256_pd512(_mm256_loadu_pd(r->rows[k] + r->from));
    __m512d less = _mm512_castpd256_pd512(_mm256_loadu_pd(r->less[k] + r->from));
    row = _mm512_insertf64x4(row, _mm256_loadu_pd(r->rows[k + 4] + r->from), 1);
    less = _mm512_insertf64x4(less, _mm256_loadu_pd(r->less[k + 4] + r->from), 1);
    return _mm256_castps_pd(_mm512_cvtpd_ps(_mm512_sub_pd(row, less)));
}
// Rows k, k + 4, k + 8 and k + 12.
LANES_INLINE lane join_rows(const float_read *r, int k) {
    __m256d first = r->less ? read_two_differences(r, k) : read_two(r->rows, k, r->from);
    __m256d second = r->less ? read_two_differences(r, k + 8) : read_two(r->rows, k + 8, r->from);
    return _mm512_castpd_ps(_mm512_insertf64x4(_mm512_castpd256_pd512(first), second, 1));
}
LANES_INLINE lane read_doubles(const double *x) {
    __m256d first = _mm256_castps_pd(_mm512_cvtpd_ps(_mm512_loadu_pd(x)));
    __m256d second = _mm256_castps_pd(_mm512_cvtpd_ps(_mm512_loadu_pd(x + 8)));
    return _mm512_castpd_ps(_mm512_insertf64x4(_mm512_castpd256_pd512(first), second, 1));
}
#elif LANES == 8
LANES_INLINE __m128 read_row(const float_read *r, int k) {
    __m256d row = _mm256_loadu_pd(r->rows[k] + r->from);
    return _mm256_cvtpd_ps(r->less ? _mm256_sub_pd(row, _mm256_loadu_pd(r->less[k] + r->from)) : row);
}
// Rows k and k + 4.
LANES_INLINE lane join_rows(const float_read *r, int k) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(read_row(r, k)), read_row(r, k + 4), 1);
}
LANES_INLINE lane read_doubles(const double *x) {
    __m128 first = _mm256_cvtpd_ps(_mm256_loadu_pd(x)), second = _mm256_cvtpd_ps(_mm256_loadu_pd(x + 4));
    return _mm256_insertf128_ps(_mm256_castps128_ps256(first), second, 1);
}
#else
LANES_INLINE void read_four(const float_read *r, int at, lane c[4]) {
    const double *row = r->rows[at] + r->from;
    for (int i = 0; i < 4; i++) c[i] = (float)(r->less ? row[i] - r->less[at][r->from + i] : row[i]);
}
LANES_INLINE lane read_doubles(const double *x) { return (float)*x; }
#endif
#if LANES > 1
LANES_INLINE void read_four(const float_read *r, int at, lane c[4]) {
    lane v[4];
    for (int i = 0; i < 4; i++) v[i] = join_rows(r, at + i);
    transpose_four(v, c);
}
#endif

// ---- the spheres around the origins

// Both poses as they are read: the rotations wxyz and the squares of their norms, from A's origin to B's.
typedef struct float_pair {
    lane a[4], b[4], square_a, square_b;
    lane3 offset;
    lane length, extents, size;
} float_pair;

LANES_INLINE lane find_square(const lane q[4]) { return (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3]); }

LANES_INLINE float_pair read_pair(const float_rows *from, int at) {
    lane d[4];
    float_pair p;
    read_four(&(float_read){from->pose_b, from->pose_a, 0}, at, d);
    read_four(&(float_read){from->pose_a, NULL, 3}, at, p.a);
    read_four(&(float_read){from->pose_b, NULL, 3}, at, p.b);
    p.square_a = find_square(p.a);
    p.square_b = find_square(p.b);
    p.offset = (lane3){d[0], d[1], d[2]};
    p.length = lane3_norm(p.offset);
    p.extents = read_doubles(from->extents + at);
    p.size = p.extents + p.length;
    return p;
}

LANES_INLINE lane_mask is_between(lane v, double least, double most) {
    return lane_and(lane_greater(v, lane_set(least)), lane_less(v, lane_set(most)));
}

// The lanes that are for floats. A coordinate of the offset that is not zero has at least the last bit of the
// positions, so these are below 2^53 times s; where it is zero they have to be read.
LANES_INLINE lane_mask find_good(const float_rows *from, const float_pair *p, unsigned some, int at) {
    lane_mask good = is_between(p->size, FLOAT_LENGTH_MIN, FLOAT_LENGTH_MAX);
    good = lane_and(good, is_between(p->square_a, 0x1p-60, 0x1p60));
    good = lane_and(good, is_between(p->square_b, 0x1p-60, 0x1p60));
    lane least = lane_min(lane_min(lane_abs(p->offset.x), lane_abs(p->offset.y)), lane_abs(p->offset.z));
    if (!(lane_bits(lane_not(lane_greater(least, lane_set(0)))) & some)) return good;
    lane place[4];
    read_four(&(float_read){from->pose_a, NULL, 0}, at, place);
    lane most = lane_max(lane_max(lane_abs(place[0]), lane_abs(place[1])), lane_abs(place[2]));
    return lane_and(good, lane_less(most, lane_set(0x1p100)));
}

// Bounds of the distance, and what they are lowered and raised by.
typedef struct float_bracket {
    lane lower, upper, claim;
} float_bracket;

// Rounding of the bounds: 6 u of s.
LANES_INLINE float_bracket measure_origins(const float_pair *p) {
    lane claim = lane_set(8 * 0x1p-24) * p->size;
    return (float_bracket){p->length - p->extents - claim, p->length + p->extents + claim, claim};
}

// ---- the enclosing spheres

// make_rotation of kernels/pair8.h: off by 21 u in norm.
LANES_INLINE lane9 make_rotation(const lane q[4], lane square) {
    lane w = q[0], x = q[1], y = q[2], z = q[3], xx = x * x, yy = y * y, zz = z * z;
    lane s = lane_set(2) / square, one = lane_set(1);
    lane xy = x * y, xz = x * z, yz = y * z, wx = w * x, wy = w * y, wz = w * z;
    return (lane9){{one - s * (yy + zz), s * (xy - wz), s * (xz + wy)},
                   {s * (xy + wz), one - s * (xx + zz), s * (yz - wx)},
                   {s * (xz - wy), s * (yz + wx), one - s * (xx + yy)}};
}

// Both bodies in the world, the spheres' centres, z.
typedef struct float_balls {
    lane9 world, world_b;
    lane3 between;
    lane distance, reach, reach_b, size;
} float_balls;

LANES_INLINE float_balls place_balls(const float_rows *from, const float_pair *p, int at) {
    float_balls f;
    lane a[4], b[4];
    read_four(&(float_read){from->shape_a, NULL, 2}, at, a);
    read_four(&(float_read){from->shape_b, NULL, 2}, at, b);
    f.world = make_rotation(p->a, p->square_a);
    f.world_b = make_rotation(p->b, p->square_b);
    lane3 center_a = lane9_mul3(f.world, (lane3){a[0], a[1], a[2]});
    lane3 center_b = lane9_mul3(f.world_b, (lane3){b[0], b[1], b[2]});
    f.between = lane3_add(p->offset, lane3_sub(center_b, center_a));
    f.distance = lane3_norm(f.between);
    f.reach_b = b[3];
    f.reach = a[3] + b[3];
    f.size = f.distance + f.reach;
    return f;
}

// Rounding: of the centres 29 u of the extents and u of the offset, of the bounds 6 u of z.
LANES_INLINE float_bracket measure_balls(const float_pair *p, const float_balls *f) {
    lane u = lane_set(0x1p-24);
    lane claim = u * (lane_set(30) * p->extents + lane_set(2) * p->length + lane_set(8) * f->size);
    return (float_bracket){f->distance - f->reach - claim, f->size + claim, claim};
}

// The numbers of the query, in a unit of the couple's own. Margins are in the range of floats: a couple's bounds are
// below 4, and no upper one is within what underflows.
LANES_INLINE void put_query(const float_rows *from, const float_balls *f, lane claim, float_query *q,
                            float_spheres *out, int at) {
    lane unit = lane_get_power(f->size), scale = lane_set(1) / unit, u = lane_set(0x1p-24);
    lane9 m = lane9_mul_transposed(f->world, f->world_b);
    lane far = lane_min(lane_set(from->far) * scale + lane_set(0x1p-100), lane_set(8));
    lane near = lane_max(lane_min(lane_set(from->near) * scale, lane_set(8)), lane_set(-1));
    lane turned = lane_set(52) * f->reach_b + lane_set(30) * f->distance;
    claim = claim + (lane_set(FLOAT_CLAIM) * f->size + u * turned);
    put3(q->rotation, at, m.r0);
    put3(q->rotation + 3, at, m.r1);
    put3(q->rotation + 6, at, m.r2);
    put3(q->translation, at, lane3_scale(lane9_mul3_transposed(f->world, f->between), scale));
    put(&q->claim, at, claim * scale);
    put(&q->far, at, far);
    put(&q->near, at, near);
    put(&q->size, at, f->size * scale);
    put(&q->scale, at, scale);
    put(&out->unit, at, unit);
}

// Lanes that the origins' spheres part keep the bounds of these, whatever the others do.
LANES_INLINE void measure_spheres(const float_rows *from, unsigned some, float_query *q, float_spheres *out, int at) {
    float_pair p = read_pair(from, at);
    float_bracket origins = measure_origins(&p), found = origins;
    lane far = lane_set(from->far);
    lane_mask is_parted = lane_greater(origins.lower, far);
    unsigned good = lane_bits(find_good(from, &p, some, at)) & some, apart = lane_bits(is_parted) & good;
    if (apart != good) {
        float_balls f = place_balls(from, &p, at);
        float_bracket balls = measure_balls(&p, &f);
        found.lower = lane_select(is_parted, origins.lower, balls.lower);
        found.upper = lane_select(is_parted, origins.upper, balls.upper);
        apart = lane_bits(lane_greater(found.lower, far)) & good;
        lane_mask is_part = lane_greater(f.size, lane_set(FLOAT_PART_MIN) * p.size);
        unsigned open = lane_bits(is_part) & good & ~apart;
        if (open) put_query(from, &f, balls.claim, q, out, at);
        out->open |= open << at;
    }
    put(&out->lower, at, found.lower);
    put(&out->upper, at, found.upper);
    put(&out->size, at, p.size);
    out->apart |= apart << at;
}

LANES_TARGET static void run_float_spheres(const float_rows *from, unsigned lanes, float_query *query,
                                           float_spheres *out) {
    out->apart = out->open = 0;
    for (int at = 0; has_more(lanes, at); at += LANES)
        if (get_lanes(lanes, at)) measure_spheres(from, get_lanes(lanes, at), query, out, at);
}
