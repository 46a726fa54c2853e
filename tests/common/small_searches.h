// Searches of small bodies at random (simd/small_gjk.h): bodies of 1 to `most` vertices, boxes on a lattice where
// values tie and zeros have signs, every kind of goal.
#ifndef OVOID_TESTS_SMALL_SEARCHES_H
#define OVOID_TESTS_SMALL_SEARCHES_H

#include "check.h"
#include "compounds.h"
#include "ovoid/ovoid.h"
#include "pair/frame.h"
#include "simd/small_gjk.h"

enum { BODIES = 40 };
static ovoid_shape *shapes[BODIES];

static inline int make_bodies(unsigned most) {
    uint64_t state = 11, *s = &state;
    for (int i = 0; i < BODIES; i++) {
        double xyz[3 * SMALL_GJK_POINTS];
        size_t count = 1 + random_next(s) % most;
        for (size_t k = 0; k < 3 * count; k++) xyz[k] = random_uniform(s, -1, 1);
        // Each second one is on a sphere, where every point is a vertex.
        for (size_t k = 0; k < count && i % 2; k++) {
            vec3 x = vec3_unit(vec3_at(xyz, k));
            memcpy(xyz + 3 * k, &x, sizeof x);
        }
        ovoid_vec3 half = {1, 0.5 * (double)(i % 3), 0.25};
        shapes[i] =
            i % 4 ? ovoid_shape_create_from_points(xyz, count, NULL, NULL) : ovoid_shape_create_box(half, NULL, NULL);
        if (!CHECK(shapes[i] != NULL)) return 0;
    }
    return 1;
}

static inline void fill_search(uint64_t *s, small_gjk_query *q, double rows[2][9]) {
    int is_even = random_next(s) % 3 == 0;
    for (int i = 0; i < 2; i++) {
        static const ovoid_quat quarters[4] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 0, 0, -1}, {0, 0, 1, 0}};
        ovoid_pose p = {{0, 0, 0}, random_quat(s)};
        if (is_even) p.rotation = quarters[random_next(s) % 4];
        ovoid_pose_compute_matrix(&p, rows[i]);
    }
    q->a = shape_get_points(shapes[random_next(s) % BODIES]);
    q->b = shape_get_points(shapes[random_next(s) % BODIES]);
    q->rows_a = rows[0];
    q->rows_b = rows[1];
    q->turned_a = q->turned_b = NULL;
    for (int i = 0; i < 3; i++) {
        q->offset[i] = is_even ? 0.25 * (double)(random_next(s) % 9) - 1 : random_uniform(s, -2, 2);
        q->start[i] = q->offset[i];
    }
    if (q->start[0] == 0 && q->start[1] == 0 && q->start[2] == 0) q->start[random_next(s) % 3] = -1;
    q->lower_radii = q->upper_radii = random_next(s) % 4 ? 0 : random_uniform(s, 0, 1);
    q->claim = 1e-13;
    q->wants_bracket = random_next(s) % 2;
    q->far = q->wants_bracket ? INFINITY : random_uniform(s, 0, 0.5);
    q->near = random_next(s) % 2 ? q->far : -INFINITY;
    q->tolerance = random_next(s) % 2 ? 1e-9 : 0.02;
    q->iterations = random_next(s) % 8 ? 1000 : (uint32_t)(random_next(s) % 5);
}

// Compares two results. An open end has no other content; of the others only the corners in use are compared.
static inline int same_search(const small_gjk_result *x, const small_gjk_result *y) {
    if (x->end != y->end) return 0;
    if (x->end == SMALL_GJK_OPEN) return 1;
    if (memcmp(x->n, y->n, sizeof x->n) || memcmp(&x->scale, &y->scale, sizeof x->scale)) return 0;
    if (x->gap != y->gap || x->iterations != y->iterations || x->valid != y->valid) return 0;
    if (x->end == SMALL_GJK_KEPT && (memcmp(x->weight, y->weight, sizeof x->weight) || x->distance != y->distance))
        return 0;
    for (int i = 0; i < 4; i++) {
        if (!(x->valid >> i & 1)) continue;
        if (x->a[i] != y->a[i] || x->b[i] != y->b[i] || x->at.x[i] != y->at.x[i] || x->at.y[i] != y->at.y[i] ||
            x->at.z[i] != y->at.z[i])
            return 0;
    }
    return 1;
}

static inline void destroy_bodies(void) {
    for (int i = 0; i < BODIES; i++) ovoid_shape_destroy(shapes[i]);
}

#endif
