// The bound of a step (motion/motion_gap.h): over an interval of times the gap along a direction, fixed or turning with
// a body, is nowhere below what is claimed from its two ends. Truth: the gap itself at sampled times. That the bound is
// worth something: over a short interval it is below the least sample by the square of the angle at most.
#include "motion/motion_gap.h"
#include "moving.h"

enum { SAMPLES = 24 };

// The least gap at sampled times between both ends, each with its own rounding.
static double sample(const motion_pair *p, const motion_gap *from, ovoid_step_frame frame, double to, double *error) {
    double least = INFINITY;
    *error = 0;
    for (int i = 0; i <= SAMPLES; i++) {
        double t = i < SAMPLES ? from->time + (to - from->time) * i / SAMPLES : to;
        motion_gap g;
        motion_gap_find_end(p, from, frame, t, &g);
        least = fmin(least, motion_gap_get_lower(&g) + g.error);
        *error = fmax(*error, g.error);
    }
    return least;
}

static void check_interval(const moving_case *c, const motion_pair *p, double begin, double end, vec3 n, int frame) {
    motion_gap from, to;
    double error;
    motion_gap_find(p, begin, n, &from);
    motion_gap_find_end(p, &from, (ovoid_step_frame)frame, end, &to);
    double bound = motion_gap_compute_lower(p, (ovoid_step_frame)frame, &from, &to);
    double least = sample(p, &from, (ovoid_step_frame)frame, end, &error);
    CHECK_LE(bound, least + error);
    // Half the square of the angles, of the sizes and distances there are.
    double angle = (p->a.piece.turn / p->a.piece.span + p->b.piece.turn / p->b.piece.span) * (end - begin);
    double way = (vec3_norm(p->a.piece.travel) / p->a.piece.span + vec3_norm(p->b.piece.travel) / p->b.piece.span) *
                 (end - begin);
    double far = from.size + p->a.reach + p->b.reach;
    CHECK_LE(least - bound, angle * angle * 2 * far + 2 * angle * way + 4 * error + 1e-12 * c->size);
}

// ---- motions whose bound is as low as the gap itself comes: a term that is too small by a few percent shows

// A segment from one point to another, in its own frame.
static ovoid_shape *make_segment(vec3 from, vec3 to) {
    double xyz[6] = {from.x, from.y, from.z, to.x, to.y, to.z};
    return ovoid_shape_create_from_points(xyz, 2, NULL, NULL);
}

// A turns about z, and n with it; B rests beside it, and reaches farthest where n looks.
static void check_turning_normal(uint64_t seed) {
    uint64_t s = check_seed = seed;
    ovoid_shape *a = ovoid_shape_create_box((vec3){0.1, 0.1, 0.1}, NULL, NULL);
    double length = random_uniform(&s, 1, 5), far = random_uniform(&s, 0, 5);
    ovoid_shape *b = make_segment((vec3){-length, 0, 0}, (vec3){0, 0, 0});
    moving_case c = {.size = 1};
    ovoid_pose here = {{0, 0, 0}, {1, 0, 0, 0}};
    c.a = (ovoid_moving_shape){.shape = a,
                               .motion = ovoid_motion_make_velocity(here, (vec3){0, 0, 0}, (vec3){0, 0, 1}, 1)};
    c.b = (ovoid_moving_shape){.shape = b, .motion = ovoid_motion_make_still((ovoid_pose){{-far, 0, 0}, {1, 0, 0, 0}})};
    motion_pair p;
    CHECK_EQ(motion_pair_make(&c.a, &c.b, 0, &p), OVOID_LIMIT_NONE);
    double angle = random_uniform(&s, 0.02, 0.4), begin = random_uniform(&s, 0, 0.1);
    for (int sign = -1; sign <= 1; sign += 2) {
        vec3 n = {sign * cos(begin + angle / 2), -sign * sin(begin + angle / 2), 0};
        check_interval(&c, &p, begin, begin + angle, n, OVOID_STEP_A);
        n = (vec3){sign, 0, 0};
        check_interval(&c, &p, 0, angle, n, OVOID_STEP_A);
    }
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
}

// Both turn nearly alike: what is left is the product of their angular velocities.
static void check_turning_together(uint64_t seed) {
    uint64_t s = check_seed = seed;
    ovoid_shape *a = ovoid_shape_create_box((vec3){0.1, 0.1, 0.1}, NULL, NULL);
    ovoid_shape *b = make_segment(vec3_scale(vec3_unit(bits_vec3(&s, 1)), 3), (vec3){0, 0, 0});
    vec3 w = vec3_scale(vec3_unit(bits_vec3(&s, 1)), 4), v = vec3_add(w, bits_vec3(&s, 0.2));
    moving_case c = {.size = 1};
    ovoid_pose here = {{0, 0, 0}, {1, 0, 0, 0}};
    c.a = (ovoid_moving_shape){.shape = a, .motion = ovoid_motion_make_velocity(here, (vec3){0, 0, 0}, w, 1)};
    c.b = (ovoid_moving_shape){.shape = b, .motion = ovoid_motion_make_velocity(here, (vec3){0, 0, 0}, v, 1)};
    motion_pair p;
    CHECK_EQ(motion_pair_make(&c.a, &c.b, 0, &p), OVOID_LIMIT_NONE);
    double begin = random_uniform(&s, 0, 0.5), end = begin + random_uniform(&s, 0.02, 0.3);
    for (int k = 0; k < 8; k++) {
        vec3 n = vec3_unit(bits_vec3(&s, 1));
        check_interval(&c, &p, begin, end, n, OVOID_STEP_A);
        check_interval(&c, &p, begin, end, n, OVOID_STEP_B);
    }
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
}

int main(void) {
    for (uint64_t seed = 1; seed <= 1200; seed++) {
        moving_case c;
        motion_pair p;
        uint64_t s = check_seed = seed;
        moving_make(&c, seed);
        double begin = random_uniform(&s, 0, 0.99);
        CHECK_EQ(motion_pair_make(&c.a, &c.b, begin, &p), OVOID_LIMIT_NONE);
        // Angles of both bodies from 1e-3 to 10 in all, not beyond the pieces.
        double rate = p.a.piece.turn / p.a.piece.span + p.b.piece.turn / p.b.piece.span + 1;
        double end = begin + exp(random_uniform(&s, log(1e-3), log(10))) / rate;
        end = fmin(end, fmin(p.end, 1));
        vec3 n = vec3_unit(bits_vec3(&s, 1));
        check_interval(&c, &p, begin, end, n, OVOID_STEP_WORLD);
        if (p.a.piece.turn > 0) check_interval(&c, &p, begin, end, n, OVOID_STEP_A);
        if (p.b.piece.turn > 0) check_interval(&c, &p, begin, end, n, OVOID_STEP_B);
        moving_destroy(&c);
    }
    for (uint64_t seed = 1; seed <= 60; seed++) check_turning_normal(seed);
    for (uint64_t seed = 1; seed <= 200; seed++) check_turning_together(seed);
    return check_end();
}
