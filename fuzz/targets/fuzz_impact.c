// Two bodies that move: velocities, two poses, paths; impact, approach, boxes, casts and rays. Truth: the check without
// search of each answer; and the bodies at sampled times, at the rounded poses that the library gives, up to what it
// says these are off.
#include "bodies.h"

enum { STEPS = 512, TIMES = 6 };

static double times_a[TIMES], times_b[TIMES];
static ovoid_pose poses_a[TIMES], poses_b[TIMES];

static ovoid_motion take_motion(fuzz_bytes *from, int is_wild, double *times, ovoid_pose *poses) {
    ovoid_motion m = {.kind = (ovoid_motion_kind)((unsigned)take_byte(from) % 4),
                      .start = take_any_pose(from, is_wild)};
    if (m.kind == OVOID_MOTION_VELOCITY) {
        m.linear = take_vector(from, is_wild);
        m.angular = take_vector(from, is_wild);
        m.pivot = take_vector(from, is_wild);
    } else if (m.kind == OVOID_MOTION_POSES) {
        m.end = take_any_pose(from, is_wild);
    }
    m.duration = fabs(take_number(from, is_wild)) / 4;
    if (m.kind == OVOID_MOTION_PATH) {
        m.times = times;
        m.poses = poses;
        m.count = (size_t)((unsigned)take_byte(from) % (TIMES + 1));
        for (size_t i = 0; i < m.count; i++) {
            times[i] = (i ? times[i - 1] : 0) + fabs(take_number(from, is_wild)) / 8;
            poses[i] = take_any_pose(from, is_wild);
        }
    }
    return m;
}

// The pair's size and the ways of both, for what rounded poses may be off.
static double find_size(const ovoid_moving_shape *a, const ovoid_moving_shape *b, double begin, double end) {
    ovoid_box box[2] = {ovoid_moving_shape_compute_box(a, begin, end), ovoid_moving_shape_compute_box(b, begin, end)};
    double size = 0;
    for (int i = 0; i < 2; i++) {
        const double side[6] = {box[i].min.x, box[i].min.y, box[i].min.z, box[i].max.x, box[i].max.y, box[i].max.z};
        for (int k = 0; k < 6; k++) size = fmax(size, fabs(side[k]));
    }
    return size;
}

static ovoid_answer ask_at(const ovoid_moving_shape *a, const ovoid_moving_shape *b, double time) {
    ovoid_pair pair = {a->shape, b->shape, ovoid_moving_shape_compute_pose(a, time),
                       ovoid_moving_shape_compute_pose(b, time)};
    return ovoid_depth(&pair, NULL, NULL, NULL);
}

static void check_impact(const ovoid_moving_shape *a, const ovoid_moving_shape *b, double margin,
                         ovoid_motion_options options) {
    static ovoid_step steps[STEPS];
    options.steps = steps;
    options.capacity = STEPS;
    ovoid_impact x = ovoid_impact_find(&(ovoid_moving_pair){*a, *b, margin}, &options);
    ovoid_error error = {OVOID_OK, -1, ""};
    if (x.limit == OVOID_LIMIT_POSE_A || x.limit == OVOID_LIMIT_POSE_B || x.limit == OVOID_LIMIT_OPTIONS) {
        fuzz_require(x.status == OVOID_IMPACT_UNDECIDED);
        fuzz_require_code(ovoid_impact_verify(&(ovoid_moving_pair){*a, *b, margin}, &x,
                                              &(ovoid_motion_basis){.options = &options}, &error),
                          &error);
        return;
    }
    if (x.step_count <= STEPS)
        fuzz_require_code(ovoid_impact_verify(&(ovoid_moving_pair){*a, *b, margin}, &x,
                                              &(ovoid_motion_basis){.options = &options, .steps = steps}, &error),
                          &error);
    fuzz_require(x.begin <= x.free_until && x.free_until <= x.end);
    if (x.status == OVOID_IMPACT_HIT) fuzz_require(x.free_until <= x.hit_at && x.hit_at <= x.end);
    // Samples of what is free.
    double slack = 1e-9 * find_size(a, b, x.begin, x.end);
    for (int i = 0; i < 16 && x.free_until > x.begin && slack < 1e30; i++) {
        ovoid_answer at = ask_at(a, b, x.begin + (x.free_until - x.begin) * (i / 16.0));
        fuzz_require(at.upper > margin - slack);
    }
    if (x.status == OVOID_IMPACT_HIT) fuzz_require(ask_at(a, b, x.hit_at).lower <= margin + slack);
}

