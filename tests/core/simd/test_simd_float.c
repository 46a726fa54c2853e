// The search in single precision, one step of it (simd/float_gjk.h): every instruction set has the bits of the scalar
// twin; lanes that are idle change nothing. Truth of the bounds: of simplices and corners that no search would come to
// (slivers, corners that are nearly one, the origin beside a triangle or on a plane), in doubles, in which what floats
// round is exact or nearly so. The claim is zero, so a bound holds by its own roundings alone: the upper bound of two
// or three corners is not below the distance of their hull, and the depth in a tetrahedron not above its planes'
// distances.
// The spheres: of poses and spheres of all sizes the bounds, the places of points of B and the margins, in long
// doubles; couples that are not for floats are neither answered nor begun.
#include "check.h"
#include "linear/vec3.h"
#include "simd/float_gjk.h"

enum { ROUNDS = 20000 };

static float_gjk truth, other;
static long near_ends, inside_ends;

// In [-1, 1), exact in single precision: gcc 12 drops the rounding of two doubles to floats and back side by side.
static double make_number(uint64_t *s) { return (double)(random_next(s) >> 39) * 0x1p-24 - 1; }
static vec3 make_vec3(uint64_t *s) {
    double x = make_number(s), y = make_number(s), z = make_number(s);
    return (vec3){x, y, z};
}

static vec3 get_old(const float_gjk *g, int i, unsigned k) {
    return (vec3){g->old[3 * i].lane[k], g->old[3 * i + 1].lane[k], g->old[3 * i + 2].lane[k]};
}

static void put(float_column *c, unsigned k, vec3 v) {
    c[0].lane[k] = (float)v.x;
    c[1].lane[k] = (float)v.y;
    c[2].lane[k] = (float)v.z;
}

// A corner: random, near another, near the plane of three, or on the line of two.
static vec3 make_corner(uint64_t *s, const vec3 c[3]) {
    vec3 random = make_vec3(s);
    double small = pow(10, -random_uniform(s, 1, 8));
    switch (random_next(s) % 5) {
    case 0: return vec3_add_scaled(c[0], random, small);
    case 1: {
        double first = make_number(s), second = make_number(s);
        vec3 on = vec3_add_scaled(vec3_scale(c[0], first), c[1], second);
        return vec3_add_scaled(on, random, small);
    }
    case 2: return vec3_add_scaled(vec3_scale(c[0], 1 - random.x), c[1], random.x);
    default: return random;
    }
}

// Bodies are points: A's the origin, B's the corner w.
static void fill(uint64_t *s, float_gjk *g) {
    g->blocks = 1;
    g->most = 24;
    g->live = (unsigned)random_next(s) & FLOATS_ALL;
    for (unsigned k = 0; k < FLOATS; k++) {
        int asks_near = random_next(s) % 2 == 0;
        vec3 c[3];
        c[0] = make_vec3(s);
        c[1] = make_vec3(s);
        c[2] = make_corner(s, c);
        vec3 w = make_corner(s, c), n = make_vec3(s);
        if (random_next(s) % 2) w = vec3_scale(vec3_add(vec3_add(c[0], c[1]), c[2]), -random_uniform(s, 0.1, 1));
        if (asks_near) n = vec3_dot(n, w) > 0 ? n : vec3_neg(n);
        for (int i = 0; i < 9; i++) g->query.rotation[i].lane[k] = i % 4 == 0;
        put(g->query.translation, k, (vec3){0, 0, 0});
        g->query.claim.lane[k] = 0;
        g->query.far.lane[k] = 8;
        g->query.near.lane[k] = asks_near ? 8 : -1;
        g->query.id.lane[k] = (float)k;
        for (int i = 0; i < 3; i++) put(&g->old[3 * i], k, c[i]);
        unsigned valid = asks_near ? 1 + (unsigned)random_next(s) % 7 : 7;
        for (int i = 0; i < 3; i++) g->is_valid[i].lane[k] = valid >> i & 1 ? -0.0f : 0.0f;
        put(g->n, k, n);
        double norm = vec3_norm_squared((vec3){(float)n.x, (float)n.y, (float)n.z});
        g->square.lane[k] = (float)norm;
        // With this height the simplex is looked at for `near`; else the corner's length would be enough.
        g->height.lane[k] = asks_near ? 0 : INFINITY;
        if (asks_near) g->query.near.lane[k] = (float)(0.999 * vec3_norm(w));
        g->steps.lane[k] = (float)(random_next(s) % 4);
        for (int j = 0; j < 8; j++) {
            for (int d = 0; d < 3; d++) g->columns.a[8 * d + j].lane[k] = 0;
            g->columns.b[j].lane[k] = (float)w.x;
            g->columns.b[8 + j].lane[k] = (float)w.y;
            g->columns.b[16 + j].lane[k] = (float)w.z;
        }
    }
}

