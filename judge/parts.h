// Shared by the judge's files: its state, and the functions that they call in one another.
#ifndef OVOID_JUDGE_PARTS_H
#define OVOID_JUDGE_PARTS_H

#include "judge.h"
#include "posed.h"

#include <math.h>

/// The facts proven about a shape's inner ellipsoid, computed once.
typedef struct facts {
    const ovoid_shape *shape; ///< NULL: an empty slot
    int is_inside;            ///< positive definite and inside the polyhedron
    number radius;            ///< 0 <= radius <= smallest radius of the ellipsoid
} facts;

struct judge {
    pool *p;
    facts *table; ///< open addressing
    size_t capacity, count;
    double absolute, relative; ///< the tolerances of "touching"
    nvec *points;              ///< of the present surface, room for so many and twice as many triangles
    uint32_t *triangles;
    uint32_t point_room;
};

/// Frees the room of the present surface.
void judge_forget_surface(judge *context);

/// Writes code and sentence (place -1) to *error, which may be NULL, and returns the code.
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
ovoid_code
judge_reject(ovoid_error *error, ovoid_code code, const char *format, ...);

static inline int is_finite(ovoid_vec3 v) { return isfinite(v.x) && isfinite(v.y) && isfinite(v.z); }

/// A claim about the hulls without their radii, d <= core or d >= core, and its evidence.
typedef struct claim {
    judge *context;
    const posed *s;
    const ovoid_proof *proof;
    num core; ///< bound + radii
    ovoid_error *error;
} claim;

/// The direction of the lower bound: the exact sum of its two parts, which must be finite.
nvec proof_direction(pool *p, const ovoid_proof *proof);

/// The lower bound, by proof.normal and normal_low.
ovoid_code judge_verify_lower(const claim *c);
/// The upper bound, by proof.kind.
ovoid_code judge_verify_upper(const claim *c, const ovoid_cover *cover);
/// The upper bounds that rest on the inner ellipsoids.
ovoid_code judge_verify_inner(const claim *c);

/// 1 if a point of the world is no farther than `reach` from the body's hull.
int body_holds(pool *p, const body *b, nvec point, num reach);

/// The witness points lie on their bodies.
ovoid_code judge_verify_witness(const claim *c, const ovoid_answer *answer);

/// OVOID_OK if the bracket of "touching" contains zero and is no wider than the tolerance, for bodies of that size;
/// reach: the sum of all positions and lengths, of which double-doubles resolve 2^-88.
ovoid_code judge_verify_touching(const judge *context, const ovoid_answer *answer, double size, double reach,
                                 ovoid_error *error);

/// judge_verify_answer of a posed pair whose answer is not a refusal; judge_verify_points.
ovoid_code judge_verify_posed(judge *context, const posed *s, const ovoid_answer *answer, const ovoid_cover *cover,
                              ovoid_error *error);
ovoid_code judge_verify_points_posed(const posed *s, const ovoid_answer *answer, ovoid_error *error);

/// A table of all pairs of parts or triangles, rows and columns in the orders of both trees.
typedef struct pair_table {
    uint32_t rows, columns;
    uint32_t row, column; ///< of the deciding pair
    const ovoid_exclusion *items;
    size_t count;
} pair_table;

/// 1 if the rectangles of the exclusions, whose ranges must be in the table, and the deciding pair's own square cover
/// the table; else 0, with a pair that they do not cover.
int judge_is_covered(const pair_table *table, uint32_t *row, uint32_t *column);

/// 1 if the order names each of `count` items once; *place: the place of item `of`.
int judge_is_order(const uint32_t *order, uint32_t count, uint32_t of, uint32_t *place);

/// 1 if the edges of the triangles cancel, as pieces of lines. points: xyz of point i at 3 i; corners: of triangle t at
/// 3 t.
int judge_is_chain_closed(pool *p, const double *points, const uint32_t *corners, size_t triangles);

/// The sum of w[i] times vertex v[i] of a body in the world, times the body's n, and the sum of the weights.
typedef struct weighted {
    nvec point;
    num weight;
} weighted;
weighted body_weighted_point(pool *p, const body *b, const uint32_t *v, const double *w, uint32_t count);

/// The inner ellipsoid's facts, from the table or computed.
const facts *judge_get_facts(judge *context, const body *b);

/// The point of a proof of kind INNER or INNER_POINTS: n times the world point.
nvec inner_point_a(const claim *c);
nvec inner_point_b(const claim *c);

#endif
