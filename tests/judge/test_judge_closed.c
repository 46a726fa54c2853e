// Spheres, capsules and boxes among one another, every answer put before the exact judge (GMP), which trusts nothing
// but the vertices and the poses, and before ovoid_answer_verify. Truth: exact arithmetic; no tolerance is involved but
// the judge's for witness points (their rounding). The pairs: of sizes from 1e-9 to 1e9, one small beside the other,
// needles and plates, points and segments without a radius, capsules of no length; anywhere, of the same axes, turned
// from these by 1e-17 to 1e-3, on a grid (concentric, flush, one behind the other), and moved along the normal until
// they touch to some digits.
//   --pairs N   so many pairs, three answers each; default 400
//   --seed N
#include "check.h"
#include "judge.h"
#include "options.h"
#include "ovoid/ovoid.h"
#include "places.h"
#include "proofs/covers.h"

static judge *court;

static double random_log(uint64_t *r, double low, double high) {
    return low * exp(random_uniform(r, 0, 1) * log(high / low));
}
static unsigned random_below(uint64_t *r, unsigned count) {
    return (unsigned)(random_uniform(r, 0, 1) * count) % count;
}
static ovoid_vec3 random_place(uint64_t *r, double size) {
    double x = random_normal(r), y = random_normal(r), z = random_normal(r);
    return (ovoid_vec3){size * x, size * y, size * z};
}
enum { SPHERE, CAPSULE, BOX, KINDS };

static ovoid_shape *make_shape(uint64_t *r, double size, unsigned *kind) {
    double radius = random_below(r, 3) ? size * random_log(r, 1e-6, 2) : 0, x = size * random_log(r, 1e-4, 1);
    double y = size * random_log(r, 1e-3, 1), points[6];
    const ovoid_shape_options rounded = {.radius = radius};
    for (int i = 0; i < 6; i++) points[i] = x * random_normal(r);
    switch (random_below(r, 6)) {
    case 0: return *kind = SPHERE, ovoid_shape_create_sphere(radius, NULL, NULL);
    case 1: return *kind = SPHERE, ovoid_shape_create_from_points(points, 1, &rounded, NULL);
    case 2: return *kind = CAPSULE, ovoid_shape_create_capsule(radius, random_below(r, 4) ? x : 0, NULL, NULL);
    case 3: return *kind = CAPSULE, ovoid_shape_create_from_points(points, 2, &rounded, NULL);
    case 4: return *kind = BOX, ovoid_shape_create_box((ovoid_vec3){size, x, y}, NULL, NULL);
    default: return *kind = BOX, ovoid_shape_create_box((ovoid_vec3){x, x, size}, &rounded, NULL);
    }
}

static double get_size(const ovoid_shape *s) {
    return ovoid_shape_get_measures(s).sphere_radius + ovoid_shape_get_radius(s);
}

static void place(uint64_t *r, ovoid_pair *p) {
    double size = get_size(p->shape_a) + get_size(p->shape_b);
    const double far[6] = {2, 0.6, 0.3, 0.15, 0.03, 0};
    ovoid_vec3 d = random_place(r, size * far[random_below(r, 6)]);
    p->pose_a = (ovoid_pose){random_place(r, size), random_quat(r)};
    p->pose_b = (ovoid_pose){p->pose_a.position, random_quat(r)};
    unsigned how = random_below(r, 8);
    if (how < 3) p->pose_b.rotation = p->pose_a.rotation;
    if (how == 1) p->pose_b.rotation.y += random_log(r, 1e-17, 1e-3);
    if (how == 2) {
        p->pose_a = (ovoid_pose){{0, 0, 0}, {1, 0, 0, 0}};
        p->pose_b = (ovoid_pose){{0, 0, 0}, {1, random_below(r, 2), 0, 0}};
        double step = get_size(random_below(r, 2) ? p->shape_a : p->shape_b) / 2;
        d = (ovoid_vec3){step * random_below(r, 3), step * random_below(r, 3), step * random_below(r, 3)};
    }
    ovoid_vec3 *to = &p->pose_b.position;
    *to = (ovoid_vec3){to->x + d.x, to->y + d.y, to->z + d.z};
    if (random_below(r, 3)) return;
    // Along the normal until they touch, nearly.
    for (int k = 0; k < 2; k++) {
        ovoid_answer x = ovoid_depth(p, NULL, NULL, NULL);
        double part = k == 0 || random_below(r, 2) ? 0 : (random_below(r, 2) ? 1 : -1) * random_log(r, 1e-16, 0.05);
        double way = size * part - (x.lower + x.upper) / 2;
        *to = (ovoid_vec3){to->x + x.normal.x * way, to->y + x.normal.y * way, to->z + x.normal.z * way};
    }
}

