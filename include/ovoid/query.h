/**
 * @file query.h
 * Proximity of two posed shapes: do they touch, how far apart, how deep; each answer with its bracket and its proof.
 * Queries allocate nothing, lock nothing, keep no global state and do bounded work. In optimised builds each takes at
 * most 96 KB of stack, so a thread of 128 KB will do; with sanitizers or without optimisation, several times as much.
 */
#ifndef OVOID_QUERY_H
#define OVOID_QUERY_H

#include "ovoid/shape.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Two posed shapes. The shapes are borrowed. */
typedef struct ovoid_pair {
    const ovoid_shape *shape_a, *shape_b;
    ovoid_pose pose_a, pose_b;
} ovoid_pair;

/** What is proven about the signed distance d (positive: the distance; negative: minus the penetration depth). */
typedef enum ovoid_status {
    OVOID_UNDECIDED = 0, /**< the sign of d is not proven; ovoid_answer.limit says why */
    OVOID_SEPARATED,     /**< lower > 0 */
    OVOID_TOUCHING,      /**< lower <= 0 <= upper, and upper - lower is at most the options' tolerance; the bodies'
                            allowances do not widen it */
    OVOID_OVERLAPPING    /**< upper < 0 */
} ovoid_status;

/** The stage that decided. */
typedef enum ovoid_stage {
    OVOID_STAGE_NONE = 0,
    OVOID_STAGE_PROOF,   /**< the earlier proof or cover handed in */
    OVOID_STAGE_SPHERE,  /**< enclosing spheres */
    OVOID_STAGE_OUTER,   /**< outer ellipsoids */
    OVOID_STAGE_SUPPORT, /**< the polyhedra's supports along the ellipsoids' direction, or the closed form of points,
                            segments and boxes */
    OVOID_STAGE_INNER,   /**< inner ellipsoids */
    OVOID_STAGE_GJK,     /**< exact: Gilbert, Johnson, Keerthi 1988 */
    OVOID_STAGE_EPA,     /**< exact: expanding polytope, van den Bergen 2001; for two boxes, or polyhedra
                            of up to 32 vertices each, all faces of the difference at once */
    OVOID_STAGE_REFINE   /**< in pairs of doubles, where doubles cannot tell the sign or reach the tolerance */
} ovoid_stage;

/** Why a query stopped before its bracket was narrower than the tolerance. */
typedef enum ovoid_limit {
    OVOID_LIMIT_NONE = 0,   /**< the bracket is as narrow as asked, except for the bodies' allowances */
    OVOID_LIMIT_ANSWERED,   /**< the query (collide, within, bounds) is answered; the bracket is true but wide */
    OVOID_LIMIT_CAP,        /**< proven farther than options.cap */
    OVOID_LIMIT_ITERATIONS, /**< options.iterations used up */
    OVOID_LIMIT_PRECISION,  /**< no further progress, in pairs of doubles either; for bodies with allowances also an
                               overlap that the few pairs of vertices in a proof cannot prove, but ovoid_depth may */
    OVOID_LIMIT_CAPACITY,   /**< the depth search filled its working memory; a cover may bring more */
    OVOID_LIMIT_POSE_A,     /**< refused: pose_a has NaN, infinity, a length out of range or a zero quaternion */
    OVOID_LIMIT_POSE_B,     /**< refused: pose_b, for the same reasons */
    OVOID_LIMIT_OPTIONS,    /**< refused: a tolerance, cap or margin that is NaN or negative */
    OVOID_LIMIT_SHAPE_A, /**< refused: there is no shape_a (NULL); or a body has not exactly one of shape, compound and
                            solid */
    OVOID_LIMIT_SHAPE_B, /**< refused: shape_b, for the same reasons */
    OVOID_LIMIT_ALLOWANCE, /**< the shapes' allowances leave the sign of d, or the margin, open; no search can narrow
                              the bracket */
    OVOID_LIMIT_MEMORY     /**< refused: the memory of a cover is NULL or too small */
} ovoid_limit;

