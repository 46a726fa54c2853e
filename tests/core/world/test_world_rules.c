// What a world lets through and what it refuses: groups, ignored pairs, the filter; ids that are gone, poses that are
// none; an allocation that fails, each in turn. Truth: the bodies' places, chosen so that all touch all; worlds.h.
#include "countdown.h"
#include "worlds.h"

static const ovoid_contact_query collide = {.kind = OVOID_QUERY_COLLIDE};

// n boxes at one place: all pairs touch.
static ovoid_world *make_heap(const ovoid_world_options *o, const ovoid_shape *box, int n, ovoid_id *ids) {
    ovoid_world *w = ovoid_world_create(o, NULL);
    for (int i = 0; i < n; i++) {
        ovoid_world_body b = {.body = {.shape = box, .pose = {{0.01 * i, 0, 0}, {1, 0, 0, 0}}}, .user = (uint64_t)i};
        ids[i] = ovoid_world_add(w, &b, NULL);
        CHECK(ids[i] != 0);
    }
    return w;
}

static size_t count_contacts(ovoid_world *w) {
    ovoid_contacts f;
    CHECK(ovoid_world_compute_contacts(w, &collide, &f, NULL) == OVOID_OK);
    world_validate_frame(w, &collide, &f);
    return f.count;
}

static int is_even_sum(void *context, ovoid_id a, ovoid_id b) {
    ++*(int *)context;
    return ((a >> 32) + (b >> 32)) % 2 == 0;
}

static void test_rules(const ovoid_shape *box) {
    ovoid_id ids[10];
    ovoid_world *w = make_heap(NULL, box, 10, ids);
    CHECK_EQ(count_contacts(w), 45);
    // Ignored, taken back, ignored twice.
    for (int k = 0; k < 2; k++) CHECK(ovoid_world_add_ignored(w, ids[3], ids[7], NULL) == OVOID_OK);
    CHECK(!ovoid_world_is_pair(w, ids[7], ids[3]));
    CHECK_EQ(count_contacts(w), 44);
    CHECK(ovoid_world_remove_ignored(w, ids[7], ids[3], NULL) == OVOID_OK);
    CHECK_EQ(count_contacts(w), 45);
    // An ignored pair ends with its bodies: the index that is used again is another body.
    CHECK(ovoid_world_add_ignored(w, ids[0], ids[1], NULL) == OVOID_OK);
    CHECK(ovoid_world_remove(w, ids[1], NULL) == OVOID_OK);
    ovoid_world_body b;
    CHECK(ovoid_world_get(w, ids[0], &b, NULL) == OVOID_OK);
    ovoid_id again = ovoid_world_add(w, &b, NULL);
    CHECK(again != ids[1] && again >> 32 == ids[1] >> 32);
    CHECK_EQ(count_contacts(w), 45);
    // Groups: 5 with 5, others not.
    for (int i = 0; i < 10; i++) {
        ovoid_id id = i == 1 ? again : ids[i];
        CHECK(ovoid_world_set_groups(w, id, (ovoid_groups){i < 5 ? 1 : 2, i < 5 ? 2 : 1}, NULL) == OVOID_OK);
    }
    CHECK_EQ(count_contacts(w), 25);
    ovoid_world_destroy(w);
    // The filter is asked when a pair is new, and again after a renewal.
    int calls = 0;
    ovoid_world_options o = {.filter = is_even_sum, .filter_context = &calls};
    w = make_heap(&o, box, 10, ids);
    CHECK_EQ(count_contacts(w), 20);
    int first = calls;
    CHECK_LE(45, first);
    ovoid_contacts f;
    CHECK(ovoid_world_compute_contacts(w, &collide, &f, NULL) == OVOID_OK);
    CHECK(ovoid_world_renew(w, ids[0], NULL) == OVOID_OK);
    calls = 0;
    CHECK(ovoid_world_compute_contacts(w, &collide, &f, NULL) == OVOID_OK);
    CHECK_EQ(calls, 9);
    CHECK_EQ(f.count, 20);
    ovoid_world_destroy(w);
}

