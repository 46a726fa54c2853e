// Where a world decides by what it knows of earlier frames, at the edge of what that allows: margins of 10 and 100
// sizes, arms that turn about a far axis, bodies that drift slowly. Truth: the query of each pair alone, cold, whose
// answers have proofs that other tests put before the exact judge; no pair that it does not part may be missing in a
// frame, and what is reported must hold its bracket.
#include "worlds.h"

static const ovoid_pose here = {{0, 0, 0}, {1, 0, 0, 0}};

// A turn by an angle about a unit axis.
static ovoid_quat make_turn(ovoid_vec3 axis, double angle) {
    double s = sin(angle / 2);
    return (ovoid_quat){cos(angle / 2), s * axis.x, s * axis.y, s * axis.z};
}

static ovoid_quat multiplied(ovoid_quat p, ovoid_quat q) {
    ovoid_pose a = {{0, 0, 0}, p}, b = {{0, 0, 0}, q};
    return ovoid_pose_compute_product(&a, &b).rotation;
}

static ovoid_vec3 turned(ovoid_quat q, ovoid_vec3 v) {
    ovoid_pose a = {{0, 0, 0}, q}, b = {v, {1, 0, 0, 0}};
    return ovoid_pose_compute_product(&a, &b).position;
}

static void add(ovoid_world *w, ovoid_id *id, const ovoid_shape *shape, ovoid_pose pose) {
    ovoid_world_body b = {.body = {.shape = shape, .pose = pose}};
    *id = ovoid_world_add(w, &b, NULL);
    CHECK(*id != 0);
}

static size_t look(ovoid_world *w, const ovoid_contact_query *q) {
    ovoid_contacts f;
    CHECK(ovoid_world_compute_contacts(w, q, &f, NULL) == OVOID_OK);
    world_validate_frame(w, q, &f);
    return f.count;
}

// ---- two bodies whose gap is the margin, a little less and a little more: still, and drifting across it

static void test_margin(const ovoid_shape *a, const ovoid_shape *b, double margin, double enlargement, uint64_t *s) {
    ovoid_world *w = ovoid_world_create(&(ovoid_world_options){.enlargement = enlargement}, NULL);
    ovoid_contact_query q = {.kind = (ovoid_query_kind)(1 + random_next(s) % 3), .margin = margin};
    ovoid_id ids[2];
    // Along an axis of the world, in which boxes are as far apart as the bodies: both are boxes of half size 1.
    ovoid_vec3 way = {0, 0, 0};
    double *along = random_next(s) % 3 == 0 ? &way.x : random_next(s) % 2 ? &way.y : &way.z;
    double sign = random_next(s) % 2 ? 1 : -1;
    add(w, &ids[0], a, here);
    *along = sign * (2 + 1.5 * margin);
    add(w, &ids[1], b, (ovoid_pose){way, {1, 0, 0, 0}});
    CHECK_EQ(look(w, &q), 0);
    static const double shares[] = {0.9999999, 0.5, 1 + 1e-7, 0.985, 1.2, 0.999};
    for (int i = 0; i < 6; i++) {
        *along = sign * (2 + shares[i] * margin);
        CHECK(ovoid_world_move(w, ids[1], &(ovoid_pose){way, {1, 0, 0, 0}}, NULL) == OVOID_OK);
        CHECK_EQ(look(w, &q), shares[i] < 1);
    }
    // Slowly in, slowly out: in steps of a thousandth of the margin.
    for (int i = -12; i <= 12; i++) {
        *along = sign * (2 + (1 + (double)abs(i) / 1000 - 0.0065) * margin);
        CHECK(ovoid_world_move(w, ids[1], &(ovoid_pose){way, {1, 0, 0, 0}}, NULL) == OVOID_OK);
        CHECK_EQ(look(w, &q), abs(i) < 6.5);
    }
    ovoid_world_destroy(w);
}

// ---- an arm that turns about an axis, toward a small body and past it

typedef struct arm {
    ovoid_shape *shape, *small;
    double length, thick, gap;
} arm;

