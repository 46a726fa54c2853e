// The court. An answer is wrong if the judge or the library's own checker refuses it, if it excludes the truth, or if
// its word is not what its bracket says.
#include "ask.h"

#include "check.h"
#include "proofs/covers.h"
#include "report.h"
#include "shapes.h"

#include <time.h>

judge *trial_judge;
const char *trial_failures;

// --- failures

static void append_failure(const tally *t, const ovoid_pair *pair, const ovoid_answer *x, const char *query,
                           const char *why) {
    FILE *f = trial_failures ? fopen(trial_failures, "a") : NULL;
    if (!f) return;
    fprintf(f, "%s, seed %llu, %s: %s\n", t->name, (unsigned long long)trial_seed, query, why);
    print_answer(f, x);
    print_pair(f, pair);
    fclose(f);
}

void trial_fail(tally *t, const ovoid_pair *pair, const ovoid_answer *x, const char *query, const char *why) {
    static int printed;
    t->wrong++;
    if (printed++ < 100) {
        printf("FAILED %s, seed %llu, %s: %s\n", t->name, (unsigned long long)trial_seed, query, why);
        append_failure(t, pair, x, query, why);
    }
    if (printed > 4) return;
    print_answer(stdout, x);
    print_pair(stdout, pair);
    fflush(stdout);
}

// --- sizes

static double vec_distance(ovoid_vec3 a, ovoid_vec3 b) { return hypot(hypot(a.x - b.x, a.y - b.y), a.z - b.z); }

static double find_extent(const ovoid_shape *shape) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    double extent = 0;
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        const double *v = p.vertices + 3 * (size_t)i;
        extent = fmax(extent, hypot(hypot(v[0], v[1]), v[2]));
    }
    return extent;
}

double pair_size(const ovoid_pair *pair) {
    ovoid_vec3 oa = ovoid_shape_get_polytope(pair->shape_a).origin, ob = ovoid_shape_get_polytope(pair->shape_b).origin;
    ovoid_vec3 a = ovoid_pose_compute_point(&pair->pose_a, oa), b = ovoid_pose_compute_point(&pair->pose_b, ob);
    return find_extent(pair->shape_a) + find_extent(pair->shape_b) + vec_distance(a, b) +
           ovoid_shape_get_radius(pair->shape_a) + ovoid_shape_get_radius(pair->shape_b);
}

static double sum_abs(ovoid_vec3 v) { return fabs(v.x) + fabs(v.y) + fabs(v.z); }

// What pairs of doubles leave of turned origins, and underflow.
static double pair_unresolved_sign(const ovoid_pair *pair) {
    return 0x1p-88 * (sum_abs(ovoid_shape_get_polytope(pair->shape_a).origin) +
                      sum_abs(ovoid_shape_get_polytope(pair->shape_b).origin)) +
           16 * OVOID_LENGTH_MIN;
}

// The least width that a bracket can be asked to have: that of the sign, and what the bodies' positions leave.
double pair_unresolved(const ovoid_pair *pair) {
    return 0x1p-88 * (sum_abs(pair->pose_a.position) + sum_abs(pair->pose_b.position)) + pair_unresolved_sign(pair);
}

// --- judging one answer

// The present pair, with what its answers have in common.
typedef struct hearing {
    tally *t;
    const ovoid_pair *pair;
    const trial_hints *hints;
    uint64_t *state;
    double d;                     // a distance near the true one, for margins and caps
    const ovoid_options *options; // of the query that is heard
} hearing;

// Distances above this part of the size have a proven sign: ten times what docs/query.md says of overlaps.
#define RESOLVED 1e-26

