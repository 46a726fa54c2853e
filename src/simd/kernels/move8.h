// The kernel of move8.h, written once over lanes; scalar.c, avx2.c and avx512.c include this after kernels/pair8.h.
#include "simd/move8.h"

// What is read of eight bodies.
typedef struct move_columns {
    lane_column from[4], from_rotation[4], to[4], to_rotation[4]; ///< the positions' fourth numbers are not read
    lane_column ball[4], reach[4], place[4], placed[4];
    lane_column low[3], high[3];
} move_columns;

LANES_INLINE void read_bodies(const move8_places *p, int end, move_columns *out) {
    read_columns((lane_rows){p->from, 0, end}, 4, out->from);
    read_columns((lane_rows){p->from, 3, end}, 4, out->from_rotation);
    read_columns((lane_rows){p->to, 0, end}, 4, out->to);
    read_columns((lane_rows){p->to, 3, end}, 4, out->to_rotation);
    read_columns((lane_rows){p->ball, 0, end}, 4, out->ball);
    read_columns((lane_rows){p->reach, 0, end}, 4, out->reach);
    read_columns((lane_rows){p->place, 0, end}, 4, out->place);
    read_columns((lane_rows){p->placed, 0, end}, 4, out->placed);
    for (int k = 0; k < end; k++)
        for (int i = 0; i < 3; i++) {
            out->low[i].lane[k] = p->room[k][i];
            out->high[i].lane[k] = p->room[k][3 + i];
        }
}

LANES_INLINE lane_mask is_equal(lane a, lane b) { return lane_and(lane_at_least(a, b), lane_at_most(a, b)); }

// The lanes in which so many numbers of two columns are the same.
LANES_INLINE lane_mask is_same(const lane_column *a, const lane_column *b, int count, int at) {
    lane_mask same = lane_not(lane_none());
    for (int i = 0; i < count; i++) same = lane_and(same, is_equal(get(a + i, at), get(b + i, at)));
    return same;
}

LANES_INLINE lane norm_of_quaternion(const lane_column *q, int at) {
    lane w = get(q, at), x = get(q + 1, at), y = get(q + 2, at), z = get(q + 3, at);
    return (w * w + x * x) + (y * y + z * z);
}

LANES_INLINE lane_mask is_near_unit(const lane_column *q, const move8_errors *errors, int at) {
    lane off = lane_abs(norm_of_quaternion(q, at) - lane_set(1));
    return lane_less(off, lane_set(errors->nearly_unit));
}

// compute_chord of quaternions of about unit length.
LANES_INLINE lane compute_chord(const lane_column *p, const lane_column *q, const move8_errors *errors, int at) {
    lane a[4], b[4];
    for (int i = 0; i < 4; i++) {
        a[i] = get(p + i, at);
        b[i] = get(q + i, at);
    }
    lane dot = (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]);
    lane sign = lane_select(lane_less(dot, lane_set(0)), lane_set(-1), lane_set(1));
    for (int i = 0; i < 4; i++) b[i] = b[i] - sign * a[i];
    lane square = (b[0] * b[0] + b[1] * b[1]) + (b[2] * b[2] + b[3] * b[3]);
    lane chord = lane_set(2) * lane_sqrt(square) * lane_set(errors->slack) + lane_set(2 * errors->nearly_unit);
    return lane_select(is_same(p, q, 4, at), lane_set(0), lane_min(chord, lane_set(2)));
}

// is_along in world/move.c.
LANES_INLINE lane_mask is_along(lane displacement, lane turn, lane low, lane high) {
    lane slack = turn + lane_set(0x1p-48) * (lane_abs(displacement) + turn);
    return lane_and(lane_at_most(displacement + slack, high), lane_at_most(slack - displacement, low));
}

LANES_INLINE void move_lanes(const move_columns *c, const move8_errors *errors, move8_result *out, int at) {
    lane_mask odd =
        lane_not(lane_and(is_near_unit(c->from_rotation, errors, at), is_near_unit(c->to_rotation, errors, at)));
    lane_mask same = lane_and(is_same(c->from, c->to, 3, at), is_same(c->from_rotation, c->to_rotation, 4, at));
    lane3 position = get3(c->to, at), before = get3(c->place, at);
    lane3 now = lane3_add(position, lane9_mul3(make_rotation(c->to_rotation, at), get3(c->ball, at)));
    lane3 displacement = lane3_sub(now, before);

    // The error of the centre, and the travel.
    lane largest = lane_max(lane_max(lane_abs(position.x), lane_abs(position.y)), lane_abs(position.z));
    lane error = lane_set(errors->center) * (largest + get(c->ball + 3, at)) + lane_set(errors->hidden);
    lane chord = compute_chord(c->from_rotation, c->to_rotation, errors, at);
    lane turn = (chord * get(c->reach, at) + (get(c->reach + 2, at) + error)) * lane_set(errors->slack);
    lane travel = get(c->place + 3, at) + turn;
    travel = travel + travel * lane_set(0x1p-51);

    // Whether the box still holds the body.
    lane3 way = lane3_sub(now, get3(c->placed, at));
    lane turned = travel - get(c->placed + 3, at);
    lane_mask in = lane_and(is_along(way.x, turned, get(c->low, at), get(c->high, at)),
                            is_along(way.y, turned, get(c->low + 1, at), get(c->high + 1, at)));
    in = lane_and(in, is_along(way.z, turned, get(c->low + 2, at), get(c->high + 2, at)));
    put3(out->place, at, now);
    put(out->place + 3, at, travel);
    put3(out->displacement, at, displacement);
    put(&out->turn, at, turn);
    put(&out->center_error, at, error);
    out->odd |= lane_bits(odd) << at;
    out->moved |= lane_bits(lane_not(same)) << at;
    out->left |= lane_bits(lane_not(in)) << at;
}

LANES_TARGET static void run_move(const move8_places *from, const move8_errors *errors, move8_result *out) {
    int end = from->count > LANES ? PAIR8 : LANES;
    unsigned lanes = (1u << from->count) - 1;
    move_columns c;
    read_bodies(from, end, &c);
    out->moved = out->left = out->odd = 0;
    for (int at = 0; at < end; at += LANES) move_lanes(&c, errors, out, at);
    out->odd &= lanes;
    out->moved &= lanes & ~out->odd;
    out->left &= out->moved;
}
