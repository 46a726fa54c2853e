/**
 * @file paper.h
 * Facial area splitting: cells of directions as seen from the inner ellipsoid's centre; for each cell the faces through
 * which its rays leave, and the vertices that are extreme for its directions. W.-K. Su, J.-S. Liu, I-F. Chen, Enhancing
 * Collision Detection Method Based on Enclosed Ellipsoid by Facial Areas Splitting.
 */
#ifndef OVOID_PAPER_H
#define OVOID_PAPER_H

#include "ovoid/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How directions are split into areas. */
typedef enum ovoid_split {
    OVOID_SPLIT_OCTANTS = 0, /**< the paper's 8 areas, by the signs of the three coordinates */
    OVOID_SPLIT_CUBE = 1 /**< 6 k k cells of a cube map, k a power of two, so that finer cells nest in coarser ones */
} ovoid_split;

/**
 * Which areas a search keeps. SIGNS and PAPER use the eight octants, which every ovoid_areas has beside its own split.
 * SIGNS is sound for rays into the front half: those whose image in the ellipsoid's sphere space makes at most a right
 * angle with the image of `toward`. ALL, RAY and SIGNS give the same facet and t, bit for bit.
 */
typedef enum ovoid_area_rule {
    OVOID_RULE_ALL = 0,   /**< every face: full face checking */
    OVOID_RULE_RAY = 1,   /**< the one area that contains the ray: sound, with the least work; the default */
    OVOID_RULE_SIGNS = 2, /**< sound half-sphere rule: drop the octant opposite to the direction to the other body */
    OVOID_RULE_PAPER =
        3 /**< UNSOUND: drop octants whose vector . direction < -sqrt(2)/2; its proof holds only in 2-D */
} ovoid_area_rule;

/**
 * The tables of one polyhedron, in sphere space, x' = Q^-1/2 (x - center) with the symmetric root: for each cell the
 * facets through which its rays leave, and the vertices extreme for its directions, both conservative. The cell of a
 * ray's direction u is that of Q^-1/2 u; the cell of a support's direction n, which is a normal, is that of Q^1/2 n.
 */
typedef struct ovoid_areas ovoid_areas;

/** Options of the tables; all zero, or NULL, is the default: the paper's octants. */
typedef struct ovoid_areas_options {
    ovoid_split split;
    uint32_t k; /**< of a cube map: cells per edge, a power of two from 1 to 64; ignored for octants */
    const ovoid_allocator *allocator; /**< NULL: malloc and free; copied */
} ovoid_areas_options;

/**
 * Creates the tables. ellipsoid: positive definite, centre strictly inside the solid. NULL on failure, with *error
 * filled. Owned by the caller; it keeps pointers into the polytope, which must outlive it.
 */
OVOID_API ovoid_areas *ovoid_areas_create(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid,
                                          const ovoid_areas_options *options, ovoid_error *error);
/** Frees the tables; NULL is allowed. */
OVOID_API void ovoid_areas_destroy(ovoid_areas *areas);

/** Counts of a table. */
typedef struct ovoid_area_counts {
    uint32_t cells;
    uint64_t facet_entries, vertex_entries; /**< sums over the cells */
    uint64_t bytes;
} ovoid_area_counts;
/** The size of the tables. */
OVOID_API ovoid_area_counts ovoid_areas_get_counts(const ovoid_areas *areas);

/** The exit of a ray. */
typedef struct ovoid_exit {
    double t; /**< where the ray center + t direction leaves, rounded, from the facet planes; infinity if it does not */
    ovoid_vec3 point; /**< center + t direction */
    uint32_t facet;   /**< the facet through which it leaves */
    uint32_t touched; /**< facets tested */
} ovoid_exit;

/**
 * Step (g) of the paper: the point where the ray from the ellipsoid's centre along direction (body frame, any length
 * but zero) leaves the polyhedron, testing only the facets of the areas that the rule keeps. Under OVOID_RULE_PAPER the
 * answer may be wrong. toward: the direction to the other body (body frame), for the rules that drop areas by it.
 */
OVOID_API ovoid_exit ovoid_areas_find_exit(const ovoid_areas *areas, ovoid_vec3 direction, ovoid_vec3 toward,
                                           ovoid_area_rule rule);

/**
 * The vertex extreme along direction (body frame), by a search of its cell's candidates; ties: lowest index. It is the
 * vertex of a search of all vertices, bit for bit. *touched (may be NULL): vertices tested.
 */
OVOID_API uint32_t ovoid_areas_find_support(const ovoid_areas *areas, ovoid_vec3 direction, uint32_t *touched);

/** The result of cutting the faces along the octants' three planes. */
typedef struct ovoid_split_counts {
    uint32_t faces;         /**< triangles before */
    uint32_t pieces;        /**< polygon pieces after: the paper's count, 12 -> 36 for a box */
    uint32_t triangles;     /**< pieces cut into triangles */
    uint32_t per_octant[8]; /**< pieces by octant; bit 0: x < 0, bit 1: y < 0, bit 2: z < 0 */
} ovoid_split_counts;

/**
 * Cuts every triangle along the three coordinate planes of sphere space and counts the pieces. Only `faces` is filled
 * if Q is not positive definite.
 */
OVOID_API ovoid_split_counts ovoid_polytope_compute_split(const ovoid_polytope *polytope,
                                                          const ovoid_ellipsoid *ellipsoid);

/** The online steps of the paper for a pair, each with its cost, for study; not how the library decides. */
typedef struct ovoid_paper_bounds {
    ovoid_nearest
        nearest;  /**< step (e): X* and Y* of the inner ellipsoids, world frame; its lower bound is theirs, not d's */
    double lower; /**< step (f), proven: d >= the gap of the outer ellipsoids along the normal between them */
    double upper; /**< step (g): |Q1 Q2| less the rounding radii, 0 if the inner ellipsoids overlap: an upper bound of
                     d, to rounding, but not under OVOID_RULE_PAPER */
    ovoid_vec3 q1, q2; /**< where the rays from the inner centres through X* and Y* leave the polyhedra */
    ovoid_vec3 p1, p2; /**< where the same rays leave the outer ellipsoids */
    uint32_t faces;    /**< facets touched */
    int collides;      /**< HEURISTIC, no proof: the paper's criterion says that the bodies collide */
} ovoid_paper_bounds;

/**
 * Steps (e), (f), (g) of the paper and its criterion: the bodies are apart if |Q1 Q2| > min(|P1 Q1|, |P2 Q2|,
 * threshold), with Q1 before Q2 on the way. The criterion is a heuristic and often wrong. areas: the tables of shape_a
 * and shape_b, made with their inner ellipsoids; NULL for a flat shape, whose Q1 or Q2 is then X* or Y* itself. Refused
 * poses: -infinity, infinity.
 */
OVOID_API ovoid_paper_bounds ovoid_paper_compute_bounds(const ovoid_pair *pair, const ovoid_areas *areas[2],
                                                        ovoid_area_rule rule, double threshold);

#ifdef __cplusplus
}
#endif
#endif
