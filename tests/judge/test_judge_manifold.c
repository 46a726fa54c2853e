// Contacts before the exact judge: boxes, prisms, hulls, rounded, round and flat bodies on one another and in random
// poses, with edges and faces that are parallel or nearly so, cold and warm. Truth: the facets clipped and the zone of
// contact made in exact arithmetic, the bodies' exact supports along the normal, and the exact distance of each point
// from its body; of `upper`, the lower bounds of ovoid_depth, each shown by its own normal in exact arithmetic.
// A longer run: test_judge_manifold --contacts 1e6.
#include "judge.h"
#include "manifolds.h"
#include "options.h"
#include "places.h"

enum { SHAPES = 72, KINDS = 12, FRAMES = 4 };
static ovoid_shape *shapes[SHAPES];

static ovoid_shape *create(int kind, uint64_t *s) {
    double xyz[3 * 32];
    ovoid_error error;
    int count = kind == 2 ? 8 : kind == 3 ? 14 : 32;
    const ovoid_shape_options rounded = {.radius = 0.1}, coarse = {.tolerance = 0.02};
    if (kind == 0)
        return ovoid_shape_create_box((ovoid_vec3){random_uniform(s, 0.5, 1.5), random_uniform(s, 0.5, 1.5), 0.6}, NULL,
                                      &error);
    if (kind == 1)
        return ovoid_shape_create_prism(&(ovoid_prism){1, 0.5, 3 + (uint32_t)(random_next(s) % 9)}, NULL, &error);
    if (kind == 5) return ovoid_shape_create_box((ovoid_vec3){0.7, random_uniform(s, 0.2, 1), 0.4}, &rounded, &error);
    if (kind == 6) return ovoid_shape_create_capsule(0.3, 0.8, NULL, &error);
    if (kind == 7) return ovoid_shape_create_cylinder(0.6, random_uniform(s, 0.2, 1), &coarse, &error);
    if (kind == 8) return ovoid_shape_create_cone(0.8, 0.6, &coarse, &error);
    if (kind == 10) return ovoid_shape_create_box((ovoid_vec3){random_uniform(s, 0.2, 1), 0.7, 0.02}, NULL, &error);
    if (kind == 11)
        return ovoid_shape_create_pyramid(&(ovoid_prism){1, 0.1, 3 + (uint32_t)(random_next(s) % 4)}, NULL, &error);
    for (int i = 0; i < count; i++) {
        vec3 p = vec3_unit((vec3){random_normal(s), random_normal(s), random_normal(s)});
        if (i < 5) p = (vec3){0.8 * cos(1.2566 * i), 0.8 * sin(1.2566 * i), -0.6};
        if (kind == 9) p.z = 0.25;
        for (int k = 0; k < 3; k++) xyz[3 * i + k] = (&p.x)[k];
    }
    return ovoid_shape_create_from_points(xyz, (size_t)count, NULL, &error);
}

// A turn in which faces or edges of A and B are parallel but for a small angle, from 1e-1 down to rounding, or none.
static ovoid_quat small_turn(uint64_t *s) {
    double angle = random_next(s) % 4 ? pow(10, random_uniform(s, -17, -1)) : 0;
    ovoid_quat turn = {1, 0, 0, angle};
    if (random_next(s) & 1) turn.x = angle * random_normal(s), turn.y = angle * random_normal(s);
    if (random_next(s) & 1) turn.z = random_normal(s);
    return turn;
}

// B on A, by faces or in a random turn; both then moved by a common pose, or not.
static void place(ovoid_pair *pair, uint64_t *s) {
    uint64_t way = random_next(s) % 4;
    ovoid_pose home = ovoid_pose_make_identity(),
               by = {{random_normal(s), random_normal(s), random_normal(s)}, random_quat(s)};
    pair->pose_a = pair->pose_b = home;
    pair->pose_b.rotation = way == 0   ? (ovoid_quat){1, 0, 0, random_normal(s)}
                            : way == 1 ? small_turn(s)
                                       : random_quat(s);
    double aside = random_next(s) & 1 ? 0.3 : 1;
    vec3 d = vec3_unit((vec3){aside * random_normal(s), aside * random_normal(s), 1});
    double near = 0, far = 6, want = random_uniform(s, -0.03, 0.01);
    for (int k = 0; k < 30; k++) {
        pair->pose_b.position = vec3_scale(d, (near + far) / 2);
        if (ovoid_depth(pair, NULL, NULL, NULL).lower > want)
            far = (near + far) / 2;
        else
            near = (near + far) / 2;
    }
    if (way == 1 && random_next(s) & 1) return;
    pair->pose_a = ovoid_pose_compute_product(&by, &pair->pose_a);
    pair->pose_b = ovoid_pose_compute_product(&by, &pair->pose_b);
}

