// The kernels of epa8.h, written once over lanes; scalar.c, avx2.c and avx512.c include this. Every
// number is computed lane by lane, minima and maxima do not depend on an order, ties go to the lowest index: so all
// widths give the same bits.
#include "simd/kernels/epa8/surface.h"

enum { MOST = 64 };

// ---- supports

#if LANES == 1
LANES_INLINE support_result find_one(const simd_points *p, lane3 n) {
    return simd_find_support(p, &(vec3){n.x, n.y, n.z});
}
#else
LANES_INLINE lane3 point_lanes(const simd_points *p, uint32_t at) {
    return (lane3){lane_load(p->x + at), lane_load(p->y + at), lane_load(p->z + at)};
}

// The greatest of `count` points along n, of several the first; count is a constant, so that all values stay in
// registers.
LANES_INLINE support_result find_among(const simd_points *p, lane3 n, uint32_t count) {
    lane value[MOST / LANES], most = value[0] = lane3_dot(point_lanes(p, 0), n);
    for (uint32_t i = 1; i < count / LANES; i++) {
        value[i] = lane3_dot(point_lanes(p, LANES * i), n);
        most = lane_top(most, value[i]);
    }
    most = lane_find_max(most);
    uint64_t equal = lane_bits(lane_at_least(value[0], most));
    for (uint32_t i = 1; i < count / LANES; i++)
        equal |= (uint64_t)lane_bits(lane_at_least(value[i], most)) << LANES * i;
    return (support_result){lane_first(most) + 0.0, equal ? (uint32_t)__builtin_ctzll(equal) : 0};
}

LANES_INLINE support_result find_one(const simd_points *p, lane3 n) {
    if (p->padded_count == 8) return find_among(p, n, 8);
    if (p->padded_count == 16) return find_among(p, n, 16);
    if (p->padded_count == 24) return find_among(p, n, 24);
    if (p->padded_count == 32) return find_among(p, n, 32);
    return find_among(p, n, p->padded_count);
}
#endif

// is_own: a constant, so that neither loop has the other's way in it.
LANES_INLINE simd_difference find_difference(const epa8_query *q, int is_own, double x, double y, double z) {
    if (is_own) return q->find(q->bodies, (vec3){x, y, z});
    support_result b = find_one(&q->b, (lane3){lane_set(x), lane_set(y), lane_set(z)});
    support_result a = find_one(&q->a, (lane3){lane_set(-x), lane_set(-y), lane_set(-z)});
    uint32_t i = a.index, k = b.index;
    return (simd_difference){
        -b.value - a.value, q->b.x[k] - q->a.x[i], q->b.y[k] - q->a.y[i], q->b.z[k] - q->a.z[i], i, k};
}

// ---- growth

LANES_INLINE void set_point(epa8 *s, uint32_t i, const simd_difference *point) {
    s->w[0][i] = point->x, s->w[1][i] = point->y, s->w[2][i] = point->z;
    s->a[i] = point->a, s->b[i] = point->b;
}
LANES_INLINE vec3 get_point(const epa8 *s, uint32_t i) { return (vec3){s->w[0][i], s->w[1][i], s->w[2][i]}; }

LANES_INLINE int has_point(const epa8 *s, const simd_difference *point) {
    int found = 0;
    for (uint32_t i = 0; i < s->points; i++) found |= s->a[i] == point->a && s->b[i] == point->b;
    return found;
}

// The next of the first four points: the support toward the origin of the point, line or plane that there is, as GJK
// would take it. The direction has the length that it comes with: no gap is taken from it.
LANES_INLINE vec3 find_toward(const epa8 *s) {
    vec3 w = get_point(s, 0);
    if (s->points == 1) return vec3_neg(w);
    vec3 e1 = vec3_sub(get_point(s, 1), w);
    if (s->points == 2) {
        double square = vec3_norm_squared(e1);
        return square > 0 ? vec3_add_scaled(vec3_neg(w), e1, vec3_dot(w, e1) / square) : vec3_neg(w);
    }
    vec3 n = vec3_cross(e1, vec3_sub(get_point(s, 2), w));
    return vec3_dot(n, w) < 0 ? n : vec3_neg(n);
}

// Four points by supports toward the origin; then the sign of their volume, 0 where they are near a plane.
LANES_INLINE int complete(epa8 *s, const epa8_query *q, int is_own) {
    while (s->points < EPA8_START) {
        vec3 n = find_toward(s);
        simd_difference point = find_difference(q, is_own, n.x, n.y, n.z);
        if (has_point(s, &point)) return 0;
        set_point(s, s->points++, &point);
    }
    vec3 w = get_point(s, 0), e1 = vec3_sub(get_point(s, 1), w), e2 = vec3_sub(get_point(s, 2), w);
    vec3 e3 = vec3_sub(get_point(s, 3), w);
    double volume = vec3_dot(vec3_cross(e1, e2), e3);
    double edges = vec3_norm_squared(e1) * vec3_norm_squared(e2) * vec3_norm_squared(e3);
    return volume * volume > 1e-12 * edges ? volume < 0 ? -1 : 1 : 0;
}