static void expect(ovoid_code code, ovoid_code wanted, const ovoid_error *error, const char *words) {
    CHECK_EQ(code, wanted);
    if (!CHECK(strstr(error->message, words) != NULL)) printf("  %s\n", error->message);
}

static void test_bodies_refused(const ovoid_shape *box) {
    ovoid_id ids[4];
    ovoid_error e = {0};
    ovoid_world *w = make_heap(NULL, box, 4, ids);
    ovoid_pose bad = {{NAN, 0, 0}, {1, 0, 0, 0}}, zero = {{0, 0, 0}, {0, 0, 0, 0}}, far = {{1e60, 0, 0}, {1, 0, 0, 0}};
    ovoid_world_body before, after;
    CHECK(ovoid_world_get(w, ids[2], &before, NULL) == OVOID_OK && before.user == 2);
    expect(ovoid_world_move(w, ids[2], &bad, &e), OVOID_ERROR_NOT_FINITE, &e, "NaN");
    expect(ovoid_world_move(w, ids[2], &zero, &e), OVOID_ERROR_ROTATION, &e, "quaternion");
    expect(ovoid_world_move(w, ids[2], &far, &e), OVOID_ERROR_RANGE, &e, "OVOID_LENGTH_MAX");
    // All or none: the third of four is bad.
    ovoid_pose poses[4] = {{{5, 0, 0}, {1, 0, 0, 0}}, {{5, 0, 0}, {1, 0, 0, 0}}, bad, {{5, 0, 0}, {1, 0, 0, 0}}};
    expect(ovoid_world_move_many(w, &(ovoid_world_moves){ids, poses, 4}, &e), OVOID_ERROR_NOT_FINITE, &e,
           "nothing is moved");
    CHECK_EQ(e.place, 2);
    CHECK(ovoid_world_get(w, ids[2], &after, NULL) == OVOID_OK && memcmp(&before, &after, sizeof before) == 0);
    CHECK(ovoid_world_get(w, ids[0], &after, NULL) == OVOID_OK && after.body.pose.position.x < 1);
    // Ids: none, stale, twice.
    expect(ovoid_world_remove(w, 0, &e), OVOID_ERROR_INDEX, &e, "names no body");
    ovoid_id twice[3] = {ids[0], ids[1], ids[0]};
    expect(ovoid_world_remove_many(w, twice, 3, &e), OVOID_ERROR_INDEX, &e, "names no body");
    CHECK_EQ(e.place, 2);
    CHECK_EQ(ovoid_world_get_count(w), 4);
    CHECK(ovoid_world_remove(w, ids[1], NULL) == OVOID_OK);
    expect(ovoid_world_remove(w, ids[1], &e), OVOID_ERROR_INDEX, &e, "was removed");
    expect(ovoid_world_move(w, ids[1], &before.body.pose, &e), OVOID_ERROR_INDEX, &e, "was removed");
    expect(ovoid_world_get(w, ids[1], &after, &e), OVOID_ERROR_INDEX, &e, "was removed");
    expect(ovoid_world_add_ignored(w, ids[0], ids[1], &e), OVOID_ERROR_INDEX, &e, "was removed");
    expect(ovoid_world_add_ignored(w, ids[0], ids[0], &e), OVOID_ERROR_ARGUMENT, &e, "no pair");
    expect(ovoid_world_renew(w, ids[1], &e), OVOID_ERROR_INDEX, &e, "was removed");
    expect(ovoid_world_set_groups(w, ids[1], (ovoid_groups){1, 1}, &e), OVOID_ERROR_INDEX, &e, "was removed");
    // Bodies: neither shape nor compound; a bad pose among good ones.
    ovoid_world_body none = {.body = {.pose = {{0, 0, 0}, {1, 0, 0, 0}}}}, two[2] = {before, before};
    CHECK(ovoid_world_add(w, &none, &e) == 0);
    expect(e.code, OVOID_ERROR_ARGUMENT, &e, "a shape, a compound and a solid");
    two[1].body.pose = bad;
    expect(ovoid_world_add_many(w, &(ovoid_world_additions){two, 2, NULL}, &e), OVOID_ERROR_NOT_FINITE, &e, "NaN");
    CHECK_EQ(e.place, 1);
    CHECK_EQ(ovoid_world_get_count(w), 3);
    // Going through while removing: the next one after a removed id is found.
    size_t seen = 0;
    for (ovoid_id id = ovoid_world_find_next(w, 0); id; id = ovoid_world_find_next(w, id), seen++)
        CHECK(ovoid_world_remove(w, id, NULL) == OVOID_OK);
    CHECK_EQ(seen, 3);
    ovoid_contacts f;
    CHECK(ovoid_world_compute_contacts(w, &collide, &f, NULL) == OVOID_OK && f.count == 0 && f.pairs == 0);
    ovoid_world_destroy(w);
}

