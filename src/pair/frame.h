// A pair of posed shapes in one frame: the body frame of A. Everything a query computes is in this frame; the constants
// below bound what rounding can do, and every bound that is reported is widened by them.
//
// With u = 2^-53, ea, eb the shapes' extents (spans, where they have allowances), t the position of B's body frame and
// s = ea + eb + |t| + radii:
// - a rotation matrix from a quaternion is off by 36 u in norm, B's rotation in A's frame by 82 u;
// - t is off by 43 u |t| (differences of positions are exact in double-double, far origins are rotated in it);
// - a difference x_b - x_a is off by 91 u s, a support gap along a unit direction by 100 u s, and by 142 u s if the
//   direction is given in the world frame; taking a direction to the world frame and back moves a gap by 96 u s.
// Hence a gap measured along a direction of the world is off by less than FRAME_CHECK, and a claim that is lowered by
// FRAME_CLAIM holds for the exact gap and is confirmed by any measurement to within FRAME_CHECK. docs/error-analysis.md
// derives these numbers.
#ifndef OVOID_PAIR_FRAME_H
#define OVOID_PAIR_FRAME_H

#include "linear/mat3.h"
#include "ovoid/prepared.h"
#include "shape/rim.h"
#include "simd/pair.h"

#define FRAME_CLAIM (256 * 0x1p-53)
#define FRAME_CHECK (148 * 0x1p-53)

/// A matrix that prepares a shape (query/prepared.c) is off the rotation of its pose by at most 170 u, which moves the
/// shape's points by that part of its extent. Bounds are widened by two or three times what is hidden.
#define FRAME_MATRIX (128 * 0x1p-53)
/// The bit of is_ready that says so.
enum { FRAME_BY_MATRIX = 2 };

/// The frame of a pair.
typedef struct pair_frame {
    // By frame_place: both bodies in the world.
    const ovoid_shape *a, *b;
    mat3 world, world_b;               ///< the rotations of A and B to the world
    vec3 world_origin;                 ///< of A's body frame, world
    vec3 offset;                       ///< of B's body frame from A's, world
    vec3 between;                      ///< of B's enclosing sphere's centre from A's, world
    const double *turned_a, *turned_b; ///< vertices of small bodies turned into the world's axes; NULL: not prepared
    double size;                       ///< s
    double claim;                      ///< FRAME_CLAIM s, and what underflow can hide
    double check;                      ///< FRAME_CHECK s, and what underflow can hide
    double hidden;                     ///< the lengths that underflow and far origins can hide, whatever the size
    double lower_radii; ///< the sums of both shapes' lower_radius and of their upper_radius (block.h); they differ
    double upper_radii; ///< by the allowances
    int is_true;        ///< 1: supports are those of true round bodies, which have no allowance then (round.h)
    double beyond;      ///< how far these exceed the polyhedra's spheres and ellipsoids
    // By frame_relate: B in the frame of A.
    mat3 rotation;    ///< x_a_frame = rotation x_b + translation
    vec3 translation; ///< of B's body frame
} pair_frame;

/// The frame of a pair, or the reason why there is none: SHAPE_A, SHAPE_B, POSE_A, POSE_B.
ovoid_limit frame_make(const ovoid_pair *pair, pair_frame *frame);

/// frame_make in two steps, for callers that may be done after the first: both bodies in the world; B in the frame of
/// A.
ovoid_limit frame_place(const ovoid_pair *pair, pair_frame *frame);
void frame_relate(pair_frame *frame);

/// Sets the lengths by which bounds are widened.
static inline void frame_set_lengths(pair_frame *f) {
    f->lower_radii = f->a->lower_radius + f->b->lower_radius;
    f->upper_radii = f->a->upper_radius + f->b->upper_radius;
    f->size = f->a->span + f->b->span + vec3_norm(f->offset) + f->lower_radii;
    f->claim = FRAME_CLAIM * f->size + 2 * f->hidden;
    f->check = FRAME_CHECK * f->size + f->hidden;
    f->is_true = 0;
    f->beyond = 0;
}

/// frame_place of prepared shapes, both of which must be ready, in two steps: everything but the rotations; the
/// rotations.
static inline void frame_place_prepared(const ovoid_prepared_shape *a, const ovoid_prepared_shape *b, pair_frame *f) {
    f->a = a->body.shape;
    f->b = b->body.shape;
    f->world_origin = a->body.pose.position;
    f->offset = vec3_sub(b->body.pose.position, a->body.pose.position);
    f->between = vec3_add(f->offset, vec3_sub(b->center, a->center));
    f->hidden = OVOID_LENGTH_MIN;
    if ((a->is_ready | b->is_ready) & FRAME_BY_MATRIX) f->hidden += FRAME_MATRIX * (f->a->span + f->b->span);
    frame_set_lengths(f);
}

