// What rounding can do to a world: bodies far from the origin, or far from their own frame's, that move by less than
// their centres are rounded by; a body that has turned so often that its travel has few digits left; rays and bodies
// that only graze what they meet. Truth: the query of each pair alone, cold (its answers have proofs that other tests
// put before the exact judge, and it takes differences of positions exactly); for casts, that the ray goes through a
// point of the body by construction, in numbers that doubles hold.
#include "linear/exact.h"
#include "worlds.h"

static ovoid_shape *make_box_at(ovoid_vec3 at, ovoid_vec3 half, double radius) {
    double xyz[3 * 8];
    for (int i = 0; i < 8; i++) {
        xyz[3 * i] = at.x + (i & 1 ? half.x : -half.x);
        xyz[3 * i + 1] = at.y + (i & 2 ? half.y : -half.y);
        xyz[3 * i + 2] = at.z + (i & 4 ? half.z : -half.z);
    }
    int is_point = half.x == 0 && half.y == 0 && half.z == 0;
    return ovoid_shape_create_from_points(xyz, is_point ? 1 : 8, &(ovoid_shape_options){.radius = radius}, NULL);
}

// ---- far away: A turns about an axis 64 sizes off by angles that move it by less than a rounding of its position

typedef struct far_case {
    double far, grid; ///< of positions along y, and what they are rounded by
    int is_local;     ///< the bodies are far from their own frames' origins, and near the world's
    ovoid_shape *a, *b;
    ovoid_vec3 at_a, at_b;
} far_case;

static far_case make_far_case(uint64_t seed, uint64_t *s) {
    far_case c = {.far = ldexp(1, 12 + (int)(random_next(s) % 18)), .is_local = seed % 3 == 2};
    c.grid = c.far * 0x1p-52;
    // Half sizes are 1 and a part of a rounding; so the gap is one, of either sign.
    double more_a = random_uniform(s, 0, 0.5) * c.grid, more_b = random_uniform(s, -1.5, 0.5) * c.grid;
    double local = c.is_local ? c.far : 0, place = c.is_local ? -c.far : c.far;
    int is_ball = seed % 4 == 1;
    ovoid_vec3 half_a = {1, 1 + more_a, 1}, half_b = {1, 1 + more_b, 1}, none = {0, 0, 0};
    c.a = make_box_at((ovoid_vec3){64, local, 0}, is_ball ? none : half_a, is_ball ? 1 + more_a : 0);
    // Near their places' origins both turn alike, and 128 apart, so that one goes up as the other goes down.
    c.b = make_box_at((ovoid_vec3){c.is_local ? -64 : 64, local, 0}, is_ball ? none : half_b, is_ball ? 1 + more_b : 0);
    c.at_a = (ovoid_vec3){0, place, 0};
    c.at_b = (ovoid_vec3){c.is_local ? 128 : 0, place + 2, 0};
    return c;
}

