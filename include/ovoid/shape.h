/**
 * @file shape.h
 * A shape: an immutable convex body in one block of memory, shared by any number of bodies and threads.
 */
#ifndef OVOID_SHAPE_H
#define OVOID_SHAPE_H

#include "ovoid/ellipsoid.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * A convex body: the convex hull of its vertices, enlarged by a rounding radius >= 0. A point with a radius is a
 * sphere, a segment a capsule, a flat polygon a rounded plate. It holds faces, both ellipsoids, measures and a table
 * for its support function.
 */
typedef struct ovoid_shape ovoid_shape;

/** Which inner ellipsoid a shape holds. */
typedef enum ovoid_inner_method {
    OVOID_INNER_MAXIMUM = 0, /**< the maximum-volume inscribed ellipsoid */
    OVOID_INNER_PHASES = 1,  /**< the paper's three phases */
    OVOID_INNER_LEAN = 2     /**< that of the body's moments, scaled to fit: a lean shape, which is made in half to two
                                thirds of the time and is as true, but has no table of supports and no Gauss map */
} ovoid_inner_method;

/**
 * How far the true body may differ from a shape that approximates it: two lengths >= 0. Every point of the true body,
 * which is convex and not empty, is within `outside` of the shape, and every point of the shape, rounding radius
 * included, is within `inside` of the true body. So lower - outside <= d <= upper + inside holds for the true distance
 * d of two bodies, where lower and upper are those of the shapes and both lengths are summed over both bodies
 * (docs/allowances.md). This is the bracket of every answer. Points and normals are those of the shapes. `outside`
 * differs from a rounding radius, which is part of the body: it changes only lower bounds.
 *
 * With an axis, the true body exceeds the shape only across the axis: every point of the true body is within `outside`
 * of a point of the shape that has the same height along the axis. Along the axis the shape is then exact: a lower
 * bound by a normal n loses outside |n x axis| in place of outside.
 */
typedef struct ovoid_allowance {
    double outside; /**< how far the true body may exceed the shape */
    double inside; /**< how far the shape may exceed the true body; a length above its own diameter plus `outside` means
                      the same as that, and is stored as about that */
    ovoid_vec3 axis; /**< of any length, stored as 1, in the user's local frame; zero: `outside` holds for all
                        directions. Stored as zero if `outside` is zero */
} ovoid_allowance;

/** Kinds of bodies that are known in closed form. */
typedef enum ovoid_round_kind {
    OVOID_ROUND_NONE = 0, /**< nothing is known beside polyhedron, radius and allowance */
    OVOID_ROUND_CYLINDER, /**< a cylinder from z = -half_length to +half_length */
    OVOID_ROUND_CONE,     /**< a cone, its base at z = -half_length, its apex at +half_length */
    OVOID_ROUND_ELLIPSOID /**< an ellipsoid around the origin, with half_axes along x, y and z */
} ovoid_round_kind;

/**
 * The true body of a shape whose polyhedron is inscribed in it, in the user's local frame; the shape's rounding radius
 * is around it. Distances and depths of pairs are those of true bodies (docs/allowances.md).
 */
typedef struct ovoid_round {
    ovoid_round_kind kind;
    double radius, half_length; /**< of cylinders and cones, else 0 */
    ovoid_vec3 half_axes;       /**< of ellipsoids, else 0 */
} ovoid_round;

/** Options of all functions that create a shape; all zero, or NULL, is the default. */
typedef struct ovoid_shape_options {
    double radius;             /**< rounding radius, >= 0, added around the hull */
    double gap;                /**< relative volume gap of the ellipsoids; 0 means 1e-6, of a lean shape 0.1 */
    ovoid_inner_method inner;  /**< which inner ellipsoid */
    ovoid_allowance allowance; /**< what the true body may differ by; zero: the shape is the body */
    double tolerance; /**< of cylinders, cones and ellipsoids: the most that `outside` may be, a length; 0 means
                         radius / 200, of ellipsoids a 13th of the largest half axis, of flat ones a 9th */
    const ovoid_allocator *allocator; /**< NULL: malloc and free; copied into the shape */
} ovoid_shape_options;

/**
 * The convex hull of points. xyz: count points, xyz of point i at 3 i, finite. The array is not kept. No extreme point
 * is lost: a point is dropped only if it equals another or if exact arithmetic proves that it is in the hull of those
 * kept. Returns NULL on failure with *error filled (error may be NULL): EMPTY, NOT_FINITE (place: the point), RANGE,
 * RADIUS, LIMIT, HULL, MEMORY. The caller destroys the shape. Cost: n log n. At most 2^24 points. Hull: C. B. Barber,
 * D. P. Dobkin, H. Huhdanpaa, The quickhull algorithm for convex hulls, 1996, with every decision in exact arithmetic.
 */
OVOID_API ovoid_shape *ovoid_shape_create_from_points(const double *xyz, size_t count,
                                                      const ovoid_shape_options *options, ovoid_error *error);

