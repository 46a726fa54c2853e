// What is not there is refused by every public function, and never looked into: a shape that is NULL, a solid with
// neither a shape nor a compound or with both, and a pose of zeros, as cleared memory has it. Truth: the limit or the
// code that the headers name, and no answer beside it. A pointer that is followed all the same ends the program.
#include "check.h"
#include "ovoid/ovoid.h"
#include "proofs/covers.h"

static ovoid_shape *shape;
static ovoid_compound *compound;
static const ovoid_pose identity = {{0, 0, 0}, {1, 0, 0, 0}}, aside = {{1.5, 0, 0}, {1, 0, 0, 0}};
static const ovoid_pose zero = {{0, 0, 0}, {0, 0, 0, 0}};

/// What is wrong with a pair, and what queries must say of it. b: of the second body, else of the first.
typedef enum fault { NO_SHAPE, ZERO_POSE, FAULTS } fault;
typedef struct wrong {
    fault is;
    int b;
} wrong;
static ovoid_limit get_limit(wrong w) {
    if (w.is == NO_SHAPE) return w.b ? OVOID_LIMIT_SHAPE_B : OVOID_LIMIT_SHAPE_A;
    return w.b ? OVOID_LIMIT_POSE_B : OVOID_LIMIT_POSE_A;
}

static const char *asked; ///< the function at hand
#define EXPECT(condition)                                                                                              \
    do                                                                                                                 \
        if (!CHECK(condition)) printf("  %s\n", asked);                                                                \
    while (0)

static ovoid_pair make_pair(wrong w) {
    ovoid_pair p = {shape, shape, identity, aside};
    if (w.is == NO_SHAPE) *(w.b ? &p.shape_b : &p.shape_a) = NULL;
    if (w.is == ZERO_POSE) *(w.b ? &p.pose_b : &p.pose_a) = zero;
    return p;
}

static void expect_refused(const ovoid_answer *x, ovoid_limit limit) {
    EXPECT(x->limit == limit);
    EXPECT(x->status == OVOID_UNDECIDED);
    EXPECT(x->lower == -INFINITY && x->upper == INFINITY);
}

// ---- pairs

static void ask_pair(wrong w) {
    STATIC_COVER(cover);
    ovoid_pair p = make_pair(w);
    ovoid_answer x[5] = {ovoid_collide(&p, NULL, NULL), ovoid_within(&p, 1, NULL, NULL), ovoid_distance(&p, NULL, NULL),
                         ovoid_depth(&p, NULL, NULL, &cover), ovoid_pair_compute_bounds(&p)};
    static const char *const names[5] = {"collide", "within", "distance", "depth", "bounds"};
    for (int i = 0; i < 5; i++) {
        asked = names[i];
        expect_refused(&x[i], get_limit(w));
        asked = "answer_check";
        EXPECT(ovoid_answer_verify(&p, &x[i], NULL, NULL) == OVOID_OK);
    }
    // An answer to what must be refused.
    ovoid_pair sound = {shape, shape, identity, aside};
    ovoid_answer claim = ovoid_distance(&sound, NULL, NULL);
    EXPECT(ovoid_answer_verify(&p, &claim, NULL, NULL) == OVOID_ERROR_PROOF);
    asked = "gradient";
    ovoid_gradient g = ovoid_answer_compute_gradient(&p, &claim, NULL);
    EXPECT(!g.has_translation && !g.has_rotation);
    asked = "smooth";
    ovoid_smooth s = ovoid_pair_compute_smooth(&p, 2);
    EXPECT(s.limit == get_limit(w) && s.outer.value == -INFINITY && s.inner.value == INFINITY);
    asked = "paper";
    const ovoid_areas *areas[2] = {NULL, NULL};
    ovoid_paper_bounds b = ovoid_paper_compute_bounds(&p, areas, OVOID_RULE_SIGNS, 1);
    EXPECT(b.lower == -INFINITY && b.upper == INFINITY);
}

