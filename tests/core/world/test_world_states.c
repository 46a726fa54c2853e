// States of a machine: ovoid_world_find_any_of. Truth of what is found: all probes and all couples asked one by one,
// cold. Truth of where a probe is: each vertex under its pose in long double, whose rounding is a two-thousandth of
// that of doubles, must be in the outline's box and sphere, to the last bit.
#include "extended.h"
#include "shape/block.h"
#include "world/body_bounds.h"
#include "worlds.h"

// ---- outlines

static void check_vertex(const body_outline *o, extended3 p, long double radius) {
    CHECK(p.x - radius >= o->bounds.min.x && p.x + radius <= o->bounds.max.x);
    CHECK(p.y - radius >= o->bounds.min.y && p.y + radius <= o->bounds.max.y);
    CHECK(p.z - radius >= o->bounds.min.z && p.z + radius <= o->bounds.max.z);
    extended3 d = {p.x - o->at.x, p.y - o->at.y, p.z - o->at.z};
    CHECK(extended3_norm(d) + radius <= o->reach);
}

// The outline holds all vertices, and is no larger than twice the box of the vertices but for what rounding adds.
static void check_outline(const ovoid_body *body) {
    body_sphere ball = body_compute_sphere(body);
    body_outline o = body_compute_outline(body, &ball);
    const ovoid_shape *s = body->shape;
    const double *v = shape_vertices(s);
    for (uint32_t i = 0; i < s->vertex_count; i++, v += 3) {
        extended3 local = {(long double)s->origin.x + v[0], (long double)s->origin.y + v[1],
                           (long double)s->origin.z + v[2]};
        check_vertex(&o, extended3_place(&body->pose, local), s->radius + s->allowance.outside);
    }
    box tight = body_compute_box(body, &ball);
    double more = 1e-12 * (vec3_max_abs(body->pose.position) + ball.size);
    CHECK_LE(o.bounds.max.x - o.bounds.min.x, 4 * (tight.max.x - tight.min.x) + 2 * ball.reach + more);
    CHECK_LE(o.reach, ball.reach + ball.radius + more);
}

static ovoid_pose make_pose(uint64_t *s, int k) {
    static const double far[] = {0, 1, 1e3, 1e9};
    ovoid_pose p = {random_place(s, far[k % 4]), random_quat(s)};
    // Along the axes the box of a box is as narrow as can be.
    if (k % 3 == 0) p.rotation = (ovoid_quat){k % 2, (k + 1) % 2, 0, 0};
    return p;
}

static void test_outlines(uint64_t seed) {
    uint64_t s = check_seed = seed;
    ovoid_shape *shapes[WORLD_SHAPES];
    world_make_shapes(&s, 0.37, shapes);
    double xyz[24];
    for (int i = 0; i < 24; i++) xyz[i] = 7e5 + random_uniform(&s, -1, 1);
    ovoid_shape *away = ovoid_shape_create_from_points(xyz, 8, NULL, NULL);
    ovoid_shape *rod = ovoid_shape_create_cylinder(0.2, 3, &(ovoid_shape_options){.tolerance = 0.01}, NULL);
    for (int k = 0; k < 600; k++) {
        const ovoid_shape *which = k % 14 == 12 ? away : k % 14 == 13 ? rod : shapes[k % 14];
        ovoid_body body = {.shape = which, .pose = make_pose(&s, k)};
        check_outline(&body);
    }
    ovoid_shape_destroy(away);
    ovoid_shape_destroy(rod);
    world_destroy_shapes(shapes);
}

// ---- states

enum { PROBES = 40, COUPLES = 60, BODIES = 60 };

typedef struct scene {
    ovoid_shape *shapes[WORLD_SHAPES];
    ovoid_compound *compound;
    ovoid_world *world;
    ovoid_world_body probes[PROBES];
    ovoid_couple couples[COUPLES];
    size_t probe_count, couple_count;
    uint64_t s;
} scene;

static ovoid_world_body draw(scene *x, double side) {
    ovoid_world_body b = {.body = {.shape = x->shapes[random_next(&x->s) % WORLD_SHAPES]}};
    if (random_next(&x->s) % 8 == 0) b.body = (ovoid_body){.compound = x->compound};
    b.body.pose = (ovoid_pose){random_place(&x->s, side), random_quat(&x->s)};
    if (random_next(&x->s) % 3 == 0)
        b.groups.group = 1 + random_next(&x->s) % 3, b.groups.mask = 1 + random_next(&x->s) % 3;
    return b;
}

static int do_touch(const ovoid_body *a, const ovoid_body *b) {
    ovoid_body_pair pair = {*a, *b};
    return ovoid_body_collide(&pair, NULL, NULL).status != OVOID_SEPARATED;
}

