// A large set of answers, the same on every machine, and its hash, which must be equal for all compilers, levels of
// optimisation, vector widths and threads. Only operations that IEEE 754 rounds correctly go into the input, so the
// version of the mathematics library does not matter.
#ifndef OVOID_TESTS_BITS_H
#define OVOID_TESTS_BITS_H

#include "check.h"
#include "ovoid/ovoid.h"
#include "proofs/covers.h"

/// FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo, 1991), over bytes as they are: +0 and -0 differ.
static inline uint64_t bits_add(uint64_t hash, const void *data, size_t size) {
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++) hash = (hash ^ bytes[i]) * 1099511628211u;
    return hash;
}
#define BITS_START 14695981039346656037u
#define BITS_ADD(hash, value) ((hash) = bits_add((hash), &(value), sizeof(value)))

static inline uint64_t bits_add_answer(uint64_t hash, const ovoid_answer *answer) {
    const ovoid_proof *p = &answer->proof;
    hash = bits_add(hash, answer, offsetof(ovoid_answer, proof));
    BITS_ADD(hash, p->normal);
    BITS_ADD(hash, p->normal_low);
    BITS_ADD(hash, p->kind);
    BITS_ADD(hash, p->count);
    hash = bits_add(hash, p->a, p->count * sizeof *p->a);
    hash = bits_add(hash, p->b, p->count * sizeof *p->b);
    hash = bits_add(hash, p->weight_a, p->count * sizeof *p->weight_a);
    hash = bits_add(hash, p->weight_b, p->count * sizeof *p->weight_b);
    BITS_ADD(hash, p->inner_a);
    BITS_ADD(hash, p->inner_b);
    return hash;
}

static inline uint64_t bits_add_cover(uint64_t hash, const ovoid_cover *c) {
    hash = bits_add(hash, c->a, c->point_count * sizeof *c->a);
    hash = bits_add(hash, c->b, c->point_count * sizeof *c->b);
    return bits_add(hash, c->triangles, c->triangle_count * sizeof *c->triangles);
}

/// Uniform in [-1, 1), exactly a multiple of 2^-52.
static inline double bits_coordinate(uint64_t *s) { return (double)(random_next(s) >> 11) * 0x1p-52 - 1; }
static inline ovoid_vec3 bits_vec3(uint64_t *s, double scale) {
    double x = bits_coordinate(s), y = bits_coordinate(s), z = bits_coordinate(s);
    return (ovoid_vec3){scale * x, scale * y, scale * z};
}
static inline ovoid_quat bits_quat(uint64_t *s) {
    double w = bits_coordinate(s), x = bits_coordinate(s), y = bits_coordinate(s), z = bits_coordinate(s);
    return (ovoid_quat){w, x, y, z};
}

/// The families of shapes.
typedef enum bits_family {
    BITS_PLAIN,
    BITS_ROUND,
    BITS_LARGE,
    BITS_NEEDLE,
    BITS_SLAB,
    BITS_FLAT,
    BITS_SEGMENT,
    BITS_BALL,
    BITS_BOX,
    BITS_FAR,
    BITS_TINY,
    BITS_HUGE,
    BITS_FAMILIES
} bits_family;
static const char *const bits_names[BITS_FAMILIES] = {"plain",    "round", "large", "needles", "slabs", "flat",
                                                      "segments", "balls", "boxes", "far",     "tiny",  "huge"};

/// The approximate size of a family's shapes.
static inline double bits_scale(bits_family f) { return f == BITS_TINY ? 0x1p-40 : f == BITS_HUGE ? 0x1p60 : 1; }

/// The place of the family's shapes in their own frames: exact in the coordinates.
static inline double bits_away(bits_family f) { return f == BITS_FAR ? 0x1p20 : 0; }

static inline ovoid_shape *bits_make_shape(bits_family f, uint64_t *s) {
    double xyz[3 * 300];
    size_t count = f == BITS_LARGE ? 300 : f == BITS_SEGMENT ? 2 : f == BITS_BALL ? 1 : 4 + random_next(s) % 36;
    double y = f == BITS_NEEDLE ? 0x1p-10 : 0.5, z = f == BITS_NEEDLE || f == BITS_SLAB ? 0x1p-10
                                                     : f == BITS_FLAT                   ? 0
                                                                                        : 1;
    for (size_t i = 0; i < count; i++) {
        ovoid_vec3 v = bits_vec3(s, 1);
        if (f == BITS_ROUND || f == BITS_LARGE) {
            double n = sqrt((v.x * v.x + v.y * v.y) + v.z * v.z);
            v = (ovoid_vec3){v.x / n, v.y / n, v.z / n};
        }
        xyz[3 * i] = v.x * bits_scale(f) + bits_away(f);
        xyz[3 * i + 1] = v.y * y * bits_scale(f);
        xyz[3 * i + 2] = v.z * z * bits_scale(f);
    }
    ovoid_shape_options o = {.radius = f == BITS_BALL || random_next(s) % 4 == 0 ? 0.125 * bits_scale(f) : 0,
                             .inner = random_next(s) % 8 == 0 ? OVOID_INNER_PHASES : OVOID_INNER_MAXIMUM};
    if (f == BITS_BOX) return ovoid_shape_create_box((ovoid_vec3){1, 0.5, 0.25}, &o, NULL);
    return ovoid_shape_create_from_points(xyz, count, &o, NULL);
}

