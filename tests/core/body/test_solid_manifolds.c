// The manifolds of a solid and convex parts. Truth: on a level floor of many triangles, the manifold of the same body
// on a box with the same top; elsewhere, brute force over all triangles: each point on its body, a normal that is the
// facet's or along which the solid rises nowhere beside the point; and the answer of ovoid_body_distance.
#include "bits.h"
#include "linear/rotation.h"
#include "manifolds.h"
#include "ovoid/body_manifolds.h"
#include "shape/block.h"
#include "solids.h"

enum { MOST = 512 };

typedef struct found_manifolds {
    ovoid_body_manifold items[MOST];
    ovoid_manifold_points points[MOST];
    ovoid_body_manifolds all;
} found_manifolds;

static void find(const ovoid_body_pair *pair, const ovoid_manifold_options *options, found_manifolds *f) {
    f->all = (ovoid_body_manifolds){.items = f->items, .points = f->points, .capacity = MOST};
    CHECK_EQ(ovoid_body_manifolds_find(pair, options, &f->all), OVOID_LIMIT_NONE);
    CHECK_LE(f->all.count, MOST);
}

// ---- bodies

enum { KINDS = 6 };

static ovoid_shape *make_shape(int kind, uint64_t *s) {
    double xyz[3 * 20];
    ovoid_shape_options round = {.radius = kind == 5 ? 0.2 : 0};
    for (int i = 0; i < 60; i++) xyz[i] = random_uniform(s, -0.7, 0.7);
    switch (kind) {
    case 0: return ovoid_shape_create_box((ovoid_vec3){0.5, 0.7, 0.3}, NULL, NULL);
    case 1: return ovoid_shape_create_sphere(0.5, NULL, NULL);
    case 2: return ovoid_shape_create_capsule(0.3, 0.6, NULL, NULL);
    case 3: return ovoid_shape_create_from_points(xyz, 20, NULL, NULL);
    case 4: return ovoid_shape_create_from_points(xyz, 6, NULL, NULL);
    default: return ovoid_shape_create_from_points(xyz, 8, &round, NULL);
    }
}

static int is_level(uint64_t seed) { return seed % 3 == 0; }

// A pose in which the body reaches down to that depth.
static ovoid_pose make_pose(const ovoid_shape *shape, double x, double y, double depth, uint64_t *s, uint64_t seed) {
    ovoid_pose pose = {{x, y, 0}, {1, 0, 0, 0}};
    double turn = random_uniform(s, 0, 3);
    pose.rotation = is_level(seed) ? (ovoid_quat){cos(turn), 0, 0, sin(turn)} : random_quat(s);
    mat3 r = quat_to_mat3(pose.rotation);
    double low = vec3_dot(r.r2, shape->origin) - shape_find_extreme(shape, vec3_neg(r.r2)).value - shape->radius;
    pose.position.z = -depth - low;
    return pose;
}

// ---- a level floor

static double level(double x, double y) {
    (void)x;
    (void)y;
    return 0;
}

static const ovoid_manifold_point *find_point(const ovoid_manifold_points *p, uint32_t id) {
    for (uint32_t i = 0; i < p->count; i++)
        if (p->points[i].id == id) return &p->points[i];
    return NULL;
}

static void check_same(const ovoid_body_pair *pair, const ovoid_pair *one, const ovoid_manifold_options *options) {
    static found_manifolds f;
    find(pair, options, &f);
    ovoid_manifold truth = ovoid_manifold_find(one, options, NULL);
    ovoid_manifold_points points = ovoid_manifold_compute_points(one, &truth);
    if (truth.axis == OVOID_MANIFOLD_NONE) {
        CHECK_EQ(f.all.count, 0);
        return;
    }
    if (!CHECK_EQ(f.all.count, 1)) return;
    const ovoid_manifold *m = &f.items[0].manifold;
    CHECK(vec3_norm(vec3_sub(m->normal, (ovoid_vec3){0, 0, -1})) <= 1e-15);
    CHECK(vec3_norm(vec3_sub(m->normal, truth.normal)) <= 1e-15);
    CHECK_EQ(m->axis, OVOID_MANIFOLD_FACE_B);
    CHECK_EQ(m->status, truth.status);
    CHECK_NEAR(m->lower, truth.lower, 1e-12);
    CHECK_NEAR(m->upper, truth.upper, 1e-10);
    CHECK_EQ(m->count, truth.count);
    CHECK_EQ(m->corners, truth.corners);
    CHECK_NEAR((double)m->share, (double)truth.share, 1e-6);
    for (uint32_t i = 0; i < points.count; i++) {
        const ovoid_manifold_point *p = find_point(&f.points[0], points.points[i].id);
        if (!CHECK(p != NULL)) continue;
        CHECK(vec3_norm(vec3_sub(p->point_a, points.points[i].point_a)) <= 1e-12);
        CHECK(vec3_norm(vec3_sub(p->point_b, points.points[i].point_b)) <= 1e-12);
    }
    ovoid_error error = {.message = ""};
    if (!CHECK_EQ(ovoid_body_manifold_verify(pair, &f.items[0], options, &error), OVOID_OK))
        printf("  %s\n", error.message);
}