static int are_in_groups(const ovoid_world_body *a, const ovoid_world_body *b) {
    uint32_t ga = a->groups.group || a->groups.mask ? a->groups.group : ~0u,
             ma = a->groups.group || a->groups.mask ? a->groups.mask : ~0u;
    uint32_t gb = b->groups.group || b->groups.mask ? b->groups.group : ~0u,
             mb = b->groups.group || b->groups.mask ? b->groups.mask : ~0u;
    return ga & mb && gb & ma;
}

static int touches_world(const scene *x, const ovoid_world_body *probe) {
    for (ovoid_id id = ovoid_world_find_next(x->world, 0); id; id = ovoid_world_find_next(x->world, id)) {
        ovoid_world_body b;
        CHECK(ovoid_world_get(x->world, id, &b, NULL) == OVOID_OK);
        if (are_in_groups(probe, &b) && do_touch(&probe->body, &b.body)) return 1;
    }
    return 0;
}

/// How many states ended at a body, at a couple, at nothing.
static int ends[3];

static void collide_state(const scene *x) {
    size_t first = 0, couple = 0;
    while (first < x->probe_count && !touches_world(x, &x->probes[first])) first++;
    while (couple < x->couple_count &&
           !do_touch(&x->probes[x->couples[couple].a].body, &x->probes[x->couples[couple].b].body))
        couple++;
    ovoid_world_probes all = {x->probes, x->probe_count, x->couples, x->couple_count};
    ovoid_world_hit hit;
    CHECK(ovoid_world_find_any_of(x->world, &all, &hit, NULL) == OVOID_OK);
    if (first < x->probe_count) {
        CHECK(hit.b && !(hit.b & OVOID_WORLD_PROBE));
        CHECK_EQ(hit.a, first);
        ends[0]++;
    } else if (couple < x->couple_count) {
        CHECK_EQ(hit.a, x->couples[couple].a);
        CHECK(hit.b == (OVOID_WORLD_PROBE | x->couples[couple].b));
        CHECK(hit.answer.status != OVOID_SEPARATED);
        ends[1]++;
    } else {
        CHECK(hit.b == 0 && hit.a == 0 && hit.lower == 0);
        ends[2]++;
    }
}

static void test_states(uint64_t seed) {
    scene x = {.s = seed};
    check_seed = seed;
    world_make_shapes(&x.s, 0.3, x.shapes);
    x.compound = world_make_compound(&x.s, x.shapes, 0.3);
    x.world = ovoid_world_create(NULL, NULL);
    static const double sides[] = {2, 5, 15, 60};
    double side = sides[seed / 3 % 4];
    for (int i = 0; i < BODIES; i++) {
        ovoid_world_body b = draw(&x, side);
        CHECK(ovoid_world_add(x.world, &b, NULL) != 0);
    }
    // A third of the states are beside the bodies, where only their probes can meet; a third has few probes.
    x.probe_count = random_next(&x.s) % (seed % 3 == 1 ? 4 : PROBES) + 1;
    for (size_t i = 0; i < x.probe_count; i++) {
        x.probes[i] = draw(&x, seed % 3 == 0 ? 0.4 + 0.4 * (double)(seed % 4) : 1.3 * side);
        if (seed % 3 == 0) x.probes[i].body.pose.position.x += 2 * side + 6;
    }
    x.couple_count = random_next(&x.s) % COUPLES;
    for (size_t i = 0; i < x.couple_count; i++)
        x.couples[i] = (ovoid_couple){(uint32_t)(random_next(&x.s) % x.probe_count),
                                      (uint32_t)(random_next(&x.s) % x.probe_count)};
    // Of a probe and itself nothing is to be found.
    for (size_t i = 0; i < x.couple_count; i++)
        if (x.couples[i].a == x.couples[i].b) x.couples[i] = x.couples[--x.couple_count], i--;
    collide_state(&x);
    ovoid_world_destroy(x.world);
    ovoid_compound_destroy(x.compound);
    world_destroy_shapes(x.shapes);
}

// Two bodies as a couple of probes, and one of them in the world: as their own query says.
static void check_two(const ovoid_world_body *probes) {
    ovoid_couple couple = {0, 1};
    ovoid_world_probes all = {probes, 2, &couple, 1}, one = {probes + 1, 1, NULL, 0};
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_world_hit hit;
    int touches = do_touch(&probes[0].body, &probes[1].body);
    CHECK(ovoid_world_find_any_of(w, &all, &hit, NULL) == OVOID_OK);
    CHECK_EQ(hit.b != 0, touches);
    CHECK(ovoid_world_add(w, &probes[0], NULL) != 0);
    CHECK(ovoid_world_find_any_of(w, &one, &hit, NULL) == OVOID_OK);
    CHECK_EQ(hit.b != 0, touches);
    ovoid_world_destroy(w);
}

