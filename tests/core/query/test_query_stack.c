// How much stack a query takes: each runs in a thread whose stack was filled with a pattern; what is gone of the
// pattern was used. Truth: the 96 KB that the headers state for all of them, and the smaller figures of docs/query.md.
// The pairs are those of all families, and boxes that overlap by so little that every method has its turn. Not measured
// under a sanitizer, which makes stacks several times as large, nor without optimisation.
#define _XOPEN_SOURCE 700 // pthread_attr_setstack
#include "bits.h"
#include "proofs/covers.h"

#include <pthread.h>

#if defined(__SANITIZE_ADDRESS__) || !defined(__OPTIMIZE__)
#define MEASURED 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define MEASURED 0
#endif
#endif
#ifndef MEASURED
#define MEASURED 1
#endif

enum {
    STACK = 256 << 10,
    PATTERN = 0xa5,
    PAIRS = 24,
    SHALLOW = 96,
    STATED = 96 << 10,
    STATED_OF_SOLIDS = STATED + (16 << 10),
    COUPLES = 9
};

static _Alignas(65536) unsigned char stack[STACK];

/// What is asked about, and what was answered: all of it outside the stack that is measured.
static ovoid_pair pair, round_pair;
static ovoid_shape *cylinder; ///< beside the pair's second shape: the round pair
static ovoid_answer answer, round_answer;
STATIC_COVER(cover);
static ovoid_smooth smooth;
static ovoid_gradient gradient;
static ovoid_impact impact;
static ovoid_approach approach;
static ovoid_ray_hit ray_hit;
static ovoid_box box;
static ovoid_step steps[4096];
static ovoid_moving_shape moving[2];
static ovoid_compound *compounds[2];
static ovoid_body_pair body_pair;
static ovoid_moving_body moving_bodies[2];
static ovoid_solid *solids[2];
static ovoid_body_pair solid_pair;
static ovoid_moving_body moving_solids[2];
static ovoid_body_answer solid_answer;
static ovoid_body_answer compound_answer;
static ovoid_body_impact compound_impact;
static ovoid_step_group groups[4096];
static ovoid_exclusion items[256];
static ovoid_exclusions exclusions = {.items = items, .capacity = 256, .cover = &cover};
static ovoid_world *world;
static ovoid_world_body probe;
static ovoid_id ids[2];
static ovoid_world_hit hit, hits[4];
static ovoid_world_cast cast;
static ovoid_contacts frame;
static ovoid_posed_shape posed[2];
static ovoid_couple couples[COUPLES];
static ovoid_answer answers[COUPLES];
static const ovoid_ray ray = {{5, 4, 3}, {-5, -4.1, -3}, INFINITY, 0};
static const ovoid_motion_options recording = {
    .steps = steps, .capacity = 4096, .groups = groups, .group_capacity = 4096};

// ---- the queries

static void ask_nothing(void) {}
static void ask_collide(void) { answer = ovoid_collide(&pair, NULL, NULL); }
static void ask_within(void) { answer = ovoid_within(&pair, 0.01, NULL, NULL); }
static void ask_distance(void) { answer = ovoid_distance(&pair, NULL, NULL); }
static void ask_bounds(void) { answer = ovoid_pair_compute_bounds(&pair); }
static void ask_depth(void) { answer = ovoid_depth(&pair, NULL, NULL, &cover); }
/// From the depth's cover: the query before it.
static void ask_depth_from(void) { answer = ovoid_depth_from(&pair, NULL, &answer.proof, &cover); }
/// Of the depth's answer: the query before them.
static void ask_check(void) {
    CHECK(ovoid_answer_verify(&pair, &answer, &(ovoid_answer_basis){.cover = &cover}, NULL) == OVOID_OK);
}
static ovoid_manifold manifold;
static ovoid_manifold_points manifold_points;
static ovoid_manifold_polygon manifold_polygon;
static const ovoid_manifold_options manifold_options = {.margin = 0.1, .cover = &cover};
static void ask_manifold(void) { manifold = ovoid_manifold_find(&pair, &manifold_options, NULL); }
/// Of the contact of the query before them.
static void ask_manifold_again(void) { manifold = ovoid_manifold_find(&pair, &manifold_options, &manifold); }
static void ask_manifold_points(void) { manifold_points = ovoid_manifold_compute_points(&pair, &manifold); }
static void ask_manifold_polygon(void) {
    (void)ovoid_manifold_compute_polygon(&pair, &manifold, &manifold_options, &manifold_polygon);
}
static void ask_manifold_check(void) {
    CHECK(ovoid_manifold_verify(&pair, &manifold, &manifold_options, NULL) == OVOID_OK);
}
static void ask_gradient(void) { gradient = ovoid_answer_compute_gradient(&pair, &answer, &cover); }
static void ask_round_gradient(void) { gradient = ovoid_answer_compute_gradient(&round_pair, &round_answer, NULL); }
static void ask_smooth(void) { smooth = ovoid_pair_compute_smooth(&pair, 2); }

