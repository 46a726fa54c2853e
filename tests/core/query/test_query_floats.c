// Single precision: batches of a yes or no of which only the verdicts are wanted, and of distances. Every fourth body
// has up to 130 vertices, more than a group's columns, and some of these a table of supports. Truth: the signed
// distance of the single query, whose bracket must have a common point with the verdict's; the status, and within or
// not, of the single query; a bracket as narrow as its, and a proof that holds, of a distance; the same bits from every
// vector width, in another order, in batches of every length. The bodies are hulls, needles, plates, flat polygons and
// bodies far from their frames' origins, large beside small, of scales from 1e-46 to 1e46, at gaps and overlaps of 1e-8
// to 1 of the size, touching, and in one place. What a verdict rests on, of couples that are added one by one: its
// direction and its vertices, measured in doubles.
#include "bits.h"

#include "linear/rotation.h"
#include "pair/hull.h"
#include "query/batch_floats.h"

enum { SHAPES = 24, COUPLES = 400, LENGTHS = 36, MOST = 130 };
enum { COLLIDE, WITHIN, DISTANCE, QUESTIONS };

static ovoid_shape *shapes[SHAPES];
static ovoid_posed_shape bodies[2 * COUPLES];
static ovoid_couple couples[COUPLES];
static ovoid_verdict verdicts[COUPLES];
static double scale, margin;
static long stages[16];

static ovoid_shape *make_shape(int i, uint64_t *s) {
    double xyz[3 * MOST], thin = pow(10, -random_uniform(s, 1, 7)), own = i % 6 == 5 ? 1e-3 * scale : scale;
    size_t count = 4 + random_next(s) % (i % 4 == 3 ? MOST - 3 : 29);
    for (size_t k = 0; k < count; k++) {
        double x = random_normal(s), y = random_normal(s), z = random_normal(s),
               norm = own / sqrt(x * x + y * y + z * z);
        xyz[3 * k] = x * norm + (i % 6 == 4 ? 50 * scale : 0);
        xyz[3 * k + 1] = y * norm * (i % 6 == 1 ? thin : 1);
        xyz[3 * k + 2] = i % 12 == 3 ? 0 : z * norm * (i % 3 == 1 ? thin : 1);
    }
    if (i % 6 == 2) return ovoid_shape_create_box((ovoid_vec3){0.5 * scale, 0.75 * scale, scale}, NULL, NULL);
    return ovoid_shape_create_from_points(xyz, count, NULL, NULL);
}

static ovoid_pair get_pair(int i) {
    const ovoid_posed_shape *a = &bodies[2 * i], *b = &bodies[2 * i + 1];
    return (ovoid_pair){a->shape, b->shape, a->pose, b->pose};
}

// At a gap or an overlap of a random order; every eighth touching to rounding, every ninth in the place of the other.
static void place(int i, uint64_t *s) {
    ovoid_posed_shape *a = &bodies[2 * i], *b = a + 1;
    for (ovoid_posed_shape *body = a; body <= b; body++) {
        body->shape = shapes[random_next(s) % SHAPES];
        body->pose.position = bits_vec3(s, scale);
        body->pose.rotation = bits_quat(s);
    }
    couples[i] = (ovoid_couple){2 * (uint32_t)i, 2 * (uint32_t)i + 1};
    if (i % 9 == 0) *b = *a;
    if (i % 9 == 0) return;
    ovoid_pair pair = get_pair(i);
    ovoid_answer now = ovoid_depth(&pair, NULL, NULL, NULL);
    double sign = random_next(s) % 2 ? 1 : -1, wanted = i % 8 ? sign * scale * pow(10, -random_uniform(s, 0, 8)) : 0;
    double step = wanted - now.lower;
    b->pose.position.x += step * now.normal.x;
    b->pose.position.y += step * now.normal.y;
    b->pose.position.z += step * now.normal.z;
}

static ovoid_code ask(int question, const ovoid_batch *batch) {
    if (question == DISTANCE) return ovoid_distance_batch(batch, NULL);
    return question == WITHIN ? ovoid_within_batch(batch, margin, NULL) : ovoid_collide_batch(batch, NULL);
}

static int is_within_margin(const ovoid_verdict *v) { return v->upper <= margin ? 1 : v->lower > margin ? 0 : -1; }

