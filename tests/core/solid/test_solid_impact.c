// Solids that move. Truth: distances at sampled times, from ovoid_body_distance, which other tests hold against brute
// force: never within the margin before free_until, and within it at hit_at; every pair of triangles by
// ovoid_impact_find for small solids; closed forms of a peg that falls through a ring and a ball inside a hollow.
// Proofs are checked, and what is altered is refused.
#include "solids.h"

enum { CAPACITY = 400000, GROUPS = 60000 };
static ovoid_step steps[CAPACITY];
static ovoid_step_group groups[GROUPS];

static ovoid_motion make_motion(uint64_t *s, double far) {
    ovoid_pose start = {random_vec3(s, far), random_quat(s)}, end = {random_vec3(s, far), random_quat(s)};
    if (random_next(s) % 2) return ovoid_motion_make_poses(start, end, 1);
    return ovoid_motion_make_velocity(start, random_vec3(s, 6), random_vec3(s, random_next(s) % 3 ? 2 : 0), 1);
}

static ovoid_body_answer ask(const ovoid_moving_body *a, const ovoid_moving_body *b, double time) {
    ovoid_body_pair pair = {{a->shape, a->compound, ovoid_motion_compute_pose(&a->motion, time), a->solid},
                            {b->shape, b->compound, ovoid_motion_compute_pose(&b->motion, time), b->solid}};
    return ovoid_body_distance(&pair, NULL, NULL);
}

static int is_proven(const ovoid_moving_body *a, const ovoid_moving_body *b, double margin,
                     const ovoid_body_impact *x) {
    ovoid_error error = {.message = ""};
    ovoid_code code = ovoid_body_impact_verify(&(ovoid_moving_body_pair){*a, *b, margin}, x,
                                               &(ovoid_motion_basis){.steps = steps, .groups = groups}, &error);
    if (code != OVOID_OK) printf("  %lld: %s\n", (long long)error.place, error.message);
    return code == OVOID_OK;
}

static void check_samples(const ovoid_moving_body *a, const ovoid_moving_body *b, double margin, const ovoid_impact *x,
                          uint64_t *s) {
    for (int i = 0; i < 12; i++) {
        double t = x->free_until * (i ? random_uniform(s, 0, 1) : 1 - 1e-9);
        ovoid_body_answer at = ask(a, b, t);
        if (x->free_until > 0) CHECK(at.upper >= margin - 1e-9 && at.status != OVOID_OVERLAPPING);
    }
    if (x->status == OVOID_IMPACT_HIT) CHECK_LE(ask(a, b, x->hit_at).lower, margin + 1e-12);
}

static void check_altered(const ovoid_moving_body *a, const ovoid_moving_body *b, double margin,
                          const ovoid_body_impact *x) {
    ovoid_body_impact y = *x;
    if (!(x->impact.free_until > x->impact.begin)) return;
    y.group_count--;
    CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){*a, *b, margin}, &y,
                                   &(ovoid_motion_basis){.steps = steps, .groups = groups}, NULL) != OVOID_OK);
    y = *x;
    y.impact.free_until = fmin(y.impact.free_until + 1e-3, y.impact.hit_at);
    if (y.impact.free_until > x->impact.free_until + 1e-4 && y.impact.status != OVOID_IMPACT_FREE)
        CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){*a, *b, margin}, &y,
                                       &(ovoid_motion_basis){.steps = steps, .groups = groups}, NULL) != OVOID_OK);
    y = *x;
    y.impact.status = x->impact.status == OVOID_IMPACT_FREE ? OVOID_IMPACT_HIT : OVOID_IMPACT_FREE;
    CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){*a, *b, margin}, &y,
                                   &(ovoid_motion_basis){.steps = steps, .groups = groups}, NULL) != OVOID_OK);
    ovoid_step_group kept = groups[0];
    groups[0].end_a++;
    CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){*a, *b, margin}, x,
                                   &(ovoid_motion_basis){.steps = steps, .groups = groups}, NULL) != OVOID_OK);
    groups[0] = kept;
    ovoid_step first = steps[0];
    steps[0].normal = (ovoid_vec3){-first.normal.x, -first.normal.y, -first.normal.z};
    CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){*a, *b, margin}, x,
                                   &(ovoid_motion_basis){.steps = steps, .groups = groups}, NULL) != OVOID_OK);
    steps[0] = first;
}

