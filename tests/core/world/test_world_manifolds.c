// Manifolds of a world. Truth: the manifolds of each pair alone, and a list of the pairs of the step before
// (worlds.h); closed forms of boxes on boxes.
#include "world_life.h"

static const ovoid_pose here = {{0, 0, 0}, {1, 0, 0, 0}};

static ovoid_world_manifolds compute(ovoid_world *w, const ovoid_world_manifold_query *q) {
    ovoid_world_manifolds found = {.count = 0};
    ovoid_error error = {0};
    if (!CHECK(ovoid_world_compute_manifolds(w, q, &found, &error) == OVOID_OK)) printf("  %s\n", error.message);
    return found;
}

// ---- bodies that come, move and go; steps of other kinds between

static void set_materials(life *l) {
    for (size_t k = 0; k < l->count; k++) {
        if (random_next(&l->s) % 10) continue;
        const ovoid_material m = {.margin = random_next(&l->s) % 2 ? 0.1 * random_uniform(&l->s, 0, l->scale) : 0,
                                  .friction = random_uniform(&l->s, 0, 2),
                                  .restitution = random_uniform(&l->s, 0, 1)};
        ovoid_material own;
        CHECK(ovoid_world_set_material(l->world, l->ids[k], &m, NULL) == OVOID_OK);
        CHECK(ovoid_world_get_material(l->world, l->ids[k], &own, NULL) == OVOID_OK);
        CHECK(own.margin == m.margin && own.friction == m.friction && own.restitution == m.restitution);
    }
}

// The whole answer of a pair after a step with manifolds.
static void check_proof(const ovoid_world *w, const ovoid_world_manifolds *found) {
    static ovoid_exclusion items[1024];
    if (!found->count) return;
    const ovoid_world_manifold *m = &found->items[found->count / 2];
    const ovoid_contact contact = {.a = m->a, .b = m->b};
    ovoid_exclusions exclusions = {.items = items, .capacity = 1024};
    ovoid_contact_proof proof = {.exclusions = &exclusions};
    ovoid_world_body a, b;
    CHECK(ovoid_world_compute_proof(w, &contact, &proof, NULL) == OVOID_OK);
    CHECK(ovoid_world_get(w, m->a, &a, NULL) == OVOID_OK && ovoid_world_get(w, m->b, &b, NULL) == OVOID_OK);
    const ovoid_body_pair pair = {a.body, b.body};
    CHECK(ovoid_body_verify(&pair, &proof.answer, &(ovoid_body_basis){.exclusions = &exclusions}, NULL) == OVOID_OK);
    CHECK(proof.answer.lower <= m->verdict.upper && m->verdict.lower <= proof.answer.upper);
}

static void test_life(uint64_t seed) {
    static history past;
    static const double scales[4] = {1, 1e-9, 1e9, 1};
    check_seed = seed;
    ovoid_shape *shapes[WORLD_SHAPES];
    static life l;
    life_begin(&l, seed, scales[seed % 4], shapes);
    ovoid_world_manifold_query q = {.ahead = 0};
    size_t ended = 0, begun = 0, kept = 0;
    past.count = 0;
    for (int f = 0; f < 120; f++) {
        if (random_next(&l.s) % 8 == 0) q.options.margin = random_next(&l.s) % 2 ? 0 : 0.2 * l.scale;
        if (random_next(&l.s) % 8 == 0) q.options.tolerance = random_next(&l.s) % 2 ? 0 : 1e-3 * l.scale;
        q.ahead = f % 40 < 20 ? 0 : 2;
        set_materials(&l);
        ovoid_world_manifolds found = compute(l.world, &q);
        world_validate_manifolds(l.world, &(manifold_truth){&q, q.ahead > 0 ? 200 * l.scale : 0}, &found);
        history_step(&past, &found);
        check_proof(l.world, &found);
        ended += found.ended_count;
        begun += found.begun;
        kept += found.kept;
        if (random_next(&l.s) % 5 == 0) {
            ovoid_contact_query other = {.kind = (ovoid_query_kind)(random_next(&l.s) % 4)};
            other.margin = other.kind ? 0.1 * l.scale : 0;
            ovoid_contacts contacts;
            CHECK(ovoid_world_compute_contacts(l.world, &other, &contacts, NULL) == OVOID_OK);
            world_validate_frame(l.world, &other, &contacts);
        }
        if (f % 10 != 9) life_step(&l);
    }
    CHECK_LE(50, begun);
    CHECK_LE(50, ended);
    CHECK_LE(20, kept);
    life_end(&l);
}