static long judged, polygons;

static void judge_one(judge *context, const ovoid_pair *pair, const ovoid_manifold_options *o,
                      const ovoid_manifold *m) {
    static ovoid_manifold_polygon polygon;
    ovoid_error error = {OVOID_OK, -1, ""};
    if (!m->count) return;
    CHECK_EQ(ovoid_manifold_compute_polygon(pair, m, o, &polygon), OVOID_OK);
    judge_contact contact = {m, &polygon, o->margin, 2e-6 * size_of_pair(pair)};
    if (!CHECK_EQ(judge_verify_contact(context, pair, &contact, &error), OVOID_OK)) printf("  %s\n", error.message);
    ovoid_answer truth = ovoid_depth(pair, NULL, NULL, NULL);
    ovoid_manifold shown = {.normal = truth.normal, .lower = truth.lower};
    contact.manifold = &shown;
    polygon.count = 0;
    CHECK_EQ(judge_verify_contact(context, pair, &contact, &error), OVOID_OK);
    CHECK_LE(truth.lower, m->upper);
    judged++;
    polygons += m->corners > 2;
}

// A judge that accepts all is none: corners and bounds that are moved are refused.
static void check_judge(judge *context, const ovoid_pair *pair, const ovoid_manifold_options *o, ovoid_manifold m) {
    static ovoid_manifold_polygon polygon;
    judge_contact contact = {&m, &polygon, o->margin, 2e-6 * size_of_pair(pair)};
    int has_facets = (m.facet_a & m.facet_b & OVOID_MANIFOLD_KIND) == OVOID_MANIFOLD_FACET;
    if (ovoid_manifold_compute_polygon(pair, &m, o, &polygon) != OVOID_OK || polygon.count < 3 || !has_facets) return;
    polygon.points[0].point_a.x += 1e-3;
    CHECK(judge_verify_contact(context, pair, &contact, NULL) != OVOID_OK);
    polygon.points[0].point_a.x -= 1e-3;
    double inner = polygon.inner;
    polygon.inner = polygon.outer * (1 + 1e-12) + 1e-15;
    CHECK(judge_verify_contact(context, pair, &contact, NULL) != OVOID_OK);
    polygon.inner = inner;
    double outer = polygon.outer;
    polygon.outer = inner * (1 - 1e-12) - 1e-15;
    CHECK(judge_verify_contact(context, pair, &contact, NULL) != OVOID_OK);
    polygon.outer = outer;
    m.lower += 1e-9;
    // The features of a cylinder's polyhedron do not show the largest gap of the cylinder itself, which the judge
    // knows.
    int is_round = ovoid_shape_get_round(pair->shape_a).kind != OVOID_ROUND_NONE ||
                   ovoid_shape_get_round(pair->shape_b).kind != OVOID_ROUND_NONE;
    if (!is_round) CHECK(judge_verify_contact(context, pair, &contact, NULL) != OVOID_OK);
}

int main(int argc, char **argv) {
    static const double tolerances[4] = {0, 1e-3, 0.3, 1e-3};
    double wanted = 2000;
    const test_option options[] = {{"contacts", "ends after so many (2000)", NULL, &wanted, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, argc, argv);
    if (code >= 0) return code;
    judge *context = judge_create();
    uint64_t s = 1;
    for (int i = 0; i < SHAPES; i++) shapes[i] = create(i % KINDS, &s);
    for (uint64_t seed = 1; (double)judged < wanted && check_failed < 20; seed++) {
        s = check_seed = seed;
        ovoid_pair pair = {shapes[random_next(&s) % SHAPES],
                           shapes[random_next(&s) % SHAPES],
                           {{0, 0, 0}, {0, 0, 0, 0}},
                           {{0, 0, 0}, {0, 0, 0, 0}}};
        place(&pair, &s);
        ovoid_manifold_options o = {.margin = seed % 3 ? pow(10, random_uniform(&s, -4, -1)) : 10,
                                    .tolerance = tolerances[seed % 4]};
        // What moves by more than its tolerance is searched again; at a large one, features are kept past their time.
        double step = tolerances[seed % 4] > 0.01 ? 0.02 : 1e-4;
        ovoid_manifold m = {0};
        for (int frame = 0; frame < FRAMES; frame++) {
            m = ovoid_manifold_find(&pair, &o, &m);
            judge_one(context, &pair, &o, &m);
            if (seed <= 100) check_judge(context, &pair, &o, m);
            pair.pose_b.position.x += step * random_normal(&s);
            pair.pose_b.position.z += step * random_normal(&s);
            pair.pose_b.rotation.y += step * random_normal(&s);
        }
    }
    check_seed = 0;
    printf("%ld contacts judged, %ld of them polygons\n", judged, polygons);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    judge_destroy(context);
    return check_end();
}
