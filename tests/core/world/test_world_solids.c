// Worlds with solids among shapes and compounds. Truth: the cold query of every pair alone (ovoid_solid_*, which other
// tests hold against brute force), by loops over all bodies; and that what ages has points in common with the truth.
#include "solids.h"

enum { SOLIDS = 4, BODIES = 18 };

typedef struct stage {
    uint64_t s;
    mesh meshes[SOLIDS];
    ovoid_solid *solids[SOLIDS];
    ovoid_shape *shapes[2];
    ovoid_compound *compound;
    ovoid_world *w;
    ovoid_id ids[BODIES];
    ovoid_pose poses[BODIES];
    size_t aged, rays, casts;
} stage;

static ovoid_body make_body(stage *x, int k, ovoid_pose pose) {
    ovoid_body b = {.pose = pose};
    if (k % 4 == 1)
        b.shape = x->shapes[k % 8 / 4];
    else if (k % 9 == 8)
        b.compound = x->compound;
    else
        b.solid = x->solids[k % SOLIDS];
    return b;
}

static void begin(stage *x, uint64_t seed, double spread) {
    *x = (stage){.s = seed};
    mesh_add_ring(&x->meshes[0], 1, 0.25, 9, 6, 0.1, &x->s);
    mesh_add_star(&x->meshes[1], (ovoid_vec3){0.3, 0, 0}, 1, 5, 7, 0.5, &x->s);
    mesh_add_angle(&x->meshes[2], 1.4, 0.3, 0.4);
    // A hollow that others can be in: its inside is outside of it.
    mesh_add_star(&x->meshes[3], (ovoid_vec3){0, 0, 0}, 2.5, 6, 8, 0, &x->s);
    mesh_add_star(&x->meshes[3], (ovoid_vec3){0, 0, 0}, 2.2, 6, 8, 0, &x->s);
    for (size_t t = x->meshes[3].triangles / 2; t < x->meshes[3].triangles; t++) {
        uint32_t *i = x->meshes[3].indices + 3 * t, kept = i[0];
        i[0] = i[1], i[1] = kept;
    }
    for (int k = 0; k < SOLIDS; k++) x->solids[k] = mesh_make_solid(&x->meshes[k]);
    x->shapes[0] = ovoid_shape_create_box((ovoid_vec3){0.2, 0.15, 0.1}, NULL, NULL);
    x->shapes[1] = ovoid_shape_create_capsule(0.1, 0.4, NULL, NULL);
    const ovoid_posed_shape parts[2] = {{x->shapes[0], {{0.3, 0, 0}, {1, 0, 0, 0}}},
                                        {x->shapes[1], {{-0.3, 0, 0}, {1, 1, 0, 0}}}};
    x->compound = ovoid_compound_create(parts, 2, NULL, NULL);
    x->w = ovoid_world_create(&(ovoid_world_options){.threads = 2}, NULL);
    for (int k = 0; k < BODIES; k++) {
        x->poses[k] = (ovoid_pose){random_vec3(&x->s, spread), random_quat(&x->s)};
        ovoid_world_body b = {.body = make_body(x, k, x->poses[k])};
        x->ids[k] = ovoid_world_add(x->w, &b, NULL);
        CHECK(x->ids[k] != 0);
    }
}

static void end(stage *x) {
    ovoid_world_destroy(x->w);
    ovoid_compound_destroy(x->compound);
    for (int k = 0; k < 2; k++) ovoid_shape_destroy(x->shapes[k]);
    for (int k = 0; k < SOLIDS; k++) ovoid_solid_destroy(x->solids[k]);
    for (int k = 0; k < SOLIDS; k++) mesh_clear(&x->meshes[k]);
}

static ovoid_body_answer ask(const ovoid_body *a, const ovoid_body *b, const ovoid_contact_query *q) {
    const ovoid_body_pair pair = {*a, *b};
    const ovoid_options o = {.cap = q->margin > 0 ? q->margin : 1e-300};
    if (q->kind == OVOID_QUERY_COLLIDE) return ovoid_body_collide(&pair, NULL, NULL);
    if (q->kind == OVOID_QUERY_WITHIN) return ovoid_body_within(&pair, q->margin, NULL, NULL);
    return ovoid_body_distance(&pair, &o, NULL);
}