static ovoid_answer ask_single(int question, const ovoid_pair *pair) {
    if (question == DISTANCE) return ovoid_distance(pair, NULL, NULL);
    return question == WITHIN ? ovoid_within(pair, margin, NULL, NULL) : ovoid_collide(pair, NULL, NULL);
}

static void check_beside_single(int question, int i) {
    const ovoid_verdict *v = &verdicts[i];
    ovoid_pair pair = get_pair(i);
    ovoid_answer depth = ovoid_depth(&pair, NULL, NULL, NULL), single = ask_single(question, &pair);
    CHECK(v->lower <= depth.upper && depth.lower <= v->upper);
    CHECK(v->status == single.status);
    CHECK(v->status != OVOID_SEPARATED || v->lower > 0);
    CHECK(v->status != OVOID_OVERLAPPING || v->upper < 0);
    if (question == WITHIN) CHECK(is_within_margin(v) == ovoid_answer_is_within(&single, margin));
    if (question == DISTANCE && v->status == OVOID_SEPARATED) CHECK(v->limit == single.limit);
    if (question != DISTANCE) stages[v->stage]++;
}

// The whole answers of a distance: the same verdicts, and proofs that hold.
static void check_answers(void) {
    static ovoid_answer answers[COUPLES];
    ovoid_batch batch = {
        .bodies = bodies, .body_count = 2 * COUPLES, .couples = couples, .couple_count = COUPLES, .answers = answers};
    CHECK(ovoid_distance_batch(&batch, NULL) == OVOID_OK);
    for (int i = 0; i < COUPLES; i++) {
        ovoid_pair pair = get_pair(i);
        check_seed = (uint64_t)i;
        CHECK(memcmp(&answers[i], &verdicts[i], sizeof verdicts[i]) == 0);
        CHECK(ovoid_answer_verify(&pair, &answers[i], NULL, NULL) == OVOID_OK);
    }
}

// In another order, and in batches of every length up to two groups and more; each couple alone, too.
static void check_neighbors(int question) {
    static ovoid_couple other[COUPLES];
    static ovoid_verdict found[COUPLES];
    for (int i = 0; i < COUPLES; i++) other[i] = couples[(i * 7 + 3) % COUPLES];
    ovoid_batch batch = {
        .bodies = bodies, .body_count = 2 * COUPLES, .couples = other, .couple_count = COUPLES, .verdicts = found};
    CHECK(ask(question, &batch) == OVOID_OK);
    for (int i = 0; i < COUPLES; i++) CHECK(memcmp(&found[i], &verdicts[(i * 7 + 3) % COUPLES], sizeof *found) == 0);
    for (size_t count = 1; count < LENGTHS; count++)
        for (size_t from = 0; from + count <= COUPLES; from += count == 1 ? 1 : 5 * count) {
            memset(found, 7, sizeof found);
            batch.couples = couples + from;
            batch.couple_count = count;
            CHECK(ask(question, &batch) == OVOID_OK);
            CHECK(memcmp(found, verdicts + from, count * sizeof *found) == 0);
            CHECK(found[count].iterations == 0x07070707);
        }
}

static int asked;

static void check_width(void) {
    static ovoid_verdict found[COUPLES];
    ovoid_batch batch = {
        .bodies = bodies, .body_count = 2 * COUPLES, .couples = couples, .couple_count = COUPLES, .verdicts = found};
    CHECK(ask(asked, &batch) == OVOID_OK);
    CHECK(memcmp(found, verdicts, sizeof found) == 0);
    check_neighbors(asked);
}

// ---- what a verdict rests on

typedef struct ends {
    ovoid_verdict verdicts[COUPLES];
    float normals[COUPLES][3];
    uint16_t corners[COUPLES][4][2];
    unsigned char is_open[COUPLES];
} ends;

static long directions, tetrahedra;

static void leave_open(void *self, size_t index) { ((ends *)self)->is_open[index]++; }