static ovoid_batch make_batch(void) {
    return (ovoid_batch){posed, 2, couples, COUPLES, NULL, NULL, NULL, answers, NULL};
}
static void ask_collide_batch(void) {
    ovoid_batch batch = make_batch();
    CHECK(ovoid_collide_batch(&batch, NULL) == OVOID_OK);
}
static void ask_within_batch(void) {
    ovoid_batch batch = make_batch();
    CHECK(ovoid_within_batch(&batch, 0.01, NULL) == OVOID_OK);
}
static void ask_distance_batch(void) {
    ovoid_batch batch = make_batch();
    CHECK(ovoid_distance_batch(&batch, NULL) == OVOID_OK);
}
static void ask_depth_batch(void) {
    ovoid_batch batch = make_batch();
    CHECK(ovoid_depth_batch(&batch, NULL) == OVOID_OK);
}

static void ask_impact(void) { impact = ovoid_impact_find(&(ovoid_moving_pair){moving[0], moving[1], 0}, &recording); }
static void ask_impact_check(void) {
    CHECK(ovoid_impact_verify(&(ovoid_moving_pair){moving[0], moving[1], 0}, &impact,
                              &(ovoid_motion_basis){.steps = steps}, NULL) == OVOID_OK);
}
static void ask_approach(void) {
    approach = ovoid_approach_find(&(ovoid_moving_pair){moving[0], moving[1], 0}, &recording);
}
static void ask_approach_check(void) {
    CHECK(ovoid_approach_verify(&(ovoid_moving_pair){moving[0], moving[1], 0}, &approach,
                                &(ovoid_motion_basis){.steps = steps}, NULL) == OVOID_OK);
}
static void ask_cast(void) { impact = ovoid_shape_cast(&pair, (ovoid_vec3){-2, 0.1, 0}, 0, NULL); }
static void ask_ray(void) { ray_hit = ovoid_shape_cast_ray(&posed[1], &ray); }
static void ask_box(void) { box = ovoid_moving_shape_compute_box(&moving[0], 0, 1); }

static void ask_compound_collide(void) {
    compound_answer = ovoid_body_collide(&body_pair, NULL, &(ovoid_body_evidence){.exclusions = &exclusions});
}
static void ask_compound_within(void) {
    compound_answer = ovoid_body_within(&body_pair, 0.01, NULL, &(ovoid_body_evidence){.exclusions = &exclusions});
}
static void ask_compound_distance(void) {
    compound_answer = ovoid_body_distance(&body_pair, NULL, &(ovoid_body_evidence){.exclusions = &exclusions});
}
static void ask_compound_depth(void) {
    compound_answer = ovoid_body_depth(&body_pair, NULL, &(ovoid_body_evidence){.exclusions = &exclusions});
}
static void ask_compound_check(void) {
    CHECK(ovoid_body_verify(&body_pair, &compound_answer, &(ovoid_body_basis){.exclusions = &exclusions}, NULL) ==
          OVOID_OK);
}
static void ask_compound_impact(void) {
    compound_impact =
        ovoid_body_impact_find(&(ovoid_moving_body_pair){moving_bodies[0], moving_bodies[1], 0}, &recording);
}
static void ask_compound_impact_check(void) {
    CHECK(ovoid_body_impact_verify(&(ovoid_moving_body_pair){moving_bodies[0], moving_bodies[1], 0}, &compound_impact,
                                   &(ovoid_motion_basis){.steps = steps, .groups = groups}, NULL) == OVOID_OK);
}
static void ask_compound_box(void) { box = ovoid_moving_body_compute_box(&moving_bodies[0], 0, 1); }

