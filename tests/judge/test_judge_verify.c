// What ovoid_answer_verify accepts is true: of each answer the lower bound is raised, and the upper bound lowered, as
// far as the checker still accepts them, to the last double; the exact judge must accept that too. So the checker's own
// error constants are tested where they matter, at their edge. What is altered must be refused; what is handed to a
// query may be anything. Truth: the judge.
#include "bits.h"
#include "proofs/covers.h"

#include "judge.h"

static judge *exact;
STATIC_COVER(cover);

/// The answer with one bound altered, and the status that follows.
static ovoid_answer alter(const ovoid_answer *x, int upper, double bound) {
    ovoid_answer y = *x;
    if (upper)
        y.upper = bound;
    else
        y.lower = bound;
    // The other bound is in nobody's way.
    if (upper && y.lower > bound) y.lower = -INFINITY;
    if (!upper && y.upper < bound) y.upper = INFINITY;
    y.status = y.lower > 0 ? OVOID_SEPARATED : y.upper < 0 ? OVOID_OVERLAPPING : OVOID_UNDECIDED;
    y.limit = OVOID_LIMIT_PRECISION;
    return y;
}

static int is_accepted(const ovoid_pair *p, const ovoid_answer *x, int upper, double bound) {
    ovoid_answer y = alter(x, upper, bound);
    return ovoid_answer_verify(p, &y, &(ovoid_answer_basis){.cover = &cover}, NULL) == OVOID_OK;
}

/// The last double in the direction of `beyond`, which is refused, that is accepted.
static double find_edge(const ovoid_pair *p, const ovoid_answer *x, int upper, double accepted, double beyond) {
    for (int round = 0; round < 200; round++) {
        double middle = accepted + (beyond - accepted) / 2;
        if (middle == accepted || middle == beyond) break;
        if (is_accepted(p, x, upper, middle))
            accepted = middle;
        else
            beyond = middle;
    }
    return accepted;
}

static double size_of(const ovoid_pair *p) {
    double size = 0;
    const ovoid_shape *shapes[2] = {p->shape_a, p->shape_b};
    for (int k = 0; k < 2; k++) {
        ovoid_measures m = ovoid_shape_get_measures(shapes[k]);
        size += (m.box.max.x - m.box.min.x) + (m.box.max.y - m.box.min.y) + (m.box.max.z - m.box.min.z) +
                ovoid_shape_get_radius(shapes[k]);
    }
    return size;
}

static long edges[2][8]; // by bound and kind of proof

static void check_bound(const ovoid_pair *p, const ovoid_answer *x, int upper) {
    double bound = upper ? x->upper : x->lower, step = (upper ? -1 : 1) * size_of(p);
    if (isinf(bound) || !CHECK(is_accepted(p, x, upper, bound))) return;
    if (is_accepted(p, x, upper, bound + step)) return;
    double edge = find_edge(p, x, upper, bound, bound + step);
    ovoid_answer y = alter(x, upper, edge);
    ovoid_error error = {0};
    if (!CHECK(judge_verify_answer(exact, p, &y, &cover, &error) == OVOID_OK) && check_failed < 10)
        printf("  %s bound %.17g, from %.17g, proof %s: %s\n", upper ? "upper" : "lower", edge, bound,
               ovoid_proof_kind_get_name(x->proof.kind), error.message);
    edges[upper][upper ? x->proof.kind : 0]++;
}

// ---- what must be refused: one thing altered

static long altered;

static void check_refused(const ovoid_pair *p, const ovoid_answer *y, const ovoid_cover *c, const char *what) {
    altered++;
    if (!CHECK(ovoid_answer_verify(p, y, &(ovoid_answer_basis){.cover = c}, NULL) != OVOID_OK) && check_failed < 10)
        printf("  accepted: %s\n", what);
}

static void check_altered_entries(const ovoid_pair *p, const ovoid_answer *x) {
    uint32_t count_a = ovoid_shape_get_polytope(p->shape_a).vertex_count;
    uint32_t count_b = ovoid_shape_get_polytope(p->shape_b).vertex_count;
    for (uint32_t i = 0; i < x->proof.count; i++) {
        ovoid_answer y = *x;
        y.proof.b[i] = count_b;
        check_refused(p, &y, &cover, "an index past the end of B");
        y = *x, y.proof.a[i] = count_a;
        check_refused(p, &y, &cover, "an index past the end of A");
        y = *x, y.proof.weight_b[i] = -1e-3 * (y.proof.weight_b[i] + 1e-3);
        check_refused(p, &y, &cover, "a weight below zero of B");
        y = *x, y.proof.weight_a[i] = -1e-3 * (y.proof.weight_a[i] + 1e-3);
        check_refused(p, &y, &cover, "a weight below zero of A");
    }
    if (x->proof.kind != OVOID_PROOF_COVER) return;
    static own_cover c;
    check_refused(p, x, NULL, "no cover");
    for (uint32_t i = 0; i < cover.triangle_count; i += 1 + cover.triangle_count / 8) {
        own_cover_copy(&c, &cover);
        c.cover.triangle_count--;
        memcpy(c.triangles[i], c.triangles[c.cover.triangle_count], sizeof *c.triangles);
        check_refused(p, x, &c.cover, "a cover with a hole");
    }
    own_cover_copy(&c, &cover);
    c.b[0] = count_b;
    check_refused(p, x, &c.cover, "an index past the end in the cover");
}

