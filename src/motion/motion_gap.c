// Gaps along a direction at a time, and their least over an interval: the terms of the theorem in motion_gap.h.
#include "motion/motion_gap.h"

#include "linear/rotation.h"
#include "motion/motion_angle.h"
#include "pair/round.h"

// A gap of two posed bodies in doubles is off by 60 u of their size (docs/error-analysis.md, the first rejections).
#define GAP_CHECK (64 * ROUNDING)

ovoid_limit motion_pair_make(const ovoid_moving_shape *a, const ovoid_moving_shape *b, double time, motion_pair *pair) {
    if (!motion_body_make(a, time, &pair->a)) return OVOID_LIMIT_POSE_A;
    if (!motion_body_make(b, time, &pair->b)) return OVOID_LIMIT_POSE_B;
    pair->begin = max2(pair->a.piece.begin, pair->b.piece.begin);
    pair->end = min2(pair->a.piece.end, pair->b.piece.end);
    return OVOID_LIMIT_NONE;
}

double motion_pair_find_pair(const motion_pair *m, double time, ovoid_pair *at) {
    at->shape_a = m->a.moving->shape;
    at->shape_b = m->b.moving->shape;
    return motion_body_find_pose(&m->a, time, &at->pose_a) + motion_body_find_pose(&m->b, time, &at->pose_b);
}

// The speed of a body's pivot along n.
static double compute_speed(const motion_body *b, vec3 n) {
    return b->piece.is_still ? 0 : vec3_dot(n, b->piece.travel) / b->piece.span;
}

// How fast a point of the shape moves along n, beside its pivot; both in the shape's axes.
static double compute_turning(const motion_body *b, vec3 n, vec3 point) {
    return vec3_dot(n, vec3_cross(b->axis, vec3_sub(point, b->pivot))) * (b->piece.turn / b->piece.span);
}

// A support along a direction and a point that reaches it, in the shape's body frame.
typedef struct reached {
    double value;
    vec3 point;
} reached;

// Of the true body along m if it is known, else of the vertices, whose support was found, and what stands out of them.
static reached find_reached(const motion_body *b, vec3 m, support_result found) {
    const ovoid_shape *s = b->moving->shape;
    reached end;
    if (shape_is_round(s)) {
        round_end found_end = round_find_support(s, m);
        end = (reached){found_end.value, shape_get_vertex(s, found_end.vertex)};
    } else {
        end.value = found.value + shape_compute_across(s, m, AXIS_CLAIM);
        end.point = vec3_at(shape_vertices(s), found.index);
    }
    return end;
}

// One body's supports along n; m is n along the body's axes.
static void set_support(const motion_body *b, vec3 n, vec3 m, const reached *end, double support[2], double speed[2]) {
    support[0] = support[1] = end->value;
    speed[0] = speed[1] = compute_speed(b, n);
    if (!(b->piece.turn > 0)) return;
    speed[0] += compute_turning(b, m, end->point);
    double along = vec3_dot(n, b->piece.axis), across = vec3_norm(vec3_cross(n, b->piece.axis));
    double cylinder = max2(along * b->low, along * b->high) + across * b->wide;
    support[1] = vec3_dot(m, b->pivot) + cylinder + (2 * b->axis_error + 512 * ROUNDING) * b->reach;
}

void motion_gap_find(const motion_pair *p, double time, vec3 n, motion_gap *g) {
    ovoid_pair at;
    pair_frame f;
    *g = (motion_gap){.time = time, .normal = n, .base = -INFINITY};
    double shift = motion_pair_find_pair(p, time, &at);
    if (frame_place(&at, &f) != OVOID_LIMIT_NONE) return;
    vec3 in_a = mat3_mul_transposed_vec3(f.world, n), in_b = vec3_neg(mat3_mul_transposed_vec3(f.world_b, n));
    simd_pair ends = frame_find_pair(&f, in_a, in_b);
    g->base = vec3_dot(n, f.offset) - (p->a.radius + p->b.radius);
    reached a = find_reached(&p->a, in_a, ends.high), b = find_reached(&p->b, in_b, ends.low);
    set_support(&p->a, n, in_a, &a, g->support[0], g->speed[0]);
    set_support(&p->b, vec3_neg(n), in_b, &b, g->support[1], g->speed[1]);
    double check = frame_has_round(&f) ? GAP_CHECK + ROUND_CHECK : GAP_CHECK;
    g->error = (shift + check * f.size + f.hidden) * (1 + 16 * ROUNDING);
    g->size = f.size;
    g->apart = frame_world_difference(&f, a.point, b.point);
}

