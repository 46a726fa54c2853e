// Questions between frames. Truth: all bodies asked one by one, by the queries and casts of single pairs.
#include "worlds.h"

enum { BODIES = 120 };

typedef struct scene {
    ovoid_shape *shapes[WORLD_SHAPES];
    ovoid_compound *compound;
    ovoid_world *world;
    ovoid_id ids[BODIES];
    uint64_t s;
    double side;
} scene;

static ovoid_world_body make_body(scene *x) {
    ovoid_world_body b = {.body = {.shape = x->shapes[random_next(&x->s) % WORLD_SHAPES]}};
    if (random_next(&x->s) % 8 == 0) b.body = (ovoid_body){.compound = x->compound};
    b.body.pose = (ovoid_pose){random_place(&x->s, x->side), random_quat(&x->s)};
    if (random_next(&x->s) % 5 == 0) b.groups.group = 1, b.groups.mask = 2;
    return b;
}

static void scene_make(scene *x, uint64_t seed, double side) {
    check_seed = x->s = seed;
    x->side = side;
    world_make_shapes(&x->s, 1, x->shapes);
    x->compound = world_make_compound(&x->s, x->shapes, 1);
    x->world = ovoid_world_create(NULL, NULL);
    for (int i = 0; i < BODIES; i++) {
        ovoid_world_body b = make_body(x);
        x->ids[i] = ovoid_world_add(x->world, &b, NULL);
    }
    for (int i = 0; i < 20; i++) (void)ovoid_world_add_ignored(x->world, x->ids[i], x->ids[BODIES - 1 - i], NULL);
}

static void scene_destroy(scene *x) {
    ovoid_world_destroy(x->world);
    ovoid_compound_destroy(x->compound);
    world_destroy_shapes(x->shapes);
}

static ovoid_world_body get_body(const scene *x, int i) {
    ovoid_world_body b;
    CHECK(ovoid_world_get(x->world, x->ids[i], &b, NULL) == OVOID_OK);
    return b;
}

static int is_in_groups(const ovoid_world_body *a, const ovoid_world_body *b) {
    uint32_t ga = a->groups.group, ma = a->groups.mask;
    if (!ga && !ma) ga = ma = ~0u;
    return ga & b->groups.mask && b->groups.group & ma;
}

static int rays_met, solids_met;

// A hit's answer holds for its pair, and its proof.
static void check_hit(const ovoid_body *a, const ovoid_body *b, const ovoid_world_hit *hit) {
    ovoid_body_pair pair = {*a, *b};
    ovoid_answer truth = ovoid_body_depth(&pair, NULL, NULL).deciding;
    CHECK_LE(hit->answer.lower, truth.upper);
    CHECK_LE(truth.lower, hit->answer.upper);
}

static void test_nearest(scene *x) {
    double best = INFINITY;
    for (int i = 0; i < BODIES; i++) {
        ovoid_world_body a = get_body(x, i);
        double least = INFINITY;
        for (int j = 0; j < BODIES; j++) {
            if (!ovoid_world_is_pair(x->world, x->ids[i], x->ids[j])) continue;
            ovoid_body_pair pair = {a.body, get_body(x, j).body};
            least = fmin(least, ovoid_body_distance(&pair, NULL, NULL).upper);
        }
        ovoid_world_hit hit;
        CHECK(ovoid_world_find_nearest(x->world, &(ovoid_world_query){.id = x->ids[i]}, &hit, NULL) == OVOID_OK);
        CHECK(hit.a == x->ids[i]);
        CHECK_NEAR(fmax(hit.answer.upper, 0), fmax(least, 0), 1e-7);
        if (least > 0) CHECK_LE(hit.lower, least);
        ovoid_world_body b;
        CHECK(ovoid_world_get(x->world, hit.b, &b, NULL) == OVOID_OK);
        check_hit(&a.body, &b.body, &hit);
        best = fmin(best, least);
    }
    ovoid_world_hit hit;
    CHECK(ovoid_world_find_nearest_pair(x->world, NULL, &hit, NULL) == OVOID_OK);
    CHECK_NEAR(fmax(hit.answer.upper, 0), fmax(best, 0), 1e-7);
    CHECK(hit.a < hit.b && ovoid_world_is_pair(x->world, hit.a, hit.b));
    if (best > 0) CHECK_LE(hit.lower, best);
    ovoid_options none_near = {.cap = best / 2};
    if (!(best > 1e-6)) return;
    CHECK(ovoid_world_find_nearest_pair(x->world, &none_near, &hit, NULL) == OVOID_OK);
    CHECK(hit.b == 0);
    CHECK_LE(hit.lower, best);
}

