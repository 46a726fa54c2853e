// The gap of two moving bodies at one time, of which every step of an impact is made, before the exact judge: for the
// poses that are computed there, what is left after the error of the measurement must be shown by the normal in
// rational arithmetic. What the poses themselves may be off by is added again, as it is not the judge's matter
// (tests/core/motion/test_motion_pose.c). So no step, and no "free", stands on a gap that rounding made.
#include "judge.h"
#include "motion/motion_gap.h"
#include "moving.h"

// The lower bound L along n as an answer about the pair; its other half is that of a query.
static ovoid_answer make_claim(const ovoid_pair *pair, double lower, vec3 n) {
    ovoid_answer x = ovoid_distance(pair, NULL, NULL);
    x.lower = lower;
    x.normal = x.proof.normal = n;
    x.proof.normal_low = (vec3){0, 0, 0};
    x.status = lower > 0 ? OVOID_SEPARATED : x.upper < 0 ? OVOID_OVERLAPPING : OVOID_UNDECIDED;
    return x;
}

static long shown;

static void check_gap(judge *context, const moving_case *c, double time, vec3 n) {
    motion_pair p;
    motion_gap g;
    ovoid_pair pair;
    ovoid_error error = {.message = ""};
    CHECK_EQ(motion_pair_make(&c->a, &c->b, time, &p), OVOID_LIMIT_NONE);
    double shift = motion_pair_find_pair(&p, time, &pair);
    motion_gap_find(&p, time, n, &g);
    ovoid_answer x = make_claim(&pair, motion_gap_get_lower(&g) + shift, n);
    if (!CHECK_EQ(judge_verify_answer(context, &pair, &x, NULL, &error), OVOID_OK)) printf("  %s\n", error.message);
    // It is no less than it must be: a thousand roundings more are not shown.
    x = make_claim(&pair, x.lower + 1e3 * 0x1p-53 * g.size, n);
    shown += judge_verify_answer(context, &pair, &x, NULL, &error) != OVOID_OK;
}

int main(void) {
    judge *context = judge_create();
    for (uint64_t seed = 1; seed <= 300; seed++) {
        moving_case c;
        uint64_t s = check_seed = seed;
        moving_make(&c, seed);
        for (int k = 0; k < 4; k++) {
            double time = k ? random_uniform(&s, 0, 1) : 0;
            ovoid_pair pair = moving_get_pair(&c.a, &c.b, time);
            vec3 nearest = vec3_unit(ovoid_distance(&pair, NULL, NULL).normal), any = vec3_unit(bits_vec3(&s, 1));
            check_gap(context, &c, time, k % 2 ? any : nearest);
        }
        judge_forget(context);
        moving_destroy(&c);
    }
    check_seed = 0;
    CHECK_LE(600, shown);
    judge_destroy(context);
    return check_end();
}
