// The kernels of kept8.h, written once over lanes; scalar.c, avx2.c and avx512.c include this after kernels/pair8.h.
#include "simd/kept8.h"

#include <string.h>

// ---- bounds

// Where the numbers of the pairs are; of lanes beyond `count` those of the first.
typedef struct bound_rows {
    const double *bound[PAIR8], *place_a[PAIR8], *place_b[PAIR8];
} bound_rows;

LANES_INLINE void find_rows(const kept8_bounds *all, int end, bound_rows *out) {
    for (int k = 0; k < end; k++) {
        const char *entry = (const char *)all->entries + ((unsigned)k < all->count ? (size_t)k * all->size : 0);
        uint32_t body[2];
        memcpy(body, entry, sizeof body);
        out->bound[k] = (const double *)(const void *)(entry + sizeof body);
        out->place_a[k] = all->places + 4 * (size_t)body[0];
        out->place_b[k] = all->places + 4 * (size_t)body[1];
    }
}

LANES_INLINE lane sum_abs(lane3 v) { return lane_abs(v.x) + lane_abs(v.y) + lane_abs(v.z); }

LANES_TARGET static kept8_answers run_compare(const kept8_bounds *all) {
    int end = all->count > LANES ? PAIR8 : LANES;
    bound_rows rows;
    lane_column bound[4], place_a[4], place_b[4];
    find_rows(all, end, &rows);
    read_columns((lane_rows){rows.bound, 0, end}, 4, bound);
    read_columns((lane_rows){rows.place_a, 0, end}, 4, place_a);
    read_columns((lane_rows){rows.place_b, 0, end}, 4, place_b);
    kept8_answers out = {0, 0, 0};
    for (int at = 0; at < end; at += LANES) {
        lane3 a = get3(place_a, at), b = get3(place_b, at), d = lane3_sub(b, a), v = get3(bound, at);
        lane c = get(bound + 3, at), t = get(place_a + 3, at) + get(place_b + 3, at);
        lane range = lane_load(all->ranges + at);
        lane slack = lane_set(KEPT8_SLACK) * (sum_abs(d) + t + lane_abs(c) + range) + range;
        lane way = lane3_norm(lane3_sub(d, v)), centers = lane_set(KEPT8_CENTERS) * (sum_abs(a) + sum_abs(b));
        out.plane |= lane_bits(lane_greater(c + lane3_dot(v, d) - t, slack)) << at;
        out.ball |= lane_bits(lane_greater(c - way - t, slack)) << at;
        out.sphere |= lane_bits(lane_greater(way, c + slack + centers)) << at;
    }
    return out;
}

// ---- both bodies in the world

// Both bodies placed in the world.
typedef struct kept_pair {
    lane9 world, world_b;
    lane3 offset;
    lane lower_radii, upper_radii, size;
    lane_mask good;
} kept_pair;

typedef struct kept_columns {
    lane_column position[4], rotation[4]; ///< the position's fourth number is not read
    lane_column lengths[4];
} kept_columns;

LANES_INLINE void read_kept(const double *const pose[PAIR8], const double *const lengths[PAIR8], int end,
                            kept_columns *out) {
    read_columns((lane_rows){pose, 0, end}, 4, out->position);
    read_columns((lane_rows){pose, 3, end}, 4, out->rotation);
    read_columns((lane_rows){lengths, 0, end}, 4, out->lengths);
}

// frame_place without the spheres' centres.
LANES_INLINE kept_pair place_kept(const kept_columns *a, const kept_columns *b, int at) {
    kept_pair p;
    p.good = lane_and(is_plain(a->rotation, at), is_plain(b->rotation, at));
    p.world = make_rotation(a->rotation, at);
    p.world_b = make_rotation(b->rotation, at);
    p.offset = lane3_sub(get3(b->position, at), get3(a->position, at));
    p.lower_radii = get(a->lengths, at) + get(b->lengths, at);
    p.upper_radii = get(a->lengths + 1, at) + get(b->lengths + 1, at);
    p.size = get(a->lengths + 2, at) + get(b->lengths + 2, at) + lane3_norm(p.offset) + p.lower_radii;
    return p;
}

// B's point minus A's in the world (frame_world_difference).
LANES_INLINE lane3 find_kept_difference(const kept_pair *p, lane3 a, lane3 b) {
    return lane3_add(p->offset, lane3_sub(lane9_mul3(p->world_b, b), lane9_mul3(p->world, a)));
}

// ---- gaps