// is_alone: none waits for another.
static void find_ends(simd_isa isa, int is_alone, ends *found) {
    memset(found, 0, sizeof *found);
    static batch_floats floats;
    ovoid_options options;
    query_goal goal = query_goal_make_within(margin);
    if (!CHECK(options_make(NULL, &options))) return;
    goal.iterations = options.iterations;
    floats.kernels = float_gjk_get_kernels_of(isa);
    floats.alone = isa == SIMD_SCALAR ? floats.kernels : float_gjk_get_kernels(1);
    floats.goal = &goal;
    floats.options = &options;
    floats.batch = NULL;
    floats.verdicts = found->verdicts;
    floats.normals = found->normals;
    floats.corners = found->corners;
    floats.leave_open = floats.pass_on = leave_open;
    floats.self = found;
    batch_floats_begin(&floats);
    for (int i = 0; i < COUPLES; i++) {
        const ovoid_posed_shape *a = &bodies[2 * i], *b = a + 1;
        if (batch_floats_fit(a->shape, b->shape))
            batch_floats_add(&floats, (size_t)i, &(float_posed_pair){a->shape, b->shape, &a->pose, &b->pose});
        else
            leave_open(found, (size_t)i);
        if (is_alone) batch_floats_end(&floats);
    }
    batch_floats_end(&floats);
}

static vec3 place_vertex(const ovoid_posed_shape *body, uint32_t i) {
    vec3 v = vec3_at(shape_vertices(body->shape), i);
    return vec3_add(body->pose.position, mat3_mul_vec3(quat_to_mat3(body->pose.rotation), v));
}

// The gap along the direction, of the vertices in doubles, is not below the bound.
static void check_direction(int i, const float normal[3], double lower) {
    const ovoid_posed_shape *a = &bodies[2 * i], *b = a + 1;
    vec3 n = mat3_mul_vec3(quat_to_mat3(a->pose.rotation), (vec3){normal[0], normal[1], normal[2]});
    double high = -INFINITY, low = INFINITY, norm = vec3_norm(n);
    for (uint32_t k = 0; k < a->shape->vertex_count; k++)
        high = fmax(high, vec3_dot(n, vec3_sub(place_vertex(a, k), a->pose.position)));
    for (uint32_t k = 0; k < b->shape->vertex_count; k++)
        low = fmin(low, vec3_dot(n, vec3_sub(place_vertex(b, k), a->pose.position)));
    CHECK((low - high) / norm >= lower);
    directions++;
}

// The differences of the vertices hold a ball as large as the bound says.
static void check_corners(int i, const uint16_t corners[4][2], double upper) {
    const ovoid_posed_shape *a = &bodies[2 * i], *b = a + 1;
    vec3 w[4];
    for (int k = 0; k < 4; k++) {
        if (!CHECK(corners[k][0] < a->shape->vertex_count && corners[k][1] < b->shape->vertex_count)) return;
        w[k] = vec3_sub(place_vertex(b, corners[k][1]), place_vertex(a, corners[k][0]));
    }
    CHECK(hull_compute_depth(w, 4, 0) >= -upper);
    tetrahedra++;
}

static void check_ends(void) {
    static ends truth, found;
    find_ends(SIMD_SCALAR, 0, &truth);
    for (int i = 0; i < COUPLES; i++) {
        const ovoid_verdict *v = &truth.verdicts[i];
        check_seed = (uint64_t)i;
        CHECK(truth.is_open[i] == (v->status == OVOID_UNDECIDED));
        CHECK(truth.is_open[i] || memcmp(v, &verdicts[i], sizeof *v) == 0);
        if (v->status == OVOID_SEPARATED && v->stage != OVOID_STAGE_SPHERE)
            check_direction(i, truth.normals[i], v->lower);
        if (v->status == OVOID_OVERLAPPING && v->stage == OVOID_STAGE_GJK)
            check_corners(i, (const uint16_t(*)[2])truth.corners[i], v->upper);
    }
    for (int isa = 0; isa < SIMD_ISA_COUNT; isa++) {
        if (!float_gjk_get_kernels_of((simd_isa)isa)) continue;
        for (int is_alone = 0; is_alone < 2; is_alone++) {
            find_ends((simd_isa)isa, is_alone, &found);
            CHECK(memcmp(&found, &truth, sizeof found) == 0);
        }
    }
}

// ---- all

