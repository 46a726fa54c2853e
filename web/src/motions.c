// Motions of two bodies: when they come within a margin, how near they come.
#include "src/exchange.h"

static const double *read_moving(const double *from, const ovoid_shape *shape, double duration,
                                 ovoid_moving_shape *moving) {
    ovoid_pose start, end;
    from = read_pose(read_pose(from, &start), &end);
    *moving = (ovoid_moving_shape){.shape = shape, .motion = ovoid_motion_make_poses(start, end, duration)};
    return from;
}

// Reads the duration, the margin, the tolerance, then the first and last poses of a and of b.
static void read_both(const ovoid_shape *a, const ovoid_shape *b, ovoid_moving_shape *moving_a,
                      ovoid_moving_shape *moving_b, ovoid_motion_options *options) {
    double duration = exchange[0];
    *options = (ovoid_motion_options){.tolerance = exchange[2]};
    read_moving(read_moving(exchange + 3, a, duration, moving_a), b, duration, moving_b);
}

/// Writes status, limit, iterations, begin, end, free_until, hit_at, steps and the answers there.
void EXPORT(impact)(const ovoid_shape *a, const ovoid_shape *b) {
    ovoid_moving_shape moving_a, moving_b;
    ovoid_motion_options options;
    double margin = exchange[1], *to = exchange;
    read_both(a, b, &moving_a, &moving_b, &options);
    ovoid_impact i = ovoid_impact_find(&(ovoid_moving_pair){moving_a, moving_b, margin}, &options);
    *to++ = i.status, *to++ = i.limit, *to++ = i.iterations, *to++ = i.begin, *to++ = i.end;
    *to++ = i.free_until, *to++ = i.hit_at, *to++ = (double)i.step_count;
    write_answer(write_answer(to, &i.free), &i.hit);
}

/// Writes status, limit, iterations, begin, end, lower, upper, time and the answer there.
void EXPORT(approach)(const ovoid_shape *a, const ovoid_shape *b) {
    ovoid_moving_shape moving_a, moving_b;
    ovoid_motion_options options;
    double *to = exchange;
    read_both(a, b, &moving_a, &moving_b, &options);
    ovoid_approach p = ovoid_approach_find(&(ovoid_moving_pair){moving_a, moving_b, 0}, &options);
    *to++ = p.status, *to++ = p.limit, *to++ = p.iterations, *to++ = p.begin, *to++ = p.end;
    *to++ = p.lower, *to++ = p.upper, *to++ = p.time;
    write_answer(to, &p.answer);
}
