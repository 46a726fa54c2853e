// Depths that fill the search's own memory and go on in the caller's: round bodies with nearly one centre. Truth: the
// verifier, which measures the cover again; the bracket of ovoid_depth, which is true and wide and holds the depth too;
// where its memory suffices, the bits of ovoid_depth. A cover that is altered field by field must be refused.
#include "check.h"
#include "linear/vec3.h"
#include "ovoid/query.h"

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

static ovoid_depth_memory make_memory(uint32_t points) {
    ovoid_depth_memory memory = {.size = ovoid_depth_get_memory_size(points)};
    memory.data = malloc(memory.size);
    return memory;
}

static int is_proven(const ovoid_pair *pair, const ovoid_answer *x, const ovoid_large_cover *cover) {
    return ovoid_answer_verify(pair, x, &(ovoid_answer_basis){.large_cover = cover}, NULL) == OVOID_OK;
}

/// The same bits; the structs have no padding between what is compared.
static int is_same(const ovoid_answer *x, const ovoid_answer *y) {
    return x->status == y->status && x->limit == y->limit && x->stage == y->stage && x->iterations == y->iterations &&
           memcmp(&x->lower, &y->lower, 2 * sizeof(double) + 3 * sizeof(vec3)) == 0;
}

// ---- pairs that fill the search's own memory

/// What memory makes of a pair that fills 512 points.
static void check_pair(const ovoid_pair *pair, ovoid_depth_memory *memory) {
    ovoid_answer few = ovoid_depth(pair, NULL, NULL, NULL), x = ovoid_depth_with(pair, NULL, NULL, memory);
    CHECK_EQ((int)few.limit, (int)OVOID_LIMIT_CAPACITY);
    CHECK_EQ((int)x.limit, (int)OVOID_LIMIT_NONE);
    CHECK_EQ((int)x.status, (int)OVOID_OVERLAPPING);
    CHECK(memory->cover.point_count > OVOID_COVER_POINTS);
    CHECK_LE(few.lower, x.upper);
    CHECK_LE(x.lower, few.upper);
    CHECK(is_proven(pair, &x, &memory->cover));
    CHECK(!is_proven(pair, &x, NULL));
    // The points say the same as the bracket: to the tolerance of the size, 1e-9 of some 4, and rounding.
    vec3 off = vec3_sub(vec3_sub(x.point_b, x.point_a), vec3_scale(x.normal, x.lower));
    CHECK_LE(vec3_norm(off), 8e-9);
    ovoid_answer warm = ovoid_depth_with(pair, NULL, &x.proof, memory);
    CHECK_EQ((int)warm.limit, (int)OVOID_LIMIT_NONE);
    CHECK(is_proven(pair, &warm, &memory->cover));
}

static void check_full(void) {
    static const struct {
        uint32_t count;
        int is_even;
        double offset, radius;
    } cases[] = {{642, 1, 0, 0}, {642, 1, 1e-9, 0.25}, {1500, 1, 1e-3, 0}, {2562, 1, 0, 0.5}, {4096, 0, 1e-3, 0}};
    ovoid_depth_memory memory = make_memory(OVOID_COVER_POINTS_MAX);
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
    free(memory.data);
}

/// Memory for fewer points than the pair needs narrows the bracket, and its limit stays; any alignment will do.
static void check_some(void) {
    ovoid_shape *a = make_ball(1500, 1, 0);
    ovoid_pair pair = {a, a, ovoid_pose_make_identity(), {{0, 0, 0}, {0.3, 0.4, 0.5, 0.7}}};
    ovoid_answer few = ovoid_depth(&pair, NULL, NULL, NULL);
    ovoid_depth_memory memory = make_memory(1000);
    char *data = memory.data;
    for (size_t at = 0; at < 64; at += 21) {
        memory.data = data + at;
        memory.size = ovoid_depth_get_memory_size(1000) - at;
        ovoid_answer x = ovoid_depth_with(&pair, NULL, NULL, &memory);
        CHECK_EQ((int)x.limit, (int)OVOID_LIMIT_CAPACITY);
        CHECK_LE(990, memory.cover.point_count);
        CHECK_LE(memory.cover.point_count, 1000);
        CHECK_LE(x.upper - x.lower, 0.75 * (few.upper - few.lower));
        CHECK(is_proven(&pair, &x, &memory.cover));
    }
    // A limit of iterations that the caller gives is kept.
    memory.data = data;
    memory.size = ovoid_depth_get_memory_size(1000);
    ovoid_answer x = ovoid_depth_with(&pair, &(ovoid_options){.iterations = 700}, NULL, &memory);
    CHECK_EQ((int)x.limit, (int)OVOID_LIMIT_ITERATIONS);
    CHECK(is_proven(&pair, &x, &memory.cover));
    free(data);
    ovoid_shape_destroy(a);
}

