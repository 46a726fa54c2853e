// The kernels of cover8.h, written once over lanes; included after robot8_kernel.h.

LANES_INLINE lane3 cross3(lane3 a, lane3 b) { return lane3_cross(a, b); }
LANES_INLINE lane3 get_rate(const rate8 *r, int column, int at) { return get3(&r->column[column], at); }
LANES_INLINE void put3(double (*column)[ROBOT8], int at, lane3 v) {
    lane_store(column[0] + at, v.x);
    lane_store(column[1] + at, v.y);
    lane_store(column[2] + at, v.z);
}

// B r = bend x r + turn x (turn x r).
LANES_INLINE void put_matrix(rate8 *r, int at, lane3 turn, lane3 bend) {
    lane xx = turn.x * turn.x, yy = turn.y * turn.y, zz = turn.z * turn.z;
    lane xy = turn.x * turn.y, xz = turn.x * turn.z, yz = turn.y * turn.z;
    put3(&r->column[RATE8_MATRIX], at, (lane3){-(yy + zz), xy - bend.z, xz + bend.y});
    put3(&r->column[RATE8_MATRIX + 3], at, (lane3){xy + bend.z, -(xx + zz), yz - bend.x});
    put3(&r->column[RATE8_MATRIX + 6], at, (lane3){xz - bend.y, yz + bend.x, -(xx + yy)});
}

LANES_INLINE lane9 get_matrix(const rate8 *r, int at) {
    return (lane9){get_rate(r, RATE8_MATRIX, at), get_rate(r, RATE8_MATRIX + 3, at), get_rate(r, RATE8_MATRIX + 6, at)};
}

// The child of a step from its parent, whose rates are zero for the world.
LANES_INLINE void compute_rate(const chain_step *s, const step_rate8 *own, const frame8 *frames, rate8 *rates, int at,
                               lane half) {
    static const rate8 still;
    int is_root = s->parent == UINT32_MAX;
    const frame8 *child = &frames[s->child];
    const rate8 *parent = is_root ? &still : &rates[s->parent];
    lane3 r = get3(child->column, at);
    lane3 turn = get_rate(parent, RATE8_TURN, at), bend = get_rate(parent, RATE8_BEND, at);
    lane3 v = get_rate(parent, RATE8_VELOCITY, at), a = get_rate(parent, RATE8_ACCELERATION, at);
    if (!is_root) {
        r = lane3_sub(r, get3(frames[s->parent].column, at));
        v = lane3_add(v, cross3(turn, r));
        a = lane3_add(a, lane9_mul3(get_matrix(parent, at), r));
    }
    uint32_t lengths = s->kind == STEP_SLIDE ? 1 : s->kind == STEP_PLANE ? 2 : s->kind == STEP_FREE ? 3 : 0;
    for (uint32_t i = 0; i < lengths; i++) {
        lane3 along = spread3(s->along[i]);
        if (!is_root) along = lane9_mul3(get_rotation(&frames[s->parent], at), along);
        lane3 slide = lane3_scale(along, get(own->length[i], at) * half);
        v = lane3_add(v, slide);
        a = lane3_add_scaled(a, cross3(turn, slide), lane_set(2));
    }
    if (s->kind == STEP_TURN || s->kind == STEP_PLANE) {
        lane3 axis = lane9_mul3(get_rotation(child, at), spread3(s->axis));
        lane3 more = lane3_scale(axis, get(own->turn, at) * half);
        bend = lane3_add(bend, cross3(turn, more));
        turn = lane3_add(turn, more);
    }
    rate8 *to = &rates[s->child];
    put3(&to->column[RATE8_VELOCITY], at, v);
    put3(&to->column[RATE8_ACCELERATION], at, a);
    put3(&to->column[RATE8_TURN], at, turn);
    put3(&to->column[RATE8_BEND], at, bend);
    put_matrix(to, at, turn, bend);
}