static void check_altered(const ovoid_pair *p, const ovoid_answer *x) {
    ovoid_answer y = *x;
    double size = size_of(p);
    y.lower = 0, y.upper = fmax(x->upper, 0), y.status = OVOID_SEPARATED;
    check_refused(p, &y, &cover, "separated by nothing");
    y = *x, y.point_a.x += 1e-6 * (size + fabs(y.point_a.x));
    check_refused(p, &y, &cover, "a witness point of A elsewhere");
    y = *x, y.point_b.z -= 1e-6 * (size + fabs(y.point_b.z));
    check_refused(p, &y, &cover, "a witness point of B elsewhere");
    check_altered_entries(p, x);
}

// ---- what is handed in: proofs whose normal is of any length, or none; margins at the very bound

static void check_strange(const ovoid_pair *p, const ovoid_answer *x) {
    const double lengths[] = {0, 1e-320, 3e-310, 1e-160, 1e160, 1e300};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        ovoid_proof proof = x->proof;
        proof.normal.x *= lengths[i], proof.normal.y *= lengths[i], proof.normal.z *= lengths[i];
        ovoid_answer y = ovoid_collide(p, NULL, &proof);
        CHECK(judge_verify_answer(exact, p, &y, NULL, NULL) == OVOID_OK);
        y = ovoid_distance(p, NULL, &proof);
        CHECK(judge_verify_answer(exact, p, &y, NULL, NULL) == OVOID_OK);
    }
    // Where a bound that an earlier stage proves is just the margin, the query has to go on.
    ovoid_answer first = ovoid_collide(p, NULL, NULL);
    if (!(first.lower > 0) || !(x->lower > first.lower)) return;
    ovoid_answer y = ovoid_within(p, first.lower, NULL, NULL);
    CHECK_EQ(ovoid_answer_is_within(&y, first.lower), 0);
}

/// However early a search is stopped, TOUCHING is only reported if the bracket is within the tolerance.
static void check_stopped(const ovoid_pair *p) {
    double tolerance = 1e-4 * size_of(p);
    for (uint32_t most = 1; most <= 3; most++) {
        ovoid_options o = {.iterations = most, .absolute_tolerance = tolerance, .relative_tolerance = 1e-12};
        ovoid_answer y[3] = {ovoid_collide(p, &o, NULL), ovoid_distance(p, &o, NULL), ovoid_depth(p, &o, NULL, NULL)};
        for (int k = 0; k < 3; k++)
            if (y[k].status == OVOID_TOUCHING) CHECK_LE(y[k].upper - y[k].lower, 1.01 * tolerance);
    }
}

static void check_pair(const ovoid_pair *p) {
    cover.point_count = cover.triangle_count = 0;
    ovoid_answer x[4] = {ovoid_collide(p, NULL, NULL), ovoid_distance(p, NULL, NULL), ovoid_pair_compute_bounds(p),
                         ovoid_depth(p, NULL, NULL, &cover)};
    for (int k = 0; k < 4; k++) {
        check_bound(p, &x[k], 0);
        check_bound(p, &x[k], 1);
        check_altered(p, &x[k]);
    }
    check_strange(p, &x[1]);
    check_stopped(p);
}

int main(void) {
    ovoid_shape *shapes[BITS_SHAPES];
    exact = judge_create();
    if (!CHECK(exact != NULL) || !CHECK(bits_make_shapes(shapes))) return check_end();
    for (int f = 0; f < BITS_FAMILIES; f++)
        for (uint32_t i = 0; i < 60; i++) {
            ovoid_pair p = bits_make_pair(shapes, (bits_family)f, i);
            check_seed = (uint64_t)f * 1000 + i;
            check_pair(&p);
        }
    printf(
        "edges: %ld of lower bounds; of upper bounds by points %ld, hull %ld, inner %ld, inner points %ld, cover %ld\n",
        edges[0][0], edges[1][OVOID_PROOF_POINTS], edges[1][OVOID_PROOF_HULL], edges[1][OVOID_PROOF_INNER],
        edges[1][OVOID_PROOF_INNER_POINTS], edges[1][OVOID_PROOF_COVER]);
    printf("%ld alterations\n", altered);
    for (int k = OVOID_PROOF_POINTS; k <= OVOID_PROOF_COVER; k++) CHECK(edges[1][k] > 20);
    judge_destroy(exact);
    for (int i = 0; i < BITS_SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