/// Among sound couples, at each place of the eights; few, and many.
static void ask_batches(wrong w) {
    enum { MOST = 21 };
    ovoid_pair p = make_pair(w);
    ovoid_posed_shape bodies[4] = {{shape, identity}, {shape, aside}, {p.shape_a, p.pose_a}, {p.shape_b, p.pose_b}};
    ovoid_couple couples[MOST];
    ovoid_verdict verdicts[MOST];
    ovoid_batch batch = {.bodies = bodies, .body_count = 4, .couples = couples, .verdicts = verdicts};
    ovoid_code (*const ask[3])(const ovoid_batch *, ovoid_error *) = {ovoid_collide_batch, ovoid_distance_batch,
                                                                      ovoid_depth_batch};
    static const char *const names[4] = {"collide_batch", "distance_batch", "depth_batch", "within_batch"};
    for (batch.couple_count = 1; batch.couple_count <= MOST; batch.couple_count += 5)
        for (size_t at = 0; at < batch.couple_count; at++)
            for (int q = 0; q < 4; q++) {
                asked = names[q];
                for (uint32_t i = 0; i < MOST; i++) couples[i] = (ovoid_couple){i == at ? 2 : 0, i == at ? 3 : 1};
                EXPECT((q < 3 ? ask[q](&batch, NULL) : ovoid_within_batch(&batch, 1, NULL)) == OVOID_OK);
                for (size_t i = 0; i < batch.couple_count; i++)
                    EXPECT(i == at ? verdicts[i].limit == get_limit(w) && verdicts[i].lower == -INFINITY
                                   : verdicts[i].status == OVOID_OVERLAPPING);
            }
}

// ---- motions

static ovoid_moving_shape make_moving(wrong w, int b) {
    ovoid_pair p = make_pair(w);
    return (ovoid_moving_shape){.shape = b ? p.shape_b : p.shape_a,
                                .motion = ovoid_motion_make_poses(b ? p.pose_b : p.pose_a, b ? aside : identity, 1)};
}

static void ask_motions(wrong w) {
    ovoid_moving_shape a = make_moving(w, 0), b = make_moving(w, 1);
    ovoid_pair p = make_pair(w);
    asked = "impact";
    ovoid_impact x = ovoid_impact_find(&(ovoid_moving_pair){a, b, 0}, NULL);
    EXPECT(x.limit == get_limit(w) && x.status == OVOID_IMPACT_UNDECIDED && x.hit_at == INFINITY);
    EXPECT(ovoid_impact_verify(&(ovoid_moving_pair){a, b, 0}, &x, NULL, NULL) == OVOID_OK);
    x.limit = OVOID_LIMIT_NONE;
    EXPECT(ovoid_impact_verify(&(ovoid_moving_pair){a, b, 0}, &x, NULL, NULL) != OVOID_OK);
    asked = "approach";
    ovoid_approach y = ovoid_approach_find(&(ovoid_moving_pair){a, b, 0}, NULL);
    EXPECT(y.limit == get_limit(w) && y.lower == -INFINITY && y.upper == INFINITY);
    EXPECT(ovoid_approach_verify(&(ovoid_moving_pair){a, b, 0}, &y, NULL, NULL) == OVOID_OK);
    y.limit = OVOID_LIMIT_NONE;
    EXPECT(ovoid_approach_verify(&(ovoid_moving_pair){a, b, 0}, &y, NULL, NULL) != OVOID_OK);
    asked = "translation_cast";
    EXPECT(ovoid_shape_cast(&p, (ovoid_vec3){1, 0, 0}, 0, NULL).limit == get_limit(w));
    asked = "box";
    EXPECT(isnan(ovoid_moving_shape_compute_box(w.b ? &b : &a, 0, 1).min.x));
    asked = "ray_cast";
    ovoid_posed_shape body = {w.b ? p.shape_b : p.shape_a, w.b ? p.pose_b : p.pose_a};
    ovoid_ray ray = {{5, 0, 0}, {-1, 0, 0}, INFINITY, 0};
    EXPECT(ovoid_shape_cast_ray(&body, &ray).limit == (w.is == NO_SHAPE ? OVOID_LIMIT_SHAPE_B : OVOID_LIMIT_POSE_B));
}

