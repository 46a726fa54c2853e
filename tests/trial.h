// What the trials share: every query of a pair, each answer put before the exact judge, and counts by family.
#ifndef OVOID_TESTS_TRIAL_H
#define OVOID_TESTS_TRIAL_H

#include "check.h"
#include "judge.h"
#include "ovoid/ovoid.h"

#include <time.h>

// Counts of one family of pairs.
typedef struct tally {
    const char *name;
    int may_be_undecided; // documented: near the limit of doubles the sign stays open
    long pairs, answers, separated, touching, overlapping, undecided, wide, wrong;
    uint32_t iterations;
    double widest;   // of distance and depth, in parts of the pair's size
    uint64_t opened; // the seed of the first pair whose sign stayed open
} tally;

static judge *trial_judge;
static int trial_printed;

static inline void print_shape(const char *name, const ovoid_shape *shape, const ovoid_pose *pose) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    printf("  %s: rank %u, radius %.17g, origin %.17g %.17g %.17g, position %.17g %.17g %.17g, wxyz %.17g %.17g %.17g "
           "%.17g\n",
           name, p.rank, ovoid_shape_get_radius(shape), p.origin.x, p.origin.y, p.origin.z, pose->position.x,
           pose->position.y, pose->position.z, pose->rotation.w, pose->rotation.x, pose->rotation.y, pose->rotation.z);
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        const double *v = p.vertices + 3 * (size_t)i;
        printf("   %.17g %.17g %.17g\n", v[0], v[1], v[2]);
    }
}

static inline void print_answer(const ovoid_answer *x) {
    printf("  %s by %s, limit %s, %u iterations, [%.17g, %.17g], proof %s of %u, normal %.17g %.17g %.17g\n",
           ovoid_status_get_name(x->status), ovoid_stage_get_name(x->stage), ovoid_limit_get_name(x->limit),
           x->iterations, x->lower, x->upper, ovoid_proof_kind_get_name(x->proof.kind), x->proof.count, x->normal.x,
           x->normal.y, x->normal.z);
    printf("  points %.17g %.17g %.17g, %.17g %.17g %.17g\n", x->point_a.x, x->point_a.y, x->point_a.z, x->point_b.x,
           x->point_b.y, x->point_b.z);
}

// A failure, with all that is needed to see it again; the pair in full for the first few.
static inline void trial_fail(tally *t, const ovoid_pair *pair, const ovoid_answer *x, const char *query,
                              const char *why) {
    t->wrong++;
    check_failed++;
    if (trial_printed++ < 100)
        printf("FAILED %s, seed %llu, %s: %s\n", t->name, (unsigned long long)check_seed, query, why);
    if (trial_printed > 4) return;
    print_answer(x);
    print_shape("A", pair->shape_a, &pair->pose_a);
    print_shape("B", pair->shape_b, &pair->pose_b);
    fflush(stdout);
}

static inline double vec_distance(ovoid_vec3 a, ovoid_vec3 b) { return hypot(hypot(a.x - b.x, a.y - b.y), a.z - b.z); }

static inline double find_extent(const ovoid_shape *shape) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    double extent = 0;
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        const double *v = p.vertices + 3 * (size_t)i;
        extent = fmax(extent, hypot(hypot(v[0], v[1]), v[2]));
    }
    return extent;
}

// The pair's size: both extents about the body frames, the distance of the frames and the radii.
static inline double pair_size(const ovoid_pair *pair) {
    ovoid_vec3 oa = ovoid_shape_get_polytope(pair->shape_a).origin, ob = ovoid_shape_get_polytope(pair->shape_b).origin;
    ovoid_vec3 a = ovoid_pose_compute_point(&pair->pose_a, oa), b = ovoid_pose_compute_point(&pair->pose_b, ob);
    return find_extent(pair->shape_a) + find_extent(pair->shape_b) + vec_distance(a, b) +
           ovoid_shape_get_radius(pair->shape_a) + ovoid_shape_get_radius(pair->shape_b);
}

// The least that a bracket can be asked to be narrower than: underflow, and what pairs of doubles leave of positions
// and origins.
static inline double pair_unresolved(const ovoid_pair *pair) {
    const ovoid_shape *shapes[2] = {pair->shape_a, pair->shape_b};
    const ovoid_pose *poses[2] = {&pair->pose_a, &pair->pose_b};
    double sum = 0;
    for (int i = 0; i < 2; i++) {
        ovoid_vec3 o = ovoid_shape_get_polytope(shapes[i]).origin, p = poses[i]->position;
        sum += fabs(o.x) + fabs(o.y) + fabs(o.z) + fabs(p.x) + fabs(p.y) + fabs(p.z);
    }
    return 0x1p-88 * sum + 16 * OVOID_LENGTH_MIN;
}