// The distance of the origin from a triangle, in doubles: of its inside where the projection is there, else of an edge.
static double measure_segment(vec3 p, vec3 q) {
    vec3 e = vec3_sub(q, p);
    double square = vec3_dot(e, e), t = square > 0 ? -vec3_dot(p, e) / square : 0;
    return vec3_norm(vec3_add_scaled(p, e, t < 0 ? 0 : t > 1 ? 1 : t));
}
static double measure_hull(const vec3 *c, int count) {
    double least = INFINITY;
    for (int i = 0; i < count; i++)
        for (int j = 0; j <= i; j++) least = fmin(least, measure_segment(c[i], c[j]));
    if (count < 3) return least;
    vec3 n = vec3_cross(vec3_sub(c[1], c[0]), vec3_sub(c[2], c[0]));
    int is_inside = vec3_dot(n, vec3_cross(c[0], c[1])) > 0 && vec3_dot(n, vec3_cross(c[1], c[2])) > 0 &&
                    vec3_dot(n, vec3_cross(c[2], c[0])) > 0;
    return is_inside ? fabs(vec3_dot(n, c[0])) / vec3_norm(n) : least;
}

static void check_near(const float_gjk *before, const float_gjk *after, unsigned k) {
    vec3 c[3];
    int count = 0;
    for (int i = 0; i < 3; i++)
        if (signbit(before->is_valid[i].lane[k])) c[count++] = get_old(before, i, k);
    near_ends++;
    // Its own roundings, which the claim allows for, are 11 u of the corners.
    CHECK((double)after->upper.lane[k] >= measure_hull(c, count) - 11 * 0x1p-24 * sqrt(3));
}

// The origin's distance inside the plane of three corners, on the side of the fourth; below zero on the other side.
static double measure_inside(vec3 a, vec3 b, vec3 c, vec3 fourth) {
    vec3 n = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
    double side = vec3_dot(n, vec3_sub(fourth, a)), distance = -vec3_dot(n, a) / vec3_norm(n);
    return side > 0 ? distance : -distance;
}

static void check_inside(const float_gjk *before, const float_gjk *after, unsigned k) {
    vec3 c[4] = {get_old(before, 0, k),
                 get_old(before, 1, k),
                 get_old(before, 2, k),
                 {before->columns.b[0].lane[k], before->columns.b[8].lane[k], before->columns.b[16].lane[k]}};
    double depth = -(double)after->upper.lane[k], least = INFINITY;
    for (int i = 0; i < 4; i++)
        least = fmin(least, measure_inside(c[i], c[(i + 1) % 4], c[(i + 2) % 4], c[(i + 3) % 4]));
    inside_ends++;
    CHECK(depth > 0 && depth <= least);
}

// Of truth values only the sign bits are read.
static int is_truth(const float_gjk *g, const float_column *c) { return c >= g->is_valid && c < g->is_valid + 3; }