static void test_far(uint64_t seed) {
    uint64_t s = check_seed = seed;
    far_case c = make_far_case(seed, &s);
    // Some begin near the origin, where centres are known well, as a pair that is asked there, and go far together.
    int is_moved = seed % 5 < 2 && !c.is_local;
    double enlargement = is_moved ? 1 : 0;
    if (!is_moved && seed % 2) enlargement = 1e-30;
    ovoid_world *w = ovoid_world_create(&(ovoid_world_options){.enlargement = enlargement}, NULL);
    ovoid_contact_query q = {.kind = OVOID_QUERY_COLLIDE};
    // Some as compounds of one part.
    ovoid_posed_shape part_a = {c.a, {{0, 0, 0}, {1, 0, 0, 0}}}, part_b = {c.b, part_a.pose};
    int are_compounds = seed % 7 > 4;
    ovoid_compound *all_a = are_compounds ? ovoid_compound_create(&part_a, 1, NULL, NULL) : NULL;
    ovoid_compound *all_b = are_compounds ? ovoid_compound_create(&part_b, 1, NULL, NULL) : NULL;
    ovoid_world_body a = {
        .body = {.shape = are_compounds ? NULL : c.a, .compound = all_a, .pose = {c.at_a, {1, 0, 0, 0}}}};
    ovoid_world_body b = {
        .body = {.shape = are_compounds ? NULL : c.b, .compound = all_b, .pose = {c.at_b, {1, 0, 0, 0}}}};
    if (is_moved) a.body.pose.position.y = 0, b.body.pose.position.y = 2.5;
    ovoid_id ids[2] = {ovoid_world_add(w, &a, NULL), ovoid_world_add(w, &b, NULL)};
    // A turn by an angle r moves A by 64 r along y, about a rounding at most; and along x by far r, which B does too.
    double most = c.is_local ? c.grid / 128 : c.grid / 64;
    for (int i = 0; i < 12; i++) {
        double half = random_uniform(&s, -0.5, 0.5) * most;
        ovoid_pose pose = {c.at_a, {1, 0, 0, half}}, other = {c.at_b, {1, 0, 0, c.is_local ? half : 0}};
        if (i % 4 == 3 && random_next(&s) % 2) other.position.y += c.grid;
        if (i) CHECK(ovoid_world_move(w, ids[0], &pose, NULL) == OVOID_OK);
        if (i == 1 || i % 4 == 3 || (i && c.is_local)) CHECK(ovoid_world_move(w, ids[1], &other, NULL) == OVOID_OK);
        ovoid_contacts f;
        CHECK(ovoid_world_compute_contacts(w, &q, &f, NULL) == OVOID_OK);
        world_validate_frame(w, &q, &f);
        // Between frames: the same truth from the boxes alone.
        ovoid_world_hit hit;
        CHECK(ovoid_world_find_any(w, NULL, &hit, NULL) == OVOID_OK);
        CHECK_EQ(hit.b != 0, f.count);
    }
    ovoid_world_destroy(w);
    ovoid_compound_destroy(all_a);
    ovoid_compound_destroy(all_b);
    ovoid_shape_destroy(c.a);
    ovoid_shape_destroy(c.b);
}

// ---- a long life: B has turned two million times; then A comes near by less than a rounding of that travel

static void test_long_life(int kind) {
    uint64_t s = 3;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_shape *ball = ovoid_shape_create_sphere(1, NULL, NULL);
    ovoid_posed_shape part = {ball, {{0, 0, 0}, {1, 0, 0, 0}}};
    ovoid_compound *c = ovoid_compound_create(&part, 1, NULL, NULL);
    ovoid_world *w = ovoid_world_create(&(ovoid_world_options){.enlargement = 4}, NULL);
    ovoid_world_body b = {.body = {.shape = box, .pose = {{0, 0, 0}, {1, 0, 0, 0}}}};
    ovoid_world_body a = {
        .body = {.shape = kind ? NULL : box, .compound = kind ? c : NULL, .pose = {{3, 0, 0}, {1, 0, 0, 0}}}};
    ovoid_id ids[2] = {ovoid_world_add(w, &b, NULL), ovoid_world_add(w, &a, NULL)};
    ovoid_pose poses[2] = {{{0, 0, 0}, {0, 1, 0, 0}}, {{0, 0, 0}, {1, 0, 0, 0}}};
    // Half turns: each point has gone at most twice its distance. Travel: 2 sqrt 3 for each.
    for (int i = 0; i < 2000000; i++) CHECK(ovoid_world_move(w, ids[0], &poses[i & 1], NULL) == OVOID_OK);
    const double hidden = 0x1p-52 * 2000000 * 3.5;
    for (int i = 0; i < 400; i++) {
        ovoid_contact_query q = {.kind = i % 2 ? OVOID_QUERY_COLLIDE : OVOID_QUERY_WITHIN};
        q.margin = q.kind == OVOID_QUERY_WITHIN ? 0.5 : 0;
        check_seed = (uint64_t)i;
        double gap = q.margin + random_uniform(&s, 0, 2) * hidden;
        for (int step = 0; step < 6; step++) {
            double turn = random_uniform(&s, -1, 1) * hidden;
            ovoid_pose pose = {{2 + gap, 0, 0}, {1, 0, 0, 0.25 * turn}};
            CHECK(ovoid_world_move(w, ids[1], &pose, NULL) == OVOID_OK);
            ovoid_contacts f;
            CHECK(ovoid_world_compute_contacts(w, &q, &f, NULL) == OVOID_OK);
            world_validate_frame(w, &q, &f);
            gap -= random_uniform(&s, 0, 0.6) * hidden;
        }
    }
    ovoid_world_destroy(w);
    ovoid_compound_destroy(c);
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(ball);
}