/** The kind of evidence for the upper bound. */
typedef enum ovoid_proof_kind {
    OVOID_PROOF_NONE = 0, /**< no upper bound: upper is infinity */
    OVOID_PROOF_POINTS,   /**< a point of A and a point of B, convex combinations of vertices: d <= their distance */
    OVOID_PROOF_HULL,     /**< the origin is strictly inside a surface of 4 to 6 differences b[i] - a[i]: d < 0 */
    OVOID_PROOF_INNER,    /**< a point strictly inside both inner ellipsoids: d < 0 */
    OVOID_PROOF_INNER_POINTS, /**< a point of each inner ellipsoid: d <= their distance */
    OVOID_PROOF_COVER,        /**< a closed surface of differences around the origin (ovoid_cover): depth */
    OVOID_PROOF_BALLS         /**< a ball inside each body: d <= the distance of their centres minus their radii */
} ovoid_proof_kind;

/**
 * The largest number of pairs of vertices in a proof. A point inside a hull is strictly inside the hull of at most six
 * of its points (E. Steinitz, Bedingt konvergente Reihen und konvexe Systeme, 1913); the centre of an octahedron needs
 * all six.
 */
#define OVOID_PROOF_PAIRS 6

/**
 * A proof: plain data that ovoid_answer_verify, or any program with exact arithmetic, can check. It is also the warm
 * start of the pair's next query. Indices are vertices of ovoid_polytope, or points of round bodies. Rounding radii are
 * subtracted from both bounds.
 *
 * Lower bound: for every unit n, d >= min over B of n.x - max over A of n.x - radii; normal + normal_low is that n
 * (nearly unit: divide by its norm). Zero if there is no lower bound.
 * Upper bound: as `kind` says. POINTS: sum weight_a[i] x(a[i]) / sum weight_a[i] is the point of A, and the same of B
 * gives that of B. HULL: four differences are the corners of a tetrahedron; of five or six, 0 and 1 are the tips of a
 * double pyramid over the closed ring 2, 3, ..., with triangles (0, r, next r) and (1, next r, r); upper is minus the
 * origin's distance to that surface, minus the radii; the weights give a common point of the bodies. BALLS, of pairs
 * with a true cylinder, cone or ellipsoid (ovoid_round): the centre in such a body is inner_a or inner_b, that in
 * another body is its point of POINTS. The radius is that of the largest ball about the centre inside the body, before
 * rounding; it is zero for a point of POINTS; for a centre outside of its body it is below zero, minus the distance.
 *
 * Points of rims: with its highest bit set an index of a true cylinder or cone is a point of a rim. Bit 30 is 1 on the
 * rim of a cylinder's upper end, bits 29 and 28 are the quarter of the circle, and t = (the other 28 bits) / 2^28 is
 * the tangent of half the angle in it. In doubles, with part = radius / (1 + t t): ((1 - t t) part, 2 t part), turned
 * by 90 degrees for each quarter; z is -half_length or half_length; minus the origin of ovoid_polytope. The same in a
 * cover.
 *
 * Points of ellipsoids: of a true ellipsoid the other 31 bits are (i + 23169) 46339 + (j + 23169), with |i|, |j| <=
 * 23169. With z = 23169 - |i| - |j|, (x, y) is (i, j) where z >= 0, else (23169 - |j|, 23169 - |i|) with the signs of i
 * and j, + for 0. In doubles, with l = sqrt(x x + y y + z z): (a (x / l), b (y / l), c (z / l)), (a, b, c) the half
 * axes; minus the origin of ovoid_polytope.
 */
typedef struct ovoid_proof {
    ovoid_vec3 normal;     /**< world frame, from A to B */
    ovoid_vec3 normal_low; /**< the direction is the exact sum normal + normal_low; zero except for stage REFINE */
    ovoid_proof_kind kind;
    uint32_t count; /**< entries used of the arrays */
    uint32_t a[OVOID_PROOF_PAIRS], b[OVOID_PROOF_PAIRS];
    double weight_a[OVOID_PROOF_PAIRS], weight_b[OVOID_PROOF_PAIRS]; /**< >= 0, not all zero */
    ovoid_vec3 inner_a; /**< INNER: the common point; INNER_POINTS, BALLS: the point of A; body frame of A */
    ovoid_vec3 inner_b; /**< INNER_POINTS, BALLS: the point of B, body frame of B */
} ovoid_proof;