// ---- pairs that do not

/// Bodies far apart, near, in contact and deep in one another: the bits and the cover of ovoid_depth.
static void check_same(void) {
    ovoid_shape *shapes[4] = {make_ball(8, 0, 0), make_ball(100, 1, 0.1), make_ball(300, 1, 0),
                              ovoid_shape_create_box((ovoid_vec3){1, 2, 3}, NULL, NULL)};
    ovoid_depth_memory memory = make_memory(0);
    uint64_t s = 11;
    static ovoid_cover cover;
    for (int i = 0; i < 400; i++) {
        check_seed = s;
        ovoid_pair pair = {shapes[i % 4], shapes[i / 4 % 4], make_pose(&s, 0), make_pose(&s, i % 5 * 0.5)};
        ovoid_answer x = ovoid_depth(&pair, NULL, NULL, &cover), y = ovoid_depth_with(&pair, NULL, NULL, &memory);
        const ovoid_large_cover *large = &memory.cover;
        CHECK(is_same(&x, &y));
        CHECK_EQ(large->point_count, cover.point_count);
        CHECK_EQ(large->triangle_count, cover.triangle_count);
        if (large->point_count != cover.point_count || large->triangle_count != cover.triangle_count) continue;
        CHECK(memcmp(large->a, cover.a, cover.point_count * sizeof *cover.a) == 0);
        CHECK(memcmp(large->b, cover.b, cover.point_count * sizeof *cover.b) == 0);
        CHECK(memcmp(large->triangles, cover.triangles, cover.triangle_count * sizeof *cover.triangles) == 0);
        CHECK(is_proven(&pair, &y, large));
    }
    free(memory.data);
    for (int i = 0; i < 4; i++) ovoid_shape_destroy(shapes[i]);
}

static void check_refused(void) {
    ovoid_shape *a = make_ball(8, 0, 0);
    ovoid_pair pair = {a, a, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    ovoid_depth_memory memory = make_memory(OVOID_COVER_POINTS), none = {.size = memory.size}, small = memory;
    small.size--;
    ovoid_answer x[2] = {ovoid_depth_with(&pair, NULL, NULL, &none), ovoid_depth_with(&pair, NULL, NULL, &small)};
    for (int i = 0; i < 2; i++) {
        CHECK(strcmp(ovoid_limit_get_name(x[i].limit), "memory") == 0);
        CHECK_EQ((int)x[i].status, (int)OVOID_UNDECIDED);
        CHECK(x[i].lower == -INFINITY && x[i].upper == INFINITY);
        CHECK(is_proven(&pair, &x[i], NULL));
        x[i].upper = 1;
        CHECK(!is_proven(&pair, &x[i], NULL));
    }
    CHECK_EQ((int)ovoid_depth_with(&pair, NULL, NULL, &memory).limit, (int)OVOID_LIMIT_NONE);
    // What a depth refuses is refused here, and leaves no cover.
    pair.pose_b.position.x = NAN;
    CHECK_EQ((int)ovoid_depth_with(&pair, NULL, NULL, &memory).limit, (int)OVOID_LIMIT_POSE_B);
    CHECK_EQ(memory.cover.point_count, 0);
    CHECK_EQ(ovoid_depth_get_memory_size(0), ovoid_depth_get_memory_size(OVOID_COVER_POINTS));
    CHECK(ovoid_depth_get_memory_size(OVOID_COVER_POINTS + 1) > ovoid_depth_get_memory_size(OVOID_COVER_POINTS));
    CHECK(ovoid_depth_get_memory_size(OVOID_COVER_POINTS_MAX) > 0);
    CHECK_EQ(ovoid_depth_get_memory_size(OVOID_COVER_POINTS_MAX + 1), 0);
    free(memory.data);
    ovoid_shape_destroy(a);
}

// ---- a liar

typedef struct lie {
    ovoid_pair pair;
    ovoid_answer answer;
    ovoid_large_cover cover;
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
    ovoid_depth_memory memory = make_memory(8000);
    l.answer = ovoid_depth_with(&l.pair, NULL, NULL, &memory);
    l.cover = memory.cover;
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
    ovoid_large_cover whole = l.cover;
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
    free(memory.data);
    ovoid_shape_destroy(a);
}

int main(void) {
    check_full();
    check_some();
    check_same();
    check_refused();
    check_liar();
    return check_end();
}
