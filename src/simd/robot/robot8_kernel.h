// The kernels of robot8.h, written once over lanes. Every step has the operations of robot/model/kinematics.h in their
// order.
#include "base/compiler.h"
#include "simd/kernels/lanes.h"
#include "simd/robot/robot8.h"

#define HALF_PI 0x1.921fb54442d18p+0
#define HALF_PI_LOW 0x1.1a62633145c07p-54

typedef struct lane4 {
    lane w, x, y, z;
} lane4;

LANES_INLINE lane get(const double *column, int at) { return lane_load(column + at); }
LANES_INLINE lane3 spread3(vec3 v) { return (lane3){lane_set(v.x), lane_set(v.y), lane_set(v.z)}; }
LANES_INLINE lane4 spread4(ovoid_quat q) { return (lane4){lane_set(q.w), lane_set(q.x), lane_set(q.y), lane_set(q.z)}; }

// The low word of a b - p, as two_product.
LANES_INLINE lane find_product_error(lane a, lane b, lane p) {
    lane split = lane_set(134217729.0), ta = split * a, tb = split * b;
    lane ah = ta - (ta - a), al = a - ah, bh = tb - (tb - b), bl = b - bh;
    return al * bl - (((p - ah * bh) - al * bh) - ah * bl);
}

// turn_compute of |x|, the sine with the sign of x.
LANES_INLINE void compute_turn(lane x, lane *cosine, lane *sine) {
    lane zero = lane_set(0), one = lane_set(1), size = lane_abs(x);
    lane k = lane_floor(size * lane_set(1 / HALF_PI) + lane_set(0.5));
    lane high = k * lane_set(HALF_PI), low = find_product_error(k, lane_set(HALF_PI), high);
    lane r = ((size - high) - low) - k * lane_set(HALF_PI_LOW), q = r * r;
    lane s = lane_set(1.0 / 355687428096000);
    s = lane_set(1.0 / 1307674368000) - q * s;
    s = lane_set(1.0 / 6227020800) - q * s;
    s = lane_set(1.0 / 39916800) - q * s;
    s = lane_set(1.0 / 362880) - q * s;
    s = lane_set(1.0 / 5040) - q * s;
    s = lane_set(1.0 / 120) - q * s;
    s = lane_set(1.0 / 6) - q * s;
    s = r - r * (q * s);
    lane c = lane_set(1.0 / 20922789888000);
    c = lane_set(1.0 / 87178291200) - q * c;
    c = lane_set(1.0 / 479001600) - q * c;
    c = lane_set(1.0 / 3628800) - q * c;
    c = lane_set(1.0 / 40320) - q * c;
    c = lane_set(1.0 / 720) - q * c;
    c = lane_set(1.0 / 24) - q * c;
    c = lane_set(0.5) - q * c;
    c = one - q * c;
    // Quadrants 0 c s, 1 -s c, 2 -c -s, 3 s -c.
    lane quadrant = k - lane_set(4) * lane_floor(k * lane_set(0.25));
    lane_mask upper = lane_greater(quadrant, lane_set(1.5));
    lane_mask odd = lane_greater(quadrant - lane_select(upper, lane_set(2), zero), lane_set(0.5));
    lane cosine_size = lane_select(odd, -s, c), sine_size = lane_select(odd, c, s);
    *cosine = lane_select(upper, -cosine_size, cosine_size);
    sine_size = lane_select(upper, -sine_size, sine_size);
    *sine = lane_select(lane_less(x, zero), -sine_size, sine_size);
}

LANES_INLINE lane4 multiply(lane4 a, lane4 b) {
    return (lane4){(a.w * b.w - a.x * b.x) - (a.y * b.y + a.z * b.z), (a.w * b.x + a.x * b.w) + (a.y * b.z - a.z * b.y),
                   (a.w * b.y - a.x * b.z) + (a.y * b.w + a.z * b.x),
                   (a.w * b.z + a.x * b.y) + (a.z * b.w - a.y * b.x)};
}

