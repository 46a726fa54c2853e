// Depths of a world's pairs whose search fills its own memory and goes on in the world's: balls with nearly one centre,
// alone and as parts, beside pairs that need no more; and of hulls in motion. Truth: the pair asked alone with memory;
// the verifier; the same bits on any number of threads; where an allocation fails, the call after it.
#include "countdown.h"
#include "proofs/covers.h"
#include "worlds.h"

enum { PAIRS = 7, VERTICES = 700 };

static ovoid_shape *make_ball(void) {
    double points[3 * VERTICES];
    for (int i = 0; i < VERTICES; i++) {
        double z = 2 * (i + 0.5) / VERTICES - 1, r = sqrt(1 - z * z), turn = 2.399963229728653 * i;
        points[3 * i] = r * cos(turn), points[3 * i + 1] = r * sin(turn), points[3 * i + 2] = z;
    }
    return ovoid_shape_create_from_points(points, VERTICES, NULL, NULL);
}

typedef struct stage {
    ovoid_shape *ball, *box;
    ovoid_compound *parts;
    ovoid_body bodies[2 * PAIRS];
} stage;

static ovoid_vec3 random_near(uint64_t *s) {
    return (ovoid_vec3){1e-3 * random_normal(s), 1e-3 * random_normal(s), 1e-3 * random_normal(s)};
}

// Two balls in one another of each pair; of the fifth a compound and a ball, of the sixth two boxes.
static void begin(stage *x, uint64_t seed) {
    uint64_t s = seed;
    x->ball = make_ball();
    x->box = ovoid_shape_create_box((ovoid_vec3){1, 0.5, 0.25}, NULL, NULL);
    const ovoid_posed_shape parts[2] = {{x->ball, {{0, 0, 0}, {1, 0, 0, 0}}}, {x->box, {{0, 1, 0}, {1, 0, 0, 0}}}};
    x->parts = ovoid_compound_create(parts, 2, NULL, NULL);
    for (int i = 0; i < 2 * PAIRS; i++) {
        ovoid_body *body = &x->bodies[i];
        *body = (ovoid_body){.pose = {random_near(&s), random_quat(&s)}};
        body->pose.position.x += 4.0 * (i / 2);
        if (i == 8)
            body->compound = x->parts;
        else
            body->shape = i / 2 == 5 ? x->box : x->ball;
    }
}

static void end(stage *x) {
    ovoid_compound_destroy(x->parts);
    ovoid_shape_destroy(x->ball);
    ovoid_shape_destroy(x->box);
}

static ovoid_world *make_world(const stage *x, uint32_t threads, const ovoid_allocator *allocator) {
    ovoid_world *w = ovoid_world_create(&(ovoid_world_options){.threads = threads, .allocator = allocator}, NULL);
    for (int i = 0; w && i < 2 * PAIRS; i++) {
        const ovoid_world_body b = {.body = x->bodies[i], .user = (uint64_t)i};
        if (!ovoid_world_add(w, &b, NULL)) {
            ovoid_world_destroy(w);
            return NULL;
        }
    }
    return w;
}

static const ovoid_contact_query depth = {.kind = OVOID_QUERY_DEPTH};

