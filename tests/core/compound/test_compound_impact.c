// Compounds that move. Truth: every pair of parts by ovoid_impact_find, with its own proof; distances of the compounds
// at sampled times; boxes hold the parts' boxes. The deciding pair's steps are checked,
// and the groups of steps of all pairs; what is altered is refused.
#include "moving.h"

enum { PARTS = 12, CAPACITY = 20000 };
static ovoid_step steps[CAPACITY];
static size_t most_groups;

typedef struct machine {
    ovoid_shape *shapes[3];
    ovoid_compound *compound;
    ovoid_moving_body body;
} machine;

static void make(machine *m, uint64_t *s, uint32_t count) {
    ovoid_posed_shape parts[PARTS];
    for (int i = 0; i < 3; i++)
        m->shapes[i] = bits_make_shape(i == 0 ? BITS_BALL : i == 1 ? BITS_NEEDLE : BITS_PLAIN, s);
    for (uint32_t i = 0; i < count; i++) {
        parts[i].shape = m->shapes[random_next(s) % 3];
        parts[i].pose = moving_make_pose(s, 3);
    }
    m->compound = ovoid_compound_create(parts, count, NULL, NULL);
    m->body = (ovoid_moving_body){.compound = m->compound};
}

static void destroy(machine *m) {
    ovoid_compound_destroy(m->compound);
    for (int i = 0; i < 3; i++) ovoid_shape_destroy(m->shapes[i]);
}

static ovoid_motion make_motion(uint64_t *s, double far) {
    const double spins[4] = {0, 1, 6, 200};
    ovoid_pose start = moving_make_pose(s, far), end = moving_make_pose(s, far);
    if (random_next(s) % 3 == 0) return ovoid_motion_make_poses(start, end, 1);
    ovoid_vec3 linear = bits_vec3(s, 12);
    double spin = spins[random_next(s) % 4];
    return ovoid_motion_make_velocity(start, linear, bits_vec3(s, spin), 1);
}

// The first hit of all pairs of parts, and until when all are free.
static ovoid_impact find_all(const ovoid_moving_body *a, const ovoid_moving_body *b, double margin) {
    ovoid_impact best = {.status = OVOID_IMPACT_FREE, .hit_at = INFINITY, .free_until = INFINITY};
    size_t count_a = a->compound ? ovoid_compound_get_part_count(a->compound) : 1;
    size_t count_b = b->compound ? ovoid_compound_get_part_count(b->compound) : 1;
    for (size_t i = 0; i < count_a; i++)
        for (size_t j = 0; j < count_b; j++) {
            ovoid_moving_shape x = ovoid_moving_body_get_part(a, i), y = ovoid_moving_body_get_part(b, j);
            ovoid_impact one = ovoid_impact_find(&(ovoid_moving_pair){x, y, margin}, NULL);
            best.free_until = fmin(best.free_until, one.free_until);
            best.hit_at = fmin(best.hit_at, one.hit_at);
            if (one.status == OVOID_IMPACT_HIT) best.status = OVOID_IMPACT_HIT;
            if (one.status == OVOID_IMPACT_UNDECIDED && best.status == OVOID_IMPACT_FREE) best.status = one.status;
        }
    return best;
}

static void check_samples(const ovoid_moving_body *a, const ovoid_moving_body *b, double margin, const ovoid_impact *x,
                          uint64_t *s) {
    for (int i = 0; i < 20; i++) {
        double t = x->begin + (x->free_until - x->begin) * random_uniform(s, 0, 1);
        ovoid_body_pair pair = {
            {.shape = a->shape, .compound = a->compound, .pose = ovoid_motion_compute_pose(&a->motion, t)},
            {.shape = b->shape, .compound = b->compound, .pose = ovoid_motion_compute_pose(&b->motion, t)}};
        if (t < x->free_until) CHECK_LE(margin - 1e-10, ovoid_body_distance(&pair, NULL, NULL).upper);
    }
}