static void check_approach(const ovoid_moving_shape *a, const ovoid_moving_shape *b, ovoid_motion_options options) {
    static ovoid_step steps[STEPS];
    options.steps = steps;
    options.capacity = STEPS;
    ovoid_approach x = ovoid_approach_find(&(ovoid_moving_pair){*a, *b, 0}, &options);
    ovoid_error error = {OVOID_OK, -1, ""};
    if (x.limit == OVOID_LIMIT_POSE_A || x.limit == OVOID_LIMIT_POSE_B || x.limit == OVOID_LIMIT_OPTIONS) return;
    if (x.step_count <= STEPS)
        fuzz_require_code(ovoid_approach_verify(&(ovoid_moving_pair){*a, *b, 0}, &x,
                                                &(ovoid_motion_basis){.options = &options, .steps = steps}, &error),
                          &error);
    fuzz_require(x.lower <= x.upper);
    double slack = 1e-9 * find_size(a, b, x.begin, x.end);
    for (int i = 0; i <= 16 && slack < 1e30 && x.status != OVOID_OVERLAPPING; i++) {
        ovoid_answer at = ask_at(a, b, x.begin + (x.end - x.begin) * (i / 16.0));
        fuzz_require(at.upper > x.lower - slack);
    }
}

static void check_casts(const ovoid_moving_shape *a, const ovoid_moving_shape *b, fuzz_bytes *from, int is_wild) {
    ovoid_pair pair = {a->shape, b->shape, ovoid_moving_shape_compute_pose(a, 0),
                       ovoid_moving_shape_compute_pose(b, 0)};
    if (ovoid_pose_validate(&pair.pose_a) != OVOID_OK || ovoid_pose_validate(&pair.pose_b) != OVOID_OK) return;
    ovoid_impact x = ovoid_shape_cast(&pair, take_vector(from, is_wild), fabs(take_number(from, 0)) / 8, NULL);
    fuzz_require(!(x.free_until > x.hit_at));
    ovoid_posed_shape body = {a->shape, pair.pose_a};
    ovoid_ray ray = {take_vector(from, is_wild), take_vector(from, is_wild), take_number(from, is_wild), 0};
    ray.radius = fabs(take_number(from, is_wild)) / 8;
    ovoid_ray_hit hit = ovoid_shape_cast_ray(&body, &ray);
    fuzz_require(!(hit.lower > hit.upper));
    if (hit.status == OVOID_IMPACT_HIT) fuzz_require(hit.upper < INFINITY && hit.lower >= 0);
}

// B with a second part that is A's shape: against the pairs of parts alone.
static void check_solids(const ovoid_moving_shape *a, const ovoid_moving_shape *b, double margin,
                         const ovoid_motion_options *options, ovoid_pose second) {
    ovoid_posed_shape parts[2] = {{b->shape, ovoid_pose_make_identity()}, {a->shape, second}};
    ovoid_compound *compound = ovoid_compound_create(parts, 2, NULL, NULL);
    if (!compound) return;
    ovoid_moving_body bodies[2] = {{.shape = a->shape, .motion = a->motion},
                                   {.compound = compound, .motion = b->motion}};
    ovoid_body_impact x = ovoid_body_impact_find(&(ovoid_moving_body_pair){bodies[0], bodies[1], margin}, options);
    fuzz_require(!(x.impact.free_until > x.impact.hit_at));
    double least = INFINITY;
    for (size_t i = 0; i < 2; i++) {
        ovoid_moving_shape one = ovoid_moving_body_get_part(&bodies[0], 0),
                           other = ovoid_moving_body_get_part(&bodies[1], i);
        ovoid_impact alone = ovoid_impact_find(&(ovoid_moving_pair){one, other, margin}, options);
        fuzz_require(!(x.impact.free_until > alone.hit_at));
        least = fmin(least, alone.free_until);
    }
    if (x.impact.status == OVOID_IMPACT_HIT) fuzz_require(least <= x.impact.hit_at);
    ovoid_compound_destroy(compound);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes from = {data, size};
    int is_wild = take_byte(&from) > 96;
    ovoid_shape *shapes[2] = {take_any_shape(&from, is_wild), take_any_shape(&from, is_wild)};
    ovoid_moving_shape a = {.shape = shapes[0], .motion = take_motion(&from, is_wild, times_a, poses_a)};
    ovoid_moving_shape b = {.shape = shapes[1], .motion = take_motion(&from, is_wild, times_b, poses_b)};
    if (take_byte(&from) > 64) b.part = take_any_pose(&from, is_wild);
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_code sound = ovoid_motion_validate(&a.motion, &error);
    if (sound != OVOID_OK) fuzz_require_error(&error);
    if (shapes[0] && shapes[1]) {
        double margin = fabs(take_number(&from, is_wild)) / 8;
        ovoid_motion_options options = {.iterations = 1 + (uint32_t)(take_byte(&from) & 127)};
        if (take_byte(&from) > 64)
            options.begin = take_number(&from, is_wild), options.end = take_number(&from, is_wild);
        check_impact(&a, &b, margin, options);
        check_approach(&a, &b, options);
        if (sound == OVOID_OK && ovoid_motion_validate(&b.motion, NULL) == OVOID_OK)
            check_casts(&a, &b, &from, is_wild);
        check_solids(&a, &b, margin, &options, take_any_pose(&from, is_wild));
    }
    ovoid_shape_destroy(shapes[0]);
    ovoid_shape_destroy(shapes[1]);
    return 0;
}
