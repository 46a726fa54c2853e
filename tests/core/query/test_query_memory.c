// Depths that fill the search's own memory and go on in the caller's: round bodies with nearly one centre. Truth: the
// verifier, which measures the cover again; the bracket of ovoid_depth, which is true and wide and holds the depth too;
// where its memory suffices, the bits of a depth without memory. A cover that is altered field by field must be
// refused.
#include "check.h"
#include "linear/vec3.h"
#include "ovoid/body.h"
#include "ovoid/manifold.h"
#include "ovoid/smooth.h"
#include "proofs/covers.h"

/// Points to rounding on a sphere of radius 1, none with a partner on the other side: in even steps, or at random.
static ovoid_shape *make_ball(uint32_t count, int is_even, double radius) {
    double *points = malloc(3 * sizeof *points * count);
    uint64_t s = count;
    for (uint32_t i = 0; i < count; i++) {
        double at = is_even ? (i + 0.5) / count : random_share(&s), turn = is_even ? 0.3819660112501051 * i : 0;
        if (!is_even) turn = random_share(&s);
        double z = 2 * at - 1, r = sqrt(1 - z * z);
        points[3 * i] = r * cos(6.283185307179586 * turn);
        points[3 * i + 1] = r * sin(6.283185307179586 * turn);
        points[3 * i + 2] = z;
    }
    ovoid_shape *shape = ovoid_shape_create_from_points(points, count, &(ovoid_shape_options){.radius = radius}, NULL);
    free(points);
    return shape;
}

static ovoid_pose make_pose(uint64_t *s, double offset) {
    ovoid_pose pose = {{offset * random_normal(s), offset * random_normal(s), offset * random_normal(s)},
                       {random_normal(s), random_normal(s), random_normal(s), random_normal(s)}};
    return pose;
}

static ovoid_cover make_cover(uint32_t points) {
    ovoid_cover cover = {.size = ovoid_cover_get_size(points)};
    cover.memory = malloc(cover.size);
    return cover;
}

/// A triangle of a cover in memory of one's own.
static uint16_t *own_triangle(const ovoid_cover *cover, uint32_t i) { return ((uint16_t(*)[3])cover->triangles)[i]; }

static int is_proven(const ovoid_pair *pair, const ovoid_answer *x, const ovoid_cover *cover) {
    return ovoid_answer_verify(pair, x, &(ovoid_answer_basis){.cover = cover}, NULL) == OVOID_OK;
}

/// The same bits; the structs have no padding between what is compared.
static int is_same(const ovoid_answer *x, const ovoid_answer *y) {
    return x->status == y->status && x->limit == y->limit && x->stage == y->stage && x->iterations == y->iterations &&
           memcmp(&x->lower, &y->lower, 2 * sizeof(double) + 3 * sizeof(vec3)) == 0;
}

// ---- pairs that fill the search's own memory

/// What memory makes of a pair that fills 512 points.
static void check_pair(const ovoid_pair *pair, ovoid_cover *memory) {
    ovoid_answer few = ovoid_depth(pair, NULL, NULL, NULL), x = ovoid_depth(pair, NULL, NULL, memory);
    CHECK_EQ((int)few.limit, (int)OVOID_LIMIT_CAPACITY);
    CHECK_EQ((int)x.limit, (int)OVOID_LIMIT_NONE);
    CHECK_EQ((int)x.status, (int)OVOID_OVERLAPPING);
    CHECK(memory->point_count > OVOID_COVER_POINTS);
    CHECK_LE(few.lower, x.upper);
    CHECK_LE(x.lower, few.upper);
    CHECK(is_proven(pair, &x, memory));
    CHECK(!is_proven(pair, &x, NULL));
    // The points say the same as the bracket: to the tolerance of the size, 1e-9 of some 4, and rounding.
    vec3 off = vec3_sub(vec3_sub(x.point_b, x.point_a), vec3_scale(x.normal, x.lower));
    CHECK_LE(vec3_norm(off), 8e-9);
    ovoid_answer warm = ovoid_depth(pair, NULL, &x.proof, memory);
    CHECK_EQ((int)warm.limit, (int)OVOID_LIMIT_NONE);
    CHECK(is_proven(pair, &warm, memory));
}

static void check_full(void) {
    static const struct {
        uint32_t count;
        int is_even;
        double offset, radius;
    } cases[] = {{642, 1, 0, 0}, {642, 1, 1e-9, 0.25}, {1500, 1, 1e-3, 0}, {2562, 1, 0, 0.5}, {4096, 0, 1e-3, 0}};
    ovoid_cover memory = make_cover(OVOID_COVER_POINTS_MAX);
    uint64_t s = 3;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ovoid_shape *a = make_ball(cases[i].count, cases[i].is_even, 0),
                    *b = make_ball(cases[i].count + 7, cases[i].is_even, cases[i].radius);
        check_seed = s;
        ovoid_pair pair = {a, b, make_pose(&s, 0), make_pose(&s, cases[i].offset)};
        check_pair(&pair, &memory);
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    free(memory.memory);
}