static void check_same(const float_gjk *g, unsigned live) {
    CHECK(g->live == truth.live);
    for (const float_column *a = truth.old, *b = g->old; a < truth.columns.a; a++, b++)
        for (unsigned k = 0; k < FLOATS; k++) {
            if (!(live >> k & 1)) continue;
            if (is_truth(&truth, a))
                CHECK(!signbit(a->lane[k]) == !signbit(b->lane[k]));
            else
                CHECK(memcmp(&a->lane[k], &b->lane[k], sizeof *a->lane) == 0);
        }
}

// ---- spheres

enum { BLOCKS = 1500 };

// The numbers of a couple as the kernels read them, and whether it is for floats.
typedef struct sphere_couple {
    double pose[2][7], shape[2][8];
    int is_odd;
} sphere_couple;

static sphere_couple make_couple(uint64_t *s) {
    sphere_couple c = {.is_odd = 0};
    double unit = ldexp(1, (int)(random_next(s) % 60) - 30), away = random_next(s) % 4 ? 3 : 300;
    for (int b = 0; b < 2; b++) {
        double reach = unit * (random_next(s) % 3 ? random_uniform(s, 0.1, 1) : random_uniform(s, 0.001, 1)),
               square = 0;
        for (int i = 0; i < 3; i++) {
            c.shape[b][2 + i] = reach * random_uniform(s, -1, 1);
            square += c.shape[b][2 + i] * c.shape[b][2 + i];
            c.pose[b][i] = unit * random_uniform(s, -away, away);
        }
        for (int i = 3; i < 7; i++) c.pose[b][i] = random_uniform(s, -2, 2);
        c.shape[b][5] = reach;
        c.shape[b][1] = sqrt(square) + reach;
        c.shape[b][6] = c.shape[b][7] = NAN; // are not read
    }
    // Near one another; beside one another along an axis.
    for (int i = 0; i < 3 && away > 3; i++) c.pose[1][i] = c.pose[0][i] + unit * random_uniform(s, -1, 1);
    if (random_next(s) % 8 == 0) c.pose[1][1] = c.pose[0][1];
    switch (random_next(s) % 24) {
    case 0: c.pose[0][2] = c.pose[1][2] = 0x1p101; break;
    case 1: c.pose[1][0] = NAN; break;
    case 2: c.pose[0][3] = c.pose[0][4] = c.pose[0][5] = c.pose[0][6] = 0; break;
    case 3: c.pose[1][4] = 0x1p80; break;
    case 4: c.pose[0][1] = unit * 0x1p75; break;
    case 5: // around one place, far from both frames' origins
        for (int b = 0; b < 2; b++) {
            memcpy(c.pose[b], c.pose[0], sizeof c.pose[b]);
            c.shape[b][2] = 100 * unit;
            c.shape[b][3] = c.shape[b][4] = 0;
            c.shape[b][5] = unit;
            c.shape[b][1] = 102 * unit;
        }
        break;
    default: return c;
    }
    c.is_odd = 1;
    return c;
}

typedef struct point {
    long double x[3];
} point;

