// Random motions of random shapes: slow, some turns, hundreds of turns; needles, slabs, flat bodies, tiny and huge
// ones. Truth: distances at sampled times, each with a proof of its own. No sample before free_until may be within the
// margin, nor below an approach's lower bound; at hit_at the bodies are within the margin. Every answer's steps are
// checked, and what is altered is refused. Widths and step counts are printed, and few answers may stay undecided. To
// run more of them: test_impact_trials FIRST_SEED COUNT.
#include "moving.h"
#include "options.h"

enum { CAPACITY = 20000, SAMPLES = 120, TRIALS = 1200 };
static ovoid_step steps[CAPACITY];

static struct { long free, hit, undecided, wide, queries, most, near, approaches, loose, approach_queries; } counts;

// The pose's rounding is not the motion's: what a sample may be off by, in sizes of the bodies.
static double compute_slack(const moving_case *c) { return (1e-12 + 1e-15 * c->spin) * 20 * c->size; }

// The smallest distance at times of [begin, end), denser toward the end. An overlap counts as -infinity.
static double sample(const moving_case *c, double begin, double end, uint64_t *s) {
    double least = INFINITY;
    ovoid_proof proof = {.kind = OVOID_PROOF_NONE};
    for (int i = 0; i < SAMPLES; i++) {
        double share = random_uniform(s, 0, 1), t = begin + (end - begin) * (i % 2 ? share : 1 - exp(-20 * share));
        if (i == 0) t = begin;
        ovoid_pair pair = moving_get_pair(&c->a, &c->b, t);
        ovoid_answer x = ovoid_distance(&pair, NULL, &proof);
        proof = x.proof;
        least = fmin(least, x.upper);
    }
    return least;
}

// A change that makes the claim stronger than its proof is refused.
static void check_altered(const moving_case *c, double margin, const ovoid_impact *x) {
    ovoid_impact y = *x;
    double span = x->end - x->begin;
    y.free_until = x->free_until + fmax(1e-3 * span, 1e-3);
    CHECK(ovoid_impact_verify(&(ovoid_moving_pair){c->a, c->b, margin}, &y, &(ovoid_motion_basis){.steps = steps},
                              NULL) != OVOID_OK);
    y = *x;
    if (x->status == OVOID_IMPACT_HIT) {
        y.status = OVOID_IMPACT_FREE;
        CHECK(ovoid_impact_verify(&(ovoid_moving_pair){c->a, c->b, margin}, &y, &(ovoid_motion_basis){.steps = steps},
                                  NULL) != OVOID_OK);
    }
    if (x->status == OVOID_IMPACT_FREE) {
        y.status = OVOID_IMPACT_HIT;
        y.hit_at = x->end;
        CHECK(ovoid_impact_verify(&(ovoid_moving_pair){c->a, c->b, margin}, &y, &(ovoid_motion_basis){.steps = steps},
                                  NULL) != OVOID_OK);
    }
    if (!x->step_count) return;
    // A step left out, one that parts nothing, one that is no unit vector, one that goes back.
    y = *x;
    y.step_count--;
    CHECK(ovoid_impact_verify(&(ovoid_moving_pair){c->a, c->b, margin}, &y, &(ovoid_motion_basis){.steps = steps},
                              NULL) != OVOID_OK);
    ovoid_step kept = steps[x->step_count - 1];
    steps[x->step_count - 1].normal = (ovoid_vec3){-kept.normal.x, -kept.normal.y, -kept.normal.z};
    CHECK(ovoid_impact_verify(&(ovoid_moving_pair){c->a, c->b, margin}, x, &(ovoid_motion_basis){.steps = steps},
                              NULL) != OVOID_OK);
    steps[x->step_count - 1].normal = moving_scaled(kept.normal, 1.001);
    CHECK(ovoid_impact_verify(&(ovoid_moving_pair){c->a, c->b, margin}, x, &(ovoid_motion_basis){.steps = steps},
                              NULL) != OVOID_OK);
    steps[x->step_count - 1] = kept;
    steps[x->step_count - 1].until = NAN;
    CHECK(ovoid_impact_verify(&(ovoid_moving_pair){c->a, c->b, margin}, x, &(ovoid_motion_basis){.steps = steps},
                              NULL) != OVOID_OK);
    steps[x->step_count - 1] = kept;
}