// Counts the answer and judges it. full: the whole signed distance was asked for (depth), or the distance.
static inline void trial_judge_answer(tally *t, const ovoid_pair *pair, const ovoid_answer *x, const ovoid_cover *cover,
                                      const char *query, int full) {
    ovoid_error error = {0};
    t->answers++;
    check_passed++;
    if (x->iterations > t->iterations) t->iterations = x->iterations;
    if (judge_check_answer(trial_judge, pair, x, cover, &error) != OVOID_OK)
        trial_fail(t, pair, x, query, error.message);
    else if (ovoid_answer_check(pair, x, cover, &error) != OVOID_OK)
        trial_fail(t, pair, x, query, error.message);
    else if (x->stage != OVOID_STAGE_NONE && full && x->status != OVOID_UNDECIDED &&
             judge_check_points(trial_judge, pair, x, &error) != OVOID_OK)
        trial_fail(t, pair, x, query, error.message);
}

// A query that must decide the sign.
static inline void trial_count_sign(tally *t, const ovoid_pair *pair, const ovoid_answer *x, const char *query) {
    t->separated += x->status == OVOID_SEPARATED;
    t->touching += x->status == OVOID_TOUCHING;
    t->overlapping += x->status == OVOID_OVERLAPPING;
    if (x->status != OVOID_UNDECIDED) return;
    if (t->undecided++ == 0) t->opened = check_seed;
    if (!t->may_be_undecided) trial_fail(t, pair, x, query, "undecided");
}

// A query that was asked for the bracket to 1e-9 of the size.
static inline void trial_count_width(tally *t, const ovoid_pair *pair, const ovoid_answer *x) {
    double width = (x->upper - x->lower - pair_unresolved(pair)) / pair_size(pair);
    if (!(width > 1e-9)) return;
    t->wide++;
    if (width > t->widest) t->widest = width;
}

// A proof that fits nothing: whatever it holds, the query must not trust it.
static inline ovoid_proof trial_make_garbage(uint64_t *state) {
    ovoid_proof p;
    unsigned char *bytes = (unsigned char *)&p;
    memset(&p, 0, sizeof p);
    p.kind = (ovoid_proof_kind)(random_next(state) % 6);
    p.count = (uint32_t)(random_next(state) % (OVOID_PROOF_PAIRS + 2));
    p.normal = (ovoid_vec3){random_normal(state), random_normal(state), random_normal(state)};
    for (int i = 0; i < OVOID_PROOF_PAIRS; i++) {
        p.a[i] = (uint32_t)(random_next(state) % 9);
        p.b[i] = (uint32_t)(random_next(state) % 9);
        p.weight_a[i] = random_normal(state);
        p.weight_b[i] = fabs(random_normal(state));
    }
    // Some of them with bits turned over: NaN, infinity, huge indices.
    if (random_next(state) % 2)
        for (int i = 0; i < 6; i++) {
            size_t at = (size_t)(random_next(state) % sizeof p);
            if (at < offsetof(ovoid_proof, kind) || at >= offsetof(ovoid_proof, count))
                bytes[at] = (unsigned char)random_next(state);
        }
    return p;
}

// Within a margin near the distance, and one at random.
static inline void trial_ask_within(tally *t, const ovoid_pair *pair, double d, uint64_t *state) {
    const double factors[] = {0, 0.5, 1, 1 + 1e-12, 2};
    double margin = fabs(d) * factors[random_next(state) % 5];
    ovoid_answer x = ovoid_within(pair, margin, NULL, NULL);
    trial_judge_answer(t, pair, &x, NULL, "within", 0);
    int within = ovoid_answer_is_within(&x, margin);
    if (within == 1 && !(x.upper <= margin)) trial_fail(t, pair, &x, "within", "says within and is not");
    if (within == 0 && !(x.lower > margin)) trial_fail(t, pair, &x, "within", "says farther and is not");
    if (within == -1 && x.upper - x.lower > 1e-6 * pair_size(pair) + pair_unresolved(pair) &&
        x.limit == OVOID_LIMIT_NONE)
        trial_fail(t, pair, &x, "within", "open, and the bracket is wide");
}

