// Answers about solids before the exact judge and beside brute force. Truth: the judge decides each answer by its proof
// in rational arithmetic (judge/solid.c); and all pairs of triangles in extended precision give the surfaces' distance,
// solid angles what is inside. Long double has 11 bits more than double, so that distance is trusted to 1e-15 of the
// size; no answer may leave it, and beyond the tolerance of 1e-9 of the size none may be open.
//
// test_judge_solid [--answers N] [--seconds N] [--seed N] [--family N]: `make soak-solid` asks for a million answers.
#include "judge.h"
#include "options.h"
#include "solids.h"

#include <time.h>

enum { CAPACITY = 60000 };
static ovoid_exclusion items[CAPACITY];
static judge *court;

// ---- the families

/// A pair of meshes at their poses, and the largest coordinate that rounding enters by.
typedef struct sample {
    mesh a, b;
    ovoid_pose pose_a, pose_b;
    double size;
    int is_hull;              ///< b is a shape, the hull of its mesh's points
    int is_open_a, is_open_b; ///< without an inside
} sample;

static uint32_t random_count(uint64_t *s, uint32_t least, uint32_t most) {
    return least + (uint32_t)(random_next(s) % (most - least + 1));
}

// One draw after another, so that a seed makes the same pairs from every compiler.
static void add_any(mesh *m, double size, uint64_t *s) {
    uint64_t kind = random_next(s) % 3;
    double width = random_uniform(s, 0.1, 0.5), height = random_uniform(s, 0.05, 1);
    uint32_t u = random_count(s, 3, 7), v = random_count(s, 3, 5);
    if (kind == 0)
        mesh_add_angle(m, size, size * width, size * height);
    else if (kind == 1)
        mesh_add_ring(m, size, size * width, u + 1, v, 0.3, s);
    else
        mesh_add_star(m, (ovoid_vec3){0, 0, 0}, size, v, u, 0.7, s);
}

static void stretch(mesh *m, double x, double y, double z) {
    for (size_t i = 0; i < m->points; i++) m->xyz[3 * i] *= x, m->xyz[3 * i + 1] *= y, m->xyz[3 * i + 2] *= z;
}

// On a lattice of eighths.
static void round_points(mesh *m) {
    for (size_t i = 0; i < 3 * m->points; i++) m->xyz[i] = rint(8 * m->xyz[i]) / 8;
}

static void turn_over(mesh *m, size_t from) {
    for (size_t t = from; t < m->triangles; t++) {
        uint32_t *v = m->indices + 3 * t, kept = v[1];
        v[1] = v[2], v[2] = kept;
    }
}

static void place(sample *x, double far, double apart, uint64_t *s) {
    x->pose_a.position = random_vec3(s, far);
    x->pose_a.rotation = random_quat(s);
    x->pose_b.position = random_vec3(s, apart);
    x->pose_b.rotation = random_quat(s);
    ovoid_vec3 at = x->pose_a.position;
    x->pose_b.position.x += at.x, x->pose_b.position.y += at.y, x->pose_b.position.z += at.z;
}

static void make_any(sample *x, uint64_t *s) {
    add_any(&x->a, 1, s);
    add_any(&x->b, random_uniform(s, 0.3, 1.5), s);
    place(x, 1, random_uniform(s, 0, 2.5), s);
}

static void make_hull(sample *x, uint64_t *s) {
    add_any(&x->a, 1, s);
    double size = random_uniform(s, 0.05, 1);
    mesh_add_star(&x->b, (ovoid_vec3){0, 0, 0}, size, 3, random_count(s, 3, 6), 0.2, s);
    place(x, 1, random_uniform(s, 0, 2), s);
    x->is_hull = 1;
}

static void make_rings(sample *x, uint64_t *s) {
    uint32_t around = random_count(s, 5, 9);
    mesh_add_ring(&x->a, 1, 0.2, around, random_count(s, 3, 5), 0, s);
    around = random_count(s, 5, 9);
    mesh_add_ring(&x->b, 1, 0.2, around, random_count(s, 3, 5), 0, s);
    place(x, 1, 1.2, s);
}

