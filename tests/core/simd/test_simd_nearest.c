// Nearest points of small bodies: the search in single precision (float_gjk.h's approach) and its ends in doubles
// (group_gjk.h's measure). Every instruction set, and the kernel of one couple, find the bits of the scalar twin,
// whatever lanes are beside. Truth: what the ends claim is computed again in plain doubles from the corners and all
// vertices: weights of a convex combination, its points, their distance as the upper bound, the gap along the direction
// as the lower one. The two bounds meet for nearly all couples: a search that ended elsewhere leaves a gap between
// them. The origin is in the hull of four corners.
#include "check.h"
#include "linear/mat3.h"
#include "linear/rotation.h"
#include "simd/group_gjk.h"

enum { ROUNDS = 600 };
static const double tiny = 1e-13; // some hundred roundings of lengths up to two

// One body of each couple: vertices about the origin of its frame, as the kernels read them.
typedef struct body {
    _Alignas(64) float columns[3 * FLOAT_GJK_POINTS];
    _Alignas(64) double axes[3 * FLOAT_GJK_POINTS];
    double rows[3 * FLOAT_GJK_POINTS + 1];
    uint32_t count;
} body;

static body bodies[2][FLOATS];
static mat3 world[2][FLOATS];
static vec3 offset[FLOATS];
static float_points points;
static float_gjk start, found, other;
static pair8 lanes[2];
static long near_ends, inside_ends, narrow_ends, with_corners[4];

static void make_body(uint64_t *s, body *b, double radius) {
    uint32_t count = 4 + (uint32_t)(random_next(s) % 29);
    b->count = (count + 7) / 8 * 8;
    for (uint32_t i = 0; i < b->count; i++) {
        vec3 v = {random_normal(s), random_normal(s), random_normal(s)};
        double xyz[3] = {v.x, v.y, v.z}, norm = vec3_norm(v) / radius;
        for (uint32_t d = 0; d < 3; d++) {
            // A float, so that both precisions have the same body. Places beyond the last repeat the first.
            float x = i < count ? (float)(xyz[d] / norm) : b->columns[d * b->count];
            b->columns[d * b->count + i] = x;
            b->axes[d * b->count + i] = x;
            b->rows[3 * i + d] = x;
        }
    }
}

static mat3 make_rotation(uint64_t *s) {
    return quat_to_mat3((ovoid_quat){random_normal(s), random_normal(s), random_normal(s), random_normal(s)});
}

static void put(float_column *to, unsigned k, vec3 v) {
    to[0].lane[k] = (float)v.x;
    to[1].lane[k] = (float)v.y;
    to[2].lane[k] = (float)v.z;
}

static void put_doubles(lane_column *to, unsigned k, const mat3 *m) {
    const double *of = &m->r0.x;
    for (int i = 0; i < 9; i++) to[i].lane[k] = of[i];
}

// Couple k: A's and B's spheres have radius 0.25 and 0.35; centres apart by 0.45 to 1.35 of the sum.
static void make_couple(uint64_t *s, unsigned k) {
    pair8 *o = &lanes[k / PAIR8];
    for (int i = 0; i < 2; i++) {
        make_body(s, &bodies[i][k], i ? 0.35 : 0.25);
        world[i][k] = make_rotation(s);
        put_doubles(i ? o->world_b : o->world_a, k % PAIR8, &world[i][k]);
    }
    vec3 line = vec3_unit((vec3){random_normal(s), random_normal(s), random_normal(s)});
    offset[k] = vec3_scale(line, 0.6 * random_uniform(s, 0.45, 1.35));
    double size = 0.6 + vec3_norm(offset[k]);
    mat3 between = mat3_mul_transposed(world[0][k], world[1][k]);
    put(start.query.rotation, k, between.r0);
    put(start.query.rotation + 3, k, between.r1);
    put(start.query.rotation + 6, k, between.r2);
    put(start.query.translation, k, mat3_mul_transposed_vec3(world[0][k], offset[k]));
    start.query.claim.lane[k] = (float)(FLOAT_CLAIM * size);
    start.query.factor_a.lane[k] = start.query.factor_b.lane[k] = 1;
    points.a[k] = bodies[0][k].columns;
    points.b[k] = bodies[1][k].columns;
    points.blocks_a[k] = bodies[0][k].count / 8;
    points.blocks_b[k] = bodies[1][k].count / 8;
    o->offset[0].lane[k % PAIR8] = offset[k].x;
    o->offset[1].lane[k % PAIR8] = offset[k].y;
    o->offset[2].lane[k % PAIR8] = offset[k].z;
    o->radii.lane[k % PAIR8] = k % 3 ? 0 : 0.0625;
    o->size.lane[k % PAIR8] = size;
    o->count = PAIR8;
}

static vec3 get_vertex(int side, unsigned k, uint32_t i) {
    return mat3_mul_vec3(world[side][k], vec3_at(bodies[side][k].rows, i));
}

// The difference of a corner.
static vec3 get_difference(unsigned k, uint32_t id) {
    vec3 a = get_vertex(0, k, id % FLOAT_GJK_POINTS), b = get_vertex(1, k, id / FLOAT_GJK_POINTS);
    return vec3_add(offset[k], vec3_sub(b, a));
}