static void check_contact(const ovoid_world *w, const stage *x, const ovoid_contact *c, ovoid_cover *cover) {
    const ovoid_body_pair pair = {x->bodies[c->user_a], x->bodies[c->user_b]};
    ovoid_exclusions all = {.grows = 1, .cover = cover};
    ovoid_body_answer alone = ovoid_body_depth(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    CHECK_EQ((int)c->verdict.limit, (int)OVOID_LIMIT_NONE);
    CHECK_EQ((int)c->verdict.status, (int)alone.status);
    CHECK_LE(c->verdict.upper - c->verdict.lower, 1e-8);
    CHECK(c->verdict.lower <= alone.upper && alone.lower <= c->verdict.upper);
    ovoid_contact_proof proof = {.exclusions = &all};
    CHECK(ovoid_world_compute_proof(w, c, &proof, NULL) == OVOID_OK);
    CHECK(ovoid_body_verify(&pair, &proof.answer, &(ovoid_body_basis){.exclusions = &all}, NULL) == OVOID_OK);
    ovoid_exclusions_release(&all);
}

static void check_frames(uint64_t seed) {
    stage x;
    ovoid_contacts found[2];
    ovoid_cover cover = {.size = ovoid_cover_get_size(OVOID_COVER_POINTS_MAX)};
    cover.memory = malloc(cover.size);
    begin(&x, seed);
    ovoid_world *worlds[2] = {make_world(&x, 1, NULL), make_world(&x, 3, NULL)};
    // In the second frame nothing has moved, in the third every other pair.
    for (int frame = 0; frame < 3; frame++) {
        for (int i = 0; i < 2; i++) CHECK(ovoid_world_compute_contacts(worlds[i], &depth, &found[i], NULL) == OVOID_OK);
        CHECK_EQ(found[0].count, PAIRS);
        CHECK_EQ(found[1].count, PAIRS);
        for (size_t i = 0; i < found[0].count; i++) {
            CHECK(memcmp(&found[0].items[i].verdict, &found[1].items[i].verdict, sizeof(ovoid_verdict)) == 0);
            check_contact(worlds[0], &x, &found[0].items[i], &cover);
        }
        for (size_t i = 0; frame == 1 && i < found[0].count; i += 2) {
            ovoid_body *body = &x.bodies[found[0].items[i].user_a];
            body->pose.position.y += 1e-3;
            ovoid_id id = found[0].items[i].a;
            for (int k = 0; k < 2; k++) CHECK(ovoid_world_move(worlds[k], id, &body->pose, NULL) == OVOID_OK);
        }
    }
    ovoid_world_destroy(worlds[0]);
    ovoid_world_destroy(worlds[1]);
    free(cover.memory);
    end(&x);
}

// ---- hulls in motion, whose depths start from the last surface

enum { HULLS = 24, FRAMES = 30 };

static ovoid_shape *make_hull(uint64_t *s) {
    double points[3 * 60];
    size_t count = 6 + random_next(s) % 54;
    for (size_t i = 0; i < 3 * count; i++) points[i] = random_uniform(s, -1, 1);
    return ovoid_shape_create_from_points(points, count, NULL, NULL);
}

static void turn(uint64_t *s, ovoid_pose *pose) {
    pose->rotation.x += random_uniform(s, -0.01, 0.01);
    pose->rotation.z += random_uniform(s, -0.01, 0.01);
    pose->position.y += random_uniform(s, -0.01, 0.01);
}

static void check_moving(void) {
    uint64_t s = 11;
    ovoid_shape *shapes[HULLS];
    ovoid_pose poses[HULLS];
    ovoid_id ids[2][HULLS];
    ovoid_world *worlds[2] = {ovoid_world_create(&(ovoid_world_options){.threads = 1}, NULL),
                              ovoid_world_create(&(ovoid_world_options){.threads = 3}, NULL)};
    for (uint32_t i = 0; i < HULLS; i++) {
        shapes[i] = make_hull(&s);
        poses[i] = (ovoid_pose){{4.0 * (i / 2) + 0.5 * (i % 2), 0, 0}, random_quat(&s)};
        const ovoid_world_body b = {.body = {.shape = shapes[i], .pose = poses[i]}, .user = i};
        for (int k = 0; k < 2; k++) ids[k][i] = ovoid_world_add(worlds[k], &b, NULL);
    }
    long at_once = 0, overlaps = 0;
    for (int frame = 0; frame < FRAMES; frame++) {
        ovoid_contacts found[2];
        // Every tenth frame asks for yes or no: depths start from the surface before it no more.
        const ovoid_contact_query query = {.kind = frame % 10 == 9 ? OVOID_QUERY_COLLIDE : OVOID_QUERY_DEPTH};
        for (int k = 0; k < 2; k++) CHECK(ovoid_world_compute_contacts(worlds[k], &query, &found[k], NULL) == OVOID_OK);
        CHECK_EQ(found[0].count, found[1].count);
        for (size_t i = 0; i < found[0].count; i++) {
            const ovoid_contact *c = &found[0].items[i];
            const ovoid_pair pair = {shapes[c->user_a], shapes[c->user_b], poses[c->user_a], poses[c->user_b]};
            ovoid_answer truth = ovoid_depth(&pair, NULL, NULL, NULL);
            CHECK(memcmp(&c->verdict, &found[1].items[i].verdict, sizeof(ovoid_verdict)) == 0);
            CHECK_EQ((int)c->verdict.status, (int)truth.status);
            CHECK(c->verdict.lower <= truth.upper && truth.lower <= c->verdict.upper);
            if (query.kind == OVOID_QUERY_DEPTH) CHECK_LE(c->verdict.upper - c->verdict.lower, 1e-8);
            overlaps += query.kind == OVOID_QUERY_DEPTH && truth.status == OVOID_OVERLAPPING;
            at_once +=
                query.kind == OVOID_QUERY_DEPTH && c->verdict.stage == OVOID_STAGE_PROOF && !c->verdict.iterations;
        }
        for (uint32_t i = 0; i < HULLS; i++) {
            turn(&s, &poses[i]);
            for (int k = 0; k < 2; k++) CHECK(ovoid_world_move(worlds[k], ids[k][i], &poses[i], NULL) == OVOID_OK);
        }
    }
    printf("%ld of %ld depths at once\n", at_once, overlaps);
    CHECK_LE(0.6 * (double)overlaps, at_once);
    for (int k = 0; k < 2; k++) ovoid_world_destroy(worlds[k]);
    for (int i = 0; i < HULLS; i++) ovoid_shape_destroy(shapes[i]);
}

// With the k-th allocation failing: an error, and the same call again is answered.
static void check_memory(void) {
    stage x;
    long calls = 0;
    begin(&x, 5);
    for (long k = 0; calls >= 0; k++) {
        countdown memory = {k, 0};
        ovoid_allocator allocator = countdown_make_allocator(&memory);
        ovoid_world *w = make_world(&x, 1, &allocator);
        if (w) {
            ovoid_contacts found;
            ovoid_error error = {0};
            ovoid_code code = ovoid_world_compute_contacts(w, &depth, &found, &error);
            CHECK(code == OVOID_OK || code == OVOID_ERROR_MEMORY);
            calls = code == OVOID_OK ? -1 : calls + 1;
            memory.left = 1000;
            CHECK(ovoid_world_compute_contacts(w, &depth, &found, &error) == OVOID_OK && found.count == PAIRS);
            for (size_t i = 0; i < found.count; i++) CHECK_EQ((int)found.items[i].verdict.limit, (int)OVOID_LIMIT_NONE);
            ovoid_world_destroy(w);
        }
        CHECK_EQ(memory.held, 0);
    }
    end(&x);
}

// The same of bodies that the world knows from another query and that do not move: with the k-th allocation of the
// first depths failing, the call after it finds them.
static void check_asked_again(void) {
    stage x;
    ovoid_contacts found;
    ovoid_code code = OVOID_ERROR_MEMORY;
    begin(&x, 6);
    for (long k = 0; code != OVOID_OK; k++) {
        countdown memory = {100000, 0};
        ovoid_allocator allocator = countdown_make_allocator(&memory);
        ovoid_world *w = make_world(&x, 1, &allocator);
        ovoid_contact_query collide = {.kind = OVOID_QUERY_COLLIDE};
        CHECK(ovoid_world_compute_contacts(w, &collide, &found, NULL) == OVOID_OK);
        memory.left = k;
        code = ovoid_world_compute_contacts(w, &depth, &found, NULL);
        memory.left = 1000;
        CHECK(ovoid_world_compute_contacts(w, &depth, &found, NULL) == OVOID_OK && found.count == PAIRS);
        for (size_t i = 0; i < found.count; i++) CHECK_EQ((int)found.items[i].verdict.limit, (int)OVOID_LIMIT_NONE);
        ovoid_world_destroy(w);
        CHECK_EQ(memory.held, 0);
    }
    end(&x);
}

int main(void) {
    check_moving();
    for (uint64_t seed = 1; seed <= 3; seed++) check_frames(check_seed = seed);
    check_seed = 0;
    check_memory();
    check_asked_again();
    return check_end();
}
