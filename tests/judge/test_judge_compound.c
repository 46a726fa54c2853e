// Answers about compounds before the exact judge. Truth: exact rational arithmetic. The deciding pair's answer with the
// bodies' lower bound; of each exclusion every pair of parts that it names, along its normal; and, by brute force over
// all features, the signed distance of every pair of parts, of which none may be below the lower bound.
#include "compounds.h"
#include "judge.h"
#include "proofs/covers.h"

enum { CAPACITY = 4000 };
static ovoid_exclusion items[CAPACITY];
STATIC_COVER(cover);
static judge *court;

static void expect_accepted(const ovoid_pair *pair, const ovoid_answer *x, const ovoid_cover *with) {
    ovoid_error error = {.message = ""};
    if (!CHECK(judge_verify_answer(court, pair, x, with, &error) == OVOID_OK)) printf("  %s\n", error.message);
}

static uint32_t get_index(const ovoid_body *body, uint32_t place) {
    return body->compound ? ovoid_compound_get_order(body->compound)[place] : 0;
}

// A pair of parts with the exclusion's bound in place of its own.
static void judge_excluded(const ovoid_body_pair *pair, const ovoid_exclusion *e, uint32_t a, uint32_t b) {
    ovoid_pair parts = get_pair(pair, get_index(&pair->a, a), get_index(&pair->b, b));
    ovoid_answer x = ovoid_collide(&parts, NULL, NULL);
    x.lower = e->lower;
    x.normal = x.proof.normal = e->normal;
    x.proof.normal_low = e->normal_low;
    x.status = x.lower > 0 ? OVOID_SEPARATED : x.upper < 0 ? OVOID_OVERLAPPING : OVOID_UNDECIDED;
    // Where only the sign was asked for, the upper bound may be below what the exclusion knows of it.
    if (!CHECK_LE(x.lower, x.upper)) return;
    expect_accepted(&parts, &x, NULL);
}

static ovoid_code judge_all(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_exclusions *all) {
    return judge_verify_compound(court, pair, x, all, NULL);
}

// The whole answer is accepted, and refused once an exclusion is taken away or claims more than its normal shows.
static void judge_whole(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_exclusions *all) {
    ovoid_error error = {.message = ""};
    if (!CHECK(judge_verify_compound(court, pair, x, all, &error) == OVOID_OK)) printf("  %s\n", error.message);
    if (x->lower == -INFINITY) return;
    for (size_t i = 0; i < all->count; i++) {
        ovoid_exclusion kept = all->items[i];
        // Farther than any two parts here are.
        all->items[i].lower = 100;
        CHECK(judge_all(pair, x, all) != OVOID_OK);
        all->items[i] = kept;
        all->items[i].lower = nextafter(x->lower, -INFINITY);
        CHECK(judge_all(pair, x, all) != OVOID_OK);
        all->items[i] = all->items[all->count - 1];
        ovoid_exclusions fewer = {
            .items = all->items, .capacity = all->capacity, .count = all->count - 1, .cover = all->cover};
        // The deciding pair may have an exclusion too, which is not needed.
        int is_deciding = kept.end_a - kept.first_a == 1 && get_index(&pair->a, kept.first_a) == x->part_a &&
                          kept.end_b - kept.first_b == 1 && get_index(&pair->b, kept.first_b) == x->part_b;
        CHECK((judge_all(pair, x, &fewer) == OVOID_OK) == is_deciding);
        all->items[i] = kept;
    }
}

static void judge_answer(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_exclusions *all) {
    ovoid_pair parts = get_pair(pair, x->part_a, x->part_b);
    expect_accepted(&parts, &x->deciding, all->cover);
    if (!CHECK_LE(all->count, all->capacity)) return;
    judge_whole(pair, x, all);
    for (size_t i = 0; i < all->count; i++)
        for (uint32_t a = all->items[i].first_a; a < all->items[i].end_a; a++)
            for (uint32_t b = all->items[i].first_b; b < all->items[i].end_b; b++)
                judge_excluded(pair, &all->items[i], a, b);
}

static void judge_truth_of(const ovoid_body_pair *pair, const ovoid_body_answer *x) {
    double low = INFINITY, high = INFINITY;
    for (size_t a = 0; a < get_count(&pair->a); a++)
        for (size_t b = 0; b < get_count(&pair->b); b++) {
            ovoid_pair parts = get_pair(pair, a, b);
            judge_truth truth;
            if (judge_compute_truth(court, &parts, &truth, NULL) != OVOID_OK) return;
            low = fmin(low, truth.low);
            high = fmin(high, truth.high);
        }
    CHECK_LE(x->lower, high);
    CHECK_LE(low, x->upper);
}