static double find_gap(unsigned k, vec3 n) {
    double high = -INFINITY, low = INFINITY;
    for (uint32_t i = 0; i < bodies[0][k].count; i++) high = fmax(high, vec3_dot(n, get_vertex(0, k, i)));
    for (uint32_t i = 0; i < bodies[1][k].count; i++) low = fmin(low, vec3_dot(n, get_vertex(1, k, i)));
    return vec3_dot(n, offset[k]) + low - high;
}

static uint32_t get_id(const float_gjk *g, int i, unsigned k) { return (uint32_t)g->found.corner[i].lane[k]; }

// ---- the ends, in doubles

static const pair8_query numbers = {.reject = 384 * 0x1p-53, .hidden = 0};

static vec3 get3(const lane_column *c, unsigned k) { return (vec3){c[0].lane[k], c[1].lane[k], c[2].lane[k]}; }

static void check_near(const group_nearest *r, unsigned k) {
    unsigned lane = k % PAIR8;
    double sum = 0, radii = lanes[k / PAIR8].radii.lane[lane], size = lanes[k / PAIR8].size.lane[lane];
    double claim = numbers.reject * size, lower = r->lower.lane[lane], upper = r->upper.lane[lane];
    vec3 a = {0, 0, 0}, between = {0, 0, 0}, n = get3(r->normal, lane);
    int count = (int)found.found.count.lane[k];
    CHECK(count >= 1 && count <= 3);
    for (int i = 0; i < 3; i++) {
        double w = r->weight[i].lane[lane];
        uint32_t id = get_id(&found, i, k);
        CHECK(w >= 0 && (i < count || w == 0));
        sum += w;
        a = vec3_add_scaled(a, get_vertex(0, k, id % FLOAT_GJK_POINTS), w);
        between = vec3_add_scaled(between, get_difference(k, id), w);
    }
    CHECK_NEAR(sum, 1, tiny);
    CHECK(vec3_norm(vec3_sub(a, get3(r->point_a, lane))) < tiny);
    CHECK(vec3_norm(vec3_sub(vec3_add(a, between), get3(r->point_b, lane))) < tiny);
    CHECK_NEAR(vec3_norm(n), 1, tiny);
    // Within the claims of what plain doubles say, and on the safe side.
    CHECK(lower <= find_gap(k, n) - radii - 0.9 * claim && lower >= find_gap(k, n) - radii - 1.1 * claim);
    CHECK(upper >= vec3_norm(between) - radii + 0.9 * claim && upper <= vec3_norm(between) - radii + 1.1 * claim);
    narrow_ends += upper - lower < 1e-9;
    with_corners[count]++;
    near_ends++;
}

static void check_inside(unsigned k) {
    vec3 w[4];
    for (int i = 0; i < 4; i++) w[i] = get_difference(k, get_id(&found, i, k));
    for (int i = 0; i < 4; i++) {
        vec3 p = w[(i + 1) % 4], n = vec3_cross(vec3_sub(w[(i + 2) % 4], p), vec3_sub(w[(i + 3) % 4], p));
        double height = vec3_norm(n) > 0 ? vec3_dot(n, vec3_sub(w[i], p)) / vec3_norm(n) : 0;
        double origin = vec3_norm(n) > 0 ? -vec3_dot(n, p) / vec3_norm(n) : 0;
        CHECK((height > 0 ? origin : -origin) > -1e-5);
    }
    CHECK(found.found.count.lane[k] == 3);
    inside_ends++;
}

static void put_corners(unsigned group, unsigned near, group_corners *to) {
    for (unsigned lane = 0; lane < PAIR8; lane++) {
        unsigned k = PAIR8 * group + lane;
        const body *a = &bodies[0][k], *b = &bodies[1][k];
        int is_near = (int)(near >> lane & 1);
        for (int i = 0; i < 3; i++) {
            uint32_t id = is_near ? get_id(&found, i, k) : 0;
            to->a[i][lane] = a->rows + 3 * (size_t)(id % FLOAT_GJK_POINTS);
            to->b[i][lane] = b->rows + 3 * (size_t)(id / FLOAT_GJK_POINTS);
        }
        to->count.lane[lane] = is_near ? found.found.count.lane[k] : 1;
        to->points_a[lane] = (simd_points){a->axes, a->axes + a->count, a->axes + 2 * a->count, a->count};
        to->points_b[lane] = (simd_points){b->axes, b->axes + b->count, b->axes + 2 * b->count, b->count};
    }
}

static void run_measure(unsigned group, unsigned near) {
    static group_corners corners;
    static group_nearest truth, result;
    for (simd_isa isa = SIMD_SCALAR; isa < SIMD_ISA_COUNT; isa++) {
        const group_gjk_kernels *kernels = group_gjk_get_kernels_of(isa);
        if (!kernels) continue;
        put_corners(group, near, &corners);
        kernels->measure(&lanes[group], &numbers, near, &corners, &result);
        if (isa == SIMD_SCALAR) truth = result;
        CHECK((near & ~corners.good) == 0);
        const lane_column *a = (const lane_column *)&truth, *b = (const lane_column *)&result;
        for (size_t i = 0; i < sizeof result / sizeof *a; i++)
            for (unsigned k = 0; k < PAIR8; k++)
                if (near >> k & 1) CHECK(memcmp(&a[i].lane[k], &b[i].lane[k], sizeof(double)) == 0);
    }
    for (unsigned k = 0; k < PAIR8; k++)
        if (near >> k & 1) check_near(&truth, PAIR8 * group + k);
}

