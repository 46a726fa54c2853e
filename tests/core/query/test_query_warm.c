// Bodies that move a little from query to query, small and larger ones, each asked with its last proof. Truth: the
// query without one, whose bracket must meet that with it, with the same sign; and the checker. 17 of 20 answers come
// without a step of the search. Proofs of other pairs, cut off, or with any numbers change nothing but the way. Depths
// start from their last cover too: covers of other pairs, open, folded, or with any numbers change nothing but the way.
#include "check.h"
#include "ovoid/ovoid.h"
#include "places.h"

enum { SHAPES = 24, PAIRS = 60, FRAMES = 40, QUESTIONS = 3 };

static const double margin = 0.2;
static ovoid_shape *shapes[SHAPES];

static int make_shapes(uint64_t *s) {
    for (int i = 0; i < SHAPES; i++) {
        double xyz[3 * 300];
        size_t count = i % 6 == 5 ? 100 + random_next(s) % 201 : 4 + random_next(s) % 29;
        for (size_t k = 0; k < 3 * count; k++) xyz[k] = random_uniform(s, -1, 1);
        ovoid_shape_options o = {.radius = i % 4 == 3 ? 0.1 : 0};
        shapes[i] = ovoid_shape_create_from_points(xyz, count, &o, NULL);
        if (!CHECK(shapes[i] != NULL)) return 0;
    }
    return 1;
}

static ovoid_answer ask(int question, const ovoid_pair *p, const ovoid_proof *earlier) {
    if (question == 0) return ovoid_collide(p, NULL, earlier);
    return question == 1 ? ovoid_within(p, margin, NULL, earlier) : ovoid_distance(p, NULL, earlier);
}

// The weights of a tetrahedron around the origin give a common point: both witnesses are it, to rounding of bodies
// smaller than 10.
static void check_common(const ovoid_answer *x) {
    if (x->proof.kind != OVOID_PROOF_HULL) return;
    ovoid_vec3 a = x->point_a, b = x->point_b;
    CHECK_LE(fabs(b.x - a.x) + fabs(b.y - a.y) + fabs(b.z - a.z), 1e-12);
}

// The answer with a proof says what that without says, and proves it.
static void compare(int question, const ovoid_pair *p, const ovoid_answer *warm) {
    ovoid_answer cold = ask(question, p, NULL);
    CHECK_EQ(ovoid_answer_verify(p, warm, NULL, NULL), OVOID_OK);
    CHECK_EQ(warm->status, cold.status);
    check_common(&cold);
    check_common(warm);
    CHECK(warm->lower <= cold.upper && cold.lower <= warm->upper);
    if (question == 1) CHECK_EQ(ovoid_answer_is_within(warm, margin), ovoid_answer_is_within(&cold, margin));
    if (question == 2 && cold.status == OVOID_SEPARATED) CHECK_EQ(warm->limit, cold.limit);
}

static ovoid_proof make_strange(uint64_t *s, const ovoid_proof *last) {
    ovoid_proof p = *last;
    switch (random_next(s) % 6) {
    case 0: p.count = (uint32_t)(random_next(s) % (OVOID_PROOF_PAIRS + 3)); break;
    case 1: p.a[random_next(s) % 3] = UINT32_MAX; break;
    case 2: p.normal = (ovoid_vec3){NAN, INFINITY, 1e300}; break;
    case 3: p.normal = p.inner_a = (ovoid_vec3){0, 0, 0}; break;
    case 4: p.kind = (ovoid_proof_kind)(random_next(s) % 8); break;
    default: p.a[1] = p.a[0], p.b[1] = p.b[0], p.weight_a[0] = -1;
    }
    return p;
}

static void move(uint64_t *s, ovoid_pose *p, double far) {
    double step = 0.02 * far;
    p->position.x += random_uniform(s, -step, step);
    p->position.y += random_uniform(s, -step, step);
    p->rotation.x += random_uniform(s, -0.01, 0.01);
    p->rotation.z += random_uniform(s, -0.01, 0.01);
}

