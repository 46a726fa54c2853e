// The piece of a solid in a convex cell, during the cuts: the triangles clipped to the cell, and the cell. Caps are not
// needed: a corner of the hull of the piece is a corner of a clipped triangle, or a corner of the cell inside the
// solid.
#ifndef OVOID_DECOMPOSE_PIECE_H
#define OVOID_DECOMPOSE_PIECE_H

#include "decompose/body.h"
#include "polytope/hull.h"

/// Corners of triangles, three a triangle.
typedef struct soup {
    vec3 *corners;
    size_t count, room; ///< of corners
} soup;

/// A point of a hull outside the solid, and its estimated distance.
typedef struct outlier {
    vec3 point;
    double distance;
    uint32_t triangle; ///< near it
} outlier;
enum { OUTLIERS = 256 };

typedef struct piece {
    soup triangles;
    ovoid_shape *frame; ///< the cell; user's units
    vec3 *points;       ///< corners of the hull
    uint32_t point_count;
    outlier outliers[OUTLIERS]; ///< the farthest first
    uint32_t outlier_count;
    double excess;   ///< estimated
    int is_finished; ///< no plane cuts it
} piece;

/// The whole solid. Errors: MEMORY and those of hulls.
ovoid_code piece_create(const body *b, piece *p, ovoid_error *error);
/// Cuts the piece by a plane; *is_cut is 0 if one side is empty. The piece itself is unchanged. Errors as in
/// piece_create.
ovoid_code piece_divide(const body *b, const piece *p, const ovoid_plane *plane, piece sides[2], int *is_cut,
                        ovoid_error *error);
void piece_destroy(const body *b, piece *p);

/// Fills the outliers and the estimate from the hull of the points. Errors: MEMORY and those of hulls.
ovoid_code piece_estimate(const body *b, piece *p, ovoid_error *error);
/// Points whose hull is estimated. If the estimate is above `enough`, the result is some number above that.
typedef struct estimated_points {
    const vec3 *points;
    uint32_t count;
    double enough;
} estimated_points;

/// The estimate for the hull of points alone.
ovoid_code points_estimate(const body *b, const estimated_points *of, double *excess, ovoid_error *error);

/// The plane with the least cost, and that cost as in piece_compute_cost, plus a small amount for planes far from the
/// middle: the cost counts the outliers that remain in the hulls of both sides. Infinite if there is no plane.
double piece_find_plane(const body *b, const piece *p, ovoid_plane *plane);
/// The sum of the squares of the outliers' distances.
double piece_compute_cost(const piece *p);
/// A few planes for which a second plane may gain much.
enum { PIECE_PLANES = 15 };
uint32_t piece_list_planes(const body *b, const piece *p, ovoid_plane planes[PIECE_PLANES]);
/// The plane by which the piece is cut; *is_found is 0 if there is none. Errors: MEMORY and those of hulls.
ovoid_code piece_choose_plane(const body *b, const piece *p, ovoid_plane *plane, int *is_found, ovoid_error *error);

/// Whether a corner of the cell is inside the solid, moved toward the cell's middle by a small amount: a corner that
/// touches from outside is not inside.
int piece_is_inside(const body *b, vec3 corner, vec3 middle);
vec3 piece_get_frame_point(const body *b, const ovoid_polytope *frame, uint32_t i);
vec3 piece_get_frame_middle(const body *b, const ovoid_polytope *frame);

#endif