// K of one body over a share of its piece.
static double compute_curvature(const motion_body *b, double from, double to, vec3 n) {
    const motion_piece *p = &b->piece;
    if (!(p->turn > 0)) return 0;
    double share = (to - from) / p->span, angle = (p->turn + p->turn_error) * share;
    double across = vec3_norm(vec3_cross(n, p->axis)) + b->axis_error + 8 * ROUNDING;
    return angle * angle * (0.5 * across) * b->wide * (1 + 64 * ROUNDING);
}

// The least of (1 - s) g0 + s g1 - s (1 - s) K for s from 0 to 1, less than 16 u of the terms below the true one.
static double compute_least(double g0, double g1, double k) {
    double least = min2(g0, g1), rise = g1 - g0;
    if (fabs(rise) < k) {
        double s = (k - rise) / (2 * k);
        least = min2(least, g0 - k * (s * s));
    }
    return least - 16 * ROUNDING * (max2(fabs(g0), fabs(g1)) + k);
}

// ---- directions that turn with a body

static const motion_body *get_turning(const motion_pair *p, ovoid_step_frame frame) {
    return frame == OVOID_STEP_A ? &p->a : &p->b;
}

// Angular velocity; and what its length may be off by.
static vec3 compute_angular(const motion_body *b) { return vec3_scale(b->piece.axis, b->piece.turn / b->piece.span); }
static double compute_angular_error(const motion_body *b) {
    return (b->piece.turn_error + 16 * ROUNDING * b->piece.turn) / b->piece.span;
}

vec3 motion_pair_turn_normal(const motion_pair *p, ovoid_step_frame frame, double from, double to, vec3 n,
                             double *error) {
    *error = 0;
    if (frame == OVOID_STEP_WORLD) return n;
    const motion_piece *piece = &get_turning(p, frame)->piece;
    double angle = piece->turn * ((to - from) / piece->span);
    turn half = turn_compute(0.5 * angle);
    vec3 v = vec3_scale(piece->axis, half.sine);
    *error = (256 + 16 * angle) * ROUNDING;
    return vec3_unit(mat3_mul_vec3(quat_to_mat3((ovoid_quat){half.cosine, v.x, v.y, v.z}), n));
}

void motion_gap_find_end(const motion_pair *p, const motion_gap *from, ovoid_step_frame frame, double until,
                         motion_gap *to) {
    double error;
    vec3 n = motion_pair_turn_normal(p, frame, from->time, until, from->normal, &error);
    motion_gap_find(p, until, n, to);
    to->error += error * to->size;
}

// The pivot at a time, and its velocity.
static vec3 find_pivot(const motion_body *b, double time) {
    const motion_piece *p = &b->piece;
    return p->is_still ? p->from : vec3_add_scaled(p->from, p->travel, (time - p->begin) / p->span);
}
static vec3 compute_velocity(const motion_body *b) {
    return b->piece.is_still ? (vec3){0, 0, 0} : vec3_scale(b->piece.travel, 1 / b->piece.span);
}

// K of a direction that turns with a body, over the interval of length `time` from `from` on.
static double compute_turning_curvature(const motion_pair *p, ovoid_step_frame frame, double from, double time,
                                        vec3 n) {
    const motion_body *x = get_turning(p, frame), *y = frame == OVOID_STEP_A ? &p->b : &p->a;
    vec3 w = compute_angular(x), v = compute_angular(y);
    double ew = compute_angular_error(x), ev = compute_angular_error(y), rate = vec3_norm(w) + ew;
    double across = min2(vec3_norm(vec3_cross(n, x->piece.axis)) + x->axis_error + 8 * ROUNDING, 1 + 8 * ROUNDING);
    // The motion of the pivots.
    vec3 c0 = vec3_sub(find_pivot(x, from), find_pivot(y, from));
    vec3 speed = vec3_sub(compute_velocity(x), compute_velocity(y));
    vec3 c1 = vec3_add_scaled(c0, speed, time);
    double far = max2(vec3_norm(c0), vec3_norm(c1)) + (x->piece.fixed + y->piece.fixed);
    double pivots = (rate * rate * far + 2 * rate * vec3_norm(speed)) * across;
    // The turning of the other body about its pivot.
    double other = rate * rate * across;
    if (y->piece.turn > 0) {
        double apart = vec3_norm(vec3_sub(w, v)) + ew + ev;
        other = apart * apart + vec3_norm(vec3_cross(w, v)) + ew * (vec3_norm(v) + ev) + ev * rate;
    }
    return 0.5 * time * time * (pivots + other * y->reach) * (1 + 256 * ROUNDING);
}