// One pair's motion; counts the answers that the proof gave at once, by question.
static void follow(uint64_t *s, int pair, double far, int question, long at_once[QUESTIONS]) {
    ovoid_pair p = {shapes[pair % SHAPES],
                    shapes[random_next(s) % SHAPES],
                    {{0, 0, 0}, random_quat(s)},
                    {{far, 0.1 * far, 0}, random_quat(s)}};
    ovoid_proof last = ask(question, &p, NULL).proof;
    for (int i = 0; i < FRAMES; i++) {
        check_seed = (uint64_t)(pair * FRAMES + i);
        move(s, &p.pose_b, far);
        ovoid_proof strange = make_strange(s, &last);
        ovoid_answer x = ask(question, &p, &strange);
        compare(question, &p, &x);
        x = ask(question, &p, &last);
        compare(question, &p, &x);
        at_once[question] += x.iterations == 0 && (x.stage == OVOID_STAGE_PROOF || x.stage == OVOID_STAGE_SPHERE);
        last = x.proof;
    }
}

// ---- depths from their last cover

/// Room for a cover, and for a copy of it that is altered.
typedef struct cover_room {
    uint64_t memory[OVOID_COVER_SIZE / sizeof(uint64_t)];
    ovoid_cover cover;
    uint32_t a[OVOID_COVER_POINTS], b[OVOID_COVER_POINTS];
    uint16_t triangles[2 * OVOID_COVER_POINTS][3];
} cover_room;

static void make_room(cover_room *room) {
    room->cover = (ovoid_cover){.memory = room->memory, .size = sizeof room->memory};
}

/// Altered in one place, in arrays outside of the memory.
static void alter(cover_room *room, uint64_t *s) {
    ovoid_cover *c = &room->cover;
    if (!c->point_count) return;
    memcpy(room->a, c->a, c->point_count * sizeof *room->a);
    memcpy(room->b, c->b, c->point_count * sizeof *room->b);
    memcpy(room->triangles, c->triangles, c->triangle_count * sizeof *room->triangles);
    c->a = room->a, c->b = room->b, c->triangles = (const uint16_t(*)[3])room->triangles;
    uint32_t point = (uint32_t)(random_next(s) % c->point_count), face = (uint32_t)(random_next(s) % c->triangle_count);
    uint16_t *v = room->triangles[face], first = v[0];
    switch (random_next(s) % 9) {
    case 0: room->a[point] = (uint32_t)random_next(s); break;
    case 1: room->b[point] = (uint32_t)random_next(s); break;
    case 2: room->a[point] = (uint32_t)(random_next(s) % 5); break;
    case 3: room->b[point] = room->b[(point + 1) % c->point_count]; break;
    case 4: v[random_next(s) % 3] = (uint16_t)random_next(s); break;
    case 5: v[random_next(s) % 3] = (uint16_t)(random_next(s) % c->point_count); break;
    case 6: v[0] = v[1], v[1] = first; break;
    case 7: c->triangle_count = (uint32_t)(random_next(s) % (c->triangle_count + 1)); break;
    default: c->point_count = (uint32_t)(random_next(s) % (c->point_count + 1));
    }
}

static int is_same_answer(const ovoid_answer *x, const ovoid_answer *y) {
    return x->status == y->status && x->stage == y->stage && x->limit == y->limit && x->iterations == y->iterations &&
           memcmp(&x->lower, &y->lower, 2 * sizeof(double) + 3 * sizeof(ovoid_vec3)) == 0;
}