/** Faces of a polyhedron: polygons, counter-clockwise from outside, as runs of vertex indices. */
typedef struct ovoid_faces {
    const double *vertices; /**< xyz of vertex i at 3 i */
    size_t vertex_count;
    const uint32_t *indices; /**< all faces' indices, one face after another */
    const uint32_t *sizes;   /**< number of indices of each face, >= 3 */
    size_t face_count;
} ovoid_faces;

/**
 * A shape from vertices and faces that are stated to be convex; this is checked, then the hull of the vertices is
 * computed. The checks: the indices are valid, each edge occurs once in each direction (equal points count as one), and
 * no vertex is above any face's plane by more than the distance of the face's own corners from it, or 64 roundings of
 * the largest coordinate. Errors: INDEX (place: the face), NOT_CONVEX (place: the face), and those of
 * ovoid_shape_create_from_points; EMPTY if there are no faces.
 */
OVOID_API ovoid_shape *ovoid_shape_create_from_faces(const ovoid_faces *faces, const ovoid_shape_options *options,
                                                     ovoid_error *error);

/** An axis-aligned box of the given half sizes around the origin (>= 0; zero makes it flat). */
OVOID_API ovoid_shape *ovoid_shape_create_box(ovoid_vec3 half, const ovoid_shape_options *options, ovoid_error *error);

/** A sphere around the origin: a point with a radius (added to options->radius). */
OVOID_API ovoid_shape *ovoid_shape_create_sphere(double radius, const ovoid_shape_options *options, ovoid_error *error);

/** A capsule along z: a segment of length 2 half_length with that radius (added to options->radius). */
OVOID_API ovoid_shape *ovoid_shape_create_capsule(double radius, double half_length, const ovoid_shape_options *options,
                                                  ovoid_error *error);

/**
 * The cylinder along z, stored as an inscribed prism with an allowance: brackets are those of the true cylinder. Those
 * of distances are as narrow as of polyhedra; of depths too, but where a rim crosses an edge they, as those of motions
 * and smooth brackets, may be as wide as the allowance. It takes the
 * fewest sides that meet options->tolerance, 32 by default; LIMIT if these are more than 2^16. Both lengths are added
 * to those of options->allowance; the sum has the axis z, so that the flat ends are exact, unless options->allowance
 * has an `outside` that is not along z. Errors: NOT_FINITE, RADIUS, RANGE, ARGUMENT (tolerance), and those of
 * ovoid_shape_create_from_points.
 */
OVOID_API ovoid_shape *ovoid_shape_create_cylinder(double radius, double half_length,
                                                   const ovoid_shape_options *options, ovoid_error *error);

/** The cone, apex at z = +half_length, base circle at z = -half_length: as ovoid_shape_create_cylinder. */
OVOID_API ovoid_shape *ovoid_shape_create_cone(double radius, double half_length, const ovoid_shape_options *options,
                                               ovoid_error *error);

/**
 * The ellipsoid around the origin with half axes >= 0 along x, y and z, stored as an inscribed polyhedron with an
 * allowance. Brackets are those of the true ellipsoid, as narrow as of polyhedra: distances, and depths up to the
 * square of the least half axis over the largest; deeper ones to some 1e-8 of the size. The polyhedron has 4 n^2 + 2
 * vertices with the fewest steps n, 2 to 64, that meet options->tolerance, 38 by default; LIMIT if 64 do not.
 * An ellipsoid whose least half axis is below 2^-20 of the largest is the polyhedron with its allowance. Errors:
 * NOT_FINITE, RADIUS, RANGE, ARGUMENT (a negative half axis, the tolerance), MEMORY. Cost: linear in the vertices.
 */
OVOID_API ovoid_shape *ovoid_shape_create_ellipsoid(ovoid_vec3 half_axes, const ovoid_shape_options *options,
                                                    ovoid_error *error);

/** A regular polygon of `sides` >= 3 corners on a circle, extended along z. */
typedef struct ovoid_prism {
    double radius;      /**< of the circle */
    double half_length; /**< from z = -half_length to +half_length */
    uint32_t sides;
} ovoid_prism;

/** A prism along z, inscribed in the cylinder of that radius: the polyhedron itself. */
OVOID_API ovoid_shape *ovoid_shape_create_prism(const ovoid_prism *prism, const ovoid_shape_options *options,
                                                ovoid_error *error);

/** A pyramid along z over the prism's lower base, apex at z = +half_length. */
OVOID_API ovoid_shape *ovoid_shape_create_pyramid(const ovoid_prism *prism, const ovoid_shape_options *options,
                                                  ovoid_error *error);

/**
 * The shape with its vertices moved: ovoid_shape_create_from_points of the new points, at the same cost. xyz: one point
 * for each vertex of ovoid_polytope, in its order, in the user's local frame. Points that are no longer extreme are
 * dropped. Errors as in ovoid_shape_create_from_points, and ARGUMENT (no shape).
 */
OVOID_API ovoid_shape *ovoid_shape_create_deformed(const ovoid_shape *shape, const double *xyz,
                                                   const ovoid_shape_options *options, ovoid_error *error);

