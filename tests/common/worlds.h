// Random bodies, and the expected contacts of a frame: the queries of all pairs, one by one.
#ifndef OVOID_TESTS_WORLDS_H
#define OVOID_TESTS_WORLDS_H

#include "check.h"
#include "ovoid/ovoid.h"

enum { WORLD_SHAPES = 12 };

static inline ovoid_shape *world_make_shape(uint64_t *s, int k, double scale) {
    ovoid_shape_options o = {.radius = k % 4 == 3 ? 0.1 * scale : 0};
    if (k == 0) return ovoid_shape_create_box((ovoid_vec3){scale, scale, scale}, &o, NULL);
    if (k == 1) return ovoid_shape_create_sphere(0.7 * scale, NULL, NULL);
    if (k == 2) return ovoid_shape_create_capsule(0.3 * scale, scale, NULL, NULL);
    double xyz[3 * 32];
    int count = k == 4 ? 4 : 8 + k * 2;
    for (int i = 0; i < 3 * count; i++)
        xyz[i] = scale * random_uniform(s, -1, 1) + (k == 5 && i % 3 == 0 ? 3 * scale : 0);
    return ovoid_shape_create_from_points(xyz, (size_t)count, &o, NULL);
}

static inline void world_make_shapes(uint64_t *s, double scale, ovoid_shape *shapes[WORLD_SHAPES]) {
    for (int k = 0; k < WORLD_SHAPES; k++) shapes[k] = world_make_shape(s, k, scale);
}
static inline void world_destroy_shapes(ovoid_shape *shapes[WORLD_SHAPES]) {
    for (int k = 0; k < WORLD_SHAPES; k++) ovoid_shape_destroy(shapes[k]);
}

/// A compound of a few of the shapes.
static inline ovoid_compound *world_make_compound(uint64_t *s, ovoid_shape *const *shapes, double scale) {
    ovoid_posed_shape parts[5];
    for (int i = 0; i < 5; i++)
        parts[i] = (ovoid_posed_shape){shapes[random_next(s) % WORLD_SHAPES],
                                       {{scale * random_uniform(s, -2, 2), scale * random_uniform(s, -1, 1), 0},
                                        {1, random_uniform(s, -1, 1), 0, 0.5}}};
    return ovoid_compound_create(parts, 5, NULL, NULL);
}

static inline ovoid_quat random_quat(uint64_t *s) {
    return (ovoid_quat){random_normal(s), random_normal(s), random_normal(s), random_normal(s)};
}
static inline ovoid_vec3 random_place(uint64_t *s, double side) {
    return (ovoid_vec3){random_uniform(s, -side, side), random_uniform(s, -side, side), random_uniform(s, -side, side)};
}

/// The answer of a query of the pair alone, without a warm start.
static inline ovoid_body_answer world_ask(const ovoid_world_body *a, const ovoid_world_body *b,
                                          const ovoid_contact_query *q) {
    ovoid_body_pair pair = {a->body, b->body};
    ovoid_options o = {.cap = 0};
    if (q->options) o = *q->options;
    o.cap = q->margin > 0 ? q->margin : 1e-300;
    switch (q->kind) {
    case OVOID_QUERY_COLLIDE: return ovoid_body_collide(&pair, &o, NULL);
    case OVOID_QUERY_WITHIN: return ovoid_body_within(&pair, q->margin, &o, NULL);
    case OVOID_QUERY_DISTANCE: return ovoid_body_distance(&pair, &o, NULL);
    default: return ovoid_body_depth(&pair, &o, NULL);
    }
}