// ---- compounds. A solid without a shape has neither of the two or both.

static void ask_solids(wrong w, int both) {
    ovoid_pair p = make_pair(w);
    ovoid_body_pair s = {{.compound = compound, .pose = p.pose_a}, {.shape = shape, .pose = p.pose_b}};
    ovoid_body *bad = w.b ? &s.b : &s.a;
    if (w.is == NO_SHAPE) bad->shape = both ? shape : NULL, bad->compound = both ? compound : NULL;
    ovoid_body_answer x[4] = {ovoid_body_collide(&s, NULL, NULL), ovoid_body_within(&s, 1, NULL, NULL),
                              ovoid_body_distance(&s, NULL, NULL), ovoid_body_depth(&s, NULL, NULL)};
    static const char *const names[4] = {"compound_collide", "compound_within", "compound_distance", "compound_depth"};
    for (int i = 0; i < 4; i++) {
        asked = names[i];
        expect_refused(&x[i].deciding, get_limit(w));
        asked = "compound_answer_check";
        EXPECT(ovoid_body_verify(&s, &x[i], NULL, NULL) == OVOID_OK);
        x[i].lower = 0;
        EXPECT(ovoid_body_verify(&s, &x[i], NULL, NULL) == OVOID_ERROR_PROOF);
    }
    asked = "compound_impact";
    ovoid_moving_body a = {.shape = s.a.shape, .compound = s.a.compound, .motion = ovoid_motion_make_still(s.a.pose)};
    ovoid_moving_body b = {.shape = s.b.shape, .compound = s.b.compound, .motion = ovoid_motion_make_still(s.b.pose)};
    ovoid_body_impact hit = ovoid_body_impact_find(&(ovoid_moving_body_pair){a, b, 0}, NULL);
    EXPECT(hit.impact.limit == get_limit(w) && hit.impact.status == OVOID_IMPACT_UNDECIDED);
    EXPECT(ovoid_body_impact_verify(&(ovoid_moving_body_pair){a, b, 0}, &hit, NULL, NULL) == OVOID_OK);
    hit.impact.limit = OVOID_LIMIT_NONE;
    EXPECT(ovoid_body_impact_verify(&(ovoid_moving_body_pair){a, b, 0}, &hit, NULL, NULL) != OVOID_OK);
    asked = "compound box";
    EXPECT(isnan(ovoid_moving_body_compute_box(w.b ? &b : &a, 0, 1).min.x));
}

// ---- what has an error to return

#define EXPECT_ERROR(call, expected)                                                                                   \
    do {                                                                                                               \
        ovoid_error error = {.code = OVOID_OK};                                                                        \
        asked = #call;                                                                                                 \
        EXPECT(call);                                                                                                  \
        EXPECT(error.code == (expected) && error.message[0]);                                                          \
    } while (0)

/// Worlds: bodies that are added, moved, and probes. both: a solid that is a shape and a compound.
static void ask_world(fault is, int both) {
    ovoid_code code = is == NO_SHAPE ? OVOID_ERROR_ARGUMENT : OVOID_ERROR_ROTATION;
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_world_body sound = {.body = {.shape = shape, .pose = identity}}, bad = sound;
    if (is == NO_SHAPE) bad.body.shape = both ? shape : NULL, bad.body.compound = both ? compound : NULL;
    if (is == ZERO_POSE) bad.body.pose = zero;
    ovoid_id id = ovoid_world_add(w, &sound, NULL);
    ovoid_world_hit hit;
    ovoid_world_hits hits = {.count = 0};
    ovoid_world_cast cast;
    CHECK(id != 0);
    EXPECT_ERROR(ovoid_world_add(w, &bad, &error) == 0, code);
    EXPECT_ERROR(ovoid_world_add_many(w, &(ovoid_world_additions){&bad, 1, NULL}, &error) == code, code);
    if (is == ZERO_POSE) {
        EXPECT_ERROR(ovoid_world_move(w, id, &zero, &error) == code, code);
        EXPECT_ERROR(ovoid_world_move_many(w, &(ovoid_world_moves){&id, &zero, 1}, &error) == code, code);
    }
    EXPECT_ERROR(ovoid_world_find_any_of(w, &(ovoid_world_probes){.items = &bad, .count = 1}, &hit, &error) == code,
                 code);
    ovoid_couple past = {0, 1};
    ovoid_world_probes state = {&bad, 1, NULL, 0}, few = {&sound, 1, &past, 1};
    EXPECT_ERROR(ovoid_world_find_any_of(w, &state, &hit, &error) == code, code);
    EXPECT_ERROR(ovoid_world_find_any_of(w, &few, &hit, &error) == OVOID_ERROR_INDEX, OVOID_ERROR_INDEX);
    EXPECT_ERROR(ovoid_world_find_nearest(w, &(ovoid_world_query){.probe = &bad}, &hit, &error) == code, code);
    EXPECT_ERROR(ovoid_world_find_overlaps(w, &(ovoid_world_query){.probe = &bad, .margin = 1}, &hits, &error) == code,
                 code);
    EXPECT_ERROR(ovoid_world_cast_body(w, &(ovoid_world_sweep){bad, (ovoid_vec3){1, 0, 0}}, &cast, &error) == code,
                 code);
    CHECK_EQ(ovoid_world_get_count(w), 1);
    ovoid_world_destroy(w);
}