LANES_INLINE lane9 make_rotation(lane4 q) {
    lane ww = q.w * q.w, xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
    lane s = lane_set(2) / ((ww + xx) + (yy + zz)), one = lane_set(1);
    lane xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z, wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    return (lane9){{one - s * (yy + zz), s * (xy - wz), s * (xz + wy)},
                   {s * (xy + wz), one - s * (xx + zz), s * (yz - wx)},
                   {s * (xz - wy), s * (yz + wx), one - s * (xx + yy)}};
}

// Where a frame is, in another.
typedef struct lane_pose {
    lane3 p;
    lane4 q;
} lane_pose;

LANES_INLINE void put_frame(frame8 *f, int at, lane_pose pose) {
    lane3 p = pose.p;
    lane4 q = pose.q;
    lane9 r = make_rotation(q);
    const lane all[FRAME8_COLUMNS] = {p.x,    p.y,    p.z,    q.w,    q.x,    q.y,    q.z,    r.r0.x,
                                      r.r0.y, r.r0.z, r.r1.x, r.r1.y, r.r1.z, r.r2.x, r.r2.y, r.r2.z};
    for (int i = 0; i < FRAME8_COLUMNS; i++) lane_store(f->column[i] + at, all[i]);
}

// The pose of the step's own frame in its parent.
LANES_INLINE lane_pose compute_local(const chain_step *s, const double (*values)[ROBOT8], int at) {
    lane_pose own = {spread3(s->origin), spread4(s->rest)};
    uint32_t lengths = s->kind == STEP_SLIDE ? 1 : s->kind == STEP_PLANE ? 2 : s->kind == STEP_FREE ? 3 : 0;
    for (uint32_t i = 0; i < lengths; i++)
        own.p = lane3_add_scaled(own.p, spread3(s->along[i]), get(values[s->value + i], at));
    if (s->kind == STEP_TURN || s->kind == STEP_PLANE) {
        lane c, h, angle = get(values[s->value + lengths], at);
        compute_turn(lane_set(0.5) * angle, &c, &h);
        lane4 o = own.q, t = spread4(s->turned);
        own.q = (lane4){c * o.w + h * t.w, c * o.x + h * t.x, c * o.y + h * t.y, c * o.z + h * t.z};
    } else if (s->kind == STEP_FREE) {
        const double(*v)[ROBOT8] = values + s->value + 3;
        lane4 q = {get(v[0], at), get(v[1], at), get(v[2], at), get(v[3], at)};
        lane scale = lane_set(1) / lane_sqrt((q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z));
        own.q = multiply(own.q, (lane4){q.w * scale, q.x * scale, q.y * scale, q.z * scale});
    }
    return own;
}

LANES_INLINE lane9 get_rotation(const frame8 *f, int at) {
    const double(*c)[ROBOT8] = f->column;
    return (lane9){{get(c[7], at), get(c[8], at), get(c[9], at)},
                   {get(c[10], at), get(c[11], at), get(c[12], at)},
                   {get(c[13], at), get(c[14], at), get(c[15], at)}};
}
LANES_INLINE lane3 get3(const double (*column)[ROBOT8], int at) {
    return (lane3){get(column[0], at), get(column[1], at), get(column[2], at)};
}
LANES_INLINE lane sum_abs(lane3 v) { return (lane_abs(v.x) + lane_abs(v.y)) + lane_abs(v.z); }

LANES_TARGET static void run_chain(const chain_step *steps, uint32_t count, const double (*values)[ROBOT8],
                                   frame8 *frames) {
    for (uint32_t i = 0; i < count; i++) {
        const chain_step *s = &steps[i];
        for (int at = 0; at < ROBOT8; at += LANES) {
            lane_pose own = compute_local(s, values, at);
            if (s->parent != UINT32_MAX) {
                const frame8 *parent = &frames[s->parent];
                const double(*c)[ROBOT8] = parent->column;
                own.p = lane3_add(get3(c, at), lane9_mul3(get_rotation(parent, at), own.p));
                own.q = multiply((lane4){get(c[3], at), get(c[4], at), get(c[5], at), get(c[6], at)}, own.q);
            }
            put_frame(&frames[s->child], at, own);
        }
    }
}

