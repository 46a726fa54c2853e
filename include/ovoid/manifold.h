/**
 * @file manifold.h
 * Contact manifolds: up to four points at which two bodies touch, with their normal, a proven bracket of the depth or
 * distance, and an identity for each point. Queries allocate nothing and lock nothing (docs/contact.md).
 */
#ifndef OVOID_MANIFOLD_H
#define OVOID_MANIFOLD_H

#include "ovoid/query.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What the normal of a contact is made of. */
typedef enum ovoid_manifold_axis {
    OVOID_MANIFOLD_NONE = 0, /**< no contact: refused, or proven farther apart than the margin */
    OVOID_MANIFOLD_FACE_A,   /**< the normal of a facet of A */
    OVOID_MANIFOLD_FACE_B,   /**< minus the normal of a facet of B */
    OVOID_MANIFOLD_EDGES,    /**< orthogonal to an edge of A and one of B */
    OVOID_MANIFOLD_FREE      /**< between the nearest points of two features, or a direction that a search found */
} ovoid_manifold_axis;

/** The evidence for the upper bound of a contact's signed distance. */
typedef enum ovoid_manifold_proof {
    OVOID_MANIFOLD_PROOF_NONE = 0, /**< upper is infinity */
    OVOID_MANIFOLD_PROOF_POINTS,   /**< the contact's points: no point of A is closer to B than they are */
    OVOID_MANIFOLD_PROOF_FACETS, /**< the facets met: the difference of the bodies holds a frustum around the origin */
    OVOID_MANIFOLD_PROOF_SEARCH, /**< the surface around the origin (ovoid_cover) that a search found, now or earlier;
                                  an earlier one less the motion since then. Where the options have no cover, also
                                  what the facets of an earlier contact showed that needed no search, less the motion */
    OVOID_MANIFOLD_PROOF_NORMAL  /**< of a solid (<ovoid/body_manifolds.h>): the points, along the normal alone. It says
                                   nothing of other directions */
} ovoid_manifold_proof;

/**
 * The kinds of a feature, in the two highest bits of ovoid_manifold.feature_a and feature_b; the other 30 bits are its
 * index. Vertices and facets are those of ovoid_polytope; a flat polygon has two facets, 1 is its other side. An edge
 * is an index into ovoid_polytope.neighbors, that of the end with the higher index in the list of the lower.
 */
#define OVOID_MANIFOLD_VERTEX UINT32_C(0)
/** An edge. */
#define OVOID_MANIFOLD_EDGE UINT32_C(0x40000000)
/** A facet. */
#define OVOID_MANIFOLD_FACET UINT32_C(0x80000000)
/** In both features of a free axis: no feature makes it, it is the direction that a search found. */
#define OVOID_MANIFOLD_DIRECTION UINT32_C(0xc0000000)
/** The mask of the kind. */
#define OVOID_MANIFOLD_KIND UINT32_C(0xc0000000)

/**
 * The kinds of a point's id, in its two highest bits. The other bits: the index of a vertex; or of a crossing 15 bits
 * of the edge of A, then 15 of that of B. So a corner keeps its id whatever facets and axis the bodies meet by, and
 * different corners have different ids, if no edge has an index above 32767.
 */
#define OVOID_MANIFOLD_ID_VERTEX_A UINT32_C(0)
/** A vertex of B. */
#define OVOID_MANIFOLD_ID_VERTEX_B UINT32_C(0x40000000)
/** Two edges cross. */
#define OVOID_MANIFOLD_ID_CROSSING UINT32_C(0x80000000)
/** The nearest points of feature_a and feature_b: the facets met have no corner in common. */
#define OVOID_MANIFOLD_ID_NEAREST UINT32_C(0xc0000000)

/** A point of contact; world frame. */
typedef struct ovoid_manifold_point {
    ovoid_vec3 point_a, point_b; /**< on the surfaces of A and of B: point_b - point_a = separation normal */
    double separation;           /**< negative: overlap; not below ovoid_manifold.lower, but for rounding */
    uint32_t id;
} ovoid_manifold_point;

