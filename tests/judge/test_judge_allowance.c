// Answers about bodies that are known to within an allowance, before the exact judge and the check without a search:
// both take what is claimed, and neither takes a bound that leaves out half of an allowance. Truth: rational
// arithmetic, the allowances added as they are stated.
#include "bits.h"
#include "judge.h"
#include "proofs/covers.h"

static long accepted, strengthened;

static void check(judge *context, const ovoid_pair *p, const ovoid_answer *x, const ovoid_cover *cover) {
    ovoid_error error = {.message = ""};
    if (!CHECK_EQ(judge_verify_answer(context, p, x, cover, &error), OVOID_OK)) printf("  %s\n", error.message);
    if (!CHECK_EQ(ovoid_answer_verify(p, x, &(ovoid_answer_basis){.cover = cover}, &error), OVOID_OK))
        printf("  %s\n", error.message);
    accepted++;
}

// The status that the bracket has: so that only the bound is in question.
static void set_status(ovoid_answer *x) {
    x->status = x->lower > 0 ? OVOID_SEPARATED : x->upper < 0 ? OVOID_OVERLAPPING : OVOID_UNDECIDED;
}

static void check_refused(judge *context, const ovoid_pair *p, const ovoid_answer *x, const ovoid_cover *cover) {
    CHECK(judge_verify_answer(context, p, x, cover, NULL) != OVOID_OK);
    CHECK(ovoid_answer_verify(p, x, &(ovoid_answer_basis){.cover = cover}, NULL) != OVOID_OK);
    strengthened++;
}

// The bracket of a depth is that of the shapes, to the tolerance of 1e-9, and the allowances.
static void check_stronger(judge *context, const ovoid_pair *p, const ovoid_answer *x, const ovoid_cover *cover) {
    ovoid_allowance a = ovoid_shape_get_allowance(p->shape_a), b = ovoid_shape_get_allowance(p->shape_b);
    double outside = a.outside + b.outside, inside = a.inside + b.inside;
    double least = 4e-12 * (x->upper - x->lower + fabs(x->lower));
    if (outside > least) {
        ovoid_answer y = *x;
        y.lower += 0.5 * outside;
        set_status(&y);
        if (y.lower <= y.upper) check_refused(context, p, &y, cover);
    }
    int is_sharp = x->proof.kind == OVOID_PROOF_POINTS || x->proof.kind == OVOID_PROOF_COVER;
    if (inside > least && is_sharp) {
        ovoid_answer y = *x;
        y.upper -= 0.5 * inside;
        set_status(&y);
        if (y.lower <= y.upper) check_refused(context, p, &y, cover);
    }
}

static ovoid_shape *make_shape(bits_family f, uint64_t *s) {
    ovoid_shape *plain = bits_make_shape(f, s), *shape = NULL;
    if (!CHECK(plain != NULL)) return NULL;
    ovoid_polytope p = ovoid_shape_get_polytope(plain);
    double xyz[3 * 300], size = bits_scale(f), lengths[2];
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        xyz[3 * i] = p.origin.x + p.vertices[3 * i];
        xyz[3 * i + 1] = p.origin.y + p.vertices[3 * i + 1];
        xyz[3 * i + 2] = p.origin.z + p.vertices[3 * i + 2];
    }
    for (int k = 0; k < 2; k++) lengths[k] = random_next(s) % 3 ? size * random_uniform(s, 0, 0.2) : 0;
    ovoid_shape_options o = {.radius = ovoid_shape_get_radius(plain),
                             .allowance = {.outside = lengths[0], .inside = lengths[1]}};
    shape = ovoid_shape_create_from_points(xyz, p.vertex_count, &o, NULL);
    ovoid_shape_destroy(plain);
    CHECK(shape != NULL);
    return shape;
}

static void check_pair(judge *context, const ovoid_pair *p) {
    STATIC_COVER(cover);
    ovoid_answer x = ovoid_depth(p, NULL, NULL, &cover);
    check(context, p, &x, &cover);
    if (x.limit == OVOID_LIMIT_NONE || x.limit == OVOID_LIMIT_ALLOWANCE) check_stronger(context, p, &x, &cover);
    ovoid_proof earlier = x.proof;
    x = ovoid_collide(p, NULL, NULL);
    check(context, p, &x, NULL);
    x = ovoid_within(p, fabs(x.lower) * 0.7, NULL, NULL);
    check(context, p, &x, NULL);
    x = ovoid_distance(p, NULL, &earlier);
    check(context, p, &x, NULL);
    x = ovoid_pair_compute_bounds(p);
    check(context, p, &x, NULL);
}

int main(void) {
    judge *context = judge_create();
    if (!CHECK(context != NULL)) return check_end();
    ovoid_shape *shapes[BITS_SHAPES];
    uint64_t s = 11;
    int made = 1;
    for (int i = 0; i < BITS_SHAPES; i++) made &= (shapes[i] = make_shape((bits_family)(i / BITS_EACH), &s)) != NULL;
    for (int f = 0; f < BITS_FAMILIES && made; f++)
        for (uint32_t i = 0; i < 60; i++) {
            check_seed = 1000 * (uint64_t)f + i;
            ovoid_pair p = bits_make_pair(shapes, (bits_family)f, i);
            check_pair(context, &p);
        }
    check_seed = 0;
    CHECK(accepted >= 60 * 5 * BITS_FAMILIES && strengthened >= 60 * BITS_FAMILIES / 2);
    for (int i = 0; i < BITS_SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    judge_destroy(context);
    return check_end();
}