static void check_contact(stage *x, const ovoid_contact *c, const ovoid_body *a, const ovoid_body *b,
                          const ovoid_contact_query *q) {
    const ovoid_body_pair pair = {*a, *b};
    ovoid_body_answer alone = ask(a, b, q), truth = ovoid_body_distance(&pair, NULL, NULL);
    CHECK_EQ(c->verdict.status, alone.status);
    CHECK_LE(c->verdict.lower, c->verdict.upper);
    CHECK_LE(c->verdict.lower, truth.upper);
    // Of an overlap both ends are bounds of different things that nobody knows exactly.
    CHECK_LE(truth.lower, c->verdict.upper);
    CHECK(c->verdict.status != OVOID_SEPARATED || c->verdict.lower > 0);
    CHECK(c->verdict.status != OVOID_OVERLAPPING || c->verdict.upper < 0);
    if (q->kind >= OVOID_QUERY_DISTANCE && alone.status == OVOID_SEPARATED)
        CHECK_NEAR(c->verdict.lower, truth.lower, 1e-7);
    ovoid_error error = {.message = ""};
    static ovoid_exclusion items[4096];
    ovoid_exclusions exclusions = {.items = items, .capacity = 4096};
    ovoid_contact_proof proof = {.exclusions = &exclusions};
    CHECK_EQ(ovoid_world_compute_proof(x->w, c, &proof, &error), OVOID_OK);
    CHECK_EQ(ovoid_body_verify(&pair, &proof.answer,
                               &(ovoid_body_basis){.options = q->options, .exclusions = &exclusions}, &error),
             OVOID_OK);
}

static void check_frame(stage *x, const ovoid_contact_query *q) {
    ovoid_contacts f;
    CHECK_EQ(ovoid_world_compute_contacts(x->w, q, &f, NULL), OVOID_OK);
    x->aged += f.aged;
    size_t at = 0;
    for (int i = 0; i < BODIES; i++)
        for (int j = i + 1; j < BODIES; j++) {
            ovoid_body a = make_body(x, i, x->poses[i]), b = make_body(x, j, x->poses[j]);
            const ovoid_contact *c = at < f.count ? &f.items[at] : NULL;
            int is_in = c && c->a == x->ids[i] && c->b == x->ids[j];
            at += (size_t)is_in;
            if (is_in)
                check_contact(x, c, &a, &b, q);
            else
                CHECK_LE(q->margin, ask(&a, &b, q).lower);
        }
    CHECK_EQ(at, f.count);
}

static void move_all(stage *x, double step) {
    for (int k = 0; k < BODIES; k++) {
        // Some rest, some go far.
        double way = random_next(&x->s) % 3 ? step * random_uniform(&x->s, 0, 1) : 0;
        ovoid_vec3 d = random_vec3(&x->s, way);
        ovoid_pose *p = &x->poses[k];
        p->position.x += d.x, p->position.y += d.y, p->position.z += d.z;
        p->rotation.w += random_uniform(&x->s, -way, way), p->rotation.z += random_uniform(&x->s, -way, way);
    }
    CHECK_EQ(ovoid_world_move_many(x->w, &(ovoid_world_moves){x->ids, x->poses, BODIES}, NULL), OVOID_OK);
}

// Between frames: each question against a loop over all.
static void check_between(stage *x) {
    ovoid_error error;
    ovoid_world_hit hit;
    double nearest = INFINITY;
    int touching = 0;
    size_t overlaps = 0;
    ovoid_world_body probe = {.body = make_body(x, (int)(random_next(&x->s) % 3) * 2,
                                                (ovoid_pose){random_vec3(&x->s, 3), random_quat(&x->s)})};
    const ovoid_contact_query collide = {.kind = OVOID_QUERY_COLLIDE},
                              far = {.kind = OVOID_QUERY_DISTANCE, .margin = 99};
    for (int k = 0; k < BODIES; k++) {
        ovoid_body b = make_body(x, k, x->poses[k]);
        nearest = fmin(nearest, ask(&probe.body, &b, &far).upper);
        int is = !(ask(&probe.body, &b, &collide).lower > 0);
        touching |= is;
        overlaps += (size_t)is;
    }
    CHECK_EQ(ovoid_world_find_nearest(x->w, &(ovoid_world_query){.probe = &probe}, &hit, &error), OVOID_OK);
    CHECK(hit.b != 0 && hit.lower <= nearest);
    if (nearest > 0) CHECK_NEAR(hit.answer.upper, nearest, 1e-7);
    if (nearest <= 0) CHECK(hit.answer.upper <= 0);
    CHECK_EQ(ovoid_world_find_any_of(x->w, &(ovoid_world_probes){.items = &probe, .count = 1}, &hit, &error), OVOID_OK);
    CHECK_EQ(hit.b != 0, touching);
    ovoid_world_hit found[BODIES];
    ovoid_world_hits hits = {.items = found, .capacity = BODIES};
    CHECK_EQ(ovoid_world_find_overlaps(x->w, &(ovoid_world_query){.probe = &probe}, &hits, &error), OVOID_OK);
    CHECK_EQ(hits.count, overlaps);
    int any = 0;
    for (int i = 0; i < BODIES; i++)
        for (int j = i + 1; j < BODIES; j++) {
            ovoid_body a = make_body(x, i, x->poses[i]), b = make_body(x, j, x->poses[j]);
            any |= !(ask(&a, &b, &collide).lower > 0);
        }
    CHECK_EQ(ovoid_world_find_any(x->w, NULL, &hit, &error), OVOID_OK);
    CHECK_EQ(hit.b != 0, any);
}

