// The search for an axis of box_axes.h, over four places of one vector in AVX2 and of an array elsewhere, with the same
// bits.
#ifndef OVOID_SIMD_KERNELS_BOX_SEPARATION_H
#define OVOID_SIMD_KERNELS_BOX_SEPARATION_H

#include "simd/box_axes.h"
#include "simd/kernels/lanes.h"

#if LANES == 4

typedef lane quad;
LANES_INLINE quad quad_set(double x) { return lane_set(x); }
LANES_INLINE quad quad_make(const double p[3], double last) { return _mm256_setr_pd(p[0], p[1], p[2], last); }
LANES_INLINE void quad_store(double p[4], quad v) { lane_store(p, v); }
LANES_INLINE quad quad_add(quad a, quad b) { return a + b; }
LANES_INLINE quad quad_sub(quad a, quad b) { return a - b; }
LANES_INLINE quad quad_mul(quad a, quad b) { return a * b; }
LANES_INLINE quad quad_abs(quad a) { return lane_abs(a); }
/// The first three places where a > b, as bits.
LANES_INLINE unsigned quad_greater(quad a, quad b) { return lane_bits(lane_greater(a, b)) & 7; }
/// Place i of the first three becomes the one that follows it.
LANES_INLINE quad quad_next(quad a) { return _mm256_permute4x64_pd(a, 0xc9); }
/// Place 3 in all places.
LANES_INLINE quad quad_last(quad a) { return _mm256_permute4x64_pd(a, 0xff); }

#else

typedef struct quad {
    double at[4];
} quad;
#define QUAD_EACH(value)                                                                                               \
    quad r;                                                                                                            \
    for (int i = 0; i < 4; i++) r.at[i] = (value);                                                                     \
    return r
LANES_INLINE quad quad_set(double x) { QUAD_EACH(x); }
LANES_INLINE quad quad_make(const double p[3], double last) { return (quad){{p[0], p[1], p[2], last}}; }
LANES_INLINE void quad_store(double p[4], quad v) {
    for (int i = 0; i < 4; i++) p[i] = v.at[i];
}
LANES_INLINE quad quad_add(quad a, quad b) { QUAD_EACH(a.at[i] + b.at[i]); }
LANES_INLINE quad quad_sub(quad a, quad b) { QUAD_EACH(a.at[i] - b.at[i]); }
LANES_INLINE quad quad_mul(quad a, quad b) { QUAD_EACH(a.at[i] * b.at[i]); }
LANES_INLINE quad quad_abs(quad a) { QUAD_EACH(fabs(a.at[i])); }
LANES_INLINE unsigned quad_greater(quad a, quad b) {
    unsigned bits = 0;
    for (int i = 0; i < 3; i++) bits |= (unsigned)(a.at[i] > b.at[i]) << i;
    return bits;
}
LANES_INLINE quad quad_next(quad a) { return (quad){{a.at[1], a.at[2], a.at[0], a.at[3]}}; }
LANES_INLINE quad quad_last(quad a) { QUAD_EACH(a.at[3]); }
#undef QUAD_EACH

#endif

// The edges of a box, and in place 3 what is between the centres.
typedef struct box_edges {
    quad x, y, z;
} box_edges;

LANES_INLINE box_edges load_edges(const double rows[9], vec3 d) {
    return (box_edges){quad_make(rows, d.x), quad_make(rows + 3, d.y), quad_make(rows + 6, d.z)};
}

LANES_INLINE quad dot_edges(box_edges e, double x, double y, double z) {
    quad xy = quad_add(quad_mul(e.x, quad_set(x)), quad_mul(e.y, quad_set(y)));
    return quad_add(xy, quad_mul(e.z, quad_set(z)));
}

// The products of both boxes' edges and of what is between: along[k] has edge k times the other's edges and, in place
// 3, times what is between; center the edges times what is between.
typedef struct box_products {
    quad along[3], size[3], center, half;
    const double *lengths;
} box_products;