// The surface of the first four points, counter-clockwise from outside by the sign. 0 if a face is a sliver.
LANES_INLINE int make_tetrahedron(epa8 *s, const epa8_query *q, int sign) {
    static const uint8_t start_corners[2][3][EPA8_START] = {{{3, 3, 3, 0}, {0, 1, 2, 2}, {1, 2, 0, 1}},
                                                            {{3, 3, 3, 0}, {1, 2, 0, 1}, {0, 1, 2, 2}}};
    const uint8_t(*v)[EPA8_START] = start_corners[sign < 0];
    // Stored again at full width, which is how they are read.
    for (int k = 0; k < 3; k++) lane_store_four(s->w[k], s->w[k][0], s->w[k][1], s->w[k][2], s->w[k][3]);
    s->groups = 1;
    s->alive[0] = 0xf;
    s->alive[1] = s->inward[0] = s->inward[1] = 0;
    for (uint32_t i = 0; i < EPA8_START; i += LANES) {
        uint32_t at[3] = {0, 0, 0};
        for (uint32_t j = EPA8_START; j-- > i;)
            for (int k = 0; k < 3; k++) at[k] = at[k] << 8 | v[k][j];
        unsigned inward, all = ((1u << LANES) - 1) & (0xfu >> i);
        lane3 c = pick_points(s, at[0]), from = pick_points(s, at[1]), to = pick_points(s, at[2]);
        if (~set_planes(s, q, i, c, from, to, &inward) & all) return 0;
        s->inward[0] |= (inward & all) << i;
    }
    for (uint32_t i = 0; i < EPA8_START; i++) set_corners(s, i, v[0][i], v[1][i], v[2][i]);
    return 1;
}

// The surface of four points, which supports are added to. 0 if they make none of plain faces.
LANES_INLINE int make_first(epa8 *s, const epa8_query *q, int is_own) {
    int sign = complete(s, q, is_own);
    return sign && make_tetrahedron(s, q, sign);
}

// ---- a surface that is kept: its faces are in the first places, in order

LANES_INLINE lane3 pick_corners(const epa8 *s, uint32_t face, uint32_t k) {
    const uint8_t(*v)[4] = (const uint8_t(*)[4])s->v + face;
    int is_few = s->points <= 16;
    return (lane3){lane_pick_corners(s->w[0], v, k, is_few), lane_pick_corners(s->w[1], v, k, is_few),
                   lane_pick_corners(s->w[2], v, k, is_few)};
}

// The corners of the faces, up to a full group. 0 if the surface is not closed: if an edge is there twice or its
// reverse is not, or a corner is no point. An edge is a bit at its first corner, and at its last one 32 places higher.
LANES_INLINE int take_kept_faces(epa8 *s, const epa8_kept *kept) {
    const uint16_t(*triangles)[3] = kept->triangles;
    uint64_t edges[EPA8_POINTS] = {0}, odd = 0, twice = 0;
    uint32_t faces = kept->faces, all = 0;
    for (uint32_t f = 0; f < faces; f++) {
        uint32_t i = triangles[f][0], j = triangles[f][1], k = triangles[f][2], packed = i | j << 8 | k << 16;
        all |= i | j | k;
        i %= EPA8_POINTS, j %= EPA8_POINTS, k %= EPA8_POINTS;
        uint64_t at_i = 1ull << i, at_j = 1ull << j, at_k = 1ull << k;
        __builtin_memcpy(s->v[f], &packed, sizeof packed);
        twice |= (edges[i] & at_j) | (edges[j] & at_k) | (edges[k] & at_i);
        edges[i] |= at_j | at_k << 32;
        edges[j] |= at_k | at_i << 32;
        edges[k] |= at_i | at_j << 32;
    }
    for (uint32_t f = faces; f % EPA8; f++) __builtin_memset(s->v[f], 0, sizeof s->v[f]);
    for (uint32_t i = 0; i < s->points; i++) odd |= (edges[i] >> 32) ^ (edges[i] & 0xffffffff);
    for (uint32_t i = s->points; i < EPA8_POINTS; i++) odd |= edges[i];
    return all < EPA8_POINTS && !odd && !twice;
}