static void ask_solid_collide(void) {
    solid_answer = ovoid_body_collide(&solid_pair, NULL, &(ovoid_body_evidence){.exclusions = &exclusions});
}
static void ask_solid_within(void) {
    solid_answer = ovoid_body_within(&solid_pair, 0.01, NULL, &(ovoid_body_evidence){.exclusions = &exclusions});
}
static void ask_solid_distance(void) {
    solid_answer = ovoid_body_distance(&solid_pair, NULL, &(ovoid_body_evidence){.exclusions = &exclusions});
}
/// Of the distance, where there was room for its proof.
static void ask_solid_check(void) {
    ovoid_code code =
        ovoid_body_verify(&solid_pair, &solid_answer, &(ovoid_body_basis){.exclusions = &exclusions}, NULL);
    CHECK(code == OVOID_OK || exclusions.count > exclusions.capacity);
}
static void ask_solid_impact(void) {
    compound_impact =
        ovoid_body_impact_find(&(ovoid_moving_body_pair){moving_solids[0], moving_solids[1], 0}, &recording);
}
static void ask_solid_impact_check(void) {
    (void)ovoid_body_impact_verify(&(ovoid_moving_body_pair){moving_solids[0], moving_solids[1], 0}, &compound_impact,
                                   &(ovoid_motion_basis){.steps = steps, .groups = groups}, NULL);
}

static void ask_find_any(void) { CHECK(ovoid_world_find_any(world, NULL, &hit, NULL) == OVOID_OK); }
static void ask_find_any_to(void) {
    CHECK(ovoid_world_find_any_of(world, &(ovoid_world_probes){.items = &probe, .count = 1}, &hit, NULL) == OVOID_OK);
}
static void ask_find_any_of(void) {
    const ovoid_world_body both[2] = {probe, probe};
    const ovoid_couple couple = {0, 1};
    const ovoid_world_probes all = {both, 2, &couple, 1};
    CHECK(ovoid_world_find_any_of(world, &all, &hit, NULL) == OVOID_OK);
}
static void ask_find_nearest(void) {
    CHECK(ovoid_world_find_nearest(world, &(ovoid_world_query){.id = ids[0]}, &hit, NULL) == OVOID_OK);
}
static void ask_find_nearest_to(void) {
    CHECK(ovoid_world_find_nearest(world, &(ovoid_world_query){.probe = &probe}, &hit, NULL) == OVOID_OK);
}
static void ask_find_nearest_pair(void) { CHECK(ovoid_world_find_nearest_pair(world, NULL, &hit, NULL) == OVOID_OK); }
static void ask_find_overlaps(void) {
    ovoid_world_hits all = {hits, 4, 0};
    CHECK(ovoid_world_find_overlaps(world, &(ovoid_world_query){.probe = &probe, .margin = 0.01}, &all, NULL) ==
          OVOID_OK);
}
static void ask_cast_ray(void) {
    ovoid_world_ray r = {.ray = ray};
    CHECK(ovoid_world_cast_ray(world, &r, &cast, NULL) == OVOID_OK);
}
static void ask_cast_body(void) {
    CHECK(ovoid_world_cast_body(world, &(ovoid_world_sweep){probe, (ovoid_vec3){-2, 0.1, 0}}, &cast, NULL) == OVOID_OK);
}
/// Not a query, but what threads of a world do.
static void ask_frame(void) {
    ovoid_contact_query q = {OVOID_QUERY_DEPTH, 0.01, NULL};
    CHECK(ovoid_world_compute_contacts(world, &q, &frame, NULL) == OVOID_OK);
}
/// Of the frame's first contact: the call before it.
static void ask_proof(void) {
    static ovoid_contact_proof proof;
    proof.exclusions = &exclusions;
    if (frame.count) CHECK(ovoid_world_compute_proof(world, frame.items, &proof, NULL) == OVOID_OK);
}