// has_points: they are at the stated distance. Not so of the stage REFINE, which knows the depth of bodies that touch
// better than doubles say where.
static void put(const ovoid_pair *p, const ovoid_answer *answer, const ovoid_cover *cover, int has_points) {
    ovoid_error error = {0};
    const ovoid_answer_basis basis = {.cover = cover};
    if (!CHECK(judge_verify_answer(court, p, answer, cover, &error) == OVOID_OK))
        printf("the judge: %s\n", error.message);
    if (has_points && !CHECK(judge_verify_points(court, p, answer, &error) == OVOID_OK))
        printf("the judge: points: %s; stage %s, %s, from %.17g to %.17g\n", error.message,
               ovoid_stage_get_name(answer->stage), ovoid_status_get_name(answer->status), answer->lower,
               answer->upper);
    if (!CHECK(ovoid_answer_verify(p, answer, &basis, &error) == OVOID_OK)) printf("verify: %s\n", error.message);
}

static void run(uint64_t seed, uint64_t pairs) {
    static const char *const names[KINDS] = {"sphere", "capsule", "box"};
    STATIC_COVER(cover);
    const double sizes[4] = {1e-9, 1, 1, 1e9};
    uint64_t r = seed, count[KINDS][KINDS] = {{0}}, closed[KINDS][KINDS] = {{0}}, open = 0;
    for (uint64_t i = 0; i < pairs; i++) {
        check_seed = i;
        unsigned a, b;
        double size = sizes[random_below(&r, 4)];
        ovoid_shape *x = make_shape(&r, size, &a),
                    *y = make_shape(&r, random_below(&r, 4) ? size : sizes[random_below(&r, 4)], &b);
        ovoid_pair p = {x, y, {{0, 0, 0}, {1, 0, 0, 0}}, {{0, 0, 0}, {1, 0, 0, 0}}};
        if (CHECK(x && y)) {
            place(&r, &p);
            ovoid_answer hit = ovoid_collide(&p, NULL, NULL), apart = ovoid_distance(&p, NULL, NULL),
                         depth = ovoid_depth(&p, NULL, NULL, &cover);
            put(&p, &hit, NULL, 0);
            put(&p, &apart, NULL, apart.status == OVOID_SEPARATED && apart.stage != OVOID_STAGE_REFINE);
            put(&p, &depth, &cover, depth.stage != OVOID_STAGE_REFINE);
            open += hit.status == OVOID_UNDECIDED;
            unsigned low = a < b ? a : b, high = a < b ? b : a;
            count[low][high]++;
            closed[low][high] += apart.stage == OVOID_STAGE_SUPPORT && apart.iterations == 0;
        }
        ovoid_shape_destroy(x);
        ovoid_shape_destroy(y);
        judge_forget(court);
    }
    for (int a = 0; a < KINDS; a++)
        for (int b = a; b < KINDS; b++)
            printf("%-8s%-8s %8llu pairs, %8llu distances in closed form\n", names[a], names[b],
                   (unsigned long long)count[a][b], (unsigned long long)closed[a][b]);
    CHECK_EQ(open, 0u);
}

int main(int count, char **arguments) {
    uint64_t seed = 1, pairs = 400;
    const test_option options[] = {{"pairs", "so many pairs", &pairs, NULL, NULL, NULL},
                                   {"seed", "of the pairs", &seed, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    court = judge_create();
    if (CHECK(court != NULL)) run(seed, pairs);
    judge_destroy(court);
    return check_end();
}