static void check_pair(const ovoid_moving_body *a, const ovoid_moving_body *b, double margin, uint64_t *s) {
    ovoid_motion_options o = {.steps = steps, .capacity = CAPACITY};
    ovoid_body_impact found = ovoid_body_impact_find(&(ovoid_moving_body_pair){*a, *b, margin}, &o);
    const ovoid_impact *x = &found.impact;
    ovoid_impact all = find_all(a, b, margin);
    CHECK_EQ(x->status, all.status);
    CHECK_NEAR(fmin(x->hit_at, 2), fmin(all.hit_at, 2), 2e-9);
    CHECK_NEAR(x->free_until, all.free_until, 2e-9);
    CHECK(x->begin == 0 && x->end == 1);
    check_samples(a, b, margin, x, s);
    if (x->status != OVOID_IMPACT_HIT) return;
    ovoid_moving_shape part_a = ovoid_moving_body_get_part(a, found.part_a);
    ovoid_moving_shape part_b = ovoid_moving_body_get_part(b, found.part_b);
    ovoid_error error;
    if (!CHECK_EQ(ovoid_impact_verify(&(ovoid_moving_pair){part_a, part_b, margin}, x,
                                      &(ovoid_motion_basis){.steps = steps}, &error),
                  OVOID_OK))
        printf("  %s\n", error.message);
}

// The proof of all pairs, and that what is altered is refused.
static void check_proof(const ovoid_moving_body *a, const ovoid_moving_body *b, double margin) {
    static ovoid_step_group groups[CAPACITY];
    ovoid_motion_options o = {.steps = steps, .capacity = CAPACITY, .groups = groups, .group_capacity = CAPACITY};
    ovoid_error error;
    ovoid_body_impact x = ovoid_body_impact_find(&(ovoid_moving_body_pair){*a, *b, margin}, &o);
    ovoid_body_impact y = ovoid_body_impact_find(&(ovoid_moving_body_pair){*a, *b, margin}, NULL);
    CHECK_EQ(x.impact.status, y.impact.status);
    CHECK_NEAR(fmin(x.impact.hit_at, 2), fmin(y.impact.hit_at, 2), 2e-9);
    CHECK(x.impact.step_count <= CAPACITY && x.group_count <= CAPACITY);
    if (!CHECK_EQ(ovoid_body_impact_verify(&(ovoid_moving_body_pair){*a, *b, margin}, &x,
                                           &(ovoid_motion_basis){.steps = steps, .groups = groups}, &error),
                  OVOID_OK))
        printf("  group %lld: %s\n", (long long)error.place, error.message);
    most_groups = x.group_count > most_groups ? x.group_count : most_groups;
    if (x.impact.free_until <= x.impact.begin) return;
    y = x;
    y.group_count--;
    CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){*a, *b, margin}, &y,
                                   &(ovoid_motion_basis){.steps = steps, .groups = groups}, NULL) != OVOID_OK);
    y = x;
    y.impact.status = x.impact.status == OVOID_IMPACT_FREE ? OVOID_IMPACT_HIT : OVOID_IMPACT_FREE;
    CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){*a, *b, margin}, &y,
                                   &(ovoid_motion_basis){.steps = steps, .groups = groups}, NULL) != OVOID_OK);
    y = x;
    y.impact.free_until += 1e-3;
    CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){*a, *b, margin}, &y,
                                   &(ovoid_motion_basis){.steps = steps, .groups = groups}, NULL) != OVOID_OK);
    ovoid_step_group kept = groups[0];
    groups[0].end_a++;
    CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){*a, *b, margin}, &x,
                                   &(ovoid_motion_basis){.steps = steps, .groups = groups}, NULL) != OVOID_OK);
    groups[0] = kept;
    groups[0].count++;
    CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){*a, *b, margin}, &x,
                                   &(ovoid_motion_basis){.steps = steps, .groups = groups}, NULL) != OVOID_OK);
    groups[0] = kept;
    if (x.group_count > 1) {
        groups[0] = groups[1];
        CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){*a, *b, margin}, &x,
                                       &(ovoid_motion_basis){.steps = steps, .groups = groups}, NULL) != OVOID_OK);
        groups[0] = kept;
    }
    ovoid_step first = steps[0];
    steps[0].normal = (ovoid_vec3){-first.normal.x, -first.normal.y, -first.normal.z};
    CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){*a, *b, margin}, &x,
                                   &(ovoid_motion_basis){.steps = steps, .groups = groups}, NULL) != OVOID_OK);
    steps[0] = first;
}