// The same of reported bounds: a capsule beside that body, within the margin, turns by less than a rounding of the
// other's travel, and its end moves away by as much.
static void test_long_contact(void) {
    uint64_t s = 4;
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_shape *pill = ovoid_shape_create_capsule(0.5, 8, NULL, NULL);
    ovoid_world *w = ovoid_world_create(&(ovoid_world_options){.enlargement = 4}, NULL);
    ovoid_world_body b = {.body = {.shape = box, .pose = {{0, 0, 0}, {1, 0, 0, 0}}}};
    ovoid_world_body a = {.body = {.shape = pill, .pose = {{5, 0, 4.9}, {1, 0, 0, 0}}}};
    ovoid_id ids[2] = {ovoid_world_add(w, &b, NULL), ovoid_world_add(w, &a, NULL)};
    ovoid_pose poses[2] = {{{0, 0, 0}, {0, 1, 0, 0}}, {{0, 0, 0}, {1, 0, 0, 0}}};
    for (int i = 0; i < 2000000; i++) CHECK(ovoid_world_move(w, ids[0], &poses[i & 1], NULL) == OVOID_OK);
    ovoid_contact_query q = {.kind = OVOID_QUERY_WITHIN};
    size_t aged = 0;
    for (int i = 0; i < 300; i++) {
        check_seed = (uint64_t)i;
        // Nearly the margin apart, or touching a little.
        q.kind = i % 2 ? OVOID_QUERY_COLLIDE : OVOID_QUERY_WITHIN;
        q.margin = i % 2 ? 0 : 0.5;
        double x = 1.5 + q.margin - random_uniform(&s, 0.3, 4) * 1e-7;
        for (int step = 0; step < 6; step++) {
            double turn = step ? random_uniform(&s, -1.1e-10, 1.1e-10) : 0;
            ovoid_pose pose = {{x, 0, 4.9}, {1, 0, turn / 2, 0}};
            CHECK(ovoid_world_move(w, ids[1], &pose, NULL) == OVOID_OK);
            ovoid_contacts f;
            CHECK(ovoid_world_compute_contacts(w, &q, &f, NULL) == OVOID_OK);
            world_validate_frame(w, &q, &f);
            aged += f.aged;
        }
    }
    CHECK_LE(300, aged);
    ovoid_world_destroy(w);
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(pill);
}

// ---- casts that graze: a ray through a point of an edge of a box, a box pushed along another's face

static double whole(uint64_t *s, double most) { return floor(random_uniform(s, -most, most + 1)); }

static void test_rays(void) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_world *w = ovoid_world_create(&(ovoid_world_options){.enlargement = 1e-30}, NULL);
    ovoid_world_body b = {.body = {.shape = box, .pose = {{0, 0, 0}, {1, 0, 0, 0}}}};
    ovoid_id id = ovoid_world_add(w, &b, NULL);
    uint64_t s = 5;
    for (int i = 0; i < 4000; i++) {
        check_seed = (uint64_t)i;
        // The edge of x = 1 and y = -1: a line along (x, y, z) with x and y of one sign touches it and no more.
        double far = ldexp(1, 5 + i % 40), x = whole(&s, far), z = whole(&s, far);
        double y = floor(random_uniform(&s, 0.2, 5) * x);
        if (x == 0) continue;
        double edge_z = ldexp(whole(&s, 255), -8);
        ovoid_vec3 edge = {1, -1, edge_z}, way = {x, y, z};
        ovoid_ray ray = {{edge.x - x, edge.y - y, edge.z - z}, way, 3, i % 3 ? 0 : ldexp(1, -30)};
        ovoid_world_cast x_hit;
        CHECK(ovoid_world_cast_ray(w, &(ovoid_world_ray){.ray = ray}, &x_hit, NULL) == OVOID_OK);
        // It is met at time 1.
        CHECK(x_hit.body == id || x_hit.undecided > 0);
        CHECK_LE(x_hit.lower, 1);
        if (x_hit.body) CHECK_LE(x_hit.lower, x_hit.upper);
        // A box of half size 1/2 whose own edge takes the same way.
        if (far > 0x1p20) continue;
        ovoid_shape *small = ovoid_shape_create_box((ovoid_vec3){0.5, 0.5, 0.5}, NULL, NULL);
        ovoid_vec3 from = {ray.origin.x + 0.5, ray.origin.y - 0.5, ray.origin.z};
        ovoid_world_body probe = {.body = {.shape = small, .pose = {from, {1, 0, 0, 0}}}};
        CHECK(ovoid_world_cast_body(w, &(ovoid_world_sweep){probe, way}, &x_hit, NULL) == OVOID_OK);
        CHECK(x_hit.body == id || x_hit.undecided > 0);
        CHECK_LE(x_hit.lower, 1);
        ovoid_shape_destroy(small);
    }
    ovoid_world_destroy(w);
    ovoid_shape_destroy(box);
}