static const struct {
    const char *name;
    void (*ask)(void);
    size_t most; ///< stated, in bytes
} queries[] = {{"nothing", ask_nothing, 16 << 10},
               {"collide", ask_collide, STATED},
               {"within", ask_within, STATED},
               {"distance", ask_distance, STATED},
               {"bounds", ask_bounds, 12 << 10},
               {"depth", ask_depth, STATED},
               {"depth_from", ask_depth_from, STATED},
               {"check", ask_check, 56 << 10},
               {"manifold", ask_manifold, STATED},
               {"manifold again", ask_manifold_again, STATED},
               {"manifold points", ask_manifold_points, 40 << 10},
               {"manifold polygon", ask_manifold_polygon, 64 << 10},
               {"manifold check", ask_manifold_check, 64 << 10},
               {"gradient", ask_gradient, 32 << 10},
               {"gradient of a cylinder", ask_round_gradient, STATED},
               {"smooth", ask_smooth, STATED},
               {"collide_batch", ask_collide_batch, STATED},
               {"within_batch", ask_within_batch, STATED},
               {"distance_batch", ask_distance_batch, STATED},
               {"depth_batch", ask_depth_batch, STATED},
               {"impact", ask_impact, STATED},
               {"impact_check", ask_impact_check, 64 << 10},
               {"approach", ask_approach, STATED},
               {"approach_check", ask_approach_check, 64 << 10},
               {"translation_cast", ask_cast, STATED},
               {"ray_cast", ask_ray, STATED},
               {"box", ask_box, 12 << 10},
               {"compound_collide", ask_compound_collide, STATED},
               {"compound_within", ask_compound_within, STATED},
               {"compound_distance", ask_compound_distance, STATED},
               {"compound_depth", ask_compound_depth, STATED},
               {"compound_check", ask_compound_check, 64 << 10},
               {"compound_impact", ask_compound_impact, STATED},
               {"compound_impact_check", ask_compound_impact_check, 64 << 10},
               {"compound_box", ask_compound_box, 12 << 10},
               {"solid_collide", ask_solid_collide, STATED_OF_SOLIDS},
               {"solid_within", ask_solid_within, STATED_OF_SOLIDS},
               {"solid_distance", ask_solid_distance, STATED_OF_SOLIDS},
               {"solid_check", ask_solid_check, 64 << 10},
               {"solid_impact", ask_solid_impact, STATED + (32 << 10)},
               {"solid_impact_check", ask_solid_impact_check, STATED + (32 << 10)},
               {"find_any", ask_find_any, STATED},
               {"find_any_to", ask_find_any_to, STATED},
               {"find_any_of", ask_find_any_of, STATED},
               {"find_nearest", ask_find_nearest, STATED},
               {"find_nearest_to", ask_find_nearest_to, STATED},
               {"find_nearest_pair", ask_find_nearest_pair, STATED},
               {"find_overlaps", ask_find_overlaps, STATED},
               {"cast_ray", ask_cast_ray, STATED},
               {"cast_body", ask_cast_body, STATED},
               {"frame", ask_frame, STATED},
               {"proof", ask_proof, STATED}};
enum { QUERIES = sizeof queries / sizeof *queries };
static size_t most[QUERIES];

// ---- measuring

static void *run(void *argument) {
    int query;
    memcpy(&query, argument, sizeof query);
    queries[query].ask();
    return NULL;
}

static size_t measure(int query) {
    pthread_attr_t attributes;
    pthread_t thread;
    memset(stack, PATTERN, sizeof stack);
    CHECK(pthread_attr_init(&attributes) == 0);
    CHECK(pthread_attr_setstack(&attributes, stack, sizeof stack) == 0);
    if (CHECK(pthread_create(&thread, &attributes, run, &query) == 0)) CHECK(pthread_join(thread, NULL) == 0);
    (void)pthread_attr_destroy(&attributes);
    size_t untouched = 0;
    while (untouched < sizeof stack && stack[untouched] == PATTERN) untouched++;
    return sizeof stack - untouched;
}

/// The surface of a shape; of one that is flat or less, the triangle of three of its vertices.
static ovoid_solid *make_solid(const ovoid_shape *shape) {
    static const uint32_t one[3] = {0, 0, 0};
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    uint32_t count = p.triangle_count ? p.triangle_count : 1;
    return ovoid_solid_create_from_triangles(
        &(ovoid_triangles){p.vertices, p.vertex_count, p.triangle_count ? p.triangles : one, count}, NULL, NULL);
}