static void test_queries_refused(const ovoid_shape *box) {
    ovoid_id ids[2];
    ovoid_error e = {0};
    ovoid_contacts f;
    ovoid_world *w = make_heap(NULL, box, 2, ids);
    ovoid_contact_query q = {.kind = (ovoid_query_kind)9};
    expect(ovoid_world_compute_contacts(w, &q, &f, &e), OVOID_ERROR_ARGUMENT, &e, "kind 9");
    q = (ovoid_contact_query){.kind = OVOID_QUERY_WITHIN, .margin = -1};
    expect(ovoid_world_compute_contacts(w, &q, &f, &e), OVOID_ERROR_ARGUMENT, &e, "margin");
    q.margin = INFINITY;
    expect(ovoid_world_compute_contacts(w, &q, &f, &e), OVOID_ERROR_ARGUMENT, &e, "margin");
    q = (ovoid_contact_query){.kind = OVOID_QUERY_COLLIDE, .margin = 1};
    expect(ovoid_world_compute_contacts(w, &q, &f, &e), OVOID_ERROR_ARGUMENT, &e, "within");
    ovoid_options bad = {.relative_tolerance = NAN};
    q = (ovoid_contact_query){.options = &bad};
    expect(ovoid_world_compute_contacts(w, &q, &f, &e), OVOID_ERROR_ARGUMENT, &e, "tolerance");
    ovoid_contact_proof x = {.exclusions = NULL};
    ovoid_contact c = {.a = ids[0], .b = ids[1]};
    expect(ovoid_world_compute_proof(w, &c, &x, &e), OVOID_ERROR_ARGUMENT, &e, "no contact");
    CHECK_EQ(count_contacts(w), 1);
    c.b = ids[1] + 1;
    expect(ovoid_world_compute_proof(w, &c, &x, &e), OVOID_ERROR_INDEX, &e, "names no body");
    ovoid_world_destroy(w);
    ovoid_world_options o = {.threads = 257};
    CHECK(!ovoid_world_create(&o, &e));
    expect(e.code, OVOID_ERROR_ARGUMENT, &e, "at most 256");
    o = (ovoid_world_options){.enlargement = -1};
    CHECK(!ovoid_world_create(&o, &e));
    expect(e.code, OVOID_ERROR_ARGUMENT, &e, "enlargement");
    ovoid_world_destroy(NULL);
}

// A short life in which the k-th allocation fails: the call says so, nothing changes, and the call made again succeeds.
typedef struct trial {
    countdown count;
    int failures;
} trial;

// 1: succeeded; 0: refused for memory, which is then given back.
static int retry(trial *t, ovoid_code code) {
    if (code == OVOID_OK) return 1;
    CHECK_EQ(code, OVOID_ERROR_MEMORY);
    t->failures++;
    t->count.left = 1000000;
    return 0;
}