void frame_place_rotations(const ovoid_prepared_shape *a, const ovoid_prepared_shape *b, pair_frame *frame);

/// The largest width of the bracket that the shapes' allowances cause.
static inline double frame_get_allowance(const pair_frame *f) { return f->lower_radii - f->upper_radii; }
/// 1 for a body that the frame takes as the true one, without an allowance.
static inline int frame_is_bare(const pair_frame *f, const ovoid_shape *s) { return f->is_true && shape_is_round(s); }
static inline int frame_has_axis(const pair_frame *f) {
    return (shape_has_axis(f->a) && !frame_is_bare(f, f->a)) || (shape_has_axis(f->b) && !frame_is_bare(f, f->b));
}
/// The gain of a lower bound along the unit direction n if an allowance is along an axis; `lower_radii` was subtracted
/// from the bound. Add it and round down. in_a: n in the axes of A; in_b: in those of B. error: of both (block.h).
static inline double frame_compute_gain(const pair_frame *f, vec3 in_a, vec3 in_b, double error) {
    double a = frame_is_bare(f, f->a) ? 0 : shape_compute_gain(f->a, in_a, error);
    return a + (frame_is_bare(f, f->b) ? 0 : shape_compute_gain(f->b, in_b, error));
}
/// The bound with that gain; never below the bound, so that a check with a larger gain shows no less.
static inline double frame_take_gain(double lower, double gain) {
    return gain > 0 ? max2(lower, nextafter(lower + gain, -INFINITY)) : lower;
}
/// 1 if the limit says that a query was refused, so that its answer claims nothing.
static inline int limit_is_refusal(ovoid_limit limit) {
    return limit == OVOID_LIMIT_MEMORY || (limit >= OVOID_LIMIT_POSE_A && limit <= OVOID_LIMIT_SHAPE_B);
}

/// A vertex of B in the frame.
static inline vec3 frame_b(const pair_frame *f, vec3 x) {
    return vec3_add(mat3_mul_vec3(f->rotation, x), f->translation);
}
static inline vec3 frame_vertex_a(const pair_frame *f, uint32_t i) { return vec3_at(shape_vertices(f->a), i); }
static inline vec3 frame_vertex_b(const pair_frame *f, uint32_t i) {
    return frame_b(f, vec3_at(shape_vertices(f->b), i));
}
/// The difference of two vertices of a proof, B minus A.
static inline vec3 frame_proof_difference(const pair_frame *f, uint32_t a, uint32_t b) {
    return vec3_sub(frame_b(f, shape_get_vertex(f->b, b)), shape_get_vertex(f->a, a));
}
/// The difference of two vertices of the polyhedra, B minus A.
static inline vec3 frame_difference(const pair_frame *f, uint32_t a, uint32_t b) {
    return vec3_sub(frame_vertex_b(f, b), frame_vertex_a(f, a));
}
/// B's point minus A's in the world's axes; the points are in their body frames, and frame_place is enough.
static inline vec3 frame_world_difference(const pair_frame *f, vec3 a, vec3 b) {
    return vec3_add(f->offset, vec3_sub(mat3_mul_vec3(f->world_b, b), mat3_mul_vec3(f->world, a)));
}
/// A point or direction of the frame in the world, and back.
static inline vec3 frame_point_to_world(const pair_frame *f, vec3 x) {
    return vec3_add(f->world_origin, mat3_mul_vec3(f->world, x));
}
static inline vec3 frame_direction_to_world(const pair_frame *f, vec3 n) { return mat3_mul_vec3(f->world, n); }
static inline vec3 frame_direction_from_world(const pair_frame *f, vec3 n) {
    return mat3_mul_transposed_vec3(f->world, n);
}

/// Where A and B are extreme toward each other along a unit direction n from A to B; of true bodies, if the frame says
/// so.
typedef struct frame_support {
    uint32_t a, b;
    double gap; ///< min over B of n.x - max over A of n.x, off by at most 100 u s
    vec3 w;     ///< x_b - x_a of the two vertices
} frame_support;
frame_support frame_find_support(const pair_frame *f, vec3 n);

/// The gap by a search of all vertices, without the shapes' tables: for verification.
double frame_measure_gap(const pair_frame *f, vec3 n);

/// The supports of A along in_a and of B along in_b, each in its own body frame.
simd_pair shapes_find_pair(const ovoid_shape *a, const ovoid_shape *b, vec3 in_a, vec3 in_b);
static inline simd_pair frame_find_pair(const pair_frame *f, vec3 in_a, vec3 in_b) {
    return shapes_find_pair(f->a, f->b, in_a, in_b);
}

#endif