// With a wide tolerance a body whose bracket reaches beyond the one at hand may be nearer than that one's lower bound:
// the bound of all counts it.
static void test_nearest_loosely(scene *x) {
    for (int i = 0; i < BODIES; i++) {
        ovoid_world_body self = get_body(x, i);
        const ovoid_options loose = {.absolute_tolerance = i % 2 ? 0.1 * (1 + i % 40) : 0, .iterations = 1 + i % 3 / 2};
        ovoid_world_hit hit;
        CHECK(ovoid_world_find_nearest(x->world, &(ovoid_world_query){.id = x->ids[i], .options = &loose}, &hit,
                                       NULL) == OVOID_OK);
        double nearest = INFINITY;
        for (int j = 0; j < BODIES; j++) {
            if (!ovoid_world_is_pair(x->world, x->ids[i], x->ids[j])) continue;
            ovoid_body_pair pair = {self.body, get_body(x, j).body};
            nearest = fmin(nearest, ovoid_body_distance(&pair, NULL, NULL).upper);
        }
        if (nearest > 0) CHECK_LE(hit.lower, nearest);
    }
}

static void test_any(scene *x) {
    int all = 0;
    for (int i = 0; i < BODIES; i++) {
        ovoid_world_body a = get_body(x, i);
        int touches = 0;
        for (int j = 0; j < BODIES; j++) {
            if (!ovoid_world_is_pair(x->world, x->ids[i], x->ids[j])) continue;
            ovoid_body_pair pair = {a.body, get_body(x, j).body};
            touches |= ovoid_body_collide(&pair, NULL, NULL).status != OVOID_SEPARATED;
        }
        ovoid_world_hit hit;
        CHECK(ovoid_world_find_any(x->world, &(ovoid_world_ids){&x->ids[i], 1}, &hit, NULL) == OVOID_OK);
        CHECK_EQ(hit.b != 0, touches);
        if (hit.b) CHECK(hit.a == x->ids[i] && hit.answer.status != OVOID_SEPARATED);
        all |= touches;
    }
    ovoid_world_hit hit;
    CHECK(ovoid_world_find_any(x->world, NULL, &hit, NULL) == OVOID_OK);
    CHECK_EQ(hit.b != 0, all);
    CHECK(ovoid_world_find_any(x->world, &(ovoid_world_ids){x->ids, BODIES}, &hit, NULL) == OVOID_OK);
    CHECK_EQ(hit.b != 0, all);
}

// Several probes at once: the first that find_overlaps finds something for.
static void check_any_to(scene *x, const ovoid_world_body *probes, size_t count) {
    ovoid_world_hits hits = {.capacity = 0};
    size_t first = 0;
    for (; first < count; first++) {
        CHECK(ovoid_world_find_overlaps(x->world, &(ovoid_world_query){.probe = &probes[first]}, &hits, NULL) ==
              OVOID_OK);
        if (hits.count) break;
    }
    ovoid_world_hit hit;
    CHECK(ovoid_world_find_any_of(x->world, &(ovoid_world_probes){.items = probes, .count = count}, &hit, NULL) ==
          OVOID_OK);
    CHECK_EQ(hit.b != 0, first < count);
    if (!hit.b) return;
    CHECK_EQ(hit.a, first);
    ovoid_world_body b;
    CHECK(ovoid_world_get(x->world, hit.b, &b, NULL) == OVOID_OK);
    check_hit(&probes[first].body, &b.body, &hit);
    CHECK(hit.answer.status != OVOID_SEPARATED);
}

static void check_overlaps(scene *x, const ovoid_world_body *probe, double margin) {
    static ovoid_world_hit items[BODIES];
    ovoid_world_hits hits = {.items = items, .capacity = BODIES};
    CHECK(ovoid_world_find_overlaps(x->world, &(ovoid_world_query){.probe = probe, .margin = margin}, &hits, NULL) ==
          OVOID_OK);
    size_t at = 0;
    double nearest = INFINITY;
    for (int j = 0; j < BODIES; j++) {
        ovoid_world_body b = get_body(x, j);
        if (!is_in_groups(probe, &b)) continue;
        ovoid_body_pair pair = {probe->body, b.body};
        ovoid_answer alone = ovoid_body_within(&pair, margin, NULL, NULL).deciding;
        nearest = fmin(nearest, ovoid_body_distance(&pair, NULL, NULL).upper);
        if (alone.lower > margin) continue;
        CHECK(at < hits.count && items[at].b == x->ids[j] && items[at].a == 0);
        if (at < hits.count) check_hit(&probe->body, &b.body, &items[at]);
        at++;
    }
    CHECK_EQ(at, hits.count);
    ovoid_world_hits none = {.capacity = 0};
    CHECK(ovoid_world_find_overlaps(x->world, &(ovoid_world_query){.probe = probe, .margin = margin}, &none, NULL) ==
          OVOID_OK);
    CHECK_EQ(none.count, hits.count);
    ovoid_world_hit hit;
    CHECK(ovoid_world_find_nearest(x->world, &(ovoid_world_query){.probe = probe}, &hit, NULL) == OVOID_OK);
    CHECK_NEAR(fmax(hit.answer.upper, 0), fmax(nearest, 0), 1e-7);
}