LANES_TARGET static void run_rates(const rate_chain *chain, const double half[ROBOT8], rate8 *rates) {
    for (uint32_t i = 0; i < chain->count; i++) {
        if (!chain->rates[i].is_moving) continue;
        for (int at = 0; at < ROBOT8; at += LANES)
            compute_rate(&chain->steps[i], &chain->rates[i], chain->frames, rates, at, get(half, at));
    }
}

LANES_TARGET static void run_move(const moving8 *link, const double center[3], motion8 *m) {
    lane3 own = {lane_set(center[0]), lane_set(center[1]), lane_set(center[2])};
    for (int at = 0; at < ROBOT8; at += LANES) {
        lane3 r = lane9_mul3(get_rotation(link->frame, at), own);
        lane3 a = lane3_add(get_rate(link->rate, RATE8_ACCELERATION, at), lane9_mul3(get_matrix(link->rate, at), r));
        put3(&m->column[MOTION8_PLACE], at, lane3_add(get3(link->frame->column, at), r));
        put3(&m->column[MOTION8_VELOCITY], at,
             lane3_add(get_rate(link->rate, RATE8_VELOCITY, at), cross3(get_rate(link->rate, RATE8_TURN, at), r)));
        put3(&m->column[MOTION8_QUARTER], at, lane3_scale(a, lane_set(0.25)));
    }
}

// ---- boxes

LANES_INLINE lane3 find_extent(lane9 to, lane3 v, lane3 q) {
    lane3 a = abs3(lane9_mul3_transposed(to, v)), b = abs3(lane9_mul3_transposed(to, q));
    return lane3_add(a, b);
}

LANES_TARGET static void run_near_moving(const cover_boxes *all, const motion8 *m, const double reach[ROBOT8],
                                         unsigned char *near) {
    lane zero = lane_set(0);
    lane9 to = spread9(&all->rotation);
    for (uint32_t i = 0; i < all->count; i++) near[i] = 0;
    for (int at = 0; at < ROBOT8; at += LANES) {
        lane3 q = get3(&m->column[MOTION8_QUARTER], at);
        lane3 p = lane9_mul3_transposed(to, lane3_add(get3(&m->column[MOTION8_PLACE], at), q));
        lane3 e = find_extent(to, get3(&m->column[MOTION8_VELOCITY], at), q);
        lane own = get(reach, at);
        for (uint32_t i = 0; i < all->count; i++) {
            const cover_box *b = &all->boxes[i];
            lane3 out = {lane_max(lane_abs(p.x - lane_set(b->center[0])) - (e.x + lane_set(b->half[0])), zero),
                         lane_max(lane_abs(p.y - lane_set(b->center[1])) - (e.y + lane_set(b->half[1])), zero),
                         lane_max(lane_abs(p.z - lane_set(b->center[2])) - (e.z + lane_set(b->half[2])), zero)};
            lane_mask far = is_far(lane3_dot(out, out), own + lane_set(b->radius));
            near[i] |= (unsigned char)(lane_bits(lane_not(far)) << at & ((1u << ROBOT8) - 1));
        }
    }
}

// The box around the place of a moving point in all lanes.
LANES_TARGET static void run_enclose(const motion8 *m, double low[3], double high[3]) {
    for (int k = 0; k < 3; k++) {
        lane least = lane_set(INFINITY), most = lane_set(-INFINITY);
        for (int at = 0; at < ROBOT8; at += LANES) {
            lane q = get(m->column[MOTION8_QUARTER + k], at), p = get(m->column[MOTION8_PLACE + k], at) + q;
            lane e = lane_abs(get(m->column[MOTION8_VELOCITY + k], at)) + lane_abs(q);
            least = -lane_max(e - p, -least);
            most = lane_max(p + e, most);
        }
        low[k] = -find_greatest(-least);
        high[k] = find_greatest(most);
    }
}

// ---- pairs of links

// A point's motion as seen from a frame that moves, in the world's axes.
typedef struct seen {
    lane3 place, velocity, quarter; // place: from the frame's origin
} seen;

