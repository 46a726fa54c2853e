// Two bodies of up to six parts each. Truth: the check without search of each answer and its exclusions; brackets of
// one distance have a point in common, also with the smallest of all pairs of parts, each asked alone.
#include "ask.h"
#include "bodies.h"

#ifdef OVOID_HAVE_JUDGE
#include <judge.h>

/// What the library's check accepts, exact arithmetic must accept too.
static void put_before_judge(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_options *options,
                             const ovoid_exclusions *exclusions) {
    static judge *the_judge;
    if (!the_judge) the_judge = judge_create();
    fuzz_require(the_judge != NULL);
    judge_set_options(the_judge, options);
    ovoid_error error = {OVOID_OK, -1, ""};
    fuzz_require_code(judge_verify_compound(the_judge, pair, x, exclusions, &error), &error);
    judge_forget(the_judge);
}
#else
static void put_before_judge(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_options *options,
                             const ovoid_exclusions *exclusions) {
    (void)pair, (void)x, (void)options, (void)exclusions;
}
#endif

enum { SHAPES = 3, PARTS = 6, ITEMS = 64 };

typedef struct findings {
    const ovoid_body_pair *pair;
    const ovoid_options *options; ///< of the queries
    double lower, upper;
    ovoid_body_proof last;
} findings;

static void check(findings *f, const ovoid_body_answer *x, const ovoid_exclusions *exclusions) {
    ovoid_error error = {OVOID_OK, -1, ""};
    // Without all exclusions there is nothing to check it by.
    if (exclusions->count <= exclusions->capacity) {
        fuzz_require_code(
            ovoid_body_verify(f->pair, x, &(ovoid_body_basis){.options = f->options, .exclusions = exclusions}, &error),
            &error);
        put_before_judge(f->pair, x, f->options, exclusions);
    }
    f->lower = fmax(f->lower, x->lower);
    f->upper = fmin(f->upper, x->upper);
    fuzz_require(f->lower <= f->upper);
    f->last = (ovoid_body_proof){x->part_a, x->part_b, x->deciding.proof};
}

static void ask_all(findings *f, double margin, const ovoid_options *options, const ovoid_body_proof *earlier,
                    size_t capacity) {
    static ovoid_exclusion items[ITEMS];
    static uint64_t memory[OVOID_COVER_SIZE / sizeof(uint64_t)];
    static ovoid_cover cover = {.memory = memory, .size = sizeof memory};
    ovoid_exclusions exclusions = {.items = items, .capacity = capacity, .cover = &cover};
    f->options = options;
    ovoid_body_answer x =
        ovoid_body_collide(f->pair, options, &(ovoid_body_evidence){.earlier = earlier, .exclusions = &exclusions});
    check(f, &x, &exclusions);
    x = ovoid_body_within(f->pair, margin, options,
                          &(ovoid_body_evidence){.earlier = earlier, .exclusions = &exclusions});
    check(f, &x, &exclusions);
    int within = ovoid_answer_is_within(&x.deciding, margin);
    if (within == 1) fuzz_require(f->lower <= margin);
    if (within == 0) fuzz_require(f->upper > margin);
    x = ovoid_body_distance(f->pair, options, &(ovoid_body_evidence){.earlier = earlier, .exclusions = &exclusions});
    check(f, &x, &exclusions);
    x = ovoid_body_depth(f->pair, options, &(ovoid_body_evidence){.earlier = earlier, .exclusions = &exclusions});
    check(f, &x, &exclusions);
}

static ovoid_posed_shape get_part(const ovoid_body *body, size_t i) {
    ovoid_posed_shape part = {body->shape, ovoid_pose_make_identity()};
    if (body->compound) part = ovoid_compound_get_part(body->compound, i);
    return (ovoid_posed_shape){part.shape,
                               body->compound ? ovoid_pose_compute_product(&body->pose, &part.pose) : body->pose};
}

// The smallest distance of all pairs of parts; 0 if one of them is refused.
static int find_truth(const ovoid_body_pair *pair, double *lower, double *upper) {
    size_t count_a = pair->a.compound ? ovoid_compound_get_part_count(pair->a.compound) : 1;
    size_t count_b = pair->b.compound ? ovoid_compound_get_part_count(pair->b.compound) : 1;
    *lower = *upper = INFINITY;
    for (size_t i = 0; i < count_a; i++)
        for (size_t j = 0; j < count_b; j++) {
            ovoid_posed_shape a = get_part(&pair->a, i), b = get_part(&pair->b, j);
            ovoid_pair parts = {a.shape, b.shape, a.pose, b.pose};
            ovoid_answer x = ovoid_depth(&parts, NULL, NULL, NULL);
            if (x.stage == OVOID_STAGE_NONE && x.lower == -INFINITY) return 0;
            *lower = fmin(*lower, x.lower);
            *upper = fmin(*upper, x.upper);
        }
    return 1;
}

// A shape alone, or a compound of shapes; which is to be destroyed.
static int take_solid(fuzz_bytes *from, ovoid_shape *const *shapes, int is_wild, ovoid_body *body,
                      ovoid_compound **made) {
    ovoid_posed_shape parts[PARTS];
    size_t count = (size_t)((unsigned)take_byte(from) % (PARTS + 1));
    *body = (ovoid_body){.shape = NULL};
    if (count == 0) body->shape = shapes[(unsigned)take_byte(from) % SHAPES];
    for (size_t i = 0; i < count; i++) {
        parts[i].shape = shapes[(unsigned)take_byte(from) % SHAPES];
        parts[i].pose = take_any_pose(from, is_wild);
    }
    body->pose = take_any_pose(from, is_wild);
    if (count == 0) return 1;
    ovoid_error error = {OVOID_OK, -1, ""};
    body->compound = *made = ovoid_compound_create(parts, count, NULL, &error);
    if (!body->compound) fuzz_require_error(&error);
    return body->compound != NULL;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes from = {data, size};
    int is_wild = take_byte(&from) > 96;
    ovoid_shape *shapes[SHAPES];
    int all = 1;
    for (int i = 0; i < SHAPES; i++) all &= (shapes[i] = take_any_shape(&from, is_wild)) != NULL;
    ovoid_body_pair pair = {{.shape = NULL}, {.shape = NULL}};
    ovoid_compound *made[2] = {NULL, NULL};
    if (all && take_solid(&from, shapes, is_wild, &pair.a, &made[0]) &&
        take_solid(&from, shapes, is_wild, &pair.b, &made[1])) {
        double margin = fabs(take_double(&from));
        if (!isfinite(margin)) margin = 0;
        ovoid_options options = {.relative_tolerance = ldexp(1, take_byte(&from) / 4 - 32),
                                 .iterations = 1 + (uint32_t)(take_byte(&from) & 15)};
        ovoid_body_proof earlier = {(uint32_t)take_byte(&from), (uint32_t)take_byte(&from), fuzz_take_proof(&from)};
        findings f = {&pair, NULL, -INFINITY, INFINITY, earlier};
        ask_all(&f, margin, NULL, NULL, ITEMS);
        ask_all(&f, margin, NULL, &earlier, ITEMS);
        earlier = f.last;
        ask_all(&f, margin, NULL, &earlier, (size_t)(take_byte(&from) & 3));
        ask_all(&f, margin, &options, &earlier, ITEMS);
        double lower, upper;
        if (find_truth(&pair, &lower, &upper)) fuzz_require(f.lower <= upper && lower <= f.upper);
    }
    ovoid_compound_destroy(made[0]);
    ovoid_compound_destroy(made[1]);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return 0;
}