/// Memory for fewer points than the pair needs narrows the bracket, and its limit stays; any alignment will do.
static void check_some(void) {
    ovoid_shape *a = make_ball(1500, 1, 0);
    ovoid_pair pair = {a, a, ovoid_pose_make_identity(), {{0, 0, 0}, {0.3, 0.4, 0.5, 0.7}}};
    ovoid_answer few = ovoid_depth(&pair, NULL, NULL, NULL);
    ovoid_cover memory = make_cover(1000);
    char *data = memory.memory;
    for (size_t at = 0; at < 64; at += 21) {
        memory.memory = data + at;
        memory.size = ovoid_cover_get_size(1000) - at;
        ovoid_answer x = ovoid_depth(&pair, NULL, NULL, &memory);
        CHECK_EQ((int)x.limit, (int)OVOID_LIMIT_CAPACITY);
        CHECK_LE(990, memory.point_count);
        CHECK_LE(memory.point_count, 1000);
        CHECK_LE(x.upper - x.lower, 0.75 * (few.upper - few.lower));
        CHECK(is_proven(&pair, &x, &memory));
    }
    // A limit of iterations that the caller gives is kept.
    memory.memory = data;
    memory.size = ovoid_cover_get_size(1000);
    ovoid_answer x = ovoid_depth(&pair, &(ovoid_options){.iterations = 700}, NULL, &memory);
    CHECK_EQ((int)x.limit, (int)OVOID_LIMIT_ITERATIONS);
    CHECK(is_proven(&pair, &x, &memory));
    free(data);
    ovoid_shape_destroy(a);
}

// ---- pairs that do not

/// Bodies far apart, near, in contact and deep in one another: the bits and the cover of ovoid_depth.
static void check_same(void) {
    ovoid_shape *shapes[4] = {make_ball(8, 0, 0), make_ball(100, 1, 0.1), make_ball(300, 1, 0),
                              ovoid_shape_create_box((ovoid_vec3){1, 2, 3}, NULL, NULL)};
    ovoid_cover memory = make_cover(0);
    uint64_t s = 11;
    STATIC_COVER(cover);
    for (int i = 0; i < 400; i++) {
        check_seed = s;
        ovoid_pair pair = {shapes[i % 4], shapes[i / 4 % 4], make_pose(&s, 0), make_pose(&s, i % 5 * 0.5)};
        ovoid_answer x = ovoid_depth(&pair, NULL, NULL, &cover), y = ovoid_depth(&pair, NULL, NULL, &memory);
        const ovoid_cover *large = &memory;
        CHECK(is_same(&x, &y));
        CHECK_EQ(large->point_count, cover.point_count);
        CHECK_EQ(large->triangle_count, cover.triangle_count);
        if (large->point_count != cover.point_count || large->triangle_count != cover.triangle_count) continue;
        CHECK(memcmp(large->a, cover.a, cover.point_count * sizeof *cover.a) == 0);
        CHECK(memcmp(large->b, cover.b, cover.point_count * sizeof *cover.b) == 0);
        CHECK(memcmp(large->triangles, cover.triangles, cover.triangle_count * sizeof *cover.triangles) == 0);
        CHECK(is_proven(&pair, &y, large));
    }
    free(memory.memory);
    for (int i = 0; i < 4; i++) ovoid_shape_destroy(shapes[i]);
}

/// A depth of bodies and a contact are refused as a depth is; the refusals claim nothing and are accepted.
static void check_refused_body(const ovoid_pair *pair, ovoid_cover *none) {
    const ovoid_body_pair bodies = {{.shape = pair->shape_a, .pose = pair->pose_a},
                                    {.shape = pair->shape_a, .pose = pair->pose_a}};
    ovoid_exclusions all = {.cover = none};
    ovoid_body_answer x = ovoid_body_depth(&bodies, NULL, &(ovoid_body_evidence){.exclusions = &all});
    CHECK_EQ((int)x.limit, (int)OVOID_LIMIT_MEMORY);
    CHECK(ovoid_body_verify(&bodies, &x, NULL, NULL) == OVOID_OK);
    x.upper = x.deciding.upper = 1;
    CHECK(ovoid_body_verify(&bodies, &x, NULL, NULL) != OVOID_OK);
    const ovoid_pair same = {pair->shape_a, pair->shape_a, pair->pose_a, pair->pose_a};
    const ovoid_manifold_options o = {.cover = none};
    ovoid_manifold m = ovoid_manifold_find(&same, &o, NULL);
    CHECK(m.limit == OVOID_LIMIT_MEMORY && m.lower == -INFINITY && m.upper == INFINITY);
}