// A hollow ball, and what may be in its hollow, in its wall, through it or outside.
static void make_shells(sample *x, uint64_t *s) {
    mesh_add_star(&x->a, (ovoid_vec3){0, 0, 0}, 1, 4, 6, 0, s);
    size_t outer = x->a.triangles;
    mesh_add_star(&x->a, (ovoid_vec3){0, 0, 0}, random_uniform(s, 0.3, 0.9), 4, 5, 0.1, s);
    if (random_next(s) % 4) turn_over(&x->a, outer);
    add_any(&x->b, random_uniform(s, 0.02, 0.5), s);
    place(x, 1, random_uniform(s, 0, 1), s);
}

static void add_comb(mesh *m, int teeth, uint64_t *s) {
    double width = random_uniform(s, 0.1, 0.4);
    for (int i = 0; i < teeth; i++) {
        uint32_t first = (uint32_t)m->points;
        mesh_add_angle(m, 1, width, 0.1);
        for (uint32_t k = first; k < m->points; k++) m->xyz[3 * k + 2] += 0.5 * i;
    }
}

// Teeth between teeth: components that interlock.
static void make_combs(sample *x, uint64_t *s) {
    add_comb(&x->a, 3, s);
    add_comb(&x->b, 2, s);
    x->pose_a = x->pose_b = ovoid_pose_make_identity();
    x->pose_b.position = random_vec3(s, 0.7);
    x->pose_b.position.z += 0.5;
    if (random_next(s) % 2) x->pose_b.rotation = (ovoid_quat){1, 0, 0, random_uniform(s, -0.2, 0.2)};
}

static void make_needles(sample *x, uint64_t *s) {
    add_any(&x->a, 1, s);
    add_any(&x->b, 1, s);
    double thin[4];
    for (int i = 0; i < 4; i++) thin[i] = exp(random_uniform(s, -7, 0));
    stretch(&x->a, 1, thin[0], thin[1]);
    stretch(&x->b, thin[2], 1, thin[3]);
    place(x, 1, random_uniform(s, 0, 1), s);
}

// Corners on a lattice, without turning: faces, edges and corners that touch, coincide, lie in one plane.
static void make_lattice(sample *x, uint64_t *s) {
    add_any(&x->a, 1, s);
    add_any(&x->b, 1, s);
    round_points(&x->a);
    round_points(&x->b);
    x->pose_a = x->pose_b = ovoid_pose_make_identity();
    ovoid_vec3 at = random_vec3(s, 1.5);
    x->pose_b.position = (ovoid_vec3){rint(8 * at.x) / 8, rint(8 * at.y) / 8, rint(8 * at.z) / 8};
}

// The same body twice: in one place, moved along an axis, or by a hair.
static void make_copies(sample *x, uint64_t *s) {
    uint64_t again = *s;
    add_any(&x->a, 1, s);
    add_any(&x->b, 1, &again);
    place(x, 1, 0, s);
    x->pose_b.rotation = x->pose_a.rotation;
    double by[4] = {0, 1e-14, 1e-6, 1};
    double most = by[random_next(s) % 4];
    x->pose_b.position.x += most * random_uniform(s, -2, 2);
}

static void make_contained(sample *x, uint64_t *s) {
    mesh_add_ring(&x->a, 1, 0.5, random_count(s, 5, 8), 4, 0.1, s);
    if (random_next(s) % 3 == 0) mesh_add_star(&x->a, (ovoid_vec3){0, 0, 0}, 0.4, 3, 4, 0.2, s);
    add_any(&x->b, random_uniform(s, 0.005, 0.1), s);
    place(x, 1, 0, s);
    ovoid_vec3 at = random_vec3(s, 0.8);
    at = (ovoid_vec3){at.x + 0.8, 0, 0.6 * at.z};
    x->pose_b.position = ovoid_pose_compute_point(&x->pose_a, at);
}

static void rescale(sample *x, double by) {
    stretch(&x->a, by, by, by);
    stretch(&x->b, by, by, by);
    ovoid_vec3 *at[2] = {&x->pose_a.position, &x->pose_b.position};
    for (int i = 0; i < 2; i++) at[i]->x *= by, at[i]->y *= by, at[i]->z *= by;
}