/// The depth from a cover says what that without says, and proves it; it has the same bits wherever the arrays are.
static ovoid_answer ask_from(const ovoid_pair *p, const ovoid_proof *earlier, cover_room *room) {
    static cover_room copy;
    copy = *room;
    copy.cover.memory = copy.memory;
    // The copy reads the room's arrays, so it comes first.
    ovoid_answer y = ovoid_depth_from(p, NULL, earlier, &copy.cover);
    ovoid_answer x = ovoid_depth_from(p, NULL, earlier, &room->cover);
    ovoid_answer cold = ovoid_depth(p, NULL, NULL, NULL);
    CHECK(is_same_answer(&x, &y));
    CHECK_EQ(ovoid_answer_verify(p, &x, &(ovoid_answer_basis){.cover = &room->cover}, NULL), OVOID_OK);
    CHECK_EQ(x.status, cold.status);
    CHECK_EQ(x.limit, cold.limit);
    CHECK(x.lower <= cold.upper && cold.lower <= x.upper);
    CHECK_EQ(room->cover.point_count > 0, x.proof.kind == OVOID_PROOF_COVER);
    return x;
}

/// One pair's motion, with its own cover and with others; counts the depths without a step.
static long follow_depth(uint64_t *s, int pair, double far) {
    static cover_room room, strange;
    ovoid_pair p = {shapes[pair % SHAPES],
                    shapes[random_next(s) % SHAPES],
                    {{0, 0, 0}, random_quat(s)},
                    {{far, 0.1 * far, 0}, random_quat(s)}};
    ovoid_proof last = {.count = 0};
    long at_once = 0;
    make_room(&room);
    for (int i = 0; i < FRAMES; i++) {
        check_seed = (uint64_t)(pair * FRAMES + i);
        move(s, &p.pose_b, far);
        // The cover of another pair, or of this one with a fault.
        if (i == 0 && pair % 2 == 0) make_room(&strange);
        if (i % 2) strange = room;
        strange.cover.memory = strange.memory;
        alter(&strange, s);
        (void)ask_from(&p, i % 3 ? &last : NULL, &strange);
        ovoid_answer x = ask_from(&p, &last, &room);
        at_once += x.iterations == 0 && x.stage == OVOID_STAGE_PROOF;
        last = x.proof;
    }
    return at_once;
}

static void check_depths(uint64_t *s) {
    static const double places[2] = {0.3, 0.9};
    for (int place = 0; place < 2; place++) {
        long at_once = 0;
        for (int i = 0; i < PAIRS; i++) at_once += follow_depth(s, i, places[place]);
        printf("at %g: %ld of %d depths at once\n", places[place], at_once, PAIRS * FRAMES);
        CHECK_LE(0.5 * PAIRS * FRAMES, at_once);
    }
    // Nothing to start from: the bits of a depth, which starts from no cover.
    static cover_room room;
    make_room(&room);
    ovoid_pair p = {shapes[0], shapes[1], ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    ovoid_answer x = ovoid_depth_from(&p, NULL, NULL, &room.cover), y = ovoid_depth(&p, NULL, NULL, NULL);
    ovoid_answer z = ovoid_depth_from(&p, NULL, NULL, NULL);
    CHECK(is_same_answer(&x, &y) && is_same_answer(&z, &y));
    CHECK(room.cover.point_count > 0);
    z = ovoid_depth(&p, NULL, &x.proof, NULL);
    y = ovoid_depth(&p, NULL, &x.proof, &room.cover);
    CHECK(is_same_answer(&z, &y));
    room.cover.memory = NULL;
    CHECK_EQ(ovoid_depth_from(&p, NULL, NULL, &room.cover).limit, OVOID_LIMIT_MEMORY);
}

int main(void) {
    uint64_t s = 3;
    if (!make_shapes(&s)) return 1;
    static const double places[4] = {0.3, 1.2, 1.7, 2.2};
    for (int place = 0; place < 4; place++) {
        long at_once[QUESTIONS] = {0};
        for (int question = 0; question < QUESTIONS; question++)
            for (int i = 0; i < PAIRS; i++) follow(&s, i, places[place], question, at_once);
        for (int question = 0; question < QUESTIONS; question++) {
            printf("at %g, question %d: %ld of %d at once\n", places[place], question, at_once[question],
                   PAIRS * FRAMES);
            CHECK_LE(0.85 * PAIRS * FRAMES, at_once[question]);
        }
    }
    check_depths(&s);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
