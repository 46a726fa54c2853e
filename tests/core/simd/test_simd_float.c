// The search in single precision, one step of it (simd/float_gjk.h): every instruction set has the bits of the scalar
// twin; lanes that are idle change nothing. Truth of the bounds: of simplices and corners that no search would come to
// (slivers, corners that are nearly one, the origin beside a triangle or on a plane), in doubles, in which what floats
// round is exact or nearly so. The claim is zero, so a bound holds by its own roundings alone: the upper bound of two
// or three corners is not below the distance of their hull, and the depth in a tetrahedron not above its planes'
// distances.
#include "check.h"
#include "linear/vec3.h"
#include "simd/float_gjk.h"

enum { ROUNDS = 20000 };

static float_gjk truth, other;
static long near_ends, inside_ends;

static float make_number(uint64_t *s) { return (float)random_uniform(s, -1, 1); }
static vec3 make_vec3(uint64_t *s) {
    float x = make_number(s), y = make_number(s), z = make_number(s);
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
        float first = make_number(s), second = make_number(s);
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
            for (int d = 0; d < 3; d++) g->a[8 * d + j].lane[k] = 0;
            g->b[j].lane[k] = (float)w.x;
            g->b[8 + j].lane[k] = (float)w.y;
            g->b[16 + j].lane[k] = (float)w.z;
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
                 {before->b[0].lane[k], before->b[8].lane[k], before->b[16].lane[k]}};
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
    for (const float_column *a = truth.old, *b = g->old; a < truth.a; a++, b++)
        for (unsigned k = 0; k < FLOATS; k++) {
            if (!(live >> k & 1)) continue;
            if (is_truth(&truth, a))
                CHECK(!signbit(a->lane[k]) == !signbit(b->lane[k]));
            else
                CHECK(memcmp(&a->lane[k], &b->lane[k], sizeof *a->lane) == 0);
        }
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
    return check_end();
}