static void make_small(sample *x, uint64_t *s) { make_any(x, s), rescale(x, 1e-9), x->size = 5e-9; }
static void make_large(sample *x, uint64_t *s) { make_any(x, s), rescale(x, 1e9), x->size = 5e9; }

// Far from the world's origin, and far from the frames' own.
static void make_far(sample *x, uint64_t *s) {
    make_any(x, s);
    ovoid_vec3 by = random_vec3(s, 1e6);
    ovoid_vec3 *at[2] = {&x->pose_a.position, &x->pose_b.position};
    for (int i = 0; i < 2; i++) at[i]->x += by.x, at[i]->y += by.y, at[i]->z += by.z;
}

static void make_off_center(sample *x, uint64_t *s) {
    make_any(x, s);
    for (size_t i = 0; i < x->a.points; i++) x->a.xyz[3 * i] += 1000;
    x->pose_a.position = ovoid_pose_compute_point(&x->pose_a, (ovoid_vec3){-1000, 0, 0});
    x->size = 3000;
}

// Cubes on one grid, turned together: whatever meets is flush; of fine and coarse triangles.
static void make_cubes(sample *x, uint64_t *s) {
    cubes a = cubes_make(s), b = random_next(s) % 4 ? cubes_make(s) : a;
    mesh_add_cubes(&x->a, &a, random_next(s) % 8 ? 1 : 2);
    mesh_add_cubes(&x->b, &b, 1);
    ovoid_vec3 by = random_vec3(s, 2.5);
    double step = random_next(s) % 2 ? 1 : 2;
    ovoid_pose turn = {{0, 0, 0}, {1, 0, 0, 0}}, at = {{0, 0, 0}, {1, 0, 0, 0}};
    if (random_next(s) % 2) turn.rotation = random_quat(s);
    at.position = (ovoid_vec3){rint(step * by.x) / step, rint(step * by.y) / step, rint(step * by.z) / step};
    x->pose_a = turn;
    x->pose_b = ovoid_pose_compute_product(&turn, &at);
}

static void make_cubes_and_hull(sample *x, uint64_t *s) {
    make_cubes(x, s);
    mesh_clear(&x->b);
    cubes one = {{0}};
    int length = 1 + (int)(random_next(s) % 3);
    for (int i = 0; i < length; i++) one.is[i] = 1;
    mesh_add_cubes(&x->b, &one, 1);
    x->is_hull = 1;
}

// Without some of their triangles they are surfaces.
static void open_mesh(mesh *m, uint64_t *s) {
    size_t drop = 1 + random_next(s) % 4;
    m->triangles -= m->triangles > drop ? drop : 0;
}

static void make_open(sample *x, uint64_t *s) {
    if (random_next(s) % 3)
        make_any(x, s);
    else
        make_cubes(x, s);
    uint64_t which = random_next(s) % 3;
    if (which != 1) open_mesh(&x->a, s), x->is_open_a = 1;
    if (which != 0) open_mesh(&x->b, s), x->is_open_b = 1;
}

typedef struct family {
    const char *name;
    void (*make)(sample *x, uint64_t *s);
} family;

static const family families[] = {
    {"rings, angles, stars", make_any},
    {"with a convex shape", make_hull},
    {"linked rings", make_rings},
    {"hollow balls", make_shells},
    {"combs", make_combs},
    {"needles", make_needles},
    {"lattice", make_lattice},
    {"copies", make_copies},
    {"contained", make_contained},
    {"1e-9", make_small},
    {"1e9", make_large},
    {"1e6 from the origin", make_far},
    {"1000 from the frame", make_off_center},
    {"cubes on a grid", make_cubes},
    {"cubes and a box", make_cubes_and_hull},
    {"open", make_open},
};
enum { FAMILIES = sizeof families / sizeof *families };

// ---- one pair

typedef struct tally {
    long answers, apart, touching, overlapping, open, pairs, exclusions;
} tally;
static tally tallies[FAMILIES];

typedef struct inquiry {
    ovoid_body_pair pair;
    solid_truth truth;
    double slack, tolerance;
    tally *t;
    ovoid_exclusions all;
} inquiry;