static void check_scale(uint64_t *s) {
    margin = 1e-3 * scale;
    for (int i = 0; i < SHAPES; i++)
        if (!CHECK((shapes[i] = make_shape(i, s)) != NULL)) return;
    for (int i = 0; i < COUPLES; i++) place(i, s);
    ovoid_batch batch = {
        .bodies = bodies, .body_count = 2 * COUPLES, .couples = couples, .couple_count = COUPLES, .verdicts = verdicts};
    for (asked = 0; asked < QUESTIONS; asked++) {
        CHECK(ask(asked, &batch) == OVOID_OK);
        for (int i = 0; i < COUPLES; i++) {
            check_seed = (uint64_t)i;
            check_beside_single(asked, i);
        }
        if (asked == DISTANCE) check_answers();
        if (asked == WITHIN) check_ends();
        check_neighbors(asked);
        bits_run_narrower(check_width);
    }
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
}

// Options: few iterations end a search as they end the single query's; a tolerance above all gaps.
static void check_options(uint64_t *s) {
    const ovoid_options all[] = {{.iterations = 1}, {.iterations = 2}, {.absolute_tolerance = 1}};
    scale = 1;
    for (int i = 0; i < SHAPES; i++)
        if (!CHECK((shapes[i] = make_shape(i, s)) != NULL)) return;
    for (int i = 0; i < COUPLES; i++) place(i, s);
    ovoid_batch batch = {
        .bodies = bodies, .body_count = 2 * COUPLES, .couples = couples, .couple_count = COUPLES, .verdicts = verdicts};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        batch.options = &all[k];
        CHECK(ovoid_collide_batch(&batch, NULL) == OVOID_OK);
        for (int i = 0; i < COUPLES; i++) {
            const ovoid_verdict *v = &verdicts[i];
            ovoid_pair pair = get_pair(i);
            ovoid_answer single = ovoid_collide(&pair, &all[k], NULL);
            check_seed = (uint64_t)i;
            CHECK(v->status == single.status || all[k].iterations);
            CHECK(!all[k].iterations || v->iterations <= all[k].iterations || v->iterations == single.iterations);
            double tolerance = all[k].absolute_tolerance;
            if (tolerance > 0) CHECK((v->upper - v->lower <= tolerance) == (v->limit == OVOID_LIMIT_NONE));
        }
    }
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
}

// Distances of round hulls end in the lanes: their bits are seldom those of the single query, which what is left alone
// has.
static void check_plain(uint64_t *s) {
    static ovoid_answer answers[COUPLES];
    long alone = 0;
    scale = 1;
    for (int i = 0; i < SHAPES; i++)
        if (!CHECK((shapes[i] = make_shape(0, s)) != NULL)) return;
    for (int i = 0; i < COUPLES; i++) place(i, s);
    ovoid_batch batch = {
        .bodies = bodies, .body_count = 2 * COUPLES, .couples = couples, .couple_count = COUPLES, .answers = answers};
    // Both enclosing spheres have radii of at most 1.
    for (int i = 0; i < COUPLES; i++) {
        bodies[2 * i + 1].pose.position = bodies[2 * i].pose.position;
        bodies[2 * i + 1].pose.position.x += 2.25;
    }
    CHECK(ovoid_distance_batch(&batch, NULL) == OVOID_OK);
    for (int i = 0; i < COUPLES; i++) {
        ovoid_pair pair = get_pair(i);
        ovoid_answer single = ovoid_distance(&pair, NULL, NULL);
        alone += memcmp(&answers[i], &single, sizeof single) == 0;
    }
    printf("%ld of %d distances have the bits of the single query\n", alone, COUPLES);
    CHECK(alone < COUPLES / 8);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
}

int main(void) {
    static const double scales[] = {1, 1e-9, 1e9, 1e-30, 1e30, 1e-46, 1e46};
    uint64_t s = 31;
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        scale = scales[i];
        check_scale(&s);
    }
    printf("spheres %ld, outer %ld, inner %ld, supports %ld, gjk %ld, others %ld\n", stages[OVOID_STAGE_SPHERE],
           stages[OVOID_STAGE_OUTER], stages[OVOID_STAGE_INNER], stages[OVOID_STAGE_SUPPORT], stages[OVOID_STAGE_GJK],
           stages[OVOID_STAGE_EPA] + stages[OVOID_STAGE_REFINE]);
    printf("%ld directions, %ld tetrahedra\n", directions, tetrahedra);
    CHECK(directions > 100 && tetrahedra > 100);
    check_options(&s);
    check_plain(&s);
    return check_end();
}
