// The families of the long run: their pools, their shares, and how two bodies of one are placed.
#include "long_run.h"

#include "check.h"
#include "shapes.h"

#include <string.h>

static const ovoid_vec3 zero = {0, 0, 0};

static double random_sign(uint64_t *r, double x) { return random_next(r) % 2 ? x : -x; }

static ovoid_shape *make_some_box(uint64_t *r) {
    double x = log_uniform(r, 0.1, 1), y = log_uniform(r, 0.1, 1);
    return make_box(x, y, log_uniform(r, 0.1, 1), 0);
}
static ovoid_shape *make_half_box(uint64_t *r) {
    double x = 0.5 * (double)(1 + random_next(r) % 3), y = 0.5 * (double)(1 + random_next(r) % 3);
    return make_box(x, y, 0.5 * (double)(1 + random_next(r) % 3), 0);
}
// Hulls of about so many vertices, axes 1:1 to 1:4.
static ovoid_shape *make_sized(uint64_t *r, size_t low, size_t high) {
    double x = log_uniform(r, 1, 4), y = log_uniform(r, 1, 4), z = log_uniform(r, 1, 4);
    size_t count = low + (size_t)(random_next(r) % (high - low + 1));
    return make_hull(r, count, (ovoid_vec3){x, y, z}, zero, 0);
}
static ovoid_shape *make_8(uint64_t *r) { return make_sized(r, 4, 8); }
static ovoid_shape *make_32(uint64_t *r) { return make_sized(r, 9, 32); }
static ovoid_shape *make_128(uint64_t *r) { return make_sized(r, 33, 128); }
static ovoid_shape *make_512(uint64_t *r) { return make_sized(r, 129, 512); }
static ovoid_shape *make_2048(uint64_t *r) { return make_sized(r, 513, 2048); }
static ovoid_shape *make_long(uint64_t *r) { return make_long_hull(r, 64); }
static ovoid_shape *make_flat_one(uint64_t *r) { return make_flat(r, 0); }
static ovoid_shape *make_low_rank(uint64_t *r) {
    switch (random_next(r) % 4) {
    case 0: return make_point(r, 0);
    case 1: return make_flat(r, 0);
    case 2: return make_8(r);
    default: return make_segment(r, 0);
    }
}
static ovoid_shape *make_scaled(uint64_t *r) {
    const double scales[] = {1e-9, 1, 1e9};
    return make_random_hull(r, 32, scales[random_next(r) % 3]);
}
static ovoid_shape *make_wild(uint64_t *r) { return make_random_hull(r, 20, log_uniform(r, 1e-80, 1e45)); }
static ovoid_shape *make_far_vertices(uint64_t *r) {
    ovoid_vec3 center = random_vec3(r, 1e7);
    return make_hull(r, random_count(r, 40), (ovoid_vec3){1, 2, 1}, center, 0);
}

// A plate whose top is at z = 0, and bodies that reach down to z = 0: a box, a bar on its edge, a cube on a corner.
static ovoid_shape *make_plate(uint64_t *r) {
    double x = random_uniform(r, 8, 16), y = random_uniform(r, 8, 16), z = log_uniform(r, 0.1, 4);
    const double xyz[24] = {-x, -y, 0, x, -y, 0, -x, y, 0, x, y, 0, -x, -y, -z, x, -y, -z, -x, y, -z, x, y, -z};
    return make_points(xyz, 8, 0);
}
static ovoid_shape *make_standing(uint64_t *r) {
    static const double bar[24] = {0, -2, 4, 0, 2, 4, 0, -2, 0, 0, 2, 0, 2, -2, 2, 2, 2, 2, -2, -2, 2, -2, 2, 2};
    static const double cube[24] = {-3, 5, 0, -5, 1, 5, -1, 1, 4, -3, -3, 9, 3, 3, 1, 1, -1, 6, 5, -1, 5, 3, -5, 10};
    double x = random_uniform(r, 0.5, 4), y = random_uniform(r, 0.5, 4), z = log_uniform(r, 0.5, 4);
    const double box[24] = {-x, -y, 0, x, -y, 0, -x, y, 0, x, y, 0, -x, -y, z, x, -y, z, -x, y, z, x, y, z};
    const double *const all[] = {bar, cube, box};
    return make_points(all[random_next(r) % 3], 8, 0);
}

