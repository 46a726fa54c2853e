/**
 * @file paper.h
 * Facial area splitting: cells of directions as seen from the inner ellipsoid's centre, the faces that rays of a cell
 * leave by and the vertices that are extreme for its directions. W.-K. Su, J.-S. Liu, I-F. Chen, Enhancing Collision
 * Detection Method Based on Enclosed Ellipsoid by Facial Areas Splitting.
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
 * Which areas a search keeps. SIGNS and PAPER work on the eight octants, which every ovoid_areas has beside its own
 * split. SIGNS is sound for rays into the front half: those whose image in the ellipsoid's sphere space makes at most a
 * right angle with the image of `toward`. ALL, RAY and SIGNS give the same facet and t, bit for bit.
 */
typedef enum ovoid_area_rule {
    OVOID_RULE_ALL = 0,   /**< every face: full face checking */
    OVOID_RULE_RAY = 1,   /**< the one area that holds the ray: sound and least work; the default */
    OVOID_RULE_SIGNS = 2, /**< sound half-sphere rule: drop the octant opposite to the direction to the other body */
    OVOID_RULE_PAPER = 3  /**< UNSOUND: drop octants whose vector . direction < -sqrt(2)/2, a proof for 2-D only */
} ovoid_area_rule;

/**
 * The tables of one polyhedron, in sphere space, x' = Q^-1/2 (x - center) with the symmetric root: cell -> facets that
 * rays of the cell leave by, cell -> vertices extreme for directions of the cell, both conservative. A ray's direction
 * u falls in the cell of Q^-1/2 u; a support's direction n, being a normal, in the cell of Q^1/2 n.
 */
typedef struct ovoid_areas ovoid_areas;

/** Options of the tables; all zero is the default, the paper's octants, and NULL means that. */
typedef struct ovoid_areas_options {
    ovoid_split split;
    uint32_t k; /**< of a cube map: cells per edge, a power of two from 1 to 64; ignored for octants */
    const ovoid_allocator *allocator; /**< NULL: malloc and free; copied */
} ovoid_areas_options;

/**
 * Makes the tables. ellipsoid: positive definite, centre strictly inside (of a solid). NULL on failure, with *error
 * filled. Owned by the caller; keeps pointers into the polytope, which must outlive it.
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
/** How large the tables are. */
OVOID_API ovoid_area_counts ovoid_areas_get_counts(const ovoid_areas *areas);

/** The exit of a ray. */
typedef struct ovoid_exit {
    double t;         /**< where the ray center + t direction leaves: facet planes' rounded answer; infinity if none */
    ovoid_vec3 point; /**< center + t direction */
    uint32_t facet;   /**< the facet it leaves by */
    uint32_t touched; /**< facets tested */
} ovoid_exit;

/**
 * Step (g) of the paper: where the ray from the ellipsoid's centre along direction (body frame, any length but zero)
 * leaves the polyhedron, testing only the facets of the areas that the rule keeps. Under OVOID_RULE_PAPER the answer
 * may be wrong. toward: the direction to the other body (body frame), for the rules that drop areas by it.
 */
OVOID_API ovoid_exit ovoid_areas_find_exit(const ovoid_areas *areas, ovoid_vec3 direction, ovoid_vec3 toward,
                                           ovoid_area_rule rule);

/**
 * The vertex extreme along direction (body frame), by a search of its cell's candidates; ties: lowest index. The same
 * vertex as a search of all, bit for bit. *touched (may be NULL): vertices tested.
 */
OVOID_API uint32_t ovoid_areas_find_support(const ovoid_areas *areas, ovoid_vec3 direction, uint32_t *touched);

/** What cutting the faces along the octants' three planes gives. */
typedef struct ovoid_split_counts {
    uint32_t faces;         /**< triangles before */
    uint32_t pieces;        /**< polygon pieces after: the paper's count, 12 -> 36 for a box */
    uint32_t triangles;     /**< pieces cut into triangles */
    uint32_t per_octant[8]; /**< pieces by octant; bit 0: x < 0, bit 1: y < 0, bit 2: z < 0 */
} ovoid_split_counts;

/**
 * Cuts every triangle along the three coordinate planes of sphere space and counts the pieces. Only `faces` is filled
 * where Q is not positive definite.
 */
OVOID_API ovoid_split_counts ovoid_polytope_compute_split(const ovoid_polytope *polytope,
                                                          const ovoid_ellipsoid *ellipsoid);

/** The online steps of the paper for a pair, each with its cost, for study; not how the library decides. */
typedef struct ovoid_paper_bounds {
    ovoid_nearest
        nearest;  /**< step (e): X* and Y* of the inner ellipsoids, world frame; its lower bound is theirs, not d's */
    double lower; /**< step (f), proven: d >= the gap of the outer ellipsoids along the normal between them */
    double upper; /**< step (g): |Q1 Q2| less the rounding radii, 0 where the inner ellipsoids overlap: d <= it, to
                       rounding; under OVOID_RULE_PAPER not even that */
    ovoid_vec3 q1, q2; /**< where the rays from the inner centres through X* and Y* leave the polyhedra */
    ovoid_vec3 p1, p2; /**< where the same rays leave the outer ellipsoids */
    uint32_t faces;    /**< facets touched */
    int collides;      /**< HEURISTIC, no proof: the paper's criterion says that the bodies collide */
} ovoid_paper_bounds;

/**
 * Steps (e), (f), (g) of the paper and its criterion: |Q1 Q2| > min(|P1 Q1|, |P2 Q2|, threshold), with Q1 before Q2 on
 * the way, means apart. A heuristic, often wrong. areas: the tables of shape_a and shape_b, made of their inner
 * ellipsoids; NULL for a flat shape, whose Q is then X* or Y* itself. Refused poses: -infinity, infinity.
 */
OVOID_API ovoid_paper_bounds ovoid_paper_compute_bounds(const ovoid_pair *pair, const ovoid_areas *areas[2],
                                                        ovoid_area_rule rule, double threshold);

#ifdef __cplusplus
}
#endif
#endif