/// Adds the shape's bytes: vertices, ellipsoids, and the derived data.
static inline uint64_t bits_add_shape(uint64_t hash, const ovoid_shape *shape) {
    unsigned char bytes[1 << 16];
    hash = bits_add(hash, bytes, ovoid_shape_write(shape, bytes, sizeof bytes));
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    hash = bits_add(hash, p.triangles, 3 * (size_t)p.triangle_count * sizeof *p.triangles);
    hash = bits_add(hash, p.triangle_facets, p.triangle_count * sizeof *p.triangle_facets);
    hash = bits_add(hash, p.planes, p.facet_count * sizeof *p.planes);
    ovoid_measures m = ovoid_shape_get_measures(shape);
    return BITS_ADD(hash, m);
}

enum { BITS_EACH = 4, BITS_SHAPES = BITS_FAMILIES * BITS_EACH };

/// All shapes; 0 if one could not be made.
static inline int bits_make_shapes(ovoid_shape *shapes[BITS_SHAPES]) {
    uint64_t s = 42;
    int all = 1;
    for (int i = 0; i < BITS_SHAPES; i++) {
        shapes[i] = bits_make_shape((bits_family)(i / BITS_EACH), &s);
        all &= shapes[i] != NULL;
    }
    return all;
}

/// The i-th pair, its first shape of the family; a quarter of the pairs each: anywhere, at exact places on a grid
/// without rotation, close to the same place, near.
static inline ovoid_pair bits_make_pair(ovoid_shape *const shapes[BITS_SHAPES], bits_family f, uint32_t i) {
    uint64_t s = 1000003u * (uint64_t)i + (uint64_t)f;
    bits_family other = i % 3 == 0 ? (bits_family)(random_next(&s) % BITS_FAMILIES) : f;
    ovoid_pair p = {shapes[(uint64_t)f * BITS_EACH + random_next(&s) % BITS_EACH],
                    shapes[(uint64_t)other * BITS_EACH + random_next(&s) % BITS_EACH],
                    {{0, 0, 0}, {1, 0, 0, 0}},
                    {{0, 0, 0}, {1, 0, 0, 0}}};
    double scale = fmax(bits_scale(f), bits_scale(other));
    p.pose_b.position = bits_vec3(&s, i % 4 == 2 ? 0.0625 * scale : i % 4 == 3 ? scale : 3 * scale);
    if (i % 4 == 1) {
        uint64_t grid = random_next(&s);
        p.pose_b.position = (ovoid_vec3){scale * (double)(grid % 5) * 0.5, scale * (double)(grid / 5 % 3) * 0.5, 0};
    } else {
        p.pose_a.rotation = bits_quat(&s);
        p.pose_b.rotation = bits_quat(&s);
    }
    // Shapes far from their frames' origins are moved near, also by steps of the grid.
    if (i % 4 == 1) p.pose_a.position.x -= bits_away(f), p.pose_b.position.x -= bits_away(other);
    if (f == other && i % 4 > 1) p.pose_b.rotation = p.pose_a.rotation;
    return p;
}

enum { BITS_ANSWERS = 9 };

/// Every query of a pair.
static inline uint64_t bits_add_pair(uint64_t hash, const ovoid_pair *p) {
    LOCAL_COVER(cover);
    LOCAL_COVER(warm_cover);
    ovoid_options few = {.iterations = 3, .relative_tolerance = 0x1p-20};
    ovoid_answer x[BITS_ANSWERS] = {ovoid_depth(p, NULL, NULL, &cover), ovoid_collide(p, NULL, NULL),
                                    ovoid_distance(p, NULL, NULL), ovoid_pair_compute_bounds(p)};
    x[4] = ovoid_within(p, 0.25 * fabs(x[2].upper), NULL, NULL);
    x[5] = ovoid_collide(p, NULL, &x[0].proof);
    x[6] = ovoid_distance(p, NULL, &x[1].proof);
    x[7] = ovoid_depth(p, NULL, &x[2].proof, &warm_cover);
    x[8] = ovoid_distance(p, &few, NULL);
    for (int k = 0; k < BITS_ANSWERS; k++) {
        hash = bits_add_answer(hash, &x[k]);
        const ovoid_cover *shown = k == 0 ? &cover : k == 7 ? &warm_cover : NULL;
        ovoid_code code =
            ovoid_answer_verify(p, &x[k], &(ovoid_answer_basis){.options = k == 8 ? &few : NULL, .cover = shown}, NULL);
        BITS_ADD(hash, code);
    }
    return bits_add_cover(bits_add_cover(hash, &cover), &warm_cover);
}

/// The same points of a manifold to the last bit, without their padding.
static inline int points_are_same(const ovoid_manifold_points *a, const ovoid_manifold_points *b) {
    int is_same = a->count == b->count;
    for (uint32_t k = 0; is_same && k < a->count; k++) {
        const ovoid_manifold_point *p = &a->points[k], *q = &b->points[k];
        is_same = memcmp(p, q, offsetof(ovoid_manifold_point, id)) == 0 && p->id == q->id;
    }
    return is_same;
}

// ---- vector widths: what the compiler's runtime knows of the processor is made less

#if defined(__x86_64__)
/// Of libgcc and of compiler-rt alike: the first word of features, by the numbers of GCC's enum processor_features.
extern struct cpu_model { unsigned vendor, type, subtype, features[1]; } __cpu_model;

/// With the narrower ones: AVX2, then plain C.
static inline void bits_run_narrower(void (*check)(void)) {
    enum { AVX2 = 10, AVX512F = 15 };
    unsigned all = __cpu_model.features[0];
    __cpu_model.features[0] = all & ~(1u << AVX512F);
    check();
    __cpu_model.features[0] = all & ~(1u << AVX512F | 1u << AVX2);
    check();
    __cpu_model.features[0] = all;
}
#else
static inline void bits_run_narrower(void (*check)(void)) { (void)check; }
#endif

#endif