LANES_INLINE seen see(seen world, const moving8 *from, int at) {
    const rate8 *r = from->rate;
    lane3 turn = get_rate(r, RATE8_TURN, at);
    lane3 p = lane3_sub(world.place, get3(from->frame->column, at));
    lane3 v = lane3_sub(world.velocity, lane3_add(get_rate(r, RATE8_VELOCITY, at), cross3(turn, p)));
    lane3 a = lane3_add(get_rate(r, RATE8_ACCELERATION, at), lane9_mul3(get_matrix(r, at), p));
    a = lane3_add_scaled(a, cross3(turn, v), lane_set(2));
    return (seen){p, v, lane3_sub(world.quarter, lane3_scale(a, lane_set(0.25)))};
}

LANES_INLINE seen see_point(const motion8 *m, const moving8 *from, int at) {
    const seen world = {get3(&m->column[MOTION8_PLACE], at), get3(&m->column[MOTION8_VELOCITY], at),
                        get3(&m->column[MOTION8_QUARTER], at)};
    return see(world, from, at);
}

LANES_INLINE seen see_origin(const moving8 *link, const moving8 *from, int at) {
    const seen world = {get3(link->frame->column, at), get_rate(link->rate, RATE8_VELOCITY, at),
                        lane3_scale(get_rate(link->rate, RATE8_ACCELERATION, at), lane_set(0.25))};
    return see(world, from, at);
}

// Along the direction d from a point to where the moving one is nearest to it, about: whatever d is, the gap is a lower
// bound.
LANES_INLINE lane_mask is_far_along(lane3 y, lane3 v, lane3 quarter, lane limit) {
    lane zero = lane_set(0), one = lane_set(1), square = lane3_dot(v, v), along = -lane3_dot(y, v);
    lane t = lane_select(lane_greater(square, zero), along / square, zero);
    t = lane_select(lane_greater(t, one), one, lane_select(lane_less(t, -one), -one, t));
    lane3 d = lane3_add_scaled(y, v, t);
    lane gap = (lane3_dot(d, y) - lane_abs(lane3_dot(d, v))) - lane_abs(lane3_dot(d, quarter));
    lane limits = limit * limit * lane3_dot(d, d);
    return lane_and(lane_greater(gap, zero), lane_greater(gap * gap * lane_set(1 - 0x1p-40), limits));
}

LANES_TARGET static unsigned run_near_points(const motion8 *a, const motion8 *b, const double reach[ROBOT8]) {
    unsigned bits = 0;
    for (int at = 0; at < ROBOT8; at += LANES) {
        lane3 q = lane3_sub(get3(&b->column[MOTION8_QUARTER], at), get3(&a->column[MOTION8_QUARTER], at));
        lane3 v = lane3_sub(get3(&b->column[MOTION8_VELOCITY], at), get3(&a->column[MOTION8_VELOCITY], at));
        lane3 y = lane3_sub(get3(&b->column[MOTION8_PLACE], at), get3(&a->column[MOTION8_PLACE], at));
        bits |= lane_bits(lane_not(is_far_along(lane3_add(y, q), v, q, get(reach, at)))) << at;
    }
    return bits & ((1u << ROBOT8) - 1);
}

LANES_TARGET static unsigned run_near_point(const motion8 *m, const motion8 *point, const moving8 *from,
                                            const double reach[ROBOT8]) {
    unsigned bits = 0;
    for (int at = 0; at < ROBOT8; at += LANES) {
        seen of = see_point(m, from, at);
        lane3 own = lane3_sub(get3(&point->column[MOTION8_PLACE], at), get3(from->frame->column, at));
        lane3 y = lane3_add(lane3_sub(of.place, own), of.quarter);
        bits |= lane_bits(lane_not(is_far_along(y, of.velocity, of.quarter, get(reach, at)))) << at;
    }
    return bits & ((1u << ROBOT8) - 1);
}

LANES_INLINE lane find_slab_gap(const body_slabs *s, int k, lane p, lane e) {
    return lane_abs(p - lane_set(s->middle[k])) - (e + lane_set(s->half[k]));
}

#define SQRT_HALF 0.70710678118  // below it
#define SQRT_THIRD 0.57735026918 // below it