const long_family long_families[] = {
    {"boxes", make_some_box, 16, 12, PLACE_ANY, NULL},
    {"boxes, aligned", make_half_box, 16, 8, PLACE_ALIGNED, NULL},
    {"lattice, shared corners", make_lattice, 24, 8, PLACE_COMMON, NULL},
    {"contacts known exactly", make_plate, 24, 4, PLACE_STACKED, make_standing},
    {"hulls of 4 to 8", make_8, 24, 14, PLACE_ANY, NULL},
    {"hulls of 9 to 32", make_32, 16, 14, PLACE_ANY, NULL},
    {"hulls of 33 to 128", make_128, 8, 6, PLACE_ANY, NULL},
    {"hulls of 129 to 512", make_512, 4, 2, PLACE_ANY, NULL},
    {"hulls of 513 to 2048", make_2048, 2, 1, PLACE_ANY, NULL},
    {"axes to 1:1000", make_long, 16, 6, PLACE_ANY, NULL},
    {"needles", make_needle, 16, 5, PLACE_ANY, NULL},
    {"slabs", make_slab, 16, 5, PLACE_ANY, NULL},
    {"flat polygons", make_flat_one, 16, 5, PLACE_ANY, NULL},
    {"segments and points", make_low_rank, 16, 5, PLACE_ANY, NULL},
    {"round", make_round, 16, 5, PLACE_ANY, NULL},
    {"prisms", make_prism, 12, 4, PLACE_ANY, NULL},
    {"near-coplanar", make_near_coplanar, 8, 4, PLACE_ANY, NULL},
    {"grids", make_grid, 8, 4, PLACE_ANY, NULL},
    {"any with any", make_any, 16, 6, PLACE_ANY, NULL},
    {"identical", make_8, 16, 2, PLACE_SAME, NULL},
    {"contained", make_32, 16, 2, PLACE_INSIDE, NULL},
    {"scales 1e-9, 1, 1e9", make_scaled, 16, 3, PLACE_ANY, NULL},
    {"scales 1e-80 to 1e45", make_wild, 16, 2, PLACE_ANY, NULL},
    {"1e7 from the origin", make_32, 16, 3, PLACE_FAR, NULL},
    {"vertices 1e7 away", make_far_vertices, 12, 3, PLACE_ANY, NULL},
    {"quaternions of any norm", make_8, 24, 3, PLACE_NORMS, NULL},
    {"real hulls", NULL, 24, 8, PLACE_ANY, NULL},
};
const size_t long_family_count = sizeof long_families / sizeof *long_families;

double random_gap(uint64_t *r) {
    switch (random_next(r) % 8) {
    case 0: return 0;
    case 1: return random_sign(r, log_uniform(r, 1e-15, 1e-9));
    case 2: return random_sign(r, log_uniform(r, 1e-9, 1e-3));
    case 3: return -log_uniform(r, 1e-3, 0.2);
    case 4: return log_uniform(r, 1, 1e3);
    case 5: return 0.01;
    default: return log_uniform(r, 1e-3, 1);
    }
}