/** The points of a contact. */
typedef struct ovoid_manifold_points {
    uint32_t count; /**< of points; 0 if the contact is not one of this pair */
    double grown;   /**< each point_a lies in A grown by this, each point_b in B: rounding, snapping, kept corners */
    ovoid_manifold_point points[4];
} ovoid_manifold_points;

/** Options of contact queries; all zero, or NULL, is the default. */
typedef struct ovoid_manifold_options {
    double margin;    /**< speculative: contacts and their points are given up to this distance; >= 0 */
    double tolerance; /**< a kept contact is used again without a search if its bracket is at most this wide, a length;
                         0: 1e-9 of the pair's size (ovoid_options) */
    double keep;  /**< a kept corner stays while it is outside of the other body's facet by at most this, a length; its
                     separation is then at least the gap along the normal. 0: exact polygons, in which corners nearer
                     than 4e-6 of the pair's size are one */
    double angle; /**< facets that meet the plane of contact at more than this angle (radians, at most 1.45) are not
                     faces of the contact: only their edge or vertex touches; 0 means 1.45 */
    ovoid_cover *cover; /**< room for the proof of a search, or NULL. Untouched by a query that needs no search, so that
                           the cover of the last search stays; ovoid_manifold_verify reads it. Bit 1 of memory.flags is
                           set where the bodies were measured as (b, a): then cover->a are vertices of B */
    ovoid_manifold_points *points; /**< room for the points, or NULL: those of ovoid_manifold_compute_points, bit for
                                      bit, at a fraction of its cost; a batch has its own */
} ovoid_manifold_options;

/**
 * What the next query of the pair uses; it claims nothing about the bodies. `flags` says in which order they were
 * measured, and the points, the polygon and the verifier need it.
 */
typedef struct ovoid_manifold_memory {
    float searched; /**< the upper bound that the last search proved, rounded up */
    float pose[7];  /**< B in the frame of A at that search: quaternion w, x, y, z, then the translation */
    uint32_t flags;
} ovoid_manifold_memory;

/**
 * A contact: a plain value of 128 bytes, both the result of a query and the `earlier` of the pair's next one. All zero
 * means no earlier contact. The signed distance d is positive where the bodies are apart, and minus the penetration
 * depth where they overlap.
 */
typedef struct ovoid_manifold {
    ovoid_status status; /**< as in ovoid_answer, from the bracket */
    ovoid_limit limit;   /**< as in ovoid_answer: NONE if the bracket is as narrow as the tolerance */
    double lower, upper; /**< bracket of d. lower is the gap along the normal: moving B by -lower along the normal parts
                            the bodies, and no direction needs less than -upper */
    ovoid_vec3 normal;   /**< unit, world frame, from A to B */
    uint32_t id[4];      /**< of the points; 0 beyond count */
    uint32_t feature_a;  /**< what makes the axis: of A the facet, edge or vertex */
    uint32_t feature_b;  /**< of B */
    uint32_t facet_a;    /**< the feature of A that was clipped: the facet, or the edge or vertex where no facet is
                            within options.angle; a feature as feature_a */
    uint32_t facet_b;    /**< of B */
    ovoid_manifold_axis axis;
    uint8_t count;    /**< of points, 0 to 4: the polygon's deepest corner is one of them, to 1e-6 of the pair's size;
                         where earlier points are kept, to a tenth of the tolerance */
    uint8_t proof;    /**< ovoid_manifold_proof */
    uint16_t corners; /**< of the whole polygon; the points are four of them if there are more */
    float share;      /**< the area of the points' quadrilateral divided by that of the polygon; 1 if they are all */
    ovoid_manifold_memory memory;
} ovoid_manifold;

/** Most corners of a polygon. Facets of more than half as many corners take part with half as many of them. */
#define OVOID_MANIFOLD_CORNERS 128

/** The whole polygon of a contact: where both bodies' facets, projected along the normal, are within the margin. */
typedef struct ovoid_manifold_polygon {
    uint32_t count; /**< of corners, counter-clockwise seen from the tip of the normal; 1: a point, 2: a segment */
    double grown;   /**< as in ovoid_manifold_points */
    double inner;   /**< the area of the polygon of the facets alone: all of it is in contact */
    double outer;   /**< the area of a polygon that holds every point of contact: nothing outside of it is within the
                       margin along the normal; of rounded bodies, no points of their cores are within the margin and
                       both radii */
    ovoid_manifold_point points[OVOID_MANIFOLD_CORNERS];
} ovoid_manifold_polygon;