static void test_floor(uint64_t seed) {
    uint64_t s = check_seed = seed;
    const ground of = {3 + (uint32_t)(random_next(&s) % 30), 4, -1, level, random_uniform(&s, 0, 0.2)};
    ovoid_solid *floor = ground_make(&of, &s);
    ovoid_shape *block = ovoid_shape_create_box((ovoid_vec3){4, 4, 0.5}, NULL, NULL);
    for (int kind = 0; kind < KINDS; kind++) {
        ovoid_shape *shape = make_shape(kind, &s);
        double depth = seed % 2 ? random_uniform(&s, 0, 0.05) : random_uniform(&s, -0.03, 0);
        const ovoid_pose place = {{0, 0, 0}, {1, 0, 0, 0}}, under = {{0, 0, -0.5}, {1, 0, 0, 0}};
        ovoid_pose pose = make_pose(shape, random_uniform(&s, -2, 2), random_uniform(&s, -2, 2), depth, &s, seed);
        const ovoid_body_pair pair = {{.shape = shape, .pose = pose}, {.solid = floor, .pose = place}};
        const ovoid_pair one = {shape, block, pose, under};
        const ovoid_manifold_options options = {.margin = seed % 5 ? 0.02 : 0};
        check_same(&pair, &one, &options);
        ovoid_shape_destroy(shape);
    }
    ovoid_shape_destroy(block);
    ovoid_solid_destroy(floor);
}

// ---- grounds that are not level

static double hilly(double x, double y) { return 0.3 * sin(2 * x) * cos(3 * y); }
static double stepped(double x, double y) { return floor(x * 1.01) * 0.25 + (y > 0.3 ? 0.5 : 0); }
static double ridged(double x, double y) { return -0.7 * fabs(x + 0.05) + 0.01 * y; }
static double grooved(double x, double y) { return 0.7 * fabs(x + 0.05) + 0.01 * y; }

typedef struct tally {
    size_t pairs, manifolds, lost, through, wide;
} tally;