/** Points of a depth's surface that a search holds in its own memory, on the stack. */
#define OVOID_COVER_POINTS 512
/** The largest number of points of a cover. */
#define OVOID_COVER_POINTS_MAX 32767
/** Bytes of memory of a cover of up to OVOID_COVER_POINTS points, for an array. */
#define OVOID_COVER_SIZE ((size_t)10304)

/**
 * The proof of the upper bound of an overlap's signed distance: differences x(b[i]) - x(a[i]) and triangles over them
 * that form a closed oriented surface which winds around the origin. No point of the surface is nearer to the origin
 * than r, hence the ball of radius r lies inside the Minkowski difference and d <= -r - radii. It has at most
 * OVOID_COVER_POINTS_MAX points and twice as many triangles.
 *
 * A query writes it into `memory`, so the arrays are there until the next query that the cover is given to; one query
 * at a time may have it. Memory of more than OVOID_COVER_POINTS points is also where the search goes on that has filled
 * its own. What reads a cover reads counts and arrays only, wherever these are: its memory may be NULL.
 */
typedef struct ovoid_cover {
    uint32_t point_count, triangle_count;
    const uint32_t *a, *b;          /**< point_count of each: vertices of shape_a and of shape_b */
    const uint16_t (*triangles)[3]; /**< triangle_count of them: points, counter-clockwise from outside */
    void *memory; /**< the caller's, of any alignment and content; a query without it is refused, with limit MEMORY */
    size_t size;  /**< of memory, bytes: at least OVOID_COVER_SIZE; see ovoid_cover_get_size */
} ovoid_cover;

/** Options of a query; all zero, or NULL, is the default. */
typedef struct ovoid_options {
    double absolute_tolerance; /**< stop when upper - lower is at most this, or at most the relative one; default 0 */
    double relative_tolerance; /**< of the pair's size: the sum of the largest vertex norms of both shapes in their body
                                  frames, the distance of those frames' origins, and the radii; 0 means 1e-9 */
    double cap;                /**< stop when proven farther apart than this; 0 means no cap */
    uint32_t iterations; /**< most iterations of each exact method; 0 means 1000, of a depth with a larger memory than
                            its own twice the points that this holds */
} ovoid_options;

/** The answer to a query. lower <= d <= upper always holds, rounding included. */
typedef struct ovoid_answer {
    ovoid_status status;
    ovoid_stage stage;
    ovoid_limit limit;
    uint32_t iterations; /**< of the exact methods */
    double lower, upper; /**< bracket of the signed distance; -infinity and infinity where refused */
    ovoid_vec3 point_a,
        point_b; /**< witness points, world frame, on their bodies to rounding. Distance and depth: point_b - point_a =
                    d normal, to w + sqrt(w (w + 2 |d|)) for a bracket of width w, and to 1e-9 of the size; if a limit
                    ended a search for the depth, this holds for some d of the bracket where kind is COVER. Other
                    queries: the points behind upper, not the closest ones. Where the kind is HULL or INNER they are
                    one point, common to both bodies. */
    ovoid_vec3 normal; /**< unit, world frame, from A to B; the direction of the lower bound */
    ovoid_proof proof;
} ovoid_answer;

/**
 * Do the bodies touch? Stops as soon as the sign of d is proven. earlier: a proof of this pair, or NULL; a proof of
 * zeros is the same as NULL.
 */
OVOID_API ovoid_answer ovoid_collide(const ovoid_pair *pair, const ovoid_options *options, const ovoid_proof *earlier);

/**
 * Are the bodies within margin (>= 0) of each other? Stops when lower > margin, or when upper <= margin and the sign
 * of d is proven too. Read it with ovoid_answer_is_within. A bracket around the margin is narrower than the tolerance.
 */
OVOID_API ovoid_answer ovoid_within(const ovoid_pair *pair, double margin, const ovoid_options *options,
                                    const ovoid_proof *earlier);