// must_decide: asked for the sign, with the default options.
static void compare_truth(const hearing *h, const ovoid_answer *x, const char *query, int must_decide) {
    const judge_truth *truth = h->hints->truth;
    if (!truth) return;
    h->t->compared++;
    if (!(x->lower <= truth->high && truth->low <= x->upper)) trial_fail(h->t, h->pair, x, query, "not the truth");
    if ((x->status == OVOID_SEPARATED && truth->sign <= 0) || (x->status == OVOID_OVERLAPPING && truth->sign >= 0))
        trial_fail(h->t, h->pair, x, query, "not the truth's sign");
    double known = fmin(fabs(truth->low), fabs(truth->high)) - pair_unresolved_sign(h->pair);
    if (must_decide && truth->sign != 0 && known > RESOLVED * pair_size(h->pair) && x->status == OVOID_TOUCHING)
        trial_fail(h->t, h->pair, x, query, "touching, though the distance is not that small");
}

// Counts the answer and judges it. full: the whole signed distance was asked for (depth), or the distance.
static void judge_answer(const hearing *h, const ovoid_answer *x, const ovoid_cover *cover, const char *query,
                         int full) {
    ovoid_error error = {0};
    h->t->answers++;
    if (x->iterations > h->t->iterations) h->t->iterations = x->iterations;
    judge_set_options(trial_judge, h->options);
    if (judge_verify_answer(trial_judge, h->pair, x, cover, &error) != OVOID_OK)
        trial_fail(h->t, h->pair, x, query, error.message);
    else if (ovoid_answer_verify(h->pair, x, &(ovoid_answer_basis){.options = h->options, .cover = cover}, &error) !=
             OVOID_OK)
        trial_fail(h->t, h->pair, x, query, error.message);
    else if (x->stage != OVOID_STAGE_NONE && full && x->status != OVOID_UNDECIDED &&
             judge_verify_points(trial_judge, h->pair, x, &error) != OVOID_OK)
        trial_fail(h->t, h->pair, x, query, error.message);
}

void trial_count_sign(tally *t, const ovoid_pair *pair, const ovoid_answer *x, const char *query) {
    t->separated += x->status == OVOID_SEPARATED;
    t->touching += x->status == OVOID_TOUCHING;
    t->overlapping += x->status == OVOID_OVERLAPPING;
    if (x->status != OVOID_UNDECIDED) return;
    if (t->undecided++ == 0) t->opened = trial_seed;
    if (!t->may_be_undecided) trial_fail(t, pair, x, query, "undecided");
}

void trial_count_width(tally *t, const ovoid_pair *pair, const ovoid_answer *x) {
    double width = (x->upper - x->lower - pair_unresolved(pair)) / pair_size(pair);
    if (!(width > 1e-9)) return;
    t->wide++;
    if (width > t->widest) t->widest = width;
}

static void hear_depth(const hearing *h, const ovoid_answer *x, const ovoid_cover *cover, const char *query) {
    judge_answer(h, x, cover, query, 1);
    compare_truth(h, x, query, 1);
    trial_count_sign(h->t, h->pair, x, query);
    trial_count_width(h->t, h->pair, x);
}
static void hear_distance(const hearing *h, const ovoid_answer *x, const char *query) {
    judge_answer(h, x, NULL, query, x->status == OVOID_SEPARATED);
    compare_truth(h, x, query, 1);
    trial_count_sign(h->t, h->pair, x, query);
    if (x->status == OVOID_SEPARATED) trial_count_width(h->t, h->pair, x);
}
static void hear_collide(const hearing *h, const ovoid_answer *x, const char *query) {
    judge_answer(h, x, NULL, query, 0);
    compare_truth(h, x, query, 1);
    trial_count_sign(h->t, h->pair, x, query);
}

// --- earlier proofs

// Some bytes turned over, all but the kind's: NaN, infinity, huge indices, a normal that is a little too long.
static void damage(ovoid_proof *p, int bytes_changed, uint64_t *state) {
    unsigned char *bytes = (unsigned char *)p;
    for (int i = 0; i < bytes_changed; i++) {
        size_t at = (size_t)(random_next(state) % sizeof *p);
        if (at < offsetof(ovoid_proof, kind) || at >= offsetof(ovoid_proof, count))
            bytes[at] = (unsigned char)random_next(state);
    }
}

