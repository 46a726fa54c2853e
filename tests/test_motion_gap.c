// The bound of a step (query/motion_gap.h): over an interval of times the gap along a direction, fixed or turning with
// a body, is nowhere below what is claimed from its two ends. Truth: the gap itself at sampled times. That the bound is
// worth something: over a short interval it is below the least sample by the square of the angle at most.
#include "moving.h"
#include "query/motion_gap.h"

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
    return check_end();
}