// Two boxes along the axes, apart or together by a few parts in 10^12 of their size, as probes and in a world: nothing
// that touches may be passed over.
static void test_edges(uint64_t seed) {
    uint64_t s = check_seed = seed;
    double half = random_uniform(&s, 0.1, 9), radius = seed % 2 ? random_uniform(&s, 0, 1) : 0;
    ovoid_shape *shape =
        ovoid_shape_create_box((ovoid_vec3){half, half / 3, 2 * half}, &(ovoid_shape_options){.radius = radius}, NULL);
    ovoid_vec3 at = random_place(&s, 100), away[3] = {{2 * half, 0, 0}, {0, 2 * half / 3, 0}, {0, 0, 4 * half}};
    ovoid_vec3 step = away[seed % 3], unit = vec3_unit(step);
    for (int k = -4; k <= 4; k++) {
        double gap = 2 * radius + k * 2e-12 * (half + 100);
        ovoid_vec3 to = vec3_add(vec3_add(at, step), vec3_scale(unit, gap));
        ovoid_world_body probes[2] = {{.body = {.shape = shape, .pose = {at, {1, 0, 0, 0}}}},
                                      {.body = {.shape = shape, .pose = {to, {1, 0, 0, 0}}}}};
        check_two(probes);
    }
    ovoid_shape_destroy(shape);
}

// The same of two balls, whose spheres and boxes are all there is of them.
static void test_balls(uint64_t seed) {
    uint64_t s = check_seed = seed;
    double radius = random_uniform(&s, 0.1, 9);
    ovoid_shape *ball = ovoid_shape_create_sphere(radius, NULL, NULL);
    ovoid_vec3 at = random_place(&s, 10), way = vec3_unit(random_place(&s, 1));
    for (int k = -4; k <= 4; k++) {
        ovoid_vec3 to = vec3_add(at, vec3_scale(way, 2 * radius + k * 1e-11));
        ovoid_world_body probes[2] = {{.body = {.shape = ball, .pose = {at, random_quat(&s)}}},
                                      {.body = {.shape = ball, .pose = {to, random_quat(&s)}}}};
        check_two(probes);
    }
    ovoid_shape_destroy(ball);
}

// Two balls at one place: each must want the other.
static void test_groups(void) {
    ovoid_shape *ball = ovoid_shape_create_sphere(1, NULL, NULL);
    for (uint32_t k = 0; k < 16; k++) {
        ovoid_world *w = ovoid_world_create(NULL, NULL);
        ovoid_world_body body = {.body = {.shape = ball, .pose = {{0, 0, 0}, {1, 0, 0, 0}}},
                                 .groups = {1 + k % 2, 1 + k / 2 % 2}};
        ovoid_world_body probe = {.body = body.body, .groups = {1 + k / 4 % 2, 1 + k / 8 % 2}};
        ovoid_world_hit hit;
        CHECK(ovoid_world_add(w, &body, NULL) != 0);
        CHECK(ovoid_world_find_any_of(w, &(ovoid_world_probes){.items = &probe, .count = 1}, &hit, NULL) == OVOID_OK);
        CHECK_EQ(hit.b != 0, body.groups.group == probe.groups.mask && probe.groups.group == body.groups.mask);
        ovoid_world_destroy(w);
    }
    ovoid_shape_destroy(ball);
}

static void test_refusals(void) {
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_world_body points[2] = {ovoid_world_make_point(w, (ovoid_vec3){0, 0, 0}),
                                  ovoid_world_make_point(w, (ovoid_vec3){1, 0, 0})};
    ovoid_couple couples[2] = {{0, 1}, {1, 2}};
    ovoid_world_probes all = {points, 2, couples, 2};
    ovoid_world_hit hit;
    ovoid_error error = {0};
    CHECK(ovoid_world_find_any_of(w, &all, &hit, &error) == OVOID_ERROR_INDEX);
    CHECK_EQ(error.place, 1);
    CHECK(strstr(error.message, "couple 1 names a probe past the last of 2") != NULL);
    all.couple_count = 1;
    points[1].body.pose.position.y = INFINITY;
    CHECK(ovoid_world_find_any_of(w, &all, &hit, &error) == OVOID_ERROR_NOT_FINITE);
    CHECK_EQ(error.place, 1);
    points[1].body.pose.position.y = 2 * OVOID_LENGTH_MAX;
    CHECK(ovoid_world_find_any_of(w, &all, &hit, &error) == OVOID_ERROR_RANGE);
    all = (ovoid_world_probes){NULL, 0, NULL, 0};
    CHECK(ovoid_world_find_any_of(w, &all, &hit, &error) == OVOID_OK && hit.b == 0);
    ovoid_world_destroy(w);
}

int main(void) {
    if (!EXTENDED) check_skip("long double has no more digits than double here");
    for (uint64_t seed = 1; EXTENDED && seed <= 4; seed++) test_outlines(seed);
    for (uint64_t seed = 1; seed <= 200; seed++) test_states(seed);
    for (uint64_t seed = 1; seed <= 60; seed++) test_edges(seed);
    for (uint64_t seed = 1; seed <= 60; seed++) test_balls(seed);
    test_groups();
    test_refusals();
    for (int i = 0; i < 3; i++) CHECK_LE(25, ends[i]);
    return check_end();
}