static void check_facet_manifold(const ovoid_body_pair *pair, const ovoid_manifold_options *options,
                                 const found_manifolds *f, size_t i) {
    const ovoid_body_manifold *item = &f->items[i];
    const ovoid_manifold *m = &item->manifold;
    const ovoid_manifold_points *p = &f->points[i];
    ovoid_error error = {.message = ""};
    if (!CHECK_EQ(ovoid_body_manifold_verify(pair, item, options, &error), OVOID_OK)) printf("  %s\n", error.message);
    ovoid_manifold_points again = ovoid_body_manifold_compute_points(pair, item);
    CHECK_EQ(again.count, p->count);
    CHECK_EQ(p->count, m->count);
    vec3 up = vec3_neg(mat3_mul_transposed_vec3(quat_to_mat3(pair->b.pose.rotation), m->normal));
    const ovoid_manifold_point *deepest = &p->points[0];
    for (uint32_t k = 0; k < p->count; k++) {
        const ovoid_manifold_point *x = &p->points[k];
        vec3 b =
            mat3_mul_transposed_vec3(quat_to_mat3(pair->b.pose.rotation), vec3_sub(x->point_b, pair->b.pose.position));
        CHECK_LE(distance_of_point(pair->a.shape, &pair->a.pose, x->point_a), p->grown + 1e-9);
        CHECK_LE(solid_measure_distance(pair->b.solid, b), p->grown + 1e-9);
        vec3 way = vec3_sub(vec3_sub(x->point_b, x->point_a), vec3_scale(m->normal, x->separation));
        CHECK_LE(vec3_norm(way), 1e-12);
        CHECK_LE(x->separation, options->margin + 1e-5);
        CHECK_LE(m->lower, x->separation);
        CHECK(vec3_norm(vec3_sub(x->point_a, again.points[k].point_a)) <= 1e-12);
        if (x->separation < deepest->separation) deepest = x;
    }
    CHECK_LE(deepest->separation, m->upper);
    if (m->axis == OVOID_MANIFOLD_FACE_B) {
        vec3 c[3];
        solid_read_triangle(pair->b.solid, item->part_b, c);
        CHECK(vec3_dot(vec3_unit(vec3_cross(vec3_sub(c[1], c[0]), vec3_sub(c[2], c[0]))), up) >= 1 - 1e-12);
    } else {
        vec3 b = mat3_mul_transposed_vec3(quat_to_mat3(pair->b.pose.rotation),
                                          vec3_sub(deepest->point_b, pair->b.pose.position));
        CHECK_LE(solid_measure_rise(pair->b.solid, b, up, 1e-5), 1e-4);
    }
}

// ---- lies: a true manifold, altered in one field to what is not true

enum { LIES = 20 };

static int alter(ovoid_body_manifold *item, int lie) {
    ovoid_manifold *m = &item->manifold;
    switch (lie) {
    case 0: m->lower += 1e-6; return 1;
    case 1: m->upper -= 1e-6; return 1;
    case 2: m->status = m->status == OVOID_OVERLAPPING ? OVOID_SEPARATED : OVOID_OVERLAPPING; return 1;
    case 3: m->limit = m->limit == OVOID_LIMIT_NONE ? OVOID_LIMIT_PRECISION : OVOID_LIMIT_NONE; return 1;
    case 4: m->normal = vec3_unit(vec3_add(m->normal, vec3_scale(vec3_orthogonal(m->normal), 1e-3))); return 1;
    case 5: m->normal = vec3_neg(m->normal); return 1;
    case 6: m->id[m->count - 1]++; return 1;
    case 7: m->id[m->count - 1] ^= OVOID_MANIFOLD_ID_CROSSING; return 1;
    case 8: m->feature_a++; return 1;
    case 9: m->feature_b++; return 1;
    case 10: m->facet_a ^= OVOID_MANIFOLD_KIND; return 1;
    case 11: m->facet_b++; return 1;
    case 12: m->axis = m->axis == OVOID_MANIFOLD_FACE_B ? OVOID_MANIFOLD_FREE : OVOID_MANIFOLD_FACE_B; return 1;
    case 13: m->axis = OVOID_MANIFOLD_EDGES; return 1;
    case 14: m->count--; return 1;
    case 15: m->proof = (uint8_t)((m->proof + 1) % 5); return 1;
    case 16: m->corners++; return 1;
    case 17: m->share *= 0.99F; return 1;
    case 18: item->part_a++; return 1;
    case 19: item->part_b++; return 1;
    default: return 0;
    }
}

static int are_near(const ovoid_manifold_points *p, const ovoid_manifold_points *q) {
    int are = p->count == q->count;
    for (uint32_t i = 0; are && i < p->count; i++)
        are = p->points[i].id == q->points[i].id &&
              vec3_norm(vec3_sub(p->points[i].point_a, q->points[i].point_a)) <= 1e-9 &&
              vec3_norm(vec3_sub(p->points[i].point_b, q->points[i].point_b)) <= 1e-9;
    return are;
}

static void check_lies(const ovoid_body_pair *pair, const ovoid_body_manifold *item,
                       const ovoid_manifold_options *options) {
    for (int lie = 0; lie < LIES; lie++) {
        ovoid_body_manifold altered = *item;
        ovoid_error error = {.message = ""};
        (void)alter(&altered, lie);
        ovoid_code code = ovoid_body_manifold_verify(pair, &altered, options, &error);
        // Another feature of the part that has the same points is as true.
        ovoid_manifold_points own = ovoid_body_manifold_compute_points(pair, item),
                              other = ovoid_body_manifold_compute_points(pair, &altered);
        if (lie == 10 && code == OVOID_OK && are_near(&own, &other)) continue;
        if (!CHECK_EQ(code, OVOID_ERROR_PROOF)) printf("  lie %d, axis %d\n", lie, item->manifold.axis);
        CHECK(error.message[0] != 0);
    }
}

