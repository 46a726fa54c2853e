// The box that a moving body sweeps: along each axis of the world, its supports at the ends of an interval, enlarged by
// the most that they may grow in between (motion_gap.h), or those of the cylinder about its axis. Intervals are cut so
// that a body turns by half a radian at most in each, which leaves phi^2 / 8 = 1 / 32 of its width.
#include "base/environment.h"
#include "linear/box.h"
#include "linear/rotation.h"
#include "motion/motion.h"
#include "shape/block.h"
#include "simd/support.h"

#define CUT_TURN 0.5
#define MOST_TURN 4.0

typedef double extent[3]; // along x, y, z

static vec3 make_axis(int i) { return (vec3){i == 0, i == 1, i == 2}; }
// The body's extents at a time, errors included.
static void find_extents(const motion_body *b, double time, extent low, extent high) {
    const ovoid_shape *shape = b->moving->shape;
    ovoid_pose pose;
    double shift = motion_body_find_pose(b, time, &pose);
    mat3 r = quat_to_mat3(pose.rotation);
    vec3 at = vec3_add(pose.position, mat3_mul_vec3(r, shape->origin));
    const vec3 rows[3] = {r.r0, r.r1, r.r2};
    simd_points points = shape_get_points(shape);
    double error = shift + 64 * ROUNDING * (b->reach + shape->lower_radius + 2 * vec3_max_abs(pose.position)) +
                   OVOID_LENGTH_MIN + shape->lower_radius;
    for (int i = 0; i < 3; i++) {
        vec3 back = vec3_neg(rows[i]);
        support_result up = simd_find_support(&points, &rows[i]), down = simd_find_support(&points, &back);
        high[i] = (vec3_get(at, i) + up.value) + error;
        low[i] = (vec3_get(at, i) - down.value) - error;
    }
}

// The most by which the supports along n at two times may be exceeded in between.
static double compute_bulge(const motion_body *b, double from, double to, vec3 n) {
    const motion_piece *p = &b->piece;
    double angle = (p->turn + p->turn_error) * ((to - from) / p->span);
    double across = vec3_norm(vec3_cross(n, p->axis)) + b->axis_error + 8 * ROUNDING;
    return angle * angle * (0.125 * across) * b->wide * (1 + 64 * ROUNDING);
}

static void take(box *all, const extent low, const extent high, const extent bulge) {
    vec3 l = {low[0] - bulge[0], low[1] - bulge[1], low[2] - bulge[2]};
    vec3 h = {high[0] + bulge[0], high[1] + bulge[1], high[2] + bulge[2]};
    *all = box_join(all, &(box){l, h});
}

// The cylinder about the axis, with the pivot where it is at a time.
static void take_cylinder(box *all, const motion_body *b, double time) {
    const motion_piece *p = &b->piece;
    vec3 at = vec3_add_scaled(p->from, p->travel, (time - p->begin) / p->span);
    double radius = b->radius;
    double slack = (2 * b->axis_error + 512 * ROUNDING) * b->reach + OVOID_LENGTH_MIN + p->fixed +
                   64 * ROUNDING * (vec3_max_abs(at) + vec3_max_abs(p->travel) + radius);
    extent low, high;
    const extent bulge = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        double along = vec3_get(p->axis, i), middle = vec3_get(at, i);
        double across = vec3_norm(vec3_cross(make_axis(i), p->axis)) * b->wide + slack + radius;
        high[i] = middle + (max2(along * b->low, along * b->high) + across);
        low[i] = middle + (min2(along * b->low, along * b->high) - across);
    }
    take(all, low, high, bulge);
}

// One piece between two times of it.
static void take_piece(box *all, const motion_body *b, double from, double to) {
    double turned = b->piece.is_still ? 0 : b->piece.turn * ((to - from) / b->piece.span);
    if (turned > MOST_TURN) {
        take_cylinder(all, b, from);
        take_cylinder(all, b, to);
        return;
    }
    int count = 1 + (int)(turned / CUT_TURN);
    extent low[2], high[2], bulge = {0, 0, 0};
    double before = from;
    find_extents(b, from, low[0], high[0]);
    for (int k = 1; k <= count; k++) {
        double time = k < count ? from + (to - from) * k / count : to;
        find_extents(b, time, low[k & 1], high[k & 1]);
        for (int i = 0; i < 3; i++)
            if (b->piece.turn > 0) bulge[i] = compute_bulge(b, before, time, make_axis(i));
        take(all, low[0], high[0], bulge);
        take(all, low[1], high[1], bulge);
        before = time;
    }
}

static ovoid_box compute_box(const ovoid_moving_shape *moving, double begin, double end) {
    const ovoid_motion *m = &moving->motion;
    ovoid_box none = {{NAN, NAN, NAN}, {NAN, NAN, NAN}};
    box all = box_make_empty();
    if (!moving->shape || !(begin <= end) || motion_validate(m, begin, end, NULL) != OVOID_OK) return none;
    // Outside of its time the body rests.
    double first = motion_get_begin(m), last = motion_get_end(m);
    double time = min2(max2(begin, first), last), until = max2(min2(end, last), first);
    if (m->kind == OVOID_MOTION_STILL) time = until = 0;
    motion_body body;
    do {
        if (!motion_body_make(moving, time, &body)) return none;
        double next = min2(body.piece.end, until);
        take_piece(&all, &body, time, next);
        time = next;
    } while (time < until);
    return all;
}

ovoid_box ovoid_moving_shape_compute_box(const ovoid_moving_shape *moving, double begin, double end) {
    ENVIRONMENT_RETURN(ovoid_box, begin, compute_box(moving, begin, end));
}