LANES_TARGET static void run_place(const frame8 *frame, const double center[3], double reach, sphere8 *sphere) {
    lane3 local = {lane_set(center[0]), lane_set(center[1]), lane_set(center[2])};
    for (int at = 0; at < ROBOT8; at += LANES) {
        lane3 p = lane3_add(get3(frame->column, at), lane9_mul3(get_rotation(frame, at), local));
        lane_store(sphere->column[0] + at, p.x);
        lane_store(sphere->column[1] + at, p.y);
        lane_store(sphere->column[2] + at, p.z);
        lane_store(sphere->column[SPHERE8_REACH] + at, lane_set(reach) + lane_set(ROBOT8_SLACK) * sum_abs(p));
    }
}

LANES_TARGET static void run_half_turns(const double *angles, uint32_t count, double *cosines, double *sines) {
    for (uint32_t i = 0; i < count; i += LANES) {
        lane c, s;
        compute_turn(lane_set(0.5) * lane_load(angles + i), &c, &s);
        lane_store(cosines + i, c);
        lane_store(sines + i, s);
    }
}

// The square of the distance of a point to a box, from the vector between the centres.
LANES_INLINE lane compute_box_square(lane9 rotation, lane3 half, lane3 d) {
    lane3 local = lane9_mul3_transposed(rotation, d);
    lane zero = lane_set(0);
    lane3 out = {lane_max(lane_abs(local.x) - half.x, zero), lane_max(lane_abs(local.y) - half.y, zero),
                 lane_max(lane_abs(local.z) - half.z, zero)};
    return lane3_dot(out, out);
}

LANES_INLINE lane_mask is_far(lane square, lane reach) {
    return lane_greater(square * lane_set(1 - 0x1p-40), reach * reach);
}

// Most boxes are parted by the balls around them.
LANES_INLINE unsigned find_near_boxes(const box8 *boxes, lane3 p, double reach) {
    const double(*c)[ROBOT8] = boxes->column;
    unsigned bits = 0;
    for (int at = 0; at < ROBOT8; at += LANES) {
        lane3 d = lane3_sub(p, get3(c, at));
        lane_mask near = lane_not(is_far(lane3_dot(d, d), lane_set(reach) + get(c[BOX8_BALL], at)));
        if (lane_bits(near) == 0) continue;
        lane9 r = {get3(c + 3, at), get3(c + 6, at), get3(c + 9, at)};
        lane square = compute_box_square(r, get3(c + BOX8_HALF, at), d);
        lane limit = lane_set(reach) + get(c[BOX8_RADIUS], at);
        bits |= lane_bits(lane_and(near, lane_not(is_far(square, limit)))) << at;
    }
    return bits & ((1u << ROBOT8) - 1);
}

LANES_TARGET static unsigned run_near_boxes(const box8 *boxes, const double point[3], double reach) {
    return find_near_boxes(boxes, (lane3){lane_set(point[0]), lane_set(point[1]), lane_set(point[2])}, reach);
}

LANES_INLINE lane3 set3(const double (*column)[ROBOT8], uint32_t k) {
    return (lane3){lane_set(column[0][k]), lane_set(column[1][k]), lane_set(column[2][k])};
}

// The states in LANES of which a sphere is near one box.
LANES_INLINE unsigned find_near_states(const box8 *box, uint32_t k, lane3 center, lane reach) {
    const double(*c)[ROBOT8] = box->column;
    lane3 d = lane3_sub(center, set3(c, k));
    lane_mask near = lane_not(is_far(lane3_dot(d, d), reach + lane_set(c[BOX8_BALL][k])));
    if (lane_bits(near) == 0) return 0;
    lane square =
        compute_box_square((lane9){set3(c + 3, k), set3(c + 6, k), set3(c + 9, k)}, set3(c + BOX8_HALF, k), d);
    return lane_bits(lane_and(near, lane_not(is_far(square, reach + lane_set(c[BOX8_RADIUS][k])))));
}