// ---- a stack at rest: what is the same stays the same

enum { STACK = 20, FRAMES = 200 };

static void sort_ids(uint32_t *ids, uint32_t count) {
    for (uint32_t i = 1; i < count; i++)
        for (uint32_t k = i; k > 0 && ids[k - 1] > ids[k]; k--) {
            uint32_t moved = ids[k];
            ids[k] = ids[k - 1];
            ids[k - 1] = moved;
        }
}

// The ids of each pair, sorted, and the point of each id.
typedef struct resting {
    uint32_t count, ids[4];
    ovoid_vec3 points[4];
} resting;

static resting make_resting(const ovoid_world_manifolds *found, size_t i) {
    const ovoid_manifold_points *points = &found->points[found->items[i].first];
    resting r = {.count = points->count};
    for (uint32_t k = 0; k < r.count; k++) r.ids[k] = points->points[k].id;
    sort_ids(r.ids, r.count);
    for (uint32_t k = 0; k < r.count; k++)
        for (uint32_t j = 0; j < r.count; j++)
            if (points->points[j].id == r.ids[k]) r.points[k] = points->points[j].point_a;
    return r;
}

static double find_way(const resting *p, const resting *q) {
    double most = 0;
    for (uint32_t k = 0; k < p->count; k++) {
        ovoid_vec3 a = p->points[k], b = q->points[k];
        most = fmax(most, fmax(fabs(a.x - b.x), fmax(fabs(a.y - b.y), fabs(a.z - b.z))));
    }
    return most;
}

// 20 boxes of side 1 that overlap by 1e-4, each moved and turned by up to `jitter` in each frame: of 19 pairs and 200
// frames no id changes, and no point goes farther than the jitter explains. A corner is the same point of a body, at
// most 1 from its middle: it goes by two jitters of the place and two of the turn in each axis, of each body.
static void test_stack(double jitter, const ovoid_shape *box) {
    uint64_t s = 88172645463325252u;
    static resting before[STACK];
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_id ids[STACK];
    ovoid_world_manifold_query q = {.options = {.tolerance = 1e-3, .keep = 5e-3, .margin = 5e-3}};
    size_t changes = 0, searched = 0;
    double most = 0;
    for (int i = 0; i < STACK; i++) {
        ovoid_world_body b = {.body = {.shape = box, .pose = here}};
        b.body.pose.position.z = i * (1 - 1e-4);
        ids[i] = ovoid_world_add(w, &b, NULL);
    }
    for (int f = 0; f < FRAMES; f++) {
        ovoid_pose poses[STACK];
        for (int i = 0; i < STACK; i++) {
            ovoid_vec3 d = random_place(&s, jitter), t = random_place(&s, jitter);
            poses[i] = (ovoid_pose){{d.x, d.y, i * (1 - 1e-4) + d.z}, {1, t.x, t.y, t.z}};
        }
        CHECK(ovoid_world_move_many(w, &(ovoid_world_moves){ids, poses, STACK}, NULL) == OVOID_OK);
        ovoid_world_manifolds found = compute(w, &q);
        CHECK_EQ(found.count, STACK - 1);
        CHECK_EQ(found.begun, f ? 0 : STACK - 1);
        CHECK_EQ(found.ended_count, 0);
        for (size_t i = 0; i < found.count; i++) {
            resting now = make_resting(&found, i);
            CHECK_EQ(now.count, 4);
            if (f) {
                int is_same = now.count == before[i].count && memcmp(now.ids, before[i].ids, 4 * now.count) == 0;
                changes += !is_same;
                if (is_same) most = fmax(most, find_way(&now, &before[i]));
            }
            before[i] = now;
        }
        searched += f ? found.step.queried : 0;
    }
    CHECK_EQ(changes, 0);
    CHECK_LE(most, 16 * jitter);
    // Each pair is looked at in each frame.
    CHECK_EQ(searched, (STACK - 1) * (FRAMES - 1));
    ovoid_world_destroy(w);
}

// ---- ranges: by materials, and by speed