/** The distance to the tolerance if the bodies are apart; of an overlap only the sign is proven. */
OVOID_API ovoid_answer ovoid_distance(const ovoid_pair *pair, const ovoid_options *options, const ovoid_proof *earlier);

/**
 * The signed distance to the tolerance: the distance if the bodies are apart, minus the penetration depth if they
 * overlap. cover (may be NULL) receives the proof of the depth's lower bound; its point_count is 0 if none is needed.
 *
 * A search that has filled its own memory, of OVOID_COVER_POINTS points, goes on in that of the cover if it is larger;
 * else it ends with a true and wide bracket and the limit CAPACITY. The bits of other depths are the same whatever
 * memory there is. Round bodies with nearly one centre need most: about 1.7 points for each vertex of the larger one.
 * The limit is MEMORY, and nothing is answered, if the cover's memory is NULL or smaller than OVOID_COVER_SIZE.
 */
OVOID_API ovoid_answer ovoid_depth(const ovoid_pair *pair, const ovoid_options *options, const ovoid_proof *earlier,
                                   ovoid_cover *cover);

/**
 * ovoid_depth of a pair that has moved a little since its last depth. The search starts from the surface of that
 * depth's cover, where it has at most 32 points and is one around the origin yet; else from the proof. In motion that
 * takes half the time of ovoid_depth with the proof alone. cover: in, what ovoid_depth or this function showed of the
 * pair the last time, counts of 0 for nothing; out, as of ovoid_depth. Its arrays may be anywhere, and hold anything:
 * what is read is checked, and changes only the way to the depth. The answer follows from the pair, the options, the
 * proof and the counts and arrays of the cover. cover NULL: the same as ovoid_depth.
 */
OVOID_API ovoid_answer ovoid_depth_from(const ovoid_pair *pair, const ovoid_options *options,
                                        const ovoid_proof *earlier, ovoid_cover *cover);

/** Bytes of memory of a cover for a search of up to that many points: 10 KB, and beyond 512 150 a point. 0: too many.
 */
OVOID_API size_t ovoid_cover_get_size(uint32_t point_count);

/** A posed shape. The shape is borrowed. */
typedef struct ovoid_posed_shape {
    const ovoid_shape *shape;
    ovoid_pose pose;
} ovoid_posed_shape;

/** Two bodies of a batch, by index. */
typedef struct ovoid_couple {
    uint32_t a, b;
} ovoid_couple;

/** Status and bracket of an answer, as batches and worlds give them for many pairs: without points and proof. */
typedef struct ovoid_verdict {
    ovoid_status status;
    ovoid_stage stage;
    ovoid_limit limit;
    uint32_t iterations;
    double lower, upper;
} ovoid_verdict;

/** The points and the normal of an answer, as batches and worlds give them for many pairs. */
typedef struct ovoid_witness {
    ovoid_vec3 point_a, point_b, normal;
} ovoid_witness;

/**
 * One query of many pairs. The results of a couple follow from its bodies, its earlier proof, the question and the
 * options alone: they have the same bits whatever couples are beside it, in any order, in a batch of any length, on
 * every machine. So to use several threads, give each a part of the couples and of the arrays beside them; bodies may
 * be shared. They have the same bits with any set of outputs, but for a yes or no (collide, within) of which only the
 * verdicts are wanted: couples of small bodies are then decided in single precision, and their brackets have other bits
 * than beside answers, proofs or witnesses.
 *
 * Beside the query of the pair alone (ovoid_collide and its sisters) a batch gives the same status, a true bracket that
 * is as narrow as the question needs, and a valid proof. It may give other bits: another stage may decide, with another
 * bracket, other points and another proof. Statuses may differ only where options.iterations end a search.
 *
 * From four couples on a batch takes less time than as many single queries, or at most 1.07 times as much; of three it
 * takes up to 1.2 times as much, of two up to 1.5, of one up to 1.9.
 *
 * Earlier proofs save time for couples near each other, at no further cost if proofs are written anyway. For yes or no
 * about couples that are mostly far apart leave the proofs out: in lanes the spheres decide a couple in a quarter of
 * the time that writing a proof takes.
 */