// How far the moving point stays from the body along the slabs' directions other than x, y, z.
LANES_INLINE lane find_most_gap(const body_slabs *s, lane3 p, lane3 v, lane3 q) {
    const lane of[3][3] = {{p.x, p.y, p.z}, {v.x, v.y, v.z}, {q.x, q.y, q.z}};
    lane most[2] = {lane_set(-INFINITY), lane_set(-INFINITY)};
    for (int k = 0; k < 6; k++) {
        int i = k < 4 ? 0 : 1, j = k < 2 ? 1 : 2;
        lane sum[3];
        for (int n = 0; n < 3; n++) sum[n] = k % 2 ? of[n][i] - of[n][j] : of[n][i] + of[n][j];
        most[0] = lane_max(find_slab_gap(s, 3 + k, sum[0], lane_abs(sum[1]) + lane_abs(sum[2])), most[0]);
    }
    for (int k = 0; k < 4; k++) {
        lane sum[3];
        for (int n = 0; n < 3; n++) {
            lane two = k < 2 ? of[n][0] + of[n][1] : of[n][0] - of[n][1];
            sum[n] = k % 2 ? two - of[n][2] : two + of[n][2];
        }
        most[1] = lane_max(find_slab_gap(s, 9 + k, sum[0], lane_abs(sum[1]) + lane_abs(sum[2])), most[1]);
    }
    return lane_max(most[0] * lane_set(SQRT_HALF), most[1] * lane_set(SQRT_THIRD));
}

LANES_TARGET static unsigned run_near_slabs(const motion8 *m, const moving8 *body, const body_slabs *s,
                                            const double reach[ROBOT8]) {
    unsigned bits = 0;
    lane zero = lane_set(0);
    for (int at = 0; at < ROBOT8; at += LANES) {
        seen of = see_point(m, body, at);
        lane9 rotation = get_rotation(body->frame, at);
        lane3 q = lane9_mul3_transposed(rotation, of.quarter), v = lane9_mul3_transposed(rotation, of.velocity);
        lane3 p = lane3_add(lane9_mul3_transposed(rotation, of.place), q);
        lane limit = get(reach, at);
        lane3 out = {lane_max(find_slab_gap(s, 0, p.x, lane_abs(v.x) + lane_abs(q.x)), zero),
                     lane_max(find_slab_gap(s, 1, p.y, lane_abs(v.y) + lane_abs(q.y)), zero),
                     lane_max(find_slab_gap(s, 2, p.z, lane_abs(v.z) + lane_abs(q.z)), zero)};
        lane_mask far = is_far(lane3_dot(out, out), limit);
        if (!lane_bits(lane_not(far))) continue;
        lane most = find_most_gap(s, p, v, q) * lane_set(1 - 0x1p-40);
        far = lane_or(far, lane_greater(most, limit));
        bits |= lane_bits(lane_not(far)) << at;
    }
    return bits & ((1u << ROBOT8) - 1);
}

LANES_TARGET static unsigned run_near_resting(const balls8 *balls, const body_place *place, const body_slabs *s,
                                              double reach) {
    lane9 rotation = spread9(&place->rotation);
    lane3 to = spread3(place->position), still = {lane_set(0), lane_set(0), lane_set(0)};
    lane zero = lane_set(0);
    for (int at = 0; at < ROBOT8; at += LANES) {
        lane3 p = lane3_add(to, lane9_mul3(rotation, get3(balls->column, at)));
        lane limit = get(balls->column[BALLS8_RADIUS], at) + lane_set(reach);
        lane3 out = {lane_max(find_slab_gap(s, 0, p.x, zero), zero), lane_max(find_slab_gap(s, 1, p.y, zero), zero),
                     lane_max(find_slab_gap(s, 2, p.z, zero), zero)};
        lane_mask near = lane_not(is_far(lane3_dot(out, out), limit));
        if (!lane_bits(near)) continue;
        lane most = find_most_gap(s, p, still, still) * lane_set(1 - 0x1p-40);
        if (lane_bits(lane_and(near, lane_not(lane_greater(most, limit))))) return 1;
    }
    return 0;
}

