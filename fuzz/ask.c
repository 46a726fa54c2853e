// Truth: the judge (docs/proofs.md), which knows nothing of how an answer was found; and for small bodies its brute
// force, which knows nothing of proofs.
#include "ask.h"

#ifdef OVOID_HAVE_JUDGE

#include <judge.h>

/// What the answers to a pair have said so far: d is in [lower, upper].
typedef struct findings {
    const ovoid_pair *pair;
    const ovoid_options *options; ///< of the queries
    judge *judge;
    double lower, upper;
} findings;

// An answer and, where the full default question was asked, its points.
static void check(findings *f, const ovoid_answer *x, const ovoid_cover *cover, int is_full) {
    ovoid_error error = {OVOID_OK, -1, ""};
    judge_set_options(f->judge, f->options);
    ovoid_code code = judge_verify_answer(f->judge, f->pair, x, cover, &error);
    if (code == OVOID_OK)
        code = ovoid_answer_verify(f->pair, x, &(ovoid_answer_basis){.options = f->options, .cover = cover}, &error);
    // Where a limit ended the search of a depth, a common point may be all there is.
    int has_points = x->status == OVOID_SEPARATED || x->limit == OVOID_LIMIT_NONE;
    if (code == OVOID_OK && is_full && has_points && x->stage != OVOID_STAGE_NONE && x->status != OVOID_UNDECIDED)
        code = judge_verify_points(f->judge, f->pair, x, &error);
    if (code != OVOID_OK) {
        (void)fprintf(stderr, "wrong answer: %s\n", error.message);
        abort();
    }
    // Brackets of one d have a point in common.
    f->lower = fmax(f->lower, x->lower);
    f->upper = fmin(f->upper, x->upper);
    fuzz_require(f->lower <= f->upper);
}

static void check_within(findings *f, double margin, const ovoid_proof *earlier) {
    ovoid_answer x = ovoid_within(f->pair, margin, f->options, earlier);
    check(f, &x, NULL, 0);
    int within = ovoid_answer_is_within(&x, margin);
    if (within == 1) fuzz_require(x.upper <= margin);
    if (within == 0) fuzz_require(x.lower > margin);
}

static void ask_all(findings *f, double margin, const ovoid_options *options, const ovoid_proof *earlier) {
    static uint64_t memory[OVOID_COVER_SIZE / sizeof(uint64_t)];
    static ovoid_cover cover = {.memory = memory, .size = sizeof memory}; // filled by each call
    f->options = options;
    int is_full = options == NULL;
    ovoid_answer x = ovoid_collide(f->pair, options, earlier);
    check(f, &x, NULL, 0);
    check_within(f, margin, earlier);
    x = ovoid_distance(f->pair, options, earlier);
    check(f, &x, NULL, is_full && x.status == OVOID_SEPARATED);
    x = ovoid_depth(f->pair, options, earlier, &cover);
    check(f, &x, &cover, is_full);
    // With its own proof and cover.
    ovoid_proof own = x.proof;
    x = ovoid_depth_from(f->pair, options, &own, &cover);
    check(f, &x, &cover, is_full);
    f->options = NULL;
    x = ovoid_pair_compute_bounds(f->pair);
    check(f, &x, NULL, 0);
}

static void check_truth(findings *f) {
    enum { MOST = 7 };
    judge_truth truth;
    if (ovoid_shape_get_polytope(f->pair->shape_a).vertex_count > MOST ||
        ovoid_shape_get_polytope(f->pair->shape_b).vertex_count > MOST || f->lower == -INFINITY ||
        judge_compute_truth(f->judge, f->pair, &truth, NULL) != OVOID_OK)
        return;
    fuzz_require(f->lower <= truth.high && truth.low <= f->upper);
    if (f->lower > 0) fuzz_require(truth.sign > 0);
    if (f->upper < 0) fuzz_require(truth.sign < 0);
}

void fuzz_ask(const ovoid_pair *pair, double margin, const ovoid_options *options, const ovoid_proof *earlier) {
    findings f = {pair, NULL, judge_create(), -INFINITY, INFINITY};
    fuzz_require(f.judge != NULL);
    ask_all(&f, margin, NULL, NULL);
    ask_all(&f, margin, NULL, earlier);
    if (options) ask_all(&f, margin, options, earlier);
    check_truth(&f);
    judge_destroy(f.judge);
}

#else

void fuzz_ask(const ovoid_pair *pair, double margin, const ovoid_options *options, const ovoid_proof *earlier) {
    ovoid_answer answers[4] = {ovoid_collide(pair, options, earlier), ovoid_distance(pair, options, earlier),
                               ovoid_within(pair, margin, options, earlier), ovoid_pair_compute_bounds(pair)};
    for (int i = 0; i < 4; i++)
        fuzz_require(ovoid_answer_verify(pair, &answers[i], &(ovoid_answer_basis){.options = i < 3 ? options : NULL},
                                         NULL) == OVOID_OK);
}

#endif

ovoid_proof fuzz_take_proof(fuzz_bytes *from) {
    ovoid_proof p;
    memset(&p, 0, sizeof p);
    p.kind = (ovoid_proof_kind)((unsigned)take_byte(from) % 6);
    p.count = (uint32_t)take_byte(from) % (OVOID_PROOF_PAIRS + 3);
    p.normal = (ovoid_vec3){take_double(from), take_double(from), take_double(from)};
    for (int i = 0; i < OVOID_PROOF_PAIRS; i++) {
        p.a[i] = (uint32_t)take_byte(from); // negative: huge
        p.b[i] = (uint32_t)take_byte(from);
        p.weight_a[i] = take_double(from);
        p.weight_b[i] = take_double(from);
    }
    if (take_byte(from) > 64) p.normal_low = (ovoid_vec3){take_double(from), take_double(from), take_double(from)};
    p.inner_a = (ovoid_vec3){take_double(from), take_double(from), take_double(from)};
    p.inner_b = (ovoid_vec3){take_double(from), take_double(from), take_double(from)};
    return p;
}