// A ray against the triangles of each body alone, as thick as the ray; and what it enters.
static void check_rays(stage *x) {
    for (int i = 0; i < 12; i++) {
        ovoid_vec3 from = random_vec3(&x->s, 6), to = random_vec3(&x->s, 2);
        ovoid_world_ray r = {.ray = {from, {to.x - from.x, to.y - from.y, to.z - from.z}, i % 3 ? 2 : INFINITY, 0}};
        r.ray.radius = i % 2 ? 0.05 : 0;
        ovoid_world_cast cast;
        CHECK_EQ(ovoid_world_cast_ray(x->w, &r, &cast, NULL), OVOID_OK);
        // Before the hit the ray's ball is in no body; at its upper end it is in the one that was hit.
        ovoid_shape *ball = ovoid_shape_create_sphere(r.ray.radius, NULL, NULL);
        double until = cast.body ? cast.upper : 2;
        int is_in = 0;
        for (int k = 0; k < 40; k++) {
            double t = k ? until * random_uniform(&x->s, 0, 1) : cast.upper;
            if (!(t < INFINITY)) continue;
            ovoid_pose at = {
                {from.x + t * r.ray.direction.x, from.y + t * r.ray.direction.y, from.z + t * r.ray.direction.z},
                {1, 0, 0, 0}};
            for (int j = 0; j < BODIES; j++) {
                const ovoid_body_pair pair = {make_body(x, j, x->poses[j]), {.shape = ball, .pose = at}};
                ovoid_body_answer y = ovoid_body_collide(&pair, NULL, NULL);
                if (t < cast.lower - 1e-9) CHECK(y.status != OVOID_OVERLAPPING);
                is_in |= !k && x->ids[j] == cast.body && y.upper <= 1e-9;
            }
        }
        if (cast.body) CHECK(is_in);
        if (cast.body && !cast.undecided) CHECK_LE(cast.upper - cast.lower, 1e-8 * (1 + cast.upper));
        x->rays += cast.body != 0;
        ovoid_shape_destroy(ball);
    }
}

// A body on its way: apart from all before the hit, and touching at it.
static void check_cast(stage *x) {
    for (int i = 0; i < 3; i++) {
        ovoid_world_body probe = {
            .body = make_body(x, i == 1 ? 1 : i, (ovoid_pose){random_vec3(&x->s, 7), random_quat(&x->s)})};
        ovoid_vec3 to = random_vec3(&x->s, 2), from = probe.body.pose.position;
        ovoid_vec3 way = {to.x - from.x, to.y - from.y, to.z - from.z};
        ovoid_world_cast cast;
        CHECK_EQ(ovoid_world_cast_body(x->w, &(ovoid_world_sweep){probe, way}, &cast, NULL), OVOID_OK);
        double until = fmin(cast.upper, 1);
        int is_in = 0;
        for (int k = 0; k < 12; k++) {
            double t = k ? until * random_uniform(&x->s, 0, 1) : until;
            ovoid_body at = probe.body;
            at.pose.position.x += t * way.x, at.pose.position.y += t * way.y, at.pose.position.z += t * way.z;
            for (int j = 0; j < BODIES; j++) {
                const ovoid_body_pair pair = {make_body(x, j, x->poses[j]), at};
                ovoid_body_answer y = ovoid_body_distance(&pair, NULL, NULL);
                if (t < cast.lower - 1e-9) CHECK(y.status != OVOID_OVERLAPPING);
                is_in |= !k && x->ids[j] == cast.body && y.lower <= 1e-8;
            }
        }
        if (cast.body) CHECK(is_in);
        x->casts += cast.body != 0;
    }
}

