// Random events in a world: bodies are added, move a little or far, and are removed; pairs are ignored and queried
// again.
#ifndef OVOID_TESTS_WORLD_LIFE_H
#define OVOID_TESTS_WORLD_LIFE_H

#include "worlds.h"

typedef struct life {
    ovoid_world *world;
    ovoid_shape **shapes;
    ovoid_compound *compound;
    ovoid_id ids[64];
    size_t count;
    size_t most_bodies, most_pairs; ///< so far
    double side, scale;
    uint64_t s;
    history past; ///< the pairs of the last manifolds
    size_t most_parts;
} life;

static inline ovoid_world_body life_make_body(life *l) {
    ovoid_world_body b = {.body = {.shape = l->shapes[random_next(&l->s) % WORLD_SHAPES]}};
    if (random_next(&l->s) % 8 == 0) b.body = (ovoid_body){.compound = l->compound};
    b.body.pose = (ovoid_pose){random_place(&l->s, l->side), random_quat(&l->s)};
    if (random_next(&l->s) % 4 == 0) {
        b.groups.group = 1u << random_next(&l->s) % 3;
        b.groups.mask = (uint32_t)random_next(&l->s) % 7 + 1;
    }
    b.user = random_next(&l->s);
    return b;
}

static inline void life_add(life *l) {
    ovoid_world_body b = life_make_body(l);
    ovoid_id id = ovoid_world_add(l->world, &b, NULL);
    CHECK(id != 0);
    l->ids[l->count++] = id;
}

static inline void life_move(life *l, ovoid_id id) {
    ovoid_world_body b;
    CHECK(ovoid_world_get(l->world, id, &b, NULL) == OVOID_OK);
    ovoid_pose p = b.body.pose;
    double step = random_next(&l->s) % 16 == 0 ? l->side : 0.02 * l->scale;
    ovoid_vec3 d = random_place(&l->s, step);
    p.position = (ovoid_vec3){p.position.x + d.x, p.position.y + d.y, p.position.z + d.z};
    if (random_next(&l->s) % 2) p.rotation.w += random_uniform(&l->s, -0.03, 0.03);
    CHECK(ovoid_world_move(l->world, id, &p, NULL) == OVOID_OK);
}

static inline void life_step(life *l) {
    for (size_t k = 0; k < l->count; k++)
        if (random_next(&l->s) % 3) life_move(l, l->ids[k]);
    if (l->count < 60 && random_next(&l->s) % 2) life_add(l);
    if (l->count > 5 && random_next(&l->s) % 3 == 0) {
        size_t k = random_next(&l->s) % l->count;
        CHECK(ovoid_world_remove(l->world, l->ids[k], NULL) == OVOID_OK);
        l->ids[k] = l->ids[--l->count];
    }
    if (l->count > 2 && random_next(&l->s) % 4 == 0) {
        ovoid_id a = l->ids[random_next(&l->s) % l->count], b = l->ids[random_next(&l->s) % l->count];
        if (a != b)
            CHECK((random_next(&l->s) % 2 ? ovoid_world_add_ignored(l->world, a, b, NULL)
                                          : ovoid_world_remove_ignored(l->world, a, b, NULL)) == OVOID_OK);
    }
}

/// Shapes of one scale, or huge and small ones mixed; some bodies on a lattice where they touch exactly.
static inline void life_begin(life *l, uint64_t seed, double scale, ovoid_shape **shapes) {
    *l =
        (life){.world = ovoid_world_create(NULL, NULL), .shapes = shapes, .side = 4 * scale, .scale = scale, .s = seed};
    world_make_shapes(&l->s, scale, shapes);
    if (seed % 4 == 3) {
        ovoid_shape_destroy(shapes[6]);
        ovoid_shape_destroy(shapes[7]);
        shapes[6] = world_make_shape(&l->s, 6, 50 * scale);
        shapes[7] = world_make_shape(&l->s, 7, 1e-3 * scale);
    }
    l->compound = world_make_compound(&l->s, shapes, scale);
    for (int i = 0; i < 40; i++) life_add(l);
}

static inline void life_end(life *l) {
    ovoid_world_destroy(l->world);
    ovoid_compound_destroy(l->compound);
    world_destroy_shapes(l->shapes);
}

/// The manifolds of a frame, compared with all pairs. Of a part with its points there are four copies in all, of 408
/// bytes at most; arrays double.
static inline void life_manifolds(life *l) {
    const ovoid_world_manifold_query q = {
        .options = {.margin = random_next(&l->s) % 2 ? random_uniform(&l->s, 0, 0.2) * l->scale : 0,
                    .tolerance = random_next(&l->s) % 2 ? 1e-3 * l->scale : 0},
        .ahead = (double)(random_next(&l->s) % 3)};
    const ovoid_material m = {.margin = random_uniform(&l->s, 0, 0.1) * l->scale, .friction = 1};
    CHECK(ovoid_world_set_material(l->world, l->ids[random_next(&l->s) % l->count], &m, NULL) == OVOID_OK);
    ovoid_world_manifolds found;
    CHECK(ovoid_world_compute_manifolds(l->world, &q, &found, NULL) == OVOID_OK);
    // The largest body has a size of a few hundred.
    world_validate_manifolds(l->world, &(manifold_truth){&q, 200 * l->scale}, &found);
    history_step(&l->past, &found);
    if (found.part_count > l->most_parts) l->most_parts = found.part_count;
}

/// A frame with any query, compared with all pairs; and the bytes that the world holds: arrays double, so the 330 bytes
/// of a body with its leaf, and the 390 of a pair with its cached answer and its contact, take at most twice that for
/// the largest numbers so far.
static inline void life_frame(life *l, ovoid_contact_query *q) {
    if (random_next(&l->s) % 6 == 0) {
        q->kind = (ovoid_query_kind)(random_next(&l->s) % 4);
        q->margin = q->kind ? random_uniform(&l->s, 0, 0.5) * l->scale : 0;
    }
    ovoid_contacts frame;
    CHECK(ovoid_world_compute_contacts(l->world, q, &frame, NULL) == OVOID_OK);
    world_validate_frame(l->world, q, &frame);
    if (frame.bodies > l->most_bodies) l->most_bodies = frame.bodies;
    if (frame.pairs > l->most_pairs) l->most_pairs = frame.pairs;
    size_t manifolds = l->most_parts ? 65536 + 2048 * (l->most_bodies + l->most_pairs) + 4096 * l->most_parts : 0;
    CHECK_LE(frame.memory, 16384 + 1024 * (l->most_bodies + l->most_pairs) + manifolds);
    if (random_next(&l->s) % 4 == 0) life_manifolds(l);
}

#endif