/** The two parts into which a plane cuts a shape. The caller destroys both. */
typedef struct ovoid_shape_halves {
    ovoid_code code;    /**< OVOID_OK; else the reason why there are no parts */
    ovoid_shape *below; /**< the part with normal . x <= offset; NULL if only points of the plane itself are left */
    ovoid_shape *above; /**< the part with normal . x >= offset; NULL as for `below` */
} ovoid_shape_halves;

/**
 * The shape cut in two by a plane { x : normal . x = offset } of the user's local frame, normal of any length but zero.
 * Where an edge is cut, both parts get the same point, which is on the edge to rounding. The polyhedron is cut; the
 * rounding radius is that of the options, as for every new shape. Errors as ovoid_shape_create_from_points, and
 * ARGUMENT (normal, no shape), NOT_FINITE; then both halves are NULL.
 */
OVOID_API ovoid_shape_halves ovoid_shape_create_divided(const ovoid_shape *shape, const ovoid_plane *plane,
                                                        const ovoid_shape_options *options, ovoid_error *error);

/** A copy with memory of its own; only the allocator of the options is used. Errors: ARGUMENT (no shape), MEMORY. */
OVOID_API ovoid_shape *ovoid_shape_create_copy(const ovoid_shape *shape, const ovoid_shape_options *options,
                                               ovoid_error *error);

/**
 * A copy with the allowance of the options, axis included; of the other options only the allocator is used. Errors:
 * ARGUMENT (no shape), NOT_FINITE, RANGE (the allowance), MEMORY.
 */
OVOID_API ovoid_shape *ovoid_shape_create_allowed(const ovoid_shape *shape, const ovoid_shape_options *options,
                                                  ovoid_error *error);

/** Frees the shape; NULL is allowed. No query may be using it. */
OVOID_API void ovoid_shape_destroy(ovoid_shape *shape);

/** The polyhedron. A view into the shape. */
OVOID_API ovoid_polytope ovoid_shape_get_polytope(const ovoid_shape *shape);
/** The rounding radius. */
OVOID_API double ovoid_shape_get_radius(const ovoid_shape *shape);
/** The allowance. */
OVOID_API ovoid_allowance ovoid_shape_get_allowance(const ovoid_shape *shape);
/**
 * The true body, where it is a cylinder, a cone or an ellipsoid: of a shape that ovoid_shape_create_cylinder, _cone or
 * _ellipsoid made with no allowance in its options, of a copy of it, and of what was read from its file. Else the kind
 * is OVOID_ROUND_NONE.
 */
OVOID_API ovoid_round ovoid_shape_get_round(const ovoid_shape *shape);
/** What the constructor did with the given points. */
OVOID_API ovoid_report ovoid_shape_get_report(const ovoid_shape *shape);
/**
 * 1 if OVOID_INNER_LEAN made it, or it was read from the file of one that this made. It answers every query, with the
 * same tolerances and proofs. Its inner ellipsoid decides fewer overlaps, and a support function of 96 vertices or more
 * looks at all of them. Depths of up to 32 vertices are found by a search, not from the planes of the Gauss map, in up
 * to 1.7 times the time; its faces show no depth of a swept sphere (ovoid_swept_sphere.shape). So a lean shape is for
 * few queries (docs/performance.md).
 */
OVOID_API int ovoid_shape_is_lean(const ovoid_shape *shape);
/** The outer ellipsoid of the polyhedron (without the radius), with its gap. Body frame. */
OVOID_API ovoid_fit ovoid_shape_get_outer(const ovoid_shape *shape);
/**
 * The inner ellipsoid of the polyhedron (without the radius), with its gap, which is infinite where only the moments
 * gave it. Body frame.
 */
OVOID_API ovoid_fit ovoid_shape_get_inner(const ovoid_shape *shape);
/** Measures of the polyhedron without its radius. */
OVOID_API ovoid_measures ovoid_shape_get_measures(const ovoid_shape *shape);
/** Size of the block in bytes. */
OVOID_API size_t ovoid_shape_get_size(const ovoid_shape *shape);

/**
 * The shape as bytes of a versioned, little-endian file (".ovoid") with a checksum; for solids of 16 vertices or more,
 * unless they are regular prisms, pyramids or boxes, the file contains the hull's triangles. Writes at most capacity
 * bytes to buffer and returns the number of bytes needed; nothing is written if capacity is too small.
 */
OVOID_API size_t ovoid_shape_write(const ovoid_shape *shape, void *buffer, size_t capacity);

/**
 * A shape from the bytes of a file of any version. Every byte is checked: magic, version, sizes, checksum, indices,
 * finiteness, that the triangles are the hull, and that the ellipsoids enclose and are enclosed. The result is the
 * shape that was written, bit for bit. Of the options only the allocator is used. Errors: FORMAT (place: byte offset),
 * MEMORY.
 */
OVOID_API ovoid_shape *ovoid_shape_read(const void *bytes, size_t size, const ovoid_shape_options *options,
                                        ovoid_error *error);

#ifdef __cplusplus
}
#endif
#endif