static void ask_creations(void) {
    ovoid_posed_shape parts[2] = {{shape, identity}, {NULL, identity}};
    const double points[3] = {0, 0, 0};
    const ovoid_plane plane = {{1, 0, 0}, 0};
    EXPECT_ERROR(ovoid_compound_create(parts, 2, NULL, &error) == NULL, OVOID_ERROR_ARGUMENT);
    parts[1] = (ovoid_posed_shape){shape, zero};
    EXPECT_ERROR(ovoid_compound_create(parts, 2, NULL, &error) == NULL, OVOID_ERROR_ROTATION);
    EXPECT_ERROR(ovoid_shape_create_copy(NULL, NULL, &error) == NULL, OVOID_ERROR_ARGUMENT);
    EXPECT_ERROR(ovoid_shape_create_deformed(NULL, points, NULL, &error) == NULL, OVOID_ERROR_ARGUMENT);
    EXPECT_ERROR(ovoid_shape_create_divided(NULL, &plane, NULL, &error).code == OVOID_ERROR_ARGUMENT,
                 OVOID_ERROR_ARGUMENT);
    ovoid_motion still = ovoid_motion_make_still(zero);
    EXPECT_ERROR(ovoid_motion_validate(&still, &error) == OVOID_ERROR_ROTATION, OVOID_ERROR_ROTATION);
    asked = "pose_validate";
    EXPECT(ovoid_pose_validate(&zero) == OVOID_ERROR_ROTATION);
    // Nothing to do is no error.
    ovoid_shape_destroy(NULL);
    ovoid_compound_destroy(NULL);
    ovoid_world_destroy(NULL);
    ovoid_areas_destroy(NULL);
}

static void check_names(void) {
    CHECK(strcmp(ovoid_limit_get_name(OVOID_LIMIT_SHAPE_A), "shape_a") == 0);
    CHECK(strcmp(ovoid_limit_get_name(OVOID_LIMIT_SHAPE_B), "shape_b") == 0);
}

int main(void) {
    shape = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_posed_shape parts[2] = {{shape, identity}, {shape, aside}};
    compound = ovoid_compound_create(parts, 2, NULL, NULL);
    if (!CHECK(shape && compound)) return check_end();
    for (int i = 0; i < 2 * FAULTS; i++) {
        wrong w = {(fault)(i / 2), i % 2};
        check_seed = (uint64_t)i;
        ask_pair(w);
        ask_batches(w);
        ask_motions(w);
        for (int both = 0; both < 2; both++) ask_solids(w, both);
    }
    for (int both = 0; both < 2; both++) ask_world(NO_SHAPE, both);
    ask_world(ZERO_POSE, 0);
    ask_creations();
    check_names();
    ovoid_compound_destroy(compound);
    ovoid_shape_destroy(shape);
    return check_end();
}