static ovoid_vec3 add(ovoid_vec3 a, ovoid_vec3 b) { return (ovoid_vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }

// Moves B so that its sphere's centre is at an offset from A's.
static void set_offset(const item *a, const item *b, ovoid_pair *pair, ovoid_vec3 offset) {
    ovoid_vec3 ca = ovoid_pose_compute_point(&pair->pose_a, a->center);
    pair->pose_b.position = zero;
    ovoid_vec3 cb = ovoid_pose_compute_point(&pair->pose_b, b->center);
    pair->pose_b.position = (ovoid_vec3){ca.x + offset.x - cb.x, ca.y + offset.y - cb.y, ca.z + offset.z - cb.z};
}

static void place_aligned(ovoid_pair *pair, uint64_t *r) {
    const ovoid_quat turns[] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {2, 0, 1, 0}, random_quat(r)};
    ovoid_pose turn = {{0, 0, 0}, turns[random_next(r) % 4]};
    double d[3];
    for (int i = 0; i < 3; i++) {
        d[i] = 0.5 * (double)((int)(random_next(r) % 13) - 6);
        // Sometimes a little off.
        if (random_next(r) % 4 == 0) d[i] += random_sign(r, log_uniform(r, 0x1p-50, 0x1p-10));
    }
    pair->pose_a.rotation = pair->pose_b.rotation = turn.rotation;
    pair->pose_b.position = ovoid_pose_compute_point(&turn, (ovoid_vec3){d[0], d[1], d[2]});
}

static void place_common(ovoid_pair *pair, uint64_t *r) {
    if (random_next(r) % 2) {
        pair->pose_a.position = random_vec3(r, 10);
        pair->pose_a.rotation = random_quat(r);
        pair->pose_b = pair->pose_a;
        return;
    }
    // Exact steps.
    double d[3];
    for (int i = 0; i < 3; i++) d[i] = (double)((int)(random_next(r) % 5) - 2);
    pair->pose_b.position = (ovoid_vec3){d[0], d[1], d[2]};
    if (random_next(r) % 2) pair->pose_b.rotation = (ovoid_quat){1, 0, 0, 1};
}

// Turns about z leave heights as they are, whatever the quaternion; the gap is B's height. Aside by up to 1/4, and no
// deeper than 1/50, B is nearest straight above A.
static double place_stacked(ovoid_pair *pair, uint64_t *r) {
    double above = log_uniform(r, 1e-16, 1e3), below = -log_uniform(r, 1e-16, 1e-2);
    double tiny = random_sign(r, log_uniform(r, 1e-40, 1e-16));
    const double gaps[] = {0, tiny, above, above, above, above, below, below};
    pair->pose_a.rotation.z = random_normal(r);
    pair->pose_b.rotation.z = random_normal(r);
    pair->pose_b.position.x = random_uniform(r, -0.25, 0.25);
    pair->pose_b.position.y = random_uniform(r, -0.25, 0.25);
    pair->pose_b.position.z = gaps[random_next(r) % 8];
    return pair->pose_b.position.z;
}

static void scale_norm(ovoid_quat *q, double s) { *q = (ovoid_quat){q->w * s, q->x * s, q->y * s, q->z * s}; }

double place_pair(const long_family *f, const item *a, const item *b, ovoid_pair *pair, uint64_t *r) {
    const double far[] = {3, 1, 0.6, 0.4, 0.2, 0.1};
    double size = a->reach + b->reach;
    *pair = (ovoid_pair){a->shape, b->shape, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    if (f->place == PLACE_STACKED) return place_stacked(pair, r);
    if (f->place == PLACE_ALIGNED) {
        place_aligned(pair, r);
        return NAN;
    }
    if (f->place == PLACE_COMMON) {
        place_common(pair, r);
        return NAN;
    }
    pair->pose_a.position = random_vec3(r, f->place == PLACE_FAR ? 1e7 : size);
    pair->pose_a.rotation = random_quat(r);
    if (f->place == PLACE_SAME) {
        pair->shape_b = pair->shape_a;
        pair->pose_b = pair->pose_a;
        double off = random_gap(r) * size;
        if (random_next(r) % 2) pair->pose_b.position = add(pair->pose_b.position, random_vec3(r, off));
        return NAN;
    }
    pair->pose_b.rotation = random_quat(r);
    double off = f->place == PLACE_INSIDE ? log_uniform(r, 1e-12, 0.1) : far[random_next(r) % 6];
    set_offset(a, b, pair, random_vec3(r, off * size));
    if (f->place == PLACE_NORMS) {
        scale_norm(&pair->pose_a.rotation, log_uniform(r, 1e-150, 1e150));
        scale_norm(&pair->pose_b.rotation, log_uniform(r, 1e-150, 1e150));
    }
    return NAN;
}