static void judge_answer(inquiry *q, const ovoid_body_answer *x, int is_distance) {
    ovoid_error error = {.message = ""};
    solid_truth t = q->truth;
    q->t->answers++;
    q->t->exclusions += (long)q->all.count;
    q->t->apart += x->status == OVOID_SEPARATED;
    q->t->touching += x->status == OVOID_TOUCHING;
    q->t->overlapping += x->status == OVOID_OVERLAPPING;
    if (!CHECK_LE(q->all.count, q->all.capacity)) return;
    // A proof by a common point names no nearest ones.
    ovoid_proof_kind kind = x->deciding.proof.kind;
    int points = is_distance && kind != OVOID_PROOF_HULL && kind != OVOID_PROOF_INNER;
    if (!CHECK_EQ(judge_verify_solid(court, &q->pair, x, &q->all, points, &error), OVOID_OK))
        printf("  %s\n", error.message);
    // Within the slack of touching brute force does not know.
    if (t.surfaces > q->slack) CHECK(t.is_common ? x->status != OVOID_SEPARATED : x->status != OVOID_OVERLAPPING);
    if (t.surfaces <= 0 && x->status == OVOID_SEPARATED) CHECK_LE(x->lower, q->slack);
    if (!t.is_common) CHECK_LE(x->lower, t.surfaces + q->slack);
    if (!t.is_common) CHECK_LE(t.surfaces, x->upper + q->slack);
    if (t.is_common && t.surfaces > 0) CHECK_LE(x->deciding.lower, t.surfaces + q->slack);
    int is_open = x->status == OVOID_UNDECIDED && t.surfaces > q->tolerance;
    q->t->open += is_open;
    CHECK(!is_open);
}

static void ask(inquiry *q, uint64_t *s) {
    const ovoid_body_pair *pair = &q->pair;
    ovoid_body_answer x = ovoid_body_distance(pair, NULL, &(ovoid_body_evidence){.exclusions = &q->all});
    judge_answer(q, &x, 1);
    if (x.status == OVOID_SEPARATED) CHECK_LE(x.upper - x.lower, q->tolerance);
    ovoid_body_proof earlier = {x.part_a, x.part_b, x.deciding.proof};
    x = ovoid_body_distance(pair, NULL, &(ovoid_body_evidence){.earlier = &earlier, .exclusions = &q->all});
    judge_answer(q, &x, 1);
    x = ovoid_body_collide(pair, NULL, &(ovoid_body_evidence){.exclusions = &q->all});
    judge_answer(q, &x, 0);
    earlier.part_a = (uint32_t)(random_next(s) % 40), earlier.part_b = (uint32_t)(random_next(s) % 40);
    x = ovoid_body_collide(pair, NULL, &(ovoid_body_evidence){.earlier = &earlier, .exclusions = &q->all});
    judge_answer(q, &x, 0);
    double margin = q->truth.surfaces * random_uniform(s, 0.5, 2);
    x = ovoid_body_within(pair, margin, NULL, &(ovoid_body_evidence){.exclusions = &q->all});
    judge_answer(q, &x, 0);
    int is = ovoid_body_answer_is_within(&x, margin);
    if (!q->truth.is_common && q->truth.surfaces > margin + q->tolerance) CHECK_EQ(is, 0);
    if (q->truth.is_common || q->truth.surfaces < margin - q->tolerance)
        CHECK(is == 1 || q->truth.surfaces <= q->slack);
    ovoid_options options = {.cap = random_uniform(s, 0, 2) * q->truth.surfaces};
    if (q->truth.surfaces > q->slack) {
        x = ovoid_body_distance(pair, &options, &(ovoid_body_evidence){.exclusions = &q->all});
        judge_answer(q, &x, 0);
    }
    // The other way round.
    ovoid_body_pair turned = {pair->b, pair->a};
    q->pair = turned;
    x = ovoid_body_distance(&turned, NULL, &(ovoid_body_evidence){.exclusions = &q->all});
    judge_answer(q, &x, 1);
}