static void test_ranges(const ovoid_shape *box) {
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_world_body b = {.body = {.shape = box, .pose = here}, .user = 5};
    ovoid_id ids[2];
    ids[0] = ovoid_world_add(w, &b, NULL);
    b.body.pose.position.x = 1.5; // half a side apart
    b.user = 6;
    ids[1] = ovoid_world_add(w, &b, NULL);
    ovoid_world_manifold_query q = {.options = {.margin = 0.3}};
    CHECK_EQ(compute(w, &q).count, 0);
    // Of each body its own: 0.3 + 0.1 + 0.1 is 0.5.
    ovoid_material m = {.margin = 0.1, .friction = 0.25, .restitution = 0.5};
    CHECK(ovoid_world_set_material(w, ids[0], &m, NULL) == OVOID_OK);
    CHECK_EQ(compute(w, &q).count, 0);
    m = (ovoid_material){.margin = 0.11, .friction = 4, .restitution = 0.125};
    CHECK(ovoid_world_set_material(w, ids[1], &m, NULL) == OVOID_OK);
    ovoid_world_manifolds found = compute(w, &q);
    if (CHECK_EQ(found.count, 1)) {
        CHECK_NEAR(found.items[0].margin, 0.51, 1e-15);
        CHECK(found.items[0].friction == 1 && found.items[0].restitution == 0.5);
        CHECK(found.items[0].user_a == 5 && found.items[0].user_b == 6);
        CHECK_NEAR(found.items[0].verdict.lower, 0.5, 1e-8);
    }
    // A body of the same index has no material of the one before.
    CHECK(ovoid_world_remove(w, ids[1], NULL) == OVOID_OK);
    found = compute(w, &q);
    CHECK(found.count == 0 && found.ended_count == 1 && found.ended[0].b == ids[1] && found.ended[0].user_b == 6);
    ids[1] = ovoid_world_add(w, &b, NULL);
    CHECK(ovoid_world_get_material(w, ids[1], &m, NULL) == OVOID_OK && m.margin == 0 && m.friction == 0);
    CHECK_EQ(compute(w, &q).count, 0);
    m = (ovoid_material){.margin = 0};
    CHECK(ovoid_world_set_material(w, ids[0], &m, NULL) == OVOID_OK);
    // By speed: body 1 moves by 0.1 a step toward body 0. One step ahead it is seen when the gap is 0.1, three steps
    // ahead when it is 0.3; at rest not at all.
    for (int ahead = 0; ahead <= 3; ahead++) {
        q = (ovoid_world_manifold_query){.ahead = ahead};
        for (int step = 0; step <= 9; step++) {
            ovoid_pose pose = {{1.96 - 0.1 * step, 0, 0}, {1, 0, 0, 0}};
            CHECK(ovoid_world_move(w, ids[1], &pose, NULL) == OVOID_OK);
            found = compute(w, &q);
            if (step == 0) continue; // the move from where it was before
            CHECK_EQ(found.count, 0.96 - 0.1 * step <= 0.1 * ahead);
        }
        CHECK_EQ(compute(w, &q).count, 0);
        // A jump is no speed beyond the body's size.
        ovoid_pose far = {{40, 0, 0}, {1, 0, 0, 0}};
        CHECK(ovoid_world_move(w, ids[1], &far, NULL) == OVOID_OK);
        CHECK_EQ(compute(w, &q).count, 0);
    }
    ovoid_world_destroy(w);
}

// ---- what is taken over at rest: nothing that was found for other options

static void test_options(const ovoid_shape *box) {
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_world_body bodies[2] = {{.body = {.shape = box, .pose = here}}, {.body = {.shape = box, .pose = here}}};
    bodies[1].body.pose.position = (ovoid_vec3){0.1, 0.2, 0.9};
    ovoid_id ids[2];
    CHECK(ovoid_world_add_many(w, &(ovoid_world_additions){bodies, 2, ids}, NULL) == OVOID_OK);
    ovoid_world_manifold_query q = {.options = {.tolerance = 0.5}};
    ovoid_pose pose = {{0.1, 0.2, 0.9}, {1, 0.05, 0.02, 0}};
    (void)compute(w, &q);
    CHECK(ovoid_world_move(w, ids[1], &pose, NULL) == OVOID_OK);
    ovoid_world_manifolds found = compute(w, &q);
    CHECK(found.count == 1 && found.kept == 0);
    // Its bracket is that of the face before it was turned.
    CHECK_LE(1e-6, found.items[0].verdict.upper - found.items[0].verdict.lower);
    CHECK_EQ(compute(w, &q).kept, 1);
    q.options.tolerance = 1e-8;
    found = compute(w, &q);
    CHECK(found.count == 1 && found.kept == 0);
    CHECK_LE(found.items[0].verdict.upper - found.items[0].verdict.lower, 1e-8);
    found = compute(w, &q);
    CHECK(found.kept == 1 && found.items[0].event == OVOID_MANIFOLD_STAY);
    ovoid_world_destroy(w);
}

// ---- solids: two of them have no manifolds