static void check_box(const ovoid_moving_body *m, double begin, double end) {
    ovoid_box box = ovoid_moving_body_compute_box(m, begin, end);
    size_t count = m->compound ? ovoid_compound_get_part_count(m->compound) : 1;
    for (size_t i = 0; i < count; i++) {
        ovoid_moving_shape part = ovoid_moving_body_get_part(m, i);
        ovoid_polytope p = ovoid_shape_get_polytope(part.shape);
        double r = ovoid_shape_get_radius(part.shape);
        for (int k = 0; k <= 20; k++) {
            ovoid_pose pose = ovoid_moving_shape_compute_pose(&part, begin + (end - begin) * k / 20);
            for (uint32_t v = 0; v < p.vertex_count; v++) {
                ovoid_vec3 local = {p.origin.x + p.vertices[3 * v], p.origin.y + p.vertices[3 * v + 1],
                                    p.origin.z + p.vertices[3 * v + 2]};
                ovoid_vec3 x = ovoid_pose_compute_point(&pose, local);
                CHECK(x.x - r >= box.min.x - 1e-12 && x.y - r >= box.min.y - 1e-12 && x.z - r >= box.min.z - 1e-12);
                CHECK(x.x + r <= box.max.x + 1e-12 && x.y + r <= box.max.y + 1e-12 && x.z + r <= box.max.z + 1e-12);
            }
        }
    }
}

static void check_refusals(const ovoid_moving_body *a) {
    ovoid_moving_body bad = *a;
    bad.motion.duration = -1;
    bad.motion.kind = OVOID_MOTION_POSES;
    CHECK_EQ(ovoid_body_impact_find(&(ovoid_moving_body_pair){*a, bad, 0}, NULL).impact.limit, OVOID_LIMIT_POSE_B);
    CHECK_EQ(ovoid_body_impact_find(&(ovoid_moving_body_pair){bad, *a, 0}, NULL).impact.limit, OVOID_LIMIT_POSE_A);
    CHECK_EQ(ovoid_body_impact_find(&(ovoid_moving_body_pair){*a, *a, -1}, NULL).impact.limit, OVOID_LIMIT_OPTIONS);
    CHECK(isnan(ovoid_moving_body_compute_box(&bad, 0, 1).min.x));
}

int main(void) {
    long hits = 0, tested = 0, pairs = 0;
    for (uint64_t seed = 1; seed <= 120; seed++) {
        uint64_t s = check_seed = seed;
        machine a, b;
        make(&a, &s, 1 + (uint32_t)(seed % PARTS));
        make(&b, &s, PARTS);
        a.body.motion = make_motion(&s, 4);
        b.body.motion = make_motion(&s, seed % 2 ? 5 : 12);
        // A shape, too.
        if (seed % 5 == 0) a.body = (ovoid_moving_body){.shape = a.shapes[2], .motion = a.body.motion};
        check_pair(&a.body, &b.body, seed % 3 ? 0 : 0.3, &s);
        check_proof(&a.body, &b.body, seed % 3 ? 0 : 0.3);
        ovoid_body_impact x = ovoid_body_impact_find(&(ovoid_moving_body_pair){a.body, b.body, 0}, NULL);
        hits += x.impact.status == OVOID_IMPACT_HIT;
        tested += x.tested;
        pairs += (a.body.shape ? 1 : 1 + (long)(seed % PARTS)) * PARTS;
        check_box(&a.body, 0, 0.5);
        check_box(&b.body, 0.25, 1);
        if (seed == 1) check_refusals(&a.body);
        destroy(&a);
        destroy(&b);
    }
    check_seed = 0;
    printf("%ld of 120 hit; %ld of %ld pairs of parts were looked at; proofs of at most %zu groups\n", hits, tested,
           pairs, most_groups);
    return check_end();
}