typedef struct ovoid_batch {
    const ovoid_posed_shape *bodies;
    size_t body_count;
    const ovoid_couple *couples;
    size_t couple_count;
    const ovoid_options *options; /**< of all queries; NULL: the default */
    ovoid_proof *proofs;          /**< couple_count, or NULL: each is the couple's earlier proof (all zero:
                                       none), and is replaced by that of the new answer */
    ovoid_verdict *verdicts;      /**< couple_count, or NULL */
    ovoid_answer *answers;        /**< couple_count, or NULL: all of each answer, 352 bytes */
    ovoid_witness *witnesses;     /**< couple_count, or NULL: points and normal alone, 72 bytes */
} ovoid_batch;

/** ovoid_collide for each couple. OVOID_OK, or INDEX (place: the couple) and nothing is written. */
OVOID_API ovoid_code ovoid_collide_batch(const ovoid_batch *batch, ovoid_error *error);
/** ovoid_within for each couple; errors as in ovoid_collide_batch. */
OVOID_API ovoid_code ovoid_within_batch(const ovoid_batch *batch, double margin, ovoid_error *error);
/** ovoid_distance for each couple; errors as in ovoid_collide_batch. */
OVOID_API ovoid_code ovoid_distance_batch(const ovoid_batch *batch, ovoid_error *error);
/** ovoid_depth for each couple, without covers; errors as in ovoid_collide_batch. */
OVOID_API ovoid_code ovoid_depth_batch(const ovoid_batch *batch, ovoid_error *error);

/**
 * The gap along a direction from A to B (world, any length but zero): min over B of n.x - max over A of n.x - radii,
 * where n is the unit vector along the direction. It is a proven lower bound of the signed distance, with rounding and
 * allowances included, for true cylinders and cones that of the true bodies; -infinity if a body, a pose or the
 * direction is refused. Cost: a support of each body.
 */
OVOID_API double ovoid_pair_compute_gap(const ovoid_pair *pair, ovoid_vec3 direction);

/** The bracket from the ellipsoids alone, without a search: smooth in the poses, O(1). */
OVOID_API ovoid_answer ovoid_pair_compute_bounds(const ovoid_pair *pair);

/**
 * The signed distance as one number, for callers who need no bracket: lower, which is never above the true distance and
 * within the tolerance (and the bodies' allowances) of it. NaN if the bracket is wider (limit is neither NONE nor
 * ALLOWANCE), for example of an overlap from ovoid_distance (use ovoid_depth), or of a yes or no.
 */
OVOID_API double ovoid_answer_get_distance(const ovoid_answer *answer);

/** 1: proven within the margin (upper <= margin); 0: proven farther (lower > margin); -1: neither is proven. */
OVOID_API int ovoid_answer_is_within(const ovoid_answer *answer, double margin);

/** What ovoid_answer_verify uses beside the answer; all zero, or NULL, is the default. */
typedef struct ovoid_answer_basis {
    const ovoid_options *options; /**< those of the query; NULL: the default, as of ovoid_pair_compute_bounds */
    const ovoid_cover *cover;     /**< that of ovoid_depth, or NULL */
} ovoid_answer_basis;

/**
 * Verifies an answer against its pair without any search: every bound is recomputed from the proof alone, with directed
 * error bounds, and the status must follow from the bracket and the options' tolerance. OVOID_OK, or PROOF with a
 * sentence in *error (may be NULL).
 */
OVOID_API ovoid_code ovoid_answer_verify(const ovoid_pair *pair, const ovoid_answer *answer,
                                         const ovoid_answer_basis *basis, ovoid_error *error);

/** The name of a status in results, for example "separated"; never NULL. */
OVOID_API const char *ovoid_status_get_name(ovoid_status status);
/** The name of a stage, for example "gjk". */
OVOID_API const char *ovoid_stage_get_name(ovoid_stage stage);
/** The name of a limit, for example "precision". */
OVOID_API const char *ovoid_limit_get_name(ovoid_limit limit);
/** The name of a kind of proof, for example "points". */
OVOID_API const char *ovoid_proof_kind_get_name(ovoid_proof_kind kind);

#ifdef __cplusplus
}
#endif
#endif