// The numbers of reject_by_spheres, and those of reject_by_normal before its supports.
LANES_TARGET static unsigned run_gaps(const kept8_places *from, const kept8_errors *errors, kept8_gaps *out) {
    int end = from->count > LANES ? PAIR8 : LANES;
    kept_columns a, b;
    lane_column ball_a[4], ball_b[4], normal[4];
    read_kept(from->pose_a, from->lengths_a, end, &a);
    read_kept(from->pose_b, from->lengths_b, end, &b);
    read_columns((lane_rows){from->shape_a, 2, end}, 4, ball_a);
    read_columns((lane_rows){from->shape_b, 2, end}, 4, ball_b);
    read_columns((lane_rows){from->normal, 0, end}, 4, normal);
    unsigned odd = 0;
    for (int at = 0; at < end; at += LANES) {
        kept_pair p = place_kept(&a, &b, at);
        lane3 between = find_kept_difference(&p, get3(ball_a, at), get3(ball_b, at));
        lane distance = lane3_norm(between);
        lane claim = lane_set(errors->reject) * p.size + lane_set(3 * errors->hidden);
        lane3 n = lane3_unit(get3(normal, at), &p.good);
        put3(out->n, at, n);
        put3(out->in_a, at, lane9_mul3_transposed(p.world, n));
        put3(out->in_b, at, lane3_neg(lane9_mul3_transposed(p.world_b, n)));
        put3(out->between, at, between);
        put(&out->distance, at, distance);
        put(&out->along, at, lane3_dot(n, p.offset));
        put(&out->radii, at, p.lower_radii);
        put(&out->claim, at, claim);
        put(&out->sphere, at, distance - (get(ball_a + 3, at) + get(ball_b + 3, at)) - p.lower_radii - claim);
        odd |= lane_bits(lane_not(p.good)) << at;
    }
    return odd & ((1u << end) - 1);
}

// ---- depths

// A face of the tetrahedron (measure_faces in pair/hull.c): the determinant of the origin with it, the square of twice
// its area.
LANES_INLINE void measure_face(lane3 a, lane3 b, lane3 c, lane *det, lane *square) {
    *det = lane3_dot(a, lane3_cross(b, c));
    lane3 n = lane3_cross(lane3_sub(b, a), lane3_sub(c, a));
    *square = lane3_dot(n, n);
}

LANES_INLINE lane find_largest(lane3 w, lane most) {
    return lane_max(lane_max(lane_abs(w.x), lane_abs(w.y)), lane_max(lane_abs(w.z), most));
}

// tetrahedron_depth in pair/hull.c where no number has to be scaled; *good loses the lanes that are in doubt.
LANES_INLINE lane compute_tetrahedron_depth(const lane3 w[4], lane error, lane_mask *good) {
    lane reach = lane_set(0), depth = lane_set(INFINITY), det[4], square[4];
    for (int i = 0; i < 4; i++) reach = find_largest(w[i], reach);
    *good = lane_and(*good, lane_and(lane_greater(reach, lane_set(1e-60)), lane_less(reach, lane_set(1e60))));
    measure_face(w[1], w[3], w[2], &det[0], &square[0]);
    measure_face(w[0], w[2], w[3], &det[1], &square[1]);
    measure_face(w[0], w[3], w[1], &det[2], &square[2]);
    measure_face(w[0], w[1], w[2], &det[3], &square[3]);
    reach = lane_set(2) * reach;
    lane u = lane_set(0x1p-53);
    lane slack = reach * reach * (lane_set(4) * error + lane_set(64) * u * reach);
    lane more = lane_set(8) * reach * (error + lane_set(4) * u * reach);
    lane_mask above = lane_not(lane_none()), below = above, some_above = lane_none(), some_below = lane_none();
    for (int i = 0; i < 4; i++) {
        lane_mask is_above = lane_greater(det[i], slack), is_below = lane_less(det[i], -slack);
        above = lane_and(above, is_above);
        below = lane_and(below, is_below);
        some_above = lane_or(some_above, is_above);
        some_below = lane_or(some_below, is_below);
        depth = lane_min(depth, (lane_abs(det[i]) - slack) / (lane_sqrt(square[i]) + more) * lane_set(1 - 0x1p-50));
    }
    lane_mask inside = lane_or(above, below), outside = lane_and(some_above, some_below);
    *good = lane_and(*good, lane_or(inside, outside));
    return lane_select(inside, depth, lane_set(0));
}

// measure_overlap in world/pair_revalidate.c for proofs of four differences.
LANES_TARGET static unsigned run_depths(const kept8_places *from, const kept8_errors *errors, lane_column *upper) {
    int end = from->count > LANES ? PAIR8 : LANES;
    kept_columns a, b;
    read_kept(from->pose_a, from->lengths_a, end, &a);
    read_kept(from->pose_b, from->lengths_b, end, &b);
    unsigned odd = 0;
    for (int at = 0; at < end; at += LANES) {
        kept_pair p = place_kept(&a, &b, at);
        lane claim = lane_set(errors->claim) * p.size + lane_set(2 * errors->hidden);
        lane3 w[4];
        for (int i = 0; i < 4; i++)
            w[i] = find_kept_difference(&p, read_points(from->vertex_a[i], at), read_points(from->vertex_b[i], at));
        lane depth = compute_tetrahedron_depth(w, claim, &p.good);
        put(upper, at, lane_select(lane_greater(depth, lane_set(0)), -depth - p.upper_radii, lane_set(0)));
        odd |= lane_bits(lane_not(p.good)) << at;
    }
    return odd & ((1u << end) - 1);
}