// Small hulls of few vertices; the brute force takes the fourth power of them.
static ovoid_compound *make_small(ovoid_shape *const shapes[4], size_t count, double scale, uint64_t *s) {
    ovoid_posed_shape parts[8];
    for (size_t i = 0; i < count; i++)
        parts[i] = (ovoid_posed_shape){shapes[random_next(s) % 4], {random_vec3(s, 3 * scale), random_quat(s)}};
    return ovoid_compound_create(parts, count, NULL, NULL);
}

static void check_round(int round) {
    uint64_t s = check_seed = 900 + (uint64_t)round;
    double scale = round % 4 == 3 ? 1e-9 : 1;
    ovoid_shape *shapes[4];
    for (int i = 0; i < 4; i++) {
        double xyz[18];
        for (int k = 0; k < 18; k++) xyz[k] = scale * random_uniform(&s, -1, 1) * (i == 1 && k % 3 == 2 ? 0 : 1);
        ovoid_shape_options o = {.radius = i == 2 ? 0.2 * scale : 0};
        shapes[i] = ovoid_shape_create_from_points(xyz, 4 + (size_t)(i % 3), &o, NULL);
        if (!CHECK(shapes[i] != NULL)) return;
    }
    ovoid_compound *a = make_small(shapes, 1 + (size_t)(round % 6), scale, &s), *b = make_small(shapes, 4, scale, &s);
    ovoid_body_pair pair = {{.compound = a, .pose = {random_vec3(&s, 4 * scale), random_quat(&s)}},
                            {.compound = b, .pose = {random_vec3(&s, 4 * scale), random_quat(&s)}}};
    if (round % 5 == 1) pair.b = (ovoid_body){.shape = shapes[0], .pose = pair.b.pose};
    if (CHECK(a && b)) {
        ovoid_exclusions all = {.items = items, .capacity = CAPACITY, .cover = &cover};
        ovoid_body_answer x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        judge_answer(&pair, &x, &all);
        x = ovoid_body_depth(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        judge_answer(&pair, &x, &all);
        judge_truth_of(&pair, &x);
        x = ovoid_body_collide(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        judge_answer(&pair, &x, &all);
    }
    judge_forget(court);
    ovoid_compound_destroy(a);
    ovoid_compound_destroy(b);
    for (int i = 0; i < 4; i++) ovoid_shape_destroy(shapes[i]);
}

// Two rows of cubes, those in their middles rounded and so the nearest, 1.5 apart along x: the exclusion of all pairs
// is exact to the last double, and what is beyond is refused; so is a hole, and an exclusion of parts that there are
// not.
static void check_edges(void) {
    ovoid_shape *cube = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_shape_options round = {.radius = 0.25};
    ovoid_shape *rounded = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, &round, NULL);
    ovoid_posed_shape parts[3];
    for (int i = 0; i < 3; i++)
        parts[i] = (ovoid_posed_shape){i == 1 ? rounded : cube, {{0, 2.0 * i, 0}, {1, 0, 0, 0}}};
    ovoid_compound *row = ovoid_compound_create(parts, 3, NULL, NULL);
    ovoid_body_pair pair = {{.compound = row, .pose = ovoid_pose_make_identity()},
                            {.compound = row, .pose = ovoid_pose_make_identity()}};
    pair.b.pose.position.x = 4;
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY, .cover = &cover};
    ovoid_body_answer x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    CHECK(judge_all(&pair, &x, &all) == OVOID_OK);
    // All at once: the deciding pair is among them, which is no fault.
    items[0] = (ovoid_exclusion){0, 3, 0, 3, {1, 0, 0}, {0, 0, 0}, 1.5};
    all.count = 1;
    CHECK(judge_all(&pair, &x, &all) == OVOID_OK);
    items[0].lower = nextafter(1.5, 2);
    CHECK(judge_all(&pair, &x, &all) != OVOID_OK);
    items[0] = (ovoid_exclusion){0, 3, 0, 2, {1, 0, 0}, {0, 0, 0}, 1.5};
    CHECK(judge_all(&pair, &x, &all) != OVOID_OK);
    items[0].end_b = 4;
    CHECK(judge_all(&pair, &x, &all) != OVOID_OK);
    items[0] = (ovoid_exclusion){0, 3, 0, 3, {NAN, 0, 0}, {0, 0, 0}, 1.5};
    CHECK(judge_all(&pair, &x, &all) != OVOID_OK);
    x.part_a = 3;
    CHECK(judge_all(&pair, &x, &all) != OVOID_OK);
    judge_forget(court);
    ovoid_compound_destroy(row);
    ovoid_shape_destroy(cube);
    ovoid_shape_destroy(rounded);
}

int main(void) {
    court = judge_create();
    if (!CHECK(court != NULL)) return check_end();
    for (int i = 0; i < 40; i++) check_round(i);
    check_edges();
    judge_destroy(court);
    return check_end();
}
