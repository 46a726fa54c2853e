// Compounds for the tests, and the answer by brute force: a query of every pair of parts.
#ifndef OVOID_TESTS_COMPOUNDS_H
#define OVOID_TESTS_COMPOUNDS_H

#include "check.h"
#include "ovoid/body.h"
#include "places.h"

enum { SHAPES = 12 };

/// Shapes of every kind: hulls, boxes, flat, needles, rounded ones, a sphere, one far from its own origin.
static inline int make_shapes(ovoid_shape *shapes[SHAPES], double scale, uint64_t *s) {
    for (int i = 0; i < SHAPES; i++) {
        double xyz[3 * 24];
        int count = 4 + (int)(random_next(s) % 21);
        ovoid_shape_options o = {.radius = i % 4 == 3 ? random_uniform(s, 0.05, 0.4) * scale : 0};
        for (int k = 0; k < 3 * count; k++) xyz[k] = random_uniform(s, -1, 1) * scale;
        for (int k = 0; k < count; k++) {
            if (i == 4 || i == 7) xyz[3 * k + 2] = 0;
            if (i == 5) xyz[3 * k] *= 0.01, xyz[3 * k + 1] *= 0.02;
            if (i == 6) xyz[3 * k] += 1000 * scale;
        }
        if (i == 8) count = 1;
        if (i == 9) count = 2;
        shapes[i] = i < 2 ? ovoid_shape_create_box((ovoid_vec3){scale, 0.5 * scale, 0.25 * scale}, &o, NULL)
                          : ovoid_shape_create_from_points(xyz, (size_t)count, &o, NULL);
        if (!CHECK(shapes[i] != NULL)) return 0;
    }
    return 1;
}
static inline void destroy_shapes(ovoid_shape *shapes[SHAPES]) {
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
}

/// A compound of parts spread over +-reach.
static inline ovoid_compound *make_compound(ovoid_shape *const shapes[SHAPES], size_t count, double reach,
                                            uint64_t *s) {
    ovoid_posed_shape *parts = malloc(count * sizeof *parts);
    ovoid_error error = {0};
    for (size_t i = 0; parts && i < count; i++) {
        uint64_t kind = random_next(s) % SHAPES;
        parts[i] = (ovoid_posed_shape){shapes[kind], {random_vec3(s, reach), random_quat(s)}};
        // Moves the part back to where the others are.
        if (kind == 6) {
            ovoid_polytope p = ovoid_shape_get_polytope(shapes[6]);
            ovoid_vec3 at = {p.origin.x + p.vertices[0], p.origin.y + p.vertices[1], p.origin.z + p.vertices[2]};
            ovoid_vec3 off = ovoid_pose_compute_point(&parts[i].pose, at), *to = &parts[i].pose.position;
            *to = (ovoid_vec3){2 * to->x - off.x, 2 * to->y - off.y, 2 * to->z - off.z};
        }
        // Some parts are repeated.
        if (i && random_next(s) % 16 == 0) parts[i] = parts[i - 1];
    }
    ovoid_compound *c = ovoid_compound_create(parts, count, NULL, &error);
    if (!c) printf("%s\n", error.message);
    free(parts);
    return c;
}

static inline size_t get_count(const ovoid_body *body) {
    return body->compound ? ovoid_compound_get_part_count(body->compound) : 1;
}
static inline ovoid_posed_shape get_part(const ovoid_body *body, size_t i) {
    if (!body->compound) return (ovoid_posed_shape){body->shape, body->pose};
    ovoid_posed_shape part = ovoid_compound_get_part(body->compound, i);
    return (ovoid_posed_shape){part.shape, ovoid_pose_compute_product(&body->pose, &part.pose)};
}
static inline ovoid_pair get_pair(const ovoid_body_pair *pair, size_t a, size_t b) {
    ovoid_posed_shape x = get_part(&pair->a, a), y = get_part(&pair->b, b);
    return (ovoid_pair){x.shape, y.shape, x.pose, y.pose};
}

/// The bracket of the smallest signed distance, by the depth of every pair of parts.
typedef struct bracket {
    double lower, upper;
} bracket;
static inline bracket find_brute(const ovoid_body_pair *pair, int wants_depth) {
    bracket best = {INFINITY, INFINITY};
    for (size_t a = 0; a < get_count(&pair->a); a++)
        for (size_t b = 0; b < get_count(&pair->b); b++) {
            ovoid_pair parts = get_pair(pair, a, b);
            ovoid_answer x = wants_depth ? ovoid_depth(&parts, NULL, NULL, NULL) : ovoid_distance(&parts, NULL, NULL);
            best.lower = fmin(best.lower, x.lower);
            best.upper = fmin(best.upper, x.upper);
        }
    return best;
}

#endif