/// The pair at hand in all that is asked about: bodies that change places, compounds of three of its shapes, a world.
static int set_up(void) {
    ovoid_pose none = ovoid_pose_make_identity(), aside = none;
    ovoid_measures size = ovoid_shape_get_measures(pair.shape_b);
    double far = 3 * (size.sphere_radius + ovoid_shape_get_radius(pair.shape_b));
    if (!(far > 0)) far = 1;
    cylinder = ovoid_shape_create_cylinder(0.2 * far, 0.3 * far, NULL, NULL);
    if (!CHECK(cylinder != NULL)) return 0;
    round_pair = (ovoid_pair){cylinder, pair.shape_b, none, pair.pose_b};
    ovoid_vec3 center = ovoid_pose_compute_point(&pair.pose_b, size.sphere_center);
    round_pair.pose_a.position = (ovoid_vec3){center.x + far, center.y + 0.1 * far, center.z + 0.2 * far};
    round_pair.pose_a.rotation = (ovoid_quat){0.9, 0.1, 0.2, 0.3};
    round_answer = ovoid_distance(&round_pair, NULL, NULL);
    for (int k = 0; k < 2; k++) {
        const ovoid_shape *shape = k ? pair.shape_b : pair.shape_a;
        ovoid_pose from = k ? pair.pose_b : pair.pose_a, to = k ? pair.pose_a : pair.pose_b;
        ovoid_sym3 q = ovoid_shape_get_outer(shape).ellipsoid.q;
        aside.position.x = 3 * sqrt(q.xx + q.yy + q.zz);
        ovoid_posed_shape parts[3] = {{shape, none}, {shape, aside}, {pair.shape_a, aside}};
        parts[2].pose.position.y = aside.position.x;
        posed[k] = (ovoid_posed_shape){shape, from};
        moving[k] = (ovoid_moving_shape){.shape = shape, .motion = ovoid_motion_make_poses(from, to, 1)};
        compounds[k] = ovoid_compound_create(parts, 3, NULL, NULL);
        if (!CHECK(compounds[k] != NULL)) return 0;
        solids[k] = make_solid(shape);
        if (!CHECK(solids[k] != NULL)) return 0;
        moving_solids[k] = (ovoid_moving_body){.solid = solids[k], .motion = moving[k].motion};
        moving_bodies[k] = (ovoid_moving_body){.compound = compounds[k], .motion = moving[k].motion};
    }
    body_pair = (ovoid_body_pair){{.compound = compounds[0], .pose = pair.pose_a},
                                  {.compound = compounds[1], .pose = pair.pose_b}};
    solid_pair = (ovoid_body_pair){{.solid = solids[0], .pose = pair.pose_a}, {.pose = pair.pose_b}};
    // By turns beside a solid and beside the shape.
    static int turn;
    if (turn++ % 2)
        solid_pair.b.shape = pair.shape_b;
    else
        solid_pair.b.solid = solids[1];
    for (int i = 0; i < COUPLES; i++) couples[i] = (ovoid_couple){0, 1};
    world = ovoid_world_create(NULL, NULL);
    if (!CHECK(world != NULL)) return 0;
    ids[0] = ovoid_world_add(world, &(ovoid_world_body){.body = body_pair.a}, NULL);
    ids[1] = ovoid_world_add(world, &(ovoid_world_body){.body = body_pair.b}, NULL);
    probe = (ovoid_world_body){.body = body_pair.b};
    return CHECK(ids[0] && ids[1]);
}

static void tear_down(void) {
    ovoid_shape_destroy(cylinder);
    ovoid_world_destroy(world);
    for (int k = 0; k < 2; k++) {
        ovoid_compound_destroy(compounds[k]);
        ovoid_solid_destroy(solids[k]);
    }
}

static void measure_all(size_t base) {
    if (!set_up()) return;
    for (int q = 1; q < QUERIES; q++) {
        size_t used = measure(q);
        if (used > base + most[q]) most[q] = used - base;
    }
    tear_down();
}

/// Boxes that overlap by 10^-2 to 10^-13 of their size, face to face or nearly so: no doubles tell how they lie.
static ovoid_pair make_shallow(const ovoid_shape *shape, uint32_t i) {
    uint64_t s = 77 + i;
    double deep = pow(10, -2 - (double)(i % 12));
    ovoid_vec3 aside = bits_vec3(&s, i % 3 == 0 ? 0 : 0.125);
    ovoid_pair p = {shape, shape, {{0, 0, 0}, {1, 0, 0, 0}}, {{2 - deep, aside.y, aside.z}, {1, 0, 0, 0}}};
    if (i % 2) {
        ovoid_pose turned = {{0, 0, 0}, bits_quat(&s)};
        p.pose_b = ovoid_pose_compute_product(&turned, &p.pose_b);
        p.pose_a = turned;
    }
    return p;
}

int main(void) {
    if (!MEASURED) {
        check_skip("stacks are measured in optimised builds without sanitizers");
        return check_end();
    }
    ovoid_shape *shapes[BITS_SHAPES];
    if (!CHECK(bits_make_shapes(shapes))) return check_end();
    // A thread that asks nothing has used what the system takes.
    size_t base = measure(0);
    for (int f = 0; f < BITS_FAMILIES; f++)
        for (uint32_t i = 0; i < PAIRS; i++) {
            pair = bits_make_pair(shapes, (bits_family)f, i);
            measure_all(base);
        }
    for (uint32_t i = 0; i < SHALLOW; i++) {
        pair = make_shallow(shapes[BITS_BOX * BITS_EACH], i);
        measure_all(base);
    }
    for (int q = 1; q < QUERIES; q++) {
        printf("%-22s %6zu of %6zu bytes of stack\n", queries[q].name, most[q], queries[q].most);
        CHECK_LE(most[q], queries[q].most);
    }
    for (int i = 0; i < BITS_SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