LANES_TARGET static void run_near_boxes8(const box8 *boxes, unsigned mask, const sphere8 *sphere, const double more[2],
                                         unsigned char near[ROBOT8]) {
    const double(*c)[ROBOT8] = sphere->column;
    for (uint32_t k = 0; k < ROBOT8; k++) near[k] = 0;
    for (int at = 0; at < ROBOT8; at += LANES) {
        lane reach = (get(c[SPHERE8_REACH], at) + lane_set(more[0])) + lane_set(more[1]);
        lane3 center = get3(c, at);
        for (unsigned left = mask; left; left &= left - 1) {
            uint32_t k = compiler_count_low_zeros(left);
            near[k] |= (unsigned char)(find_near_states(boxes, k, center, reach * lane_set(1 + 0x1p-50)) << at);
        }
    }
}

LANES_TARGET static unsigned run_near_spheres(const sphere8 *a, const sphere8 *b, double margin) {
    unsigned bits = 0;
    for (int at = 0; at < ROBOT8; at += LANES) {
        lane3 d = lane3_sub(get3(b->column, at), get3(a->column, at));
        lane reach = (get(a->column[SPHERE8_REACH], at) + get(b->column[SPHERE8_REACH], at)) + lane_set(margin);
        bits |= lane_bits(lane_not(is_far(lane3_dot(d, d), reach))) << at;
    }
    return bits & ((1u << ROBOT8) - 1);
}

LANES_INLINE lane3 abs3(lane3 v) { return (lane3){lane_abs(v.x), lane_abs(v.y), lane_abs(v.z)}; }
LANES_INLINE lane3 place_middle(const linked_box8 *b, lane9 rotation, int at) {
    return lane3_add(get3(b->frame->column, at), lane9_mul3(rotation, spread3(b->middle)));
}

// A box: its axes, half sizes, and how far the other one's centre is along each axis.
typedef struct lane_box {
    lane9 axes;
    lane3 half, apart;
} lane_box;

// oriented_boxes_find_gap.
LANES_INLINE lane find_gap(const lane_box *a, const lane_box *b) {
    lane3 h = a->half, k = b->half, in_a = a->apart, in_b = b->apart;
    lane9 m = lane9_mul_transposed(a->axes, b->axes);
    lane3 r0 = abs3(m.r0), r1 = abs3(m.r1), r2 = abs3(m.r2);
    const lane gaps[6] = {in_a.x - h.x - lane3_dot(r0, k),
                          in_a.y - h.y - lane3_dot(r1, k),
                          in_a.z - h.z - lane3_dot(r2, k),
                          in_b.x - k.x - ((h.x * r0.x + h.y * r1.x) + h.z * r2.x),
                          in_b.y - k.y - ((h.x * r0.y + h.y * r1.y) + h.z * r2.y),
                          in_b.z - k.z - ((h.x * r0.z + h.y * r1.z) + h.z * r2.z)};
    lane most = gaps[0];
    for (int i = 1; i < 6; i++) most = lane_max(gaps[i], most);
    return most;
}

LANES_TARGET static unsigned run_near_linked_boxes(const linked_box8 *a, const linked_box8 *b, double margin) {
    unsigned bits = 0;
    lane3 h = spread3(a->half), k = spread3(b->half);
    lane halves = sum_abs(h) + sum_abs(k);
    for (int at = 0; at < ROBOT8; at += LANES) {
        lane9 ra = get_rotation(a->frame, at), rb = get_rotation(b->frame, at);
        lane3 ca = place_middle(a, ra, at), cb = place_middle(b, rb, at), d = lane3_sub(cb, ca);
        lane size = (sum_abs(ca) + sum_abs(cb)) + halves;
        lane reach = ((lane_set(a->radius) + lane_set(b->radius)) + lane_set(margin)) + lane_set(ROBOT8_SLACK) * size;
        lane3 in_a = abs3(lane9_mul3_transposed(ra, d)), in_b = abs3(lane9_mul3_transposed(rb, d));
        lane_mask far = lane_greater(find_gap(&(lane_box){ra, h, in_a}, &(lane_box){rb, k, in_b}), reach);
        // Along the line of centres, times its length.
        lane square = lane3_dot(d, d), along = square - lane3_dot(h, in_a) - lane3_dot(k, in_b);
        lane_mask is_parted = lane_greater(along * along * lane_set(1 - 0x1p-40), reach * reach * square);
        far = lane_or(far, lane_and(lane_greater(along, lane_set(0)), is_parted));
        bits |= lane_bits(lane_not(far)) << at;
    }
    return bits & ((1u << ROBOT8) - 1);
}

