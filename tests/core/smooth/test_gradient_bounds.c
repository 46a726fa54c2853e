// What a gradient says of its own errors, where they are known: answers made by hand whose normal or points are off by
// a given angle or length. Truth: closed forms; `turn`, `slide` and `slope` must cover what was put in, and a
// derivative that does not exist must not be claimed.
#include "check.h"
#include "ovoid/ovoid.h"

#include "linear/vec3.h"

static const ovoid_pose here = {{0, 0, 0}, {1, 0, 0, 0}};

static ovoid_shape *make_points(const double *xyz, size_t count) {
    return ovoid_shape_create_from_points(xyz, count, NULL, NULL);
}

// The vertex of a shape at a place.
static uint32_t find_vertex(const ovoid_shape *shape, vec3 at) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    uint32_t best = 0;
    double least = INFINITY;
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        vec3 v = vec3_add(vec3_at(p.vertices, i), p.origin);
        double far = vec3_norm(vec3_sub(v, at));
        if (far < least) least = far, best = i;
    }
    CHECK_LE(least, 1e-9);
    return best;
}

// An answer of two points, one vertex each.
static ovoid_answer make_answer(const ovoid_pair *pair, vec3 a, vec3 b, vec3 n, double lower) {
    ovoid_answer x = {.status = OVOID_SEPARATED, .lower = lower, .upper = vec3_norm(vec3_sub(b, a)), .normal = n};
    x.point_a = a;
    x.point_b = b;
    x.proof = (ovoid_proof){.normal = n, .kind = OVOID_PROOF_POINTS, .count = 1};
    x.proof.a[0] = find_vertex(pair->shape_a, a);
    x.proof.b[0] = find_vertex(pair->shape_b, vec3_sub(b, pair->pose_b.position));
    x.proof.weight_a[0] = x.proof.weight_b[0] = 1;
    return x;
}

// Two points at a distance h: along a normal that is off by an angle the gap is h times its cosine.
static void check_turn(uint64_t *s) {
    const double origin[3] = {0, 0, 0};
    ovoid_shape *point = make_points(origin, 1);
    for (int k = 0; k < 200; k++) {
        double angle = exp(random_uniform(s, log(1e-7), log(1.5))), h = exp(random_uniform(s, -3, 3));
        ovoid_pair pair = {point, point, here, {{0, h, 0}, {1, 0, 0, 0}}};
        vec3 n = {sin(angle), cos(angle), 0}, b = {0, h, 0};
        ovoid_answer x = make_answer(&pair, (vec3){0, 0, 0}, b, n, h * cos(angle));
        ovoid_gradient g = ovoid_answer_compute_gradient(&pair, &x, NULL);
        CHECK(g.has_translation);
        // The bracket's own rounding is a part of 1e-16 of it, the angle's square; below, it is all there is.
        CHECK_LE(angle * (1 - 1e-6) - 2e-16 / angle, g.turn);
        CHECK_LE(g.turn, 1.2 * angle + 1e-7);
    }
    ovoid_shape_destroy(point);
}

// Two parallel segments: which points are nearest is open, so no derivative by rotations exists. A normal that is
// tilted shows one pair of ends, and slopes as large as the tilt.
static void check_parallel(uint64_t *s) {
    const double along[6] = {-1, 0, 0, 1, 0, 0};
    ovoid_shape *segment = make_points(along, 2);
    for (int k = 0; k < 200; k++) {
        double angle = exp(random_uniform(s, log(1e-9), log(0.1))), move = random_uniform(s, -1.9, 1.9);
        ovoid_pair pair = {segment, segment, here, {{move, 1, 0}, {1, 0, 0, 0}}};
        vec3 n = {sin(angle), cos(angle), 0}, a = {1, 0, 0}, b = {move - 1, 1, 0};
        ovoid_answer x = make_answer(&pair, a, b, n, vec3_dot(n, vec3_sub(b, a)));
        if (!(x.lower > 0)) continue;
        ovoid_gradient g = ovoid_answer_compute_gradient(&pair, &x, NULL);
        CHECK(!g.has_rotation);
    }
    ovoid_shape_destroy(segment);
}