static void test_probes(scene *x) {
    ovoid_world_body probes[40];
    for (int k = 0; k < 40; k++) {
        probes[k] = make_body(x);
        if (k % 2) probes[k] = ovoid_world_make_point(x->world, random_place(&x->s, x->side));
        check_overlaps(x, &probes[k], k % 3 ? 0 : 0.5);
    }
    for (size_t k = 0; k < 40; k++) check_any_to(x, probes + k, 40 - k < 4 ? 40 - k : 4);
    // A refused one is named; none of those before it touches.
    ovoid_world_hit hit;
    ovoid_error error;
    for (size_t k = 0; k + 1 < 40; k++) {
        CHECK(ovoid_world_find_any_of(x->world, &(ovoid_world_probes){.items = probes + k, .count = 1}, &hit, NULL) ==
              OVOID_OK);
        if (hit.b) continue;
        probes[k + 1].body.pose.rotation = (ovoid_quat){0, 0, 0, 0};
        CHECK(ovoid_world_find_any_of(x->world, &(ovoid_world_probes){.items = probes + k, .count = 2}, &hit, &error) ==
              OVOID_ERROR_ROTATION);
        CHECK_EQ(error.place, 1);
        break;
    }
}

static void test_rays(scene *x) {
    int met = 0;
    for (int k = 0; k < 200; k++) {
        ovoid_world_ray r = {.ray = {random_place(&x->s, 2 * x->side), random_place(&x->s, 1), INFINITY, 0}};
        if (k % 3 == 0) r.ray.length = 3;
        if (k % 4 == 0) r.ray.radius = 0.2;
        if (k % 5 == 0) r.ray.direction.x = r.ray.direction.y = 0;
        ovoid_world_cast cast;
        CHECK(ovoid_world_cast_ray(x->world, &r, &cast, NULL) == OVOID_OK);
        double upper = INFINITY, lower = INFINITY;
        ovoid_id body = 0;
        for (int j = 0; j < BODIES; j++) {
            ovoid_world_body b = get_body(x, j);
            size_t parts = b.body.compound ? ovoid_compound_get_part_count(b.body.compound) : 1;
            for (size_t i = 0; i < parts; i++) {
                ovoid_posed_shape part = {b.body.shape, b.body.pose};
                if (b.body.compound) {
                    part = ovoid_compound_get_part(b.body.compound, i);
                    part.pose = ovoid_pose_compute_product(&b.body.pose, &part.pose);
                }
                ovoid_ray_hit hit = ovoid_shape_cast_ray(&part, &r.ray);
                if (hit.status == OVOID_IMPACT_HIT && hit.upper < upper) upper = hit.upper, body = x->ids[j];
                if (hit.status != OVOID_IMPACT_FREE) lower = fmin(lower, hit.lower);
            }
        }
        CHECK((cast.body != 0) == (body != 0));
        if (body) {
            met++;
            CHECK_LE(cast.lower, upper);
            CHECK_LE(lower, cast.upper);
            CHECK_NEAR(cast.upper, upper, 1e-9 * (1 + upper));
        }
    }
    rays_met += met;
}

static void test_solid_casts(scene *x) {
    int met = 0;
    for (int k = 0; k < 60; k++) {
        ovoid_world_body probe = {.body = {.shape = x->shapes[k % WORLD_SHAPES]}};
        probe.body.pose = (ovoid_pose){random_place(&x->s, 1.5 * x->side), random_quat(&x->s)};
        ovoid_vec3 way = random_place(&x->s, x->side);
        ovoid_world_cast cast;
        CHECK(ovoid_world_cast_body(x->world, &(ovoid_world_sweep){probe, way}, &cast, NULL) == OVOID_OK);
        double upper = INFINITY, lower = INFINITY;
        for (int j = 0; j < BODIES; j++) {
            ovoid_world_body b = get_body(x, j);
            size_t parts = b.body.compound ? ovoid_compound_get_part_count(b.body.compound) : 1;
            for (size_t i = 0; i < parts; i++) {
                ovoid_posed_shape part = {b.body.shape, b.body.pose};
                if (b.body.compound) {
                    part = ovoid_compound_get_part(b.body.compound, i);
                    part.pose = ovoid_pose_compute_product(&b.body.pose, &part.pose);
                }
                ovoid_pair pair = {part.shape, probe.body.shape, part.pose, probe.body.pose};
                ovoid_impact hit = ovoid_shape_cast(&pair, way, 0, NULL);
                upper = fmin(upper, hit.hit_at);
                if (hit.status != OVOID_IMPACT_FREE) lower = fmin(lower, hit.free_until);
            }
        }
        CHECK_EQ(cast.body != 0, upper < INFINITY);
        if (upper < INFINITY) {
            met++;
            CHECK_LE(cast.lower, upper);
            CHECK_LE(lower, cast.upper);
            CHECK_NEAR(cast.upper, upper, 1e-9);
        }
    }
    solids_met += met;
}