// The first hit of all pairs of triangles of two solids that are apart at the beginning.
static ovoid_impact find_all(const mesh *a, const ovoid_motion *motion_a, const mesh *b, const ovoid_motion *motion_b,
                             double margin) {
    ovoid_impact best = {.status = OVOID_IMPACT_FREE, .hit_at = INFINITY, .free_until = INFINITY};
    ovoid_shape **all[2];
    const mesh *meshes[2] = {a, b};
    for (int k = 0; k < 2; k++) {
        all[k] = malloc(meshes[k]->triangles * sizeof **all);
        for (size_t i = 0; i < meshes[k]->triangles; i++) {
            double xyz[9];
            for (int c = 0; c < 9; c++) xyz[c] = meshes[k]->xyz[3 * meshes[k]->indices[3 * i + (size_t)c / 3] + c % 3];
            all[k][i] = ovoid_shape_create_from_points(xyz, 3, NULL, NULL);
        }
    }
    for (size_t i = 0; i < a->triangles; i++)
        for (size_t j = 0; j < b->triangles; j++) {
            ovoid_moving_shape x = {.shape = all[0][i], .motion = *motion_a},
                               y = {.shape = all[1][j], .motion = *motion_b};
            ovoid_impact one = ovoid_impact_find(&(ovoid_moving_pair){x, y, margin}, NULL);
            best.free_until = fmin(best.free_until, one.free_until);
            best.hit_at = fmin(best.hit_at, one.hit_at);
            if (one.status == OVOID_IMPACT_HIT) best.status = OVOID_IMPACT_HIT;
        }
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < meshes[k]->triangles; i++) ovoid_shape_destroy(all[k][i]);
        free(all[k]);
    }
    return best;
}

static ovoid_body_impact check_pair(const ovoid_moving_body *a, const ovoid_moving_body *b, double margin,
                                    uint64_t *s) {
    const ovoid_motion_options o = {.steps = steps, .capacity = CAPACITY, .groups = groups, .group_capacity = GROUPS};
    ovoid_body_impact x = ovoid_body_impact_find(&(ovoid_moving_body_pair){*a, *b, margin}, &o),
                      y = ovoid_body_impact_find(&(ovoid_moving_body_pair){*a, *b, margin}, NULL);
    CHECK_EQ(x.impact.status, y.impact.status);
    CHECK_NEAR(fmin(x.impact.hit_at, 2), fmin(y.impact.hit_at, 2), 1e-8);
    CHECK(x.impact.step_count <= CAPACITY && x.group_count <= GROUPS);
    CHECK(is_proven(a, b, margin, &x));
    check_samples(a, b, margin, &x.impact, s);
    check_altered(a, b, margin, &x);
    return x;
}

static void check_random(int rounds) {
    int hits = 0, begun = 0;
    long tested = 0;
    for (int i = 0; i < rounds; i++) {
        uint64_t s = check_seed = 100 + (uint64_t)i;
        mesh a = {NULL, NULL, 0, 0, 0, 0}, b = a;
        mesh_add_angle(&a, 1.5, 0.4, 0.3);
        if (i % 2)
            mesh_add_ring(&b, 1, 0.3, 6, 4, 0.2, &s);
        else
            mesh_add_star(&b, (ovoid_vec3){0, 0, 0}, 1, 3, 5, 0.6, &s);
        ovoid_solid *sa = mesh_make_solid(&a), *sb = mesh_make_solid(&b);
        ovoid_moving_body x = {.solid = sa, .motion = make_motion(&s, 3)},
                          y = {.solid = sb, .motion = make_motion(&s, 3)};
        double margin = i % 3 ? 0 : 0.2;
        ovoid_body_impact found = check_pair(&x, &y, margin, &s);
        hits += found.impact.status == OVOID_IMPACT_HIT;
        begun += found.impact.hit_at <= 0;
        tested += found.tested;
        if (found.impact.hit_at > 0) {
            ovoid_impact all = find_all(&a, &x.motion, &b, &y.motion, margin);
            CHECK_EQ(found.impact.status, all.status);
            CHECK_NEAR(fmin(found.impact.hit_at, 2), fmin(all.hit_at, 2), 1e-8);
            CHECK_NEAR(fmin(found.impact.free_until, 1), fmin(all.free_until, 1), 1e-8);
        }
        ovoid_solid_destroy(sa);
        ovoid_solid_destroy(sb);
        mesh_clear(&a);
        mesh_clear(&b);
    }
    check_seed = 0;
    printf("%d of %d hit, %d at the beginning; %ld pairs of triangles looked at\n", hits, rounds, begun, tested);
    CHECK(hits > begun && begun > 0 && hits < rounds);
}