// Along n a vertex c of the link's frame is at f(c) + g(c) t + 2 k(c) t^2, all linear in c: at least f - |g| + 2 min(k,
// 0). A linear form: its value at the link's origin, and its vector in the link's frame.
typedef struct form {
    lane constant;
    lane3 along;
} form;

LANES_INLINE lane evaluate(form f, lane3 c) { return f.constant + lane3_dot(f.along, c); }

// The largest absolute value of a form over the ball around the vertices.
LANES_INLINE lane find_most(form f, const moving_hull *h) {
    lane along = lane_sqrt(lane3_dot(f.along, f.along)) * lane_set(h->radius);
    return (lane_abs(evaluate(f, spread3(h->center))) + along) * lane_set(1 + 0x1p-40);
}

// The lanes in which a vertex of a cluster is not above the limit. Of most vertices their place alone shows that they
// are, if it is above `enough`.
LANES_INLINE lane_mask find_low(const vertex_cluster *cluster, const form forms[3], lane limit, lane enough) {
    lane zero = lane_set(0);
    lane_mask low = lane_none();
    lane all = evaluate(forms[0], spread3(cluster->center)) - lane_set(cluster->radius);
    if (!lane_bits(lane_not(lane_greater(all, enough)))) return low;
    for (uint32_t i = 0; i < cluster->count; i++) {
        const double *v = cluster->vertices + 3 * (size_t)i;
        lane3 c = {lane_set(v[0]), lane_set(v[1]), lane_set(v[2])};
        lane place = evaluate(forms[0], c);
        if (!lane_bits(lane_not(lane_greater(place, enough)))) continue;
        lane down = lane_max(-evaluate(forms[2], c), zero);
        lane value = (place - lane_abs(evaluate(forms[1], c))) - (down + down);
        low = lane_or(low, lane_not(lane_greater(value, limit)));
    }
    return low;
}

LANES_TARGET static unsigned run_near_hull(const moving_hull *h, const double reach[ROBOT8]) {
    unsigned bits = 0;
    for (int at = 0; at < ROBOT8; at += LANES) {
        const rate8 *own = h->link.rate, *other = h->from.rate;
        lane3 n = lane9_mul3(get_rotation(h->from.frame, at), spread3(h->normal));
        seen origin = see_origin(&h->link, &h->from, at);
        lane3 turn = get_rate(other, RATE8_TURN, at), relative = lane3_sub(get_rate(own, RATE8_TURN, at), turn);
        lane3 g = cross3(n, relative);
        lane3 k =
            lane3_sub(lane9_mul3_transposed(get_matrix(own, at), n), lane9_mul3_transposed(get_matrix(other, at), n));
        k = lane3_add_scaled(k, cross3(cross3(n, turn), relative), lane_set(-2));
        lane9 rotation = get_rotation(h->link.frame, at);
        const form forms[3] = {
            {lane3_dot(n, origin.place), lane9_mul3_transposed(rotation, n)},
            {lane3_dot(n, origin.velocity), lane9_mul3_transposed(rotation, g)},
            {lane3_dot(n, origin.quarter), lane9_mul3_transposed(rotation, lane3_scale(k, lane_set(0.25)))}};
        lane limit = lane_set(h->support) + get(reach, at) * lane_set(1 + 0x1p-40);
        lane bend = find_most(forms[2], h), enough = limit + (find_most(forms[1], h) + (bend + bend));
        for (uint32_t i = 0; i < h->count; i++)
            bits |= lane_bits(find_low(&h->clusters[i], forms, limit, enough)) << at;
    }
    return bits & ((1u << ROBOT8) - 1);
}

#define ROBOT8_KERNELS                                                                                                 \
    {                                                                                                                  \
        run_chain, run_place, run_half_turns, run_near_boxes, run_near_boxes8, run_near_spheres,                       \
            run_near_linked_boxes, run_place_balls, run_balls_in_region, run_balls_in_balls, run_rates, run_move,      \
            run_enclose, run_near_moving, run_near_points, run_near_point, run_near_slabs, run_near_hull,              \
            run_near_resting                                                                                           \
    }