// Bodies at powers of two, added one after another: a tree deeper than any stack. Truth: the spheres' own distances.
static void test_deep(void) {
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_shape *ball = ovoid_shape_create_sphere(1e-50, NULL, NULL);
    ovoid_id ids[600];
    int count = 0;
    for (double x = 1e48; x > 1e-48; x /= 1.5) {
        ovoid_world_body b = {.body = {.shape = ball, .pose = {{x, 0, 0}, {1, 0, 0, 0}}}};
        ids[count++] = ovoid_world_add(w, &b, NULL);
        if (count == 540) break;
    }
    ovoid_world_hit hit;
    CHECK(ovoid_world_find_nearest_pair(w, NULL, &hit, NULL) == OVOID_OK);
    CHECK(hit.a == ids[count - 2] && hit.b == ids[count - 1]);
    for (int k = 1; k + 1 < count; k++) {
        CHECK(ovoid_world_find_nearest(w, &(ovoid_world_query){.id = ids[k]}, &hit, NULL) == OVOID_OK);
        CHECK(hit.b == ids[k + 1]);
    }
    ovoid_world_ray r = {.ray = {{-1, 0, 0}, {1, 0, 0}, INFINITY, 0}};
    ovoid_world_cast cast;
    CHECK(ovoid_world_cast_ray(w, &r, &cast, NULL) == OVOID_OK);
    CHECK(cast.body != 0 || cast.undecided);
    ovoid_contact_query q = {.kind = OVOID_QUERY_COLLIDE};
    ovoid_contacts f;
    CHECK(ovoid_world_compute_contacts(w, &q, &f, NULL) == OVOID_OK);
    CHECK_EQ(f.count, 0);
    ovoid_world_destroy(w);
    ovoid_shape_destroy(ball);
}

static void test_refusals(void) {
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_world_hit hit;
    ovoid_error error = {0};
    CHECK(ovoid_world_find_nearest_pair(w, NULL, &hit, NULL) == OVOID_OK && hit.b == 0);
    CHECK(ovoid_world_find_any(w, NULL, &hit, NULL) == OVOID_OK && hit.b == 0);
    CHECK(ovoid_world_find_nearest(w, &(ovoid_world_query){.id = 77}, &hit, &error) == OVOID_ERROR_INDEX);
    CHECK(strstr(error.message, "names no body") != NULL);
    ovoid_world_body point = ovoid_world_make_point(w, (ovoid_vec3){1, 2, 3});
    CHECK(ovoid_world_find_nearest(w, &(ovoid_world_query){.probe = &point}, &hit, NULL) == OVOID_OK && hit.b == 0);
    point.body.pose.position.x = NAN;
    CHECK(ovoid_world_find_nearest(w, &(ovoid_world_query){.probe = &point}, &hit, NULL) == OVOID_ERROR_NOT_FINITE);
    ovoid_world_ray r = {.ray = {{0, 0, 0}, {0, 0, 0}, 1, 0}};
    ovoid_world_cast cast;
    CHECK(ovoid_world_cast_ray(w, &r, &cast, NULL) == OVOID_ERROR_ARGUMENT);
    r.ray.direction.x = 1;
    CHECK(ovoid_world_cast_ray(w, &r, &cast, NULL) == OVOID_OK && cast.body == 0 && cast.lower == 1);
    ovoid_options bad = {.cap = NAN};
    CHECK(ovoid_world_find_nearest_pair(w, &bad, &hit, NULL) == OVOID_ERROR_ARGUMENT);
    ovoid_world_destroy(w);
}

int main(void) {
    for (uint64_t seed = 1; seed <= 3; seed++) {
        scene x;
        scene_make(&x, seed, seed == 1 ? 16 : seed == 2 ? 8 : 40);
        test_nearest(&x);
        test_nearest_loosely(&x);
        test_any(&x);
        test_probes(&x);
        test_rays(&x);
        test_solid_casts(&x);
        scene_destroy(&x);
    }
    CHECK_LE(20, rays_met);
    CHECK_LE(10, solids_met);
    test_deep();
    test_refusals();
    return check_end();
}