// ---- balls inside bodies

LANES_INLINE lane9 spread9(const mat3 *m) { return (lane9){spread3(m->r0), spread3(m->r1), spread3(m->r2)}; }
LANES_INLINE lane3 get_centers(const inner_balls *b, int at) {
    return (lane3){get(b->column[0], at), get(b->column[1], at), get(b->column[2], at)};
}

LANES_TARGET static void run_place_balls(const mat3 *rotation, const double position[3], const inner_balls *local,
                                         inner_balls *world) {
    lane9 r = spread9(rotation);
    lane3 p = {lane_set(position[0]), lane_set(position[1]), lane_set(position[2])};
    for (int at = 0; at < BALLS; at += LANES) {
        lane3 own = get_centers(local, at), c = lane3_add(p, lane9_mul3(r, own));
        lane size = sum_abs(own) + sum_abs(p);
        lane_store(world->column[0] + at, c.x);
        lane_store(world->column[1] + at, c.y);
        lane_store(world->column[2] + at, c.z);
        lane_store(world->column[BALLS_RADIUS] + at,
                   get(local->column[BALLS_RADIUS], at) - lane_set(ROBOT8_SLACK) * size);
    }
}

LANES_INLINE double find_greatest(lane most) {
    double all[8];
    lane_store(all, most);
    double greatest = all[0];
    for (int i = 1; i < LANES; i++) greatest = all[i] > greatest ? all[i] : greatest;
    return greatest;
}

// limit^2 - norm^2 of LANES balls, by the limit's sign.
LANES_INLINE lane compute_depths(const inner_balls *balls, int at, const inner_region *g, lane more) {
    lane zero = lane_set(0);
    lane3 own = lane9_mul3(spread9(&g->map), lane3_sub(get_centers(balls, at), spread3(g->center)));
    lane3 out = {lane_max(lane_abs(own.x) - lane_set(g->half.x), zero),
                 lane_max(lane_abs(own.y) - lane_set(g->half.y), zero),
                 lane_max(lane_abs(own.z) - lane_set(g->half.z), zero)};
    lane limit = (get(balls->column[BALLS_RADIUS], at) + more) * lane_set(g->scale) + lane_set(g->offset);
    return limit * lane_abs(limit) - lane3_dot(out, out);
}

LANES_TARGET static double run_balls_in_region(const inner_balls *balls, const inner_region *g, double more) {
    lane most = lane_set(-INFINITY);
    for (int at = 0; at < BALLS; at += LANES) most = lane_max(compute_depths(balls, at, g, lane_set(more)), most);
    return find_greatest(most);
}

// The greatest (r + s)^2 - distance^2, by the sum's sign, of one ball and all balls of another body.
LANES_INLINE lane compute_ball_depth(const inner_balls *a, uint32_t k, const inner_balls *b) {
    lane3 c = {lane_set(a->column[0][k]), lane_set(a->column[1][k]), lane_set(a->column[2][k])};
    lane radius = lane_set(a->column[BALLS_RADIUS][k]), most = lane_set(-INFINITY);
    for (int at = 0; at < BALLS; at += LANES) {
        lane3 d = lane3_sub(get_centers(b, at), c);
        lane limit = radius + get(b->column[BALLS_RADIUS], at);
        most = lane_max(limit * lane_abs(limit) - lane3_dot(d, d), most);
    }
    return most;
}

LANES_TARGET static double run_balls_in_balls(const inner_balls *a, const inner_region *around, const inner_balls *b) {
    lane zero = lane_set(0);
    unsigned meeting = 0;
    for (int at = 0; at < BALLS; at += LANES)
        meeting |= lane_bits(lane_greater(compute_depths(a, at, around, zero), zero)) << at;
    for (; meeting; meeting &= meeting - 1) {
        lane most = compute_ball_depth(a, compiler_count_low_zeros(meeting), b);
        if (lane_bits(lane_greater(most, zero))) return find_greatest(most);
    }
    return 0;
}
