/**
 * @file robot_spheres.h
 * Spheres that approximate a link: how far a list of them is from covering the link, proven, and lists that are proven
 * to cover it. Robots are often approximated by spheres that are called conservative; these functions prove whether
 * they are. docs/robot-spheres.md has the mathematics.
 */
#ifndef OVOID_ROBOT_SPHERES_H
#define OVOID_ROBOT_SPHERES_H

#include "ovoid/robot.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A ball in its link's frame. */
typedef struct ovoid_robot_sphere {
    ovoid_vec3 center;
    double radius; /**< >= 0 */
} ovoid_robot_sphere;

/** A ball and its link. */
typedef struct ovoid_robot_link_sphere {
    uint32_t link;
    ovoid_robot_sphere ball; /**< in the link's frame */
} ovoid_robot_link_sphere;

/** A link and the spheres that approximate it, in its frame. Borrowed. */
typedef struct ovoid_robot_sphere_model {
    const ovoid_robot *robot;
    uint32_t link;
    const ovoid_robot_sphere *spheres;
    size_t count;
} ovoid_robot_sphere_model;

/** Options of an audit; all zero, or NULL, is the default. */
typedef struct ovoid_robot_audit_options {
    double tolerance;   /**< a length: the depth's bracket need not be narrower; 0: 1e-5 of the link's size */
    size_t depth_cells; /**< the largest number of cells held in the search for the deepest point, at least 64; 0: 2^16,
                           12 MB */
    size_t volume_cells;              /**< the largest number of cells held in the search of the volumes; 0: 2^16 */
    int without_volumes;              /**< 1: the volumes are not computed, and are [0, infinity] */
    const ovoid_allocator *allocator; /**< of the working memory; NULL: malloc and free */
    ovoid_watch watch;                /**< asked before each cell. If it stops the call: as if the cells were used up */
} ovoid_robot_audit_options;

/** A bracket of a true number. */
typedef struct ovoid_robot_bracket {
    double lower, upper;
} ovoid_robot_bracket;

/**
 * What is proven about spheres and a link. The link is the union of the true bodies of its elements (for shapes with
 * allowances the bodies that they approximate). depth is the greatest value, over the points x of the link, of the
 * least, over the spheres, of |x - center| - radius: the distance of the deepest uncovered point from all spheres.
 */
typedef struct ovoid_robot_sphere_audit {
    ovoid_robot_bracket depth;     /**< upper <= 0: every point is covered; lower > 0: not */
    ovoid_vec3 point;              /**< proves depth.lower: in the link's frame, on the element's shape, to rounding */
    uint32_t element;              /**< of the description: the element of that point */
    uint32_t sphere;               /**< the one nearest to it */
    ovoid_robot_bracket uncovered; /**< volume of the link outside all spheres */
    ovoid_robot_bracket excess;    /**< volume of the spheres' union outside the link */
    ovoid_robot_bracket link;      /**< volume of the link */
    ovoid_robot_bracket spheres;   /**< volume of the spheres' union */
    size_t cells;                  /**< cells examined */
} ovoid_robot_sphere_audit;

/**
 * Audits spheres against their link. Every bracket is true, rounding included, also if the cells run out; then it is
 * wider. Errors: ARGUMENT (NULL, options), INDEX (no such link), EMPTY (no spheres; a link without elements), and with
 * the sphere as place NOT_FINITE, RADIUS (negative), RANGE; LIMIT (more than 2^20 spheres), MEMORY.
 */
OVOID_API ovoid_code ovoid_robot_compute_sphere_audit(const ovoid_robot_sphere_model *model,
                                                      const ovoid_robot_audit_options *options,
                                                      ovoid_robot_sphere_audit *audit, ovoid_error *error);

/** Options of a cover; all zero, or NULL, is the default. */
typedef struct ovoid_robot_cover_options {
    double excess; /**< a length: find the fewest spheres of which none exceeds the link by more; 0: as many spheres as
                      there is room for */
    size_t rounds; /**< rounds of the search for spheres of little excess volume; 0: 8000 moves of a sphere */
    uint64_t seed; /**< of the search; the same seed gives the same bits everywhere */
    const ovoid_allocator *allocator; /**< of the working memory; NULL: malloc and free */
    ovoid_watch
        watch; /**< asked before each move and each cell of an audit. If it stops the call: the present spheres grow
                  until they are proven to cover the link, or LIMIT if they then exceed it by more than the excess */
} ovoid_robot_cover_options;

/** Spheres that cover a link: the link, room for them, and the results. */
typedef struct ovoid_robot_sphere_cover {
    uint32_t link;
    ovoid_robot_sphere *spheres; /**< owned by the caller, capacity of them; receives spheres in the link's frame */
    size_t capacity;             /**< 1 to 4096 */
    size_t count;                /**< written: how many there are */
    ovoid_robot_bracket depth;   /**< written: that of an audit of them; its upper end is at most 0 */
} ovoid_robot_sphere_cover;

/**
 * Finds spheres that are proven to cover a link, with little volume outside it. Errors: those of an audit; ARGUMENT
 * (capacity, options); LIMIT: no cover within `excess` was found with the spheres that there is room for.
 */
OVOID_API ovoid_code ovoid_robot_compute_sphere_cover(const ovoid_robot *robot,
                                                      const ovoid_robot_cover_options *options,
                                                      ovoid_robot_sphere_cover *cover, ovoid_error *error);

/** Spheres of any links of a robot. Borrowed. */
typedef struct ovoid_robot_link_spheres {
    const ovoid_robot_link_sphere *items;
    size_t count;
} ovoid_robot_link_spheres;

/**
 * The robot with spheres in the place of its elements: the same links, joints, variables and disabled pairs, and an
 * element for each sphere, in their order. It owns its shapes and borrows nothing; of the options only the allocator is
 * used. NULL on failure: ARGUMENT (no robot), and with the sphere as place INDEX (no such link), NOT_FINITE, RADIUS,
 * RANGE; LIMIT, MEMORY. A link without spheres has no elements.
 */
OVOID_API ovoid_robot *ovoid_robot_create_from_spheres(const ovoid_robot *robot,
                                                       const ovoid_robot_link_spheres *spheres,
                                                       const ovoid_robot_options *options, ovoid_error *error);

#ifdef __cplusplus
}
#endif
#endif