// The mesh of the hull of a mesh's points; the shape with it.
static ovoid_shape *make_hull_of(mesh *m) {
    ovoid_shape *shape = ovoid_shape_create_from_points(m->xyz, m->points, NULL, NULL);
    mesh hull = {NULL, NULL, 0, 0, 0, 0};
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    for (uint32_t k = 0; k < p.vertex_count; k++)
        mesh_add_point(&hull, p.vertices[3 * k] + p.origin.x, p.vertices[3 * k + 1] + p.origin.y,
                       p.vertices[3 * k + 2] + p.origin.z);
    for (uint32_t k = 0; k < p.triangle_count; k++)
        mesh_add_triangle(&hull, p.triangles[3 * k], p.triangles[3 * k + 1], p.triangles[3 * k + 2]);
    mesh_clear(m);
    *m = hull;
    return shape;
}

static void try_pair(size_t f, uint64_t seed) {
    uint64_t s = check_seed = seed;
    sample x = {.size = 5};
    families[f].make(&x, &s);
    ovoid_shape *shape = x.is_hull ? make_hull_of(&x.b) : NULL;
    ovoid_solid *a = mesh_make_solid(&x.a), *b = x.is_hull ? NULL : mesh_make_solid(&x.b);
    if (CHECK(a && (b || shape))) {
        double far = fabs(x.pose_a.position.x) + fabs(x.pose_a.position.y) + fabs(x.pose_a.position.z);
        inquiry q = {.pair = {{.solid = a, .pose = x.pose_a}, {.shape = shape, .pose = x.pose_b, .solid = b}},
                     .t = &tallies[f],
                     .slack = 1e-15 * (x.size + far)};
        q.tolerance = 1.01e-9 * (x.size + 1e-3 * far);
        q.all = (ovoid_exclusions){.items = items, .capacity = CAPACITY};
        q.truth = find_truth_of(&x.a, &x.pose_a, x.is_open_a, &x.b, &x.pose_b, x.is_open_b);
        q.t->pairs += (long)(x.a.triangles * x.b.triangles);
        ask(&q, &s);
    }
    judge_forget(court);
    ovoid_solid_destroy(a);
    ovoid_solid_destroy(b);
    ovoid_shape_destroy(shape);
    mesh_clear(&x.a);
    mesh_clear(&x.b);
}

// ---- the run

static void print_tallies(void) {
    tally all = {0, 0, 0, 0, 0, 0, 0};
    printf("%-24s %9s %9s %9s %11s %6s %13s %13s\n", "family", "answers", "apart", "touching", "overlapping", "open",
           "triangle pairs", "exclusions");
    for (size_t f = 0; f <= FAMILIES; f++) {
        const tally *t = f < FAMILIES ? &tallies[f] : &all;
        printf("%-24s %9ld %9ld %9ld %11ld %6ld %13ld %13ld\n", f < FAMILIES ? families[f].name : "all", t->answers,
               t->apart, t->touching, t->overlapping, t->open, t->pairs, t->exclusions);
        all = (tally){all.answers + t->answers,         all.apart + t->apart, all.touching + t->touching,
                      all.overlapping + t->overlapping, all.open + t->open,   all.pairs + t->pairs,
                      all.exclusions + t->exclusions};
    }
}

static long count_answers(void) {
    long sum = 0;
    for (size_t f = 0; f < FAMILIES; f++) sum += tallies[f].answers;
    return sum;
}

int main(int argc, char **argv) {
    double wanted = 800, seconds = INFINITY, seed = 20261123;
    uint64_t only = UINT64_MAX;
    const test_option options[] = {{"answers", "ends after so many (800)", NULL, &wanted, NULL, NULL},
                                   {"seconds", "ends after so long", NULL, &seconds, NULL, NULL},
                                   {"seed", "of the first pair", NULL, &seed, NULL, NULL},
                                   {"family", "a number: this one alone", &only, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, argc, argv);
    if (code >= 0) return code;
    court = judge_create();
    time_t start = time(NULL);
    for (uint64_t i = 0; court && (double)count_answers() < wanted && difftime(time(NULL), start) < seconds; i++)
        if (only == UINT64_MAX || only == i % FAMILIES) try_pair(i % FAMILIES, (uint64_t)seed + i);
    check_seed = 0;
    judge_destroy(court);
    print_tallies();
    printf("seed %.0f, %ld seconds\n", seed, (long)(time(NULL) - start));
    return check_end();
}