// The points, as B's in A's frame less A's; the operations are those of simd_pose_points. Places beyond the last point
// are some difference.
LANES_INLINE void take_kept_points(epa8 *s, const epa8_query *q, int is_own) {
    const double *r = q->kept->rotation, *t = q->kept->translation;
    const simd_points of_a = q->a, of_b = q->b;
    lane3 rows[3], at = {lane_set(t[0]), lane_set(t[1]), lane_set(t[2])};
    for (int k = 0; k < 3; k++) rows[k] = (lane3){lane_set(r[3 * k]), lane_set(r[3 * k + 1]), lane_set(r[3 * k + 2])};
    for (uint32_t i = 0; i < s->points; i += LANES) {
        const uint32_t *a = s->a + i, *b = s->b + i;
        lane3 p = {lane_gather(of_b.x, b), lane_gather(of_b.y, b), lane_gather(of_b.z, b)};
        if (is_own) p = lane3_add((lane3){lane3_dot(rows[0], p), lane3_dot(rows[1], p), lane3_dot(rows[2], p)}, at);
        lane_store(s->w[0] + i, p.x - lane_gather(of_a.x, a));
        lane_store(s->w[1] + i, p.y - lane_gather(of_a.y, a));
        lane_store(s->w[2] + i, p.z - lane_gather(of_a.z, a));
    }
}

// 0 if a face is a sliver or may not have the origin behind it.
LANES_INLINE int set_kept_planes(epa8 *s, const epa8_query *q) {
    uint64_t odd = 0;
    for (uint32_t at = 0; at < q->kept->faces; at += LANES) {
        unsigned inward;
        lane3 c = pick_corners(s, at, 0), u = pick_corners(s, at, 1), v = pick_corners(s, at, 2);
        unsigned plain = set_planes(s, q, at, c, u, v, &inward);
        odd |= (uint64_t)((inward | ~plain) & ((1u << LANES) - 1)) << at;
    }
    return !(odd & s->alive[0]);
}

// 0 if the faces are no surface around the origin.
LANES_INLINE int make_kept(epa8 *s, const epa8_query *q, int is_own) {
    uint32_t faces = q->kept->faces;
    s->groups = (faces + EPA8 - 1) / EPA8;
    s->alive[0] = ~0ull >> (64 - faces);
    s->alive[1] = s->inward[0] = s->inward[1] = 0;
    // The corners are stored one by one and read in groups: some time in between lets the stores end.
    if (!take_kept_faces(s, q->kept)) return 0;
    take_kept_points(s, q, is_own);
    return set_kept_planes(s, q);
}

// What a face is to its edges is needed only where a point is joined.
LANES_INLINE void link_kept(epa8 *s, uint32_t faces) {
    for (uint32_t f = 0; f < faces; f++) set_corners(s, f, s->v[f][0], s->v[f][1], s->v[f][2]);
}

// ---- growth by supports

// Joins a point to the surface. 0 if no face sees it, or that is not for here: then nothing is changed.
LANES_INLINE int join(epa8 *s, const epa8_query *q, const simd_difference *point) {
    uint64_t seen[2];
    rim r;
    if (s->points == EPA8_POINTS || !find_seen(s, q, point, seen) || !find_rim(s, seen, &r)) return 0;
    if (!add_cone(s, q, s->points, (vec3){point->x, point->y, point->z}, &r)) return 0;
    // The point is stored only now: the planes' wide loads of the points would wait for a narrow store among them.
    set_point(s, s->points, point);
    for (int i = 0; i < 2; i++) s->alive[i] &= ~seen[i], s->inward[i] &= ~seen[i];
    s->points++;
    return 1;
}

// The support of the nearest face, and what it says of the gap.
LANES_INLINE simd_difference measure_support(epa8 *s, const epa8_query *q, int is_own) {
    uint32_t f = s->nearest = find_nearest_face(s);
    double n[3] = {s->n[0][f], s->n[1][f], s->n[2][f]};
    simd_difference point = find_difference(q, is_own, n[0], n[1], n[2]);
    s->supports++;
    if (point.gap > s->best_gap) {
        s->best_gap = point.gap;
        s->best_n = (vec3){n[0], n[1], n[2]};
    }
    return point;
}

LANES_INLINE epa8_end grow(epa8 *s, const epa8_query *q, int is_own) {
    s->supports = 0;
    s->best_gap = -INFINITY;
    if (!(q->kept ? make_kept(s, q, is_own) : make_first(s, q, is_own))) return EPA8_FLAT;
    while (s->supports < q->most) {
        simd_difference point = measure_support(s, q, is_own);
        double low = s->low[s->nearest], high = -point.gap;
        if (point.gap > q->claim) return EPA8_APART;
        if (low > q->claim && high - low <= q->narrow) {
            s->gap = point.gap;
            find_below(s, lane_set(low + q->near), s->near);
            return EPA8_NARROW;
        }
        if (q->kept && s->supports == 1) link_kept(s, q->kept->faces);
        if (high - low <= q->slack || !join(s, q, &point)) return EPA8_LEFT;
    }
    return EPA8_LEFT;
}

LANES_TARGET static __attribute__((noinline)) epa8_end run_own(epa8 *s, const epa8_query *q) { return grow(s, q, 1); }

LANES_INLINE epa8_end run_grow(epa8 *s, const epa8_query *q) { return q->find ? run_own(s, q) : grow(s, q, 0); }
