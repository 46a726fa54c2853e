// The nearest point of a simplex to the origin, and its direction: what the search is guided by. A wrong one costs
// steps, and hides behind what searches on, so it is tested by itself. Truth: the least distance over all faces, each
// by its own plane; a tetrahedron's inside by four determinants. Simplices of every shape, the origin near and far;
// cases that rounding decides are left out by their distance from a change.
#include "check.h"
#include "distances.h"
#include "linear/mat3.h"
#include "pair/simplex.h"

static vec3 random_vec3(uint64_t *s, double scale) {
    double x = random_normal(s), y = random_normal(s), z = random_normal(s);
    return (vec3){scale * x, scale * y, scale * z};
}

static int is_inside(const vec3 w[4]) {
    int above = 0;
    above += vec3_dot(w[1], vec3_cross(w[3], w[2])) > 0;
    above += vec3_dot(w[0], vec3_cross(w[2], w[3])) > 0;
    above += vec3_dot(w[0], vec3_cross(w[3], w[1])) > 0;
    above += vec3_dot(w[0], vec3_cross(w[1], w[2])) > 0;
    return above == 0 || above == 4;
}

static double distance_of(const vec3 *w, int count) {
    if (count == 1) return vec3_norm(w[0]);
    if (count == 2) return segment_distance(w[0], w[1]);
    if (count == 3) return triangle_distance(w[0], w[1], w[2]);
    if (is_inside(w)) return 0;
    return fmin(fmin(triangle_distance(w[0], w[1], w[2]), triangle_distance(w[0], w[1], w[3])),
                fmin(triangle_distance(w[0], w[2], w[3]), triangle_distance(w[1], w[2], w[3])));
}

static long inside, outside;

static void check_simplex(uint64_t *s, int count) {
    vec3 w[4], center = random_vec3(s, random_next(s) % 2 ? 0.3 : 2);
    simplex x = {.count = count};
    for (int i = 0; i < count; i++) {
        w[i] = vec3_add(center, random_vec3(s, 1));
        x.p[i] = (difference){w[i], (uint32_t)i, (uint32_t)i};
    }
    double distance = distance_of(w, count);
    vec3 n = simplex_reduce(&x);
    if (distance == 0) {
        inside++;
        CHECK_EQ(x.count, 4);
        CHECK_EQ(vec3_norm_squared(n), 0);
        CHECK_LE(vec3_norm(simplex_compute_point(&x)), 1e-12);
    } else if (distance > 1e-6) {
        outside++;
        CHECK_NEAR(vec3_norm(simplex_compute_point(&x)), distance, 1e-9);
        CHECK_NEAR(vec3_dot(n, simplex_compute_point(&x)), distance, 1e-9);
        // No point of the simplex is nearer along the direction.
        for (int i = 0; i < count; i++) CHECK_LE(distance - 1e-9, vec3_dot(n, w[i]));
    }
    double sum = 0;
    for (int i = 0; i < x.count; i++) {
        CHECK_LE(0, x.weight[i]);
        sum += x.weight[i];
    }
    CHECK_NEAR(sum, 1, 1e-14);
}

// A normal is orthogonal to both edges, to rounding u or, of a sliver with the sine s, to a few (u / s)^2: one step of
// Gram and Schmidt, where a plain cross product would be off by u / s.
static void check_normal(uint64_t *s) {
    vec3 e1 = random_vec3(s, 1), across = random_vec3(s, 1);
    double thin = pow(10, -random_uniform(s, 0, 10));
    vec3 e2 = vec3_add_scaled(vec3_scale(e1, random_uniform(s, -1, 1)), across, thin);
    vec3 n = simplex_compute_normal(e1, e2);
    double sine = vec3_norm(vec3_cross(e1, e2)) / (vec3_norm(e1) * vec3_norm(e2)), lost = 0x1p-53 / sine;
    CHECK_NEAR(vec3_norm(n), 1, 1e-14);
    CHECK_LE(fabs(vec3_dot(n, e1)), (16 * 0x1p-53 + 16 * lost * lost + (sine > 0.01 ? 4 * lost : 0)) * vec3_norm(e1));
    CHECK_LE(fabs(vec3_dot(n, e2)), (16 * 0x1p-53 + 16 * lost * lost + (sine > 0.01 ? 4 * lost : 0)) * vec3_norm(e2));
}

/// The origin's weights in a tetrahedron around it, of any size: those of the regular one are equal.
static void check_inside_weights(double size) {
    simplex x = {.p = {{{size, size, size}, 0, 0},
                       {{-size, -size, size}, 0, 0},
                       {{-size, size, -size}, 0, 0},
                       {{size, -size, -size}, 0, 0}},
                 .count = 4};
    simplex_compute_inside_weights(&x);
    for (int i = 0; i < 4; i++) CHECK_NEAR(x.weight[i], 0.25, 1e-15);
}

int main(void) {
    const double sizes[] = {1, 1e-50, 1e-123, 1e-300, 1e50};
    for (int i = 0; i < 5; i++) check_inside_weights(sizes[i]);
    for (uint64_t seed = 0; seed < 20000; seed++) {
        uint64_t s = check_seed = seed;
        for (int count = 1; count <= 4; count++) check_simplex(&s, count);
        check_normal(&s);
    }
    CHECK(inside > 500 && outside > 50000);
    return check_end();
}