// Triangles that have nothing to do with one another, some of them far from the others, so that the query of the bodies
// leaves open what is within 1e-9 of their size: margins around the distance at the beginning. What is found there is
// held by the check.
static void fill_triangles(double v[36 * 3], uint32_t t[36], double far, uint64_t *s) {
    for (uint32_t i = 0; i < 36; i++) {
        for (int c = 0; c < 3; c++) v[3 * i + (uint32_t)c] = random_uniform(s, -1, 1) + (i >= 18 && c == 0 ? far : 0);
        t[i] = i;
    }
}

static void check_begin(int rounds) {
    const ovoid_motion_options o = {.steps = steps, .capacity = CAPACITY, .groups = groups, .group_capacity = GROUPS};
    const ovoid_options exact = {.relative_tolerance = 1e-15};
    int hits = 0;
    for (int i = 0; i < rounds; i++) {
        uint64_t s = check_seed = 900 + (uint64_t)i;
        double v[36 * 3], far = pow(10, 1 + i % 6);
        uint32_t t[36];
        fill_triangles(v, t, far, &s);
        ovoid_solid *a = ovoid_solid_create_from_triangles(&(ovoid_triangles){v, 36, t, 12}, NULL, NULL);
        fill_triangles(v, t, 0, &s);
        ovoid_solid *b = ovoid_solid_create_from_triangles(&(ovoid_triangles){v, 36, t, 12}, NULL, NULL);
        ovoid_pose here = ovoid_pose_make_identity(), there = {{0, 4, 0}, random_quat(&s)};
        ovoid_body_pair pair = {{.solid = a, .pose = here}, {.solid = b, .pose = there}};
        double d = ovoid_body_distance(&pair, &exact, NULL).upper;
        const ovoid_vec3 none = {0, 0, 0}, up = {0, 1, 0};
        ovoid_moving_body x = {.solid = a, .motion = ovoid_motion_make_velocity(here, up, none, 1)},
                          y = {.solid = b, .motion = ovoid_motion_make_velocity(there, none, none, 1)};
        for (int k = 0; k < 8; k++) {
            double margin = d + k * 2e-10 * far;
            ovoid_body_impact found = ovoid_body_impact_find(&(ovoid_moving_body_pair){x, y, margin}, &o);
            CHECK(is_proven(&x, &y, margin, &found));
            hits += found.impact.hit_at <= 0;
        }
        ovoid_solid_destroy(a);
        ovoid_solid_destroy(b);
    }
    check_seed = 0;
    CHECK(hits > rounds);
}