static void check_refused(void) {
    ovoid_shape *a = make_ball(8, 0, 0);
    ovoid_pair pair = {a, a, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    ovoid_cover memory = make_cover(OVOID_COVER_POINTS), none = {.size = memory.size}, small = memory;
    small.size--;
    ovoid_answer x[2] = {ovoid_depth(&pair, NULL, NULL, &none), ovoid_depth(&pair, NULL, NULL, &small)};
    for (int i = 0; i < 2; i++) {
        CHECK(strcmp(ovoid_limit_get_name(x[i].limit), "memory") == 0);
        CHECK_EQ((int)x[i].status, (int)OVOID_UNDECIDED);
        CHECK(x[i].lower == -INFINITY && x[i].upper == INFINITY);
        CHECK(is_proven(&pair, &x[i], NULL));
        x[i].upper = 1;
        CHECK(!is_proven(&pair, &x[i], NULL));
    }
    CHECK_EQ((int)ovoid_depth(&pair, NULL, NULL, &memory).limit, (int)OVOID_LIMIT_NONE);
    // What a depth refuses is refused here, and leaves no cover.
    pair.pose_b.position.x = NAN;
    CHECK_EQ((int)ovoid_depth(&pair, NULL, NULL, &memory).limit, (int)OVOID_LIMIT_POSE_B);
    CHECK_EQ(memory.point_count, 0);
    CHECK_EQ(ovoid_cover_get_size(0), ovoid_cover_get_size(OVOID_COVER_POINTS));
    CHECK(ovoid_cover_get_size(OVOID_COVER_POINTS + 1) > ovoid_cover_get_size(OVOID_COVER_POINTS));
    CHECK(ovoid_cover_get_size(OVOID_COVER_POINTS_MAX) > 0);
    CHECK_EQ(ovoid_cover_get_size(OVOID_COVER_POINTS_MAX + 1), 0);
    check_refused_body(&pair, &none);
    free(memory.memory);
    ovoid_shape_destroy(a);
}

// ---- parts of bodies

enum { BALLS = 6 };

/// Balls beside one another, in pairs with nearly the same depth: whichever is asked first, another one may be deeper,
/// while the large cover of the first is in the memory. Truth: the verifier, and the deepest pair asked alone.
static void check_parts(uint32_t points, int is_enough) {
    ovoid_shape *ball = make_ball(642, 1, 0);
    ovoid_posed_shape a[BALLS], b[BALLS];
    uint64_t s = 41;
    double deepest = INFINITY;
    ovoid_cover cover = make_cover(points);
    for (int i = 0; i < BALLS; i++) {
        a[i] = (ovoid_posed_shape){ball, make_pose(&s, 0)};
        b[i] = (ovoid_posed_shape){ball, make_pose(&s, 1e-4)};
        a[i].pose.position.x += 5 * i;
        b[i].pose.position.x += 5 * i;
        ovoid_answer x =
            ovoid_depth(&(ovoid_pair){ball, ball, a[i].pose, b[i].pose}, NULL, NULL, is_enough ? &cover : NULL);
        deepest = fmin(deepest, x.upper);
    }
    ovoid_body_pair pair = {
        .a = {.compound = ovoid_compound_create(a, BALLS, NULL, NULL), .pose = ovoid_pose_make_identity()},
        .b = {.compound = ovoid_compound_create(b, BALLS, NULL, NULL), .pose = ovoid_pose_make_identity()}};
    ovoid_exclusions all = {.grows = 1, .cover = &cover};
    ovoid_body_answer x = ovoid_body_depth(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    // Where the memory ends while a point is joined, the limit is PRECISION.
    CHECK((x.limit == OVOID_LIMIT_NONE) == is_enough);
    CHECK(cover.point_count > OVOID_COVER_POINTS);
    if (is_enough) CHECK_NEAR(x.upper, deepest, 1e-8);
    CHECK(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, NULL) == OVOID_OK);
    ovoid_exclusions_release(&all);
    free(cover.memory);
    ovoid_compound_destroy((ovoid_compound *)pair.a.compound);
    ovoid_compound_destroy((ovoid_compound *)pair.b.compound);
    ovoid_shape_destroy(ball);
}

// ---- contacts and gradients

static void check_others(void) {
    ovoid_shape *a = make_ball(700, 1, 0);
    ovoid_pair pair = {a, a, ovoid_pose_make_identity(), {{0, 0, 0}, {0.3, 0.4, 0.5, 0.7}}};
    ovoid_cover cover = make_cover(4000);
    const ovoid_manifold_options o = {.cover = &cover};
    ovoid_manifold m = ovoid_manifold_find(&pair, &o, NULL);
    CHECK(m.upper - m.lower < 1e-8 && m.limit == OVOID_LIMIT_NONE);
    CHECK(ovoid_manifold_verify(&pair, &m, &o, NULL) == OVOID_OK);
    if (m.proof == OVOID_MANIFOLD_PROOF_SEARCH) CHECK(ovoid_manifold_verify(&pair, &m, NULL, NULL) != OVOID_OK);
    ovoid_answer x = ovoid_depth(&pair, NULL, NULL, &cover);
    ovoid_gradient g = ovoid_answer_compute_gradient(&pair, &x, &cover);
    CHECK(cover.point_count > OVOID_COVER_POINTS && g.has_translation && g.turn < 1e-2);
    // A triangle of the last point and one that is not there.
    own_triangle(&cover, 5)[1] = (uint16_t)cover.point_count;
    CHECK(!ovoid_answer_compute_gradient(&pair, &x, &cover).has_translation);
    free(cover.memory);
    ovoid_shape_destroy(a);
}

// ---- a liar

typedef struct lie {
    ovoid_pair pair;
    ovoid_answer answer;
    ovoid_cover cover;
    uint32_t *a, *b;
    uint16_t (*triangles)[3];
} lie;

static void check_lie(const lie *l) { CHECK(!is_proven(&l->pair, &l->answer, &l->cover)); }

static void alter(lie *l, uint64_t *s) {
    uint32_t i = (uint32_t)(random_next(s) % l->cover.triangle_count), k = (uint32_t)(random_next(s) % 3);
    uint16_t *v = l->triangles[i], kept = v[k];
    // A corner that is another one, or none; a triangle that is turned.
    v[k] = (uint16_t)((kept + 1 + random_next(s) % (l->cover.point_count - 1)) % l->cover.point_count);
    check_lie(l);
    v[k] = (uint16_t)(l->cover.point_count + random_next(s) % 1000);
    check_lie(l);
    v[k] = kept;
    uint16_t swapped = v[0];
    v[0] = v[1];
    v[1] = swapped;
    check_lie(l);
    v[1] = v[0];
    v[0] = swapped;
    // A point of no vertex.
    uint32_t *of = k ? l->a : l->b, p = (uint32_t)(random_next(s) % l->cover.point_count), vertex = of[p];
    of[p] = ovoid_shape_get_polytope(l->pair.shape_a).vertex_count;
    check_lie(l);
    of[p] = vertex;
}

static void check_liar(void) {
    ovoid_shape *a = make_ball(2000, 1, 0);
    lie l = {.pair = {a, a, ovoid_pose_make_identity(), {{0, 0, 0}, {0.1, 0.4, -0.5, 0.7}}}};
    ovoid_cover memory = make_cover(8000);
    l.answer = ovoid_depth(&l.pair, NULL, NULL, &memory);
    l.cover = memory;
    l.a = (uint32_t *)l.cover.a;
    l.b = (uint32_t *)l.cover.b;
    l.triangles = (uint16_t(*)[3])l.cover.triangles;
    CHECK(is_proven(&l.pair, &l.answer, &l.cover));
    uint64_t s = 29;
    for (int i = 0; i < 25; i++) {
        check_seed = s;
        alter(&l, &s);
    }
    CHECK(is_proven(&l.pair, &l.answer, &l.cover));
    ovoid_cover whole = l.cover;
    l.cover.triangle_count--;
    check_lie(&l);
    l.cover.triangle_count = 2 * OVOID_COVER_POINTS_MAX + 1;
    check_lie(&l);
    l.cover = whole;
    l.cover.point_count = OVOID_COVER_POINTS_MAX + 1;
    check_lie(&l);
    l.cover.point_count = l.cover.triangle_count = 0;
    check_lie(&l);
    l.cover = whole;
    l.answer.upper = nextafter(l.answer.upper, -INFINITY) - 1e-12;
    check_lie(&l);
    free(memory.memory);
    ovoid_shape_destroy(a);
}

int main(void) {
    check_full();
    check_some();
    check_same();
    check_refused();
    check_parts(OVOID_COVER_POINTS_MAX, 1);
    check_parts(1800, 1);
    check_parts(700, 0);
    check_others();
    check_liar();
    return check_end();
}