// ---- the least gap, and how far a step reaches

static double compute_fixed_lower(const motion_pair *p, const motion_gap *from, const motion_gap *to) {
    double k[2] = {compute_curvature(&p->a, from->time, to->time, from->normal),
                   compute_curvature(&p->b, from->time, to->time, from->normal)};
    double best = -INFINITY;
    for (int way = 0; way < 4; way++) {
        int i = way & 1, j = way >> 1;
        double g0 = ((from->base - from->support[0][i]) - from->support[1][j]) - from->error;
        double g1 = ((to->base - to->support[0][i]) - to->support[1][j]) - to->error;
        if (g0 > -INFINITY && g1 > -INFINITY) best = max2(best, compute_least(g0, g1, (i ? 0 : k[0]) + (j ? 0 : k[1])));
    }
    return best;
}

double motion_gap_compute_lower(const motion_pair *p, ovoid_step_frame frame, const motion_gap *from,
                                const motion_gap *to) {
    if (frame == OVOID_STEP_WORLD) return compute_fixed_lower(p, from, to);
    double g0 = motion_gap_get_lower(from), g1 = motion_gap_get_lower(to);
    if (!(g0 > -INFINITY && g1 > -INFINITY)) return -INFINITY;
    double time = (to->time - from->time) * (1 + 4 * ROUNDING);
    return compute_least(g0, g1, compute_turning_curvature(p, frame, from->time, time, from->normal));
}

// How long a gap that is `room` above the level, falls by `fall` a unit of time and is curved by `curve` stays above
// it: the largest D with min over s of room - fall s D - s (1 - s) curve D^2 / 2 > 0.
static double guess_time(double room, double fall, double curve) {
    if (!(room > 0)) return 0;
    if (!(curve > 0)) return fall > 0 ? room / fall : INFINITY;
    if (fall >= sqrt(0.5 * curve * room)) return room / fall;
    return 2 * (sqrt(2 * curve * room) - fall) / curve;
}

// The share of the room that a step uses up. Nearer to the level than the rest, doubles cannot tell the bodies from
// touching ones, and a query would need the refinement.
static double compute_use(double room, double error, double curve) {
    return max2(room * (1 - (curve > 0 ? 1e-6 : 1e-15)) - 16 * error, 0.5 * room);
}

static double guess_fixed(const motion_pair *p, const motion_gap *g, double level) {
    double k[2] = {compute_curvature(&p->a, 0, 1, g->normal), compute_curvature(&p->b, 0, 1, g->normal)};
    double best = 0;
    for (int way = 0; way < 4; way++) {
        int i = way & 1, j = way >> 1;
        double room = ((g->base - g->support[0][i]) - g->support[1][j]) - g->error - level;
        double fall = g->speed[0][i] + g->speed[1][j], curve = 2 * ((i ? 0 : k[0]) + (j ? 0 : k[1]));
        best = max2(best, guess_time(compute_use(room, g->error, curve), fall, curve));
    }
    return g->time + best;
}

double motion_gap_guess_reach(const motion_pair *p, ovoid_step_frame frame, const motion_gap *g, double level) {
    if (frame == OVOID_STEP_WORLD) return guess_fixed(p, g, level);
    const motion_body *x = get_turning(p, frame);
    if (!(x->piece.turn > 0)) return g->time;
    double room = motion_gap_get_lower(g) - level;
    double fall = g->speed[0][0] + g->speed[1][0] - vec3_dot(vec3_cross(compute_angular(x), g->normal), g->apart);
    // The pivots' part of K grows with time; here its order of magnitude is enough.
    double curve = 2 * compute_turning_curvature(p, frame, g->time, 1e-3 * x->piece.span, g->normal) /
                   (1e-6 * x->piece.span * x->piece.span);
    return g->time + guess_time(compute_use(room, g->error, curve), fall, curve);
}
