// Makers of bodies. Each draws all that it needs from the state given, one number after another: C leaves the order of
// arguments and of initializers open, so no two draws stand in one list, and a seed makes the same body everywhere.
#include "shapes.h"

#include "check.h"

_Thread_local uint64_t trial_seed;

static const ovoid_vec3 zero = {0, 0, 0};

double log_uniform(uint64_t *r, double low, double high) {
    return low * exp(random_uniform(r, 0, 1) * log(high / low));
}

ovoid_vec3 random_vec3(uint64_t *r, double deviation) {
    double x = random_normal(r), y = random_normal(r), z = random_normal(r);
    return (ovoid_vec3){deviation * x, deviation * y, deviation * z};
}

ovoid_quat random_quat(uint64_t *r) {
    double w = random_normal(r), x = random_normal(r), y = random_normal(r), z = random_normal(r);
    return (ovoid_quat){w, x, y, z};
}

size_t random_count(uint64_t *r, double most) { return (size_t)log_uniform(r, 4, most + 0.99); }

ovoid_shape *make_points(const double *xyz, size_t count, double radius) {
    ovoid_shape_options options = {.radius = radius};
    ovoid_error error = {0};
    ovoid_shape *shape = ovoid_shape_create_from_points(xyz, count, &options, &error);
    if (shape) return shape;
    printf("FAILED: no shape of %zu points (seed %llu): %s\n", count, (unsigned long long)trial_seed, error.message);
    for (size_t i = 0; i < count; i++) printf(" %.17g %.17g %.17g\n", xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
    exit(1);
}

ovoid_shape *make_hull(uint64_t *r, size_t count, ovoid_vec3 axes, ovoid_vec3 center, double radius) {
    double *xyz = malloc(3 * count * sizeof *xyz);
    if (!xyz) abort();
    int fill = random_next(r) % 3 == 0;
    for (size_t i = 0; i < count; i++) {
        ovoid_vec3 v = random_vec3(r, 1);
        double s = (fill ? random_uniform(r, 0.2, 1) : 1) / sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
        xyz[3 * i] = center.x + axes.x * v.x * s;
        xyz[3 * i + 1] = center.y + axes.y * v.y * s;
        xyz[3 * i + 2] = center.z + axes.z * v.z * s;
    }
    ovoid_shape *shape = make_points(xyz, count, radius);
    free(xyz);
    return shape;
}

ovoid_shape *make_random_hull(uint64_t *r, double most, double scale) {
    double x = log_uniform(r, 1, 4), y = log_uniform(r, 1, 4), z = log_uniform(r, 1, 4);
    return make_hull(r, random_count(r, most), (ovoid_vec3){scale * x, scale * y, scale * z}, zero, 0);
}

ovoid_shape *make_long_hull(uint64_t *r, double most) {
    double y = log_uniform(r, 1e-3, 1), z = log_uniform(r, 1e-3, 1);
    return make_hull(r, random_count(r, most), (ovoid_vec3){1, y, z}, zero, 0);
}

ovoid_shape *make_needle(uint64_t *r) {
    double thin = log_uniform(r, 1e-8, 1e-2);
    return make_hull(r, random_count(r, 40), (ovoid_vec3){1, thin, thin}, zero, 0);
}

ovoid_shape *make_slab(uint64_t *r) {
    double thin = log_uniform(r, 1e-8, 1e-2);
    return make_hull(r, random_count(r, 40), (ovoid_vec3){1, 1, thin}, zero, 0);
}

ovoid_shape *make_flat(uint64_t *r, double radius) {
    double xyz[3 * 16];
    size_t count = 3 + (size_t)(random_next(r) % 10);
    int exact = random_next(r) % 2;
    ovoid_pose pose = {{0, 0, 0}, random_quat(r)};
    for (size_t i = 0; i < count; i++) {
        double x = random_uniform(r, -1, 1), y = random_uniform(r, -1, 1);
        ovoid_vec3 v = {x, y, 0};
        if (!exact) v = ovoid_pose_compute_point(&pose, v);
        xyz[3 * i] = v.x, xyz[3 * i + 1] = v.y, xyz[3 * i + 2] = v.z;
    }
    return make_points(xyz, count, radius);
}

ovoid_shape *make_segment(uint64_t *r, double radius) {
    double xyz[6];
    for (int i = 0; i < 6; i++) xyz[i] = random_uniform(r, -1, 1);
    return make_points(xyz, 2, radius);
}

ovoid_shape *make_point(uint64_t *r, double radius) {
    double xyz[3];
    for (int i = 0; i < 3; i++) xyz[i] = random_uniform(r, -1, 1);
    return make_points(xyz, 1, radius);
}

ovoid_shape *make_box(double x, double y, double z, double radius) {
    ovoid_shape_options options = {.radius = radius};
    return ovoid_shape_create_box((ovoid_vec3){x, y, z}, &options, NULL);
}

ovoid_shape *make_grid(uint64_t *r) {
    double xyz[3 * 64];
    double jitter = random_next(r) % 3 ? log_uniform(r, 1e-17, 1e-9) : 0;
    for (int i = 0; i < 3 * 64; i++) {
        double at = (double)(random_next(r) % 4) - 1.5;
        xyz[i] = at + jitter * random_uniform(r, -1, 1);
    }
    return make_points(xyz, 20 + (size_t)(random_next(r) % 44), 0);
}

ovoid_shape *make_near_coplanar(uint64_t *r) {
    // Polygons around the axes of a box that is turned: 4 to 13 points on each of its six sides.
    double xyz[3 * 80];
    size_t count = 0, on_each = 4 + (size_t)(random_next(r) % 10);
    double off = log_uniform(r, 1e-17, 1e-6);
    ovoid_pose turn = {{0, 0, 0}, random_quat(r)};
    for (int side = 0; side < 6; side++)
        for (size_t i = 0; i < on_each; i++) {
            double v[3];
            v[side / 2] = (side % 2 ? 1 : -1) + off * random_uniform(r, -1, 1);
            v[(side / 2 + 1) % 3] = random_uniform(r, -1, 1);
            v[(side / 2 + 2) % 3] = random_uniform(r, -1, 1);
            ovoid_vec3 x = ovoid_pose_compute_point(&turn, (ovoid_vec3){v[0], v[1], v[2]});
            xyz[3 * count] = x.x, xyz[3 * count + 1] = x.y, xyz[3 * count + 2] = x.z;
            count++;
        }
    return make_points(xyz, count, 0);
}

ovoid_shape *make_lattice(uint64_t *r) {
    double xyz[3 * 8];
    size_t count = 4 + (size_t)(random_next(r) % 5);
    for (size_t i = 0; i < 3 * count; i++) xyz[i] = (double)(random_next(r) % 3);
    return make_points(xyz, count, 0);
}

ovoid_shape *make_round(uint64_t *r) {
    double radius = random_next(r) % 4 ? log_uniform(r, 1e-3, 10) : log_uniform(r, 1e-12, 1e6);
    switch (random_next(r) % 6) {
    case 0: return ovoid_shape_create_sphere(radius, NULL, NULL);
    case 1: return ovoid_shape_create_capsule(radius, 1, NULL, NULL);
    case 2: return make_box(1, 0.5, 0.25, radius);
    case 3: return make_flat(r, radius);
    case 4: return make_point(r, radius);
    default: return make_hull(r, random_count(r, 40), (ovoid_vec3){1, 2, 1}, zero, radius);
    }
}

ovoid_shape *make_prism(uint64_t *r) {
    uint32_t sides = 3 + (uint32_t)(random_next(r) % 40);
    double radius = log_uniform(r, 0.2, 5);
    return random_next(r) % 2 ? ovoid_shape_create_prism(&(ovoid_prism){radius, 1, sides}, NULL, NULL)
                              : ovoid_shape_create_pyramid(&(ovoid_prism){radius, 1, sides}, NULL, NULL);
}

ovoid_shape *make_any(uint64_t *r) {
    switch (random_next(r) % 10) {
    case 0: return make_needle(r);
    case 1: return make_slab(r);
    case 2: return make_flat(r, 0);
    case 3: return make_segment(r, 0);
    case 4: return make_point(r, 0);
    case 5: return make_round(r);
    case 6: return make_prism(r);
    case 7: return make_grid(r);
    case 8: return make_near_coplanar(r);
    default: return make_random_hull(r, 60, 1);
    }
}