// A rod along x, from -length to length about `middle` in its own frame, which is where it is turned about.
static arm make_arm(uint64_t *s, double middle) {
    arm a = {.length = random_uniform(s, 3, 20), .thick = random_uniform(s, 0.01, 0.05)};
    double xyz[3 * 8];
    for (int i = 0; i < 8; i++) {
        xyz[3 * i] = middle + (i & 1 ? a.length : -a.length);
        xyz[3 * i + 1] = i & 2 ? a.thick : -a.thick;
        xyz[3 * i + 2] = i & 4 ? a.thick : -a.thick;
    }
    a.shape = ovoid_shape_create_from_points(xyz, 8, NULL, NULL);
    a.small = ovoid_shape_create_box((ovoid_vec3){0.1, 0.1, 0.1}, NULL, NULL);
    a.gap = exp(random_uniform(s, log(0.02), log(0.5)));
    return a;
}

// The gap is closed by turns alone, in steps of 1.5 % of it, and opened again.
static void test_arm(uint64_t seed, int is_compound) {
    uint64_t s = check_seed = seed;
    double middle = seed % 3 ? random_uniform(&s, -40, 40) : 0;
    arm a = make_arm(&s, middle);
    ovoid_posed_shape part = {a.shape, here};
    ovoid_compound *c = is_compound ? ovoid_compound_create(&part, 1, NULL, NULL) : NULL;
    ovoid_world *w = ovoid_world_create(&(ovoid_world_options){.enlargement = seed % 2 ? 1e-9 : 0}, NULL);
    double margin = seed % 4 == 0 ? 0.3 * a.gap : 0;
    ovoid_contact_query q = {.kind = margin > 0 ? OVOID_QUERY_WITHIN : OVOID_QUERY_COLLIDE, .margin = margin};
    // The whole scene in any attitude; the small body is under the tip.
    ovoid_quat attitude = random_quat(&s);
    double tip = middle + (seed % 5 == 1 ? -1 : 1) * (a.length - 0.1), down = tip < 0 ? 1 : -1;
    ovoid_vec3 at = {tip, -(a.thick + 0.1 + margin + a.gap), 0};
    ovoid_id ids[2];
    ovoid_world_body body = {.body = {.shape = c ? NULL : a.shape, .compound = c, .pose = {{0, 0, 0}, attitude}}};
    ids[0] = ovoid_world_add(w, &body, NULL);
    add(w, &ids[1], a.small, (ovoid_pose){turned(attitude, at), attitude});
    double step = 0.015 * a.gap / fabs(tip);
    size_t contacts = 0;
    for (int i = 0; i < 160; i++) {
        int turns = i < 90 ? i : 180 - i;
        ovoid_quat turn = make_turn((ovoid_vec3){0, 0, 1}, down * step * turns);
        ovoid_pose pose = {{0, 0, 0}, multiplied(attitude, turn)};
        CHECK(ovoid_world_move(w, ids[0], &pose, NULL) == OVOID_OK);
        contacts += look(w, &q);
    }
    CHECK_LE(10, contacts);
    CHECK_LE(contacts, 80);
    ovoid_world_destroy(w);
    ovoid_compound_destroy(c);
    ovoid_shape_destroy(a.shape);
    ovoid_shape_destroy(a.small);
}

// ---- turns of any size: half a turn takes every point of a body to the other side

static void test_half_turns(uint64_t seed) {
    uint64_t s = check_seed = seed;
    ovoid_shape *rod = ovoid_shape_create_box((ovoid_vec3){6, 0.2, 0.2}, NULL, NULL);
    ovoid_shape *ball = ovoid_shape_create_sphere(0.3, NULL, NULL);
    ovoid_world *w = ovoid_world_create(&(ovoid_world_options){.enlargement = seed % 2 ? 2 : 0}, NULL);
    ovoid_contact_query q = {.kind = seed % 3 ? OVOID_QUERY_COLLIDE : OVOID_QUERY_WITHIN};
    q.margin = q.kind == OVOID_QUERY_WITHIN ? 0.2 : 0;
    ovoid_id id, other;
    add(w, &id, rod, here);
    for (int i = 0; i < 12; i++) add(w, &other, ball, (ovoid_pose){random_place(&s, 4), {1, 0, 0, 0}});
    for (int i = 0; i < 60; i++) {
        ovoid_vec3 axis = {random_uniform(&s, -0.2, 0.2), random_uniform(&s, -0.2, 0.2), 1};
        double norm = sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
        ovoid_vec3 unit = {axis.x / norm, axis.y / norm, axis.z / norm};
        ovoid_pose pose = {{0, 0, 0}, make_turn(unit, random_uniform(&s, -4, 4))};
        CHECK(ovoid_world_move(w, id, &pose, NULL) == OVOID_OK);
        (void)look(w, &q);
    }
    ovoid_world_destroy(w);
    ovoid_shape_destroy(rod);
    ovoid_shape_destroy(ball);
}