// A box of half size 0.5 inside a hollow sphere is apart from its shell; in the full one it is inside, at any time. A
// ring falls over a peg without touching it; to the side it hits the peg's top.
static void check_known(void) {
    uint64_t s = 1;
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    mesh_add_star(&m, (ovoid_vec3){0, 0, 0}, 3, 8, 12, 0, &s);
    ovoid_solid *full = mesh_make_solid(&m);
    mesh_clear(&m);
    mesh_add_ring(&m, 1, 0.25, 24, 12, 0, &s);
    ovoid_solid *ring = mesh_make_solid(&m);
    mesh_clear(&m);
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){0.5, 0.5, 0.5}, NULL, NULL);
    ovoid_shape *peg = ovoid_shape_create_box((ovoid_vec3){0.2, 0.2, 2}, NULL, NULL);
    const ovoid_pose here = ovoid_pose_make_identity();
    ovoid_moving_body a = {.solid = full, .motion = ovoid_motion_make_still(here)};
    ovoid_moving_body b = {.shape = box,
                           .motion = ovoid_motion_make_poses(here, (ovoid_pose){{0, 0, 0.5}, {1, 0, 0, 0}}, 1)};
    ovoid_body_impact x = check_pair(&a, &b, 0, &s);
    CHECK_EQ(x.impact.status, OVOID_IMPACT_HIT);
    CHECK_EQ(x.impact.hit_at, 0);
    CHECK(x.impact.hit.upper < 0);
    // No surface is met on the way, but it is not free: what is inside at the beginning is asked before any step.
    x.impact.status = OVOID_IMPACT_FREE, x.impact.free_until = x.impact.end, x.impact.hit_at = INFINITY;
    ovoid_error error = {.message = ""};
    CHECK_EQ(ovoid_body_impact_verify(&(ovoid_moving_body_pair){a, b, 0}, &x,
                                      &(ovoid_motion_basis){.steps = steps, .groups = groups}, &error),
             OVOID_ERROR_PROOF);
    CHECK(strstr(error.message, "not apart at the beginning") != NULL);
    // The ring, from z = 5 down to -1, around the peg whose top is at 2.
    const ovoid_pose above = {{0, 0, 5}, {1, 0, 0, 0}}, below = {{0, 0, -1}, {1, 0, 0, 0}};
    ovoid_moving_body r = {.solid = ring, .motion = ovoid_motion_make_poses(above, below, 1)};
    ovoid_moving_body p = {.shape = peg, .motion = ovoid_motion_make_still(here)};
    CHECK_EQ(check_pair(&r, &p, 0, &s).impact.status, OVOID_IMPACT_FREE);
    CHECK_EQ(check_pair(&p, &r, 0.3, &s).impact.status, OVOID_IMPACT_FREE);
    // Moved by one in x its tube of 0.25 comes down on the top: at z = 2.25, after 2.75 of 6.
    r.motion.start.position.x = r.motion.end.position.x = 1;
    x = check_pair(&r, &p, 0, &s);
    CHECK_EQ(x.impact.status, OVOID_IMPACT_HIT);
    CHECK_NEAR(x.impact.free_until, 2.75 / 6, 1e-6);
    CHECK_NEAR(x.impact.hit_at, 2.75 / 6, 1e-6);
    // Boxes that hold the bodies at their ends.
    ovoid_box swept = ovoid_moving_body_compute_box(&r, 0, 1);
    CHECK(swept.max.z >= 5.25 && swept.min.z <= -1.25 && swept.max.x >= 2.25 && swept.min.x <= -0.25);
    ovoid_solid_destroy(full);
    ovoid_solid_destroy(ring);
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(peg);
}

static void check_refusals(void) {
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    mesh_add_angle(&m, 1, 0.3, 0.2);
    ovoid_solid *solid = mesh_make_solid(&m);
    const ovoid_moving_body good = {.solid = solid, .motion = ovoid_motion_make_still(ovoid_pose_make_identity())};
    ovoid_moving_body bad = good, none = {.motion = good.motion};
    bad.motion.kind = OVOID_MOTION_POSES;
    bad.motion.duration = -1;
    CHECK_EQ(ovoid_body_impact_find(&(ovoid_moving_body_pair){good, bad, 0}, NULL).impact.limit, OVOID_LIMIT_POSE_B);
    CHECK_EQ(ovoid_body_impact_find(&(ovoid_moving_body_pair){bad, good, 0}, NULL).impact.limit, OVOID_LIMIT_POSE_A);
    CHECK_EQ(ovoid_body_impact_find(&(ovoid_moving_body_pair){good, good, -1}, NULL).impact.limit, OVOID_LIMIT_OPTIONS);
    CHECK_EQ(ovoid_body_impact_find(&(ovoid_moving_body_pair){none, good, 0}, NULL).impact.limit, OVOID_LIMIT_SHAPE_A);
    CHECK_EQ(ovoid_body_impact_find(&(ovoid_moving_body_pair){good, none, 0}, NULL).impact.limit, OVOID_LIMIT_SHAPE_B);
    // A body of two kinds.
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    const ovoid_moving_body both = {.shape = box, .motion = good.motion, .solid = solid};
    CHECK_EQ(ovoid_body_impact_find(&(ovoid_moving_body_pair){both, good, 0}, NULL).impact.limit, OVOID_LIMIT_SHAPE_A);
    CHECK_EQ(ovoid_body_impact_find(&(ovoid_moving_body_pair){good, both, 0}, NULL).impact.limit, OVOID_LIMIT_SHAPE_B);
    ovoid_shape_destroy(box);
    CHECK(isnan(ovoid_moving_body_compute_box(&bad, 0, 1).min.x));
    // The same solid at the same place all the time: within the margin from the beginning.
    ovoid_body_impact x = ovoid_body_impact_find(&(ovoid_moving_body_pair){good, good, 0.1}, NULL);
    CHECK_EQ(x.impact.hit_at, 0);
    CHECK(is_proven(&good, &good, 0.1, &x));
    ovoid_solid_destroy(solid);
    mesh_clear(&m);
}

int main(void) {
    check_begin(60);
    check_random(16);
    check_known();
    check_refusals();
    return check_end();
}
