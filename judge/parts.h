// What the judge's files share: its state and the questions they answer for one another.
#ifndef OVOID_JUDGE_PARTS_H
#define OVOID_JUDGE_PARTS_H

#include "posed.h"
#include "shell.h"

/// What was proven, once, of a shape's inner ellipsoid.
typedef struct facts {
    const ovoid_shape *shape; ///< NULL: an empty slot
    int is_inside;            ///< positive definite and inside the polyhedron
    number radius;            ///< 0 <= radius <= smallest radius of the ellipsoid
} facts;

struct judge {
    pool *p;
    facts *table; ///< open addressing
    size_t capacity, count;
    double touching;
    nvec points[OVOID_COVER_POINTS];                ///< of the cover at hand
    uint32_t triangles[3 * 2 * OVOID_COVER_POINTS]; ///< of the cover at hand
};

/// Writes code and sentence (place -1) to *error, which may be NULL, and returns the code.
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
ovoid_code
judge_reject(ovoid_error *error, ovoid_code code, const char *format, ...);

/// A claim on the hulls without their radii, d <= core or d >= core, and what is to prove it.
typedef struct claim {
    judge *context;
    const posed *s;
    const ovoid_proof *proof;
    num core; ///< bound + radii
    ovoid_error *error;
} claim;

/// The direction of the lower bound: the exact sum of its two parts, which must be finite.
nvec proof_direction(pool *p, const ovoid_proof *proof);

ovoid_code judge_check_lower(const claim *c);
/// By proof.kind.
ovoid_code judge_check_upper(const claim *c, const ovoid_cover *cover);
/// The kinds that rest on the inner ellipsoids.
ovoid_code judge_check_inner(const claim *c);
ovoid_code judge_check_inner_points(const claim *c);

/// The witness points lie on their bodies.
ovoid_code judge_check_witness(const claim *c, const ovoid_answer *answer);

/// sum w[i] x(v[i]) times n, of a body's vertices, and the sum of the weights.
typedef struct weighted {
    nvec point;
    num weight;
} weighted;
weighted body_weighted_point(pool *p, const body *b, const uint32_t *v, const double *w, uint32_t count);

/// The inner ellipsoid's facts, from the table or now.
const facts *judge_get_facts(judge *context, const body *b);

/// The point of a proof of kind INNER or INNER_POINTS: n times the world point.
nvec inner_point_a(const claim *c);
nvec inner_point_b(const claim *c);

#endif