// ---- capsules, whose brackets are tight: contacts within the margin that part, meet and overlap while they age

static void test_capsules(uint64_t seed) {
    uint64_t s = check_seed = seed;
    ovoid_shape *pill = ovoid_shape_create_capsule(0.5, 8, NULL, NULL),
                *ball = ovoid_shape_create_sphere(0.5, NULL, NULL);
    ovoid_posed_shape part = {ball, here};
    ovoid_compound *c = ovoid_compound_create(&part, 1, NULL, NULL);
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_contact_query q = {.kind = OVOID_QUERY_WITHIN, .margin = 1};
    ovoid_id ids[2];
    // The capsule is along z; the ball beside its end, from overlapping to beyond the margin.
    double gap = random_uniform(&s, -0.6, 1.2);
    add(w, &ids[0], pill, here);
    ovoid_world_body body = {.body = {.shape = seed % 2 ? ball : NULL,
                                      .compound = seed % 2 ? NULL : c,
                                      .pose = {{1 + gap, 0, 3.9}, {1, 0, 0, 0}}}};
    ids[1] = ovoid_world_add(w, &body, NULL);
    double step = (seed % 4 < 2 ? 1 : -1) * 0.004;
    for (int i = 0; i < 100; i++) {
        ovoid_pose pose = {{0, 0, 0}, make_turn((ovoid_vec3){0, 1, 0}, step * i)};
        CHECK(ovoid_world_move(w, ids[0], &pose, NULL) == OVOID_OK);
        (void)look(w, &q);
    }
    // A change of the question: what answered the last one must not answer this one.
    for (int i = 0; i < 6; i++) {
        q = (ovoid_contact_query){.kind = i % 2 ? OVOID_QUERY_COLLIDE : OVOID_QUERY_WITHIN};
        if (q.kind == OVOID_QUERY_WITHIN) q.margin = random_uniform(&s, 0, 2);
        (void)look(w, &q);
    }
    ovoid_world_destroy(w);
    ovoid_compound_destroy(c);
    ovoid_shape_destroy(pill);
    ovoid_shape_destroy(ball);
}

// ---- rounded boxes deep in each other, whose kept proof is measured again as they move: both reported bounds are true

static void test_rounded(const ovoid_shape *round, uint64_t seed) {
    uint64_t s = check_seed = seed;
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_contact_query q = {.kind = OVOID_QUERY_COLLIDE};
    ovoid_id ids[2];
    add(w, &ids[0], round, (ovoid_pose){{0, 0, 0}, random_quat(&s)});
    // It turns where it is, so that only the turns use up what is known.
    ovoid_pose pose = {turned(random_quat(&s), (ovoid_vec3){random_uniform(&s, 0.2, 1.2), 0, 0}), random_quat(&s)};
    add(w, &ids[1], round, pose);
    for (int i = 0; i < 60; i++) {
        pose.rotation = multiplied(pose.rotation, make_turn((ovoid_vec3){0.6, 0, 0.8}, 0.15));
        CHECK(ovoid_world_move(w, ids[1], &pose, NULL) == OVOID_OK);
        (void)look(w, &q);
    }
    ovoid_world_destroy(w);
}

int main(void) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_shape *round =
        ovoid_shape_create_box((ovoid_vec3){0.5, 0.5, 0.5}, &(ovoid_shape_options){.radius = 0.5}, NULL);
    uint64_t s = 1;
    static const double margins[] = {0.01, 1, 10, 100, 1e4};
    for (int k = 0; k < 60; k++) {
        check_seed = (uint64_t)k;
        test_margin(box, k % 2 ? box : round, margins[k % 5], k % 3 == 0 ? 0 : k % 3 == 1 ? 1e-9 : 0.3, &s);
    }
    for (uint64_t seed = 1; seed <= 60; seed++) test_arm(seed, seed % 3 == 2);
    for (uint64_t seed = 1; seed <= 20; seed++) test_half_turns(seed);
    for (uint64_t seed = 1; seed <= 40; seed++) test_capsules(seed);
    for (uint64_t seed = 1; seed <= 30; seed++) test_rounded(round, seed);
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(round);
    return check_end();
}