static void try_impact(const moving_case *c, double margin, uint64_t *s) {
    ovoid_motion_options o = {.steps = steps, .capacity = CAPACITY};
    ovoid_error error;
    ovoid_impact x = ovoid_impact_find(&(ovoid_moving_pair){c->a, c->b, margin}, &o);
    CHECK_LE(x.step_count, CAPACITY);
    if (!CHECK_EQ(ovoid_impact_verify(&(ovoid_moving_pair){c->a, c->b, margin}, &x,
                                      &(ovoid_motion_basis){.steps = steps}, &error),
                  OVOID_OK))
        printf("  %s\n", error.message);
    if (x.free_until > x.begin) CHECK_LE(margin - compute_slack(c), sample(c, x.begin, x.free_until, s));
    if (x.status == OVOID_IMPACT_HIT) {
        ovoid_pair pair = moving_get_pair(&c->a, &c->b, x.hit_at);
        CHECK_LE(ovoid_distance(&pair, NULL, NULL).upper, margin);
        counts.hit++;
        counts.wide += x.hit_at - x.free_until > 1e-9;
    }
    counts.free += x.status == OVOID_IMPACT_FREE;
    counts.undecided += x.status == OVOID_IMPACT_UNDECIDED;
    counts.queries += x.iterations;
    if ((long)x.iterations > counts.most) counts.most = (long)x.iterations;
    check_altered(c, margin, &x);
    // Only a part of the time: the same truth.
    ovoid_motion_options late = {.begin = 0.4, .end = 0.9, .steps = steps, .capacity = CAPACITY};
    ovoid_impact y = ovoid_impact_find(&(ovoid_moving_pair){c->a, c->b, margin}, &late);
    CHECK_EQ(
        ovoid_impact_verify(&(ovoid_moving_pair){c->a, c->b, margin}, &y, &(ovoid_motion_basis){.steps = steps}, NULL),
        OVOID_OK);
    if (y.status == OVOID_IMPACT_HIT) CHECK_LE(x.free_until, y.hit_at);
}

static void try_approach(const moving_case *c, uint64_t *s) {
    ovoid_motion_options o = {.steps = steps, .capacity = CAPACITY};
    ovoid_error error;
    ovoid_approach x = ovoid_approach_find(&(ovoid_moving_pair){c->a, c->b, 0}, &o);
    if (!CHECK_EQ(ovoid_approach_verify(&(ovoid_moving_pair){c->a, c->b, 0}, &x, &(ovoid_motion_basis){.steps = steps},
                                        &error),
                  OVOID_OK))
        printf("  %s\n", error.message);
    double least = sample(c, x.begin, x.end, s), slack = compute_slack(c);
    CHECK_LE(x.lower - slack, least);
    if (x.limit == OVOID_LIMIT_NONE && x.status != OVOID_OVERLAPPING) CHECK_LE(0, least + slack);
    ovoid_pair pair = moving_get_pair(&c->a, &c->b, x.time);
    CHECK_LE(ovoid_distance(&pair, NULL, NULL).lower, x.upper);
    counts.approaches += x.status != OVOID_OVERLAPPING;
    counts.loose += x.status != OVOID_OVERLAPPING && x.limit != OVOID_LIMIT_NONE;
    counts.approach_queries += x.status != OVOID_OVERLAPPING ? x.iterations : 0;
    if (!x.step_count || x.status == OVOID_OVERLAPPING || x.begin == x.end) return;
    ovoid_approach y = x;
    y.lower = x.lower + 1e-3 * fabs(x.lower) + 1e-6 * c->size;
    y.upper = fmax(y.lower, y.upper);
    CHECK(ovoid_approach_verify(&(ovoid_moving_pair){c->a, c->b, 0}, &y, &(ovoid_motion_basis){.steps = steps}, NULL) !=
          OVOID_OK);
    y = x;
    y.upper = y.lower;
    CHECK(ovoid_approach_verify(&(ovoid_moving_pair){c->a, c->b, 0}, &y, &(ovoid_motion_basis){.steps = steps}, NULL) !=
          OVOID_OK);
}

int main(int count, char **arguments) {
    uint64_t first = 1, wanted = TRIALS;
    const test_option options[] = {{"seed", "of the first trial (1)", &first, NULL, NULL, NULL},
                                   {"trials", "how many", &wanted, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    long trials = (long)wanted;
    for (uint64_t seed = first; seed < first + wanted; seed++) {
        moving_case c;
        uint64_t s = seed;
        check_seed = seed;
        moving_make(&c, seed);
        try_impact(&c, seed % 3 == 0 ? 0.1 * c.size : 0, &s);
        if (seed % 2) try_approach(&c, &s);
        moving_destroy(&c);
    }
    check_seed = 0;
    printf("free %ld, hit %ld (wider than asked: %ld), undecided %ld; queries %.1f, most %ld\n", counts.free,
           counts.hit, counts.wide, counts.undecided, (double)counts.queries / (double)trials, counts.most);
    printf("approaches %ld (wider than asked: %ld), queries %.1f\n", counts.approaches, counts.loose,
           (double)counts.approach_queries / (double)counts.approaches);
    CHECK_LE(counts.undecided, trials / 100 + 1);
    CHECK_LE(counts.wide, trials / 100 + 1);
    CHECK_LE(counts.loose, counts.approaches / 20 + 1);
    return check_end();
}