/// An upper bound of what a body adds to a pair's size, of which the tolerance is a billionth.
static inline double world_find_reach(const ovoid_body *body) {
    if (body->compound) {
        // The ellipsoid's reach is at most the root of its trace.
        ovoid_ellipsoid e = ovoid_compound_get_outer(body->compound);
        return 2 * (sqrt(e.q.xx + e.q.yy + e.q.zz) + fabs(e.center.x) + fabs(e.center.y) + fabs(e.center.z));
    }
    ovoid_measures m = ovoid_shape_get_measures(body->shape);
    ovoid_vec3 c = m.sphere_center;
    return m.sphere_radius + fabs(c.x) + fabs(c.y) + fabs(c.z) + ovoid_shape_get_radius(body->shape);
}
static inline double world_find_size(const ovoid_body *a, const ovoid_body *b) {
    ovoid_vec3 p = a->pose.position, q = b->pose.position;
    double apart = fabs(p.x - q.x) + fabs(p.y - q.y) + fabs(p.z - q.z);
    return world_find_reach(a) + world_find_reach(b) + apart;
}

/// Compares one contact with the truth: an exact bracket of the signed distance, and the proof made for it.
static inline void world_check_contact(const ovoid_world *w, const ovoid_contact *c, const ovoid_world_body *a,
                                       const ovoid_world_body *b, const ovoid_contact_query *q) {
    static ovoid_exclusion items[4096];
    static ovoid_cover cover;
    ovoid_exclusions exclusions = {.items = items, .capacity = 4096, .cover = &cover};
    ovoid_body_pair pair = {a->body, b->body};
    ovoid_answer alone = world_ask(a, b, q).deciding, truth = ovoid_body_depth(&pair, NULL, NULL).deciding;
    CHECK_EQ(c->verdict.status, alone.status);
    CHECK(c->user_a == a->user && c->user_b == b->user);
    CHECK_LE(c->verdict.lower, truth.upper);
    CHECK_LE(truth.lower, c->verdict.upper);
    // The reported bounds prove the status.
    CHECK(c->verdict.status != OVOID_SEPARATED || c->verdict.lower > 0);
    CHECK(c->verdict.status != OVOID_OVERLAPPING || c->verdict.upper < 0);
    ovoid_contact_proof proof = {.exclusions = &exclusions};
    ovoid_error error = {0};
    CHECK(ovoid_world_compute_proof(w, c, &proof, &error) == OVOID_OK);
    ovoid_body_answer proven = proof.answer;
    if (!CHECK(ovoid_body_verify(&pair, &proven, &(ovoid_body_basis){.options = q->options, .exclusions = &exclusions},
                                 &error) == OVOID_OK))
        printf("  %s\n", error.message);
    CHECK_EQ(proven.status, alone.status);
    // Two brackets of one distance, each as wide as the tolerance.
    double near = 2e-9 * world_find_size(&a->body, &b->body);
    if (q->kind == OVOID_QUERY_DEPTH) CHECK_NEAR(c->verdict.upper, truth.upper, near);
    if (q->kind == OVOID_QUERY_DISTANCE && alone.status == OVOID_SEPARATED)
        CHECK_NEAR(c->verdict.lower, truth.lower, near);
}

/// Compares the frame with all pairs of the world, which must be small.
static inline void world_validate_frame(const ovoid_world *w, const ovoid_contact_query *q, const ovoid_contacts *f) {
    size_t at = 0;
    for (ovoid_id a = ovoid_world_find_next(w, 0); a; a = ovoid_world_find_next(w, a)) {
        ovoid_world_body body_a;
        CHECK(ovoid_world_get(w, a, &body_a, NULL) == OVOID_OK);
        for (ovoid_id b = ovoid_world_find_next(w, a); b; b = ovoid_world_find_next(w, b)) {
            ovoid_world_body body_b;
            CHECK(ovoid_world_get(w, b, &body_b, NULL) == OVOID_OK);
            const ovoid_contact *c = at < f->count ? &f->items[at] : NULL;
            int is_in = c && c->a == a && c->b == b;
            at += (size_t)is_in;
            if (!ovoid_world_is_pair(w, a, b)) {
                CHECK(!is_in);
            } else if (is_in) {
                world_check_contact(w, c, &body_a, &body_b, q);
            } else {
                ovoid_answer alone = world_ask(&body_a, &body_b, q).deciding;
                CHECK(alone.lower > q->margin || (q->kind == OVOID_QUERY_DISTANCE && alone.lower >= q->margin));
            }
        }
    }
    CHECK_EQ(at, f->count);
}

#endif