LANES_INLINE box_products multiply(const double rows[9], const double half[3], box_edges other, vec3 d) {
    box_products p = {
        .center = dot_edges(load_edges(rows, d), d.x, d.y, d.z), .half = quad_make(half, half[0]), .lengths = half};
    for (int k = 0; k < 3; k++) {
        p.along[k] = dot_edges(other, rows[k], rows[3 + k], rows[6 + k]);
        p.size[k] = quad_abs(p.along[k]);
    }
    return p;
}

// The faces of a box whose normals separate it from the other.
LANES_INLINE unsigned look_at_faces(const box_products *p, const box_products *other, quad least) {
    quad reach = quad_add(quad_mul(other->size[0], quad_set(other->lengths[0])),
                          quad_mul(other->size[1], quad_set(other->lengths[1])));
    reach = quad_add(reach, quad_mul(other->size[2], quad_set(other->lengths[2])));
    return quad_greater(quad_sub(quad_sub(quad_abs(p->center), p->half), reach), least);
}

// The edges of B whose cross products with edge i of A separate. Of edges that are nearly parallel nothing but rounding
// is left.
LANES_INLINE unsigned look_at_edges(const box_products *a, const box_products *b, int i, double least) {
    static const int next[5] = {0, 1, 2, 0, 1};
    int k = next[i + 1], m = next[i + 2];
    quad gap = quad_abs(
        quad_sub(quad_mul(quad_last(a->along[m]), a->along[k]), quad_mul(quad_last(a->along[k]), a->along[m])));
    quad of_a = quad_add(quad_mul(quad_set(a->lengths[k]), a->size[m]), quad_mul(quad_set(a->lengths[m]), a->size[k]));
    quad second = quad_next(a->size[i]), half = quad_next(b->half);
    quad of_b = quad_add(quad_mul(half, quad_next(second)), quad_mul(quad_next(half), second));
    gap = quad_sub(gap, quad_add(of_a, of_b));
    quad square = quad_sub(quad_set(1), quad_mul(a->along[i], a->along[i]));
    unsigned apart = quad_greater(quad_mul(gap, gap), quad_mul(quad_set(least * least), square));
    return apart & quad_greater(gap, quad_set(0)) & quad_greater(square, quad_set(0x1p-40));
}

// How far a box reaches along a direction whose products with its edges are given.
LANES_INLINE double find_reach(quad along, quad half) {
    double at[4];
    quad_store(at, quad_mul(quad_abs(along), half));
    return (at[0] + at[1]) + at[2];
}

LANES_INLINE vec3 get_edge(const double rows[9], unsigned i) { return (vec3){rows[i], rows[3 + i], rows[6 + i]}; }

LANES_INLINE int run_separation(const box_separation_query *q, box_separation *out) {
    vec3 d = q->between, axis;
    box_edges edges_a = load_edges(q->a, d), edges_b = load_edges(q->b, d);
    box_products a = multiply(q->a, q->half_a, edges_b, d), b = multiply(q->b, q->half_b, edges_a, d);
    quad least = quad_set(q->least);
    unsigned faces = look_at_faces(&a, &b, least) | look_at_faces(&b, &a, least) << 3, edges = 0;
    if (faces) {
        unsigned i = (unsigned)__builtin_ctz(faces);
        axis = i < 3 ? get_edge(q->a, i) : get_edge(q->b, i - 3);
    } else {
        for (int i = 0; i < 3; i++) edges |= look_at_edges(&a, &b, i, q->least) << 3 * i;
        if (!edges) return 0;
        unsigned i = (unsigned)__builtin_ctz(edges);
        axis = vec3_cross(get_edge(q->a, i / 3), get_edge(q->b, i % 3));
    }
    // Measured anew: what chose the axis says nothing of its rounding.
    vec3 n = vec3_unit(axis);
    quad of_a = dot_edges(edges_a, n.x, n.y, n.z), of_b = dot_edges(edges_b, n.x, n.y, n.z);
    double between = vec3_dot(n, d);
    unsigned flip = between < 0 ? 7 : 0;
    out->gap = fabs(between) - (find_reach(of_a, a.half) + find_reach(of_b, b.half));
    out->n = flip ? vec3_neg(n) : n;
    out->high_a = quad_greater(of_a, quad_set(0)) ^ flip;
    out->low_b = quad_greater(of_b, quad_set(0)) ^ flip ^ 7;
    return 1;
}

#endif