/**
 * The contact of two bodies. earlier: the pair's last contact, of the same two shapes, or NULL. While its bracket,
 * measured again, is at most options.tolerance wide, its features are used again without a search; else the pair is
 * searched as by ovoid_depth, and ids are carried over. Bodies that were farther apart than the margin are measured
 * along the same direction first, and facets that lie on one another where the line of centres meets them need no
 * search. Only its upper bound is taken on trust: it may hold any bytes without harm but to `upper`. Refused pairs have
 * a limit that says why, and no points. The contact of the same pair with the bodies exchanged is this one with the
 * sides exchanged, bit for bit (ovoid_manifold_make_swapped), unless shapes and poses are the same. Cost: a depth
 * query, or a fraction of it where the earlier contact serves.
 */
OVOID_API ovoid_manifold ovoid_manifold_find(const ovoid_pair *pair, const ovoid_manifold_options *options,
                                             const ovoid_manifold *earlier);

/** The contact of the pair (b, a) from that of (a, b). */
OVOID_API ovoid_manifold ovoid_manifold_make_swapped(const ovoid_manifold *manifold);

/**
 * The points of a contact. The pair is that of the query, in the same poses. Cost: linear in the corners of both
 * facets.
 */
OVOID_API ovoid_manifold_points ovoid_manifold_compute_points(const ovoid_pair *pair, const ovoid_manifold *manifold);

/**
 * The whole polygon of a contact, its areas included, into *polygon. The pair and the options are those of the query.
 * OVOID_OK, or ARGUMENT if the contact is not one of this pair; then the polygon has no corners.
 */
OVOID_API ovoid_code ovoid_manifold_compute_polygon(const ovoid_pair *pair, const ovoid_manifold *manifold,
                                                    const ovoid_manifold_options *options,
                                                    ovoid_manifold_polygon *polygon);

/**
 * Verifies a contact against its pair without a search: the bracket is measured again (by the gap along the normal; by
 * the points, the facets, or options->cover), the normal must be that of the features, each point must lie on both
 * bodies grown by what options.keep allows, the number of corners and the share must be those of the polygon, and
 * status and limit must follow. An upper bound from a search needs the cover of that search. The memory claims nothing.
 * OVOID_OK, or PROOF with a sentence in *error (may be NULL).
 */
OVOID_API ovoid_code ovoid_manifold_verify(const ovoid_pair *pair, const ovoid_manifold *manifold,
                                           const ovoid_manifold_options *options, ovoid_error *error);

/** One query of many pairs; each contact has the bits of the query of that pair alone. */
typedef struct ovoid_manifold_batch {
    const ovoid_posed_shape *bodies;
    size_t body_count;
    const ovoid_couple *couples;
    size_t couple_count;
    const ovoid_manifold_options *options; /**< of all queries; NULL: the default. A cover receives that of the last
                                             couple that was searched */
    ovoid_manifold *manifolds;     /**< couple_count: each is the couple's earlier contact (all zero: none), and is
                                         replaced by the new one */
    ovoid_manifold_points *points; /**< couple_count, or NULL */
} ovoid_manifold_batch;

/** ovoid_manifold_find for each couple. OVOID_OK, or INDEX (place: the couple) and nothing is written. */
OVOID_API ovoid_code ovoid_manifold_find_batch(const ovoid_manifold_batch *batch, ovoid_error *error);

/** The name of an axis in results: "none", "face a", "face b", "edges", "free"; never NULL. */
OVOID_API const char *ovoid_manifold_axis_get_name(ovoid_manifold_axis axis);
/** The name of a proof: "none", "points", "facets", "search", "normal". */
OVOID_API const char *ovoid_manifold_proof_get_name(ovoid_manifold_proof proof);

#ifdef __cplusplus
}
#endif
#endif