// Rays past an edge at a few roundings of their length. Truth: on which side of the edge the line passes, by pairs of
// doubles (linear/exact.h), whose own rounding is 2^-90 of the terms; what is nearer than that to the edge is left out.
static int is_met(const ovoid_ray *r, ovoid_vec3 edge) {
    dd right = dd_mul(two_sum(edge.x, -r->origin.x), dd_from(r->direction.y));
    dd below = dd_mul(two_sum(edge.y, -r->origin.y), dd_from(r->direction.x));
    return dd_sub(right, below).high > 0x1p-90 * right.high;
}

static void test_grazing_ray(const ovoid_shape *box, ovoid_vec3 half, double far, uint64_t *s, long *met) {
    ovoid_world *w = ovoid_world_create(&(ovoid_world_options){.enlargement = 1e-30}, NULL);
    ovoid_world_body b = {.body = {.shape = box, .pose = {{0, 0, 0}, {1, 0, 0, 0}}}};
    ovoid_id id = ovoid_world_add(w, &b, NULL);
    for (int i = 0; i < 16; i++) {
        double off = random_uniform(s, -2, 2) * 0x1p-53 * far;
        ovoid_vec3 way = {random_uniform(s, 0.2, 1), random_uniform(s, 0.2, 1), random_uniform(s, -1, 1)};
        ovoid_vec3 edge = {half.x, -half.y, random_uniform(s, -0.9, 0.9) * half.z};
        ovoid_vec3 from = {edge.x - far * way.x - off, edge.y - far * way.y, edge.z - far * way.z};
        ovoid_ray ray = {from, way, 2 * far, 0};
        ovoid_world_cast x;
        CHECK(ovoid_world_cast_ray(w, &(ovoid_world_ray){.ray = ray}, &x, NULL) == OVOID_OK);
        if (!is_met(&ray, edge)) continue;
        ++*met;
        CHECK(x.body == id || x.undecided > 0);
        CHECK_LE(x.lower, far * (1 + 1e-12) + 10);
    }
    ovoid_world_destroy(w);
}

static void test_grazing_rays(void) {
    uint64_t s = 6;
    long met = 0;
    for (int i = 0; i < 300; i++) {
        check_seed = (uint64_t)i;
        ovoid_vec3 half = {random_uniform(&s, 0.5, 1), random_uniform(&s, 0.5, 1), random_uniform(&s, 0.5, 1)};
        ovoid_shape *box = ovoid_shape_create_box(half, NULL, NULL);
        test_grazing_ray(box, half, ldexp(random_uniform(&s, 1, 2), 8 + i % 24), &s, &met);
        ovoid_shape_destroy(box);
    }
    CHECK_LE(1000, met);
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_world *w = ovoid_world_create(&(ovoid_world_options){.enlargement = 1e-30}, NULL);
    // Two bodies that are met one after the other, half a billionth of the way apart; the box of the farther one is
    // nearer.
    ovoid_shape *ball = ovoid_shape_create_sphere(1, NULL, NULL);
    double time = 50 - sqrt(0.75), sooner = time * (1 - 5e-10);
    ovoid_world_body c = {.body = {.shape = ball, .pose = {{50, 0.5, 0}, {1, 0, 0, 0}}}};
    ovoid_world_body d = {.body = {.shape = box, .pose = {{sooner + 1, 0, 0}, {1, 0, 0, 0}}}};
    CHECK(ovoid_world_add(w, &c, NULL) && ovoid_world_add(w, &d, NULL));
    ovoid_world_cast x;
    ovoid_ray ray = {{10, 0, 0}, {1, 0, 0}, 100, 0};
    CHECK(ovoid_world_cast_ray(w, &(ovoid_world_ray){.ray = ray}, &x, NULL) == OVOID_OK);
    CHECK_LE(x.lower, sooner - 10 + 1e-13);
    CHECK_LE(x.upper, sooner - 10 + 1e-10);
    ovoid_world_destroy(w);
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(ball);
}

int main(void) {
    for (uint64_t seed = 1; seed <= 1200; seed++) test_far(seed);
    test_long_life(0);
    test_long_life(1);
    test_long_contact();
    test_rays();
    test_grazing_rays();
    return check_end();
}