// Corners at one place: their direction has no length, and every kernel says so.
static void check_lengths(void) {
    static group_corners corners;
    static group_nearest result;
    static const double nowhere[4] = {0, 0, 0, 0};
    static pair8 o;
    o = lanes[0];
    for (int i = 0; i < 3; i++)
        for (unsigned k = 0; k < PAIR8; k++) o.offset[i].lane[k] = k % 2 ? 1e-80 : 1;
    put_corners(0, 0, &corners);
    for (int i = 0; i < 3; i++)
        for (unsigned k = 0; k < PAIR8; k++) corners.a[i][k] = corners.b[i][k] = nowhere;
    for (simd_isa isa = SIMD_SCALAR; isa < SIMD_ISA_COUNT; isa++) {
        const group_gjk_kernels *kernels = group_gjk_get_kernels_of(isa);
        if (!kernels) continue;
        kernels->measure(&o, &numbers, PAIR8_ALL, &corners, &result);
        CHECK(corners.good == 0x55);
    }
}

// ---- the search

static void check_same(const float_gjk *g, unsigned from, unsigned k, int is_inside) {
    const float_column *a = (const float_column *)&found.found, *b = (const float_column *)&g->found;
    for (size_t i = 0; i < sizeof g->found / sizeof *a; i++)
        if (i != 3 || is_inside) CHECK(memcmp(&a[i].lane[k], &b[i].lane[from], sizeof *a->lane) == 0);
}

static void search_alone(const float_ends *ends, unsigned lanes_asked) {
    const float_gjk_kernels *kernels = float_gjk_get_kernels(1);
    for (unsigned k = 0; k < FLOATS; k++) {
        if (!(lanes_asked >> k & 1)) continue;
        other = start;
        float_column *columns = (float_column *)&other.query;
        for (int i = 0; i < FLOAT_COLUMNS; i++) columns[i].lane[0] = columns[i].lane[k];
        const float_points own = {{points.a[k]}, {points.b[k]}, {points.blocks_a[k]}, {points.blocks_b[k]}};
        kernels->load(&own, 1, &other);
        float_ends now = kernels->approach(&other, 1);
        CHECK(now.near == (ends->near >> k & 1) && now.inside == (ends->inside >> k & 1));
        if (!now.open) check_same(&other, 0, k, (int)now.inside);
    }
}

static void run_round(uint64_t *s) {
    unsigned some = random_next(s) % 2 ? FLOATS_ALL : 1 + (unsigned)(random_next(s) % FLOATS_ALL);
    float_ends ends = {0, 0, 0, 0};
    for (unsigned k = 0; k < FLOATS; k++) make_couple(s, k);
    start.blocks = FLOAT_GJK_BLOCKS;
    start.most = random_next(s) % 8 ? 24 : (float)(1 + random_next(s) % 4);
    start.live = 0;
    for (simd_isa isa = SIMD_SCALAR; isa < SIMD_ISA_COUNT; isa++) {
        const float_gjk_kernels *kernels = float_gjk_get_kernels_of(isa);
        if (!kernels) continue;
        other = start;
        kernels->load(&points, some, &other);
        float_ends now = kernels->approach(&other, some);
        if (isa == SIMD_SCALAR) {
            found = other;
            ends = now;
        }
        CHECK(memcmp(&now, &ends, sizeof ends) == 0);
        CHECK((now.near | now.inside | now.open) == some && !(now.near & now.inside) && !now.apart);
        CHECK(start.most < 24 || !now.open);
        for (unsigned k = 0; k < FLOATS; k++)
            if ((now.near | now.inside) >> k & 1) check_same(&other, k, k, (int)(now.inside >> k & 1));
    }
    search_alone(&ends, some);
    for (unsigned k = 0; k < FLOATS; k++)
        if (ends.inside >> k & 1) check_inside(k);
    for (unsigned group = 0; group < 2; group++) run_measure(group, ends.near >> PAIR8 * group & PAIR8_ALL);
}

int main(void) {
    uint64_t s = 41;
    for (int i = 0; i < ROUNDS; i++) {
        check_seed = (uint64_t)i;
        run_round(&s);
    }
    check_lengths();
    printf("near %ld (%ld, %ld, %ld of 1, 2, 3 corners), not to 1e-9 %ld, inside %ld\n", near_ends, with_corners[1],
           with_corners[2], with_corners[3], near_ends - narrow_ends, inside_ends);
    CHECK(narrow_ends >= near_ends - near_ends / 500);
    CHECK(inside_ends > 500);
    for (int i = 1; i < 4; i++) CHECK(with_corners[i] > 100);
    return check_end();
}