// A proof that fits nothing: whatever it holds, the query must not trust it. One time in three it is the right one,
// with a normal that is no longer quite unit, or with some bytes changed.
static ovoid_proof make_garbage(const ovoid_proof *right, uint64_t *state) {
    ovoid_proof p = *right;
    if (random_next(state) % 3 == 0) {
        double stretch = 1 + pow(10, -random_uniform(state, 1, 16));
        p.normal = (ovoid_vec3){stretch * p.normal.x, stretch * p.normal.y, stretch * p.normal.z};
        damage(&p, (int)(random_next(state) % 4), state);
        return p;
    }
    memset(&p, 0, sizeof p);
    p.kind = (ovoid_proof_kind)(random_next(state) % 6);
    p.count = (uint32_t)(random_next(state) % (OVOID_PROOF_PAIRS + 2));
    p.normal = random_vec3(state, 1);
    for (int i = 0; i < OVOID_PROOF_PAIRS; i++) {
        p.a[i] = (uint32_t)(random_next(state) % 9);
        p.b[i] = (uint32_t)(random_next(state) % 9);
        p.weight_a[i] = random_normal(state);
        p.weight_b[i] = fabs(random_normal(state));
    }
    if (random_next(state) % 2) damage(&p, 6, state);
    return p;
}

// --- questions

// Within a margin near the distance, cold or warm.
static void ask_within(const hearing *h, const ovoid_proof *earlier) {
    const double factors[] = {0, 0.5, 1, 1 + 1e-12, 2};
    double margin = fabs(h->d) * factors[random_next(h->state) % 5];
    const char *query = earlier ? "within, warm" : "within";
    ovoid_answer x = ovoid_within(h->pair, margin, NULL, earlier);
    judge_answer(h, &x, NULL, query, 0);
    compare_truth(h, &x, query, 0);
    int within = ovoid_answer_is_within(&x, margin);
    if (within == 1 && !(x.upper <= margin)) trial_fail(h->t, h->pair, &x, query, "says within and is not");
    if (within == 0 && !(x.lower > margin)) trial_fail(h->t, h->pair, &x, query, "says farther and is not");
    int is_answered = within != -1 && x.status != OVOID_UNDECIDED;
    if (is_answered && x.limit != OVOID_LIMIT_NONE && x.limit != OVOID_LIMIT_ANSWERED)
        trial_fail(h->t, h->pair, &x, query, "answered, and the limit says otherwise");
    if (within == -1 && x.upper - x.lower > 1e-6 * pair_size(h->pair) + pair_unresolved(h->pair) &&
        x.limit == OVOID_LIMIT_NONE)
        trial_fail(h->t, h->pair, &x, query, "open, and the bracket is wide");
}

// Options of every kind: the answer may stay open, but what it says is true, and a cap is meant as one.
static void ask_limited(const hearing *h) {
    ovoid_options options = {0};
    double size = pair_size(h->pair);
    switch (random_next(h->state) % 4) {
    case 0: options.iterations = 1 + (uint32_t)(random_next(h->state) % 4); break;
    case 1: options.relative_tolerance = random_uniform(h->state, 0, 0.1); break;
    case 2: options.absolute_tolerance = random_uniform(h->state, 0, size); break;
    default: options.cap = fabs(h->d) * random_uniform(h->state, 0, 2); break;
    }
    LOCAL_COVER(cover);
    ovoid_answer x = random_next(h->state) % 2 ? ovoid_depth(h->pair, &options, NULL, &cover)
                                               : (cover.point_count = 0, ovoid_distance(h->pair, &options, NULL));
    hearing with_options = *h;
    with_options.options = &options;
    judge_answer(&with_options, &x, &cover, "with options", 0);
    compare_truth(h, &x, "with options", 0);
    if (x.limit == OVOID_LIMIT_CAP && !(x.lower > options.cap))
        trial_fail(h->t, h->pair, &x, "cap", "not proven farther");
    if (options.iterations && x.iterations > 2 * options.iterations)
        trial_fail(h->t, h->pair, &x, "iterations", "too many");
}