// Options of every kind: the answer may stay open, but what it says is true, and a cap is meant as one.
static inline void trial_ask_limited(tally *t, const ovoid_pair *pair, double d, uint64_t *state) {
    ovoid_options options = {0};
    double size = pair_size(pair);
    switch (random_next(state) % 4) {
    case 0: options.iterations = 1 + (uint32_t)(random_next(state) % 4); break;
    case 1: options.relative_tolerance = random_uniform(state, 0, 0.1); break;
    case 2: options.absolute_tolerance = random_uniform(state, 0, size); break;
    default: options.cap = fabs(d) * random_uniform(state, 0, 2); break;
    }
    ovoid_cover cover;
    judge_set_touching(trial_judge, INFINITY);
    ovoid_answer x = random_next(state) % 2 ? ovoid_depth(pair, &options, NULL, &cover)
                                            : (cover.point_count = 0, ovoid_distance(pair, &options, NULL));
    trial_judge_answer(t, pair, &x, &cover, "with options", 0);
    judge_set_touching(trial_judge, 1e-6);
    if (x.limit == OVOID_LIMIT_CAP && !(x.lower > options.cap)) trial_fail(t, pair, &x, "cap", "not proven farther");
    if (options.iterations && x.iterations > 2 * options.iterations) trial_fail(t, pair, &x, "iterations", "too many");
}

// All queries of a pair. earlier: a proof of another pose or another pair, or NULL. Returns the depth's proof.
static inline ovoid_proof trial_ask(tally *t, const ovoid_pair *pair, const ovoid_proof *earlier, uint64_t *state) {
    ovoid_cover cover;
    t->pairs++;
    ovoid_answer depth = ovoid_depth(pair, NULL, NULL, &cover);
    trial_judge_answer(t, pair, &depth, &cover, "depth", 1);
    trial_count_sign(t, pair, &depth, "depth");
    trial_count_width(t, pair, &depth);

    ovoid_answer same = ovoid_depth(pair, NULL, NULL, NULL);
    if (same.lower != depth.lower || same.upper != depth.upper || same.point_a.x != depth.point_a.x)
        trial_fail(t, pair, &same, "depth", "another answer the second time");

    ovoid_answer collide = ovoid_collide(pair, NULL, NULL);
    trial_judge_answer(t, pair, &collide, NULL, "collide", 0);
    trial_count_sign(t, pair, &collide, "collide");

    ovoid_answer distance = ovoid_distance(pair, NULL, NULL);
    trial_judge_answer(t, pair, &distance, NULL, "distance", distance.status == OVOID_SEPARATED);
    trial_count_sign(t, pair, &distance, "distance");
    if (distance.status == OVOID_SEPARATED) trial_count_width(t, pair, &distance);

    ovoid_answer bounds = ovoid_bounds(pair);
    trial_judge_answer(t, pair, &bounds, NULL, "bounds", 0);
    trial_ask_within(t, pair, distance.upper, state);

    trial_ask_limited(t, pair, distance.upper, state);

    // Warm: the pair's own proof, one of elsewhere, one of nothing at all.
    ovoid_proof garbage = trial_make_garbage(state);
    const ovoid_proof *proofs[] = {&depth.proof, &collide.proof, earlier ? earlier : &distance.proof, &garbage};
    const ovoid_proof *warm = proofs[random_next(state) % 4], *other = proofs[random_next(state) % 4];
    ovoid_answer again = ovoid_depth(pair, NULL, warm, &cover);
    trial_judge_answer(t, pair, &again, &cover, "depth, warm", 1);
    trial_count_sign(t, pair, &again, "depth, warm");
    again = ovoid_collide(pair, NULL, other);
    trial_judge_answer(t, pair, &again, NULL, "collide, warm", 0);
    trial_count_sign(t, pair, &again, "collide, warm");
    again = ovoid_distance(pair, NULL, warm);
    trial_judge_answer(t, pair, &again, NULL, "distance, warm", again.status == OVOID_SEPARATED);
    return depth.proof;
}

static inline void tally_print_header(void) {
    printf("%-22s %7s %8s %8s %8s %8s %6s %6s %9s %5s %6s\n", "family", "pairs", "answers", "apart", "touch", "overlap",
           "open", "wide", "widest", "iter", "wrong");
}

static inline void tally_print(const tally *t) {
    printf("%-22s %7ld %8ld %8ld %8ld %8ld %6ld %6ld %9.2g %5u %6ld\n", t->name, t->pairs, t->answers, t->separated,
           t->touching, t->overlapping, t->undecided, t->wide, t->widest, t->iterations, t->wrong);
    if (t->undecided) printf("%-22s first open: seed %llu\n", "", (unsigned long long)t->opened);
}

static inline double seconds_now(void) {
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
