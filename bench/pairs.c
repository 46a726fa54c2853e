// Random hulls and where they stand. The same numbers on every machine (SplitMix64, Steele, Lea, Flood 2014).
#include "pairs.h"

#include <math.h>
#include <stdlib.h>

static uint64_t state = 1;

static double random_uniform(double low, double high) {
    uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return low + (high - low) * ((double)(z >> 11) * 0x1p-53);
}

/// A point of the unit ball that is not near its centre.
static ovoid_vec3 random_point(void) {
    for (;;) {
        ovoid_vec3 p = {random_uniform(-1, 1), random_uniform(-1, 1), random_uniform(-1, 1)};
        double squared = p.x * p.x + p.y * p.y + p.z * p.z;
        if (squared <= 1 && squared > 0.01) return p;
    }
}

static ovoid_vec3 random_unit(void) {
    ovoid_vec3 p = random_point();
    double norm = sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
    return (ovoid_vec3){p.x / norm, p.y / norm, p.z / norm};
}

static ovoid_quat random_rotation(void) {
    ovoid_vec3 axis = random_point();
    return (ovoid_quat){random_uniform(-1, 1), axis.x, axis.y, axis.z};
}

const char *placement_get_name(placement place) {
    static const char *const names[PLACE_COUNT] = {"far", "mid", "near", "over"};
    return names[place];
}

static ovoid_shape *shape_create(uint32_t vertices) {
    double *xyz = malloc(sizeof(double) * 3 * vertices);
    if (!xyz) return NULL;
    double stretch_y = random_uniform(1, 4), stretch_z = random_uniform(1, 4);
    for (uint32_t i = 0; i < vertices; i++) {
        ovoid_vec3 p = random_unit();
        xyz[3 * i] = p.x;
        xyz[3 * i + 1] = p.y * stretch_y;
        xyz[3 * i + 2] = p.z * stretch_z;
    }
    ovoid_shape *shape = ovoid_shape_create_from_points(xyz, vertices, NULL, NULL);
    free(xyz);
    return shape;
}

ovoid_shape **shapes_create(uint32_t vertices, uint32_t count) {
    ovoid_shape **shapes = calloc(count, sizeof *shapes);
    for (uint32_t i = 0; shapes && i < count; i++) {
        shapes[i] = shape_create(vertices);
        if (!shapes[i]) {
            shapes_destroy(shapes, count);
            return NULL;
        }
    }
    return shapes;
}

void shapes_destroy(ovoid_shape **shapes, uint32_t count) {
    for (uint32_t i = 0; shapes && i < count; i++) ovoid_shape_destroy(shapes[i]);
    free(shapes);
}

/// Puts b along direction u from a so that the centres of the enclosing spheres are t apart.
static void place_at(ovoid_pair *pair, ovoid_vec3 u, double t) {
    ovoid_vec3 centers[2] = {ovoid_shape_get_measures(pair->shape_a).sphere_center,
                             ovoid_shape_get_measures(pair->shape_b).sphere_center};
    pair->pose_a.position = pair->pose_b.position = (ovoid_vec3){0, 0, 0};
    ovoid_vec3 a = ovoid_pose_compute_point(&pair->pose_a, centers[0]);
    ovoid_vec3 b = ovoid_pose_compute_point(&pair->pose_b, centers[1]);
    pair->pose_b.position = (ovoid_vec3){a.x - b.x + t * u.x, a.y - b.y + t * u.y, a.z - b.z + t * u.z};
}

/// The distance grows with t along a line away from the body: bisection finds where it is the gap.
static void place_with_gap(ovoid_pair *pair, ovoid_vec3 u, double size, double gap) {
    double low = 0, high = gap + 2 * size;
    for (int i = 0; i < 40; i++) {
        double t = 0.5 * (low + high);
        place_at(pair, u, t);
        ovoid_answer answer = ovoid_distance(pair, NULL, NULL);
        if (answer.upper < gap || answer.status != OVOID_SEPARATED)
            low = t;
        else
            high = t;
    }
    place_at(pair, u, high);
}

ovoid_pair *pairs_create(ovoid_shape **shapes, uint32_t count, placement place) {
    static const double gaps[PLACE_COUNT] = {5, 0.5, 0.01, 0};
    ovoid_pair *pairs = malloc(sizeof *pairs * count);
    for (uint32_t i = 0; pairs && i < count; i++) {
        pairs[i] = (ovoid_pair){
            shapes[i], shapes[(i + 1) % count], {{0, 0, 0}, random_rotation()}, {{0, 0, 0}, random_rotation()}};
        double size = ovoid_shape_get_measures(pairs[i].shape_a).sphere_radius +
                      ovoid_shape_get_measures(pairs[i].shape_b).sphere_radius;
        if (place == PLACE_OVER)
            place_at(&pairs[i], random_unit(), 0.3 * size);
        else
            place_with_gap(&pairs[i], random_unit(), size, gaps[place] * size);
    }
    return pairs;
}