static void test_two_solids(void) {
    static const double xyz[] = {-1, -1, -1, 1, -1, -1, 0, 1, -1, 0, 0, 1};
    static const uint32_t faces[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    ovoid_solid *solid = ovoid_solid_create_from_triangles(&(ovoid_triangles){xyz, 4, faces, 4}, NULL, NULL);
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_world_body bodies[2] = {{.body = {.solid = solid, .pose = here}}, {.body = {.solid = solid, .pose = here}}};
    ovoid_id ids[2];
    CHECK(solid && ovoid_world_add_many(w, &(ovoid_world_additions){bodies, 2, ids}, NULL) == OVOID_OK);
    ovoid_world_manifold_query q = {.ahead = 0};
    for (int f = 0; f < 4; f++) {
        ovoid_world_manifolds found = compute(w, &q);
        CHECK(found.part_count == 0 && found.begun == (f == 0));
        if (!CHECK_EQ(found.count, 1)) break;
        const ovoid_world_manifold *m = found.items;
        CHECK_EQ(m->count, 0);
        CHECK_EQ(m->verdict.limit, OVOID_LIMIT_SHAPE_B);
        ovoid_pose pose = {{0.01 * f, 0.01, 0}, {1, 0, 0, 0}};
        if (f < 2) CHECK(ovoid_world_move(w, ids[1], &pose, NULL) == OVOID_OK);
    }
    ovoid_pose far = {{40, 0, 0}, {1, 0, 0, 0}};
    CHECK(ovoid_world_move(w, ids[1], &far, NULL) == OVOID_OK);
    ovoid_world_manifolds found = compute(w, &q);
    CHECK(found.count == 0 && found.ended_count == 1);
    ovoid_world_destroy(w);
    ovoid_solid_destroy(solid);
}

// ---- what is refused

static void expect(ovoid_code code, ovoid_code right, const ovoid_error *error, const char *words) {
    CHECK_EQ(code, right);
    if (!CHECK(strstr(error->message, words) != NULL)) printf("  %s\n", error->message);
}

static void test_refused(const ovoid_shape *box) {
    ovoid_error e = {0};
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_world_body b = {.body = {.shape = box, .pose = here}};
    ovoid_id id = ovoid_world_add(w, &b, NULL);
    ovoid_world_manifolds found;
    const struct {
        ovoid_world_manifold_query query;
        const char *words;
    } queries[] = {{{.options = {.margin = -1}}, "margin -1"},
                   {{.options = {.margin = INFINITY}}, "margin inf"},
                   {{.options = {.tolerance = -2}}, "tolerance -2"},
                   {{.options = {.keep = NAN}}, "keep nan"},
                   {{.options = {.angle = -0.5}}, "angle -0.5"},
                   {{.options = {.angle = 2}}, "angle 2"},
                   {{.ahead = -1}, "ahead -1"},
                   {{.ahead = 101}, "ahead 101"},
                   {{.ahead = NAN}, "ahead nan"}};
    for (size_t i = 0; i < sizeof queries / sizeof *queries; i++)
        expect(ovoid_world_compute_manifolds(w, &queries[i].query, &found, &e), OVOID_ERROR_ARGUMENT, &e,
               queries[i].words);
    const struct {
        ovoid_material material;
        const char *words;
    } materials[] = {{{.margin = -1}, "margin -1"},
                     {{.friction = NAN}, "friction nan"},
                     {{.restitution = INFINITY}, "restitution inf"}};
    ovoid_material m = {.friction = 2}, own;
    CHECK(ovoid_world_set_material(w, id, &m, &e) == OVOID_OK);
    for (size_t i = 0; i < sizeof materials / sizeof *materials; i++) {
        expect(ovoid_world_set_material(w, id, &materials[i].material, &e), OVOID_ERROR_ARGUMENT, &e,
               materials[i].words);
        CHECK(ovoid_world_get_material(w, id, &own, NULL) == OVOID_OK && own.friction == 2);
    }
    expect(ovoid_world_set_material(w, id + 1, &m, &e), OVOID_ERROR_INDEX, &e, "names no body");
    expect(ovoid_world_get_material(w, 0, &m, &e), OVOID_ERROR_INDEX, &e, "names no body");
    ovoid_world_destroy(w);
}

int main(void) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){0.5, 0.5, 0.5}, NULL, NULL);
    for (uint64_t seed = 1; seed <= 4; seed++) test_life(seed);
    check_seed = 0;
    test_ranges(box);
    test_options(box);
    test_two_solids();
    test_refused(box);
    test_stack(1e-9, box);
    test_stack(1e-7, box);
    ovoid_shape_destroy(box);
    return check_end();
}