static void ask_warm(const hearing *h, const ovoid_proof *warm, const ovoid_proof *other) {
    LOCAL_COVER(cover);
    ovoid_answer x = ovoid_depth(h->pair, NULL, warm, &cover);
    hear_depth(h, &x, &cover, "depth, warm");
    // From the cover of the pair a hundredth of its size away.
    ovoid_pair moved = *h->pair;
    moved.pose_b.position.x += 0.01 * pair_size(h->pair);
    (void)ovoid_depth(&moved, NULL, NULL, &cover);
    x = ovoid_depth_from(h->pair, NULL, warm, &cover);
    hear_depth(h, &x, &cover, "depth, from a cover");
    x = ovoid_collide(h->pair, NULL, other);
    hear_collide(h, &x, "collide, warm");
    x = ovoid_distance(h->pair, NULL, warm);
    hear_distance(h, &x, "distance, warm");
    ask_within(h, other);
}

ovoid_proof trial_ask(tally *t, const ovoid_pair *pair, const trial_hints *hints, uint64_t *state) {
    hearing h = {t, pair, hints, state, 0, NULL};
    LOCAL_COVER(cover);
    t->pairs++;
    ovoid_answer depth = ovoid_depth(pair, NULL, NULL, &cover);
    hear_depth(&h, &depth, &cover, "depth");
    ovoid_answer same = ovoid_depth(pair, NULL, NULL, NULL);
    if (same.lower != depth.lower || same.upper != depth.upper || same.point_a.x != depth.point_a.x)
        trial_fail(t, pair, &same, "depth", "another answer the second time");
    ovoid_answer collide = ovoid_collide(pair, NULL, NULL);
    hear_collide(&h, &collide, "collide");
    ovoid_answer distance = ovoid_distance(pair, NULL, NULL);
    hear_distance(&h, &distance, "distance");
    ovoid_answer bounds = ovoid_pair_compute_bounds(pair);
    judge_answer(&h, &bounds, NULL, "bounds", 0);
    compare_truth(&h, &bounds, "bounds", 0);
    h.d = distance.upper;
    ask_within(&h, NULL);
    ask_limited(&h);

    // Warm: the pair's own proof, one of elsewhere, one of nothing at all; or the one given.
    ovoid_proof garbage = make_garbage(&depth.proof, state);
    const ovoid_proof *given = hints->earlier ? hints->earlier : &distance.proof;
    const ovoid_proof *proofs[] = {&depth.proof, &collide.proof, given, &garbage};
    const ovoid_proof *warm = proofs[random_next(state) % 4], *other = proofs[random_next(state) % 4];
    if (hints->warm == WARM_GIVEN) warm = other = given;
    ask_warm(&h, warm, other);
    return depth.proof;
}

// --- counts

void tally_print_header(void) {
    printf("%-32s %8s %9s %9s %8s %8s %6s %6s %9s %8s %5s %6s\n", "family", "pairs", "answers", "apart", "touch",
           "overlap", "open", "wide", "widest", "truth", "iter", "wrong");
}

void tally_print(const tally *t) {
    printf("%-32s %8llu %9llu %9llu %8llu %8llu %6llu %6llu %9.2g %8llu %5llu %6llu\n", t->name,
           (unsigned long long)t->pairs, (unsigned long long)t->answers, (unsigned long long)t->separated,
           (unsigned long long)t->touching, (unsigned long long)t->overlapping, (unsigned long long)t->undecided,
           (unsigned long long)t->wide, t->widest, (unsigned long long)t->compared, (unsigned long long)t->iterations,
           (unsigned long long)t->wrong);
    if (t->opened) printf("%-32s first open: seed %llu\n", "", (unsigned long long)t->opened);
}

void tally_add(tally *sum, const tally *more) {
    sum->pairs += more->pairs;
    sum->answers += more->answers;
    sum->separated += more->separated;
    sum->touching += more->touching;
    sum->overlapping += more->overlapping;
    sum->undecided += more->undecided;
    sum->wide += more->wide;
    sum->compared += more->compared;
    sum->wrong += more->wrong;
    if (more->iterations > sum->iterations) sum->iterations = more->iterations;
    sum->widest = fmax(sum->widest, more->widest);
}

double seconds_now(void) {
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