static void check_swapped(const ovoid_body_pair *pair, const ovoid_manifold_options *options,
                          const found_manifolds *f) {
    static found_manifolds g;
    const ovoid_body_pair other = {pair->b, pair->a};
    find(&other, options, &g);
    CHECK_EQ(g.all.count, f->all.count);
    CHECK(g.all.lower == f->all.lower && g.all.upper == f->all.upper);
    for (size_t i = 0; i < g.all.count && i < f->all.count; i++) {
        ovoid_manifold turned = ovoid_manifold_make_swapped(&g.items[i].manifold);
        CHECK(g.items[i].part_a == f->items[i].part_b && g.items[i].part_b == f->items[i].part_a);
        CHECK(memcmp(&turned, &f->items[i].manifold, sizeof turned) == 0);
        CHECK_EQ(ovoid_body_manifold_verify(&other, &g.items[i], options, NULL), OVOID_OK);
        for (uint32_t k = 0; k < g.points[i].count; k++)
            CHECK(vec3_norm(vec3_sub(g.points[i].points[k].point_a, f->points[i].points[k].point_b)) <= 0);
    }
}

static void test_ground(uint64_t seed, tally *t) {
    static double (*const heights[])(double, double) = {hilly, stepped, ridged, grooved};
    static found_manifolds f;
    uint64_t s = check_seed = seed;
    const ground of = {4 + (uint32_t)(random_next(&s) % 12), 3, -2, heights[seed % 4], random_uniform(&s, 0, 0.2)};
    ovoid_solid *solid = ground_make(&of, &s);
    for (int kind = 0; kind < KINDS; kind++) {
        ovoid_shape *shape = make_shape(kind, &s);
        double x = random_uniform(&s, -2, 2), y = random_uniform(&s, -2, 2), high = 1;
        ovoid_body_pair pair = {{.shape = shape, .pose = make_pose(shape, x, y, -high, &s, seed)},
                                {.solid = solid, .pose = {random_vec3(&s, 3), random_quat(&s)}}};
        // Down until it touches, then a little deeper.
        ovoid_pose at = pair.a.pose;
        const ovoid_manifold_options options = {.margin = seed % 3 ? 0.02 : 0};
        for (int i = 0; i < 60; i++) {
            pair.a.pose = ovoid_pose_compute_product(&pair.b.pose, &at);
            ovoid_body_answer answer = ovoid_body_distance(&pair, NULL, NULL);
            if (answer.lower < 1e-4) break;
            at.position.z -= answer.lower;
        }
        at.position.z -= random_uniform(&s, -0.015, 0.03);
        pair.a.pose = ovoid_pose_compute_product(&pair.b.pose, &at);
        find(&pair, &options, &f);
        ovoid_body_answer answer = ovoid_body_distance(&pair, NULL, NULL);
        t->pairs++;
        t->manifolds += f.all.count;
        t->through += f.all.through;
        t->lost += answer.upper <= options.margin && f.all.count == 0;
        if (answer.lower > options.margin) CHECK_EQ(f.all.count, 0);
        for (size_t i = 0; i < f.all.count; i++) {
            check_facet_manifold(&pair, &options, &f, i);
            check_lies(&pair, &f.items[i], &options);
            t->wide += f.items[i].manifold.limit != OVOID_LIMIT_NONE;
        }
        check_swapped(&pair, &options, &f);
        ovoid_shape_destroy(shape);
    }
    ovoid_solid_destroy(solid);
}

int main(void) {
    tally t = {0};
    for (uint64_t seed = 1; seed <= 60; seed++) test_floor(seed);
    for (uint64_t seed = 1; seed <= 80; seed++) test_ground(seed, &t);
    printf("%zu pairs, %zu manifolds, %zu lost, %zu through, %zu wide\n", t.pairs, t.manifolds, t.lost, t.through,
           t.wide);
    return check_end();
}