static void check_refused(stage *x) {
    ovoid_error error = {.message = ""};
    ovoid_world_body both = {.body = {.shape = x->shapes[0], .solid = x->solids[0]}};
    both.body.pose = ovoid_pose_make_identity();
    CHECK(ovoid_world_add(x->w, &both, &error) == 0);
    CHECK_EQ(error.code, OVOID_ERROR_ARGUMENT);
    ovoid_world_hit hit;
    CHECK_EQ(ovoid_world_find_any_of(x->w, &(ovoid_world_probes){.items = &both, .count = 1}, &hit, &error),
             OVOID_ERROR_ARGUMENT);
    both.body.shape = NULL;
    both.body.pose.position.x = 2 * OVOID_LENGTH_MAX;
    CHECK(ovoid_world_add(x->w, &both, &error) == 0);
    CHECK_EQ(error.code, OVOID_ERROR_RANGE);
}

// A small box in the hole of a ring of radius 1 with a tube of 1/4: apart near one side of it; on this or the other,
// which the normal that parted them first says nothing of, it meets the ring; in the tube it is within it and crosses
// nothing.
static void test_ring(void) {
    uint64_t s = 1;
    mesh m = {0};
    mesh_add_ring(&m, 1, 0.25, 24, 12, 0, &s);
    ovoid_solid *ring = mesh_make_solid(&m);
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){0.05, 0.05, 0.05}, NULL, NULL);
    ovoid_world *w = ovoid_world_create(&(ovoid_world_options){.enlargement = 20}, NULL);
    const ovoid_pose turned = {{0, 0, 0}, {1, 0, 0, 0}};
    ovoid_pose at = {{0.5, 0, 0}, {1, 0, 0, 0}};
    ovoid_id id = ovoid_world_add(w, &(ovoid_world_body){.body = {.shape = box, .pose = at}}, NULL);
    CHECK(ovoid_world_add(w, &(ovoid_world_body){.body = {.solid = ring, .pose = turned}}, NULL) != 0);
    const ovoid_contact_query q = {.kind = OVOID_QUERY_DISTANCE, .margin = 0.1};
    static const double places[] = {0.5, 0.74, 0.2, -0.3, -0.74, -1, -0.4};
    static const size_t counts[] = {0, 1, 0, 0, 1, 1, 0};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        at.position.x = places[i];
        CHECK_EQ(ovoid_world_move(w, id, &at, NULL), OVOID_OK);
        ovoid_contacts f;
        CHECK_EQ(ovoid_world_compute_contacts(w, &q, &f, NULL), OVOID_OK);
        if (!CHECK_EQ(f.count, counts[i]) || !f.count) continue;
        CHECK_EQ(f.items[0].verdict.status, OVOID_OVERLAPPING);
        CHECK(f.items[0].verdict.lower <= f.items[0].verdict.upper && f.items[0].verdict.upper < 0);
        if (places[i] == -1) CHECK(f.items[0].verdict.lower < -0.05);
    }
    ovoid_world_destroy(w);
    ovoid_shape_destroy(box);
    ovoid_solid_destroy(ring);
    mesh_clear(&m);
}

int main(void) {
    test_ring();
    size_t aged = 0, rays = 0, casts = 0;
    for (uint64_t seed = 1; seed <= 5; seed++) {
        check_seed = seed;
        stage x;
        begin(&x, seed, seed % 2 ? 4 : 2.5);
        const ovoid_contact_query q = {.kind = (ovoid_query_kind)(seed % 4), .margin = seed % 4 ? 0.3 : 0};
        for (int f = 0; f < 8; f++) {
            check_frame(&x, &q);
            if (f % 3 == 0) check_between(&x);
            if (f == 2) check_rays(&x);
            if (f == 5) check_cast(&x);
            move_all(&x, f % 4 == 3 ? 1 : 0.02);
        }
        check_refused(&x);
        aged += x.aged;
        rays += x.rays;
        casts += x.casts;
        end(&x);
    }
    check_seed = 0;
    printf("%zu pairs were answered without a query; %zu rays and %zu bodies hit\n", aged, rays, casts);
    CHECK(aged > 100 && rays > 10 && casts > 4);
    return check_end();
}