// A point above a segment: the point said to be nearest is off by a length along the segment.
static void check_slide(uint64_t *s) {
    const double along[6] = {-1, 0, 0, 1, 0, 0}, origin[3] = {0, 0, 0};
    ovoid_shape *segment = make_points(along, 2), *point = make_points(origin, 1);
    for (int k = 0; k < 200; k++) {
        double h = exp(random_uniform(s, -2, 2)), off = exp(random_uniform(s, log(1e-6), log(0.5)));
        ovoid_pair pair = {segment, point, here, {{0, h, 0}, {1, 0, 0, 0}}};
        vec3 n = {0, 1, 0};
        ovoid_answer x = make_answer(&pair, (vec3){1, 0, 0}, (vec3){0, h, 0}, n, h);
        uint32_t left = find_vertex(segment, (vec3){-1, 0, 0});
        x.proof.count = 2;
        x.proof.a[1] = left;
        x.proof.b[1] = x.proof.b[0];
        x.proof.weight_a[0] = 0.5 * (1 + off), x.proof.weight_a[1] = 0.5 * (1 - off);
        x.proof.weight_b[0] = x.proof.weight_b[1] = 0.5;
        x.point_a = (vec3){off, 0, 0};
        x.upper = sqrt(h * h + off * off);
        ovoid_gradient g = ovoid_answer_compute_gradient(&pair, &x, NULL);
        CHECK(g.slope > 0);
        CHECK_LE(off * (1 - 1e-6) - 1e-15 * h * h / off, g.slide);
        CHECK_LE(g.slide, 10 * (off + off * off / h) + 1e-7 * h);
    }
    ovoid_shape_destroy(segment);
    ovoid_shape_destroy(point);
}

// Corner above corner: each body falls away from the plane between them by its flattest edge.
static void check_slope(uint64_t seed) {
    uint64_t s = check_seed = seed;
    double slopes[2] = {INFINITY, INFINITY};
    ovoid_shape *shapes[2];
    for (int i = 0; i < 2; i++) {
        // A tip at the origin, edges to points that lie off it: down for A, up for B.
        double xyz[3 * 6] = {0};
        int count = 3 + (int)(random_next(&s) % 3);
        for (int k = 1; k <= count; k++) {
            double angle = 6.283185307179586 * (k + random_uniform(&s, -0.2, 0.2)) / count;
            double slope = random_uniform(&s, 0.02, 0.4), length = random_uniform(&s, 1, 2);
            xyz[3 * k] = length * cos(angle);
            xyz[3 * k + 1] = length * sin(angle);
            xyz[3 * k + 2] = (i ? slope : -slope) * length;
        }
        shapes[i] = make_points(xyz, (size_t)count + 1);
        if (!CHECK(shapes[i])) return;
        // Neighbours of the tip alone, as the hull has them.
        ovoid_polytope p = ovoid_shape_get_polytope(shapes[i]);
        uint32_t tip = find_vertex(shapes[i], (vec3){0, 0, 0});
        for (uint32_t k = p.neighbor_starts[tip]; k < p.neighbor_starts[tip + 1]; k++) {
            vec3 e = vec3_sub(vec3_at(p.vertices, p.neighbors[k]), vec3_at(p.vertices, tip));
            slopes[i] = fmin(slopes[i], fabs(e.z) / sqrt(e.x * e.x + e.y * e.y));
        }
    }
    ovoid_pair pair = {shapes[0], shapes[1], here, {{0, 0, 1}, {1, 0, 0, 0}}};
    ovoid_answer x = make_answer(&pair, (vec3){0, 0, 0}, (vec3){0, 0, 1}, (vec3){0, 0, 1}, 1);
    ovoid_gradient g = ovoid_answer_compute_gradient(&pair, &x, NULL);
    double truth = fmin(slopes[0] + slopes[1], 1);
    CHECK_LE(g.slope, truth * (1 + 1e-12));
    CHECK_LE(truth * (1 - 1e-12), g.slope);
    CHECK(g.has_rotation);
    for (int i = 0; i < 2; i++) ovoid_shape_destroy(shapes[i]);
}

int main(void) {
    uint64_t s = 1;
    check_turn(&s);
    check_parallel(&s);
    check_slide(&s);
    for (uint64_t seed = 1; seed <= 100; seed++) check_slope(seed);
    return check_end();
}