static void turn(const double q[4], const long double v[3], long double out[3]) {
    long double w = q[0], x = q[1], y = q[2], z = q[3], s = 2 / (w * w + x * x + y * y + z * z);
    const long double m[3][3] = {{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
                                 {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
                                 {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}};
    for (int i = 0; i < 3; i++) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
}

// A point of B about its sphere's centre, from that of A, in the world.
static point place_point(const sphere_couple *c, const long double v[3]) {
    point p;
    long double in_b[3], center[3], turned_a[3], turned_b[3];
    for (int i = 0; i < 3; i++) {
        in_b[i] = v[i] + (long double)c->shape[1][2 + i];
        center[i] = c->shape[0][2 + i];
    }
    turn(c->pose[0] + 3, center, turned_a);
    turn(c->pose[1] + 3, in_b, turned_b);
    for (int i = 0; i < 3; i++) p.x[i] = ((long double)c->pose[1][i] - c->pose[0][i]) + (turned_b[i] - turned_a[i]);
    return p;
}

static long double get_norm(const long double v[3]) { return sqrtl(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

// The point of B as the query has it, in A's axes, is within the claim of where it is.
static void check_place(const sphere_couple *c, const float_query *q, const float_spheres *found, unsigned k,
                        const long double v[3]) {
    point truth_in_world = place_point(c, v);
    long double unit = found->unit.lane[k], seen[3], off[3];
    const double back[4] = {c->pose[0][3], -c->pose[0][4], -c->pose[0][5], -c->pose[0][6]};
    turn(back, truth_in_world.x, seen);
    for (int i = 0; i < 3; i++) {
        long double x = q->translation[i].lane[k];
        for (int j = 0; j < 3; j++) x += q->rotation[3 * i + j].lane[k] * (v[j] / unit);
        off[i] = x - seen[i] / unit;
    }
    CHECK((double)get_norm(off) <= q->claim.lane[k] - FLOAT_CLAIM * q->size.lane[k]);
}

static void check_open(const sphere_couple *c, const float_rows *rows, const float_query *q, const float_spheres *found,
                       unsigned k, uint64_t *s) {
    double unit = found->unit.lane[k], size = q->size.lane[k];
    CHECK(size >= 1 && size < 2 && q->scale.lane[k] * unit == 1);
    CHECK(q->claim.lane[k] < 600 * 0x1p-24);
    CHECK(q->far.lane[k] == 8 || q->far.lane[k] * unit >= (double)rows->far);
    CHECK(q->near.lane[k] == 8 || q->near.lane[k] * unit <= (double)rows->near || q->near.lane[k] == -1);
    for (int i = 0; i < 4; i++) {
        long double v[3], reach = c->shape[1][5], norm;
        for (int j = 0; j < 3; j++) v[j] = random_uniform(s, -1, 1);
        norm = get_norm(v);
        for (int j = 0; j < 3; j++) v[j] *= reach / norm;
        check_place(c, q, found, k, v);
    }
}

static void check_couple(const sphere_couple *c, const float_spheres *found, float far, unsigned k) {
    const long double none[3] = {0, 0, 0};
    long double offset[3], between = get_norm(place_point(c, none).x);
    for (int i = 0; i < 3; i++) offset[i] = (long double)c->pose[1][i] - c->pose[0][i];
    long double length = get_norm(offset), reach = (long double)c->shape[0][5] + c->shape[1][5];
    long double extents = (long double)c->shape[0][1] + c->shape[1][1];
    double lower = found->lower.lane[k], upper = found->upper.lane[k];
    int is_apart = (int)(found->apart >> k & 1), by_origins = lower > (double)(between - reach);
    CHECK(is_apart == (lower > (double)far));
    CHECK(lower <= (double)(by_origins ? length - extents : between - reach));
    CHECK(upper >= (double)fminl(between + reach, length + extents));
    CHECK(lower >= (double)(fminl(between - reach, length - extents) - 1e-4L * (length + extents)));
    CHECK_NEAR(found->size.lane[k], (double)(length + extents), 1e-6 * (double)(length + extents));
}

static void check_spheres_of(const float_rows *rows, unsigned lanes, const float_query *query,
                             const float_spheres *truth_of) {
    const float_column *truths = (const void *)query;
    for (simd_isa isa = SIMD_SCALAR; isa < SIMD_ISA_COUNT; isa++) {
        const float_gjk_kernels *kernels = float_gjk_get_kernels_of(isa);
        static float_query q;
        const float_column *mine = (const void *)&q;
        static float_spheres found;
        if (!kernels) continue;
        kernels->spheres(rows, lanes, &q, &found);
        CHECK(found.apart == truth_of->apart && found.open == truth_of->open);
        for (unsigned k = 0; k < FLOATS; k++) {
            if (!((found.apart | found.open) >> k & 1)) continue;
            CHECK(memcmp(&found.lower.lane[k], &truth_of->lower.lane[k], sizeof(float)) == 0);
            CHECK(memcmp(&found.upper.lane[k], &truth_of->upper.lane[k], sizeof(float)) == 0);
            CHECK(memcmp(&found.size.lane[k], &truth_of->size.lane[k], sizeof(float)) == 0);
            if (!(found.open >> k & 1)) continue;
            for (int i = 0; i < FLOAT_NUMBERS; i++)
                CHECK(memcmp(&mine[i].lane[k], &truths[i].lane[k], sizeof(float)) == 0);
            CHECK(q.far.lane[k] == query->far.lane[k] && q.near.lane[k] == query->near.lane[k]);
            CHECK(q.size.lane[k] == query->size.lane[k] && q.scale.lane[k] == query->scale.lane[k]);
        }
    }
}

static void check_spheres(uint64_t *s) {
    static sphere_couple couples[FLOATS];
    static float_rows rows;
    static float_query query;
    static float_spheres found;
    long apart = 0, open = 0;
    for (int round = 0; round < BLOCKS; round++) {
        unsigned lanes = random_next(s) % 2 ? FLOATS_ALL : 1 + (unsigned)random_next(s) % FLOATS_ALL;
        check_seed = (uint64_t)round;
        rows.far = random_next(s) % 2 ? 0 : (float)random_uniform(s, 0, 2);
        rows.near = rows.far > 0 ? rows.far : -INFINITY;
        for (unsigned k = 0; k < FLOATS; k++) {
            sphere_couple *c = &couples[k];
            *c = make_couple(s);
            rows.pose_a[k] = c->pose[0];
            rows.pose_b[k] = c->pose[1];
            rows.shape_a[k] = c->shape[0];
            rows.shape_b[k] = c->shape[1];
            rows.extents[k] = c->shape[0][1] + c->shape[1][1];
        }
        float_gjk_get_kernels_of(SIMD_SCALAR)->spheres(&rows, lanes, &query, &found);
        for (unsigned k = 0; k < FLOATS; k++) {
            unsigned is_taken = (found.apart | found.open) >> k & 1;
            CHECK(is_taken == (lanes >> k & 1 && !couples[k].is_odd));
            if (!is_taken) continue;
            check_couple(&couples[k], &found, rows.far, k);
            if (found.open >> k & 1) check_open(&couples[k], &rows, &query, &found, k, s);
        }
        apart += __builtin_popcount(found.apart), open += __builtin_popcount(found.open);
        check_spheres_of(&rows, lanes, &query, &found);
    }
    printf("spheres part %ld, leave open %ld\n", apart, open);
    CHECK(apart > 3 * BLOCKS && open > BLOCKS);
}

int main(void) {
    static float_gjk before;
    uint64_t s = 17;
    const float_gjk_kernels *scalar = float_gjk_get_kernels_of(SIMD_SCALAR);
    for (int round = 0; round < ROUNDS; round++) {
        check_seed = (uint64_t)round;
        fill(&s, &before);
        truth = before;
        float_ends ends = scalar->advance(&truth);
        CHECK((ends.apart | ends.near | ends.inside | ends.open | truth.live) == before.live);
        for (unsigned k = 0; k < FLOATS; k++) {
            if (ends.near >> k & 1) check_near(&before, &truth, k);
            if (ends.inside >> k & 1) check_inside(&before, &truth, k);
        }
        for (simd_isa isa = SIMD_SCALAR; isa < SIMD_ISA_COUNT; isa++) {
            const float_gjk_kernels *kernels = float_gjk_get_kernels_of(isa);
            if (!kernels) continue;
            other = before;
            float_ends found = kernels->advance(&other);
            CHECK(memcmp(&found, &ends, sizeof ends) == 0);
            check_same(&other, before.live);
        }
    }
    printf("near %ld, inside %ld\n", near_ends, inside_ends);
    CHECK(near_ends > ROUNDS && inside_ends > ROUNDS);
    check_spheres(&s);
    return check_end();
}