// Manifolds after a call that ran out of memory are those that the call would have found, and so are the events.
static void test_failing_manifolds(ovoid_world *w, trial *t, ovoid_id id, history *past) {
    ovoid_error e = {0};
    const ovoid_material m = {.margin = 0.1, .friction = 1};
    const ovoid_world_manifold_query q = {.options = {.margin = 0.1}, .ahead = 1};
    ovoid_world_manifolds found;
    if (!retry(t, ovoid_world_set_material(w, id, &m, &e)))
        CHECK(ovoid_world_set_material(w, id, &m, NULL) == OVOID_OK);
    for (int k = 0; k < 2; k++) {
        if (!retry(t, ovoid_world_compute_manifolds(w, &q, &found, &e)))
            CHECK(ovoid_world_compute_manifolds(w, &q, &found, NULL) == OVOID_OK);
        history_step(past, &found);
    }
    CHECK_EQ(found.begun, 0);
    CHECK_EQ(found.ended_count, 0);
    if (t->failures) world_validate_manifolds(w, &(manifold_truth){&q, 20}, &found);
}

static void test_failing_allocation(ovoid_shape **shapes, long k, uint32_t threads, int *failures) {
    trial t = {.count = {k, 0}};
    check_seed = (uint64_t)k;
    uint64_t s = 5;
    ovoid_allocator memory = countdown_make_allocator(&t.count);
    ovoid_world_options o = {.allocator = &memory, .threads = threads};
    ovoid_error e = {0};
    ovoid_world *w = ovoid_world_create(&o, &e);
    if (!retry(&t, w ? OVOID_OK : e.code)) w = ovoid_world_create(&o, NULL);
    ovoid_world_body bodies[90];
    ovoid_id ids[90];
    for (int i = 0; i < 90; i++)
        bodies[i] = (ovoid_world_body){
            .body = {.shape = shapes[random_next(&s) % WORLD_SHAPES], .pose = {random_place(&s, 4), random_quat(&s)}}};
    for (int i = 0; i < 20; i++) {
        ids[i] = ovoid_world_add(w, &bodies[i], &e);
        if (!retry(&t, ids[i] ? OVOID_OK : e.code)) ids[i] = ovoid_world_add(w, &bodies[i], NULL);
    }
    ovoid_contacts f;
    static history past;
    past.count = 0;
    for (int round = 0; round < 4; round++) {
        ovoid_contact_query q = {.kind = (ovoid_query_kind)round, .margin = round ? 0.2 : 0};
        if (round == 1 && !retry(&t, ovoid_world_add_many(w, &(ovoid_world_additions){bodies + 20, 70, ids + 20}, &e)))
            CHECK(ovoid_world_add_many(w, &(ovoid_world_additions){bodies + 20, 70, ids + 20}, NULL) == OVOID_OK);
        if (round == 2)
            for (int i = 0; i < 20; i++)
                if (!retry(&t, ovoid_world_add_ignored(w, ids[i], ids[i + 30], &e)))
                    CHECK(ovoid_world_add_ignored(w, ids[i], ids[i + 30], NULL) == OVOID_OK);
        CHECK_EQ(ovoid_world_get_count(w), round ? 90 : 20);
        if (!retry(&t, ovoid_world_compute_contacts(w, &q, &f, &e)))
            CHECK(ovoid_world_compute_contacts(w, &q, &f, NULL) == OVOID_OK);
        if (t.failures || k % 16 == 0) world_validate_frame(w, &q, &f);
        if (round) test_failing_manifolds(w, &t, ids[round], &past);
        for (int i = 0; i < 20; i++) {
            ovoid_pose p = {random_place(&s, 4), random_quat(&s)};
            CHECK(ovoid_world_move(w, ids[i], &p, NULL) == OVOID_OK);
        }
    }
    ovoid_world_destroy(w);
    CHECK_EQ(t.count.held, 0);
    *failures += t.failures;
}

static void test_memory(void) {
    ovoid_shape *shapes[WORLD_SHAPES];
    uint64_t s = 3;
    world_make_shapes(&s, 1, shapes);
    int failures = 0, before = -1;
    // With one thread every allocation has its turn; with two, those of the workers come in any order.
    for (long k = 0; failures != before || k < 4; k++) {
        before = failures;
        test_failing_allocation(shapes, k, 1, &failures);
    }
    CHECK_LE(30, failures);
    world_destroy_shapes(shapes);
}

int main(void) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    test_rules(box);
    test_bodies_refused(box);
    test_queries_refused(box);
    test_memory();
    ovoid_shape_destroy(box);
    return check_end();
}
